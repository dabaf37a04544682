// What a million steps do to the energy of undamped modes, for every method of the table.

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/methods/method.h"
#include "oscillator.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr int steps = 1000000;

class EnergyDrift : public testing::TestWithParam<MethodRow>
{
protected:
  /// The omega h at which the claimed drift adds up to half a percent of the energy; where none is claimed, a large
  /// one.
  static double telling_step()
  {
    const auto [factor, power] = GetParam().energy_drift;
    return factor == 0.0 ? 0.5 : std::pow(0.005 / steps / std::abs(factor), 1.0 / power);
  }

  /// Energies at the start and at the end, each the mean over some swings.
  template <typename StepAndMeasure>
  static void expect_claimed_drift(double z, StepAndMeasure&& energy_after_step)
  {
    const int swings = static_cast<int>(std::lround(20.0 * 2.0 * M_PI / z));
    const int window = std::min(swings, steps / 50);
    double early = 0.0;
    double late = 0.0;
    for (int s = 0; s < steps; ++s)
    {
      const double energy = energy_after_step();
      early += s < window ? energy / window : 0.0;
      late += s >= steps - window ? energy / window : 0.0;
    }
    const auto [factor, power] = GetParam().energy_drift;
    const double claimed = factor * std::pow(z, power) * (steps - window);
    if (factor == 0.0)
    {
      EXPECT_NEAR(late / early, 1.0, 1e-3);
    }
    else
    {
      EXPECT_NEAR(std::log(late / early), claimed, 0.03 * std::abs(claimed));
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, EnergyDrift, testing::ValuesIn(methods()), name_of_method);

TEST_P(EnergyDrift, OfTheOscillatorIsTheClaimedOne)
{
  const double frequency = 2.0;
  const double z = telling_step();
  MethodSettings settings = one_step_a_call(GetParam());
  settings.iterations = 1;
  Oscillator oscillator(GetParam().name, frequency, 0.0, 0.0, settings);
  oscillator.put(0.1, 0.0);
  expect_claimed_drift(z, [&]() {
    oscillator.step(z / frequency);
    return oscillator.energy(frequency);
  });
}

TEST_P(EnergyDrift, OfTheStiffestModeOfAChainIsTheClaimedOne)
{
  // Four masses between two hooks, swinging lengthwise, which is linear: omega = 2 sqrt(k/m) sin(4 pi/10).
  const double k = 80.0;
  const double m = 0.1;
  Dynamics dynamics(make_sheet(chain(6, k, m)), Eigen::Vector3d::Zero(), vacuum());
  const Vectors& rest = dynamics.model().rest_positions;
  dynamics.pins().hold(still_pin("hooks", { 0, 5 }, rest));
  ClothState state{ rest, Vectors::Zero(6, 3), 0.0 };
  for (int i = 1; i <= 4; ++i)
  {
    state.positions(i, 2) += 0.02 * std::sin(4 * i * M_PI / 5.0);
  }
  const double frequency = 2.0 * std::sqrt(k / m) * std::sin(0.4 * M_PI);
  const double z = telling_step();
  const std::unique_ptr<Method> method = make(GetParam());
  expect_claimed_drift(z, [&]() {
    method->step(dynamics, z / frequency, state);
    return 0.5 * m * state.velocities.squaredNorm() + elastic_energy(dynamics.model(), state.positions);
  });
}

}  // namespace
}  // namespace cloth
