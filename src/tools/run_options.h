#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cloth
{

/// A command line that cannot be followed.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The command line of cloth_run.
struct RunOptions
{
  std::string scene_file;
  double duration = 5.0;                                      ///< s
  double every = 0.0333;                                      ///< s between two samples
  std::vector<std::pair<std::string, std::string>> settings;  ///< dotted key and value, in the order given
  std::string output_file;                                    ///< empty: none
  std::string summary_file;                                   ///< empty: none
  std::string plan_file;                                      ///< with a choice that was made before; empty: none
  bool plan_only = false;
  bool help = false;
};

/// Throws UsageError with the option, its value and what is allowed.
RunOptions parse_run_options(int argc, char** argv);

extern const char* const run_usage;

}  // namespace cloth
