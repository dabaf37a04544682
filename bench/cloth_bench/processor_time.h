#pragma once

#include <time.h>

namespace cloth
{

/// Of this thread, s: what other programs take from the core meanwhile does not count.
inline double processor_seconds()
{
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace cloth
