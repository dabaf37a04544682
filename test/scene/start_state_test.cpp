#include "cloth_sim/scene/start_state.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using Row = Eigen::RowVector3d;

SheetProperties sheet_of(int rows, int cols)
{
  SheetProperties sheet;
  sheet.rows = rows;
  sheet.cols = cols;
  sheet.width = 2.0;
  sheet.height = 3.0;
  return sheet;
}

/// The nodes of the state that `start` gives, as a function of fractions across and down.
template <typename Expected>
void expect_positions(const StartParams& start, int rows, int cols, const Expected& expected)
{
  const ClothModel model = make_sheet(sheet_of(rows, cols));
  const ClothState state = start_state(start, model);
  EXPECT_EQ(state.time, 0.0);
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double a = cols > 1 ? model.col_of(i) / (cols - 1.0) : 0.0;
    const double b = rows > 1 ? model.row_of(i) / (rows - 1.0) : 0.0;
    EXPECT_LT((state.positions.row(i) - expected(a, b)).norm(), 1e-14) << "node " << i;
  }
}

TEST(StartState, HangsFlatFromTheMiddleOfItsTopEdgeAtRest)
{
  StartParams start;
  start.position = { 10.0, 20.0, 30.0 };
  expect_positions(start, 4, 5, [](double a, double b) { return Row(9.0 + 2.0 * a, 20.0, 30.0 - 3.0 * b); });
}

TEST(StartState, StretchesAcrossAndDownAboutTheMiddleOfTheTopEdge)
{
  StartParams start;
  start.initial_stretch = { 0.5, 1.5 };
  expect_positions(start, 4, 5, [](double a, double b) { return Row(-0.5 + a, 0.0, 1.5 - 4.5 * b); });
}

TEST(StartState, RipplesAlongTheNormalByItsFormula)
{
  const double pi = std::acos(-1.0);
  StartParams start;
  start.ripple = 0.25;
  start.initial_stretch = { 0.5, 1.0 };
  expect_positions(start, 7, 9, [pi](double a, double b) {
    const double ripple = 0.25 * (std::sin(2.0 * pi * a + 0.3) + 0.5 * std::sin(3.0 * pi * b + 1.1)) * b;
    return Row(-0.5 + a, ripple, 1.5 - 3.0 * b);
  });
}

TEST(StartState, RipplesAChainInsteadOfDividingByZero)
{
  const double pi = std::acos(-1.0);
  StartParams start;
  start.ripple = 0.25;
  expect_positions(start, 5, 1, [pi](double /*a*/, double b) {
    return Row(0.0, 0.25 * (std::sin(0.3) + 0.5 * std::sin(3.0 * pi * b + 1.1)) * b, 1.5 - 3.0 * b);
  });
  expect_positions(start, 1, 5, [](double a, double /*b*/) { return Row(-1.0 + 2.0 * a, 0.0, 1.5); });
}

TEST(StartState, TurnsAboutFixedXThenYThenZ)
{
  StartParams start;
  start.position.setZero();
  start.rpy = { 0.3, -0.7, 1.9 };
  const auto about = [](double angle, int axis) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    turn(next, next) = turn(last, last) = std::cos(angle);
    turn(last, next) = std::sin(angle);
    turn(next, last) = -std::sin(angle);
    return turn;
  };
  const Eigen::Matrix3d turn = about(1.9, 2) * about(-0.7, 1) * about(0.3, 0);
  expect_positions(start, 4, 5, [&](double a, double b) {
    return Row((turn * Eigen::Vector3d(-1.0 + 2.0 * a, 0.0, -3.0 * b)).transpose());
  });
}

TEST(StartState, LiesLevelWithItsRowsAlongYAtAQuarterOfRoll)
{
  StartParams start;
  start.position.setZero();
  start.rpy[0] = std::acos(0.0);
  expect_positions(start, 4, 5, [](double a, double b) { return Row(-1.0 + 2.0 * a, 3.0 * b, 0.0); });
}

TEST(StartState, GivesEveryNodeTheVelocity)
{
  StartParams start;
  start.velocity = { 1.0, -2.0, 3.0 };
  start.rpy = { 1.0, 1.0, 1.0 };
  const ClothState state = start_state(start, make_sheet(sheet_of(3, 3)));
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_EQ(state.velocities.row(i), Row(1.0, -2.0, 3.0)) << "as given, not turned with the sheet";
  }
}

}  // namespace
}  // namespace cloth
