#include "cloth_sim/forces/gusts.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "cloth_sim/forces/air.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double strength = 2.0;
constexpr double time_scale = 0.5;

/// Means over a time that is long for the slowest wave and for the slowest beat of two.
class GustStatistics : public testing::TestWithParam<int>
{
protected:
  /// The mean of gust times gust `later` (s), componentwise, the second one's directions moved on by `shift`.
  Eigen::Array3d agreement(double later, int shift = 0) const
  {
    return mean([&](double time) -> Eigen::Array3d {
      const Eigen::Vector3d gust = gusts_.at(time + later);
      return gusts_.at(time).array() * Eigen::Array3d(gust[shift], gust[(shift + 1) % 3], gust[(shift + 2) % 3]);
    });
  }

  template <typename Value>
  static Eigen::Array3d mean(const Value& value)
  {
    constexpr int samples = 60000;
    constexpr double interval = 0.0437;
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int k = 0; k < samples; ++k)
    {
      sum += value(k * interval);
    }
    return sum / samples;
  }

  const Gusts gusts_{ { strength, time_scale, GetParam() } };
};

INSTANTIATE_TEST_SUITE_P(Seeds, GustStatistics, testing::Values(0, 1, 77, 2147483647));

TEST_P(GustStatistics, MeanIsNoneAndEachComponentHasTheStrength)
{
  const Eigen::Array3d means = mean([&](double time) -> Eigen::Array3d { return gusts_.at(time).array(); });
  EXPECT_LT(means.abs().maxCoeff(), 0.02 * strength) << means.transpose();
  const Eigen::Array3d squares = agreement(0.0);
  EXPECT_LT((squares / (strength * strength) - 1.0).abs().maxCoeff(), 0.02) << squares.transpose();
}

TEST_P(GustStatistics, ComponentsAreIndependent)
{
  const Eigen::Array3d products = agreement(0.0, 1);
  EXPECT_LT(products.abs().maxCoeff(), 0.02 * strength * strength) << products.transpose();
}

TEST_P(GustStatistics, ForgetThemselvesInTheTimeScale)
{
  for (const double later : { 0.1, 0.25, 0.5, 1.0 })
  {
    const Eigen::Array3d agreements = agreement(later) / (strength * strength);
    // 16 waves stand for a spectrum, whose last seventeenth they leave out.
    EXPECT_LT((agreements - std::exp(-later / time_scale)).abs().maxCoeff(), 0.15)
        << agreements.transpose() << ", " << later << " s later";
  }
}

TEST_P(GustStatistics, NothingChangesFasterThanTheFastestWave)
{
  const double fastest = 2.0 * (Gusts::waves + 1) / (M_PI * time_scale);
  constexpr double dt = 1e-4;
  for (int k = 0; k < 20000; ++k)
  {
    const Eigen::Vector3d change = gusts_.at((k + 1) * dt) - gusts_.at(k * dt);
    EXPECT_LT(change.norm(), fastest * gusts_.top_speed() * dt);
    EXPECT_LT(gusts_.at(k * dt).norm(), gusts_.top_speed());
  }
}

TEST(Gusts, AreTheSameForTheSameSeedAndOthersForAnother)
{
  const GustProperties properties{ strength, time_scale, 5 };
  const Gusts gusts(properties);
  const Gusts again(properties);
  const Gusts other({ strength, time_scale, 6 });
  for (const double time : { 0.0, 0.1, 12.3, 4567.8 })
  {
    EXPECT_EQ(gusts.at(time), again.at(time));
    EXPECT_GT((gusts.at(time) - other.at(time)).norm(), 0.1);
  }
}

TEST(Gusts, AreTheSumOfWavesThatTheSeedDraws)
{
  std::mt19937 generator(5489);
  double expected = 0.0;
  for (int k = 0; k < Gusts::waves; ++k)
  {
    const double u = (k % 3 + 0.25 + 0.5 * (generator() / 4294967296.0)) / 3.0;
    const double frequency = std::tan(0.5 * M_PI * (k + u) / (Gusts::waves + 1)) / time_scale;
    const double phase = 2.0 * M_PI * (generator() / 4294967296.0);
    expected += strength * std::sqrt(2.0 / Gusts::waves) * std::sin(frequency * 0.3 + phase);
  }
  EXPECT_NEAR(Gusts({ strength, time_scale, 5489 }).at(0.3).x(), expected, 1e-12);
}

TEST(Gusts, OfNoStrengthAreStillAir)
{
  EXPECT_TRUE(Gusts({ 0.0, time_scale, 5 }).at(1.2).isZero(0.0));
  EXPECT_EQ(Gusts({ 0.0, time_scale, 5 }).top_speed(), 0.0);
}

TEST(Gusts, AddToTheWindAtTheTimeThatIsAskedFor)
{
  AirProperties properties{ 0.4, 1.7, { 1.0, 2.0, -0.5 }, { strength, time_scale, 5 } };
  const Air air(properties);
  const Gusts gusts(properties.gusts);
  const ClothModel model = make_sheet(small_sheet());
  Noise noise;
  const Vectors positions = model.rest_positions + 0.02 * noise.vectors(model.nodes());
  const Vectors velocities = noise.vectors(model.nodes());
  for (const double time : { 0.0, 0.7 })
  {
    AirProperties steady{ 0.4, 1.7, properties.wind + gusts.at(time), {} };
    Vectors forces = Vectors::Zero(model.nodes(), 3);
    Vectors expected = forces;
    air.add_forces(model, time, positions, velocities, forces);
    Air(steady).add_forces(model, 0.0, positions, velocities, expected);
    EXPECT_EQ(forces, expected);
    Vectors damped = velocities;
    Vectors expected_damped = velocities;
    air.damp_implicitly(model, time, positions, 0.1, damped);
    Air(steady).damp_implicitly(model, 0.0, positions, 0.1, expected_damped);
    EXPECT_EQ(damped, expected_damped);
  }
}

}  // namespace
}  // namespace cloth
