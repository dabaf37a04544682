#include "method_errors.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// Halving the steps of a method divides its error by 2 to the power of its order; of more than 2 nothing is expected.
constexpr int most_order = 2;
/// Between two steps that were run errors may fall faster, as those of damping that long steps bring along.
constexpr int steepest = 6;
/// Less than these parts of that order, and halving does not help, or is not the order's doing.
constexpr double order_at_the_floor = 0.3;
constexpr double order_of_falling = 0.65;
/// Of a difference that is the only one or does not fall: how much of what the order would have it miss of the longer
/// step's error is believed, and how much of it may be the shorter step's.
constexpr double of_shorter[] = { 1.0, 0.6 };
constexpr double of_longer[] = { 1.8, 1.15 };

}  // namespace

MethodErrors::MethodErrors(Trials& trials, int order, const Stepping& stepping)
  : trials_(trials), order_(std::min(order, most_order)), stepping_(stepping)
{
}

void MethodErrors::hold_against(const Reference& reference)
{
  reference_ = reference;
  differences_.clear();
  for (const double step : steps_)
  {
    differences_.push_back(distance(trials_.motion(at(step)), *reference_.motion));
  }
}

Stepping MethodErrors::at(double time_step) const
{
  Stepping stepping = stepping_;
  stepping.time_step = time_step;
  return stepping;
}

void MethodErrors::run_next()
{
  const bool is_first = steps_.empty();
  if (!is_first)
  {
    stepping_.time_step *= 0.5;
  }
  const Motion& motion = trials_.motion(stepping_);
  if (has_reference())
  {
    differences_.push_back(distance(motion, *reference_.motion));
  }
  else if (!is_first)
  {
    differences_.push_back(distance(trials_.motion(at(steps_.back())), motion));
  }
  steps_.push_back(stepping_.time_step);
}

bool MethodErrors::is_known() const
{
  return !differences_.empty();
}

bool MethodErrors::falls() const
{
  const size_t count = differences_.size();
  return count >= 2 && std::isfinite(differences_[count - 2]) &&
         differences_[count - 2] > std::exp2(order_of_falling * order_) * differences_[count - 1];
}

bool MethodErrors::is_at_its_floor() const
{
  const size_t count = differences_.size();
  return !has_reference() && count >= 2 &&
         differences_[count - 2] < std::exp2(order_at_the_floor * order_) * differences_[count - 1];
}

const Motion& MethodErrors::finest() const
{
  return trials_.motion(stepping_);
}

double MethodErrors::error_of_finest() const
{
  return error_at(steps_.size() - 1);
}

double MethodErrors::slope(size_t next) const
{
  if (next == 0)
  {
    return order_;
  }
  const double longer = error_at(next - 1);
  const double shorter = error_at(next);
  return shorter > 0.0 && std::isfinite(longer) ? std::clamp(std::log2(longer / shorter), 0.0, 1.0 * steepest) : order_;
}

double MethodErrors::error_of(double time_step) const
{
  size_t next = std::min<size_t>(1, steps_.size() - 1);
  while (next + 1 < steps_.size() && steps_[next] > time_step)
  {
    ++next;
  }
  const double falling = time_step < steps_[next] ? std::min(slope(next), 1.0 * order_) : slope(next);
  return error_at(next) * std::pow(time_step / steps_[next], falling);
}

double MethodErrors::step_for(double allowed) const
{
  size_t run = 0;
  while (run + 1 < steps_.size() && error_at(run) > allowed)
  {
    ++run;
  }
  const double error = error_at(run);
  if (run == 0 && error <= allowed)
  {
    return steps_.front();
  }
  const double falling = std::max(error > allowed ? std::min(slope(run), 1.0 * order_) : slope(run), 1e-3);
  const double step = std::isfinite(error) ? steps_[run] * std::pow(allowed / error, 1.0 / falling) : 0.0;
  return run > 0 ? std::min(step, steps_[run - 1]) : step;
}

/// By Richardson's extrapolation where two differences that follow each other fall as the method's order has it.
double MethodErrors::error_at(size_t run) const
{
  if (has_reference())
  {
    return std::hypot(differences_[run], reference_.error);
  }
  const size_t last = differences_.size() - 1;
  const size_t first_of_two = run <= last || last == 0 ? run : last - 1;
  const bool are_two = first_of_two < last && std::isfinite(differences_[first_of_two]);
  const double gain = are_two ? differences_[first_of_two] / differences_[first_of_two + 1] : 0.0;
  const bool falls = gain > std::exp2(order_of_falling * order_);
  if (run <= last)
  {
    return differences_[run] * (falls ? gain / (gain - 1.0) : of_longer[order_ - 1]);
  }
  return differences_[last] * (falls ? 1.0 / (gain - 1.0) : are_two ? 1.0 : of_shorter[order_ - 1]);
}

}  // namespace cloth
