#include "started_scene.h"

#include "scene/scene_text.h"
#include "support.h"

namespace cloth
{
namespace
{

StartedScene started(const std::string& yaml)
{
  const SceneParams params = scene_of(yaml);
  return { params, scene_start(params, make_sheet(params.sheet)) };
}

TEST(Interpolated, IsExactForWhatIsLinearAlongBothSides)
{
  const int rows = 7;
  const int cols = 5;
  const auto value = [](double y, double x) { return Eigen::RowVector3d(1.0 + 2.0 * x, y - x, 3.0 * x * y); };
  Vectors values(rows * cols, 3);
  for (int i = 0; i < rows * cols; ++i)
  {
    values.row(i) = value((i / cols) / (rows - 1.0), (i % cols) / (cols - 1.0));
  }
  const int other_rows = 4;
  const int other_cols = 9;
  const Vectors on_other = interpolated(values, rows, cols, other_rows, other_cols);
  for (int i = 0; i < other_rows * other_cols; ++i)
  {
    const Eigen::RowVector3d exact =
        value((i / other_cols) / (other_rows - 1.0), (i % other_cols) / (other_cols - 1.0));
    EXPECT_LT((on_other.row(i) - exact).norm(), 1e-14) << i;
  }
}

TEST(Coarser, HasTheSameSheetWithLongerCells)
{
  const StartedScene scene = started("{cloth: {rows: 21, cols: 41, initial_stretch: [0.9, 1.1], velocity: [1, 2, 3]}}");
  const StartedScene coarse = coarser(scene, 4, 2);
  EXPECT_EQ(coarse.params.sheet.rows, 6);
  EXPECT_EQ(coarse.params.sheet.cols, 11);
  EXPECT_EQ(coarse.params.sheet.mass, scene.params.sheet.mass);
  const StartedScene flat = started("{cloth: {rows: 6, cols: 11, initial_stretch: [0.9, 1.1], velocity: [1, 2, 3]}}");
  EXPECT_LT((coarse.start.state.positions - flat.start.state.positions).norm(), 1e-13);
  EXPECT_LT((coarse.start.state.velocities - flat.start.state.velocities).norm(), 1e-13);
}

TEST(Coarser, KeepsAtLeastSoManyNodesOfASideThatHasThem)
{
  const StartedScene coarse = coarser(started("{cloth: {rows: 12, cols: 1}}"), 8, 8);
  EXPECT_EQ(coarse.params.sheet.rows, 8);
  EXPECT_EQ(coarse.params.sheet.cols, 1);
}

TEST(Coarser, HoldsTheNearestNodes)
{
  const StartedScene coarse =
      coarser(started("{cloth: {rows: 21, cols: 21}, pins: [{name: a, nodes: [[5, -1], [-1, 0], [8, 9]]}]}"), 2, 2);
  const std::vector<std::array<int, 2>> nearest{ { 3, 10 }, { 10, 0 }, { 4, 5 } };
  EXPECT_EQ(coarse.params.pins[0].nodes, nearest);
}

TEST(Finer, HasAllNodesOfTheSheetWhereTheyAre)
{
  const StartedScene scene = started("{cloth: {rows: 4, cols: 6, ripple: 0.02}}");
  const StartedScene fine = finer(scene, 3);
  EXPECT_EQ(fine.params.sheet.rows, 10);
  EXPECT_EQ(fine.params.sheet.cols, 16);
  const Vectors back = interpolated(fine.start.state.positions, 10, 16, 4, 6);
  EXPECT_LT((back - scene.start.state.positions).norm(), 1e-14);
}

}  // namespace
}  // namespace cloth
