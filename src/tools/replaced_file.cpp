#include "replaced_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

namespace cloth
{
namespace
{

/// A stream of the process or a device by its path: not to be replaced, even where it leads to a regular file.
bool is_system_path(const std::string& path)
{
  return path.compare(0, 5, "/dev/") == 0 || path.compare(0, 6, "/proc/") == 0;
}

[[noreturn]] void fail(const std::string& path)
{
  throw std::runtime_error(path + " cannot be written: " + std::strerror(errno));
}

}  // namespace

ReplacedFile::ReplacedFile(const std::string& path) : path_(path), written_path_(path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
  {
    errno = EISDIR;
    fail(path_);
  }
  const bool is_regular = !std::filesystem::exists(path, ignored) || std::filesystem::is_regular_file(path, ignored);
  if (is_regular && !is_system_path(path))
  {
    path_ = std::filesystem::weakly_canonical(path).string();
    written_path_ = path_ + ".part-" + std::to_string(::getpid());
  }
  stream_.open(written_path_, std::ios::trunc);
  if (!stream_)
  {
    fail(path_);
  }
}

ReplacedFile::~ReplacedFile()
{
  if (stream_.is_open() && written_path_ != path_)
  {
    std::remove(written_path_.c_str());
  }
}

void ReplacedFile::commit()
{
  stream_.flush();
  if (!stream_)
  {
    fail(path_);
  }
  if (written_path_ != path_ && std::rename(written_path_.c_str(), path_.c_str()) != 0)
  {
    fail(path_);
  }
  stream_.close();
}

}  // namespace cloth
