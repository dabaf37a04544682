#include "end_by_signal.h"

#include <csignal>
#include <cstdlib>

#include <ros/init.h>
#include <unistd.h>

namespace cloth
{
namespace
{

void shut_down(int /*signal*/)
{
  if (!ros::isStarted())
  {
    _exit(EXIT_SUCCESS);
  }
  ros::requestShutdown();
}

}  // namespace

void end_by_signal()
{
  std::signal(SIGINT, shut_down);
  std::signal(SIGTERM, shut_down);
}

}  // namespace cloth
