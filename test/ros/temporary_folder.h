#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

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
    std::error_code is_left;
    std::filesystem::remove_all(path_, is_left);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// The path of a file in it.
  std::string file(const std::string& name) const
  {
    return path_ + "/" + name;
  }

private:
  std::string path_;
};

}  // namespace cloth
