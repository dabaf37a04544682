#pragma once

#include <string>
#include <vector>

namespace cloth
{

/// A header and lines that are kept one by one as they are added: whatever ends the program, no whole line is lost. One
/// program at a time may have the file.
class LineFile
{
public:
  /// Reads what is there; a last line that was cut short is taken out. Throws std::runtime_error where the file cannot
  /// be read or written, begins with another header, or another program has it.
  LineFile(const std::string& path, const std::string& header);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// All lines after the header, without their ends.
  const std::vector<std::string>& lines() const
  {
    return lines_;
  }
  void add(const std::string& line);

private:
  void read(const std::string& header);
  void write(const std::string& text);

  std::string path_;
  int file_;
  std::vector<std::string> lines_;
};

}  // namespace cloth
