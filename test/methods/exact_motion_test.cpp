// Motions with exact answers, for every method of the table.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/methods/method.h"
#include "oscillator.h"
#include "support.h"

namespace cloth
{
namespace
{

class EveryMethod : public testing::TestWithParam<MethodRow>
{
protected:
  /// As many steps as put this method into its asymptotic range where `steps` do for one of higher order.
  int steps_like(int steps) const
  {
    return GetParam().order == 1 ? 20 * steps : steps;
  }

  /// An error that halves `order` times when the step is halved: C h^order with C from the coarser of two steps.
  void expect_order(double coarse_error, double fine_error, double ratio_of_steps) const
  {
    const double order = std::log(coarse_error / fine_error) / std::log(ratio_of_steps);
    EXPECT_NEAR(order, GetParam().order, 0.1) << "errors " << coarse_error << " and " << fine_error;
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(methods()), name_of_method);

struct Motion
{
  double displacement;
  double velocity;
};

/// x(t) = e^(-zeta omega t) (cos omega_d t + B sin omega_d t): from x = 1, v = 0.
Motion damped_oscillation(double frequency, double ratio, double time)
{
  const double damped = frequency * std::sqrt(1.0 - ratio * ratio);
  const double decay = std::exp(-ratio * frequency * time);
  return { decay * (std::cos(damped * time) + ratio * frequency / damped * std::sin(damped * time)),
           -decay * frequency * frequency / damped * std::sin(damped * time) };
}

TEST_P(EveryMethod, FollowsTheDampedOscillator)
{
  const double frequency = 3.0;
  for (const auto& [air, spring] :
       { std::pair(0.0, 0.0), std::pair(0.1, 0.0), std::pair(0.0, 0.1), std::pair(0.2, 0.3) })
  {
    const double end = 2.0;
    std::vector<double> errors;
    for (const int steps : { steps_like(200), steps_like(400) })
    {
      Oscillator oscillator(GetParam().name, frequency, air, spring);
      oscillator.put(0.3, 0.0);
      for (int s = 0; s < steps; ++s)
      {
        oscillator.step(end / steps);
      }
      const Motion exact = damped_oscillation(frequency, air + spring, end);
      errors.push_back(std::hypot(frequency * (oscillator.displacement() - 0.3 * exact.displacement),
                                  oscillator.velocity() - 0.3 * exact.velocity));
    }
    SCOPED_TRACE(testing::Message() << "damping ratios " << air << " and " << spring);
    EXPECT_LT(errors[1], 4.0 * std::pow(frequency * end / steps_like(400), GetParam().order));
    expect_order(errors[0], errors[1], 2.0);
  }
}

/// The shape of longitudinal mode p of a chain of n free masses: both ends pinned, or the upper one alone.
struct ChainMode
{
  double frequency;
  std::vector<double> shape;
};

ChainMode fixed_fixed(int n, int p, double k, double m)
{
  const double angle = p * M_PI / (n + 1);
  ChainMode mode{ 2.0 * std::sqrt(k / m) * std::sin(0.5 * angle), {} };
  for (int i = 1; i <= n; ++i)
  {
    mode.shape.push_back(std::sin(i * angle));
  }
  return mode;
}

ChainMode fixed_free(int n, int p, double k, double m)
{
  const double angle = (2 * p - 1) * M_PI / (2 * n + 1);
  ChainMode mode{ 2.0 * std::sqrt(k / m) * std::sin(0.5 * angle), {} };
  for (int i = 1; i <= n; ++i)
  {
    mode.shape.push_back(std::sin(i * angle));
  }
  return mode;
}

/// The part of a mode in a chain's displacement along `axis` after `time`, started at `amplitude` and at rest.
double amplitude_after(const MethodRow& row, const ChainMode& mode, const ClothModel& model, const Vectors& rest,
                       bool is_lower_end_fixed, int axis, double amplitude, double time, int steps)
{
  Dynamics dynamics(model, Eigen::Vector3d::Zero(), vacuum());
  dynamics.pins().hold(still_pin("top", { 0 }, rest));
  if (is_lower_end_fixed)
  {
    dynamics.pins().hold(still_pin("bottom", { model.nodes() - 1 }, rest));
  }
  ClothState state{ rest, Vectors::Zero(model.nodes(), 3), 0.0 };
  for (size_t i = 0; i < mode.shape.size(); ++i)
  {
    state.positions(static_cast<int>(i) + 1, axis) += amplitude * mode.shape[i];
  }
  const std::unique_ptr<Method> method = make(row);
  for (int s = 0; s < steps; ++s)
  {
    method->step(dynamics, time / steps, state);
  }
  double projection = 0.0;
  double norm = 0.0;
  for (size_t i = 0; i < mode.shape.size(); ++i)
  {
    const int node = static_cast<int>(i) + 1;
    projection += mode.shape[i] * (state.positions(node, axis) - rest(node, axis));
    norm += mode.shape[i] * mode.shape[i];
  }
  return projection / norm;
}

TEST_P(EveryMethod, SwingsALongitudinalModeOfTheChainAtItsFrequency)
{
  const int n = 8;
  const double k = 50.0;
  const double m = 0.1;
  for (const bool both_ends : { true, false })
  {
    const ClothModel model = make_sheet(chain(n + (both_ends ? 2 : 1), k, m));
    for (const int p : { 1, 3, n })
    {
      const ChainMode mode = both_ends ? fixed_fixed(n, p, k, m) : fixed_free(n, p, k, m);
      const double time = 1.1 * 2.0 * M_PI / mode.frequency;
      const double amplitude = 0.03;
      std::vector<double> errors;
      for (const int steps : { steps_like(260), steps_like(520) })
      {
        const double measured =
            amplitude_after(GetParam(), mode, model, model.rest_positions, both_ends, 2, amplitude, time, steps);
        errors.push_back(std::abs(measured / amplitude - std::cos(mode.frequency * time)));
      }
      SCOPED_TRACE(testing::Message() << "mode " << p << (both_ends ? " of both ends fixed" : " of one end fixed"));
      expect_order(errors[0], errors[1], 2.0);
      EXPECT_LT(errors[1], 3.0 * std::pow(mode.frequency * time / steps_like(520), GetParam().order));
    }
  }
}

TEST_P(EveryMethod, SwingsATransverseModeUnderTensionAtItsFrequency)
{
  // Stretched to 1.5 times its length the chain of spacing a pulls with T = k (a - l0); across it T/a stands for k.
  const int n = 8;
  const double k = 50.0;
  const double m = 0.1;
  const ClothModel model = make_sheet(chain(n + 2, k, m));
  const Vectors stretched = 1.5 * model.rest_positions;
  const double spacing = 1.5 / (n + 1);
  const double tension = k * (spacing - 1.0 / (n + 1));
  const ChainMode mode = fixed_fixed(n, 2, tension / spacing, m);
  const double time = 1.2 * 2.0 * M_PI / mode.frequency;
  const double amplitude = 1e-6 * spacing;
  const int steps = 2000;
  const double measured = amplitude_after(GetParam(), mode, model, stretched, true, 0, amplitude, time, steps);
  EXPECT_NEAR(measured / amplitude, std::cos(mode.frequency * time),
              3.0 * std::pow(mode.frequency * time / steps, GetParam().order) + 1e-9);
}

TEST_P(EveryMethod, SwingsAMembraneAtItsFrequency)
{
  // Square cells, stretched evenly and clamped all round: with X = p pi/N, Y = q pi/N across it is
  // m omega^2 = 4 T/a (sin^2 X/2 + sin^2 Y/2) + 4 T_d/d (1 - cos X cos Y), T and T_d the tensions of the structural and
  // shear springs, a and d their lengths.
  const int cells = 6;
  const int p = 2;
  const int q = 1;
  SheetProperties sheet = small_sheet(cells + 1, cells + 1);
  sheet.width = sheet.height = 0.6;
  sheet.structural = { 80.0, 0.0 };
  sheet.shear = { 50.0, 0.0 };
  sheet.flex = { 0.0, 0.0 };
  sheet.mass_lumping = MassLumping::uniform;
  Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  const ClothModel& model = dynamics.model();
  const double stretch = 1.3;
  const Vectors stretched = stretch * model.rest_positions;
  const double spacing = stretch * 0.6 / cells;
  const double pull = (1.0 - 1.0 / stretch);  // T/(k a), and T_d/(k_d d) too
  const double x = p * M_PI / cells;
  const double y = q * M_PI / cells;
  const double stiffness = 4.0 * 80.0 * pull * (std::pow(std::sin(0.5 * x), 2) + std::pow(std::sin(0.5 * y), 2)) +
                           4.0 * 50.0 * pull * (1.0 - std::cos(x) * std::cos(y));
  const double frequency = std::sqrt(stiffness / model.masses[0]);

  ClothState state{ stretched, Vectors::Zero(model.nodes(), 3), 0.0 };
  std::vector<int> border;
  Eigen::VectorXd shape(model.nodes());
  for (int i = 0; i < model.nodes(); ++i)
  {
    const int row = model.row_of(i);
    const int col = model.col_of(i);
    shape[i] = std::sin(p * M_PI * col / cells) * std::sin(q * M_PI * row / cells);
    if (row % cells == 0 || col % cells == 0)
    {
      border.push_back(i);
    }
  }
  dynamics.pins().hold(still_pin("border", border, stretched));
  const double amplitude = 1e-6 * spacing;
  state.positions.col(1) += amplitude * shape;
  const double time = 1.1 * 2.0 * M_PI / frequency;
  const int steps = steps_like(2000);
  const std::unique_ptr<Method> method = make(GetParam());
  for (int s = 0; s < steps; ++s)
  {
    method->step(dynamics, time / steps, state);
  }
  const double measured = shape.dot(state.positions.col(1)) / shape.squaredNorm() / amplitude;
  EXPECT_NEAR(measured, std::cos(frequency * time), 5.0 * std::pow(frequency * time / steps, GetParam().order) + 1e-8);
}

TEST_P(EveryMethod, KeepsTheRotatingPairAtItsLength)
{
  // l = k l0/(k - m Omega^2/2)
  const double k = 100.0;
  const double m = 0.2;
  const double turns = 4.0;  // rad/s
  const double length = k / (k - 0.5 * m * turns * turns);
  const Dynamics dynamics(make_sheet(chain(2, k, m)), Eigen::Vector3d::Zero(), vacuum());
  ClothState state{ Vectors::Zero(2, 3), Vectors::Zero(2, 3), 0.0 };
  state.positions.col(0) << -0.5 * length, 0.5 * length;
  state.velocities.col(1) << -0.5 * length * turns, 0.5 * length * turns;
  const std::unique_ptr<Method> method = make(GetParam());
  const int steps = 4000;
  const double h = 2.0 * M_PI / turns / steps;
  double worst = 0.0;
  for (int s = 0; s < steps; ++s)
  {
    method->step(dynamics, h, state);
    worst = std::max(worst, std::abs((state.positions.row(1) - state.positions.row(0)).norm() - length));
  }
  EXPECT_LT(worst, 20.0 * std::pow(turns * h, GetParam().order) + 1e-12);
  // After a whole turn the pair is where it was.
  EXPECT_NEAR(state.positions(1, 0), 0.5 * length, 20.0 * std::pow(turns * h, GetParam().order) + 1e-10);
}

TEST_P(EveryMethod, FallsWithDragAsTheFormulaSays)
{
  // v = (m g/c)(1 - e^(-c t/m)), of a sheet that falls edge on: no normal meets the air.
  const double end = 0.8;
  SheetProperties sheet = small_sheet();
  const AirProperties air{ 0.9, 0.0, Eigen::Vector3d::Zero(), {} };
  const double rate = 0.9 * sheet.width * sheet.height / sheet.mass;
  const double exact = 9.81 / rate * (1.0 - std::exp(-rate * end));
  const Dynamics dynamics(make_sheet(sheet), { 0.0, 0.0, -9.81 }, air);
  std::vector<double> errors;
  for (const int steps : { steps_like(1600), steps_like(3200) })
  {
    ClothState state{ dynamics.model().rest_positions, Vectors::Zero(dynamics.model().nodes(), 3), 0.0 };
    const std::unique_ptr<Method> method = make(GetParam());
    for (int s = 0; s < steps; ++s)
    {
      method->step(dynamics, end / steps, state);
    }
    errors.push_back((-state.velocities.col(2).array() - exact).abs().maxCoeff());
  }
  EXPECT_LT(errors[1], 10.0 * std::pow(rate * end / steps_like(3200), GetParam().order) + 1e-12);
  if (GetParam().order < 4)
  {
    expect_order(errors[0], errors[1], 2.0);
  }
}

TEST_P(EveryMethod, FallsBroadsideAtItsTerminalSpeed)
{
  SheetProperties sheet = small_sheet();
  const AirProperties air{ 0.5, 1.5, Eigen::Vector3d::Zero(), {} };
  const Dynamics dynamics(make_sheet(sheet), { 0.0, 0.0, -9.81 }, air);
  ClothState state{ dynamics.model().rest_positions, Vectors::Zero(dynamics.model().nodes(), 3), 0.0 };
  state.positions.col(1).swap(state.positions.col(2));  // lies in the x-y plane
  const std::unique_ptr<Method> method = make(GetParam());
  const int steps = steps_like(4000);
  for (int s = 0; s < steps; ++s)
  {
    method->step(dynamics, 4.0 / steps, state);
  }
  const double terminal = sheet.mass * 9.81 / ((0.5 + 1.5) * sheet.width * sheet.height);
  EXPECT_LT((state.velocities.col(2).array() + terminal).abs().maxCoeff(), 1e-9 * terminal);
}

TEST_P(EveryMethod, IsBlownAlongItsNormalUntilItMovesWithTheAir)
{
  // Without gravity and viscous damping: v_n = u_n (1 - e^(-C_vi t/m)).
  SheetProperties sheet = small_sheet();
  const AirProperties air{ 0.0, 1.2, { 0.0, 3.0, 0.0 }, {} };
  const double rate = 1.2 * sheet.width * sheet.height / sheet.mass;
  const Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), air);
  ClothState state{ dynamics.model().rest_positions, Vectors::Zero(dynamics.model().nodes(), 3), 0.0 };
  const std::unique_ptr<Method> method = make(GetParam());
  const int steps = steps_like(500);
  const double end = 0.5;
  for (int s = 0; s < steps; ++s)
  {
    method->step(dynamics, end / steps, state);
  }
  const double exact = 3.0 * (1.0 - std::exp(-rate * end));
  EXPECT_LT((state.velocities.col(1).array() - exact).abs().maxCoeff(),
            3.0 * std::pow(rate * end / steps, GetParam().order) + 1e-12);
}

TEST(ImplicitMidpoint, SwingsTheOscillatorAtItsOwnExactFrequency)
{
  // tan(Omega h/2) = omega h/2
  const double frequency = 7.0;
  for (const double z : { 0.01, 0.5, 1.9, 20.0 })
  {
    const double h = z / frequency;
    const double numerical = 2.0 / h * std::atan(0.5 * z);
    Oscillator oscillator("implicit_midpoint", frequency, 0.0, 0.0);
    oscillator.put(0.01, 0.0);
    for (int s = 1; s <= 1000; ++s)
    {
      oscillator.step(h);
      EXPECT_NEAR(oscillator.displacement(), 0.01 * std::cos(numerical * s * h), 1e-12 * s) << "z = " << z;
    }
  }
}

TEST(VelocityVerlet, SwingsTheOscillatorAtItsOwnExactFrequency)
{
  // sin(Omega h/2) = omega h/2, so that x(t + h) - 2 cos(Omega h) x(t) + x(t - h) = 0 to rounding.
  const double frequency = 7.0;
  for (const double z : { 0.01, 0.5, 1.9 })
  {
    const double h = z / frequency;
    const double numerical = 2.0 / h * std::asin(0.5 * z);
    Oscillator oscillator("velocity_verlet", frequency, 0.0, 0.0);
    oscillator.put(0.3, 0.0);
    for (int s = 1; s <= 1000; ++s)
    {
      oscillator.step(h);
      EXPECT_NEAR(oscillator.displacement(), 0.3 * std::cos(numerical * s * h), 1e-12 * s) << "z = " << z;
    }
  }
}

}  // namespace
}  // namespace cloth
