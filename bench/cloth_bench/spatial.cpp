#include "spatial.h"

#include <limits>

namespace cloth
{
namespace
{

int refined(int index, int factor)
{
  return index >= 0 ? index * factor : (index + 1) * factor - 1;
}

int refined_count(int count, int factor)
{
  return (count - 1) * factor + 1;
}

}  // namespace

SceneParams refined(SceneParams scene, int factor)
{
  scene.sheet.rows = refined_count(scene.sheet.rows, factor);
  scene.sheet.cols = refined_count(scene.sheet.cols, factor);
  for (PinParams& pin : scene.pins)
  {
    for (std::array<int, 2>& node : pin.nodes)
    {
      node = { refined(node[0], factor), refined(node[1], factor) };
    }
  }
  return scene;
}

Errors errors_between_grids(const ClothModel& coarse_model, const std::vector<ClothState>& coarse,
                            const ClothModel& fine_model, const std::vector<ClothState>& fine, int factor)
{
  std::vector<ClothState> at_same_places;
  std::vector<int> places;
  for (int i = 0; i < coarse_model.nodes(); ++i)
  {
    places.push_back(fine_model.node(factor * coarse_model.row_of(i), factor * coarse_model.col_of(i)));
  }
  double worst = 0.0;
  for (size_t s = 0; s < fine.size(); ++s)
  {
    at_same_places.push_back({ fine[s].positions(places, Eigen::all), {}, fine[s].time });
    const Vectors difference = coarse[s].positions - at_same_places.back().positions;
    worst = std::max(worst, difference.rowwise().norm().maxCoeff());
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return { rms_distance(coarse, at_same_places), worst, none, none };
}

}  // namespace cloth
