#include <algorithm>
#include <cmath>

#include "rows.h"

namespace cloth
{
namespace
{

/// Extended position-based dynamics (Macklin, Mueller and Chentanez 2016) in small substeps of one pass over the
/// springs each (Macklin et al., "Small steps in physics simulation", 2019). A spring is the constraint |l| = l0 with
/// the compliance 1/k and internal damping c in their physical units (equation 26 of 2016, with one pass):
///
///   lambda = -(|l| - l0 + gamma h n . (v_j - v_i)) / ((1 + gamma) (1/m_i + 1/m_j) + 1/(k h^2)),  gamma = c/(k h)
///
/// and its ends move by -+ lambda n/m at once, Gauss-Seidel's way. With the compliance times 0 this is position-based
/// dynamics: every spring is made as long as it is at rest, whatever its stiffness. Velocities are corrected along with
/// the positions, which is v = (x' - x)/h without its rounding error.
class ExtendedPositionBasedDynamics : public Method
{
public:
  ExtendedPositionBasedDynamics(int substeps, double compliance) : substeps_(substeps), compliance_(compliance)
  {
  }

  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    const ClothModel& model = dynamics.model();
    inverse_masses_ = model.masses.cwiseInverse();
    for (int i = 0; i < model.nodes(); ++i)
    {
      inverse_masses_[i] = dynamics.pins().holds(i) ? 0.0 : inverse_masses_[i];
    }
    const double begin = state.time;
    const double substep = h / substeps_;
    for (int s = 1; s <= substeps_; ++s)
    {
      predict(dynamics, substep, state);
      state.time = s == substeps_ ? begin + h : begin + s * substep;
      dynamics.pins().impose(state.time, state.positions, state.velocities);
      if (records())
      {
        record_external_forces(dynamics, substep, state);
      }
      for (const SpringBatch& batch : model.springs)
      {
        project(batch, substep, state);
      }
    }
    StepReport report;
    report.force_evaluations = substeps_;
    return report;
  }

private:
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

  /// In two colours: springs whose first ends lie in every second stretch of `offset` nodes share no node. The order is
  /// always the same, and so is the result.
  void project(const SpringBatch& batch, double h, ClothState& state)
  {
    const Gains gains{ compliance_ * batch.damping / (batch.stiffness * h), compliance_ / (batch.stiffness * h * h),
                       batch.rest_length };
    for (const int colour : { 0, 1 })
    {
      for_each_spring(batch, [&](int i, int j) {
        if (i / batch.offset % 2 == colour)
        {
          project(i, j, gains, h, state);
        }
      });
    }
  }

  struct Gains
  {
    double damping;
    double compliance;
    double rest_length;
  };

  void project(int i, int j, const Gains& gains, double h, ClothState& state)
  {
    const Eigen::RowVector3d l = state.positions.row(j) - state.positions.row(i);
    const double length = l.norm();
    const double inverse_masses = inverse_masses_[i] + inverse_masses_[j];
    if (length == 0.0 || inverse_masses == 0.0)
    {
      return;
    }
    const Eigen::RowVector3d n = l / length;
    const double approach = h * n.dot(state.velocities.row(j) - state.velocities.row(i));
    const double lambda = -(length - gains.rest_length + gains.damping * approach) /
                          ((1.0 + gains.damping) * inverse_masses + gains.compliance);
    if (records())
    {
      impulses().row(i) -= lambda / h * n;
      impulses().row(j) += lambda / h * n;
    }
    move(i, -lambda * inverse_masses_[i] * n, h, state);
    move(j, lambda * inverse_masses_[j] * n, h, state);
  }

  static void move(int i, const Eigen::RowVector3d& way, double h, ClothState& state)
  {
    state.positions.row(i) += way;
    state.velocities.row(i) += way / h;
  }

  int substeps_;
  double compliance_;
  Eigen::VectorXd inverse_masses_;
  Vectors accelerations_;
};

}  // namespace

const MethodRow xpbd{ "xpbd",
                      1,
                      no_stability_limit,
                      { -1.0, 2 },
                      false,
                      false,
                      1,
                      0,
                      "too soft where the substeps are too long, and not alike to both sides: it depends on the order",
                      [](const MethodSettings& settings) -> std::unique_ptr<Method> {
                        return std::make_unique<ExtendedPositionBasedDynamics>(settings.iterations,
                                                                               settings.compliance);
                      } };

}  // namespace cloth
