#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include "cloth_sim/ClothStats.h"
#include "cloth_sim/scene/scene_params.h"

#include "frames.h"

namespace cloth
{

/// How the node and its cloth are, for /diagnostics.
struct Condition
{
  cloth_sim::ClothStats stats;           ///< as they were published last
  double tick_rate = 0.0;                ///< Hz, of the period of `stats`
  double tick_under_way = 0.0;           ///< s, how long the present tick has taken so far; 0: none
  NodeParams asked;                      ///< the rate and the factor that are due
  std::uint32_t new_overruns = 0;        ///< since the last report
  double strain_limit = 0.0;             ///< 0: none
  std::string divergence;                ///< in words; empty: none
  std::optional<double> asleep_since;    ///< simulated s; none: the cloth is awake
  std::optional<Frames::Use> transform;  ///< the last that tf was asked for
};

// One status each: level, message and values.

/// Warns where ticks were dropped, or where one does not end.
void report_ticks(const Condition& condition, diagnostic_updater::DiagnosticStatusWrapper& status);
/// An error after a divergence; warns of a step beyond the stability limit and of strain far above the strain limit.
void report_cloth(const Condition& condition, diagnostic_updater::DiagnosticStatusWrapper& status);
/// Warns where the transform was old when it was used.
void report_transforms(const Condition& condition, diagnostic_updater::DiagnosticStatusWrapper& status);

/// Publishes the statuses on /diagnostics, by wall time: once a second, or as ~diagnostic_period says.
class Health
{
public:
  using Clock = std::chrono::steady_clock;

  explicit Health(const ros::NodeHandle& private_node);

  bool due(Clock::time_point now)
  {
    return now - published_ >= std::chrono::duration<double>(updater_.getPeriod());
  }

  /// `condition` but for its new overruns, which are counted here.
  void publish(const Condition& condition, Clock::time_point now);

private:
  Condition condition_;
  std::uint32_t overruns_ = 0;
  Clock::time_point published_;
  diagnostic_updater::Updater updater_;
};

}  // namespace cloth
