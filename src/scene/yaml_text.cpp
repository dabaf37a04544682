#include "cloth_sim/scene/yaml_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace cloth
{

std::string format_number(double value)
{
  if (std::isnan(value))
  {
    return ".nan";
  }
  if (std::isinf(value))
  {
    return value > 0.0 ? ".inf" : "-.inf";
  }
  char buffer[32];
  const std::to_chars_result result = std::to_chars(buffer, buffer + sizeof buffer, value);
  std::string text(buffer, result.ptr);
  if (text.find('.') == std::string::npos)
  {
    text.insert(std::min(text.size(), text.find('e')), ".0");
  }
  return text;
}

std::string shown(const YAML::Node& value)
{
  if (!value.IsDefined() || value.IsNull())
  {
    return "~";
  }
  YAML::Emitter emitter;
  emitter.SetSeqFormat(YAML::Flow);
  emitter.SetMapFormat(YAML::Flow);
  emitter << value;
  constexpr size_t longest = 80;
  const std::string text = emitter.c_str();
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

std::string joined(const std::vector<std::string>& words, const std::string& separator)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (&word == &words.front() ? "" : separator) + word;
  }
  return text;
}

}  // namespace cloth
