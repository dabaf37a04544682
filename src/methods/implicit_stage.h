#pragma once

#include "cloth_sim/forces/spring_jacobian.h"
#include "cloth_sim/methods/method.h"
#include "conjugate_gradients.h"
#include "multigrid.h"

namespace cloth
{

/// What the implicit methods solve: for the free nodes
///
///   v = base_v + s a(t, x, v),   x = base_x + s v,
///
/// pinned nodes being where they are at the time t. By Newton's method: with r = M (v - base_v) - s f(t, x, v),
///
///   (M + s C + s^2 K) dv = -r,   K = -df/dx, C = -df/dv  (SpringJacobian, Air)
///
/// solved by conjugate gradients, preconditioned with M or, where springs outweigh it by far, by multigrid. Both keep
/// the momentum, the sum of M v, exactly as the first guess has it, which falls freely. Where they find that compressed
/// springs have made the matrix indefinite, the destabilising part of K is cut down to what the masses can carry, and
/// they begin again. A step that overshoots is shortened by the line search of Matthies and Strang, "The solution of
/// nonlinear finite element equations", 1979, which needs no energy, so that damping and wind may take part.
class ImplicitStage
{
public:
  /// Of the velocities that the equation leaves open, in parts of the largest velocity or change of velocity.
  static constexpr double residual_bound = 1e-9;

  /// Solves for v (m/s) and x (m), which overwrite `velocities` and `positions`. Adds the cost to `report`; not
  /// converged after `most_iterations`, the last iterate stands and the report says so.
  void solve(const Dynamics& dynamics, double time, double s, const Vectors& base_positions,
             const Vectors& base_velocities, Vectors& positions, Vectors& velocities, StepReport& report);

  /// f(t, x, v) at the last solution, held nodes too, N.
  const Vectors& forces() const
  {
    return forces_;
  }

private:
  static constexpr int most_iterations = 100;
  /// Of (s^2 k + s c) / m, summed over a node's springs: from there on multigrid takes less time than the 20
  /// iterations and more that it spares.
  static constexpr double multigrid_from = 50.0;

  struct Equation
  {
    const Dynamics& dynamics;
    double time;
    double s;
    const Vectors& base_positions;
    const Vectors& base_velocities;
  };

  void find_residual(const Equation& equation, Vectors& positions, Vectors& velocities, StepReport& report);
  double accepted_residual(const Equation& equation, const Vectors& velocities) const;
  double rounding_of(const Equation& equation, const Vectors& positions, const Vectors& velocities) const;
  void linearise(const Equation& equation, const Vectors& positions, const Eigen::ArrayXd& capacities);
  /// False: the matrix is not positive definite, and there is no direction.
  bool find_direction(const Equation& equation, StepReport& report);
  void multiply(const Equation& equation, const Vectors& u, Vectors& product);
  void search_along(const Equation& equation, Vectors& positions, Vectors& velocities, StepReport& report);

  SpringJacobian springs_;
  Vectors normals_;
  Vectors forces_;
  Vectors residual_;
  Vectors direction_;
  Vectors start_;
  bool uses_multigrid_ = false;
  Multigrid multigrid_;
  ConjugateGradients linear_solver_;
};

}  // namespace cloth
