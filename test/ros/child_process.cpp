#include "child_process.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <sys/wait.h>
#include <unistd.h>

namespace cloth
{

ChildProcess::ChildProcess(const std::vector<std::string>& command)
{
  std::string pattern = "/tmp/cloth_sim_test_XXXXXX";
  const int file = mkstemp(pattern.data());
  if (file < 0)
  {
    throw std::runtime_error("no temporary file in /tmp");
  }
  output_file_ = pattern;
  std::vector<char*> arguments;
  for (const std::string& word : command)
  {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0)
  {
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(file);
}

ChildProcess::~ChildProcess()
{
  if (!exit_status())
  {
    signal(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  std::remove(output_file_.c_str());
}

void ChildProcess::signal(int number) const
{
  kill(pid_, number);
}

std::optional<int> ChildProcess::exit_status()
{
  int status = 0;
  if (!exit_status_ && waitpid(pid_, &status, WNOHANG) == pid_)
  {
    exit_status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return exit_status_;
}

std::string ChildProcess::output() const
{
  std::ostringstream text;
  text << std::ifstream(output_file_).rdbuf();
  return text.str();
}

}  // namespace cloth
