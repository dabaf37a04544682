#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>

namespace cloth
{

/// Generous: only a test that fails waits so long.
constexpr std::chrono::seconds patience{ 20 };

/// Runs callbacks until `condition` holds, which is asked after each of them: none that comes later has run then.
/// False: it did not in time.
inline bool wait_until(const std::function<bool()>& condition)
{
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition())
  {
    if (!ros::ok() || std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(0.005));
  }
  return true;
}

/// Keeps all that comes on a topic.
template <typename Message>
class Listener
{
public:
  explicit Listener(const std::string& topic) : subscriber_(node_.subscribe(topic, 1000, &Listener::take, this))
  {
  }

  const std::deque<Message>& all() const
  {
    return messages_;
  }
  const Message& last() const
  {
    return messages_.back();
  }
  std::uint32_t publishers() const
  {
    return subscriber_.getNumPublishers();
  }
  bool latched() const
  {
    return latched_;
  }
  void forget()
  {
    messages_.clear();
  }

  /// Waits until `count` messages are there.
  bool wait_for(size_t count)
  {
    return wait_until([&] { return messages_.size() >= count; });
  }
  /// Waits for `count` messages more.
  bool wait_for_more(size_t count)
  {
    return wait_for(messages_.size() + count);
  }
  /// Waits for a message from now on that fulfils `condition`; it is the last one then.
  bool wait_for_one(const std::function<bool(const Message&)>& condition)
  {
    size_t seen = messages_.size();
    return wait_until([&] {
      const bool is_new = messages_.size() > seen;
      seen = messages_.size();
      return is_new && condition(messages_.back());
    });
  }

private:
  void take(const ros::MessageEvent<const Message>& event)
  {
    messages_.push_back(*event.getConstMessage());
    latched_ = event.getConnectionHeader()["latching"] == "1";
  }

  ros::NodeHandle node_;
  std::deque<Message> messages_;
  bool latched_ = false;
  ros::Subscriber subscriber_;
};

}  // namespace cloth
