#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace cloth
{

/// A program that a test runs beside itself; killed at the end if it still runs.
class ChildProcess
{
public:
  /// `command` is found by PATH. What it prints goes to a file of its own.
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) const;

  /// Its exit status, 128 + n after a signal n; nothing while it runs.
  std::optional<int> exit_status();

  /// All that it has printed on both streams.
  std::string output() const;

private:
  pid_t pid_ = -1;
  std::string output_file_;
  std::optional<int> exit_status_;
};

}  // namespace cloth
