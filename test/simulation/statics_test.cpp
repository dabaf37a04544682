// Cloth that has come to rest, against exact statics, for every method of the table.

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double g = 9.81;

class Statics : public testing::TestWithParam<MethodRow>
{
protected:
  /// How exactly lengths come out, m: xpbd leaves every spring a little of what the next one in order corrects.
  static double exactness()
  {
    return std::string(GetParam().name) == "xpbd" ? 2e-3 : 1e-6;
  }

  /// Lets a setup hang in strong drag until it rests.
  static Simulation settle(SimulationSetup setup, double viscous_damping, double time)
  {
    setup.gravity = { 0.0, 0.0, -g };
    setup.method_settings.tolerance = 1e-12;
    setup.air.viscous_damping = viscous_damping;
    // Near its limit a method hardly damps at all.
    setup.time_step = std::min(1.0 / 240.0, 0.5 * Simulation(setup).stability_limit());
    Simulation simulation(std::move(setup));
    simulation.advance_to(time);
    EXPECT_LT(simulation.state().velocities.cwiseAbs().maxCoeff(), 1e-9) << "has not come to rest";
    return simulation;
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Statics, testing::ValuesIn(methods()), name_of_method);

TEST_P(Statics, EachLinkOfAHangingChainIsStretchedByWhatHangsBelow)
{
  // T_i = (N - i + 1) m g, l_i = l0 + T_i/k; in all N l0 + m g N (N + 1)/2k.
  const int links = 10;
  const double k = 200.0;
  const double m = 0.05;
  SimulationSetup setup = springs_alone(chain(links + 1, k, m), GetParam().name, 0.0);
  setup.pins.push_back(still_pin("hook", { 0 }, setup.start.positions));
  const Simulation simulation = settle(setup, 2.0 * 2.0 * std::sqrt(k / m) / 10.0 * m / (0.01 / (links + 1)), 12.0);
  const double rest_length = 1.0 / links;
  for (int i = 1; i <= links; ++i)
  {
    const double length = (simulation.state().positions.row(i) - simulation.state().positions.row(i - 1)).norm();
    EXPECT_NEAR(length, rest_length + (links - i + 1) * m * g / k, exactness()) << "link " << i;
  }
  EXPECT_NEAR(-simulation.state().positions(links, 2), 1.0 + m * g * links * (links + 1) / (2.0 * k), exactness());
}

TEST_P(Statics, ASheetHungByItsTopRowIsThatChainColumnByColumn)
{
  SheetProperties sheet = small_sheet(7, 4);
  sheet.mass_lumping = MassLumping::uniform;
  sheet.shear.stiffness = 0.0;
  sheet.flex.stiffness = 0.0;
  SimulationSetup setup = springs_alone(sheet, GetParam().name, 0.0);
  setup.pins.push_back(still_pin("rail", { 0, 1, 2, 3 }, setup.start.positions));
  const Simulation simulation = settle(setup, 3.0, 6.0);
  const ClothModel& model = simulation.model();
  const double m = sheet.mass / model.nodes();
  const double k = sheet.structural.stiffness;
  for (int c = 0; c < 4; ++c)
  {
    for (int r = 1; r < 7; ++r)
    {
      const double length =
          (simulation.state().positions.row(model.node(r, c)) - simulation.state().positions.row(model.node(r - 1, c)))
              .norm();
      EXPECT_NEAR(length, sheet.height / 6 + (7 - r) * m * g / k, exactness());
    }
  }
}

/// The elastic catenary of links of equal nodes hung at both ends: the link force (H, V_i), V_i = V_0 - i m g, where
/// V_0 is half the hanging weight; l_i = l0 + T_i/k. H by bisection, so that sum l_i H/T_i is the span.
struct Catenary
{
  Catenary(int links, double k, double m, double rest_length, double span)
  {
    const auto link = [&](int i, double horizontal) {
      const double vertical = (0.5 * (links - 1) - i) * m * g;
      const double tension = std::hypot(horizontal, vertical);
      const double length = rest_length + tension / k;
      return Eigen::Vector2d(length * horizontal / tension, -length * vertical / tension);
    };
    double low = 1e-9;
    double high = 1e4;
    for (int iteration = 0; iteration < 200; ++iteration)
    {
      const double middle = std::sqrt(low * high);
      double width = 0.0;
      for (int i = 0; i < links; ++i)
      {
        width += link(i, middle).x();
      }
      (width < span ? low : high) = middle;
    }
    nodes.push_back(Eigen::Vector2d::Zero());
    for (int i = 0; i < links; ++i)
    {
      nodes.push_back(nodes.back() + link(i, low));
    }
  }

  std::vector<Eigen::Vector2d> nodes;  ///< from one end, x along the span and z up
};

TEST_P(Statics, AChainBetweenTwoHooksIsTheElasticCatenary)
{
  const int links = 12;
  const double k = 300.0;
  const double m = 0.02;
  const double span = 0.7;
  SheetProperties sheet = chain(links + 1, k, m);
  std::swap(sheet.rows, sheet.cols);
  std::swap(sheet.width, sheet.height);
  SimulationSetup setup = springs_alone(sheet, GetParam().name, 0.0);
  // A start that sags, so that no link is compressed into a zigzag.
  for (int i = 0; i <= links; ++i)
  {
    const double along = static_cast<double>(i) / links;
    setup.start.positions.row(i) << span * (along - 0.5), 0.0, -1.2 * along * (1.0 - along);
  }
  setup.pins.push_back(still_pin("hooks", { 0, links }, setup.start.positions));
  const Simulation simulation = settle(setup, 100.0, 25.0);
  const Catenary exact(links, k, m, 1.0 / links, span);
  for (int i = 0; i <= links; ++i)
  {
    EXPECT_NEAR(simulation.state().positions(i, 0), exact.nodes[static_cast<size_t>(i)].x() - 0.5 * span, exactness());
    EXPECT_NEAR(simulation.state().positions(i, 1), 0.0, 1e-9);
    EXPECT_NEAR(simulation.state().positions(i, 2), exact.nodes[static_cast<size_t>(i)].y(), exactness());
  }
}

TEST(SettledHangingSheet, ObeysTheStrainLimitAndWithoutItIsFarAboveNearThePins)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  Simulation limited = build_simulation(make_plan(scene));
  limited.advance_to(10.0);
  EXPECT_LE(max_strain(limited.model(), limited.state().positions), 0.1001);
  scene.strain_limit.max_strain = 0.0;
  Simulation unlimited = build_simulation(make_plan(scene));
  unlimited.advance_to(10.0);
  EXPECT_GT(max_strain(unlimited.model(), unlimited.state().positions), 0.2);
}

}  // namespace
}  // namespace cloth
