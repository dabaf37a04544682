#include "scene_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"
#include "own_solver.h"
#include "reference_file.h"
#include "replaced_file.h"

namespace cloth
{
namespace
{

double node_steps_of(const Problem& problem)
{
  const Simulation simulation = simulation_of(problem, "velocity_verlet", 1.0, {});
  return simulation.model().nodes() * problem.horizon / simulation.stability_limit();
}

int moving(const std::vector<PinParams>& pins)
{
  return static_cast<int>(
      std::count_if(pins.begin(), pins.end(), [](const PinParams& pin) { return !pin.motion.amplitude.isZero(0.0); }));
}

std::string places_of(const std::vector<PinParams>& pins)
{
  std::vector<std::string> places;
  for (const PinParams& pin : pins)
  {
    places.push_back(pin.at);
  }
  return joined(places, "+");
}

std::string without_commas(std::string text)
{
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

std::string line_of(const DrawnRow& row, Half half)
{
  const SheetProperties& sheet = row.params.sheet;
  const AirProperties& air = row.params.air;
  std::vector<std::string> fields{ name_of(row.number), name_of(half), row.motion.accepted ? "yes" : "no",
                                   std::to_string(sheet.rows), std::to_string(sheet.cols) };
  for (const double number :
       { sheet.width, sheet.height, sheet.mass, sheet.structural.stiffness, sheet.shear.stiffness, sheet.flex.stiffness,
         sheet.structural.damping, air.viscous_damping, air.wind_coupling, air.wind.norm(), air.gusts.strength })
  {
    fields.push_back(format_number(number));
  }
  fields.push_back(places_of(row.params.pins));
  fields.push_back(std::to_string(moving(row.params.pins)));
  for (const double number : { row.node_steps, row.motion.disagreement, row.motion.growth })
  {
    fields.push_back(std::isfinite(number) ? format_number(number) : "");
  }
  fields.push_back(without_commas(row.motion.reason));
  return joined(fields, ",");
}

constexpr const char* draw_header =
    "scene,half,accepted,rows,cols,width,height,mass,structural,shear,flex,structural_damping,viscous_damping,"
    "wind_coupling,wind,gusts,pins,moving_pins,node_steps,reference_error,growth,reason";

}  // namespace

Solvers solvers_to_search()
{
  constexpr std::array<const char*, 4> first{ "dopri5", "velocity_verlet", "rk4", "implicit_midpoint" };
  const auto place = [&first](const std::unique_ptr<Solver>& solver) {
    return std::find(first.begin(), first.end(), solver->name());
  };
  Solvers solvers = own_solvers();
  std::stable_sort(solvers.begin(), solvers.end(),
                   [&place](const auto& one, const auto& other) { return place(one) < place(other); });
  return solvers;
}

SceneSearch::SceneSearch(const MatrixFolder& folder, Half half, const MatrixSettings& settings, Solvers solvers,
                         std::unique_ptr<Solver> independent)
  : folder_(folder)
  , half_(half)
  , settings_(settings)
  , solvers_(std::move(solvers))
  , independent_(std::move(independent))
  , journal_(folder.searches())
{
}

void SceneSearch::run()
{
  std::vector<int> numbers;
  for (int number = 0; number < settings_.scenes; ++number)
  {
    if (half_of(number) == half_)
    {
      numbers.push_back(number);
    }
  }
  progress_.expect(static_cast<int>(numbers.size()));
  for (const int number : numbers)
  {
    has_worked_ = false;
    run(number);
    progress_.done(has_worked_);
  }
}

void SceneSearch::run(int number)
{
  const std::uint64_t seed = half_ == Half::held_out ? settings_.held_out_seed : settings_.development_seed;
  for (int attempt = 0; attempt < settings_.most_attempts; ++attempt)
  {
    const DrawnRow row = draw({ seed, number, attempt, settings_.most_per_side });
    const std::string name = name_of(row.number);
    draws_.push_back(row);
    write_table();
    if (row.motion.accepted)
    {
      search(matrix_scene(name, yaml_of(row.params), settings_.horizon));
      progress_.say(std::string(name_of(half_)) + " " + name + ": " + std::to_string(row.params.sheet.rows) + " x " +
                    std::to_string(row.params.sheet.cols) + " nodes, searched");
      return;
    }
    progress_.say(std::string(name_of(half_)) + " " + name + " is drawn anew: " + row.motion.reason);
  }
  progress_.say("no scene " + std::to_string(number) + ": " + std::to_string(settings_.most_attempts) +
                " draws had no exact motion");
}

DrawnRow SceneSearch::draw(const SceneNumber& number)
{
  DrawnRow row{ number, drawn_scene(number), 0.0, {} };
  const MatrixScene scene = matrix_scene(name_of(number), yaml_of(row.params), settings_.horizon);
  row.node_steps = node_steps_of(scene.problem());
  if (!(row.node_steps <= settings_.most_node_steps))
  {
    row.motion.reason = "velocity_verlet would move " + format_number(std::round(row.node_steps)) + " nodes; at most " +
                        format_number(settings_.most_node_steps) + " can be afforded";
    return row;
  }
  row.motion = motion_of(scene);
  row.motion.samples.clear();
  if (row.motion.accepted)
  {
    ReplacedFile file(folder_.scene(scene.name));
    file.stream() << scene.yaml;
    file.commit();
  }
  return row;
}

Reference SceneSearch::motion_of(const MatrixScene& scene)
{
  const std::string path = folder_.motion(scene.name);
  if (std::optional<Reference> kept = read_reference(path, scene.fingerprint()))
  {
    return *kept;
  }
  begin(scene.name + ", exact motion");
  const Reference motion = find_exact_motion(scene.problem(), independent_.get(), settings_.motion);
  write_reference(path, scene.fingerprint(), motion);
  return motion;
}

void SceneSearch::search(const MatrixScene& scene)
{
  const std::optional<Reference> motion = read_reference(folder_.motion(scene.name), scene.fingerprint());
  const Problem problem = scene.problem();
  Search search(problem, motion->samples, settings_.search, journal_, scene.fingerprint(),
                [&](const std::string& what) { begin(scene.name + ", " + what); });
  const std::vector<Measurement>& rows = search.run(solvers_);
  ReplacedFile file(folder_.searched(scene.name));
  file.stream() << measurement_header << "\n";
  for (const Measurement& row : rows)
  {
    file.stream() << cloth::line_of(row) << "\n";
  }
  file.commit();
}

void SceneSearch::begin(const std::string& what)
{
  has_worked_ = true;
  progress_.now(what);
}

void SceneSearch::write_table() const
{
  ReplacedFile file(folder_.scenes());
  file.stream() << draw_header << "\n";
  for (const DrawnRow& row : draws_)
  {
    file.stream() << line_of(row, half_) << "\n";
  }
  file.commit();
}

}  // namespace cloth
