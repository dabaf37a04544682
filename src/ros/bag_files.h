#pragma once

#include <string>
#include <vector>

namespace cloth
{

/// The files that `text` lists, separated by blanks; a backslash makes the character after it, also a blank, part of a
/// name, as it does for `args` in a launch file.
std::vector<std::string> bag_files(const std::string& text);

}  // namespace cloth
