#include "step_costs.h"

#include <fstream>

#include "in_a_folder.h"
#include "support.h"

namespace cloth
{
namespace
{

class StepCostsInAFolder : public InAFolder
{
protected:
  static StartedScene sheet(int nodes)
  {
    SceneParams params;
    params.sheet.rows = params.sheet.cols = nodes;
    return { params, scene_start(params, make_sheet(params.sheet)) };
  }
};

TEST_F(StepCostsInAFolder, AreMeasuredOnceAndKept)
{
  const std::string file = path("below/costs.txt");
  StepCosts first(file);
  const double verlet = first.of_a_step(sheet(8), { "velocity_verlet" });
  const double euler = first.of_a_step(sheet(8), { "implicit_euler", 1e-3 });
  EXPECT_GT(verlet, 0.0);
  EXPECT_GT(euler, 0.0);
  EXPECT_EQ(first.of_a_step(sheet(8), { "velocity_verlet" }), verlet);
  StepCosts second(file);
  EXPECT_EQ(second.of_a_step(sheet(8), { "velocity_verlet" }), verlet);
  EXPECT_EQ(second.of_a_step(sheet(8), { "implicit_euler", 1e-3 }), euler);
}

TEST_F(StepCostsInAFolder, OfAFileThatCannotBeReadAreMeasuredAnew)
{
  const std::string file = path("costs.txt");
  std::ofstream(file) << "velocity_verlet 8 x 8: unfinished\nnothing";
  StepCosts costs(file);
  EXPECT_GT(costs.of_a_step(sheet(8), { "velocity_verlet" }), 0.0);
  EXPECT_EQ(StepCosts(file).of_a_step(sheet(8), { "velocity_verlet" }),
            costs.of_a_step(sheet(8), { "velocity_verlet" }));
}

TEST_F(StepCostsInAFolder, AreMeasuredAlsoWhereNothingCanBeKept)
{
  std::ofstream(path("file")) << "no folder";
  StepCosts costs(path("file") + "/costs.txt");
  EXPECT_GT(costs.of_a_step(sheet(8), { "velocity_verlet" }), 0.0);
}

}  // namespace
}  // namespace cloth
