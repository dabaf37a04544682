#include "plan_trial.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <sstream>

#include "errors.h"
#include "own_solver.h"
#include "reference_file.h"
#include "search.h"
#include "timed_outcome.h"
#include "yardstick.h"

namespace cloth
{
namespace
{

std::string content_of(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

const Solver& solver_of(const Measurement& row)
{
  static const Solvers solvers = own_solvers();
  const auto is_it = [&row](const std::unique_ptr<Solver>& solver) {
    return solver->name() == row.solver && name_of(solver->setting()) == row.setting;
  };
  return **std::find_if(solvers.begin(), solvers.end(), is_it);
}

double cost_of(const Outcome& outcome)
{
  return outcome.seconds_per_second / outcome.yardstick;
}

void take_choice(const Plan& plan, PlanRow& row)
{
  row.method = plan.method->name;
  row.time_step = plan.choice.time_step;
  row.method_tolerance = plan.choice.tolerance;
  row.iterations = plan.choice.iterations;
  row.left_out = joined(left_out(plan));
  row.estimate = plan.choice.error;
  row.estimated_cost = plan.choice.cost;
}

/// With the part where it was without, and the other way round.
PartNames turned_over(PartNames names, const std::string& part)
{
  if (names.erase(part) == 0)
  {
    names.insert(part);
  }
  return names;
}

}  // namespace

PlanTrial::PlanTrial(const MatrixFolder& folder, const TrialSettings& settings, const Provenance& provenance,
                     const std::string& build)
  : folder_(folder)
  , settings_(settings)
  , provenance_(provenance)
  , build_(build)
  , plans_(folder.plans(), plan_header)
  , parts_(folder.parts(), part_header)
{
}

bool PlanTrial::run()
{
  const std::vector<std::string> names = folder_.all_searched();
  progress_.expect(static_cast<int>(names.size()));
  bool any = false;
  for (const std::string& name : names)
  {
    const size_t before = plans_.lines().size();
    if (const std::optional<SearchedScene> scene = searched(name))
    {
      any = true;
      for (const double tolerance : settings_.tolerances)
      {
        run(*scene, tolerance);
      }
    }
    progress_.done(plans_.lines().size() > before);
  }
  return any;
}

std::optional<SearchedScene> PlanTrial::searched(const std::string& name) const
{
  SearchedScene searched{ matrix_scene(name, content_of(folder_.scene(name)), settings_.horizon), {}, {} };
  const std::string fingerprint = searched.scene.fingerprint();
  std::optional<Reference> motion = read_reference(folder_.motion(name), fingerprint);
  std::ifstream file(folder_.searched(name));
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line))
  {
    searched.rows.push_back(measurement_of(line));
  }
  if (!motion || searched.rows.empty() || searched.rows.front().fingerprint != fingerprint)
  {
    return std::nullopt;
  }
  searched.motion = std::move(motion->samples);
  return searched;
}

void PlanTrial::run(const SearchedScene& searched, double tolerance)
{
  const std::string fingerprint = searched.scene.fingerprint();
  std::optional<PlanRow> row;
  for (const std::string& line : plans_.lines())
  {
    const PlanRow kept = plan_row_of(line);
    if (kept.build == build_ && kept.fingerprint == fingerprint && kept.tolerance == tolerance)
    {
      row = kept;
    }
  }
  if (!row)
  {
    progress_.now(searched.scene.name + " at " + std::to_string(tolerance) + " m");
    row = tried(searched, tolerance);
    plans_.add(line_of(*row));
  }
  if (settings_.weighs_parts && row->message.empty())
  {
    weigh_parts(searched.scene, *row);
  }
}

PlanRow PlanTrial::tried(const SearchedScene& searched, double tolerance) const
{
  const Problem problem = searched.scene.problem();
  PlanRow row;
  row.build = build_;
  row.commit = provenance_.commit;
  row.scene = searched.scene.name;
  row.fingerprint = searched.scene.fingerprint();
  row.tolerance = tolerance;
  const std::optional<Contender> best = best_of(searched.rows, tolerance);
  if (best)
  {
    row.best_solver = best->row.solver;
    row.best_setting = best->row.setting;
    row.best_value = best->row.value;
    row.best_error = best->row.errors.rms;
  }
  try
  {
    const TimedPlan made = timed_plan(searched.scene.params, tolerance);
    row.planning_seconds = made.seconds;
    row.planning = made.yardsticks;
    take_choice(made.plan, row);
    const double affordable =
        best ? 1.0 + settings_.most_cost * best->cost * problem.horizon * Yardstick::shared().length() :
               settings_.most_seconds;
    std::vector<double> costs;
    std::vector<double> best_costs;
    double first_seconds = 0.0;
    for (int i = 0; i < (first_seconds > settings_.long_run ? 1 : settings_.runs); ++i)
    {
      const auto run_plan = [&] { return run_of(made.plan, problem, affordable); };
      const Outcome outcome = timed_outcome(run_plan, settings_.least_timed);
      costs.push_back(cost_of(outcome));
      row.seconds_per_second = outcome.seconds_per_second;
      row.status = name_of(outcome.status);
      first_seconds = i == 0 ? outcome.seconds : first_seconds;
      if (i == 0 && (outcome.status == Status::ok || outcome.status == Status::not_converged))
      {
        const Simulation simulation = build_simulation(problem.plan);
        const Errors errors = errors_of(simulation.dynamics(), outcome.samples, searched.motion);
        row.true_error = errors.rms;
        row.worst_error = errors.worst;
      }
      if (best)
      {
        const auto run_best = [&] {
          return solver_of(best->row).run(problem, std::strtod(best->row.value.c_str(), nullptr),
                                          settings_.most_seconds);
        };
        best_costs.push_back(cost_of(timed_outcome(run_best, settings_.least_timed)));
      }
    }
    row.cost = median(costs);
    row.best_cost = best ? median(best_costs) : unknown;
  }
  catch (const std::exception& error)
  {
    row.status = "refused";
    row.message = error.what();
  }
  return row;
}

void PlanTrial::weigh_parts(const MatrixScene& scene, const PlanRow& row)
{
  const PartNames names = names_in(row.left_out);
  for (const std::string& part : parts_of(scene.params))
  {
    PartRow weighed{ build_, scene.name, row.fingerprint, row.tolerance, part, names.count(part) > 0, unknown };
    const auto is_there = [&](const std::string& line) {
      const PartRow kept = part_row_of(line);
      return kept.build == build_ && kept.fingerprint == weighed.fingerprint && kept.tolerance == weighed.tolerance &&
             kept.part == part;
    };
    if (std::any_of(parts_.lines().begin(), parts_.lines().end(), is_there))
    {
      continue;
    }
    const std::vector<ClothState> as_planned = motion_without(scene, names);
    const std::vector<ClothState> otherwise = motion_without(scene, turned_over(names, part));
    weighed.change = as_planned.empty() || otherwise.empty() ? unknown : rms_distance(otherwise, as_planned);
    parts_.add(line_of(weighed));
  }
}

std::vector<ClothState> PlanTrial::motion_without(const MatrixScene& scene, const PartNames& names)
{
  std::string name = scene.name + (names.empty() ? "" : "_without_" + joined(names));
  std::replace(name.begin(), name.end(), ' ', '_');
  const std::string path = folder_.motion(name);
  if (std::optional<Reference> kept = read_reference(path, scene.fingerprint()))
  {
    return std::move(kept->samples);
  }
  progress_.now(name);
  MatrixScene changed = scene;
  changed.params = without(names, scene.params);
  Reference motion = find_unchecked_motion(changed.problem(), settings_.motion);
  write_reference(path, scene.fingerprint(), motion);
  return std::move(motion.samples);
}

}  // namespace cloth
