// The exhaustive search, on solvers whose errors and costs are known.

#include <cmath>

#include "errors.h"
#include "in_a_folder.h"
#include "search.h"
#include "small_problem.h"
#include "timed_outcome.h"

namespace cloth
{
namespace
{

/// An error of `error` h^order m at a cost of `cost`/h yardsticks a simulated second. It notes what it was run with.
class LawfulSolver : public Solver
{
public:
  LawfulSolver(std::string name, int order, double error, double cost, std::vector<double>& costs,
               Status status = Status::ok)
    : name_(std::move(name)), order_(order), error_(error), cost_(cost), costs_(costs), status_(status)
  {
  }
  std::string name() const override
  {
    return name_;
  }
  Setting setting() const override
  {
    return Setting::step;
  }
  std::vector<double> ladder(const Problem& problem, double ratio) const override
  {
    std::vector<double> steps;
    for (double step = problem.sample_interval(); step > 1e-9; step /= ratio)
    {
      steps.push_back(step);
    }
    return steps;
  }
  Outcome run(const Problem& problem, double value, double) const override
  {
    costs_.push_back(cost_ / value);
    Outcome outcome;
    outcome.status = status_;
    outcome.seconds = 1.0;
    outcome.seconds_per_second = cost_ / value;
    outcome.yardstick = 1.0;
    for (int s = 0; s < Problem::samples; ++s)
    {
      ClothState state = problem.plan.start;
      state.positions.col(0).array() += error_ * std::pow(value, order_);
      outcome.samples.push_back(state);
    }
    return outcome;
  }

private:
  std::string name_;
  int order_;
  double error_;
  double cost_;
  std::vector<double>& costs_;
  Status status_;
};

class SearchOfLaws : public InAFolder
{
protected:
  SearchOfLaws()
  {
    settings_.least_timed = 0.0;
    settings_.most_repeats = 1;
  }

  void add(const std::string& name, int order, double error, double cost, Status status = Status::ok)
  {
    solvers_.push_back(std::make_unique<LawfulSolver>(name, order, error, cost, costs_[name], status));
  }

  /// Nothing moves: the exact motion is the start.
  std::vector<Measurement> search()
  {
    Journal journal(path("searches.csv"));
    const std::vector<ClothState> exact(Problem::samples, problem_.plan.start);
    Search search(problem_, exact, settings_, journal, "a fingerprint", [](const std::string&) {});
    return search.run(solvers_);
  }

  size_t runs() const
  {
    size_t sum = 0;
    for (const auto& [name, costs] : costs_)
    {
      sum += costs.size();
    }
    return sum;
  }

  void expect_best(const std::vector<Measurement>& rows, double tolerance, const std::string& solver, double cost) const
  {
    const std::optional<Contender> best = best_of(rows, tolerance);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->row.solver, solver);
    EXPECT_LE(best->row.errors.rms, tolerance);
    // Two halvings of a gap of 2 leave one of 2^(1/4).
    EXPECT_GE(best->cost, cost * (1.0 - 1e-9));
    EXPECT_LE(best->cost, cost * 1.2);
  }

  const Problem problem_ = small_problem(1.0);
  SearchSettings settings_;
  Solvers solvers_;
  std::map<std::string, std::vector<double>> costs_;
};

TEST_F(SearchOfLaws, FindsTheBestForEachTolerance)
{
  add("first_order", 1, 1.0, 1.0);
  add("second_order", 2, 1.0, 20.0);
  const std::vector<Measurement> rows = search();
  expect_best(rows, 1e-2, "first_order", 1.0 / 1e-2);
  expect_best(rows, 1e-3, "second_order", 20.0 / std::sqrt(1e-3));
  expect_best(rows, 1e-4, "second_order", 20.0 / std::sqrt(1e-4));
}

TEST_F(SearchOfLaws, FindsTheSameWhicheverSolverIsFirst)
{
  add("second_order", 2, 1.0, 20.0);
  add("first_order", 1, 1.0, 1.0);
  const std::vector<Measurement> rows = search();
  expect_best(rows, 1e-2, "first_order", 1.0 / 1e-2);
  expect_best(rows, 1e-4, "second_order", 20.0 / std::sqrt(1e-4));
}

TEST_F(SearchOfLaws, DropsWhatCostsThreeTimesTheBest)
{
  add("second_order", 2, 1.0, 20.0);
  add("hopeless", 1, 10.0, 20.0);
  const std::vector<Measurement> rows = search();
  const double most = 3.0 * best_of(rows, 1e-4)->cost;
  for (const double cost : costs_["hopeless"])
  {
    EXPECT_LE(cost, most * 1.01 * std::pow(2.0, 0.25));
  }
  EXPECT_GT(*std::max_element(costs_["hopeless"].begin(), costs_["hopeless"].end()), most / 2.5);
  const auto is_dropped = [](const Measurement& row) {
    return row.solver == "hopeless" && row.status == name_of(Status::too_slow);
  };
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), is_dropped), 1);
}

/// As a method does whose long steps have equations that are hard to solve.
class SlowAtFirst : public LawfulSolver
{
public:
  SlowAtFirst(double longest_quick, std::vector<double>& costs)
    : LawfulSolver("slow_at_first", 2, 1e-3, 1.0, costs), longest_quick_(longest_quick)
  {
  }
  Outcome run(const Problem& problem, double value, double most_seconds) const override
  {
    Outcome outcome = LawfulSolver::run(problem, value, most_seconds);
    outcome.status = value > longest_quick_ ? Status::too_slow : Status::ok;
    return outcome;
  }

private:
  double longest_quick_;
};

TEST_F(SearchOfLaws, GoesOnWhereTheFirstSettingsAreTooSlow)
{
  add("second_order", 2, 1.0, 20.0);
  const double first = problem_.sample_interval();
  solvers_.push_back(std::make_unique<SlowAtFirst>(0.3 * first, costs_["slow_at_first"]));
  EXPECT_EQ(best_of(search(), 1e-2)->row.solver, "slow_at_first");
}

TEST_F(SearchOfLaws, GivesUpWhereTheFirstThreeSettingsAreTooSlow)
{
  add("second_order", 2, 1.0, 20.0);
  const double first = problem_.sample_interval();
  solvers_.push_back(std::make_unique<SlowAtFirst>(0.2 * first, costs_["slow_at_first"]));
  EXPECT_EQ(best_of(search(), 1e-2)->row.solver, "second_order");
  EXPECT_EQ(costs_["slow_at_first"].size(), 3U);
}

TEST_F(SearchOfLaws, TakesNothingThatDidNotSolveItsEquations)
{
  add("second_order", 2, 1.0, 20.0);
  add("unsolved", 2, 1e-3, 1e-3, Status::not_converged);
  add("unstable", 2, 1e-3, 1e-3, Status::unstable);
  const std::vector<Measurement> rows = search();
  EXPECT_FALSE(costs_["unsolved"].empty());
  EXPECT_FALSE(costs_["unstable"].empty());
  for (const double tolerance : settings_.tolerances)
  {
    EXPECT_EQ(best_of(rows, tolerance)->row.solver, "second_order");
  }
}

TEST_F(SearchOfLaws, RunsNothingAgainThatIsKept)
{
  settings_.most_repeats = 3;
  add("first_order", 1, 1.0, 1.0);
  add("second_order", 2, 1.0, 20.0);
  const std::vector<Measurement> rows = search();
  const size_t before = runs();
  const std::vector<Measurement> again = search();
  EXPECT_EQ(runs(), before);
  ASSERT_EQ(again.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i)
  {
    EXPECT_EQ(line_of(again[i]), line_of(rows[i]));
  }
}

TEST_F(SearchOfLaws, RepeatsTheBestAlone)
{
  settings_.most_repeats = 3;
  add("second_order", 2, 1.0, 20.0);
  add("dear", 2, 1.0, 40.0);
  const std::vector<Measurement> rows = search();
  for (const Measurement& row : rows)
  {
    EXPECT_TRUE(row.repeat == 0 || row.solver == "second_order") << line_of(row);
  }
  const std::string best = best_of(rows, 1e-4)->row.value;
  const auto is_best = [&](const Measurement& row) { return row.solver == "second_order" && row.value == best; };
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), is_best), 3);
}

TEST_F(SearchOfLaws, HasNoBestWhereNothingMeetsTheTolerance)
{
  settings_.tolerances = { 1e-2 };
  add("unstable", 1, 1.0, 1.0, Status::unstable);
  EXPECT_FALSE(best_of(search(), 1e-2));
}

TEST(Cost, IsTheMedianOfTheRepeats)
{
  std::vector<Measurement> rows(3);
  for (size_t i = 0; i < rows.size(); ++i)
  {
    rows[i].status = name_of(Status::ok);
    rows[i].repeat = static_cast<int>(i);
    rows[i].yardstick = 2.0;
    rows[i].seconds_per_second = i == 1 ? 1000.0 : 6.0 + static_cast<double>(i);
  }
  EXPECT_EQ(best_of(rows, 1.0)->cost, 4.0);
  EXPECT_EQ(median({ 4.0, 1.0 }), 2.5);
}

}  // namespace
}  // namespace cloth
