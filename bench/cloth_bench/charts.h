#pragma once

#include <string>

namespace cloth
{

/// Has the charts program draw what is in `folder`/runs.csv. What it could not do, in words; empty: it is done.
std::string draw_charts(const std::string& folder);

}  // namespace cloth
