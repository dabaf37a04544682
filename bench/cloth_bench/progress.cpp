#include "progress.h"

#include <cstdio>

#include <unistd.h>

namespace cloth
{

Progress::Progress() : is_terminal_(isatty(STDERR_FILENO) != 0)
{
}

void Progress::now(const std::string& what)
{
  if (is_terminal_)
  {
    std::fprintf(stderr, "\r\033[K%d of %d%s: %s", done_ + 1, expected_, time_left().c_str(), what.c_str());
    std::fflush(stderr);
    line_is_open_ = true;
  }
}

void Progress::done(bool worked)
{
  const Clock::time_point here = Clock::now();
  worked_seconds_ += worked ? std::chrono::duration<double>(here - last_).count() : 0.0;
  worked_ += worked ? 1 : 0;
  ++done_;
  last_ = here;
}

void Progress::say(const std::string& line)
{
  std::fprintf(stderr, "%s%s\n", line_is_open_ ? "\r\033[K" : "", line.c_str());
  line_is_open_ = false;
}

std::string Progress::time_left() const
{
  if (worked_ == 0)
  {
    return "";
  }
  const int seconds = static_cast<int>(worked_seconds_ / worked_ * (expected_ - done_));
  char text[48];
  std::snprintf(text, sizeof text, ", about %d:%02d min left", seconds / 60, seconds % 60);
  return text;
}

}  // namespace cloth
