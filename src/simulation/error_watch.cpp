#include "cloth_sim/simulation/error_watch.h"

#include <algorithm>
#include <cmath>

#include "whole_step.h"

namespace cloth
{
namespace
{

constexpr double aim = 0.5;          ///< of the tolerance
constexpr double far_below = 0.125;  ///< of the tolerance
constexpr double most_shortening = 0.25;
constexpr double most_lengthening = 2.0;
/// Where errors fall with a lower power of the step than this part of the order, they are not the step's.
constexpr double least_of_order = 0.3;
/// A change of the step that is smaller is none.
constexpr double least_change = 0.05;

}  // namespace

ErrorWatch::ErrorWatch(const ErrorBounds& bounds, const MethodRow* method, const MethodSettings& settings, double time)
  : bounds_(bounds), row_(method), settings_(settings), next_check_(time + first_check)
{
}

void ErrorWatch::forces_changed()
{
  if (other_)
  {
    other_->method->restart();
  }
}

void ErrorWatch::take_look(const Dynamics& dynamics, const StrainLimit& limit, double h, const ClothState& state)
{
  if (!other_)
  {
    begin_check(dynamics, limit, state);
    return;
  }
  for (int half = 0; half < 2; ++half)
  {
    take_whole_step(*other_->method, other_->limit, dynamics, 0.5 * h, other_->state);
  }
  other_->state.time = state.time;
  if (state.time >= begin_ + horizon * (compared_ + 1) / samples)
  {
    squares_ += (state.positions - other_->state.positions).squaredNorm() / static_cast<double>(state.positions.rows());
    ++compared_;
  }
  if (compared_ == samples)
  {
    end_check(state.time, h);
  }
}

void ErrorWatch::begin_check(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state)
{
  other_.emplace(Other{ state, row_->make(settings_), StrainLimit(dynamics.model(), limit.properties()) });
  other_->limit.go_on_from(limit);
  begin_ = state.time;
  compared_ = 0;
  squares_ = 0.0;
}

void ErrorWatch::end_check(double time, double h)
{
  other_.reset();
  const double gain = std::exp2(row_->order);
  const double error = std::sqrt(squares_ / samples) * gain / (gain - 1.0);
  finding_ = Finding{ time, error, h };
  first_step_ = first_step_ > 0.0 ? first_step_ : h;
  const bool is_too_large = error > bounds_.tolerance;
  const bool was_in_vain =
      before_shortening_ &&
      error > before_shortening_->error * std::pow(h / before_shortening_->step, least_of_order * row_->order);
  checks_far_below_ = error < far_below * bounds_.tolerance ? checks_far_below_ + 1 : 0;
  double next = h;
  if (is_too_large && was_in_vain)
  {
    next = before_shortening_->step;
    is_at_the_floor_ = true;
  }
  else if (is_too_large && !is_at_the_floor_)
  {
    next = std::min(h, std::max(fitting_step(h, error), bounds_.room * first_step_));
  }
  else if (checks_far_below_ >= 2)
  {
    next = std::max(h, std::min(fitting_step(h, error), bounds_.longest_step));
    checks_far_below_ = 0;
  }
  before_shortening_ = next < h ? finding_ : std::nullopt;
  const bool is_changed = std::abs(next - h) > least_change * h;
  if (is_changed)
  {
    corrected_step_ = next;
  }
  between_ = is_changed ? least_between : std::min(2.0 * between_, most_between);
  next_check_ = next < h ? time : time + between_;
}

double ErrorWatch::fitting_step(double h, double error) const
{
  const double factor = std::pow(aim * bounds_.tolerance / error, 1.0 / row_->order);
  return h * std::clamp(factor, most_shortening, most_lengthening);
}

}  // namespace cloth
