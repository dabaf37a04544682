#include "cloth_sim/forces/air.h"

namespace cloth
{

Air::Air(const AirProperties& properties) : properties_(properties), gusts_(properties.gusts)
{
}

bool Air::is_coupled(const ClothModel& model) const
{
  return properties_.wind_coupling > 0.0 && !model.is_chain();
}

void Air::add_forces(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                     Vectors& forces) const
{
  if (properties_.viscous_damping > 0.0)
  {
    for (int d = 0; d < 3; ++d)
    {
      forces.col(d).array() -= properties_.viscous_damping * model.areas.array() * velocities.col(d).array();
    }
  }
  if (!is_coupled(model))
  {
    return;
  }
  find_normal_speeds(model, time, positions, velocities);
  normal_speeds_ *= properties_.wind_coupling * model.areas.array();
  forces.array() += normals_.array().colwise() * normal_speeds_;
}

void Air::find_normal_speeds(const ClothModel& model, double time, const Vectors& positions,
                             const Vectors& velocities) const
{
  node_normals(model, positions, normals_);
  const Eigen::Vector3d wind = wind_at(time);
  normal_speeds_.setZero(model.nodes());
  for (int d = 0; d < 3; ++d)
  {
    normal_speeds_ += normals_.col(d).array() * (wind[d] - velocities.col(d).array());
  }
}

// n is a unit vector, so that along n the equation is scalar:
// (m + h C_dis + h C_vi) (n . v) = m (n . v_given) + h C_vi (n . u),  and across n: (m + h C_dis) v = m v_given.
void Air::damp_implicitly(const ClothModel& model, double time, const Vectors& positions, double h,
                          Vectors& velocities) const
{
  if (properties_.viscous_damping > 0.0)
  {
    for (int d = 0; d < 3; ++d)
    {
      velocities.col(d).array() *=
          model.masses.array() / (model.masses.array() + h * properties_.viscous_damping * model.areas.array());
    }
  }
  if (!is_coupled(model))
  {
    return;
  }
  find_normal_speeds(model, time, positions, velocities);
  const auto coupled = h * properties_.wind_coupling * model.areas.array();
  const auto inertia = model.masses.array() + h * properties_.viscous_damping * model.areas.array();
  normal_speeds_ *= coupled / (inertia + coupled);
  velocities.array() += normals_.array().colwise() * normal_speeds_;
}

void Air::add_damping_product(const ClothModel& model, const Vectors& normals, const Vectors& u, Vectors& product) const
{
  if (properties_.viscous_damping > 0.0)
  {
    product.array() += u.array().colwise() * (properties_.viscous_damping * model.areas.array());
  }
  if (is_coupled(model))
  {
    const Eigen::ArrayXd along = normals.cwiseProduct(u).rowwise().sum().array() * model.areas.array();
    product.array() += normals.array().colwise() * (properties_.wind_coupling * along);
  }
}

double Air::least_damping_rate(const ClothModel& model) const
{
  return properties_.viscous_damping * (model.areas.array() / model.masses.array()).minCoeff();
}

double Air::damping_rate(const ClothModel& model) const
{
  const double wind_coupling = is_coupled(model) ? properties_.wind_coupling : 0.0;
  return (properties_.viscous_damping + wind_coupling) * (model.areas.array() / model.masses.array()).maxCoeff();
}

}  // namespace cloth
