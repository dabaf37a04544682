#include "measurement.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace cloth
{
namespace
{

std::string exact(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

}  // namespace

const char* const measurement_header =
    "scene,kind,fingerprint,solver,setting,value,repeat,status,nodes,rms_error,worst_error,energy_error,strain_error,"
    "seconds,seconds_per_second,yardstick,force_evaluations,solves";

bool is_same_row(const Measurement& one, const Measurement& other)
{
  return one.scene == other.scene && one.kind == other.kind && one.fingerprint == other.fingerprint &&
         one.solver == other.solver && one.setting == other.setting && one.value == other.value;
}

std::string line_of(const Measurement& m)
{
  std::ostringstream line;
  line << m.scene << ',' << m.kind << ',' << m.fingerprint << ',' << m.solver << ',' << m.setting << ',' << m.value
       << ',' << m.repeat << ',' << m.status << ',' << m.nodes;
  for (const double number : { m.errors.rms, m.errors.worst, m.errors.energy, m.errors.strain, m.seconds,
                               m.seconds_per_second, m.yardstick, m.force_evaluations, m.linear_solves })
  {
    line << ',' << exact(number);
  }
  return line.str();
}

Measurement measurement_of(const std::string& line)
{
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
  {
    fields.push_back(field);
  }
  if (fields.size() != 18)
  {
    throw std::runtime_error("no measurement: " + line);
  }
  const auto number = [&fields](size_t field) { return std::strtod(fields[field].c_str(), nullptr); };
  Measurement m;
  m.scene = fields[0];
  m.kind = fields[1];
  m.fingerprint = fields[2];
  m.solver = fields[3];
  m.setting = fields[4];
  m.value = fields[5];
  m.repeat = static_cast<int>(number(6));
  m.status = fields[7];
  m.nodes = static_cast<int>(number(8));
  m.errors = { number(9), number(10), number(11), number(12) };
  m.seconds = number(13);
  m.seconds_per_second = number(14);
  m.yardstick = number(15);
  m.force_evaluations = number(16);
  m.linear_solves = number(17);
  return m;
}

}  // namespace cloth
