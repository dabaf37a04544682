#include "journal.h"

namespace cloth
{

Journal::Journal(const std::string& path) : file_(path, measurement_header)
{
  for (const std::string& line : file_.lines())
  {
    measurements_.push_back(measurement_of(line));
  }
}

const Measurement* Journal::find(const Measurement& like, int repeat) const
{
  for (const Measurement& measurement : measurements_)
  {
    if (measurement.repeat == repeat && is_same_row(measurement, like))
    {
      return &measurement;
    }
  }
  return nullptr;
}

void Journal::add(const Measurement& measurement)
{
  file_.add(line_of(measurement));
  measurements_.push_back(measurement);
}

}  // namespace cloth
