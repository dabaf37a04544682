#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include "cloth_sim/simulation/simulation.h"

namespace cloth
{

/// The topics ~pins/NAME/wrench: the cloth's force on the holder of each pin. They are advertised in a thread of its
/// own, because that waits for the master. All calls from one thread.
class PinWrenches
{
public:
  /// Below the namespace of `node`.
  explicit PinWrenches(const ros::NodeHandle& node);
  ~PinWrenches();
  PinWrenches(const PinWrenches&) = delete;
  PinWrenches& operator=(const PinWrenches&) = delete;

  /// From now on there are the topics of these pins, and no others; new ones a little later.
  void offer(const std::vector<Pin>& pins);
  /// Somebody listens to one of them.
  bool is_listened_to();
  /// Publishes where somebody listens what `simulation` has measured.
  void publish(const Simulation& simulation, const std::string& frame_id, const ros::Time& stamp);

private:
  /// Keeps the publishers to what is wanted, until the end.
  void advertise();
  std::optional<ros::Publisher> take_unwanted();
  std::optional<std::string> missing() const;

  ros::NodeHandle node_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ends_ = false;
  std::set<std::string> wanted_;                      ///< names of pins
  std::map<std::string, ros::Publisher> publishers_;  ///< by the name of the pin
  std::thread thread_;                                ///< last: it uses the others
};

}  // namespace cloth
