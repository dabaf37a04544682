#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/wait.h>

#include <gtest/gtest.h>

namespace cloth
{

inline std::string text_of(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What a program left behind.
struct Ended
{
  int status = -1;  ///< exit status; 128 and the signal where one ended it
  std::string output;
  std::string errors;
};

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

  const std::string& folder() const
  {
    return folder_;
  }

  /// Runs a program with these words as the shell reads them.
  Ended run_program(const std::string& program, const std::string& words) const
  {
    const std::string output = path("stdout");
    const std::string errors = path("stderr");
    const std::string command = "'" + program + "' " + words + " > " + output + " 2> " + errors;
    const int status = std::system(command.c_str());
    const Ended ended{ WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(output),
                       text_of(errors) };
    std::filesystem::remove(output);
    std::filesystem::remove(errors);
    return ended;
  }

private:
  std::string folder_;
};

}  // namespace cloth
