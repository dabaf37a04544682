#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace cloth
{

class BenchUsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct BenchOptions
{
  std::vector<std::string> scene_files;  ///< empty: those that come with the program
  std::string folder = "cloth_bench";
  bool quick = false;
  bool charts = true;
  bool help = false;
};

extern const char* const bench_usage;

/// Throws BenchUsageError.
BenchOptions parse_bench_options(int argc, char** argv);

}  // namespace cloth
