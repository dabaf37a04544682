// The claimed stability limits from both sides, for every method of the table.

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/methods/method.h"
#include "cloth_sim/methods/spectrum.h"
#include "oscillator.h"
#include "support.h"

namespace cloth
{
namespace
{

class Stability : public testing::TestWithParam<MethodRow>
{
};

INSTANTIATE_TEST_SUITE_P(Methods, Stability, testing::ValuesIn(methods()), name_of_method);

/// The amplitude after at most `steps` steps of h from 1 at rest; returns early once it has grown a thousandfold.
double amplitude_after(const MethodRow& row, double air_ratio, double spring_ratio, double h, int steps)
{
  Oscillator oscillator(row.name, 1.0, air_ratio, spring_ratio);
  // Displacements are far below the spring's length, so that it never turns over.
  const double unit = 1e-6;
  oscillator.put(unit, 0.0);
  double amplitude = 0.0;
  for (int s = 0; s < steps && amplitude < 1000.0; ++s)
  {
    oscillator.step(h);
    amplitude = std::sqrt(2.0 * oscillator.energy(1.0)) / unit;
  }
  return amplitude;
}

TEST_P(Stability, OfTheOscillatorEndsAtTheLimit)
{
  for (const double ratio : { 0.0, 0.05, 0.5, 1.0, 2.0 })
  {
    for (const bool in_the_air : { true, false })
    {
      const double air_ratio = in_the_air ? ratio : 0.0;
      const double spring_ratio = in_the_air ? 0.0 : ratio;
      const double limit = GetParam().stability_limit({ 1.0, 2.0 * air_ratio, 2.0 * spring_ratio });
      SCOPED_TRACE(testing::Message() << "damping ratio " << ratio << (in_the_air ? " of the air" : " of the spring")
                                      << ", limit " << limit);
      // Near -1 a stable step still swings several times as high as it started.
      EXPECT_LT(amplitude_after(GetParam(), air_ratio, spring_ratio, 0.98 * limit, 100000), 30.0);
      EXPECT_GT(amplitude_after(GetParam(), air_ratio, spring_ratio, 1.02 * limit, 100000), 1000.0);
    }
  }
}

TEST_P(Stability, LimitsAreThoseOfTheLiterature)
{
  const std::string name = GetParam().name;
  const auto limit = [&](double air_ratio, double spring_ratio) {
    return GetParam().stability_limit({ 1.0, 2.0 * air_ratio, 2.0 * spring_ratio });
  };
  if (name == "symplectic_euler")
  {
    EXPECT_DOUBLE_EQ(limit(0.0, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(limit(0.5, 0.0), std::sqrt(5.0) - 1.0);
    EXPECT_DOUBLE_EQ(limit(0.2, 0.3), limit(0.5, 0.0));
  }
  if (name == "velocity_verlet")
  {
    EXPECT_DOUBLE_EQ(limit(0.0, 0.0), 2.0);
    EXPECT_DOUBLE_EQ(limit(3.0, 0.0), 2.0);
    EXPECT_NEAR(limit(0.0, 0.05), 1.81, 0.005);
    EXPECT_NEAR(limit(0.0, 0.5), 0.83, 0.005);
    EXPECT_NEAR(limit(0.0, 1.0), 0.47, 0.005);
  }
  if (name == "rk4")
  {
    EXPECT_NEAR(limit(0.0, 0.0), 2.0 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(limit(0.0, 0.05), 2.91, 0.005);
    EXPECT_NEAR(limit(0.0, 1.0), 2.79, 0.006);
    EXPECT_NEAR(limit(0.0, 2.0), 0.75, 0.005);
  }
}

TEST_P(Stability, OfANetworkIsTheLeastOfItsModes)
{
  const Mode stiffest{ 1.0, 0.1, 2.0 };
  const double network = network_stability_limit(GetParam(), stiffest);
  for (const double part : { 0.0, 0.3, 0.54, 1.0 })
  {
    EXPECT_LE(network, 1.0001 * GetParam().stability_limit({ 1.0, 0.1, 2.0 * part }));
  }
  EXPECT_TRUE(std::isinf(network_stability_limit(GetParam(), { 0.0, 0.0, 0.0 })));
}

TEST_P(Stability, OfASheetEndsNearItsClaimedLimit)
{
  Dynamics dynamics(make_sheet(small_sheet()), Eigen::Vector3d::Zero(), vacuum());
  Noise noise;
  const Vectors& rest = dynamics.model().rest_positions;
  dynamics.pins().hold(still_pin("corner", { 0 }, rest));
  const double limit = network_stability_limit(GetParam(), stiffest_mode(dynamics, rest));
  const auto grows = [&](double h) {
    ClothState state{ rest + 1e-9 * noise.vectors(dynamics.model().nodes()), Vectors::Zero(dynamics.model().nodes(), 3),
                      0.0 };
    const std::unique_ptr<Method> method = GetParam().make();
    for (int s = 0; s < 20000; ++s)
    {
      method->step(dynamics, h, state);
      if ((state.positions - rest).norm() > 1e-6)
      {
        return true;
      }
    }
    return false;
  };
  EXPECT_FALSE(grows(limit));
  EXPECT_TRUE(grows(1.12 * limit));
}

}  // namespace
}  // namespace cloth
