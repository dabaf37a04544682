#include "spring_tensions.h"

#include <utility>

namespace cloth
{

SpringTensions::SpringTensions(const ClothModel& model)
  : lengths_(model), passes_(limited_batches(model), runs_by_rows(limited_batches(model), model.rows), model.nodes())
{
}

void SpringTensions::go_on_from(const Shortening& before)
{
  if (const auto* const other = dynamic_cast<const SpringTensions*>(&before))
  {
    use_held(other->held_);
    passes_.go_on_from(other->passes_);
  }
}

void SpringTensions::use_held(const std::vector<int>& held)
{
  if (held != held_)
  {
    held_ = held;
    passes_.use_tethers(lengths_.tethers<double>(held_, lengths_.nodes(), [](int node) { return node; }));
  }
}

StrainLimit::Report SpringTensions::shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes,
                                            Vectors& positions, Vectors* shifts)
{
  std::vector<int> held;
  for (int i = 0; i < lengths_.nodes(); ++i)
  {
    if (inverse_masses[i] == 0.0)
    {
      held.push_back(i);
    }
  }
  use_held(held);
  const StrainLimit::Report report = passes_.shorten(inverse_masses.data(), max_strain, passes, columns_of(positions));
  if (shifts != nullptr)
  {
    passes_.add_tensions_to(columns_of(*shifts));
  }
  return report;
}

}  // namespace cloth
