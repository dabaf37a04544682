#pragma once

#include <limits>
#include <string>
#include <vector>

namespace cloth
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What a planner chose for a scene at a tolerance, and what came of it.
struct PlanRow
{
  std::string build;  ///< tells programs apart
  std::string commit;
  std::string scene;
  std::string fingerprint;  ///< of the scene
  double tolerance = 0.0;   ///< m
  std::string status;       ///< of the run; refused: there is no plan
  std::string method;
  double time_step = 0.0;         ///< s
  double method_tolerance = 0.0;  ///< m
  int iterations = 0;
  std::string left_out;             ///< by name, with + between; empty: nothing
  double estimate = unknown;        ///< of the error, m
  double true_error = unknown;      ///< against the full model, m
  double worst_error = unknown;     ///< m, of any node at any time
  double estimated_cost = unknown;  ///< s for a simulated second
  double seconds_per_second = unknown;
  double cost = unknown;  ///< yardsticks for a simulated second
  double planning_seconds = unknown;
  double planning = unknown;  ///< yardsticks
  std::string best_solver;    ///< of the search; empty: none met the tolerance
  std::string best_setting;
  std::string best_value;
  double best_error = unknown;  ///< m
  double best_cost = unknown;   ///< yardsticks for a simulated second, measured in turn with the plan's
  std::string message;          ///< why there is no plan
};

/// What one part comes to beside what a plan leaves out.
struct PartRow
{
  std::string build;
  std::string scene;
  std::string fingerprint;
  double tolerance = 0.0;  ///< m
  std::string part;
  bool is_left_out = false;
  double change = unknown;  ///< of the answer, m, root mean square: with it and without
};

extern const char* const plan_header;
extern const char* const part_header;

/// One line of CSV, without its end, and back. Throws std::runtime_error where it cannot be read.
std::string line_of(const PlanRow& row);
PlanRow plan_row_of(const std::string& line);
std::string line_of(const PartRow& row);
PartRow part_row_of(const std::string& line);

}  // namespace cloth
