#include "matrix_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace cloth
{
namespace
{

/// Empty where it is unknown.
std::string exact(double number)
{
  if (std::isnan(number))
  {
    return {};
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

double number_of(const std::string& text)
{
  return text.empty() ? unknown : std::strtod(text.c_str(), nullptr);
}

/// On one line, without what ends a field.
std::string as_field(std::string text)
{
  for (char& letter : text)
  {
    letter = letter == ',' ? ';' : letter == '"' ? '\'' : letter == '\n' ? ' ' : letter;
  }
  return text;
}

std::string line_with(const std::vector<std::string>& fields)
{
  std::string line;
  for (const std::string& field : fields)
  {
    line += (&field == &fields.front() ? "" : ",") + as_field(field);
  }
  return line;
}

std::vector<std::string> fields_of(const std::string& line, const char* header)
{
  std::vector<std::string> fields(1);
  for (const char letter : line)
  {
    letter == ',' ? fields.emplace_back() : fields.back() += letter;
  }
  const std::string names = header;
  if (static_cast<long>(fields.size()) != std::count(names.begin(), names.end(), ',') + 1)
  {
    throw std::runtime_error("not a line of " + names + ": " + line);
  }
  return fields;
}

}  // namespace

const char* const plan_header =
    "build,commit,scene,fingerprint,tolerance,status,method,time_step,method_tolerance,iterations,left_out,estimate,"
    "true_error,worst_error,estimated_cost,seconds_per_second,cost,planning_seconds,planning,best_solver,best_setting,"
    "best_value,best_error,best_cost,message";
const char* const part_header = "build,scene,fingerprint,tolerance,part,is_left_out,change";

std::string line_of(const PlanRow& row)
{
  return line_with({ row.build,
                     row.commit,
                     row.scene,
                     row.fingerprint,
                     exact(row.tolerance),
                     row.status,
                     row.method,
                     exact(row.time_step),
                     exact(row.method_tolerance),
                     std::to_string(row.iterations),
                     row.left_out,
                     exact(row.estimate),
                     exact(row.true_error),
                     exact(row.worst_error),
                     exact(row.estimated_cost),
                     exact(row.seconds_per_second),
                     exact(row.cost),
                     exact(row.planning_seconds),
                     exact(row.planning),
                     row.best_solver,
                     row.best_setting,
                     row.best_value,
                     exact(row.best_error),
                     exact(row.best_cost),
                     row.message });
}

PlanRow plan_row_of(const std::string& line)
{
  const std::vector<std::string> fields = fields_of(line, plan_header);
  size_t at = 0;
  const auto text = [&] { return fields[at++]; };
  const auto number = [&] { return number_of(fields[at++]); };
  PlanRow row;
  row.build = text();
  row.commit = text();
  row.scene = text();
  row.fingerprint = text();
  row.tolerance = number();
  row.status = text();
  row.method = text();
  row.time_step = number();
  row.method_tolerance = number();
  row.iterations = static_cast<int>(number());
  row.left_out = text();
  row.estimate = number();
  row.true_error = number();
  row.worst_error = number();
  row.estimated_cost = number();
  row.seconds_per_second = number();
  row.cost = number();
  row.planning_seconds = number();
  row.planning = number();
  row.best_solver = text();
  row.best_setting = text();
  row.best_value = text();
  row.best_error = number();
  row.best_cost = number();
  row.message = text();
  return row;
}

std::string line_of(const PartRow& row)
{
  return line_with({ row.build, row.scene, row.fingerprint, exact(row.tolerance), row.part,
                     row.is_left_out ? "yes" : "no", exact(row.change) });
}

PartRow part_row_of(const std::string& line)
{
  const std::vector<std::string> fields = fields_of(line, part_header);
  return { fields[0], fields[1], fields[2], number_of(fields[3]), fields[4], fields[5] == "yes", number_of(fields[6]) };
}

}  // namespace cloth
