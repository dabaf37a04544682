#include "search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>

#include "cloth_sim/scene/yaml_text.h"
#include "errors.h"
#include "timed_outcome.h"
#include "yardstick.h"

namespace cloth
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Beyond what a run costs: to build it, and what a clock that is asked now and then finds too late, s.
constexpr double grace = 0.01;

bool is_of(const Measurement& row, const Solver& solver)
{
  return row.solver == solver.name() && row.setting == name_of(solver.setting());
}

bool meets(const Measurement& row, double tolerance)
{
  return row.status == name_of(Status::ok) && row.errors.rms <= tolerance;
}

double value_of(const Measurement& row)
{
  return std::strtod(row.value.c_str(), nullptr);
}

/// Between two settings of a ladder; steps divide the time between samples, iterations are whole. Nothing: there is
/// none.
std::optional<double> setting_between(const Problem& problem, const Solver& solver, double coarse, double fine)
{
  const double middle = std::sqrt(coarse * fine);
  double value = middle;
  if (solver.setting() == Setting::step)
  {
    value = problem.sample_interval() / std::round(problem.sample_interval() / middle);
  }
  else if (solver.setting() == Setting::iterations)
  {
    value = std::round(middle);
  }
  const auto [low, high] = std::minmax(coarse, fine);
  return low * 1.001 < value && value * 1.001 < high ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

double cost_of(const Measurement& row)
{
  return row.seconds_per_second / row.yardstick;
}

double median(std::vector<double> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  const size_t middle = numbers.size() / 2;
  return numbers.size() % 2 == 1 ? numbers[middle] : 0.5 * (numbers[middle - 1] + numbers[middle]);
}

std::vector<Contender> contenders_of(const std::vector<Measurement>& rows)
{
  using Key = std::tuple<std::string, std::string, std::string>;
  std::map<Key, std::vector<const Measurement*>> groups;
  for (const Measurement& row : rows)
  {
    groups[{ row.solver, row.setting, row.value }].push_back(&row);
  }
  std::vector<Contender> contenders;
  for (const auto& [key, group] : groups)
  {
    if (group.front()->status != name_of(Status::ok))
    {
      continue;
    }
    std::vector<double> costs;
    for (const Measurement* row : group)
    {
      costs.push_back(cost_of(*row));
    }
    contenders.push_back({ *group.front(), median(costs) });
  }
  return contenders;
}

std::optional<Contender> best_of(const std::vector<Measurement>& rows, double tolerance)
{
  std::optional<Contender> best;
  for (const Contender& contender : contenders_of(rows))
  {
    if (meets(contender.row, tolerance) && (!best || contender.cost < best->cost))
    {
      best = contender;
    }
  }
  return best;
}

Search::Search(const Problem& problem, const std::vector<ClothState>& exact, const SearchSettings& settings,
               Journal& journal, const std::string& fingerprint, std::function<void(const std::string&)> begins)
  : problem_(problem)
  , exact_(exact)
  , settings_(settings)
  , journal_(journal)
  , fingerprint_(fingerprint)
  , begins_(std::move(begins))
{
}

const std::vector<Measurement>& Search::run(const Solvers& solvers)
{
  for (const std::unique_ptr<Solver>& solver : solvers)
  {
    climb(*solver);
  }
  for (const double tolerance : settings_.tolerances)
  {
    for (const std::unique_ptr<Solver>& solver : solvers)
    {
      refine(*solver, tolerance);
    }
    repeat(solvers, tolerance);
  }
  return rows_;
}

double Search::most_cost(const Solver& solver) const
{
  double most = 0.0;
  for (const double tolerance : settings_.tolerances)
  {
    const bool is_met = std::any_of(rows_.begin(), rows_.end(), [&](const Measurement& row) {
      return is_of(row, solver) && meets(row, tolerance);
    });
    if (!is_met)
    {
      const std::optional<Contender> best = best_of(rows_, tolerance);
      most = std::max(most, best ? settings_.drop_factor * best->cost : infinity);
    }
  }
  return most;
}

void Search::climb(const Solver& solver)
{
  double before = 0.0;
  double expected = 0.0;
  int slow_starts = 0;
  bool any_complete = false;
  for (const double value : solver.ladder(problem_, settings_.ratio))
  {
    const double most = most_cost(solver);
    if (most == 0.0)
    {
      return;
    }
    const Measurement row = measure(solver, value, most, expected);
    any_complete = any_complete || row.is_complete();
    if (row.status == name_of(Status::too_slow) && (any_complete || ++slow_starts > settings_.most_slow_starts))
    {
      return;
    }
    const double here = row.is_complete() ? cost_of(row) : 0.0;
    const double growth = before > 0.0 ? std::clamp(here / before, 1.0, settings_.ratio) : 1.0;
    expected = here * growth;
    before = here;
  }
}

void Search::refine(const Solver& solver, double tolerance)
{
  for (int i = 0; i < settings_.refinements; ++i)
  {
    const Measurement* coarse = nullptr;
    const Measurement* fine = nullptr;
    std::vector<const Measurement*> ladder;
    for (const Measurement& row : rows_)
    {
      if (is_of(row, solver) && row.repeat == 0)
      {
        ladder.push_back(&row);
      }
    }
    const bool finer_is_less = solver.setting() != Setting::iterations;
    std::sort(ladder.begin(), ladder.end(), [&](const Measurement* one, const Measurement* other) {
      return finer_is_less ? value_of(*one) > value_of(*other) : value_of(*one) < value_of(*other);
    });
    for (const Measurement* row : ladder)
    {
      fine = row;
      if (meets(*row, tolerance))
      {
        break;
      }
      coarse = row;
    }
    const std::optional<Contender> best = best_of(rows_, tolerance);
    if (coarse == nullptr || coarse == fine || !best)
    {
      return;
    }
    const std::optional<double> value = setting_between(problem_, solver, value_of(*coarse), value_of(*fine));
    const double least = cost_of(*fine) / settings_.ratio;
    if (!value || least > settings_.worth_refining * best->cost)
    {
      return;
    }
    measure(solver, *value, settings_.drop_factor * best->cost, 0.0);
  }
}

void Search::repeat(const Solvers& solvers, double tolerance)
{
  const std::optional<Contender> best = best_of(rows_, tolerance);
  if (!best)
  {
    return;
  }
  for (const Contender& contender : contenders_of(rows_))
  {
    if (!meets(contender.row, tolerance) || contender.cost > settings_.worth_repeating * best->cost)
    {
      continue;
    }
    const auto solver = std::find_if(solvers.begin(), solvers.end(),
                                     [&](const std::unique_ptr<Solver>& one) { return is_of(contender.row, *one); });
    for (int repeat = 1; repeat < settings_.most_repeats; ++repeat)
    {
      Measurement again = contender.row;
      again.repeat = repeat;
      const auto is_there = [&](const Measurement& row) { return row.repeat == repeat && is_same_row(row, again); };
      if (std::any_of(rows_.begin(), rows_.end(), is_there))
      {
        continue;
      }
      if (const Measurement* kept = journal_.find(again, repeat))
      {
        rows_.push_back(*kept);
        continue;
      }
      begins_(again.solver + ", " + again.setting + " " + again.value + ", again");
      const auto run = [&] { return (*solver)->run(problem_, value_of(again), infinity); };
      take(timed_outcome(run, settings_.least_timed), again);
      journal_.add(again);
      rows_.push_back(again);
    }
  }
}

Measurement Search::row_for(const Solver& solver, double value) const
{
  Measurement row;
  row.scene = problem_.scene;
  row.kind = name_of(problem_.kind);
  row.fingerprint = fingerprint_;
  row.solver = solver.name();
  row.setting = name_of(solver.setting());
  row.value = format_number(value);
  row.nodes = static_cast<int>(problem_.plan.start.positions.rows());
  return row;
}

Measurement Search::measure(const Solver& solver, double value, double most_cost, double expected_cost)
{
  Measurement row = row_for(solver, value);
  if (const Measurement* kept = journal_.find(row, 0))
  {
    rows_.push_back(*kept);
    return *kept;
  }
  begins_(row.solver + ", " + row.setting + " " + row.value);
  if (expected_cost > most_cost)
  {
    row.status = name_of(Status::too_slow);
  }
  else
  {
    const double most_seconds =
        std::min(settings_.most_seconds, grace + most_cost * problem_.horizon * Yardstick::shared().length());
    const auto run = [&] { return solver.run(problem_, value, most_seconds); };
    const Outcome outcome = timed_outcome(run, settings_.least_timed);
    take(outcome, row);
    if (row.is_complete())
    {
      const Simulation simulation = simulation_of(problem_, "velocity_verlet", 1.0, {});
      row.errors = errors_of(simulation.dynamics(), outcome.samples, exact_);
    }
  }
  journal_.add(row);
  rows_.push_back(row);
  return row;
}

}  // namespace cloth
