#include <algorithm>
#include <cmath>
#include <limits>

#include "rows.h"
#include "runge_kutta.h"

namespace cloth
{
namespace
{

/// Dormand and Prince, "A family of embedded Runge-Kutta formulae", 1980: RK5(4)7M. The last stage is the step's end,
/// and so the first stage of the next step.
const Tableau& tableau()
{
  static const std::vector<double> weights{ 35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0,
                                            11.0 / 84.0,  0.0 };
  static const Tableau coefficients{ { 0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0 },
                                     { {},
                                       { 1.0 / 5.0 },
                                       { 3.0 / 40.0, 9.0 / 40.0 },
                                       { 44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0 },
                                       { 19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0 },
                                       { 9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0,
                                         -5103.0 / 18656.0 },
                                       std::vector<double>(weights.begin(), weights.end() - 1) },
                                     weights };
  return coefficients;
}

/// The weights of the step less those of the embedded formula of order 4.
const std::vector<double>& error_weights()
{
  static const std::vector<double> weights{ 71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                                            -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0 };
  return weights;
}

/// Steps as long as the error estimate allows: the greatest of |e_x| and h |e_v| over all nodes, in m, is held below
/// the tolerance. An infinite tolerance takes every step as it is given. The step follows Gustafsson's control with the
/// constants of Hairer, Norsett and Wanner, "Solving Ordinary Differential Equations I", II.4 and IV.2.
class DormandPrince5 : public Method
{
public:
  explicit DormandPrince5(double tolerance) : tolerance_(tolerance), stages_(tableau())
  {
  }

  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    StepReport report;
    double taken = within(h);
    double error = try_step(dynamics, taken, state, report);
    while (!(error <= 1.0) && taken > shortest_step)
    {
      ++report.rejected_steps;
      wanted_ = taken * std::clamp(safety * std::pow(error, -1.0 / 5.0), 0.2, 1.0);
      if (!std::isfinite(error))
      {
        wanted_ = 0.2 * taken;
      }
      taken = within(h);
      error = try_step(dynamics, taken, state, report);
    }
    report.converged = error <= 1.0;
    if (records())
    {
      stages_.add_impulses(dynamics, taken, impulses());
    }
    stages_.advance(dynamics, taken, state);
    stages_.keep_last_as_first();
    choose_next_step(taken, error, report.rejected_steps > 0);
    return report;
  }

  void restart() override
  {
    first_is_known_ = false;
  }

private:
  static constexpr double safety = 0.9;
  static constexpr double shortest_step = 1e-12;  // s

  /// The step to try where the caller allows h. Two like steps to the end are better than a long and a tiny one.
  double within(double h) const
  {
    return wanted_ >= h ? h : std::min(wanted_, 0.5 * h);
  }

  /// The error in parts of the tolerance.
  double try_step(const Dynamics& dynamics, double h, const ClothState& state, StepReport& report)
  {
    stages_.work_out(dynamics, h, state, first_is_known_);
    report.force_evaluations += stages_.count() - (first_is_known_ ? 1 : 0);
    first_is_known_ = true;
    error_in_positions_.setZero(state.positions.rows(), 3);
    error_in_velocities_.setZero(state.positions.rows(), 3);
    stages_.add_weighted(dynamics, h, error_weights(), error_in_positions_, error_in_velocities_);
    dynamics.pins().clear_held(error_in_velocities_);
    const double largest =
        std::max(error_in_positions_.rowwise().squaredNorm().maxCoeff<Eigen::PropagateNaN>(),
                 h * h * error_in_velocities_.rowwise().squaredNorm().maxCoeff<Eigen::PropagateNaN>());
    return std::sqrt(largest) / tolerance_;
  }

  void choose_next_step(double taken, double error, bool after_rejection)
  {
    constexpr double memory = 0.04;
    const double factor =
        safety * std::pow(std::max(error, 1e-10), 0.75 * memory - 1.0 / 5.0) * std::pow(last_error_, memory);
    const double next = taken * std::clamp(factor, 0.2, after_rejection ? 1.0 : 5.0);
    const bool was_cut_short = taken < wanted_;
    wanted_ = was_cut_short && next >= taken ? std::max(next, wanted_) : next;
    last_error_ = std::max(error, 1e-4);
  }

  double tolerance_;
  RungeKuttaStages stages_;
  Vectors error_in_positions_;
  Vectors error_in_velocities_;
  bool first_is_known_ = false;
  double wanted_ = std::numeric_limits<double>::infinity();
  double last_error_ = 1e-4;
};

double stability_limit(const Mode& mode)
{
  static const StabilityRegion region(tableau());
  return region.limit(mode);
}

}  // namespace

const MethodRow dopri5{ "dopri5",
                        5,
                        stability_limit,
                        { -1.0 / 1800.0, 6 },
                        false,
                        true,
                        false,
                        6,
                        0,
                        "beyond the limit of its steps it rejects one after the other: slow, but not wrong",
                        [](const MethodSettings& settings) -> std::unique_ptr<Method> {
                          return std::make_unique<DormandPrince5>(settings.tolerance);
                        } };

}  // namespace cloth
