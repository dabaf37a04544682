#include "cloth_sim/scene/plan.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

const char* const four_by_five = "cloth: {rows: 4, cols: 5}";

/// Nothing is tried unless the solver is given.
std::vector<std::string> lines_of(const std::string& yaml)
{
  const bool has_solver = yaml.find("solver:") != std::string::npos;
  const Plan plan = make_plan(scene_of("{" + yaml + (has_solver ? "}" : ", solver: {method: velocity_verlet}}")));
  return describe(plan, build_simulation(plan));
}

/// The one line that begins with the part's name.
std::string line_of(const std::string& part, const std::string& yaml)
{
  std::string found;
  for (const std::string& line : lines_of(yaml))
  {
    if (line.compare(0, part.size() + 2, part + ": ") == 0)
    {
      EXPECT_EQ(found, "") << part << " is there twice";
      found = line;
    }
  }
  return found;
}

TEST(Plan, KeepsWhatActsAndCountsIt)
{
  const std::string yaml = std::string(four_by_five) + ", springs: {structural: {stiffness: 50, damping: 0}}";
  EXPECT_EQ(line_of("structural springs", yaml), "structural springs: kept, 31 of 50.0 N/m, undamped");
  EXPECT_EQ(line_of("shear springs", yaml), "shear springs: kept, 24 of 100.0 N/m and 0.01 N s/m");
  EXPECT_EQ(line_of("flex springs", yaml), "flex springs: kept, 22 of 10.0 N/m, undamped");
  EXPECT_EQ(line_of("gravity", yaml), "gravity: kept, 9.81 m/s2");
  EXPECT_EQ(line_of("viscous damping", yaml), "viscous damping: kept, 0.3 N s/m per m2");
  EXPECT_TRUE(has(line_of("wind", yaml), { "wind: kept, 1.0 N s/m per m2, air at 0.0 m/s; still" }));
  EXPECT_TRUE(has(line_of("wind", "air: {gusts: {strength: 2}}"), { "air at 0.0 m/s with gusts of 2.0 m/s; still" }));
  EXPECT_EQ(line_of("strain limit", yaml), "strain limit: kept, 0.1 in at most 30 sweeps a step");
  EXPECT_TRUE(has(line_of("pins", yaml), { "pins: kept, 2 nodes in 2 pins, 0 " }));
  EXPECT_TRUE(has(line_of("pins", "pins: [{name: a, at: border, motion: {amplitude: [0, 0, 1], frequency: 1}}]"),
                  { "124 nodes in 1 pin, 1 of them moving" }));
}

TEST(Plan, LeavesOutWhatCannotActAndSaysWhy)
{
  const auto is = [](const std::string& part, const std::string& yaml, const std::string& reason) {
    EXPECT_EQ(line_of(part, yaml), part + ": left out, " + reason);
  };
  is("structural springs", "springs: {structural: {stiffness: 0}}", "stiffness is 0");
  is("shear springs", "springs: {shear: {stiffness: 0}}", "stiffness is 0");
  is("flex springs", "springs: {flex: {stiffness: 0}}", "stiffness is 0");
  is("shear springs", "cloth: {rows: 5, cols: 1}", "the grid of 5 x 1 nodes has no room for one");
  is("flex springs", "cloth: {rows: 2, cols: 2}", "the grid of 2 x 2 nodes has no room for one");
  is("gravity", "gravity: [0, 0, 0]", "it is 0");
  is("viscous damping", "air: {viscous_damping: 0}", "the coefficient is 0");
  is("wind", "air: {wind_coupling: 0, wind: [1, 0, 0]}", "air.wind_coupling is 0; no normals are computed");
  is("wind", "cloth: {rows: 5, cols: 1}", "a chain has no normals");
  is("wind", "cloth: {rows: 1, cols: 5}", "a chain has no normals");
  is("strain limit", "strain_limit: {max_strain: 0}", "max_strain is 0");
  is("strain limit", "springs: {structural: {stiffness: 0}, shear: {stiffness: 0}}",
     "there are no structural and no shear springs");
  is("pins", "pins: []", "the scene has none");
}

TEST(Plan, DoesNotRunWhatItLeavesOut)
{
  const Plan plan = make_plan(scene_of("springs: {structural: {stiffness: 0}, shear: {stiffness: 0}}"));
  EXPECT_EQ(plan.scene.strain_limit.max_strain, 0.0);
  EXPECT_EQ(make_plan(scene_of("")).scene.strain_limit.max_strain, 0.1);
}

TEST(Plan, HasALineForEveryPartOnceAndInOrder)
{
  const std::vector<std::string> parts{ "structural springs",
                                        "shear springs",
                                        "flex springs",
                                        "internal damping",
                                        "gravity",
                                        "viscous damping",
                                        "wind",
                                        "strain limit",
                                        "pins",
                                        "start",
                                        "method",
                                        "error watch",
                                        "sleep",
                                        "threads",
                                        "time step" };
  const std::vector<std::string> lines = lines_of(four_by_five);
  ASSERT_EQ(lines.size(), parts.size());
  for (size_t i = 0; i < parts.size(); ++i)
  {
    EXPECT_EQ(lines[i].substr(0, lines[i].find(':')), parts[i]);
  }
}

TEST(Plan, SaysWhereTheSheetStartsAndHoldsIt)
{
  EXPECT_EQ(line_of("start", four_by_five), "start: kept, flat");
  const std::string drawn = "cloth: {rows: 4, cols: 5, initial_stretch: [0.9, 1.0], start: ";
  EXPECT_EQ(line_of("start", drawn + "catenary}"), "start: kept, catenary, between 2 pinned nodes, relaxed");
  EXPECT_TRUE(
      has(line_of("start", drawn + "settled}"), { "start: kept, settled, from catenary in ", " of the weight" }));
  const Plan plan = make_plan(scene_of("{" + drawn + "settled}}"));
  EXPECT_EQ(build_simulation(plan).state().positions, plan.start.positions);
  EXPECT_THROW(make_plan(scene_of("{cloth: {start: catenary}}")), SceneError);
}

TEST(Plan, SaysWhetherStepsAreCheckedWhileTheyRun)
{
  const SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}, solver: {tolerance: 2.0e-3}}");
  const auto line_with = [&](const std::string& method, double error, double cost) {
    Choice choice;
    choice.method = method;
    choice.error = error;
    choice.cost = cost;
    const Plan plan = make_plan(scene, choice);
    return *std::find_if(plan.lines.begin(), plan.lines.end(),
                         [](const PlanLine& line) { return line.part == "error watch"; });
  };
  const PlanLine watched = line_with("velocity_verlet", 1e-3, 0.1);
  EXPECT_TRUE(watched.kept);
  EXPECT_TRUE(has(watched.reason, { "by half steps", "more than 0.002 m" })) << watched.reason;
  EXPECT_TRUE(has(line_with("velocity_verlet", 5e-3, 0.1).reason, { "more than 0.01 m" }));
  EXPECT_FALSE(line_with("velocity_verlet", 1e-3, 0.4).kept);
  EXPECT_TRUE(has(line_with("velocity_verlet", 1e-3, 0.4).reason, { "0.4 s of work a second leave no time" }));
  EXPECT_TRUE(has(line_with("dopri5", 1e-3, 0.1).reason, { "dopri5 watches each of its steps" }));
  EXPECT_EQ(line_of("error watch", "solver: {method: rk4}"), "error watch: left out, solver.method is rk4, not auto");
}

/// A heavy sheet stretches soon, and for some steps the limit is known no better than the bounds say.
TEST(Plan, SaysWhereTheStepFollowsFromABound)
{
  const Plan plan =
      make_plan(scene_of("{cloth: {rows: 12, cols: 12, mass: 4}, strain_limit: {max_strain: 0}, solver: "
                         "{method: velocity_verlet}}"));
  Simulation simulation = build_simulation(plan);
  EXPECT_TRUE(has(describe(plan, simulation).back(), { " s, 0.9 of the stability limit of velocity_verlet" }));
  bool follows_from_a_bound = false;
  for (int tick = 1; tick <= 20; ++tick)
  {
    ASSERT_TRUE(simulation.advance_to(0.1 * tick));
    const std::string line = describe(plan, simulation).back();
    follows_from_a_bound |=
        line.find(" s, from a bound within 0.9 of the stability limit of velocity_verlet") != std::string::npos;
  }
  EXPECT_TRUE(follows_from_a_bound);
}

TEST(Plan, SaysWhatTheLastCheckFound)
{
  const SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6, ripple: 0.01}, plan: full}");
  Choice choice;
  choice.method = "velocity_verlet";
  choice.error = 1e-4;
  choice.cost = 1e-3;
  const Plan plan = make_plan(scene, choice);
  Simulation simulation = build_simulation(plan);
  ASSERT_TRUE(simulation.advance_to(ErrorWatch::first_check + ErrorWatch::horizon + 0.1));
  const std::vector<std::string> lines = describe(plan, simulation);
  const auto line =
      std::find_if(lines.begin(), lines.end(), [](const std::string& text) { return text.find("error watch: ") == 0; });
  EXPECT_TRUE(has(*line, { "in the second before 5", " s erred by " })) << *line;
}

TEST(Plan, OfAutoSaysHowExactAndHowDearItIs)
{
  const std::string line = line_of("method", std::string(four_by_five) + ", solver: {tolerance: 0.25}");
  EXPECT_TRUE(
      has(line, { "method: kept, ", " at steps of ", " s errs by ", " m over 1.0 s for ", " s of work a second" }));
}

TEST(Plan, TriesPartsUnlessTheSceneIsToBeModelledInFull)
{
  const std::string sheet = "cloth: {rows: 16, cols: 16}, solver: {method: auto, tolerance: 1.0e-2}, ";
  const char* const tried = "without, the answer changes by ";
  EXPECT_TRUE(has(line_of("shear springs", sheet + "plan: auto"), { tried }));
  EXPECT_FALSE(has(line_of("shear springs", sheet + "plan: full"), { tried }));
  EXPECT_TRUE(make_plan(scene_of("{" + sheet + "plan: full}")).choice.left_out.empty());
}

TEST(Plan, OfAnEarlierChoiceIsTheSame)
{
  const SceneParams scene = scene_of("{cloth: {rows: 16, cols: 16}, solver: {tolerance: 1.0e-2}}");
  const Plan first = make_plan(scene);
  Choice choice = first.choice;
  choice.left_out = { "wind", "internal damping" };
  choice.method = "rk4";
  choice.time_step = 1e-3;
  const Plan second = make_plan(scene, choice);
  EXPECT_EQ(second.method, find_method("rk4"));
  EXPECT_EQ(second.scene.air.wind_coupling, 0.0);
  EXPECT_EQ(second.scene.sheet.structural.damping, 0.0);
  EXPECT_EQ(second.asked.air.wind_coupling, 1.0);
  Simulation one = build_simulation(make_plan(scene, first.choice));
  Simulation other = build_simulation(first);
  one.advance_to(0.2);
  other.advance_to(0.2);
  EXPECT_EQ(one.state().positions, other.state().positions);
}

TEST(Plan, TakesEveryMethodThatIsNamed)
{
  for (const MethodRow& method : methods())
  {
    const std::string yaml = std::string(four_by_five) + ", solver: {method: " + method.name + "}";
    EXPECT_EQ(make_plan(scene_of("{" + yaml + "}")).method, &method);
    const std::string line = line_of("method", yaml);
    EXPECT_EQ(line.find(std::string("method: kept, ") + method.name + ", as the scene says"), 0u) << line;
  }
}

TEST(Plan, SaysWhichStepIsTakenAndWhy)
{
  const Plan plan = make_plan(scene_of(std::string("{") + four_by_five + ", solver: {method: velocity_verlet}}"));
  const Simulation simulation = build_simulation(plan);
  const std::string step = describe(plan, simulation).back();
  EXPECT_TRUE(has(step, { "time step: ", " s, 0.9 of the stability limit of velocity_verlet, " }));
  const YAML::Node number = YAML::Load(step.substr(11, step.find(" s,") - 11));
  EXPECT_NEAR(number.as<double>(), 0.9 * simulation.stability_limit(), 1e-4 * number.as<double>());

  EXPECT_TRUE(
      has(line_of("time step", std::string(four_by_five) + ", solver: {method: velocity_verlet, time_step: 1.0e-3}"),
          { "time step: 0.001 s, as the scene says; the stability limit of velocity_verlet is 0.0" }));
  const std::string free =
      "springs: {structural: {stiffness: 0}, shear: {stiffness: 0}, flex: {stiffness: 0}}, "
      "air: {viscous_damping: 0, wind_coupling: 0}";
  EXPECT_TRUE(has(line_of("time step", free), { "time step: 0.00416666", " s, 1/240 s, since nothing here limits" }));
}

TEST(ConvergenceWarning, CountsTheStepsThatWereNotSolved)
{
  const std::string stiff = std::string("{") + four_by_five +
                            ", springs: {structural: {stiffness: 1.0e5}}, solver: {method: projective, iterations: 2}}";
  Simulation simulation = build_simulation(make_plan(scene_of(stiff)));
  EXPECT_EQ(convergence_warning(simulation), "");
  simulation.advance_to(0.1);
  const std::string unsolved = std::to_string(simulation.counters().unconverged_steps);
  EXPECT_TRUE(has(convergence_warning(simulation),
                  { unsolved + " of 24 steps of projective", "solver.time_step", "solver.iterations" }));
}

TEST(TimeStepWarning, HasBothNumbersBeyondTheLimitAndNothingWithinIt)
{
  const std::string scene = std::string("{") + four_by_five + ", solver: {method: velocity_verlet, time_step: ";
  const Simulation chosen = build_simulation(make_plan(scene_of(scene + "0}}")));
  EXPECT_EQ(time_step_warning(chosen), "");
  const double limit = chosen.stability_limit();
  const Simulation within = build_simulation(make_plan(scene_of(scene + format_number(0.99 * limit) + "}}")));
  EXPECT_EQ(time_step_warning(within), "");

  const double given = 1.01 * limit;
  const Simulation beyond = build_simulation(make_plan(scene_of(scene + format_number(given) + "}}")));
  EXPECT_EQ(beyond.time_step(), given) << "a given step is obeyed";
  const std::string warning = time_step_warning(beyond);
  const std::string start =
      "solver.time_step is " + format_number(given) + " s, beyond the stability limit of velocity_verlet, ";
  ASSERT_EQ(warning.substr(0, start.size()), start);
  EXPECT_NEAR(std::stod(warning.substr(start.size())), limit, 1e-4 * limit);
}

TEST(LivePlan, KeepsTheStartAndTakesTheRest)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6, initial_stretch: [0.9, 1], start: catenary}}");
  const Plan before = make_plan(scene);
  scene.sheet.structural.stiffness = 300.0;
  scene.solver.method = "rk4";
  const Plan after = live_plan(before, scene);
  EXPECT_EQ(after.start.positions, before.start.positions);
  const Simulation simulation = carry_on(after, build_simulation(before));
  const std::vector<std::string> lines = describe(after, simulation);
  for (const char* const line :
       { "structural springs: kept, 60 of 300.0 N/m and 0.01 N s/m", "start: kept, catenary, between 2 pinned nodes",
         "method: kept, rk4, as the scene says" })
  {
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const std::string& text) { return has(text, { line }); }))
        << line;
  }
}

TEST(LivePlan, BringsBackWhatATrialLeftOut)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}}");
  Choice choice;
  choice.left_out = { "flex springs" };
  choice.method = "symplectic_euler";
  const Plan before = make_plan(scene, choice);
  EXPECT_EQ(before.scene.sheet.flex.stiffness, 0.0);
  scene.air.viscous_damping = 0.5;
  const Plan after = live_plan(before, scene);
  EXPECT_EQ(after.scene.sheet.flex.stiffness, scene.sheet.flex.stiffness);
  EXPECT_EQ(after.method, before.method);
  EXPECT_TRUE(after.choice.left_out.empty());
}

TEST(LivePlan, OfAutoTakesAStepThatIsGivenAndLetsItGoAgain)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}}");
  const Plan before = make_plan(scene);
  scene.solver.time_step = 1e-6;
  const Plan shorter = live_plan(before, scene);
  const Simulation simulation = carry_on(shorter, build_simulation(before));
  EXPECT_EQ(simulation.time_step(), 1e-6);
  scene.air.viscous_damping = 0.7;
  EXPECT_EQ(carry_on(live_plan(shorter, scene), simulation).time_step(), 1e-6);
  scene.solver.time_step = 0.0;
  EXPECT_GT(carry_on(live_plan(shorter, scene), simulation).time_step(), 1e-5);
}

TEST(LivePlan, ChangedGustsAreThoseThatTheirSceneWouldHaveHadAtThatTime)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}, air: {wind: [0, 1, 0], gusts: {strength: 1}}}");
  const Plan before = make_plan(scene);
  Simulation running = build_simulation(before);
  running.advance_to(0.3);
  scene.air.gusts = { 2.0, 0.5, 7 };
  const Simulation simulation = carry_on(live_plan(before, scene), running);
  const Gusts gusts(scene.air.gusts);
  for (const double time : { 0.3, 1.7 })
  {
    EXPECT_EQ(simulation.dynamics().air().wind_at(time), scene.air.wind + gusts.at(time));
  }
}

TEST(LivePlan, RefusesWhatDoesNotFitTogether)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}}");
  const Plan before = make_plan(scene);
  scene.solver.compliance = 0.5;
  EXPECT_THROW(live_plan(before, scene), SceneError);
}

TEST(Plan, RefusesMixedPrecisionOfAMethodThatHasNone)
{
  EXPECT_THROW(make_plan(scene_of("{solver: {method: rk4, precision: mixed}}")), SceneError);
  const Plan plan = make_plan(scene_of("{cloth: {rows: 6, cols: 6}, solver: {method: xpbd, precision: mixed}}"));
  EXPECT_EQ(plan.scene.solver.precision, Precision::mixed);
}

TEST(LivePlan, WhereForcesOverflowNothingCarriesOn)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}, solver: {method: tr_bdf2}}");
  const Plan before = make_plan(scene);
  const Simulation running = build_simulation(before);
  scene.gravity.z() = 1e300;
  EXPECT_THROW(carry_on(live_plan(before, scene), running), SceneError);
}

TEST(LivePlan, WhereNoStepIsStableNothingCarriesOn)
{
  SceneParams scene = scene_of("{cloth: {rows: 6, cols: 6}}");
  const Plan before = make_plan(scene);
  const Simulation running = build_simulation(before);
  scene.solver.method = "explicit_euler";
  scene.air.viscous_damping = 0.0;
  EXPECT_THROW(carry_on(live_plan(before, scene), running), SceneError);
  scene.solver.time_step = 1e-3;
  EXPECT_THROW(carry_on(live_plan(before, scene), running), SceneError) << "a live change does not go past the limit";
}

}  // namespace
}  // namespace cloth
