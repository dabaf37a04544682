#include "started_scene.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// Where node `index` of `count` lies among `other_count` that span the same way.
double place_of(int index, int count, int other_count)
{
  return count == 1 ? 0.0 : static_cast<double>(index) * (other_count - 1) / (count - 1);
}

int nearest_index(int index, int count, int other_count)
{
  const int from_the_front = index >= 0 ? index : count + index;
  return static_cast<int>(std::lround(place_of(from_the_front, count, other_count)));
}

StartedScene on_grid(const StartedScene& scene, int rows, int cols)
{
  const SheetProperties& given = scene.params.sheet;
  StartedScene other = scene;
  other.params.sheet.rows = rows;
  other.params.sheet.cols = cols;
  for (PinParams& pin : other.params.pins)
  {
    for (std::array<int, 2>& node : pin.nodes)
    {
      node = { nearest_index(node[0], given.rows, rows), nearest_index(node[1], given.cols, cols) };
    }
  }
  ClothState& state = other.start.state;
  state.positions = interpolated(scene.start.state.positions, given.rows, given.cols, rows, cols);
  state.velocities = interpolated(scene.start.state.velocities, given.rows, given.cols, rows, cols);
  return other;
}

int coarser_count(int count, int factor, int fewest)
{
  const int cells = static_cast<int>(std::lround(static_cast<double>(count - 1) / factor));
  return std::clamp(cells + 1, std::min(count, fewest), count);
}

}  // namespace

Vectors interpolated(const Vectors& on_other, int other_rows, int other_cols, int rows, int cols)
{
  Vectors values(rows * cols, 3);
  for (int r = 0; r < rows; ++r)
  {
    const double y = place_of(r, rows, other_rows);
    const int above = std::min(static_cast<int>(y), std::max(0, other_rows - 2));
    const int below = std::min(above + 1, other_rows - 1);
    const double down = y - above;
    for (int c = 0; c < cols; ++c)
    {
      const double x = place_of(c, cols, other_cols);
      const int left = std::min(static_cast<int>(x), std::max(0, other_cols - 2));
      const int right = std::min(left + 1, other_cols - 1);
      const double across = x - left;
      values.row(r * cols + c) = (1.0 - down) * ((1.0 - across) * on_other.row(above * other_cols + left) +
                                                 across * on_other.row(above * other_cols + right)) +
                                 down * ((1.0 - across) * on_other.row(below * other_cols + left) +
                                         across * on_other.row(below * other_cols + right));
    }
  }
  return values;
}

StartedScene coarser(const StartedScene& scene, int factor, int fewest_nodes)
{
  return on_grid(scene, coarser_count(scene.params.sheet.rows, factor, fewest_nodes),
                 coarser_count(scene.params.sheet.cols, factor, fewest_nodes));
}

StartedScene finer(const StartedScene& scene, int factor)
{
  const SheetProperties& sheet = scene.params.sheet;
  return on_grid(scene, factor * (sheet.rows - 1) + 1, factor * (sheet.cols - 1) + 1);
}

}  // namespace cloth
