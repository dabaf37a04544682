#include "recorded_start.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/scene/pin_selection.h"
#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

#include "conversions.h"
#include "recorded_topologies.h"
#include "refused_request.h"
#include "replayed_cloth.h"

namespace cloth
{
namespace
{

using StateMessage = cloth_sim::ClothState;

constexpr double two_pi = 6.283185307179586;
const rosbag::TypeQuery states("cloth_sim/ClothState");
const rosbag::TypeQuery topologies("cloth_sim/ClothTopology");

void require_one_cloth(const rosbag::Bag& bag)
{
  rosbag::View view(bag, states);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections())
  {
    topics.insert(connection->topic);
  }
  if (topics.size() != 1)
  {
    throw SceneError("it has states on " + std::to_string(topics.size()) + " topics" + (topics.empty() ? "" : ": ") +
                     joined({ topics.begin(), topics.end() }) + "; allowed: one; rosbag filter takes one out");
  }
}

StateMessage::ConstPtr state_at(const rosbag::Bag& bag, double time)
{
  rosbag::View whole(bag);
  const ros::Time begin = whole.getBeginTime();
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, states, begin + ros::Duration(time)))
  {
    if (const auto state = instance.instantiate<StateMessage>())
    {
      return state;
    }
  }
  rosbag::View all(bag, states);
  throw SceneError("no state at start_time " + format_number(time) + " s or later; allowed: up to " +
                   format_number((all.getEndTime() - begin).toSec()) + " s");
}

cloth_sim::ClothTopology::ConstPtr topology_of(const rosbag::Bag& bag, const StateMessage& state)
{
  RecordedTopologies recorded;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, topologies))
  {
    if (const auto topology = instance.instantiate<cloth_sim::ClothTopology>())
    {
      recorded.add(topology);
    }
  }
  const auto topology = recorded.find(state.topology_version, state.header.stamp);
  if (topology == nullptr)
  {
    throw SceneError("no topology version " + std::to_string(state.topology_version) +
                     ", which its states need; the first file of a recording has it");
  }
  return topology;
}

std::string grid(int rows, int cols)
{
  return std::to_string(rows) + " x " + std::to_string(cols) + " nodes";
}

void require_same_sheet(const ClothModel& recorded, const std::string& frame_id, const SceneParams& scene)
{
  const SheetProperties& sheet = scene.sheet;
  if (recorded.rows != sheet.rows || recorded.cols != sheet.cols)
  {
    throw SceneError("a cloth of " + grid(recorded.rows, recorded.cols) + " was recorded; the scene has " +
                     grid(sheet.rows, sheet.cols) + "; allowed: the same cloth.rows and cloth.cols");
  }
  const auto fits = [](double one, double other) { return std::abs(one - other) <= 1e-5 * other; };
  if (!fits(recorded.width, sheet.width) || !fits(recorded.height, sheet.height))
  {
    throw SceneError("a cloth of " + format_number(recorded.width) + " m x " + format_number(recorded.height) +
                     " m was recorded; the scene has " + format_number(sheet.width) + " m x " +
                     format_number(sheet.height) + " m; allowed: the same cloth.width and cloth.height");
  }
  if (frame_id != scene.frame_id)
  {
    throw SceneError("it was recorded in frame_id " + frame_id + "; the scene has " + scene.frame_id +
                     "; allowed: the same");
  }
}

/// Zero where none were recorded.
Vectors velocities_of(const StateMessage& state, int nodes)
{
  Vectors velocities = Vectors::Zero(nodes, 3);
  if (!state.velocities.empty())
  {
    if (state.velocities.size() != 3 * static_cast<size_t>(nodes))
    {
      throw RefusedRequest("a state has " + std::to_string(state.velocities.size()) + " velocity values for " +
                           std::to_string(nodes) + " nodes");
    }
    from_float32(state.velocities, velocities);
  }
  if (!velocities.allFinite())
  {
    throw RefusedRequest("a state with a velocity that is not finite");
  }
  return velocities;
}

/// The motion from `time` (s) on, as one that begins at 0.
Oscillation shifted(Oscillation motion, double time)
{
  motion.phase += std::fmod(two_pi * motion.frequency * time, two_pi);
  return motion;
}

std::string unused_name(std::string name, const std::vector<PinParams>& pins)
{
  while (std::any_of(pins.begin(), pins.end(), [&](const PinParams& pin) { return pin.name == name; }))
  {
    name += "_";
  }
  return name;
}

std::vector<PinParams> pins_that_hold(const std::vector<Pin>& held, const SceneParams& scene, const ClothModel& model,
                                      double time)
{
  std::set<int> left;
  for (const Pin& pin : held)
  {
    left.insert(pin.nodes.begin(), pin.nodes.end());
  }
  const auto place = [&](int node) { return std::array<int, 2>{ model.row_of(node), model.col_of(node) }; };
  std::vector<PinParams> pins;
  for (const Pin& pin : pins_of(scene.pins, model, model.rest_positions))
  {
    PinParams still_held{ pin.name, {}, {}, shifted(pin.oscillation, time) };
    for (const int node : pin.nodes)
    {
      if (left.erase(node) > 0)
      {
        still_held.nodes.push_back(place(node));
      }
    }
    if (!still_held.nodes.empty())
    {
      pins.push_back(still_held);
    }
  }
  if (!left.empty())
  {
    PinParams others{ unused_name("recorded", scene.pins), {}, {}, {} };
    std::transform(left.begin(), left.end(), std::back_inserter(others.nodes), place);
    pins.push_back(others);
  }
  return pins;
}

Plan plan_from(const rosbag::Bag& bag, SceneParams scene)
{
  require_one_cloth(bag);
  const StateMessage::ConstPtr state = state_at(bag, scene.node.start_time);
  ReplayedCloth recorded(topology_of(bag, *state), scene);
  require_same_sheet(recorded.model, state->header.frame_id, scene);
  recorded.take(*state);

  SceneStart start;
  start.state.positions = recorded.positions;
  start.state.velocities = velocities_of(*state, recorded.model.nodes());
  start.description =
      "as recorded in " + scene.node.start_bag + " at sim_time " + format_number(state->sim_time) + " s";
  scene.pins = pins_that_hold(recorded.held, scene, recorded.model, state->sim_time);
  return make_plan(scene, start);
}

}  // namespace

Plan plan_from_recording(const SceneParams& scene)
{
  const std::string fault = "start_bag: " + scene.node.start_bag + ": ";
  try
  {
    return plan_from(rosbag::Bag(scene.node.start_bag), scene);
  }
  catch (const rosbag::BagException& error)
  {
    throw SceneError(fault + error.what());
  }
  catch (const RefusedRequest& error)
  {
    throw SceneError(fault + error.what());
  }
  catch (const SceneError& error)
  {
    throw SceneError(fault + error.what());
  }
}

}  // namespace cloth
