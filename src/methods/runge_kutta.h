#pragma once

#include <vector>

#include "cloth_sim/methods/method.h"

namespace cloth
{

/// The coefficients of an explicit Runge-Kutta method (Butcher's tableau).
struct Tableau
{
  std::vector<double> times;                ///< c_i
  std::vector<std::vector<double>> stages;  ///< a_ij, j < i
  std::vector<double> weights;              ///< b_i
};

/// The stages of an explicit Runge-Kutta method for (x, v)' = (v, a(t, x, v)). Pins are imposed on every stage.
class RungeKuttaStages
{
public:
  explicit RungeKuttaStages(Tableau tableau);

  /// Works out all stages of a step of length h from `state`. True for `first_is_known`: the slopes of the first
  /// stage are already in place.
  void work_out(const Dynamics& dynamics, double h, const ClothState& state, bool first_is_known = false);

  /// Takes the step: x + h sum_i w_i v_i and v + h sum_i w_i a_i, at time t + h.
  void advance(const Dynamics& dynamics, double h, ClothState& state) const;

  /// Adds h sum_i w_i v_i and h sum_i w_i a_i for any weights.
  void add_weighted(const Dynamics& dynamics, double h, const std::vector<double>& weights, Vectors& positions,
                    Vectors& velocities) const;

  /// Adds h sum_i w_i f_i, N s, held nodes too.
  void add_impulses(const Dynamics& dynamics, double h, Vectors& impulses) const;

  /// Takes the slopes of the last stage for those of the first: of a tableau whose last stage is the step's end.
  void keep_last_as_first();

  int count() const
  {
    return static_cast<int>(tableau_.times.size());
  }

private:
  struct Slope
  {
    Vectors velocity;
    Vectors acceleration;  ///< of held nodes: the forces' alone; pins are imposed on all that it leads to
  };

  Tableau tableau_;
  std::vector<Slope> slopes_;
  Vectors stage_positions_;
};

/// The Runge-Kutta method of a tableau, at the step that it is given.
class RungeKutta : public Method
{
public:
  explicit RungeKutta(const Tableau& tableau);
  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override;

private:
  RungeKuttaStages stages_;
};

/// Where a tableau's method is stable. With mu an eigenvalue of a mode, a step multiplies its amplitude by |R(h mu)|,
/// R(z) = 1 + sum_k z^k b A^(k-1) 1.
class StabilityRegion
{
public:
  explicit StabilityRegion(const Tableau& tableau);

  /// The step where that first exceeds 1, s. 0: at once.
  double limit(const Mode& mode) const;

private:
  std::vector<double> polynomial_;  ///< R's coefficients
};

}  // namespace cloth
