#include "line_file.h"

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

LineFile::LineFile(const std::string& path, const std::string& header)
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
      throw std::runtime_error(path + " is in use by another run of this program");
    }
    read(header);
  }
  catch (...)
  {
    ::close(file_);
    throw;
  }
}

LineFile::~LineFile()
{
  ::close(file_);
}

void LineFile::add(const std::string& line)
{
  write(line + "\n");
  lines_.push_back(line);
}

void LineFile::read(const std::string& header)
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
    write(header + "\n");
  }
  else if (line != header)
  {
    throw std::runtime_error(path_ + " has other columns than this program writes; give another folder with --out");
  }
  while (std::getline(lines, line))
  {
    lines_.push_back(line);
  }
}

void LineFile::write(const std::string& text)
{
  if (::write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
  {
    throw std::runtime_error(path_ + " cannot be written: " + std::strerror(errno));
  }
}

}  // namespace cloth
