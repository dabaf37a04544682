#include "fault_log.h"

#include <sstream>
#include <string>

#include <ros/console.h>

namespace cloth
{

void log_fault(const std::exception& error)
{
  std::istringstream faults(error.what());
  for (std::string fault; std::getline(faults, fault);)
  {
    ROS_FATAL("%s", fault.c_str());
  }
}

}  // namespace cloth
