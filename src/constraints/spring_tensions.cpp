#include "spring_tensions.h"

namespace cloth
{

SpringTensions::SpringTensions(const ClothModel& model)
  : passes_(limited_batches(model), runs_by_rows(limited_batches(model), model.rows), model.nodes())
{
}

void SpringTensions::go_on_from(const Shortening& before)
{
  if (const auto* const other = dynamic_cast<const SpringTensions*>(&before))
  {
    passes_.go_on_from(other->passes_);
  }
}

StrainLimit::Report SpringTensions::shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes,
                                            Vectors& positions, Vectors* shifts)
{
  const StrainLimit::Report report = passes_.shorten(inverse_masses.data(), max_strain, passes, columns_of(positions));
  if (shifts != nullptr)
  {
    passes_.add_tensions_to(columns_of(*shifts));
  }
  return report;
}

}  // namespace cloth
