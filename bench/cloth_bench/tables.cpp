#include "tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "replaced_file.h"

namespace cloth
{
namespace
{

/// Empty where it is not a number.
std::string field(double number)
{
  if (std::isnan(number))
  {
    return {};
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

std::string field_unless_zero(double number)
{
  return number == 0.0 ? "" : field(number);
}

std::string quoted(std::string text)
{
  std::replace(text.begin(), text.end(), '"', '\'');
  return '"' + text + '"';
}

double median_of(std::vector<double> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  const size_t middle = numbers.size() / 2;
  return numbers.size() % 2 == 1 ? numbers[middle] : 0.5 * (numbers[middle - 1] + numbers[middle]);
}

/// The length of the yardstick while nothing disturbs the machine: a tenth of all runs found it shorter.
double undisturbed_yardstick(const Journal& journal)
{
  std::vector<double> lengths;
  for (const Measurement& measurement : journal.all())
  {
    if (measurement.is_complete())
    {
      lengths.push_back(measurement.yardstick);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths.empty() ? 0.0 : lengths[lengths.size() / 10];
}

bool belongs_to(const Measurement& measurement, const SceneRow& scene)
{
  return measurement.scene == scene.scene && measurement.kind == scene.kind &&
         measurement.fingerprint == scene.fingerprint;
}

bool is_drawn(const Measurement& measurement, const SceneRow& scene)
{
  return !measurement.is_complete() || !(measurement.errors.rms < resolution * scene.reference_error);
}

/// What the repeats of a row would take where the yardstick has the length `yardstick`.
std::vector<double> times_of(const Measurement& row, const Journal& journal, double yardstick)
{
  std::vector<double> times;
  for (const Measurement& measurement : journal.all())
  {
    if (measurement.is_complete() && is_same_row(measurement, row))
    {
      times.push_back(measurement.seconds_per_second / measurement.yardstick * yardstick);
    }
  }
  return times;
}

void write_row(std::ostream& stream, const Measurement& row, const SceneRow& scene, const std::vector<double>& times,
               const Provenance& provenance)
{
  stream << row.scene << ',' << row.kind << ',' << row.solver << ',' << row.setting << ',' << row.value << ','
         << field(scene.horizon) << ',' << row.status << ',';
  if (row.is_complete())
  {
    const auto [low, high] = std::minmax_element(times.begin(), times.end());
    stream << field(row.errors.rms) << ',' << field(row.errors.worst) << ',' << field(row.errors.energy) << ','
           << field(row.errors.strain) << ',' << field(median_of(times)) << ',' << field(*low) << ',' << field(*high)
           << ',' << times.size() << ',' << field(row.force_evaluations) << ',' << field(row.linear_solves) << ',';
  }
  else
  {
    stream << ",,,,,,,,,,";
  }
  stream << field_unless_zero(scene.reference_error) << ',' << row.nodes << ',' << field(scene.tolerance) << ','
         << provenance.machine << ',' << provenance.compiler << ',' << provenance.commit << '\n';
}

}  // namespace

void write_tables(const std::string& folder, const std::vector<SceneRow>& scenes, const Journal& journal,
                  const Provenance& provenance)
{
  ReplacedFile scene_table(folder + "/scenes.csv");
  ReplacedFile run_table(folder + "/runs.csv");
  scene_table.stream() << "scene,kind,accepted,horizon,reference_error,growth,reason\n";
  run_table.stream()
      << "scene,kind,solver,setting,value,horizon,status,rms_error,worst_error,energy_error,strain_error,"
         "seconds_per_second,seconds_per_second_low,seconds_per_second_high,repeats,force_evaluations,"
         "solves,reference_error,nodes,tolerance_line,machine,compiler,commit\n";
  const double yardstick = undisturbed_yardstick(journal);
  for (const SceneRow& scene : scenes)
  {
    scene_table.stream() << scene.scene << ',' << scene.kind << ',' << (scene.accepted ? "yes" : "no") << ','
                         << field(scene.horizon) << ',' << field_unless_zero(scene.reference_error) << ','
                         << field_unless_zero(scene.growth) << ',' << quoted(scene.reason) << '\n';
    for (const Measurement& measurement : journal.all())
    {
      if (measurement.repeat == 0 && belongs_to(measurement, scene) && is_drawn(measurement, scene))
      {
        write_row(run_table.stream(), measurement, scene, times_of(measurement, journal, yardstick), provenance);
      }
    }
  }
  scene_table.commit();
  run_table.commit();
}

}  // namespace cloth
