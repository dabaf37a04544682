#include "cloth_sim/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cloth_sim/methods/spectrum.h"

#include "whole_step.h"

namespace cloth
{
namespace
{

/// The step where neither the scene nor stability asks for one, s.
constexpr double unlimited_time_step = 1.0 / 240.0;

/// The fewest equal steps of at most `time_step` that make up `way`; a rounding error more does not count.
std::uint64_t steps_for(double way, double time_step)
{
  constexpr double most = 1e18;  // never done, but a number
  return static_cast<std::uint64_t>(std::clamp(std::ceil(way / time_step * (1.0 - 1e-12)), 1.0, most));
}

int threads_for(const ClothModel& model, int given)
{
  const int most = given > 0 ? given : std::min(usable_threads(), Simulation::chosen_threads);
  return std::clamp(model.nodes() / Simulation::nodes_a_thread, 1, most);
}

}  // namespace

Simulation::Simulation(SimulationSetup setup)
  : dynamics_(std::move(setup.model), setup.gravity, setup.air)
  , strain_limit_(dynamics_.model(), setup.strain_limit)
  , method_row_(setup.method)
  , method_settings_(setup.method_settings)
  , given_time_step_(setup.time_step)
  , given_share_(setup.keeps_within_limit ? limit_share : std::numeric_limits<double>::infinity())
  , state_(std::move(setup.start))
  , rest_watch_(setup.sleep_distance)
  , error_watch_(setup.error_bounds, method_row_, setup.method_settings, state_.time)
{
  if (method_row_ == nullptr)
  {
    throw std::invalid_argument("a simulation needs a method");
  }
  if (state_.positions.rows() != model().nodes() || state_.velocities.rows() != model().nodes())
  {
    throw std::invalid_argument("the start state must have a position and a velocity for every node");
  }
  method_ = method_row_->make(method_settings_);
  dynamics_.use_threads(threads_for(model(), setup.threads));
  for (const Pin& pin : setup.pins)
  {
    dynamics_.pins().hold(pin);
  }
  dynamics_.pins().impose(state_.time, state_.positions, state_.velocities);
  changed_from_outside();
  if (setup.start_is_settled)
  {
    rest_watch_.begin_settled(dynamics_, state_);
  }
}

Simulation Simulation::gone_over_to(SimulationSetup setup) const
{
  setup.pins = pins().all();
  setup.start = state_;
  setup.start_is_settled = false;
  Simulation next(std::move(setup));
  next.given_share_ = std::min(next.given_share_, 1.0);
  next.strain_limit_.go_on_from(strain_limit_);
  next.last_step_ = last_step_;
  next.divergence_ = divergence_;
  next.counters_ = counters_;
  next.measures_reactions_ = measures_reactions_;
  next.measured_since_ = measured_since_;
  next.velocities_before_ = velocities_before_;
  next.impulses_ = impulses_;
  const bool has_lower_limit =
      !strain_limit_.active() || next.strain_limit_.properties().max_strain < strain_limit_.properties().max_strain;
  if (next.strain_limit_.active() && has_lower_limit)
  {
    next.shorten_at_no_speed();
  }
  return next;
}

void Simulation::shorten_at_no_speed()
{
  constexpr int most_sweeps = 1000;
  constexpr double in_no_hurry = std::numeric_limits<double>::infinity();
  StrainLimit limit(model(), { strain_limit_.properties().max_strain, most_sweeps, LimitSolver::plain_sweeps });
  limit.apply(model(), pins(), in_no_hurry, state_);
  changed_from_outside();
}

void Simulation::step(double h)
{
  const double begin = state_.time;
  const PartCalls calls_before = part_calls();
  method_->record_impulses(measures_reactions_ ? &impulses_ : nullptr);
  const StepReport report =
      take_whole_step(*method_, strain_limit_, dynamics_, h, state_, measures_reactions_ ? &impulses_ : nullptr);
  last_step_ = state_.time - begin;
  counters_.limit_sweeps += static_cast<std::uint64_t>(report.limit_sweeps);
  counters_.force_evaluations += static_cast<std::uint64_t>(report.force_evaluations);
  counters_.linear_solves += static_cast<std::uint64_t>(report.linear_solves);
  counters_.linear_iterations += static_cast<std::uint64_t>(report.linear_iterations);
  counters_.rejected_steps += static_cast<std::uint64_t>(report.rejected_steps);
  counters_.unconverged_steps += report.converged ? 0 : 1;
  counters_.calls.add_difference(calls_before, part_calls());
  ++counters_.steps;
}

bool Simulation::advance_to(double time, const std::function<bool()>& stops)
{
  sleep_where_at_rest();
  double longest = asleep_since_ ? 0.0 : longest_step();
  while (!divergence_ && !asleep_since_ && state_.time < time)
  {
    if (!(longest >= shortest_step))
    {
      divergence_ =
          Divergence{ state_.time, 0, "no step of " + std::string(method_row_->name) + " is stable any more" };
      break;
    }
    if (method_row_->is_adaptive)
    {
      take_adaptive_steps(time, longest);
    }
    else
    {
      take_equal_steps(time, longest);
    }
    keep_or_restore();
    sleep_where_at_rest();
    if (state_.time < time && stops && stops())
    {
      break;
    }
    if (state_.time < time)
    {
      longest = std::min(longest, longest_step());
    }
  }
  if (asleep_since_)
  {
    state_.time = last_good_.time = std::max(state_.time, time);
  }
  return !divergence_;
}

void Simulation::sleep_where_at_rest()
{
  if (asleep_since_ || divergence_ || measures_reactions_ || !rest_watch_.finds_rest(dynamics_, strain_limit_, state_))
  {
    return;
  }
  asleep_since_ = state_.time;
  state_.velocities.setZero();
  last_good_ = state_;
  method_ = method_row_->make(method_settings_);
  error_watch_.state_changed();
}

void Simulation::wake()
{
  if (asleep_since_)
  {
    changed_from_outside();
  }
}

void Simulation::take_equal_steps(double time, double longest)
{
  const double begin = state_.time;
  const std::uint64_t steps = steps_for(time - begin, longest);
  const double h = (time - begin) / static_cast<double>(steps);
  const std::uint64_t until_check =
      std::min({ steps, std::uint64_t(steps_between_checks), stability_watch_.steps_between_looks() });
  for (std::uint64_t s = 1; s <= until_check; ++s)
  {
    step(h);
    state_.time = s == steps ? time : begin + static_cast<double>(s) * h;
    rest_watch_.look(state_);
    error_watch_.look(dynamics_, strain_limit_, h, state_);
  }
}

void Simulation::take_adaptive_steps(double time, double longest)
{
  for (int s = 0; s < steps_between_checks && state_.time < time; ++s)
  {
    const double missing = time - state_.time;
    step(std::min(longest, missing));
    if (time - state_.time <= 1e-12 * missing)
    {
      state_.time = time;
    }
    rest_watch_.look(state_);
  }
}

void Simulation::keep_or_restore()
{
  divergence_ = guard_.check(dynamics_, state_);
  if (divergence_)
  {
    state_ = last_good_;
    return;
  }
  last_good_ = state_;
}

void Simulation::changed_from_outside()
{
  method_->restart();
  stability_watch_.forget();
  guard_.open(dynamics_, state_);
  last_good_ = state_;
  asleep_since_.reset();
  rest_watch_.begin(dynamics_, state_);
  error_watch_.state_changed();
}

double Simulation::stability_limit() const
{
  return network_stability_limit(*method_row_, spectrum_of(dynamics_, state_.positions));
}

double Simulation::time_step() const
{
  return method_row_->is_adaptive && last_step_ > 0.0 ? last_step_ : longest_step();
}

double Simulation::longest_step() const
{
  if (method_row_->is_adaptive)
  {
    return given_time_step_ > 0.0 ? given_time_step_ : std::numeric_limits<double>::infinity();
  }
  return given_time_step_ > 0.0 && std::isinf(given_share_) ? given_time_step_ : limited_step();
}

double Simulation::limited_step() const
{
  const double wanted = error_watch_.corrected_step().value_or(given_time_step_);
  const double enough = wanted > 0.0 ? wanted / given_share_ : std::numeric_limits<double>::infinity();
  const double limit = stability_watch_.limit(*method_row_, dynamics_, state_, counters_.steps, enough);
  if (wanted > 0.0 && wanted <= given_share_ * limit)
  {
    return wanted;
  }
  return std::isfinite(limit) ? limit_share * limit : unlimited_time_step;
}

std::string Simulation::divergence_report() const
{
  if (!divergence_)
  {
    return {};
  }
  const double limit = stability_limit();
  std::ostringstream text;
  text << "diverged at " << divergence_->time << " s, first seen at node [" << model().row_of(divergence_->node) << ", "
       << model().col_of(divergence_->node) << "]: " << divergence_->cause << "; the step was " << last_step_
       << " s, the stability limit of " << method_row_->name;
  if (std::isfinite(limit))
  {
    text << " is " << limit << " s for the last good state; take a smaller solver.time_step (0: chosen from the limit)";
  }
  else
  {
    text << " is none, of the linear problem; take a smaller solver.time_step";
  }
  text << " or softer springs";
  return text.str();
}

void Simulation::measure_reactions(bool measure)
{
  measures_reactions_ = measure;
  if (measure)
  {
    wake();
    rest_watch_.begin(dynamics_, state_);
    measured_since_ = state_.time;
    velocities_before_ = state_.velocities;
    impulses_.setZero(model().nodes(), 3);
  }
}

Wrench Simulation::reaction_on(const Pin& pin) const
{
  Wrench wrench;
  const double duration = state_.time - measured_since_;
  if (!measures_reactions_ || duration <= 0.0)
  {
    return wrench;
  }
  const Eigen::RowVector3d middle = state_.positions(pin.nodes, Eigen::all).colwise().mean();
  for (const int node : pin.nodes)
  {
    const Eigen::RowVector3d change = state_.velocities.row(node) - velocities_before_.row(node);
    const Eigen::Vector3d force = (impulses_.row(node) - model().masses[node] * change).transpose() / duration;
    const Eigen::Vector3d arm = (state_.positions.row(node) - middle).transpose();
    wrench.force += force;
    wrench.torque += arm.cross(force);
  }
  return wrench;
}

void Simulation::set_wind(const Eigen::Vector3d& wind)
{
  if (wind != dynamics_.air().properties().wind)
  {
    dynamics_.air().set_wind(wind);
    wake();
    rest_watch_.begin(dynamics_, state_);
  }
  else if (asleep_since_)
  {
    return;
  }
  method_->restart();
  error_watch_.forces_changed();
  guard_.open(dynamics_, state_);
}

void Simulation::hold(const std::string& name, const std::vector<int>& nodes)
{
  dynamics_.pins().hold({ name, nodes, state_.positions(nodes, Eigen::all), {}, {} });
  dynamics_.pins().impose(state_.time, state_.positions, state_.velocities);
  changed_from_outside();
}

bool Simulation::release(const std::string& name)
{
  const bool released = dynamics_.pins().release(name);
  if (released)
  {
    changed_from_outside();
  }
  return released;
}

void Simulation::release_all()
{
  if (!pins().all().empty())
  {
    dynamics_.pins().release_all();
    changed_from_outside();
  }
}

bool Simulation::carry(const std::string& name, const Eigen::Vector3d& target, double duration)
{
  const Pin* const pin = pins().find(name);
  if (pin == nullptr)
  {
    return false;
  }
  const Eigen::Isometry3d now = pin->carry.placement(state_.time);
  if (is_there(*pin, Eigen::Translation3d(target - pin->middle(state_.time)) * now))
  {
    return true;
  }
  dynamics_.pins().carry(name, target, state_.time, state_.time + duration);
  pins_sent_elsewhere();
  return true;
}

bool Simulation::carry(const std::string& name, const Eigen::Isometry3d& placement, const Eigen::Vector3d& pivot,
                       double end)
{
  const Pin* const pin = pins().find(name);
  if (pin == nullptr)
  {
    return false;
  }
  if (is_there(*pin, placement))
  {
    return true;
  }
  dynamics_.pins().carry(name, placement, pivot, state_.time, end);
  pins_sent_elsewhere();
  return true;
}

/// Stays there already, to a rounding error.
bool Simulation::is_there(const Pin& pin, const Eigen::Isometry3d& placement) const
{
  return !pin.moves_at(state_.time) && pin.carry.placement(state_.time).isApprox(placement, 1e-13);
}

void Simulation::pins_sent_elsewhere()
{
  wake();
  rest_watch_.begin(dynamics_, state_);
  method_->restart();
  error_watch_.forces_changed();
  guard_.allow_pin_motion(dynamics_);
}

}  // namespace cloth
