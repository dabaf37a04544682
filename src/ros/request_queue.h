#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cloth_sim/simulation/simulation.h"

#include "refused_request.h"

namespace cloth
{

/// The one door to the simulation: callbacks of any thread leave requests here, the tick takes them.
class RequestQueue
{
public:
  using Request = std::function<void(Simulation&)>;
  static constexpr size_t most_waiting = 1000;

  /// Throws RefusedRequest when `most_waiting` requests wait already.
  void leave(Request request)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() >= most_waiting)
    {
      throw RefusedRequest("more than " + std::to_string(most_waiting) + " requests wait for the next tick");
    }
    waiting_.push_back(std::move(request));
  }

  /// The wind from the next tick on, m/s; the latest counts.
  void leave_wind(const Eigen::Vector3d& wind)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    wind_ = wind;
  }

  /// All that waits but the wind, in the order in which it came; none waits then.
  std::vector<Request> take_all()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(waiting_, {});
  }
  /// The wind, if one was left since the last call.
  std::optional<Eigen::Vector3d> take_wind()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(wind_, std::nullopt);
  }

private:
  std::mutex mutex_;
  std::vector<Request> waiting_;
  std::optional<Eigen::Vector3d> wind_;
};

}  // namespace cloth
