#include "cloth_sim/forces/air.h"

#include <cstdint>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

/// Of a call for some of the nodes, as one of the whole sheet: those that begin with node 0 count.
std::uint64_t counted(NodeRange nodes)
{
  return nodes.begin == 0 && nodes.size() > 0 ? 1 : 0;
}

}  // namespace

Air::Air(const AirProperties& properties) : properties_(properties), gusts_(properties.gusts)
{
}

bool Air::is_coupled(const ClothModel& model) const
{
  return properties_.wind_coupling > 0.0 && !model.is_chain();
}

void Air::make_room_for(const ClothModel& model) const
{
  if (is_coupled(model))
  {
    normals_.resize(model.nodes(), 3);
    normal_speeds_.resize(model.nodes());
  }
}

void Air::add_forces(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                     Vectors& forces) const
{
  make_room_for(model);
  add_forces(model, time, positions, velocities, all_nodes(model), forces);
}

void Air::add_forces(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                     NodeRange nodes, Vectors& forces) const
{
  if (properties_.viscous_damping > 0.0)
  {
    part_calls()[Part::viscous_damping] += counted(nodes);
    in_widest_vectors([&](auto) {
      const double damping = properties_.viscous_damping;
      const double* const areas = model.areas.data();
      for (int d = 0; d < 3; ++d)
      {
        const double* const v = velocities.col(d).data();
        double* const f = forces.col(d).data();
#pragma GCC ivdep
        for (int i = nodes.begin; i < nodes.end; ++i)
        {
          f[i] -= damping * areas[i] * v[i];
        }
      }
    });
  }
  if (!is_coupled(model))
  {
    return;
  }
  find_normal_speeds(model, time, positions, velocities, nodes);
  normal_speeds_.segment(nodes.begin, nodes.size()) *=
      properties_.wind_coupling * model.areas.segment(nodes.begin, nodes.size()).array();
  add_along_normals(nodes, forces);
}

void Air::find_normal_speeds(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                             NodeRange nodes) const
{
  part_calls()[Part::wind] += counted(nodes);
  node_normals(model, positions, nodes, normals_);
  const Eigen::Vector3d wind = wind_at(time);
  in_widest_vectors([&](auto) {
    const double* const n_x = normals_.col(0).data();
    const double* const n_y = normals_.col(1).data();
    const double* const n_z = normals_.col(2).data();
    const double* const v_x = velocities.col(0).data();
    const double* const v_y = velocities.col(1).data();
    const double* const v_z = velocities.col(2).data();
    double* const speeds = normal_speeds_.data();
#pragma GCC ivdep
    for (int i = nodes.begin; i < nodes.end; ++i)
    {
      speeds[i] = n_x[i] * (wind[0] - v_x[i]) + n_y[i] * (wind[1] - v_y[i]) + n_z[i] * (wind[2] - v_z[i]);
    }
  });
}

void Air::add_along_normals(NodeRange nodes, Vectors& vectors) const
{
  in_widest_vectors([&](auto) {
    const double* const speeds = normal_speeds_.data();
    for (int d = 0; d < 3; ++d)
    {
      const double* const n = normals_.col(d).data();
      double* const sums = vectors.col(d).data();
#pragma GCC ivdep
      for (int i = nodes.begin; i < nodes.end; ++i)
      {
        sums[i] += n[i] * speeds[i];
      }
    }
  });
}

// n is a unit vector, so that along n the equation is scalar:
// (m + h C_dis + h C_vi) (n . v) = m (n . v_given) + h C_vi (n . u),  and across n: (m + h C_dis) v = m v_given.
void Air::damp_implicitly(const ClothModel& model, double time, const Vectors& positions, double h,
                          Vectors& velocities) const
{
  if (properties_.viscous_damping > 0.0)
  {
    ++part_calls()[Part::viscous_damping];
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
  make_room_for(model);
  find_normal_speeds(model, time, positions, velocities, all_nodes(model));
  const auto coupled = h * properties_.wind_coupling * model.areas.array();
  const auto inertia = model.masses.array() + h * properties_.viscous_damping * model.areas.array();
  normal_speeds_ *= coupled / (inertia + coupled);
  add_along_normals(all_nodes(model), velocities);
}

// Likewise: without C_vi the equation gives a, with which the air still has C_vi n . (u - v - h a) to add along n, over
// m + h C_dis + h C_vi.
void Air::accelerate_implicitly(const ClothModel& model, double time, const Vectors& positions, double h,
                                NodeRange nodes, Vectors& forces, Vectors& velocities) const
{
  const bool coupled = is_coupled(model);
  if (coupled)
  {
    part_calls()[Part::wind] += counted(nodes);
    node_normals(model, positions, nodes, normals_);
  }
  part_calls()[Part::viscous_damping] += properties_.viscous_damping > 0.0 ? counted(nodes) : 0;
  const Eigen::Vector3d wind = wind_at(time);
  in_widest_vectors([this, &model, h, nodes, &forces, &velocities, coupled, wind](auto) {
    const int end = nodes.end;
    const double step = h;
    const double damping = properties_.viscous_damping;
    const double coupling = properties_.wind_coupling;
    const double* const masses = model.masses.data();
    const double* const areas = model.areas.data();
    double* const v_x = velocities.col(0).data();
    double* const v_y = velocities.col(1).data();
    double* const v_z = velocities.col(2).data();
    double* const a_x = forces.col(0).data();
    double* const a_y = forces.col(1).data();
    double* const a_z = forces.col(2).data();
    const auto accelerate = [=](int i, double x, double y, double z) {
      a_x[i] = x;
      a_y[i] = y;
      a_z[i] = z;
    };
    const auto add_to_velocity = [=](int i, double x, double y, double z) {
      v_x[i] += step * x;
      v_y[i] += step * y;
      v_z[i] += step * z;
    };
#pragma GCC ivdep
    for (int i = nodes.begin; i < end; ++i)
    {
      const double c = damping * areas[i];
      const double inverse = 1.0 / (masses[i] + step * c);
      const double x = inverse * (a_x[i] - c * v_x[i]);
      const double y = inverse * (a_y[i] - c * v_y[i]);
      const double z = inverse * (a_z[i] - c * v_z[i]);
      accelerate(i, x, y, z);
      add_to_velocity(i, x, y, z);
    }
    if (!coupled)
    {
      return;
    }
    const double* const n_x = normals_.col(0).data();
    const double* const n_y = normals_.col(1).data();
    const double* const n_z = normals_.col(2).data();
#pragma GCC ivdep
    for (int i = nodes.begin; i < end; ++i)
    {
      const double c = coupling * areas[i];
      const double speed = n_x[i] * (wind[0] - v_x[i]) + n_y[i] * (wind[1] - v_y[i]) + n_z[i] * (wind[2] - v_z[i]);
      const double missing = c * speed / (masses[i] + step * (damping * areas[i] + c));
      accelerate(i, a_x[i] + missing * n_x[i], a_y[i] + missing * n_y[i], a_z[i] + missing * n_z[i]);
      add_to_velocity(i, missing * n_x[i], missing * n_y[i], missing * n_z[i]);
    }
  });
}

void Air::add_damping_product(const ClothModel& model, const Vectors& normals, const Vectors& u, Vectors& product) const
{
  if (properties_.viscous_damping > 0.0)
  {
    ++part_calls()[Part::viscous_damping];
    product.array() += u.array().colwise() * (properties_.viscous_damping * model.areas.array());
  }
  if (is_coupled(model))
  {
    ++part_calls()[Part::wind];
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
