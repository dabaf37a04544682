#include "cloth_sim/constraints/pin_reach.h"

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/springs.h"
#include "support.h"

namespace cloth
{
namespace
{

/// Nodes 0.25 m apart across, 0.5 m down.
SheetProperties oblong()
{
  SheetProperties sheet = small_sheet(3, 5);
  sheet.width = 1.0;
  sheet.height = 1.0;
  return sheet;
}

PinReach reach_between(const ClothModel& model, int a, int b, double factor)
{
  const Vectors positions = factor * model.rest_positions;
  Pins pins(model.nodes());
  pins.hold(still_pin("a", { a }, positions));
  pins.hold(still_pin("b", { b }, positions));
  return reach_of(model, pins, positions);
}

TEST(PinReach, IsTheStrainOfTheStraightWayAlongARow)
{
  const ClothModel model = make_sheet(oblong());
  const PinReach reach = reach_between(model, 0, 4, 1.3);
  EXPECT_NEAR(reach.strain, 0.3, 1e-14);
  EXPECT_EQ(reach.first, "a");
  EXPECT_EQ(reach.second, "b");
}

TEST(PinReach, GoesDiagonallyAsFarAsItCan)
{
  const ClothModel model = make_sheet(oblong());
  const double way = 2.0 * std::hypot(0.25, 0.5) + 2.0 * 0.25;
  EXPECT_NEAR(reach_between(model, 0, 14, 1.2).strain, 1.2 * std::sqrt(2.0) / way - 1.0, 1e-14);
}

TEST(PinReach, GoesRoundCornersWithoutShearSprings)
{
  SheetProperties sheet = oblong();
  sheet.shear.stiffness = 0.0;
  EXPECT_NEAR(reach_between(make_sheet(sheet), 0, 14, 1.5).strain, 1.5 * std::sqrt(2.0) / 2.0 - 1.0, 1e-14);
}

TEST(PinReach, IsNoneWhereNoTwoPinsAreDrawnApart)
{
  const ClothModel model = make_sheet(oblong());
  EXPECT_EQ(reach_between(model, 0, 4, 0.9).strain, 0.0);
  EXPECT_EQ(reach_between(model, 0, 4, 0.9).first, "");
  Pins one(model.nodes());
  one.hold(still_pin("both", { 0, 4 }, 2.0 * model.rest_positions));
  EXPECT_EQ(reach_of(model, one, 2.0 * model.rest_positions).strain, 0.0);
}

TEST(PinReach, IsNoneWithoutStructuralSprings)
{
  SheetProperties sheet = oblong();
  sheet.structural.stiffness = 0.0;
  EXPECT_EQ(reach_between(make_sheet(sheet), 0, 4, 2.0).strain, 0.0);
}

/// Without this a limit that no shape can keep gives the sheet more speed in every step.
TEST(PinReach, TheStrainLimitGivesWayToIt)
{
  const ClothModel model = make_sheet(small_sheet(9, 9));
  ClothState state{ 1.3 * model.rest_positions, Vectors::Zero(model.nodes(), 3), 0.0 };
  Pins pins(model.nodes());
  pins.hold(still_pin("a", { 0 }, state.positions));
  pins.hold(still_pin("b", { 8 }, state.positions));
  StrainLimit limit(model, { 0.05, 1000 });
  const StrainLimit::Report report = limit.apply(model, pins, 0.01, state);
  EXPECT_TRUE(report.reached);
  EXPECT_NEAR(limit.reach().strain, 0.3, 1e-14);
  EXPECT_LE(max_strain(model, state.positions), 1.05 * 0.3 * (1.0 + StrainLimit::tolerance) + 1e-12);
}

}  // namespace
}  // namespace cloth
