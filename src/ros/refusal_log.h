#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace cloth
{

/// Warns once of each cause of refusal or trouble, however often it comes: the same text again only after `quiet_time`,
/// and no more than `max_causes` texts within it. Goes by a steady clock, because ROS time may stand still. May be used
/// from several threads.
class RefusalLog
{
public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds quiet_time{ 5 };
  static constexpr size_t max_causes = 20;
  /// Characters; of a longer text the beginning is warned.
  static constexpr size_t longest_cause = 500;

  /// `warn` gets the text of each warning.
  explicit RefusalLog(std::function<void(const std::string&)> warn);

  void report(const std::string& cause, Clock::time_point now = Clock::now());

private:
  void forget_before(Clock::time_point time);

  std::function<void(const std::string&)> warn_;
  std::mutex mutex_;
  std::map<std::string, Clock::time_point> warned_;
};

}  // namespace cloth
