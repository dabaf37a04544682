#pragma once

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "in_a_folder.h"
#include "scene/scene_text.h"

namespace cloth
{

/// cloth_run as a program.
class ClothRun : public InAFolder
{
protected:
  /// Runs cloth_run with these words as the shell reads them.
  Ended run(const std::string& words) const
  {
    return run_program(CLOTH_RUN, words);
  }

  /// A small sheet that runs in no time.
  std::string small_scene() const
  {
    return write("small.yaml", "cloth: {rows: 4, cols: 5, ripple: 0.02}\n");
  }
};

/// The lines of a CSV file after its header, as numbers.
inline std::vector<std::vector<double>> rows_of(const std::string& csv)
{
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    std::vector<double> row;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
    {
      row.push_back(std::strtod(field.c_str(), nullptr));
    }
    rows.push_back(row);
  }
  return rows;
}

/// The times of the samples of a CSV file, each once.
inline std::vector<double> times_of(const std::string& csv)
{
  std::vector<double> times;
  for (const std::vector<double>& row : rows_of(csv))
  {
    if (row.at(1) == 0.0)
    {
      times.push_back(row.at(0));
    }
  }
  return times;
}

}  // namespace cloth
