#include "cloth_sim/scene/parameter_table.h"

#include <cctype>
#include <stdexcept>

#include "cloth_sim/methods/method.h"
#include "cloth_sim/scene/pin_selection.h"
#include "parameter_kinds.h"

namespace cloth
{
namespace
{

bool is_frame(const std::string& text)
{
  return !text.empty() && text[0] != '/';
}

bool is_ros_name(const std::string& text)
{
  const auto of_a_name = [](unsigned char character) { return std::isalnum(character) || character == '_'; };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), of_a_name);
}

Parameter<PinParams> nodes_row()
{
  Parameter<PinParams> parameter;
  parameter.key = "nodes";
  parameter.type = "list of [row, col]";
  parameter.allowed = "a list of [row, col], integers, at least one";
  parameter.meaning = "which nodes, instead of `at`; negative numbers count from the end";
  parameter.set = [](const YAML::Node& value, PinParams& pin) {
    std::vector<std::array<int, 2>> nodes;
    for (const YAML::Node& node : read_list(value))
    {
      if (!node.IsSequence() || node.size() != 2)
      {
        throw std::invalid_argument("not a pair");
      }
      nodes.push_back({ read_integer(node[0]), read_integer(node[1]) });
    }
    if (nodes.empty())
    {
      throw std::invalid_argument("no node");
    }
    pin.nodes = nodes;
  };
  parameter.get = [](const PinParams& pin) {
    std::vector<std::string> pairs;
    for (const std::array<int, 2>& node : pin.nodes)
    {
      pairs.push_back("[" + std::to_string(node[0]) + ", " + std::to_string(node[1]) + "]");
    }
    return "[" + joined(pairs) + "]";
  };
  return parameter;
}

std::vector<std::string> method_words()
{
  std::vector<std::string> words{ "auto" };
  for (const MethodRow& row : methods())
  {
    words.push_back(row.name);
  }
  return words;
}

Parameter<SceneParams> for_node(Parameter<SceneParams> parameter)
{
  parameter.node_only = true;
  return parameter;
}

Parameter<SceneParams> live(Parameter<SceneParams> parameter)
{
  parameter.live = true;
  return parameter;
}

/// A file. None is an empty path in the scene, and the word where it is written.
template <typename Access>
Parameter<SceneParams> path_or_none(const char* key, const char* meaning, Access access)
{
  constexpr const char* none = "none";
  Parameter<SceneParams> parameter;
  parameter.key = key;
  parameter.type = "path";
  parameter.allowed = "an absolute path, or none";
  parameter.meaning = meaning;
  parameter.set = [=](const YAML::Node& value, SceneParams& target) {
    const std::string text = value.IsScalar() ? value.Scalar() : std::string();
    if (text != none && (text.empty() || text[0] != '/'))
    {
      throw std::invalid_argument("not an absolute path");
    }
    access(target) = text == none ? std::string() : text;
  };
  parameter.get = [=](const SceneParams& target) {
    const std::string& text = access(target);
    return text.empty() ? std::string(none) : text;
  };
  return parameter;
}

std::vector<Parameter<SceneParams>> make_table()
{
  using Scene = RowsOf<SceneParams>;
  return {
    Scene::text("frame_id", is_frame, "a tf frame: not empty, no leading slash",
                "the frame in which everything else is given, z up", CLOTH_MEMBER(frame_id)),
    live(Scene::vector("gravity", "m/s2", any, "acceleration of a free fall", CLOTH_MEMBER(gravity))),

    Scene::integer("cloth.rows", 1, 4096, "nodes down the sheet; 1 is a chain across", CLOTH_MEMBER(sheet.rows)),
    Scene::integer("cloth.cols", 1, 4096, "nodes across the sheet; 1 is a chain down; two nodes at least in all",
                   CLOTH_MEMBER(sheet.cols)),
    Scene::number("cloth.width", "m", positive,
                  "at rest, between first and last column; of a chain down: its strip's width",
                  CLOTH_MEMBER(sheet.width)),
    Scene::number("cloth.height", "m", positive,
                  "at rest, between first and last row; of a chain across: its strip's width",
                  CLOTH_MEMBER(sheet.height)),
    Scene::number("cloth.mass", "kg", positive, "of the whole sheet", CLOTH_MEMBER(sheet.mass)),
    Scene::choice("cloth.mass_lumping", { "area", "uniform" },
                  "how mass and area are shared out to the nodes: by tributary area, or equally as Provot does",
                  CLOTH_MEMBER(sheet.mass_lumping)),
    Scene::vector("cloth.position", "m", any, "middle of the top edge (row 0) at the start",
                  CLOTH_MEMBER(start.position)),
    Scene::vector("cloth.rpy", "rad", any,
                  "roll, pitch, yaw; at zero the sheet hangs in the x-z plane, column along +x, row along -z",
                  CLOTH_MEMBER(start.rpy)),
    Scene::vector("cloth.velocity", "m/s", any, "of every free node at time 0", CLOTH_MEMBER(start.velocity)),
    Scene::vector("cloth.initial_stretch", "", positive,
                  "factors on the start positions, across and down; rest lengths stay",
                  CLOTH_MEMBER(start.initial_stretch)),
    Scene::choice("cloth.start", { "flat", "catenary", "settled" },
                  "the shape at the start: flat; hanging in catenaries between the pins; at rest in still air",
                  CLOTH_MEMBER(start.shape)),
    Scene::number("cloth.ripple", "m", any,
                  "amplitude of a smooth asymmetric displacement along the normal at the start",
                  CLOTH_MEMBER(start.ripple)),

    live(Scene::number("springs.structural.stiffness", "N/m", not_negative,
                       "against stretch; 0 leaves these springs out", CLOTH_MEMBER(sheet.structural.stiffness))),
    live(Scene::number("springs.structural.damping", "N s/m", not_negative, "internal damping of structural springs",
                       CLOTH_MEMBER(sheet.structural.damping))),
    live(Scene::number("springs.shear.stiffness", "N/m", not_negative, "against shear; 0 leaves these springs out",
                       CLOTH_MEMBER(sheet.shear.stiffness))),
    live(Scene::number("springs.shear.damping", "N s/m", not_negative, "internal damping of shear springs",
                       CLOTH_MEMBER(sheet.shear.damping))),
    live(Scene::number("springs.flex.stiffness", "N/m", not_negative, "against bending; 0 leaves these springs out",
                       CLOTH_MEMBER(sheet.flex.stiffness))),
    live(Scene::number("springs.flex.damping", "N s/m", not_negative, "internal damping of flex springs",
                       CLOTH_MEMBER(sheet.flex.damping))),

    live(Scene::number("strain_limit.max_strain", "", not_negative,
                       "structural and shear springs are not stretched beyond this; 0: no limit",
                       CLOTH_MEMBER(strain_limit.max_strain))),
    live(Scene::integer("strain_limit.sweeps", 1, 100000, "most passes over the springs after a step",
                        CLOTH_MEMBER(strain_limit.sweeps))),
    Scene::choice("strain_limit.solver", { "tensions", "sweeps" },
                  "how springs are shortened: by tensions that carry over from step to step, in few passes, or by "
                  "Provot's plain sweeps",
                  CLOTH_MEMBER(strain_limit.solver)),

    live(Scene::number("air.viscous_damping", "N s/m per m2", not_negative, "drag of the air at rest, in any direction",
                       CLOTH_MEMBER(air.viscous_damping))),
    live(
        Scene::number("air.wind_coupling", "N s/m per m2", not_negative,
                      "how the air's velocity relative to the sheet acts along its normals; 0: no normals are computed",
                      CLOTH_MEMBER(air.wind_coupling))),
    live(Scene::vector("air.wind", "m/s", any, "velocity of the air: the way it moves", CLOTH_MEMBER(air.wind))),
    live(Scene::number(
        "air.gusts.strength", "m/s", not_negative,
        "root mean square of each component of smooth gusts, which are added to the wind, also to that of "
        "~wind; 0: none",
        CLOTH_MEMBER(air.gusts.strength))),
    live(Scene::number("air.gusts.time_scale", "s", Range{ 1e-3, true }, "how long a gust lasts",
                       CLOTH_MEMBER(air.gusts.time_scale))),
    live(Scene::integer("air.gusts.seed", 0, 2147483647, "the same seed is the same gusts at the same simulated time",
                        CLOTH_MEMBER(air.gusts.seed))),

    live(Scene::choice("solver.method", method_words(), "time-stepping method; auto: trial runs at the start find the cheapest that meets solver.tolerance",
                       CLOTH_MEMBER(solver.method))),
    live(Scene::number(
        "solver.time_step", "s", Range{ 1e-9, true, infinity, true },
        "largest step; 0: 0.9 of the method's stability limit as the cloth deforms, 1/240 where there is no limit; "
        "dopri5: the largest step, 0: none",
        CLOTH_MEMBER(solver.time_step))),
    live(Scene::number("solver.tolerance", "m", Range{ 1e-12, true },
                       "auto: what the motion may err by, as a root mean square over all nodes and the first second; dopri5: bounds the "
                       "estimated position error of a step",
                       CLOTH_MEMBER(solver.tolerance))),
    live(Scene::integer("solver.iterations", 1, 10000,
                        "projective: local-global iterations a step; xpbd: substeps a step",
                        CLOTH_MEMBER(solver.iterations))),
    live(Scene::number(
        "solver.compliance", "", unit_interval,
        "xpbd: factor on the springs' compliance 1/k; 1: stiffness means the same as in every other method, "
        "0: position-based dynamics",
        CLOTH_MEMBER(solver.compliance))),
    Scene::choice("solver.precision", { "double", "mixed" },
                  "xpbd: what its substeps compute in; mixed: in single precision, on one thread, what a step adds to "
                  "a state in double",
                  CLOTH_MEMBER(solver.precision)),
    Scene::integer(
        "solver.threads", 0, 64,
        "the most threads that share a step, where the sheet is large enough to gain by it; 0: 2, or as many "
        "as this machine has if fewer; the result is the same to the last bit for any number",
        CLOTH_MEMBER(solver.threads)),
    Scene::choice(
        "plan", { "auto", "full" },
        "auto: what does not change the answer by a quarter of solver.tolerance is left out, where solver.method "
        "is auto too; full: all that the scene describes is modelled",
        CLOTH_MEMBER(plan)),

    for_node(live(Scene::number("rate", "Hz", Range{ 1e-3, true, 1000.0 }, "ticks a second, one published mesh each",
                                CLOTH_MEMBER(node.rate)))),
    for_node(
        live(Scene::number("real_time_factor", "", not_negative, "simulated seconds in a second; 0: as fast as it can",
                           CLOTH_MEMBER(node.real_time_factor)))),
    for_node(Scene::choice("clock_mode", { "follow", "master" },
                           "follow: paced by ROS time; master: publishes /clock, paced by wall time, one message a "
                           "tick; rate and real_time_factor count by wall time then",
                           CLOTH_MEMBER(node.clock_mode))),
    for_node(Scene::choice("start_paused", { "false", "true" }, "whether time stands still at the start",
                           CLOTH_MEMBER(node.start_paused))),
    for_node(
        path_or_none("start_bag",
                     "a recording of ~state and ~topology of one cloth, from a state of which the cloth goes on; the "
                     "start that the scene describes is not used then",
                     CLOTH_MEMBER(node.start_bag))),
    for_node(Scene::number("start_time", "s", Range{ 0.0, true, 1e9 },
                           "from the beginning of the recording to that state, the first from then on",
                           CLOTH_MEMBER(node.start_time))),
    for_node(Scene::number("tf_pins.top_speed", "m/s", positive,
                           "the fastest, in simulated time, that a pin follows the tf frame that carries it; where the "
                           "frame jumps it catches up at this speed",
                           CLOTH_MEMBER(node.tf_pins.top_speed))),
    for_node(Scene::number("tf_pins.max_age", "s", not_negative,
                           "a pin holds its place while the latest transform of its frame is older, or farther in the "
                           "future; 0: of any age will do",
                           CLOTH_MEMBER(node.tf_pins.max_age))),
    for_node(
        Scene::number("wind_timeout", "s", not_negative,
                      "so long after the last message on ~wind, in ROS time, the scene's wind blows again; 0: never",
                      CLOTH_MEMBER(node.wind_timeout))),
    for_node(Scene::choice("display.colouring", { "fabric", "strain" },
                           "colour of the mesh: the fabric's, or the strain of the springs at each node",
                           CLOTH_MEMBER(node.colouring))),
    for_node(Scene::vector("display.fabric_colour", "", unit_interval, "red, green, blue",
                           CLOTH_MEMBER(node.fabric_colour))),
  };
}

std::vector<Parameter<PinParams>> make_pin_table()
{
  using Pin = RowsOf<PinParams>;
  return {
    Pin::text("name", is_ros_name, "a ROS name: a letter, then letters, digits and _; each name once",
              "how messages call the pin; must be given", CLOTH_MEMBER(name)),
    Pin::choice("at", pin_places(), "which nodes", CLOTH_MEMBER(at)),
    nodes_row(),
    Pin::vector("motion.amplitude", "m", any,
                "A in the way A (sin(2 pi f t + phase) - sin(phase)) from where the pin starts",
                CLOTH_MEMBER(motion.amplitude)),
    Pin::number("motion.frequency", "Hz", not_negative, "f", CLOTH_MEMBER(motion.frequency)),
    Pin::number("motion.phase", "rad", any, "phase", CLOTH_MEMBER(motion.phase)),
  };
}

}  // namespace

const std::vector<Parameter<SceneParams>>& parameter_table()
{
  static const std::vector<Parameter<SceneParams>> table = make_table();
  return table;
}

const std::vector<Parameter<PinParams>>& pin_table()
{
  static const std::vector<Parameter<PinParams>> table = make_pin_table();
  return table;
}

}  // namespace cloth
