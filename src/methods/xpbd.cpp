#include <algorithm>
#include <cmath>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/spring_rows.h"
#include "cloth_sim/model/wide_vectors.h"

#include "rows.h"
#include "small_step_springs.h"

namespace cloth
{
namespace
{

/// The chosen springs' changes, from the ends' ways since the step's begin and the positions then.
template <bool fused, typename IsChosen>
void find_changes(const SpringRow& ways, const SpringRow& before, const Gains<double>& gains, IsChosen&& is_chosen,
                  RowChanges& changes)
{
  const Gains<double> local = gains;
  const double* const w_i = ways.w_i;
  const double* const w_j = ways.w_j;
  const double* const way_x_i = ways.i[0];
  const double* const way_y_i = ways.i[1];
  const double* const way_z_i = ways.i[2];
  const double* const way_x_j = ways.j[0];
  const double* const way_y_j = ways.j[1];
  const double* const way_z_j = ways.j[2];
  const double* const x_i = before.i[0];
  const double* const y_i = before.i[1];
  const double* const z_i = before.i[2];
  const double* const x_j = before.j[0];
  const double* const y_j = before.j[1];
  const double* const z_j = before.j[2];
  const int n = ways.n;
  const int padded = ways.padded();
#pragma GCC ivdep
  for (int k = 0; k < padded; ++k)
  {
    const double way_x = way_x_j[k] - way_x_i[k];
    const double way_y = way_y_j[k] - way_y_i[k];
    const double way_z = way_z_j[k] - way_z_i[k];
    const double x = x_j[k] - x_i[k] + way_x;
    const double y = y_j[k] - y_i[k] + way_y;
    const double z = z_j[k] - z_i[k] + way_z;
    const double w = w_i[k] + w_j[k];
    const double excess =
        correction<fused>(x * x + y * y + z * z, x * way_x + y * way_y + z * way_z, local.rest_length, local.damping);
    const double part = is_chosen(k) && k < n && w > 0.0 ? excess / resistance(local, w) : 0.0;
    changes.x[k] = part * x;
    changes.y[k] = part * y;
    changes.z[k] = part * z;
  }
}

/// Extended position-based dynamics (Macklin, Mueller and Chentanez 2016) in small substeps of one pass over the
/// springs each (Macklin et al., "Small steps in physics simulation", 2019). A spring is the constraint |l| = l0 with
/// the compliance 1/k and internal damping c in their physical units (equation 26 of 2016, with one pass):
///
///   lambda = -(|l| - l0 + gamma h n . (v_j - v_i)) / ((1 + gamma) (1/m_i + 1/m_j) + 1/(k h^2)),  gamma = c/(k h)
///
/// and its ends move by -+ lambda n/m at once, Gauss-Seidel's way. With the compliance times 0 this is position-based
/// dynamics: every spring is made as long as it is at rest, whatever its stiffness. The velocities follow from the
/// positions, v = (x' - x)/h.
class ExtendedPositionBasedDynamics : public Method
{
public:
  ExtendedPositionBasedDynamics(int substeps, double compliance) : substeps_(substeps), compliance_(compliance)
  {
  }

  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    const ClothModel& model = dynamics.model();
    make_room_for(model.nodes());
    dynamics.pins().find_inverse_masses(model.masses, inverse_masses_);
    const double begin = state.time;
    const double substep = h / substeps_;
    for (int s = 1; s <= substeps_; ++s)
    {
      before_.topRows(model.nodes()) = state.positions;
      predict(dynamics, substep, state);
      state.time = s == substeps_ ? begin + h : begin + s * substep;
      dynamics.pins().impose(state.time, state.positions, state.velocities);
      ways_.topRows(model.nodes()) = substep * state.velocities;
      for (const Pin& pin : dynamics.pins().all())
      {
        ways_(pin.nodes, Eigen::all) = state.positions(pin.nodes, Eigen::all) - before_(pin.nodes, Eigen::all);
      }
      if (records())
      {
        record_external_forces(dynamics, substep, state);
      }
      project(model, substep);
      state.velocities = ways_.topRows(model.nodes()) / substep;
      state.positions = before_.topRows(model.nodes()) + ways_.topRows(model.nodes());
      dynamics.pins().impose(state.time, state.positions, state.velocities);
    }
    StepReport report;
    report.force_evaluations = substeps_;
    return report;
  }

private:
  void make_room_for(int nodes)
  {
    if (inverse_masses_.size() != nodes + row_padding)
    {
      inverse_masses_.setZero(nodes + row_padding);
      before_.setZero(nodes + row_padding, 3);
      ways_.setZero(nodes + row_padding, 3);
    }
  }

  void predict(const Dynamics& dynamics, double h, ClothState& state)
  {
    dynamics.external_forces_on_all(state.time, accelerations_);
    dynamics.accelerations_of(accelerations_, accelerations_);
    state.velocities += h * accelerations_;
    dynamics.air().damp_implicitly(dynamics.model(), state.time + h, state.positions, h, state.velocities);
    state.positions += h * state.velocities;
  }

  void record_external_forces(const Dynamics& dynamics, double h, const ClothState& state)
  {
    dynamics.external_forces_on_all(state.time, accelerations_);
    dynamics.air().add_forces(dynamics.model(), state.time, state.positions, state.velocities, accelerations_);
    add_impulses(h, accelerations_);
  }

  void record(const RowChanges& changes, int node, int offset, int n, double h)
  {
    for (int k = 0; k < n; ++k)
    {
      const Eigen::RowVector3d impulse = Eigen::RowVector3d(changes.x[k], changes.y[k], changes.z[k]) / h;
      impulses().row(node + k) += impulse;
      impulses().row(node + k + offset) -= impulse;
    }
  }

  /// Batch by batch, in two colours: springs whose first ends lie in every second stretch of `offset` nodes share no
  /// node. In another order long steps may be unstable.
  void project(const ClothModel& model, double h)
  {
    in_widest_vectors([&](auto arithmetic) {
      for (const SpringBatch& batch : model.springs)
      {
        count_call(batch);
        part_calls()[Part::internal_damping] += compliance_ * batch.damping > 0.0 ? 1 : 0;
        for (const int colour : { 0, 1 })
        {
          for (int r = 0; r < batch.rows; ++r)
          {
            project_row<arithmetic.has_fused_multiply_add>(batch, r, colour, h);
          }
        }
      }
    });
  }

  /// The springs of a row that have the colour: piece by piece of a stretch where stretches are long, else by choice.
  template <bool fused>
  void project_row(const SpringBatch& batch, int r, int colour, double h)
  {
    const Gains<double> gains = gains_of<double>(batch, compliance_, h);
    const int offset = batch.offset;
    const int begin = batch.first + r * batch.row_stride;
    const int end = begin + batch.cols;
    if (offset <= longest_along_a_row)
    {
      for (int node = begin; node < end; node += spring_row_size)
      {
        project_block<fused>(
            node, offset, std::min(spring_row_size, end - node), gains,
            [=](int k) { return ((node + k) & offset) == colour * offset; }, h);
      }
      return;
    }
    for (int stretch = begin / offset; stretch * offset < end; ++stretch)
    {
      const int end_here = std::min(end, (stretch + 1) * offset);
      for (int node = std::max(begin, stretch * offset); stretch % 2 == colour && node < end_here;
           node += spring_row_size)
      {
        project_block<fused>(
            node, offset, std::min(spring_row_size, end_here - node), gains, [](int) { return true; }, h);
      }
    }
  }

  template <bool fused, typename IsChosen>
  void project_block(int node, int offset, int n, const Gains<double>& gains, IsChosen&& is_chosen, double h)
  {
    const SpringRow ways(inverse_masses_.data(), columns_of(ways_), node, offset, n);
    const SpringRow before(inverse_masses_.data(), columns_of(before_), node, offset, n);
    RowChanges changes;
    find_changes<fused>(ways, before, gains, is_chosen, changes);
    move_ends(ways, changes);
    if (records())
    {
      record(changes, node, offset, n, h);
    }
  }

  static constexpr int longest_along_a_row = 2;  ///< offset of the flex springs along a row

  int substeps_;
  double compliance_;
  Eigen::VectorXd inverse_masses_;
  Vectors accelerations_;
  Vectors before_;  ///< positions at the substep's begin
  Vectors ways_;    ///< from there, m: velocities follow from them without the rounding of positions
};

}  // namespace

const MethodRow xpbd{ "xpbd",
                      1,
                      no_stability_limit,
                      { -1.0, 2 },
                      false,
                      false,
                      true,
                      1,
                      0,
                      "too soft where the substeps are too long, and not alike to both sides: it depends on the order",
                      [](const MethodSettings& settings) -> std::unique_ptr<Method> {
                        if (settings.precision == Precision::mixed)
                        {
                          return make_mixed_xpbd(settings);
                        }
                        return std::make_unique<ExtendedPositionBasedDynamics>(settings.iterations,
                                                                               settings.compliance);
                      } };

}  // namespace cloth
