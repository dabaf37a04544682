// Every method's order is the slope of its line on the chart.

#include <cmath>

#include "errors.h"
#include "small_problem.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double in_time = 100.0;  // s

class Slope : public testing::TestWithParam<MethodRow>
{
protected:
  double error_at(double value) const
  {
    const Outcome outcome = solver_.run(problem_, value, in_time);
    EXPECT_EQ(name_of(outcome.status), std::string("ok"));
    evaluations_ = outcome.force_evaluations;
    return rms_distance(outcome.samples, exact_.samples);
  }

  const Problem problem_ = small_problem();
  const Outcome exact_ = exact_motion(problem_);
  const OwnSolver solver_{ GetParam(), GetParam().is_adaptive ? Setting::tolerance : Setting::step };
  mutable double evaluations_ = 0.0;
};

INSTANTIATE_TEST_SUITE_P(Methods, Slope, testing::ValuesIn(methods()), name_of_method);

TEST_P(Slope, OfErrorAgainstStepOrOfErrorAgainstWorkIsTheOrder)
{
  const std::vector<double> ladder = solver_.ladder(problem_, 2.0);
  if (GetParam().is_adaptive)
  {
    const double coarser = error_at(1e-8);
    const double fewer = evaluations_;
    const double finer = error_at(1e-11);
    EXPECT_NEAR(std::log(coarser / finer) / std::log(evaluations_ / fewer), GetParam().order, 0.2)
        << coarser << ", " << finer;
    return;
  }
  const double step = problem_.sample_interval() / (GetParam().order == 1 ? 1024 : GetParam().order == 2 ? 256 : 32);
  const double coarser = error_at(step);
  const double finer = error_at(0.5 * step);
  EXPECT_NEAR(std::log2(coarser / finer), GetParam().order, 0.2) << coarser << ", " << finer;
}

TEST_P(Slope, BeginsWithALadderThatHalvesTheStepOrTightensTheTolerance)
{
  const std::vector<double> ladder = solver_.ladder(problem_, 2.0);
  ASSERT_GT(ladder.size(), 5U);
  for (size_t rung = 1; rung < ladder.size(); ++rung)
  {
    EXPECT_NEAR(ladder[rung - 1] / ladder[rung], GetParam().is_adaptive ? 10.0 : 2.0, 1e-12);
  }
  if (!GetParam().is_adaptive)
  {
    const double steps = problem_.sample_interval() / ladder.front();
    EXPECT_EQ(steps, std::round(steps)) << "samples are at ends of steps";
    const double limit = simulation_of(problem_, GetParam().name, 1.0, {}).stability_limit();
    EXPECT_GE(ladder.front(), std::min(limit, problem_.sample_interval())) << "what is unstable is shown too";
  }
}

}  // namespace
}  // namespace cloth
