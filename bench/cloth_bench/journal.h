#pragma once

#include <string>
#include <vector>

#include "line_file.h"
#include "measurement.h"

namespace cloth
{

/// All measurements in a folder, kept as they are made: whatever ends the program, no more is lost than the run that it
/// was at.
class Journal
{
public:
  /// Throws std::runtime_error where the file cannot be read or written, or another program has it.
  explicit Journal(const std::string& path);

  /// That repeat of the row of `like`, or null. Not to be kept beyond `add`.
  const Measurement* find(const Measurement& like, int repeat) const;
  void add(const Measurement& measurement);
  const std::vector<Measurement>& all() const
  {
    return measurements_;
  }

private:
  LineFile file_;
  std::vector<Measurement> measurements_;
};

}  // namespace cloth
