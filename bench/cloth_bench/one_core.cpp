#include "one_core.h"

#include <sched.h>

namespace cloth
{

bool stay_on_one_core()
{
  cpu_set_t cores;
  CPU_ZERO(&cores);
  const int core = ::sched_getcpu();
  if (core < 0)
  {
    return false;
  }
  CPU_SET(core, &cores);
  return ::sched_setaffinity(0, sizeof cores, &cores) == 0;
}

}  // namespace cloth
