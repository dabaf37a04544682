#pragma once

#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "child_process.h"
#include "listener.h"

namespace cloth
{

/// roslaunch of one of the package's files; ended properly, because the nodes are children of its own.
class Launch
{
public:
  /// `arguments`: the name of the file, then its arguments.
  explicit Launch(const std::vector<std::string>& arguments) : process_(command(arguments))
  {
  }
  ~Launch()
  {
    end();
  }
  Launch(const Launch&) = delete;
  Launch& operator=(const Launch&) = delete;

  void end()
  {
    const auto has_ended = [&] { return process_.exit_status().has_value(); };
    if (!has_ended())
    {
      process_.signal(SIGINT);
    }
    EXPECT_TRUE(wait_until(has_ended)) << output();
  }
  std::string output() const
  {
    return process_.output();
  }

private:
  static std::vector<std::string> command(const std::vector<std::string>& arguments)
  {
    std::vector<std::string> words{ "roslaunch", "cloth_sim" };
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  }

  ChildProcess process_;
};

}  // namespace cloth
