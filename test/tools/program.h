#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "scene/scene_text.h"

namespace cloth
{

inline std::string text_of(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Tests that write files do it in a folder of their own, which goes with them.
class InAFolder : public testing::Test
{
protected:
  InAFolder()
  {
    std::string pattern = testing::TempDir() + "cloth_sim_XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr)
    {
      throw std::runtime_error("no folder for the test's files");
    }
    folder_ = pattern;
  }
  ~InAFolder() override
  {
    std::error_code ignored;
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string path(const std::string& name) const
  {
    return folder_ + "/" + name;
  }
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  std::vector<std::string> files() const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
    {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

private:
  std::string folder_;
};

/// What a program left behind.
struct Ended
{
  int status = -1;  ///< exit status; 128 and the signal where one ended it
  std::string output;
  std::string errors;
};

/// cloth_run as a program.
class ClothRun : public InAFolder
{
protected:
  /// Runs cloth_run with these words as the shell reads them.
  Ended run(const std::string& words) const
  {
    const std::string output = path("stdout");
    const std::string errors = path("stderr");
    const std::string command = std::string("'") + CLOTH_RUN + "' " + words + " > " + output + " 2> " + errors;
    const int status = std::system(command.c_str());
    const Ended ended{ WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(output),
                       text_of(errors) };
    std::filesystem::remove(output);
    std::filesystem::remove(errors);
    return ended;
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
