#include "bag_files.h"

namespace cloth
{

std::vector<std::string> bag_files(const std::string& text)
{
  std::vector<std::string> files;
  bool in_name = false;
  bool is_escaped = false;
  for (const char character : text)
  {
    const bool is_escape = character == '\\' && !is_escaped;
    const bool is_separator = character == ' ' && !is_escaped;
    if (!is_separator && !in_name)
    {
      files.emplace_back();
    }
    in_name = !is_separator;
    if (!is_separator && !is_escape)
    {
      files.back() += character;
    }
    is_escaped = is_escape;
  }
  return files;
}

}  // namespace cloth
