// What is charted of a scene.

#include "errors.h"
#include "small_problem.h"
#include "support.h"

namespace cloth
{
namespace
{

/// The largest difference between a sheet's left and right half, m.
double asymmetry(const Problem& problem)
{
  const Vectors& x = problem.plan.start.positions;
  const ClothModel model = make_sheet(problem.plan.scene.sheet);
  double largest = 0.0;
  for (int row = 0; row < model.rows; ++row)
  {
    for (int col = 0; col < model.cols; ++col)
    {
      const double here = x(model.node(row, col), 1);
      largest = std::max(largest, std::abs(here - x(model.node(row, model.cols - 1 - col), 1)));
    }
  }
  return largest;
}

TEST(ProblemOfAScene, StartsWithoutSymmetryAndSmoothly)
{
  for (const std::string start : { "", "start: settled, ", "start: catenary, initial_stretch: [0.9, 1], " })
  {
    const Problem problem = problem_of("a", Kind::trajectory, scene_of("cloth: {" + start + "rows: 9, cols: 9}"), 0.5);
    EXPECT_GT(asymmetry(problem), 5e-3) << start;
    EXPECT_LT(asymmetry(problem), 5e-2) << start;
  }
}

TEST(ProblemOfAScene, KeepsARippleThatTheSceneHas)
{
  const SceneParams scene = scene_of(small_scene);
  const Problem problem = problem_of("a", Kind::trajectory, scene, 0.5);
  EXPECT_EQ(problem.plan.start.positions, start_state(scene.start, make_sheet(scene.sheet)).positions);
}

TEST(ProblemOfAScene, HasAStrainLimitOnlyWhereThatIsWhatIsCharted)
{
  const SceneParams scene = scene_of("strain_limit: {max_strain: 0.2}");
  EXPECT_EQ(problem_of("a", Kind::trajectory, scene, 0.5).plan.scene.strain_limit.max_strain, 0.0);
  EXPECT_EQ(problem_of("a", Kind::spatial, scene, 0.5).plan.scene.strain_limit.max_strain, 0.0);
  EXPECT_EQ(problem_of("a", Kind::limited, scene, 0.5).plan.scene.strain_limit.max_strain, 0.2);
}

TEST(ProblemOfAScene, IsDisturbedByTheSizeThatIsAskedFor)
{
  const Problem problem = small_problem();
  const Problem other = disturbed(problem, 1e-9);
  EXPECT_NEAR(rms_distance({ other.plan.start }, { problem.plan.start }), 1e-9, 1e-15);
}

TEST(HorizonOfAScene, IsShorterTheMoreASceneCosts)
{
  const SceneParams cheap = scene_of(small_scene);
  EXPECT_EQ(horizon_of(cheap, 0.5, 1e9), 0.5);
  EXPECT_EQ(horizon_of(cheap, 0.3, 1e9), 0.25);
  const double limit = simulation_of(small_problem(), "velocity_verlet", 1.0, {}).stability_limit();
  const double node_steps_a_second = 30.0 / limit;
  EXPECT_EQ(horizon_of(cheap, 0.5, 0.26 * node_steps_a_second), 0.25);
  EXPECT_EQ(horizon_of(cheap, 0.5, 0.24 * node_steps_a_second), 0.1);
  EXPECT_EQ(horizon_of(cheap, 0.5, 0.09 * node_steps_a_second), 0.05);
}

}  // namespace
}  // namespace cloth
