#pragma once

#include <chrono>
#include <string>

namespace cloth
{

/// Tells how far a long work is: on a terminal in a line that is written over, with the time left; elsewhere in a line
/// for every scene.
class Progress
{
public:
  Progress();

  /// So many parts more are to be done.
  void expect(int parts)
  {
    expected_ += parts;
  }
  /// What is being done now.
  void now(const std::string& what);
  /// One part is done; `worked` false: it had been done before.
  void done(bool worked);
  /// A line that stays.
  void say(const std::string& line);

private:
  using Clock = std::chrono::steady_clock;

  std::string time_left() const;

  bool is_terminal_;
  bool line_is_open_ = false;
  int expected_ = 0;
  int done_ = 0;
  int worked_ = 0;
  double worked_seconds_ = 0.0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace cloth
