#pragma once

#include <exception>

namespace cloth
{

/// Logs why the node cannot go on, a fatal entry for each line of `error`.
void log_fault(const std::exception& error);

}  // namespace cloth
