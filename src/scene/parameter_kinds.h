#pragma once

// The kinds of values that a table may hold: how each is read, checked, written and described.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a number may be; always finite.
struct Range
{
  double low;
  bool low_included;
  double high = infinity;
  bool or_zero = false;

  bool contains(double value) const
  {
    if (or_zero && value == 0.0)
    {
      return true;
    }
    return std::isfinite(value) && (low_included ? value >= low : value > low) && value <= high;
  }

  /// " >= 0.0"; empty where any finite number will do.
  std::string in_words() const
  {
    std::string words;
    if (low > -infinity)
    {
      words += (low_included ? " >= " : " > ") + format_number(low);
    }
    if (high < infinity)
    {
      words += (words.empty() ? " <= " : " and <= ") + format_number(high);
    }
    return words + (or_zero ? ", or 0" : "");
  }
};

constexpr Range any{ -infinity, false };
constexpr Range not_negative{ 0.0, true };
constexpr Range positive{ 0.0, false };
constexpr Range unit_interval{ 0.0, true, 1.0 };

inline double read_number(const YAML::Node& value)
{
  double number = 0.0;
  if (!value.IsScalar() || !YAML::convert<double>::decode(value, number))
  {
    throw std::invalid_argument("not a number");
  }
  return number;
}

inline int read_integer(const YAML::Node& value)
{
  const std::string text = value.IsScalar() ? value.Scalar() : std::string();
  const char* const end = text.data() + text.size();
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const begin = text.data() + (has_plus ? 1 : 0);
  int number = 0;
  const std::from_chars_result result = std::from_chars(begin, end, number);
  if (result.ec != std::errc() || result.ptr != end)
  {
    throw std::invalid_argument("not an integer");
  }
  return number;
}

/// Text that reads as a list is a list: rosparam hands on `[0,0,-1]` as text.
inline YAML::Node read_list(const YAML::Node& value)
{
  YAML::Node list = value;
  if (value.IsScalar())
  {
    list.reset(YAML::Load(value.Scalar()));
  }
  if (!list.IsSequence())
  {
    throw std::invalid_argument("not a list");
  }
  return list;
}

inline void assign(std::string& target, const std::string& word)
{
  target = word;
}

inline void assign(MassLumping& target, const std::string& word)
{
  target = word == "area" ? MassLumping::area : MassLumping::uniform;
}

inline void assign(LimitSolver& target, const std::string& word)
{
  target = word == "tensions" ? LimitSolver::tensions : LimitSolver::plain_sweeps;
}

inline void assign(Precision& target, const std::string& word)
{
  target = word == "mixed" ? Precision::mixed : Precision::in_double;
}

inline void assign(bool& target, const std::string& word)
{
  target = word == "true";
}

inline std::string word_of(const std::string& value)
{
  return value;
}

inline std::string word_of(MassLumping value)
{
  return value == MassLumping::area ? "area" : "uniform";
}

inline std::string word_of(LimitSolver value)
{
  return value == LimitSolver::tensions ? "tensions" : "sweeps";
}

inline std::string word_of(Precision value)
{
  return value == Precision::mixed ? "mixed" : "double";
}

inline std::string word_of(bool value)
{
  return value ? "true" : "false";
}

// An accessor that serves for reading and for writing.
#define CLOTH_MEMBER(path)  \
  [](auto& target) -> auto& \
  {                         \
    return target.path;     \
  }

/// Makes the rows of a table whose values live in a Target. `access` gives the value's place in it.
template <typename Target>
struct RowsOf
{
  template <typename Access>
  static Parameter<Target> integer(const char* key, int low, int high, const char* meaning, Access access)
  {
    Parameter<Target> parameter;
    parameter.key = key;
    parameter.type = "integer";
    parameter.allowed = "an integer from " + std::to_string(low) + " to " + std::to_string(high);
    parameter.meaning = meaning;
    parameter.low = low;
    parameter.high = high;
    parameter.set = [=](const YAML::Node& value, Target& target) {
      const int number = read_integer(value);
      if (number < low || number > high)
      {
        throw std::invalid_argument("out of range");
      }
      access(target) = number;
    };
    parameter.get = [=](const Target& target) { return std::to_string(access(target)); };
    return parameter;
  }

  template <typename Access>
  static Parameter<Target> number(const char* key, const char* unit, const Range& range, const char* meaning,
                                  Access access)
  {
    Parameter<Target> parameter;
    parameter.key = key;
    parameter.type = "number";
    parameter.unit = unit;
    const std::string bounds = range.in_words();
    parameter.allowed = bounds.empty() ? "a finite number" : "a number" + bounds;
    parameter.meaning = meaning;
    set_bounds(parameter, range);
    parameter.set = [=](const YAML::Node& value, Target& target) {
      const double number = read_number(value);
      if (!range.contains(number))
      {
        throw std::invalid_argument("out of range");
      }
      access(target) = number;
    };
    parameter.get = [=](const Target& target) { return format_number(access(target)); };
    return parameter;
  }

  template <typename Access>
  static Parameter<Target> vector(const char* key, const char* unit, const Range& range, const char* meaning,
                                  Access access)
  {
    constexpr int size = std::decay_t<decltype(access(std::declval<Target&>()))>::SizeAtCompileTime;
    Parameter<Target> parameter;
    parameter.key = key;
    parameter.type = "list of " + std::to_string(size) + " numbers";
    parameter.unit = unit;
    const std::string bounds = range.in_words();
    const std::string count = std::to_string(size);
    parameter.allowed =
        bounds.empty() ? "a list of " + count + " finite numbers" : "a list of " + count + " numbers, each" + bounds;
    parameter.meaning = meaning;
    set_bounds(parameter, range);
    parameter.set = [=](const YAML::Node& value, Target& target) {
      const YAML::Node list = read_list(value);
      if (list.size() != static_cast<size_t>(size))
      {
        throw std::invalid_argument("wrong length");
      }
      Eigen::Matrix<double, size, 1> numbers;
      for (int i = 0; i < size; ++i)
      {
        numbers[i] = read_number(list[i]);
        if (!range.contains(numbers[i]))
        {
          throw std::invalid_argument("out of range");
        }
      }
      access(target) = numbers;
    };
    parameter.get = [=](const Target& target) {
      std::vector<std::string> numbers;
      for (const double element : access(target))
      {
        numbers.push_back(format_number(element));
      }
      return "[" + joined(numbers) + "]";
    };
    return parameter;
  }

  /// One of some words.
  template <typename Access>
  static Parameter<Target> choice(const char* key, const std::vector<std::string>& words, const char* meaning,
                                  Access access)
  {
    Parameter<Target> parameter;
    parameter.key = key;
    parameter.type = "text";
    parameter.allowed = "one of " + joined(words);
    parameter.meaning = meaning;
    parameter.set = [=](const YAML::Node& value, Target& target) {
      const std::string word = value.IsScalar() ? value.Scalar() : std::string();
      if (std::find(words.begin(), words.end(), word) == words.end())
      {
        throw std::invalid_argument("not a choice");
      }
      assign(access(target), word);
    };
    parameter.get = [=](const Target& target) { return word_of(access(target)); };
    return parameter;
  }

  /// Text of a form that `is_allowed` tells.
  template <typename Access>
  static Parameter<Target> text(const char* key, bool (*is_allowed)(const std::string&), const char* allowed,
                                const char* meaning, Access access)
  {
    Parameter<Target> parameter;
    parameter.key = key;
    parameter.type = "text";
    parameter.allowed = allowed;
    parameter.meaning = meaning;
    parameter.set = [=](const YAML::Node& value, Target& target) {
      if (!value.IsScalar() || !is_allowed(value.Scalar()))
      {
        throw std::invalid_argument("not of the form");
      }
      access(target) = value.Scalar();
    };
    parameter.get = [=](const Target& target) { return access(target); };
    return parameter;
  }

private:
  static void set_bounds(Parameter<Target>& parameter, const Range& range)
  {
    parameter.low = range.low;
    parameter.high = range.high;
    parameter.or_zero = range.or_zero;
  }
};

}  // namespace cloth
