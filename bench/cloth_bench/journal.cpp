#include "journal.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace cloth
{

Journal::Journal(const std::string& path)
  : path_(path), file_(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644))
{
  if (file_ < 0)
  {
    throw std::runtime_error(path + " cannot be written: " + std::strerror(errno));
  }
  try
  {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
    {
      throw std::runtime_error(path + " is in use by another cloth_bench");
    }
    read();
  }
  catch (...)
  {
    ::close(file_);
    throw;
  }
}

Journal::~Journal()
{
  ::close(file_);
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
  write(line_of(measurement) + "\n");
  measurements_.push_back(measurement);
}

void Journal::read()
{
  std::ifstream stream(path_, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  std::string text = content.str();
  const size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (::ftruncate(file_, static_cast<off_t>(whole)) != 0)
  {
    throw std::runtime_error(path_ + " cannot be written: " + std::strerror(errno));
  }
  text.resize(whole);
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line))
  {
    write(std::string(measurement_header) + "\n");
  }
  else if (line != measurement_header)
  {
    throw std::runtime_error(path_ + " is no journal of this cloth_bench; give another folder with --out");
  }
  while (std::getline(lines, line))
  {
    measurements_.push_back(measurement_of(line));
  }
}

void Journal::write(const std::string& text)
{
  if (::write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
  {
    throw std::runtime_error(path_ + " cannot be written: " + std::strerror(errno));
  }
}

}  // namespace cloth
