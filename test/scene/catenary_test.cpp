#include "cloth_sim/scene/catenary.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cloth
{
namespace
{

const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();

/// The length of a polygon with its corners on the curve: below the curve's by a part of 1/pieces^2.
double measured_length(const Catenary& curve, double length)
{
  constexpr int pieces = 2000;
  double sum = 0.0;
  for (int p = 0; p < pieces; ++p)
  {
    sum += (curve.at(length * (p + 1) / pieces) - curve.at(length * p / pieces)).norm();
  }
  return sum;
}

struct Hung
{
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  double length;
  Eigen::Vector3d down;
};

class HungCurve : public testing::TestWithParam<Hung>
{
};

INSTANTIATE_TEST_SUITE_P(
    Ends, HungCurve,
    testing::Values(Hung{ { 0, 0, 0 }, { 1, 0, 0 }, 1.2, down }, Hung{ { 0, 0, 0 }, { 1, 0, 0 }, 1.0 + 1e-6, down },
                    Hung{ { 0, 0, 0 }, { 1, 0, 0 }, 40.0, down }, Hung{ { 1, 2, 3 }, { 0.5, 2.5, 3.4 }, 1.5, down },
                    Hung{ { 1, 2, 3 }, { 0.5, 2.5, 2.4 }, 0.98, down },
                    Hung{ { 0, 0, 0 }, { 0.2, 0.5, 0.3 }, 0.9, Eigen::Vector3d(1, -2, 0.5).normalized() }));

TEST_P(HungCurve, GoesThroughBothEndsAtItsLength)
{
  const Hung& hung = GetParam();
  const Catenary curve(hung.start, hung.end, hung.length, hung.down);
  EXPECT_LT((curve.at(0.0) - hung.start).norm(), 1e-12);
  EXPECT_LT((curve.at(hung.length) - hung.end).norm(), 1e-10 * hung.length);
  EXPECT_NEAR(measured_length(curve, hung.length), hung.length, 1e-4 * hung.length);
}

TEST_P(HungCurve, CarriesTheWeightBetweenAnyTwoOfItsPoints)
{
  // The tension's part across gravity is the same everywhere; along gravity it grows with the weight between: the
  // slope is linear in the arc length.
  const Hung& hung = GetParam();
  const Catenary curve(hung.start, hung.end, hung.length, hung.down);
  const auto slope = [&](double arc) {
    const double h = 1e-5 * hung.length;
    const Eigen::Vector3d tangent = curve.at(arc + h) - curve.at(arc - h);
    const double along = tangent.dot(hung.down);
    return along / (tangent - along * hung.down).norm();
  };
  const double first = slope(0.1 * hung.length);
  const double middle = slope(0.35 * hung.length);
  const double last = slope(0.6 * hung.length);
  EXPECT_LT(last, first) << "does not sag";
  EXPECT_NEAR(middle, 0.5 * (first + last), 1e-4 * (std::abs(first) + std::abs(last)));
}

TEST_P(HungCurve, StaysInThePlaneOfGravityAndItsEnds)
{
  const Hung& hung = GetParam();
  const Catenary curve(hung.start, hung.end, hung.length, hung.down);
  const Eigen::Vector3d normal = (hung.end - hung.start).cross(hung.down).normalized();
  for (int i = 0; i <= 10; ++i)
  {
    EXPECT_NEAR((curve.at(0.1 * i * hung.length) - hung.start).dot(normal), 0.0, 1e-12);
  }
}

TEST(Catenary, OfLevelEndsHasItsLowestPointInTheMiddleAtTheKnownSag)
{
  // Of a = 0.5 and half a span of 0.6: length 2 a sinh 1.2, sag a (cosh 1.2 - 1).
  const double length = 2.0 * 0.5 * std::sinh(1.2);
  const Catenary curve({ -0.6, 0, 2 }, { 0.6, 0, 2 }, length, down);
  EXPECT_LT((curve.at(0.5 * length) - Eigen::Vector3d(0, 0, 2.0 - 0.5 * (std::cosh(1.2) - 1.0))).norm(), 1e-13);
  for (int i = 0; i <= 20; ++i)
  {
    const Eigen::Vector3d point = curve.at(0.05 * i * length);
    EXPECT_NEAR(point.z(), 2.0 - 0.5 * (std::cosh(1.2) - std::cosh(point.x() / 0.5)), 1e-13);
  }
}

TEST(Catenary, BetweenPlumbEndsGoesDownAndUpAgain)
{
  const Catenary curve({ 1, 1, 2 }, { 1, 1, 1.4 }, 1.0, down);
  EXPECT_LT((curve.at(0.0) - Eigen::Vector3d(1, 1, 2)).norm(), 1e-15);
  EXPECT_LT((curve.at(0.4) - Eigen::Vector3d(1, 1, 1.6)).norm(), 1e-15);
  EXPECT_LT((curve.at(0.8) - Eigen::Vector3d(1, 1, 1.2)).norm(), 1e-15) << "the lowest point";
  EXPECT_LT((curve.at(1.0) - Eigen::Vector3d(1, 1, 1.4)).norm(), 1e-15);
}

TEST(Catenary, NearlyPlumbEndsLeadToTheSameFold)
{
  const Catenary folded({ 0, 0, 0 }, { 0, 0, 0.2 }, 1.0, down);
  const Catenary nearly({ 0, 0, 0 }, { 1e-7, 0, 0.2 }, 1.0, down);
  for (int i = 0; i <= 10; ++i)
  {
    EXPECT_LT((folded.at(0.1 * i) - nearly.at(0.1 * i)).norm(), 1e-6);
  }
}

TEST(Catenary, WithoutSlackIsTheStraightLineEvenlyStretched)
{
  const Catenary curve({ 0, 0, 0 }, { 2, 0, 1 }, 2.0, down);
  EXPECT_LT((curve.at(0.5) - Eigen::Vector3d(0.5, 0, 0.25)).norm(), 1e-15);
  EXPECT_LT((curve.at(2.0) - Eigen::Vector3d(2, 0, 1)).norm(), 1e-15);
}

}  // namespace
}  // namespace cloth
