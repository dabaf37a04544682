#pragma once

#include <fstream>
#include <string>

namespace cloth
{

/// A file that takes the place of `path` as a whole when it is committed, or leaves what was there alone. A path that
/// is no regular file, or lies in /dev or /proc (/dev/stdout), is written to directly; a link is followed.
class ReplacedFile
{
public:
  /// Throws std::runtime_error where nothing can be written beside `path`.
  explicit ReplacedFile(const std::string& path);
  ~ReplacedFile();
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;

  std::ostream& stream()
  {
    return stream_;
  }

  /// Throws std::runtime_error where not all could be written.
  void commit();

  /// Removes what every file not yet committed has written beside its path. May be called by signal handlers.
  static void remove_uncommitted() noexcept;

  /// From now on SIGINT, SIGTERM and SIGHUP do that before they end the program, as they would without.
  static void remove_uncommitted_when_ended();

private:
  bool is_beside_its_path() const
  {
    return written_path_ != path_;
  }

  std::string path_;
  std::string written_path_;
  std::ofstream stream_;
};

}  // namespace cloth
