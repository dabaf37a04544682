#pragma once

#include <string>
#include <vector>

namespace cloth
{

/// The path of what comes with the program in the folder bench/: beside the installed program, else in the source.
/// Empty: it is in neither.
std::string shipped_file(const std::string& name);

/// The scenes that come with the program, in order of their names; the small ones alone where `small`.
std::vector<std::string> scenes_of_the_program(bool small);

}  // namespace cloth
