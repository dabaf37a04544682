#include "cloth_sim/scene/pin_selection.h"

#include <algorithm>
#include <map>
#include <utility>

#include "cloth_sim/scene/scene_reader.h"

namespace cloth
{
namespace
{

struct Place
{
  const char* name;
  bool (*contains)(const ClothModel& model, int row, int col);
};

bool top(const ClothModel& /*model*/, int row, int /*col*/)
{
  return row == 0;
}

bool bottom(const ClothModel& model, int row, int /*col*/)
{
  return row == model.rows - 1;
}

bool left(const ClothModel& /*model*/, int /*row*/, int col)
{
  return col == 0;
}

bool right(const ClothModel& model, int /*row*/, int col)
{
  return col == model.cols - 1;
}

template <bool (*First)(const ClothModel&, int, int), bool (*Second)(const ClothModel&, int, int)>
bool both(const ClothModel& model, int row, int col)
{
  return First(model, row, col) && Second(model, row, col);
}

bool border(const ClothModel& model, int row, int col)
{
  return top(model, row, col) || bottom(model, row, col) || left(model, row, col) || right(model, row, col);
}

constexpr Place places[] = {
  { "top_left", both<top, left> },
  { "top_right", both<top, right> },
  { "bottom_left", both<bottom, left> },
  { "bottom_right", both<bottom, right> },
  { "top_edge", top },
  { "bottom_edge", bottom },
  { "left_edge", left },
  { "right_edge", right },
  { "border", border },
};

bool move_alike(const Oscillation& one, const Oscillation& other)
{
  return one.amplitude == other.amplitude && one.frequency == other.frequency && one.phase == other.phase;
}

std::string in_brackets(int row, int col)
{
  return "[" + std::to_string(row) + ", " + std::to_string(col) + "]";
}

/// An index that may count from the end; the result may be out of range.
int from_either_end(int index, int count)
{
  return index < 0 ? index + count : index;
}

std::vector<int> listed_nodes(const PinParams& pin, const ClothModel& model, const std::string& path)
{
  std::vector<int> nodes;
  for (const std::array<int, 2>& listed : pin.nodes)
  {
    const int row = from_either_end(listed[0], model.rows);
    const int col = from_either_end(listed[1], model.cols);
    if (row < 0 || row >= model.rows || col < 0 || col >= model.cols)
    {
      throw SceneError(path + ".nodes has " + in_brackets(listed[0], listed[1]) + "; allowed: rows -" +
                       std::to_string(model.rows) + " to " + std::to_string(model.rows - 1) + ", columns -" +
                       std::to_string(model.cols) + " to " + std::to_string(model.cols - 1));
    }
    const int node = model.node(row, col);
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end())
    {
      nodes.push_back(node);
    }
  }
  return nodes;
}

std::vector<int> nodes_at(const Place& place, const ClothModel& model)
{
  std::vector<int> nodes;
  for (int i = 0; i < model.nodes(); ++i)
  {
    if (place.contains(model, model.row_of(i), model.col_of(i)))
    {
      nodes.push_back(i);
    }
  }
  return nodes;
}

}  // namespace

const std::vector<std::string>& pin_places()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Place& place : places)
    {
      list.push_back(place.name);
    }
    return list;
  }();
  return names;
}

std::vector<int> nodes_of(const PinParams& pin, const ClothModel& model, const std::string& path)
{
  for (const Place& place : places)
  {
    if (pin.at == place.name)
    {
      return nodes_at(place, model);
    }
  }
  return listed_nodes(pin, model, path);
}

std::vector<Pin> pins_of(const std::vector<PinParams>& params, const ClothModel& model, const Vectors& positions)
{
  std::vector<Pin> pins;
  std::map<int, const PinParams*> holders;
  for (size_t p = 0; p < params.size(); ++p)
  {
    const std::string path = "pins[" + std::to_string(p) + "]";
    Pin pin{ params[p].name, {}, {}, params[p].motion, {} };
    for (const int node : nodes_of(params[p], model, path))
    {
      const auto [holder, is_free] = holders.insert({ node, &params[p] });
      if (is_free)
      {
        pin.nodes.push_back(node);
      }
      else if (!move_alike(holder->second->motion, params[p].motion))
      {
        throw SceneError(path + " (" + params[p].name + ") holds node " +
                         in_brackets(model.row_of(node), model.col_of(node)) + ", which " + holder->second->name +
                         " holds too and moves otherwise; allowed: one motion a node");
      }
    }
    if (!pin.nodes.empty())
    {
      pin.held = positions(pin.nodes, Eigen::all);
      pins.push_back(std::move(pin));
    }
  }
  return pins;
}

}  // namespace cloth
