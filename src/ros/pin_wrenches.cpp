#include "pin_wrenches.h"

#include <algorithm>
#include <utility>

#include <boost/make_shared.hpp>
#include <geometry_msgs/WrenchStamped.h>

#include "conversions.h"

namespace cloth
{
namespace
{

geometry_msgs::Vector3 to_vector(const Eigen::Vector3d& from)
{
  geometry_msgs::Vector3 vector;
  vector.x = from.x();
  vector.y = from.y();
  vector.z = from.z();
  return vector;
}

}  // namespace

PinWrenches::PinWrenches(const ros::NodeHandle& node) : node_(node), thread_([this] { advertise(); })
{
}

PinWrenches::~PinWrenches()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void PinWrenches::offer(const std::vector<Pin>& pins)
{
  std::set<std::string> names;
  for (const Pin& pin : pins)
  {
    names.insert(pin.name);
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (names == wanted_)
    {
      return;
    }
    wanted_ = std::move(names);
  }
  changed_.notify_one();
}

bool PinWrenches::is_listened_to()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(publishers_.begin(), publishers_.end(),
                     [](const auto& entry) { return entry.second.getNumSubscribers() > 0; });
}

void PinWrenches::publish(const Simulation& simulation, const std::string& frame_id, const ros::Time& stamp)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [name, publisher] : publishers_)
  {
    const Pin* const pin = simulation.pins().find(name);
    if (pin == nullptr || publisher.getNumSubscribers() == 0)
    {
      continue;
    }
    const Wrench wrench = simulation.reaction_on(*pin);
    const auto message = boost::make_shared<geometry_msgs::WrenchStamped>();
    message->header.frame_id = frame_id;
    message->header.stamp = stamp;
    message->wrench.force = to_vector(wrench.force);
    message->wrench.torque = to_vector(wrench.torque);
    publisher.publish(message);
  }
}

void PinWrenches::advertise()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ends_)
  {
    if (auto unwanted = take_unwanted())
    {
      lock.unlock();
      unwanted->shutdown();
      lock.lock();
    }
    else if (const auto name = missing())
    {
      lock.unlock();
      const auto publisher = node_.advertise<geometry_msgs::WrenchStamped>("pins/" + *name + "/wrench", 100);
      lock.lock();
      publishers_[*name] = publisher;
    }
    else
    {
      changed_.wait(lock);
    }
  }
}

std::optional<ros::Publisher> PinWrenches::take_unwanted()
{
  const auto unwanted = std::find_if(publishers_.begin(), publishers_.end(),
                                     [this](const auto& entry) { return wanted_.count(entry.first) == 0; });
  if (unwanted == publishers_.end())
  {
    return std::nullopt;
  }
  const ros::Publisher publisher = unwanted->second;
  publishers_.erase(unwanted);
  return publisher;
}

std::optional<std::string> PinWrenches::missing() const
{
  const auto found = std::find_if(wanted_.begin(), wanted_.end(),
                                  [this](const std::string& name) { return publishers_.count(name) == 0; });
  return found == wanted_.end() ? std::nullopt : std::make_optional(*found);
}

}  // namespace cloth
