#include "clock_publisher.h"

#include <string>
#include <vector>

#include <ros/master.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Clock.h>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

constexpr const char* topic = "/clock";

std::vector<std::string> publishers_of(const std::string& name)
{
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue state;
  request[0] = ros::this_node::getName();
  std::vector<std::string> nodes;
  if (!ros::master::execute("getSystemState", request, response, state, false))
  {
    return nodes;
  }
  XmlRpc::XmlRpcValue& publications = state[0];
  for (int i = 0; i < publications.size(); ++i)
  {
    if (static_cast<std::string>(publications[i][0]) != name)
    {
      continue;
    }
    XmlRpc::XmlRpcValue& publishers = publications[i][1];
    for (int j = 0; j < publishers.size(); ++j)
    {
      nodes.push_back(static_cast<std::string>(publishers[j]));
    }
  }
  return nodes;
}

void require_a_free_clock()
{
  const std::string refusal = "clock_mode is master, ";
  if (!ros::Time::isSimTime())
  {
    throw SceneError(refusal +
                     "but /use_sim_time is not true, so that nobody would go by the clock; allowed: follow, "
                     "or set /use_sim_time to true before the nodes start");
  }
  const std::vector<std::string> publishers = publishers_of(topic);
  if (!publishers.empty())
  {
    throw SceneError(refusal + "but /clock is published already, by " + joined(publishers) +
                     "; allowed: follow, or stop the other publisher");
  }
}

}  // namespace

ClockPublisher::ClockPublisher()
{
  require_a_free_clock();
  constexpr bool latched = true;
  clock_ = node_.advertise<rosgraph_msgs::Clock>(topic, 100, latched);
  const ros::WallTime now = ros::WallTime::now();
  publish({ now.sec, now.nsec });
}

void ClockPublisher::publish(const ros::Time& time)
{
  time_ = time;
  rosgraph_msgs::Clock message;
  message.clock = time;
  clock_.publish(message);
}

}  // namespace cloth
