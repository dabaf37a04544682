#include "answering_services.h"

#include <utility>

#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

namespace cloth
{
namespace
{

template <typename Response>
bool respond(Answer answer, Response& response)
{
  response.success = answer.success;
  response.message = std::move(answer.message);
  return true;
}

}  // namespace

ros::ServiceServer advertise_trigger(ros::NodeHandle& node, const std::string& name, std::function<Answer()> action)
{
  using std_srvs::Trigger;
  const boost::function<bool(Trigger::Request&, Trigger::Response&)> serve =
      [action = std::move(action)](Trigger::Request& /*request*/, Trigger::Response& response) {
        return respond(action(), response);
      };
  return node.advertiseService(name, serve);
}

ros::ServiceServer advertise_switch(ros::NodeHandle& node, const std::string& name, std::function<Answer(bool)> action)
{
  using std_srvs::SetBool;
  const boost::function<bool(SetBool::Request&, SetBool::Response&)> serve =
      [action = std::move(action)](SetBool::Request& request, SetBool::Response& response) {
        return respond(action(request.data != 0), response);
      };
  return node.advertiseService(name, serve);
}

}  // namespace cloth
