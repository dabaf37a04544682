#pragma once

#include <ostream>

namespace cloth
{

/// Measures for half a minute, and writes as CSV, how long a step may be: for every method of the table and a range of
/// damping ratios zeta, measured and predicted, as z = omega h, and measured over predicted.
void write_stability_map(std::ostream& output);

}  // namespace cloth
