// Plans are held against what they promise: motions of the whole model at a tolerance that leaves no doubt.

#include "planner.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/scene/scene_reader.h"

#include "grid_report.h"
#include "scene/scene_text.h"
#include "support.h"
#include "trials.h"

namespace cloth
{
namespace
{

constexpr double any_number = 1e12;

StartedScene started(const std::string& yaml)
{
  const SceneParams params = scene_of(yaml);
  return { params, scene_start(params, make_sheet(params.sheet)) };
}

/// Non-chaotic, so that there is a motion to be wrong about.
std::string damped_sheet(int nodes, const std::string& further)
{
  const std::string count = std::to_string(nodes);
  return "{cloth: {rows: " + count + ", cols: " + count +
         ", ripple: 0.01}, air: {viscous_damping: 3, wind_coupling: 0.2, wind: [0, 1, 0]}, strain_limit: {max_strain: "
         "0}, " +
         further + "}";
}

Motion exact_motion(const StartedScene& scene)
{
  return motion_of(scene, { "dopri5", 0.0, 1e-9 }, any_number);
}

Motion planned_motion(const StartedScene& scene, const Choice& choice)
{
  SceneParams params = scene.params;
  params.solver.method = "auto";
  Simulation simulation = build_simulation(make_plan(params, choice));
  Motion motion;
  for (int s = 1; s <= Motion::samples; ++s)
  {
    simulation.advance_to(Motion::horizon * s / Motion::samples);
    motion.positions.push_back(simulation.state().positions);
  }
  return motion;
}

TEST(Distance, IsTheRootMeanSquareOverNodesAndSamples)
{
  Motion one;
  Motion other;
  for (int s = 0; s < Motion::samples; ++s)
  {
    one.positions.push_back(Vectors::Zero(4, 3));
    other.positions.push_back(Vectors::Zero(4, 3));
  }
  other.positions[2](1, 0) = 3.0;
  other.positions[2](1, 2) = 4.0;
  EXPECT_DOUBLE_EQ(distance(one, other), 5.0 / std::sqrt(4.0 * Motion::samples));
  EXPECT_EQ(distance(one, other, 2), 0.0);
  other.positions.pop_back();
  EXPECT_TRUE(std::isinf(distance(one, other)));
}

TEST(Planned, KeepsWhatItPromises)
{
  StepCosts costs("");
  for (const char* const tolerance : { "1.0e-2", "1.0e-3", "1.0e-4" })
  {
    for (const int nodes : { 8, 16 })
    {
      const StartedScene scene = started(damped_sheet(nodes, std::string("solver: {tolerance: ") + tolerance + "}"));
      const Choice choice = plan_by_trial(scene, costs).choice;
      const double error = distance(planned_motion(scene, choice), exact_motion(scene));
      EXPECT_LE(choice.error, scene.params.solver.tolerance) << tolerance << ", " << nodes;
      EXPECT_LE(error, scene.params.solver.tolerance) << tolerance << ", " << nodes;
      EXPECT_GT(choice.error, 0.1 * error) << tolerance << ", " << nodes;
    }
  }
}

TEST(Planned, LeavesOutWhatDoesNotMatterAndKeepsWhatDoes)
{
  StepCosts costs("");
  const StartedScene scene =
      started(damped_sheet(16, "springs: {flex: {stiffness: 1.0e-4}}, solver: {tolerance: 1.0e-3}"));
  const Planned planned = plan_by_trial(scene, costs);
  const std::vector<std::string>& left_out = planned.choice.left_out;
  EXPECT_NE(std::find(left_out.begin(), left_out.end(), "flex springs"), left_out.end());
  EXPECT_EQ(std::find(left_out.begin(), left_out.end(), "shear springs"), left_out.end());
  EXPECT_EQ(std::find(left_out.begin(), left_out.end(), "wind"), left_out.end());
  const Motion exact = exact_motion(scene);
  const auto change_without = [&](const std::string& part) {
    Choice choice = planned.choice;
    choice.left_out = { part };
    return distance(planned_motion(scene, choice), exact);
  };
  EXPECT_LT(change_without("flex springs"), 1e-3);
  EXPECT_GT(change_without("shear springs"), 0.25e-3);
  EXPECT_GT(change_without("wind"), 0.25e-3);
}

/// Without its damping the sheet may be stepped three times as far, which makes another method the cheapest.
TEST(Planned, TakesTheStepsOfTheModelThatIsLeft)
{
  StepCosts costs("");
  const StartedScene scene = started(
      damped_sheet(12,
                   "springs: {structural: {stiffness: 1000, damping: 2}, shear: {stiffness: 300, damping: 0.1}, flex: "
                   "{stiffness: 0}}, solver: {tolerance: 1.0e-2}"));
  const Planned planned = plan_by_trial(scene, costs);
  ASSERT_EQ(planned.choice.left_out, PartList{ "internal damping" });
  StartedScene undamped = scene;
  undamped.params = without(scene.params, planned.choice.left_out);
  undamped.params.plan = "full";
  EXPECT_EQ(planned.choice.method, plan_by_trial(undamped, costs).choice.method);
  EXPECT_EQ(planned.choice.time_step, plan_by_trial(undamped, costs).choice.time_step);
}

TEST(Planned, ModelsAllWhereTheSceneSaysSo)
{
  StepCosts costs("");
  const StartedScene scene =
      started(damped_sheet(16, "springs: {flex: {stiffness: 1.0e-4}}, plan: full, solver: {tolerance: 1.0e-3}"));
  const Planned planned = plan_by_trial(scene, costs);
  EXPECT_TRUE(planned.choice.left_out.empty());
  EXPECT_TRUE(planned.tried.empty());
  EXPECT_FALSE(planned.choice.method.empty());
}

TEST(Planned, IsTheSameFromTheSameCosts)
{
  StepCosts costs("");
  const StartedScene scene = started(damped_sheet(16, "solver: {tolerance: 1.0e-3}"));
  const Planned first = plan_by_trial(scene, costs);
  const Planned second = plan_by_trial(scene, costs);
  EXPECT_EQ(first.reason, second.reason);
  EXPECT_EQ(first.choice.left_out, second.choice.left_out);
  EXPECT_EQ(first.choice.time_step, second.choice.time_step);
  EXPECT_EQ(first.choice.error, second.choice.error);
}

TEST(Planned, OfALooserToleranceCostsNoMore)
{
  StepCosts costs("");
  double before = std::numeric_limits<double>::infinity();
  for (const char* const tolerance : { "1.0e-5", "1.0e-4", "1.0e-3", "1.0e-2" })
  {
    const StartedScene scene =
        started(damped_sheet(16, std::string("plan: full, solver: {tolerance: ") + tolerance + "}"));
    const Planned planned = plan_by_trial(scene, costs);
    EXPECT_LE(planned.choice.cost, 1.1 * before) << tolerance;
    before = planned.choice.cost;
  }
}

TEST(Planned, TakesNoLongerStepThanGiven)
{
  StepCosts costs("");
  const StartedScene scene = started(damped_sheet(8, "solver: {tolerance: 1.0e-2, time_step: 1.0e-4}"));
  const Choice choice = plan_by_trial(scene, costs).choice;
  EXPECT_GT(choice.time_step, 0.0);
  EXPECT_LE(choice.time_step, 1e-4);
}

/// Steps that a trial holds against a far more exact motion of the sheet itself need no margin for extrapolation.
TEST(Planned, ErrsByMoreOfTheToleranceWhereThatIsMeasured)
{
  StepCosts costs("");
  const StartedScene scene = started(
      damped_sheet(12,
                   "springs: {structural: {stiffness: 2.0e+4}, shear: {stiffness: 1.0e+4}, flex: {stiffness: 1.0e+3}}, "
                   "solver: {tolerance: 1.0e-2}"));
  const Choice choice = plan_by_trial(scene, costs).choice;
  const double error = distance(planned_motion(scene, choice), exact_motion(scene));
  EXPECT_GT(choice.error, 0.6e-2);
  EXPECT_LE(choice.error, 1e-2);
  EXPECT_LE(error, 1e-2);
  EXPECT_NEAR(choice.error, error, 0.2 * error);
}

/// Where steps err by more than the tolerance, trials do not tell what is below it.
TEST(Planned, LeavesNothingOutWhereTheToleranceCannotBeHad)
{
  StepCosts costs("");
  StartedScene scene = started(damped_sheet(8, "springs: {flex: {stiffness: 1.0e-30}}"));
  scene.params.solver.tolerance = 1e-16;
  const Planned planned = plan_by_trial(scene, costs);
  ASSERT_GT(planned.choice.error, 1e-16);
  const auto flex = std::find_if(planned.tried.begin(), planned.tried.end(),
                                 [](const TriedPart& part) { return part.part == "flex springs"; });
  ASSERT_NE(flex, planned.tried.end());
  EXPECT_EQ(flex->change, 0.0);
  EXPECT_TRUE(planned.choice.left_out.empty());
}

TEST(Planned, SaysWhereTheToleranceCannotBeHad)
{
  // Drawn together, undamped and without flex springs it folds as chance has it.
  StepCosts costs("");
  const StartedScene scene = started(
      "{cloth: {rows: 24, cols: 24, initial_stretch: [0.8, 1], ripple: 0.02}, springs: {flex: {stiffness: 0}}, "
      "air: {viscous_damping: 0.01, wind_coupling: 0}, strain_limit: {max_strain: 0}, solver: {tolerance: 1.0e-6}}");
  const Planned planned = plan_by_trial(scene, costs);
  EXPECT_GT(planned.choice.error, 1e-6);
  EXPECT_TRUE(has(planned.reason, { "the tolerance of 1.0e-06 m cannot be had" })) << planned.reason;
}

StartedScene shipped(const std::string& name, const std::vector<std::pair<std::string, std::string>>& settings)
{
  YAML::Node tree = load_scene_file("config/" + name + ".yaml");
  for (const auto& [key, value] : settings)
  {
    override_key(tree, key, value);
  }
  const SceneParams params = read_scene(tree);
  return { params, scene_start(params, make_sheet(params.sheet)) };
}

double error_of(const StartedScene& scene, const Choice& choice)
{
  const double limit = simulation_of(scene, { "velocity_verlet" }).stability_limit();
  const Stepping exact{ "velocity_verlet", 0.25 * limit };
  return distance(planned_motion(scene, choice), motion_of(scene, exact, any_number));
}

/// What folds parts from itself, and the plan claims by how much.
TEST(Planned, ClaimsWhatIsTrueOfSheetsThatFold)
{
  StepCosts costs("");
  for (const char* const max_strain : { "0", "0.1" })
  {
    const StartedScene scene = shipped("hanging_sheet", { { "strain_limit.max_strain", max_strain } });
    const Planned planned = plan_by_trial(scene, costs);
    const double error = error_of(scene, planned.choice);
    EXPECT_TRUE(has(planned.reason, { "cannot be had, since the motion parts from itself" })) << planned.reason;
    EXPECT_GT(planned.choice.error, 0.3 * error) << max_strain;
    EXPECT_LT(planned.choice.error, 3.0 * error) << max_strain;
  }
}

/// A few long steps of xpbd err as if they were short ones; half of them on the sheet itself tell.
TEST(Planned, BelievesNoLongStepsThatTheSheetItselfBelies)
{
  StepCosts costs("");
  const StartedScene scene = shipped("free_sheet", {});
  const Choice choice = plan_by_trial(scene, costs).choice;
  EXPECT_LE(choice.error, scene.params.solver.tolerance);
  EXPECT_LE(error_of(scene, choice), scene.params.solver.tolerance);
}

/// In real time there are steps of xpbd alone that err by a metre.
TEST(Planned, IsRatherSlowerThanOfNoUse)
{
  StepCosts costs("");
  const StartedScene scene = shipped(
      "hanging_sheet", { { "cloth.rows", "128" }, { "cloth.cols", "128" }, { "strain_limit.max_strain", "0" } });
  const Planned planned = plan_by_trial(scene, costs);
  EXPECT_LT(planned.choice.error, 0.1) << planned.reason;
}

TEST(GridReport, NamesAGridThatWouldDo)
{
  // In free fall any grid will.
  StepCosts costs("");
  const StartedScene falling =
      started("{cloth: {rows: 33, cols: 33}, pins: [], air: {viscous_damping: 0, wind_coupling: 0}}");
  Choice choice;
  choice.method = "velocity_verlet";
  choice.cost = 1.0;
  const std::string report = grid_report(falling, choice, costs);
  EXPECT_TRUE(has(report, { "5 x 5 nodes would do", " s of work a second instead of 1 s" })) << report;
}

TEST(GridReport, FindsNoRestWithoutSprings)
{
  StepCosts costs("");
  const StartedScene loose = started(
      "{cloth: {rows: 17, cols: 17}, springs: {structural: {stiffness: 0, damping: 0}, shear: {stiffness: 0, damping: "
      "0}, "
      "flex: {stiffness: 0, damping: 0}}, strain_limit: {max_strain: 0}}");
  Choice choice;
  choice.method = "velocity_verlet";
  choice.cost = 1.0;
  const std::string report = grid_report(loose, choice, costs);
  EXPECT_TRUE(has(report, { "m in motion and no rest to compare" })) << report;
}

TEST(GridReport, SaysThatThereIsNone)
{
  StepCosts costs("");
  const StartedScene hanging = started(damped_sheet(17, "solver: {tolerance: 1.0e-6}"));
  Choice choice;
  choice.method = "velocity_verlet";
  choice.cost = 1.0;
  const std::string report = grid_report(hanging, choice, costs);
  EXPECT_TRUE(has(report, { "as the scene says; no coarser grid", "9 x 9 nodes differ from twice as fine by " }))
      << report;
}

}  // namespace
}  // namespace cloth
