#include "trials.h"

#include <string>

#include <gtest/gtest.h>

#include "cloth_sim/scene/scene_start.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

/// Held at two corners; with few passes of plain sweeps the limit needs short steps.
StartedScene limited_sheet(const std::string& max_strain, int passes)
{
  const SceneParams params = scene_of("{cloth: {rows: 17, cols: 17}, strain_limit: {max_strain: " + max_strain +
                                      ", sweeps: " + std::to_string(passes) + ", solver: sweeps}}");
  return { params, scene_start(params, make_sheet(params.sheet)) };
}

Stepping xpbd_at(double time_step)
{
  return { "xpbd", time_step, 1e-3, 1 };
}

TEST(Trials, LeadNowhereAtStepsTooLongForTheStrainLimit)
{
  StepCosts costs("");
  Trials trials(limited_sheet("0.05", 8), costs);
  EXPECT_TRUE(trials.motion(xpbd_at(1.0 / 16.0)).positions.empty());
  EXPECT_GT(trials.motion(xpbd_at(1.0 / 16.0)).excess, 1.0);
  const Motion& short_steps = trials.motion(xpbd_at(5e-4));
  EXPECT_EQ(short_steps.positions.size(), size_t(Motion::samples));
  EXPECT_LT(short_steps.excess, 0.5);
}

/// Where no step is short enough for the passes that there are, it is the scene's doing, and planned all the same.
TEST(Trials, OfALimitThatNoStepKeepsAreHeldAgainstTheScout)
{
  StepCosts costs("");
  Trials trials(limited_sheet("0.05", 1), costs);
  const Motion& of_scout = trials.motion({ trials.scout().name, 0.5 * trials.limit(trials.scout()) });
  EXPECT_EQ(of_scout.positions.size(), size_t(Motion::samples));
  EXPECT_GT(of_scout.excess, 0.1);
}

/// Damped by as much as the springs let go back, steps of second order are half as long as those of first order.
TEST(Trials, HaveAScoutOfFirstOrderWhereDampingMakesItMuchCheaper)
{
  StepCosts costs("");
  const auto scout_at = [&](double damping) {
    StartedScene scene = limited_sheet("0", 8);
    scene.params.sheet.structural.damping = damping;
    return std::string(Trials(scene, costs).scout().name);
  };
  EXPECT_EQ(scout_at(0.0), "velocity_verlet");
  EXPECT_EQ(scout_at(1.0), "symplectic_euler");
}

/// A motion takes as long as it does: what is cheap is tried as it is, for the sake of what cells are too long for.
TEST(Trials, AreOfTheSheetItselfWhereThatIsCheap)
{
  StepCosts costs("");
  StartedScene scene = limited_sheet("0", 8);
  EXPECT_EQ(Trials(scene, costs).coarseness(), 1.0);
  scene.params.sheet.structural.stiffness = 1e6;
  EXPECT_GT(Trials(scene, costs).coarseness(), 1.5);
}

TEST(Trials, FindNoErrorInTheScoutItself)
{
  StepCosts costs("");
  Trials trials(limited_sheet("0", 8), costs);
  const Stepping longest = trials.longest_of_scout_on_the_sheet();
  EXPECT_EQ(trials.error_on_the_sheet(longest), 0.0);
  Stepping half = longest;
  half.time_step *= 0.5;
  EXPECT_GT(trials.error_on_the_sheet(half), 0.0);
}

TEST(Trials, CompareStepsWithShorterOnesOnTheSheetItself)
{
  StepCosts costs("");
  const StartedScene scene = limited_sheet("0", 8);
  Trials trials(scene, costs);
  const Stepping steps{ "velocity_verlet", 1e-3 };
  const Stepping shorter{ "velocity_verlet", 1e-3 / shorter_in_a_check };
  const double difference = distance(motion_of(scene, steps, 1e9), motion_of(scene, shorter, 1e9));
  EXPECT_GT(difference, 0.0);
  EXPECT_EQ(trials.difference_on_the_sheet(steps).value(), difference);
  EXPECT_EQ(trials.difference_on_trials(steps), difference);
  EXPECT_FALSE(trials.difference_on_the_sheet({ "velocity_verlet", 1e-9 }).has_value());
}

/// The first equations take thousands of evaluations, more than a soft sheet takes altogether.
TEST(Trials, HaveTimeForAFirstSolveOnlyOfStiffSheets)
{
  StepCosts costs("");
  StartedScene scene = limited_sheet("0", 8);
  EXPECT_FALSE(Trials(scene, costs).can_afford_a_first_solve());
  scene.params.sheet.structural.stiffness = 1e7;
  EXPECT_TRUE(Trials(scene, costs).can_afford_a_first_solve());
}

TEST(Trials, KnowNoExcessWithoutALimit)
{
  StepCosts costs("");
  Trials trials(limited_sheet("0", 8), costs);
  const Motion& motion = trials.motion(xpbd_at(1.0 / 16.0));
  EXPECT_EQ(motion.positions.size(), size_t(Motion::samples));
  EXPECT_EQ(motion.excess, 0.0);
}

}  // namespace
}  // namespace cloth
