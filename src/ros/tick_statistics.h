#pragma once

#include <chrono>

namespace cloth
{

/// What the ticks of one period of wall time took.
struct TickReport
{
  double real_time_factor = 0.0;  ///< simulated seconds for each second of wall time
  double tick_ms_mean = 0.0;      ///< ms; 0 where there was no tick
  double tick_ms_max = 0.0;       ///< ms
  double rate = 0.0;              ///< ticks for each second of wall time
};

/// Gathers tick durations, and sums them up once a second of wall time.
class TickStatistics
{
public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds period{ 1 };

  explicit TickStatistics(Clock::time_point start);

  void add(Clock::duration tick);

  bool due(Clock::time_point now) const
  {
    return now - start_ >= period;
  }

  /// The simulated time, which is now `simulated_time` (s), begins at 0 again.
  void restart(double simulated_time)
  {
    simulated_at_start_ -= simulated_time;
  }

  /// The period that ends now, at `simulated_time` (s); begins the next.
  TickReport take(Clock::time_point now, double simulated_time);

private:
  using Milliseconds = std::chrono::duration<double, std::milli>;

  Clock::time_point start_;
  double simulated_at_start_ = 0.0;
  int ticks_ = 0;
  Milliseconds total_{ 0.0 };
  Milliseconds longest_{ 0.0 };
};

}  // namespace cloth
