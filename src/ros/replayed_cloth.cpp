#include "replayed_cloth.h"

#include <string>

#include "conversions.h"
#include "recorded_model.h"
#include "refused_request.h"
#include "scene_display.h"

namespace cloth
{
namespace
{

void require_size(const cloth_sim::ClothState& state, const ClothModel& model)
{
  const auto nodes = static_cast<size_t>(model.nodes());
  if (state.positions.size() != 3 * nodes || state.flags.size() != nodes)
  {
    throw RefusedRequest("a state of " + std::to_string(state.positions.size()) + " position values and " +
                         std::to_string(state.flags.size()) + " flags does not fit its topology version " +
                         std::to_string(state.topology_version) + " of " + std::to_string(model.rows) + " x " +
                         std::to_string(model.cols) + " nodes");
  }
}

std::vector<Pin> held_by(const std::vector<std::uint8_t>& flags)
{
  Pin pin;
  pin.name = "pins";
  for (size_t node = 0; node < flags.size(); ++node)
  {
    if ((flags[node] & cloth_sim::ClothState::PINNED) != 0)
    {
      pin.nodes.push_back(static_cast<int>(node));
    }
  }
  return pin.nodes.empty() ? std::vector<Pin>{} : std::vector<Pin>{ pin };
}

}  // namespace

ReplayedCloth::ReplayedCloth(const cloth_sim::ClothTopology::ConstPtr& its_topology, const SceneParams& scene)
  : topology(its_topology)
  , model(recorded_model(*topology, scene.sheet))
  , mesh(mesh_marker_of(model, topology->header.frame_id, scene))
  , springs(model, topology->header.frame_id)
  , pins(model, topology->header.frame_id)
{
}

void ReplayedCloth::take(const cloth_sim::ClothState& state)
{
  require_size(state, model);
  Vectors next;
  from_float32(state.positions, next);
  if (!next.allFinite())
  {
    throw RefusedRequest("a state with a position that is not finite");
  }
  positions.swap(next);
  held = held_by(state.flags);
}

void ReplayedCloth::forget_shown_pins()
{
  pins = PinMarkers(model, topology->header.frame_id);
}

}  // namespace cloth
