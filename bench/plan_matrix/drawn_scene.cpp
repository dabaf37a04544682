#include "drawn_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <yaml-cpp/yaml.h>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/scene_reader.h"
#include "draw.h"

namespace cloth
{
namespace
{

constexpr int fewest_per_side = 8;
constexpr double pi = 3.14159265358979323846;

/// The side that is longer is drawn so that each doubling is as likely as any other.
void draw_grid(Draw& draw, int most_per_side, SheetProperties& sheet)
{
  const int longer = static_cast<int>(std::lround(draw.logarithmic(fewest_per_side, most_per_side)));
  const int shorter = draw.whole(std::max(fewest_per_side, longer / 2), longer);
  const bool is_tall = draw.once_in(1, 2);
  sheet.rows = is_tall ? longer : shorter;
  sheet.cols = is_tall ? shorter : longer;
  const double spacing = draw.logarithmic(0.5, 2.0) / longer;
  sheet.height = spacing * (sheet.rows - 1);
  sheet.width = spacing * (sheet.cols - 1) * draw.even(0.8, 1.25);
  sheet.mass = draw.logarithmic(0.05, 1.0) * sheet.width * sheet.height;
}

/// Damping is drawn as a part of that which is critical for one spring between two nodes of the sheet.
void draw_springs(Draw& draw, SheetProperties& sheet)
{
  const double node_mass = sheet.mass / ((sheet.rows - 1) * (sheet.cols - 1));
  const double damping_ratio = draw.once_in(1, 8) ? 0.0 : draw.logarithmic(0.02, 0.7);
  const auto springs = [&](double stiffness, double ratio) {
    return SpringProperties{ stiffness, ratio * 2.0 * std::sqrt(stiffness * node_mass) };
  };
  const double stiffness = draw.logarithmic(1e2, 1e5);
  sheet.structural = springs(stiffness, damping_ratio);
  sheet.shear = springs(draw.once_in(1, 8) ? 0.0 : stiffness * draw.logarithmic(0.1, 1.0), damping_ratio);
  const double flex = draw.once_in(1, 6) ? 0.0 : stiffness * draw.logarithmic(1e-3, 0.3);
  sheet.flex = springs(flex, draw.once_in(1, 2) ? damping_ratio : 0.0);
}

/// Mostly level; no longer than 1.5. Braces settle the order of the draws.
Eigen::Vector3d drawn_direction(Draw& draw)
{
  return Eigen::Vector3d{ draw.even(-1.0, 1.0), draw.even(-1.0, 1.0), draw.even(-0.3, 0.3) };
}

void draw_air(Draw& draw, AirProperties& air)
{
  air.viscous_damping = draw.once_in(1, 8) ? 0.0 : draw.logarithmic(0.1, 3.0);
  air.wind_coupling = draw.once_in(3, 10) ? 0.0 : draw.logarithmic(0.1, 3.0);
  const double speed = draw.once_in(2, 5) ? 0.0 : draw.logarithmic(0.5, 8.0);
  air.wind = speed * drawn_direction(draw);
  if (draw.once_in(1, 5))
  {
    air.gusts = { draw.logarithmic(0.3, 2.0), draw.logarithmic(0.1, 1.0), draw.whole(1, 1000) };
  }
}

/// Half of those that move begin at rest, the others at full speed.
Oscillation drawn_motion(Draw& draw)
{
  const double size = draw.logarithmic(0.01, 0.1);
  return { size * drawn_direction(draw), draw.logarithmic(0.3, 2.0), draw.once_in(1, 2) ? 0.5 * pi : 0.0 };
}

std::vector<PinParams> drawn_pins(Draw& draw)
{
  const char* const one_place[] = { "top_left", "top_edge", "left_edge", "top_edge" };
  std::vector<PinParams> pins;
  if (draw.once_in(1, 2))
  {
    pins = { { "left", "top_left", {}, {} }, { "right", "top_right", {}, {} } };
  }
  else
  {
    pins = { { "held", one_place[draw.whole(0, 3)], {}, {} } };
  }
  for (PinParams& pin : pins)
  {
    if (draw.once_in(2, 5))
    {
      pin.motion = drawn_motion(draw);
    }
  }
  return pins;
}

/// Half of the sheets hang nearly as they will hang, the others fall.
void draw_start(Draw& draw, const SheetProperties& sheet, StartParams& start)
{
  const double lift = draw.once_in(1, 2) ? draw.even(-0.3, 0.3) : draw.even(0.5, 1.3);
  start.rpy = { lift, 0.0, draw.even(-pi, pi) };
  start.ripple = std::min(sheet.width, sheet.height) * draw.logarithmic(0.005, 0.05);
}

std::string text_in(const YAML::Node& tree)
{
  YAML::Emitter emitter;
  emitter << tree;
  return std::string(emitter.c_str()) + "\n";
}

YAML::Node tree_of(const PinParams& pin)
{
  YAML::Node tree(YAML::NodeType::Map);
  for (const Parameter<PinParams>& parameter : pin_table())
  {
    if (parameter.key != "nodes" || !pin.nodes.empty())
    {
      override_key(tree, parameter.key, parameter.get(pin));
    }
  }
  return tree;
}

}  // namespace

Half half_of(int number)
{
  return number % 2 == 0 ? Half::development : Half::held_out;
}

const char* name_of(Half half)
{
  return half == Half::development ? "development" : "held_out";
}

std::string name_of(const SceneNumber& scene)
{
  char text[32];
  std::snprintf(text, sizeof text, "%03d", scene.number);
  return scene.attempt == 0 ? text : text + ("_" + std::to_string(scene.attempt));
}

SceneParams drawn_scene(const SceneNumber& scene)
{
  Draw draw(scene.seed, static_cast<std::uint64_t>(scene.number), static_cast<std::uint64_t>(scene.attempt));
  SceneParams params;
  draw_grid(draw, scene.most_per_side, params.sheet);
  draw_springs(draw, params.sheet);
  draw_air(draw, params.air);
  params.pins = drawn_pins(draw);
  draw_start(draw, params.sheet, params.start);
  params.strain_limit.max_strain = 0.0;
  params.solver.threads = 1;
  return params;
}

std::string yaml_of(const SceneParams& scene)
{
  YAML::Node tree(YAML::NodeType::Map);
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    if (!parameter.node_only)
    {
      override_key(tree, parameter.key, parameter.get(scene));
    }
  }
  for (const PinParams& pin : scene.pins)
  {
    tree["pins"].push_back(tree_of(pin));
  }
  return text_in(tree);
}

}  // namespace cloth
