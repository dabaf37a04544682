#include "implicit_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloth
{
namespace
{

/// The largest |u_i| / m_i.
double largest_per_mass(const Vectors& u, const Eigen::VectorXd& masses)
{
  return std::sqrt((u.rowwise().squaredNorm().array() / masses.array().square()).maxCoeff());
}

/// The largest sum of stiffness_factor k + damping_factor c at a node over its mass.
double largest_springs_per_mass(const ClothModel& model, double stiffness_factor, double damping_factor)
{
  Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(model.nodes());
  for (const SpringBatch& batch : model.springs)
  {
    const double weight = stiffness_factor * batch.stiffness + damping_factor * batch.damping;
    for_each_spring(batch, [&](int i, int j) {
      sums[i] += weight;
      sums[j] += weight;
    });
  }
  return (sums / model.masses.array()).maxCoeff();
}

}  // namespace

void ImplicitStage::solve(const Dynamics& dynamics, double time, double s, const Vectors& base_positions,
                          const Vectors& base_velocities, Vectors& positions, Vectors& velocities, StepReport& report)
{
  const Equation equation{ dynamics, time, s, base_positions, base_velocities };
  const Eigen::VectorXd& masses = dynamics.model().masses;
  uses_multigrid_ =
      !dynamics.model().is_chain() && largest_springs_per_mass(dynamics.model(), s * s, s) > multigrid_from;
  dynamics.external_forces_on_all(time, velocities);
  dynamics.accelerations_of(velocities, velocities);
  velocities = base_velocities + s * velocities;
  find_residual(equation, positions, velocities, report);
  const double rounding = rounding_of(equation, positions, velocities);
  const double accepted = std::max(rounding, accepted_residual(equation, velocities));
  // One iteration at least: a guess within the bound must not put an end to slow motions.
  bool is_solved = largest_per_mass(residual_, masses) <= rounding;
  for (int i = 0; i < most_iterations && !is_solved; ++i)
  {
    const auto unlimited = Eigen::ArrayXd::Constant(masses.size(), std::numeric_limits<double>::infinity());
    linearise(equation, positions, unlimited);
    if (!find_direction(equation, report))
    {
      // What remains of M, a tenth of it, keeps the matrix definite.
      linearise(equation, positions, 0.9 * masses.array());
      find_direction(equation, report);
    }
    search_along(equation, positions, velocities, report);
    is_solved = largest_per_mass(residual_, masses) <= accepted;
  }
  report.converged = report.converged && is_solved;
}

void ImplicitStage::find_residual(const Equation& equation, Vectors& positions, Vectors& velocities, StepReport& report)
{
  const Dynamics& dynamics = equation.dynamics;
  dynamics.pins().impose_velocities(equation.time, velocities);
  positions = equation.base_positions + equation.s * velocities;
  dynamics.pins().impose(equation.time, positions, velocities);
  dynamics.forces(equation.time, positions, velocities, forces_);
  residual_ = (velocities - equation.base_velocities).array().colwise() * dynamics.model().masses.array();
  residual_ -= equation.s * forces_;
  dynamics.pins().clear_held(residual_);
  ++report.force_evaluations;
}

double ImplicitStage::accepted_residual(const Equation& equation, const Vectors& velocities) const
{
  const double largest_velocity = std::sqrt(velocities.rowwise().squaredNorm().maxCoeff());
  return residual_bound * (largest_velocity + largest_per_mass(residual_, equation.dynamics.model().masses));
}

/// What rounding of the springs' forces and of the velocities may leave of the residual, per mass.
double ImplicitStage::rounding_of(const Equation& equation, const Vectors& positions, const Vectors& velocities) const
{
  const double farthest = std::sqrt(positions.rowwise().squaredNorm().maxCoeff());
  const double fastest = std::sqrt(velocities.rowwise().squaredNorm().maxCoeff());
  return 4.0 * std::numeric_limits<double>::epsilon() *
         (fastest + equation.s * largest_springs_per_mass(equation.dynamics.model(), 1.0, 0.0) * farthest);
}

void ImplicitStage::linearise(const Equation& equation, const Vectors& positions, const Eigen::ArrayXd& capacities)
{
  const ClothModel& model = equation.dynamics.model();
  springs_.linearise(model, positions, equation.s * equation.s, equation.s, capacities);
  if (equation.dynamics.air().is_coupled(model))
  {
    node_normals(model, positions, normals_);
  }
  if (uses_multigrid_)
  {
    const AirProperties& air = equation.dynamics.air().properties();
    multigrid_.prepare(model, equation.dynamics.pins(),
                       model.masses.array() + equation.s * air.viscous_damping * model.areas.array(), springs_);
  }
}

void ImplicitStage::multiply(const Equation& equation, const Vectors& u, Vectors& product)
{
  const Dynamics& dynamics = equation.dynamics;
  product.setZero(u.rows(), 3);
  dynamics.air().add_damping_product(dynamics.model(), normals_, u, product);
  product *= equation.s;
  product.array() += u.array().colwise() * dynamics.model().masses.array();
  springs_.add_product(u, product);
  dynamics.pins().clear_held(product);
}

/// To a part of the residual that costs Newton's method hardly an iteration.
bool ImplicitStage::find_direction(const Equation& equation, StepReport& report)
{
  constexpr double part = 1e-3;
  const Eigen::VectorXd& masses = equation.dynamics.model().masses;
  const auto multiplied = [&](const Vectors& u, Vectors& product) { multiply(equation, u, product); };
  const auto by_multigrid = [&](const Vectors& r, Vectors& z) { multigrid_.apply(r, z); };
  const bool is_solved =
      uses_multigrid_ ?
          linear_solver_.solve(multiplied, by_multigrid, masses, residual_, part, direction_) :
          linear_solver_.solve(multiplied, MassPreconditioner(masses), masses, residual_, part, direction_);
  ++report.linear_solves;
  report.linear_iterations += linear_solver_.iterations();
  return is_solved;
}

/// Goes along the direction until the residual's component along it has fallen enough; it is a descent direction of the
/// residual's component as the matrix is positive definite.
void ImplicitStage::search_along(const Equation& equation, Vectors& positions, Vectors& velocities, StepReport& report)
{
  constexpr double enough = 0.8;
  constexpr int most_trials = 10;
  start_ = velocities;
  const double at_start = dot(direction_, residual_);
  double length = 1.0;
  for (int trial = 0; trial < most_trials; ++trial)
  {
    velocities = start_ + length * direction_;
    find_residual(equation, positions, velocities, report);
    const double here = dot(direction_, residual_);
    const bool has_overshot = !(here * at_start >= 0.0);
    if (!has_overshot || std::abs(here) <= enough * std::abs(at_start))
    {
      return;
    }
    // Where the component would be zero if it were linear in between.
    length *= std::isfinite(here) ? std::clamp(at_start / (at_start - here), 0.1, 0.9) : 0.1;
  }
}

}  // namespace cloth
