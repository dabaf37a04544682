#pragma once

#include <string>

namespace cloth
{

/// What the system calls the processor; "unknown processor" where it does not say.
std::string processor_name();

/// Processor time of this thread, s: what other programs take from the core meanwhile does not count.
double processor_seconds();

}  // namespace cloth
