#pragma once

#include <csignal>
#include <string>
#include <vector>

#include <ros/param.h>

#include "child_process.h"
#include "listener.h"

namespace cloth
{

/// The node with `arguments`, and a clean namespace of its own on the parameter server.
class NodeProcess
{
public:
  explicit NodeProcess(const std::vector<std::string>& arguments) : process_(command(arguments))
  {
  }

  /// Ends it in good order, so that it takes its leave of the master: should the next node be given its port, the
  /// listeners of this one would take that for the one that they know, and never listen to it.
  ~NodeProcess()
  {
    if (!process_.exit_status())
    {
      signal(SIGINT);
      wait_for_end();
    }
  }

  bool wait_for_end()
  {
    return wait_until([&] { return process_.exit_status().has_value(); });
  }
  int exit_status()
  {
    return process_.exit_status().value_or(-1);
  }
  std::string output() const
  {
    return process_.output();
  }
  void signal(int number) const
  {
    process_.signal(number);
  }

private:
  static std::vector<std::string> command(const std::vector<std::string>& arguments)
  {
    ros::param::del("/cloth_node");
    std::vector<std::string> words{ CLOTH_NODE };
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }

  ChildProcess process_;
};

}  // namespace cloth
