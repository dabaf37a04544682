#include "cloth_sim/scene/scene_start.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/scene/catenary.h"
#include "cloth_sim/scene/catenary_start.h"
#include "cloth_sim/scene/pin_selection.h"
#include "scene/scene_text.h"
#include "support.h"

namespace cloth
{
namespace
{

SceneStart start_of(const SceneParams& scene)
{
  return scene_start(scene, make_sheet(scene.sheet));
}

std::string refusal_of(const std::string& yaml)
{
  try
  {
    start_of(scene_of(yaml));
    return {};
  }
  catch (const SceneError& error)
  {
    return error.what();
  }
}

/// The largest strain of the structural springs.
double structural_strain(ClothModel model, const Vectors& positions)
{
  model.springs.erase(std::remove_if(model.springs.begin(), model.springs.end(),
                                     [](const SpringBatch& batch) { return batch.kind != SpringKind::structural; }),
                      model.springs.end());
  return max_strain(model, positions);
}

/// A chain of 41 nodes across, 1 m long, held at its ends.
std::string chain_across(const std::string& more)
{
  return "{cloth: {start: catenary, rows: 1, cols: 41, width: 1, position: [0, 0, 0], " + more +
         "}, springs: {structural: {stiffness: 1000}}}";
}

void expect_hung_between_ends(const SceneParams& scene, const Eigen::Vector3d& down)
{
  const Vectors positions = start_of(scene).state.positions;
  const Vectors flat = start_state(scene.start, make_sheet(scene.sheet)).positions;
  const Catenary exact(flat.row(0).transpose(), flat.row(40).transpose(), 1.0, down);
  for (int i = 0; i <= 40; ++i)
  {
    EXPECT_LT((positions.row(i).transpose() - exact.at(i / 40.0)).norm(), 1e-12) << "node " << i;
  }
  EXPECT_EQ(positions.row(0), flat.row(0));
  EXPECT_EQ(positions.row(40), flat.row(40));
}

TEST(CatenaryStart, OfAChainIsTheInextensibleCatenary)
{
  const SceneParams scene = scene_of(chain_across("initial_stretch: [0.7, 1]"));
  expect_hung_between_ends(scene, -Eigen::Vector3d::UnitZ());
  // sinh(z)/z = length/span by bisection; the sag is a (cosh z - 1) with a = span/2z.
  double low = 1e-3;
  double high = 10.0;
  for (int halving = 0; halving < 100; ++halving)
  {
    const double z = 0.5 * (low + high);
    (std::sinh(z) / z < 1.0 / 0.7 ? low : high) = z;
  }
  const double sag = 0.7 / (2.0 * low) * (std::cosh(low) - 1.0);
  const Vectors positions = start_of(scene).state.positions;
  EXPECT_NEAR(positions.col(2).minCoeff(), -sag, 1e-12);
  EXPECT_NEAR(positions(20, 2), -sag, 1e-12) << "the lowest node is not that in the middle";
}

TEST(CatenaryStart, HangsBetweenPinsAtDifferentHeights)
{
  expect_hung_between_ends(scene_of(chain_across("initial_stretch: [0.8, 1], rpy: [0, 0.5, 0.3]")),
                           -Eigen::Vector3d::UnitZ());
}

TEST(CatenaryStart, HangsBetweenPinsPlumbBelowEachOther)
{
  expect_hung_between_ends(scene_of(chain_across("initial_stretch: [0.8, 1], rpy: [0, 1.5707963267948966, 0]")),
                           -Eigen::Vector3d::UnitZ());
}

TEST(CatenaryStart, HangsTheWayGravityPoints)
{
  SceneParams scene = scene_of(chain_across("initial_stretch: [0.7, 1]"));
  scene.gravity = { 1.0, 3.0, 0.5 };
  expect_hung_between_ends(scene, scene.gravity.normalized());
}

TEST(CatenaryStart, GivesTheVelocityOfTheScene)
{
  const SceneParams scene = scene_of(chain_across("initial_stretch: [0.7, 1], velocity: [1, 2, 3]"));
  EXPECT_EQ(start_of(scene).state.velocities.row(7), Eigen::RowVector3d(1, 2, 3));
}

TEST(CatenaryStart, RipplesFreeNodesAndLeavesPinsWhereTheFlatStartHasThem)
{
  // A level chain down the sheet, whose last node the flat start ripples, too. The normal points up.
  const SceneParams scene = scene_of(
      "{cloth: {start: catenary, rows: 41, cols: 1, height: 1, initial_stretch: [1, 0.8], ripple: 0.01, rpy: "
      "[1.5707963267948966, 0, 0]}, springs: {structural: {stiffness: 1000}}, strain_limit: {max_strain: 0}, pins: "
      "[{name: a, nodes: [[0, 0]]}, {name: b, nodes: [[-1, 0]]}]}");
  const ClothModel model = make_sheet(scene.sheet);
  const Vectors positions = start_of(scene).state.positions;
  const Vectors flat = start_state(scene.start, model).positions;
  const Eigen::VectorXd ripple = ripple_of(scene.start, model);
  EXPECT_EQ(positions.row(0), flat.row(0));
  EXPECT_EQ(positions.row(40), flat.row(40));
  EXPECT_GT(std::abs(flat(40, 2) - flat(0, 2)), 1e-3);
  const Catenary exact(flat.row(0).transpose(), flat.row(40).transpose(), 1.0, -Eigen::Vector3d::UnitZ());
  for (int i = 1; i < 40; ++i)
  {
    const Eigen::Vector3d rippled = exact.at(i / 40.0) + ripple[i] * Eigen::Vector3d::UnitZ();
    EXPECT_LT((positions.row(i).transpose() - rippled).norm(), 1e-12);
  }
}

/// The curves alone, before anything is relaxed.
Vectors hung(const SceneParams& scene, const std::vector<int>& pinned)
{
  const ClothModel model = make_sheet(scene.sheet);
  return hung_in_catenaries(scene.start, model, pinned, scene.gravity.normalized());
}

SceneParams level_sheet(int nodes, double stretch)
{
  SceneParams scene;
  scene.sheet.rows = nodes;
  scene.sheet.cols = nodes;
  scene.start.rpy[0] = std::acos(0.0);
  scene.start.initial_stretch = { stretch, stretch };
  return scene;
}

TEST(HungInCatenaries, SpansASheetBetweenItsFourCorners)
{
  const SceneParams scene = level_sheet(21, 0.9);
  const ClothModel model = make_sheet(scene.sheet);
  const std::vector<int> corners{ 0, 20, 420, 440 };
  const Vectors flat = start_state(scene.start, model).positions;
  const Vectors positions = hung(scene, corners);
  for (const int corner : corners)
  {
    EXPECT_EQ(positions.row(corner), flat.row(corner));
  }
  const Catenary edge(flat.row(0).transpose(), flat.row(20).transpose(), 1.0, -Eigen::Vector3d::UnitZ());
  const Catenary diagonal(flat.row(0).transpose(), flat.row(440).transpose(), std::sqrt(2.0),
                          -Eigen::Vector3d::UnitZ());
  for (int i = 0; i <= 20; ++i)
  {
    EXPECT_LT((positions.row(i).transpose() - edge.at(0.05 * i)).norm(), 1e-12);
    EXPECT_LT((positions.row(21 * i + i).transpose() - diagonal.at(0.05 * i * std::sqrt(2.0))).norm(), 1e-12);
  }
  EXPECT_LT(max_strain(model, positions), 0.1);
}

TEST(HungInCatenaries, KeepsTheHigherOfTwoCurves)
{
  // Of the pins on a line the curve between neighbours is above that between the outer ones.
  const SceneParams scene = scene_of(chain_across("initial_stretch: [0.7, 1]"));
  const Vectors positions = hung(scene, { 0, 20, 40 });
  const Vectors flat = start_state(scene.start, make_sheet(scene.sheet)).positions;
  const Catenary left(flat.row(0).transpose(), flat.row(20).transpose(), 0.5, -Eigen::Vector3d::UnitZ());
  for (int i = 0; i <= 20; ++i)
  {
    EXPECT_LT((positions.row(i).transpose() - left.at(0.025 * i)).norm(), 1e-12);
  }
}

TEST(HungInCatenaries, HangsWhatIsBetweenNoCurvesStraightDown)
{
  SceneParams scene;
  scene.sheet.rows = 9;
  scene.sheet.cols = 9;
  scene.start.initial_stretch[0] = 0.9;
  const Vectors positions = hung(scene, { 0, 8 });
  for (int i = 9; i < 81; ++i)
  {
    const Eigen::RowVector3d hanging = positions.row(i % 9) - Eigen::RowVector3d(0, 0, i / 9 / 8.0);
    EXPECT_LT((positions.row(i) - hanging).norm(), 1e-14);
  }
}

TEST(HungInCatenaries, LetsManyPinsOfOneEdgeHangTheSheetBelowThem)
{
  SceneParams scene;
  scene.start.initial_stretch[0] = 0.8;
  std::vector<int> edge(32);
  for (int i = 0; i < 32; ++i)
  {
    edge[static_cast<size_t>(i)] = i;
  }
  const Vectors positions = hung(scene, edge);
  const Vectors flat = start_state(scene.start, make_sheet(scene.sheet)).positions;
  EXPECT_LT((positions - flat).cwiseAbs().maxCoeff(), 1e-14) << "no curve has a node to itself";
}

TEST(HungInCatenaries, SagsWithinABorderInTheShortestWayAcross)
{
  const SceneParams scene = level_sheet(32, 0.9);
  const std::vector<int> border = nodes_of({ "frame", "border", {}, {} }, make_sheet(scene.sheet), "pins[0]");
  ASSERT_EQ(border.size(), 124u);
  const Vectors positions = hung(scene, border);
  const Catenary across({ 0, 0, 0 }, { 0.9, 0, 0 }, 1.0, -Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(positions(0, 2) - positions.col(2).minCoeff(), -across.at(0.5).z(), 1e-3);
}

TEST(CatenaryStart, RelaxesWhereCurvesLeaveSpringsOverstretched)
{
  SceneParams scene = level_sheet(32, 0.9);
  scene.start.shape = "catenary";
  scene.pins = { { "frame", "border", {}, {} } };
  const ClothModel model = make_sheet(scene.sheet);
  const std::vector<int> border = nodes_of(scene.pins[0], model, "pins[0]");
  EXPECT_GT(max_strain(model, hung(scene, border)), 0.2) << "nothing to relax";
  for (const double limit : { 0.0, 0.1 })
  {
    scene.strain_limit.max_strain = limit;
    const Vectors positions = start_of(scene).state.positions;
    EXPECT_LT(max_strain(model, positions), 0.1001);
    EXPECT_EQ(positions(border, Eigen::all), start_state(scene.start, model).positions(border, Eigen::all));
  }
}

class ScenesThatHang : public testing::TestWithParam<std::string>
{
};

INSTANTIATE_TEST_SUITE_P(Each, ScenesThatHang, testing::Values("hanging_sheet", "curtain", "hammock"));

TEST_P(ScenesThatHang, StartWithinTheStrainLimitWithTheirPinsInPlace)
{
  SceneParams scene = shipped_scene(GetParam());
  scene.start.shape = "catenary";
  const ClothModel model = make_sheet(scene.sheet);
  const Vectors positions = start_of(scene).state.positions;
  const Vectors flat = start_state(scene.start, model).positions;
  for (const Pin& pin : pins_of(scene.pins, model, flat))
  {
    for (const int node : pin.nodes)
    {
      EXPECT_EQ(positions.row(node), flat.row(node));
    }
  }
  EXPECT_LT(max_strain(model, positions), 0.11);
  EXPECT_LT((positions - flat).col(2).minCoeff(), -0.01) << "nothing sags";
  EXPECT_TRUE(positions.allFinite());
}

TEST_P(ScenesThatHang, StartOverstretchedNowhereWithoutTheLimitEither)
{
  SceneParams scene = shipped_scene(GetParam());
  scene.start.shape = "catenary";
  scene.strain_limit.max_strain = 0.0;
  const ClothModel model = make_sheet(scene.sheet);
  EXPECT_LT(structural_strain(model, start_of(scene).state.positions), 0.25) << "0.213 is the strain at rest";
}

TEST(SceneStart, IsRefusedWithTheReasonAndTheCure)
{
  EXPECT_TRUE(has(refusal_of("{cloth: {start: catenary, initial_stretch: [0.9, 1]}, gravity: [0, 0, 0]}"),
                  { "cloth.start is catenary, but gravity is 0, ", "set gravity, or take cloth.start: flat" }));
  EXPECT_TRUE(has(refusal_of("{cloth: {start: catenary}}"),
                  { "cloth.start is catenary, but no two of the 2 pinned nodes have slack between them; ",
                    "cloth.initial_stretch below 1" }));
  EXPECT_TRUE(has(refusal_of("{cloth: {start: catenary}, pins: [{name: a, at: top_left}]}"),
                  { "a curve needs two pinned nodes, and the scene has 1; add pins" }));
  EXPECT_TRUE(has(refusal_of("{cloth: {start: catenary}, pins: []}"), { "the scene has 0; add pins" }));
  EXPECT_TRUE(has(refusal_of("{cloth: {start: settled}, pins: []}"),
                  { "cloth.start is settled, but the sheet has no pins and falls for ever; add pins" }));
  EXPECT_TRUE(has(refusal_of("{cloth: {start: settled}, springs: {structural: {stiffness: 0}, shear: {stiffness: 0}}}"),
                  { "no springs join some nodes to a pin, and they fall for ever; add springs" }));
}

TEST(SceneStart, ThatDoesNotConvergeIsRefusedWithNumbers)
{
  // Pins farther apart than the limit lets the sheet be.
  const std::string refusal = refusal_of(
      "{cloth: {rows: 3, cols: 3, start: settled, initial_stretch: [1.5, 1]}, strain_limit: {max_strain: "
      "0.1}}");
  EXPECT_TRUE(has(refusal, { "cloth.start is settled, but no rest was found in ", " iterations: the largest net force ",
                             " of the weight, allowed is 1e-08; some spring is strained by 0.",
                             " more than strain_limit.max_strain; raise it" }));
}

TEST(SceneStart, SaysHowItWasMade)
{
  EXPECT_EQ(start_of(scene_of("{}")).description, "flat");
  EXPECT_EQ(start_of(scene_of("{cloth: {start: catenary, rows: 4, cols: 4, initial_stretch: [0.9, 1]}}")).description,
            "catenary, between 2 pinned nodes, relaxed");
  EXPECT_EQ(start_of(scene_of(chain_across("initial_stretch: [0.9, 1]"))).description,
            "catenary, between 2 pinned nodes");
  const std::string small = "{cloth: {start: settled, rows: 4, cols: 4, initial_stretch: [";
  EXPECT_TRUE(
      has(start_of(scene_of(small + "0.9, 1]}}")).description,
          { "settled, from catenary in ", " iterations; the largest net force on a node is ", " of the weight" }));
  EXPECT_TRUE(has(start_of(scene_of(small + "1, 1]}}")).description, { "settled, from flat in " }));
  EXPECT_TRUE(has(start_of(scene_of(small + "1, 1]}, gravity: [0, 0, 0], pins: []}")).description,
                  { "settled, from flat in 0 iterations; ", " of the largest k l0" }));
}

/// The time after which the kinetic energy stays below 1e-4 J, within 6 s.
double time_to_rest(const std::string& shape)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = 12;
  scene.sheet.cols = 12;
  scene.strain_limit.max_strain = 0.0;
  scene.start.shape = shape;
  Simulation simulation = build_simulation(make_plan(scene));
  double last = 0.0;
  for (double time = 0.02; time < 6.0; time += 0.02)
  {
    simulation.advance_to(time);
    last = energies_of(simulation.dynamics(), simulation.state()).kinetic > 1e-4 ? time : last;
  }
  return last;
}

TEST(SceneStart, ShortensTheTimeToRest)
{
  const double flat = time_to_rest("flat");
  const double catenary = time_to_rest("catenary");
  EXPECT_GT(flat, 0.5);
  EXPECT_LT(flat, 5.0) << "has not come to rest";
  EXPECT_LT(catenary, 0.9 * flat);
  EXPECT_EQ(time_to_rest("settled"), 0.0);
}

}  // namespace
}  // namespace cloth
