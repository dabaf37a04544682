#pragma once

#include <string>

namespace cloth
{

/// Has the charts program draw what is in `folder`/runs.csv; `command` is what it says that was made by. What it could
/// not do, in words; empty: it is done.
std::string draw_charts(const std::string& folder, const std::string& command);

}  // namespace cloth
