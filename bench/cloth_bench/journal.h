#pragma once

#include <string>
#include <vector>

#include "measurement.h"

namespace cloth
{

/// All measurements in a folder, kept line by line as they are made: whatever ends the program, no more is lost than
/// the run that it was at. One program at a time may have it.
class Journal
{
public:
  /// Reads what is there; a last line that was cut short is taken out. Throws std::runtime_error where the file cannot
  /// be read or written, or another program has it.
  explicit Journal(const std::string& path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// That repeat of the row of `like`, or null. Not to be kept beyond `add`.
  const Measurement* find(const Measurement& like, int repeat) const;
  void add(const Measurement& measurement);
  const std::vector<Measurement>& all() const
  {
    return measurements_;
  }

private:
  void read();
  void write(const std::string& text);

  std::string path_;
  int file_;
  std::vector<Measurement> measurements_;
};

}  // namespace cloth
