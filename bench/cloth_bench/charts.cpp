#include "charts.h"

#include <vector>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "shipped_files.h"

extern char** environ;

namespace cloth
{
namespace
{

/// The first python3 on the path may be a version manager's, without the system's packages.
std::string python()
{
  const char* const of_the_system = "/usr/bin/python3";
  return ::access(of_the_system, X_OK) == 0 ? of_the_system : "python3";
}

/// The exit status; other than 0 also where the program cannot be started.
int status_of(std::vector<std::string> words)
{
  std::vector<char*> arguments;
  for (std::string& word : words)
  {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = -1;
  if (::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0 ||
      ::waitpid(child, &status, 0) != child)
  {
    return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string draw_charts(const std::string& folder, const std::string& command)
{
  const std::string program = shipped_file("plot_work_precision.py");
  if (program.empty())
  {
    return "no charts: plot_work_precision.py is not where it should be";
  }
  const std::string has_matplotlib =
      "import importlib.util, sys; sys.exit(importlib.util.find_spec('matplotlib') is None)";
  if (status_of({ python(), "-c", has_matplotlib }) != 0)
  {
    return "no charts: matplotlib (python3-matplotlib) is missing; afterwards: " + program + " " + folder +
           "/runs.csv " + folder;
  }
  const int status = status_of({ python(), program, folder + "/runs.csv", folder, "--command", command });
  return status == 0 ? "" : "no charts: " + program + " failed";
}

}  // namespace cloth
