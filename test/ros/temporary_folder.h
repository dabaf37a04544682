#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace cloth
{

/// A folder for a test's files, removed with those at the end.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string pattern = "/tmp/cloth_sim_files_XXXXXX";
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder()
  {
    for (const std::string& file : files_)
    {
      std::remove(file.c_str());
    }
    std::remove(path_.c_str());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// The path of a file in it.
  std::string file(const std::string& name)
  {
    files_.push_back(path_ + "/" + name);
    return files_.back();
  }

private:
  std::string path_;
  std::vector<std::string> files_;
};

}  // namespace cloth
