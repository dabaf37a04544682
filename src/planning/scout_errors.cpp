#include "scout_errors.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

constexpr size_t most_steps = 4;
/// Halving the steps of a method of order 2 divides its error by 4 where that is the error of the step.
constexpr double least_gain = 1.5;
constexpr double gain_of_order = 2.5;
/// What an error comes to, in parts of a difference that is the only one or does not fall: of the longer step the third
/// part of the difference and more may be missing, and of the shorter one the error lies between a third and all of it.
constexpr double of_longer = 1.15;
constexpr double of_shorter = 0.6;

}  // namespace

ScoutErrors::ScoutErrors(Trials& trials) : trials_(trials), steps_{ trials.longest_step() }
{
  halve();
}

void ScoutErrors::refine_to(double wanted)
{
  while (steps_.size() < most_steps && error_of_finest() > wanted && !is_at_its_floor() && !trials_.are_over())
  {
    halve();
  }
}

bool ScoutErrors::is_at_its_floor() const
{
  const size_t count = differences_.size();
  return count >= 2 && differences_[count - 2] < least_gain * differences_[count - 1];
}

const Motion& ScoutErrors::finest() const
{
  return trials_.motion({ scout, steps_.back() });
}

double ScoutErrors::error_of_finest() const
{
  return error_at(steps_.size() - 1);
}

/// Along the straight line, in logarithms.
double ScoutErrors::error_of(double time_step) const
{
  size_t next = 1;
  while (next + 1 < steps_.size() && steps_[next] > time_step)
  {
    ++next;
  }
  const double longer = error_at(next - 1);
  const double shorter = error_at(next);
  const double slope = shorter > 0.0 && std::isfinite(longer) ? std::log2(longer / shorter) : 2.0;
  return shorter * std::pow(time_step / steps_[next], std::clamp(slope, 0.0, 2.0));
}

void ScoutErrors::halve()
{
  const Motion& before = finest();
  steps_.push_back(0.5 * steps_.back());
  differences_.push_back(distance(before, finest()));
}

/// By Richardson's extrapolation where two differences that follow each other fall as the method's order has it.
double ScoutErrors::error_at(size_t step) const
{
  const size_t last = differences_.size() - 1;
  const size_t first_of_two = step <= last ? step : last - 1;
  const bool are_two = first_of_two < last;
  const double gain = are_two ? differences_[first_of_two] / differences_[first_of_two + 1] : 0.0;
  const bool falls = gain > gain_of_order;
  if (step <= last)
  {
    return differences_[step] * (falls ? gain / (gain - 1.0) : of_longer);
  }
  return differences_[last] * (falls ? 1.0 / (gain - 1.0) : are_two ? 1.0 : of_shorter);
}

}  // namespace cloth
