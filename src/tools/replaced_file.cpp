#include "replaced_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
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
  throw std::runtime_error(path + " cannot be written" + (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
}

// What a signal handler may read: atomic pointers that need no lock.
std::array<std::atomic<const char*>, 8> uncommitted_paths{};
static_assert(std::atomic<const char*>::is_always_lock_free);

/// The first place that holds `from` holds `to` afterwards.
void exchange_path(const char* from, const char* to)
{
  for (std::atomic<const char*>& path : uncommitted_paths)
  {
    const char* expected = from;
    if (path.compare_exchange_strong(expected, to))
    {
      return;
    }
  }
}

/// At once, because what the program would ask next may be minutes away.
void end_without_traces(int signal)
{
  ReplacedFile::remove_uncommitted();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
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
    exchange_path(nullptr, written_path_.c_str());
  }
  stream_.open(written_path_, std::ios::trunc);
  if (!stream_)
  {
    exchange_path(written_path_.c_str(), nullptr);
    fail(path_);
  }
}

ReplacedFile::~ReplacedFile()
{
  if (stream_.is_open() && is_beside_its_path())
  {
    std::remove(written_path_.c_str());
  }
  exchange_path(written_path_.c_str(), nullptr);
}

void ReplacedFile::commit()
{
  errno = 0;
  stream_.flush();
  if (!stream_)
  {
    fail(path_);
  }
  if (is_beside_its_path() && std::rename(written_path_.c_str(), path_.c_str()) != 0)
  {
    fail(path_);
  }
  stream_.close();
}

void ReplacedFile::remove_uncommitted() noexcept
{
  for (const std::atomic<const char*>& path : uncommitted_paths)
  {
    const char* const written = path.load();
    if (written != nullptr)
    {
      ::unlink(written);
    }
  }
}

void ReplacedFile::remove_uncommitted_when_ended()
{
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    std::signal(signal, end_without_traces);
  }
}

}  // namespace cloth
