#pragma once

namespace cloth
{

/// Keeps this program to the core that it is on. False: the system does not let it.
bool stay_on_one_core();

}  // namespace cloth
