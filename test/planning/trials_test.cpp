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
  const Motion& of_scout = trials.motion({ scout, 0.5 * trials.limit(*find_method(scout)) });
  EXPECT_EQ(of_scout.positions.size(), size_t(Motion::samples));
  EXPECT_GT(of_scout.excess, 0.1);
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
