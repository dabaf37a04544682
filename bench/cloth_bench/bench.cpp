#include "bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "cloth_sim/scene/yaml_text.h"
#include "own_solver.h"
#include "reference_file.h"
#include "spatial.h"
#include "timed_outcome.h"

namespace cloth
{
namespace
{

/// A grid that can be moved for less time than this is not compared with finer ones, s.
constexpr double shortest_spatial_horizon = 0.02;
/// What may be spent on the finest grid, in parts of what may be spent on the scene itself.
constexpr double spatial_part = 2.0;
/// So many times as fine.
constexpr int finest_factor = 4;

bool has_limit(const BenchScene& scene)
{
  return scene.params.strain_limit.max_strain > 0.0;
}

/// The same folder, there and with nothing in it that comes from elsewhere.
const std::string& prepared(const std::string& folder, const Provenance& provenance)
{
  std::filesystem::create_directories(folder + "/references");
  require_same_provenance(folder, provenance);
  return folder;
}

std::string words_for(const Measurement& row)
{
  return row.scene + " (" + row.kind + "), " + row.solver + ", " + row.setting + " " + row.value;
}

}  // namespace

BenchSettings BenchSettings::quick()
{
  BenchSettings settings;
  settings.longest_horizon = 0.25;
  settings.most_node_steps = 5e6;
  settings.smallest_error = 1e-6;
  settings.most_seconds = 0.2;
  settings.most_repeats = 4;
  settings.least_timed = 0.005;
  settings.reference.first_tolerance = 1e-10;
  settings.reference.most_disagreement = 1e-8;
  settings.reference.most_seconds = 4.0;
  settings.limited_disagreement = 2e-4;
  settings.limited_seconds = 2.5;
  settings.spatial_seconds = 4.0;
  return settings;
}

Bench::Bench(const std::string& folder, const BenchSettings& settings, Solvers solvers,
             std::unique_ptr<Solver> independent, const Provenance& provenance)
  : folder_(prepared(folder, provenance))
  , settings_(settings)
  , solvers_(std::move(solvers))
  , independent_(std::move(independent))
  , provenance_(provenance)
  , journal_(folder + "/measurements.csv")
{
}

bool Bench::run(const std::vector<BenchScene>& scenes, const std::function<bool()>& ends_early)
{
  ends_early_ = ends_early;
  for (const BenchScene& scene : scenes)
  {
    const int parts = static_cast<int>(solvers_.size()) + 2;
    progress_.expect((has_limit(scene) ? 2 : 1) * parts + (settings_.spatial_seconds > 0.0 ? 1 : 0));
  }
  try
  {
    for (const BenchScene& scene : scenes)
    {
      run(scene, Kind::trajectory);
      if (has_limit(scene))
      {
        run(scene, Kind::limited);
      }
      if (settings_.spatial_seconds > 0.0)
      {
        run_spatial(scene);
      }
    }
  }
  catch (const Ended&)
  {
  }
  const auto is_accepted = [](const SceneRow& row) { return row.accepted && row.kind != name_of(Kind::spatial); };
  return std::any_of(scene_rows_.begin(), scene_rows_.end(), is_accepted);
}

SceneRow Bench::scene_row(const BenchScene& scene, Kind kind, double horizon) const
{
  SceneRow row;
  row.scene = scene.name;
  row.kind = name_of(kind);
  row.horizon = horizon;
  row.tolerance = scene.params.solver.tolerance;
  std::string text = scene.text + row.kind;
  for (const double setting :
       { horizon, settings_.smallest_error, settings_.most_seconds, settings_.ratio, settings_.least_timed,
         settings_.reference.first_tolerance, settings_.reference.tightest_tolerance,
         settings_.reference.most_disagreement, settings_.limited_disagreement, settings_.limited_seconds })
  {
    text += " " + format_number(setting);
  }
  row.fingerprint = fingerprint_of(text);
  return row;
}

void Bench::run(const BenchScene& scene, Kind kind)
{
  const double horizon = horizon_of(scene.params, settings_.longest_horizon, settings_.most_node_steps);
  Problem problem = problem_of(scene.name, kind, scene.params, horizon);
  SceneRow row = scene_row(scene, kind, horizon);
  say_if_changed(row);
  const Reference reference = reference_of(problem, row.fingerprint);
  problem.horizon = reference.horizon;
  row.accepted = reference.accepted;
  row.horizon = reference.horizon;
  row.reference_error = reference.disagreement;
  row.growth = reference.growth;
  row.reason = reference.reason;
  scene_rows_.push_back(row);
  if (!row.reason.empty())
  {
    progress_.say(row.scene + " (" + row.kind + ")" + (row.accepted ? ": " : " is refused: ") + row.reason);
  }
  finish_part();
  std::vector<std::pair<const Solver*, Measurement>> complete;
  for (const std::unique_ptr<Solver>& solver : solvers_)
  {
    const std::string obstacle = solver->obstacle(problem);
    if (row.accepted && !obstacle.empty())
    {
      progress_.say(row.scene + " (" + row.kind + "): without " + solver->name() + ": " + obstacle);
    }
    else if (row.accepted)
    {
      for (const Measurement& measurement : climb(*solver, problem, reference, row))
      {
        complete.emplace_back(solver.get(), measurement);
      }
    }
    finish_part();
  }
  repeat_in_turn(problem, complete);
  finish_part();
}

void Bench::say_if_changed(const SceneRow& row)
{
  bool any = false;
  for (const Measurement& measurement : journal_.all())
  {
    if (measurement.scene == row.scene && measurement.kind == row.kind)
    {
      any = true;
      if (measurement.fingerprint == row.fingerprint)
      {
        return;
      }
    }
  }
  if (any)
  {
    progress_.say(row.scene + " (" + row.kind + ") begins anew: the scene, or how much is asked for, has changed");
  }
}

Reference Bench::reference_of(const Problem& problem, const std::string& fingerprint)
{
  const std::string path = folder_ + "/references/" + problem.scene + "_" + name_of(problem.kind) + ".bin";
  if (const std::optional<Reference> kept = read_reference(path, fingerprint))
  {
    return *kept;
  }
  begin_work(problem.scene + " (" + name_of(problem.kind) + "), reference");
  ReferenceSettings settings = settings_.reference;
  settings.most_disagreement =
      problem.kind == Kind::limited ? settings_.limited_disagreement : settings.most_disagreement;
  settings.most_seconds = problem.kind == Kind::limited ? settings_.limited_seconds : settings.most_seconds;
  const Reference reference = problem.kind == Kind::limited ? find_limited_reference(problem, settings) :
                                                              find_reference(problem, independent_.get(), settings);
  write_reference(path, fingerprint, reference);
  return reference;
}

std::vector<Measurement> Bench::climb(const Solver& solver, const Problem& problem, const Reference& reference,
                                      const SceneRow& row)
{
  Measurement like;
  like.scene = row.scene;
  like.kind = row.kind;
  like.fingerprint = row.fingerprint;
  like.solver = solver.name();
  like.setting = name_of(solver.setting());
  const double smallest_error =
      std::max(problem.kind == Kind::limited ? 0.0 : settings_.smallest_error, resolution * reference.disagreement);
  std::vector<Measurement> complete;
  double expected = 0.0;
  double before = 0.0;
  bool is_after_another = false;
  for (const double value : solver.ladder(problem, settings_.ratio))
  {
    like.value = format_number(value);
    const Measurement here = first_run(solver, problem, value, reference, like, expected);
    if (here.is_complete())
    {
      complete.push_back(here);
    }
    // Where stability ends the strain limit may need more passes than all the steps that are saved.
    const bool finer_are_slower = problem.kind != Kind::limited || !complete.empty();
    const bool is_last = here.status == name_of(Status::too_slow) && finer_are_slower;
    if (is_last || (here.is_complete() && here.errors.rms < smallest_error))
    {
      break;
    }
    const double growth = is_after_another ? std::max(1.0, here.seconds / before) : 1.0;
    expected = here.is_complete() ? here.seconds * std::min(growth, settings_.ratio) : 0.0;
    is_after_another = here.is_complete();
    before = here.seconds;
  }
  return complete;
}

Measurement Bench::first_run(const Solver& solver, const Problem& problem, double value, const Reference& reference,
                             const Measurement& row, double expected_seconds)
{
  if (const Measurement* kept = journal_.find(row, 0))
  {
    return *kept;
  }
  begin_work(words_for(row));
  Measurement measurement = row;
  measurement.nodes = static_cast<int>(problem.plan.start.positions.rows());
  if (expected_seconds > settings_.most_seconds)
  {
    measurement.status = name_of(Status::too_slow);
    measurement.seconds = expected_seconds;
  }
  else
  {
    const auto run = [&] { return solver.run(problem, value, settings_.most_seconds); };
    const Outcome outcome = timed_outcome(run, settings_.least_timed);
    take(outcome, measurement);
    if (measurement.is_complete())
    {
      const Simulation simulation = simulation_of(problem, "velocity_verlet", 1.0, {});
      measurement.errors = errors_of(simulation.dynamics(), outcome.samples, reference.samples);
    }
  }
  add(measurement);
  return measurement;
}

void Bench::repeat_in_turn(const Problem& problem, const std::vector<std::pair<const Solver*, Measurement>>& rows)
{
  constexpr double as_long_as_it_takes = std::numeric_limits<double>::infinity();
  for (int repeat = 1; repeat < settings_.most_repeats; ++repeat)
  {
    for (const auto& [solver, row] : rows)
    {
      const int affordable = static_cast<int>(2.0 * settings_.most_seconds / std::max(row.seconds, 1e-6));
      if (repeat >= std::max(2, affordable) || journal_.find(row, repeat) != nullptr)
      {
        continue;
      }
      begin_work(words_for(row) + ", again");
      const double value = std::strtod(row.value.c_str(), nullptr);
      Measurement again = row;
      again.repeat = repeat;
      const auto run = [&solver = *solver, &problem, value] { return solver.run(problem, value, as_long_as_it_takes); };
      take(timed_outcome(run, settings_.least_timed), again);
      add(again);
    }
  }
}

void Bench::run_spatial(const BenchScene& scene)
{
  const double horizon = horizon_of(refined(scene.params, finest_factor), settings_.longest_horizon,
                                    spatial_part * settings_.most_node_steps);
  SceneRow row = scene_row(scene, Kind::spatial, horizon);
  row.accepted = horizon >= shortest_spatial_horizon;
  row.reason = row.accepted ? "" : "a grid four times as fine would take too long";
  scene_rows_.push_back(row);
  const OwnSolver solver(*find_method("dopri5"), Setting::tolerance);
  constexpr double tolerance = 1e-8;
  Problem fine_problem;
  Outcome fine;
  for (int factor = 1; factor < finest_factor && row.accepted; factor *= 2)
  {
    const SceneParams params = refined(scene.params, factor);
    Measurement measurement;
    measurement.scene = row.scene;
    measurement.kind = row.kind;
    measurement.fingerprint = row.fingerprint;
    measurement.solver = solver.name();
    measurement.setting = name_of(Setting::nodes_per_side);
    measurement.value = std::to_string(params.sheet.rows);
    if (journal_.find(measurement, 0) != nullptr)
    {
      continue;
    }
    begin_work(words_for(measurement));
    if (fine.samples.empty())
    {
      fine_problem = problem_of(scene.name, Kind::spatial, refined(scene.params, finest_factor), horizon);
      fine = solver.run(fine_problem, tolerance, settings_.spatial_seconds);
    }
    const Problem problem = problem_of(scene.name, Kind::spatial, params, horizon);
    Outcome outcome = solver.run(problem, tolerance, settings_.spatial_seconds);
    outcome.status = fine.status == Status::ok ? outcome.status : fine.status;
    take(outcome, measurement);
    measurement.nodes = params.sheet.rows * params.sheet.cols;
    if (measurement.is_complete())
    {
      measurement.errors =
          errors_between_grids(make_sheet(params.sheet), outcome.samples, make_sheet(fine_problem.plan.scene.sheet),
                               fine.samples, finest_factor / factor);
    }
    add(measurement);
  }
  finish_part();
}

void Bench::add(const Measurement& measurement)
{
  journal_.add(measurement);
  has_worked_ = true;
}

void Bench::finish_part()
{
  write_tables(folder_, scene_rows_, journal_, provenance_);
  progress_.done(has_worked_);
  has_worked_ = false;
}

void Bench::begin_work(const std::string& what)
{
  if (ends_early_ && ends_early_())
  {
    throw Ended();
  }
  has_worked_ = true;
  progress_.now(what);
}

}  // namespace cloth
