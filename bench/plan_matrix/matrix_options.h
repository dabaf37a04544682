#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "plan_trial.h"
#include "scene_search.h"

namespace cloth
{

class MatrixUsageError : public std::invalid_argument
{
public:
  using std::invalid_argument::invalid_argument;
};

struct MatrixOptions
{
  std::string folder = "plan_matrix";
  std::vector<Half> halves{ Half::development, Half::held_out };
  bool searches = true;
  bool plans = true;
  MatrixSettings settings;
  TrialSettings trial;
  bool help = false;
};

extern const char* const matrix_usage;

/// Throws MatrixUsageError with what is wrong and what is allowed.
MatrixOptions parse_matrix_options(int argc, char** argv);

}  // namespace cloth
