#include "cloth_sim/scene/scene_start.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/springs.h"
#include "cloth_sim/scene/catenary_start.h"
#include "cloth_sim/scene/pin_selection.h"
#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/start_state.h"
#include "cloth_sim/simulation/statics.h"

namespace cloth
{
namespace
{

/// A sheet is at rest where no net force is above this part of its weight.
constexpr double rest_tolerance = 1e-8;
/// A structural or shear spring that starts with more strain than this is overstretched.
constexpr double most_start_strain = 0.1;
/// Relaxed until no net force is above this part of the weight.
constexpr double relaxed_tolerance = 0.03;
/// Most passes of the strain limit over an overstretched sheet.
constexpr int start_sweeps = 1000;

[[noreturn]] void refuse(const SceneParams& scene, const std::string& reason)
{
  throw SceneError("cloth.start is " + scene.start.shape + ", but " + reason);
}

/// What a shape is made from: the sheet as it starts flat, and the pins that hold it there.
struct FlatSheet
{
  FlatSheet(const SceneParams& scene, const ClothModel& model)
    : state(start_state(scene.start, model)), pins(model.nodes())
  {
    for (const Pin& pin : pins_of(scene.pins, model, state.positions))
    {
      pins.hold(pin);
      pinned.insert(pinned.end(), pin.nodes.begin(), pin.nodes.end());
    }
    std::sort(pinned.begin(), pinned.end());
  }

  ClothState state;
  Pins pins;
  std::vector<int> pinned;
};

/// Why the sheet cannot hang in catenaries; empty where it can.
std::string obstacle_to_catenaries(const SceneParams& scene, const ClothModel& model, const FlatSheet& flat)
{
  if (scene.gravity.isZero(0.0))
  {
    return "gravity is 0, and nothing hangs without it; set gravity, or take cloth.start: flat";
  }
  if (flat.pinned.size() < 2)
  {
    return "a curve needs two pinned nodes, and the scene has " + std::to_string(flat.pinned.size()) +
           "; add pins, or take cloth.start: flat";
  }
  if (!has_slack(model, flat.pinned, flat.state.positions))
  {
    return "no two of the " + std::to_string(flat.pinned.size()) +
           " pinned nodes have slack between them; draw them together with cloth.initial_stretch below 1, or take "
           "cloth.start: flat";
  }
  return {};
}

/// Relaxes a sheet some spring of which starts overstretched: springs and gravity roughly, then the strain limit.
/// False: none does.
bool relax(const SceneParams& scene, const ClothModel& model, const FlatSheet& flat, Vectors& positions)
{
  const double limit = scene.strain_limit.max_strain;
  const double most = limit > 0.0 ? std::min(limit, most_start_strain) : most_start_strain;
  if (max_strain(model, positions) <= most || !holds_every_node(model, flat.pins))
  {
    return false;
  }
  Vectors relaxed = positions;
  if (settle(model, flat.pins, scene.gravity, 0.0, relaxed_tolerance, relaxed).converged)
  {
    positions = relaxed;
  }
  if (limit > 0.0)
  {
    ClothState state{ positions, Vectors::Zero(model.nodes(), 3), 0.0 };
    StrainLimit(model, { limit, start_sweeps, LimitSolver::plain_sweeps }).apply(model, flat.pins, 1.0, state);
    positions = state.positions;
  }
  return true;
}

SceneStart catenary_start(const SceneParams& scene, const ClothModel& model, const FlatSheet& flat)
{
  SceneStart start{ flat.state, "catenary, between " + std::to_string(flat.pinned.size()) + " pinned nodes", false };
  start.state.positions = hung_in_catenaries(scene.start, model, flat.pinned, scene.gravity.normalized());
  start.description += relax(scene, model, flat, start.state.positions) ? ", relaxed" : "";
  return start;
}

/// Two digits.
std::string in_short(double number)
{
  std::ostringstream text;
  text << std::setprecision(2) << number;
  return text.str();
}

std::string cure_of_unrest(const SceneParams& scene, const StaticsReport& report)
{
  if (scene.strain_limit.max_strain == 0.0)
  {
    return "take cloth.start: flat";
  }
  return "some spring is strained by " + in_short(report.excess) +
         " more than strain_limit.max_strain; raise it, bring the pins nearer to each other, or take cloth.start: flat";
}

SceneStart settled_start(const SceneParams& scene, const ClothModel& model, const FlatSheet& flat)
{
  if (!scene.gravity.isZero(0.0) && flat.pinned.empty())
  {
    refuse(scene, "the sheet has no pins and falls for ever; add pins, or take cloth.start: flat");
  }
  if (!scene.gravity.isZero(0.0) && !holds_every_node(model, flat.pins))
  {
    refuse(scene,
           "no springs join some nodes to a pin, and they fall for ever; add springs, or take cloth.start: flat");
  }
  const bool hangs = obstacle_to_catenaries(scene, model, flat).empty();
  ClothState state = hangs ? catenary_start(scene, model, flat).state : flat.state;
  const StaticsReport report =
      settle(model, flat.pins, scene.gravity, scene.strain_limit.max_strain, rest_tolerance, state.positions);
  const std::string force = "the largest net force on a node is " + in_short(report.residual) +
                            (scene.gravity.isZero(0.0) ? " of the largest k l0" : " of the weight");
  const std::string iterations = std::to_string(report.iterations) + " iterations";
  if (!report.converged)
  {
    refuse(scene, "no rest was found in " + iterations + ": " + force + ", allowed is " + in_short(rest_tolerance) +
                      "; " + cure_of_unrest(scene, report));
  }
  return { state, "settled, from " + std::string(hangs ? "catenary" : "flat") + " in " + iterations + "; " + force,
           true };
}

}  // namespace

SceneStart scene_start(const SceneParams& scene, const ClothModel& model)
{
  const FlatSheet flat(scene, model);
  if (scene.start.shape == "catenary")
  {
    const std::string obstacle = obstacle_to_catenaries(scene, model, flat);
    if (!obstacle.empty())
    {
      refuse(scene, obstacle);
    }
    return catenary_start(scene, model, flat);
  }
  if (scene.start.shape == "settled")
  {
    return settled_start(scene, model, flat);
  }
  return { flat.state, "flat", false };
}

}  // namespace cloth
