#pragma once

#include <string>
#include <vector>

#include "errors.h"
#include "solver.h"

namespace cloth
{

/// One run of one solver at one setting of a scene. Errors are of no meaning where the run did not come to its end.
struct Measurement
{
  std::string scene;
  std::string kind;
  std::string fingerprint;  ///< of what the scene and the settings were
  std::string solver;
  std::string setting;
  std::string value;  ///< as `format_number` has it, which tells settings apart
  int repeat = 0;
  std::string status;
  int nodes = 0;
  Errors errors;                    ///< not a number where it does not apply
  double seconds = 0.0;             ///< of processor time
  double seconds_per_second = 0.0;  ///< processor time per simulated second
  double yardstick = 1.0;           ///< its length meanwhile, s
  double force_evaluations = 0.0;   ///< per simulated second
  double linear_solves = 0.0;       ///< likewise

  /// It came to its end and has errors.
  bool is_complete() const
  {
    return status == name_of(Status::ok) || status == name_of(Status::not_converged);
  }
};

/// Whether both are runs of the same solver at the same setting of the same scene, perhaps repeats.
bool is_same_row(const Measurement& one, const Measurement& other);

/// One line of CSV, without its end, and back. Throws std::runtime_error where it cannot be read.
std::string line_of(const Measurement& measurement);
Measurement measurement_of(const std::string& line);

/// The names of the columns.
extern const char* const measurement_header;

}  // namespace cloth
