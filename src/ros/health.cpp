#include "health.h"

#include <cstdio>

#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

/// So many times the strain limit is more than sweeps that end early leave.
constexpr double allowed_strain_share = 1.5;
/// A transform that was older than this when it was used is stale, s.
constexpr double stale_age = 1.0;

/// A tick that takes longer is to be seen, s.
constexpr double longest_tick = 1.0;

/// Three digits: for people.
std::string in_short(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

double stability_margin(const cloth_sim::ClothStats& stats)
{
  return stats.stability_limit / stats.time_step;
}

std::string strain_of(const Condition& condition)
{
  return "strain " + in_short(condition.stats.max_strain) +
         (condition.strain_limit > 0.0 ? " of " + in_short(condition.strain_limit) : std::string(", no limit"));
}

/// A method that chooses its steps by itself rejects those that are too long.
bool is_unstable(const Condition& condition)
{
  return stability_margin(condition.stats) < 1.0 && condition.stats.method != "dopri5";
}

}  // namespace

void report_ticks(const Condition& condition, DiagnosticStatusWrapper& status)
{
  const cloth_sim::ClothStats& stats = condition.stats;
  if (condition.tick_under_way > longest_tick)
  {
    status.summary(DiagnosticStatus::WARN, "a tick has taken " + in_short(condition.tick_under_way) + " s so far");
  }
  else if (condition.new_overruns > 0)
  {
    status.summary(DiagnosticStatus::WARN, std::to_string(condition.new_overruns) + " ticks dropped: too slow");
  }
  else if (stats.paused)
  {
    status.summary(DiagnosticStatus::OK, "paused");
  }
  else
  {
    status.summary(DiagnosticStatus::OK, in_short(condition.tick_rate) + " ticks a second");
  }
  status.add("rate (Hz)", in_short(condition.tick_rate));
  status.add("rate asked for (Hz)", in_short(condition.asked.rate));
  status.add("real-time factor", in_short(stats.real_time_factor));
  status.add("real-time factor asked for", in_short(condition.asked.real_time_factor));
  status.add("overruns", stats.overruns);
  status.add("tick, mean (ms)", in_short(stats.tick_ms_mean));
  status.add("tick, longest (ms)", in_short(stats.tick_ms_max));
}

void report_cloth(const Condition& condition, DiagnosticStatusWrapper& status)
{
  const cloth_sim::ClothStats& stats = condition.stats;
  if (!condition.divergence.empty())
  {
    status.summary(DiagnosticStatus::ERROR, condition.divergence);
  }
  else if (is_unstable(condition))
  {
    status.summary(DiagnosticStatus::WARN, "the step is beyond the stability limit: the cloth will diverge");
  }
  else if (condition.strain_limit > 0.0 && stats.max_strain > allowed_strain_share * condition.strain_limit)
  {
    status.summary(DiagnosticStatus::WARN, strain_of(condition) + ": more strain_limit.sweeps help, or a coarser grid");
  }
  else
  {
    status.summary(DiagnosticStatus::OK, strain_of(condition));
  }
  status.add("worst strain", in_short(stats.max_strain));
  status.add("strain limit", condition.strain_limit > 0.0 ? in_short(condition.strain_limit) : std::string("none"));
  status.add("method", stats.method);
  status.add("time step (s)", format_number(stats.time_step));
  status.add("stability limit (s)", format_number(stats.stability_limit));
  status.add("stability margin", in_short(stability_margin(stats)));
  status.add("steps not solved", stats.unconverged_steps);
  status.add("simulated time (s)", format_number(stats.sim_time));
  status.add("asleep since (s)", condition.asleep_since ? format_number(*condition.asleep_since) : "awake");
}

void report_transforms(const Condition& condition, DiagnosticStatusWrapper& status)
{
  if (!condition.transform)
  {
    status.summary(DiagnosticStatus::OK, "none used");
    return;
  }
  const Frames::Use& use = *condition.transform;
  const bool is_stale = use.age && *use.age > stale_age;
  const std::string age = use.age ? in_short(*use.age) + " s old" : std::string("static");
  status.summary(is_stale ? DiagnosticStatus::WARN : DiagnosticStatus::OK, "from " + use.frame + ": " + age);
  status.add("frame", use.frame);
  status.add("tf age (s)", use.age ? in_short(*use.age) : std::string("static"));
}

Health::Health(const ros::NodeHandle& private_node)
  : updater_(ros::NodeHandle(), private_node, private_node.getNamespace())
{
  updater_.setHardwareID("none");
  const auto add = [this](const char* name, void (*report)(const Condition&, DiagnosticStatusWrapper&)) {
    updater_.add(name, [this, report](DiagnosticStatusWrapper& status) { report(condition_, status); });
  };
  add("ticks", report_ticks);
  add("cloth", report_cloth);
  add("transforms", report_transforms);
}

void Health::publish(const Condition& condition, Clock::time_point now)
{
  condition_ = condition;
  // A reset counts from 0 again.
  condition_.new_overruns = condition.stats.overruns - (condition.stats.overruns >= overruns_ ? overruns_ : 0);
  overruns_ = condition.stats.overruns;
  published_ = now;
  updater_.force_update();
}

}  // namespace cloth
