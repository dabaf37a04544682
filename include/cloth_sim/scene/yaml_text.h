#pragma once

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace cloth
{

/// A number as it is written in YAML: the shortest form that reads back the same, always with a point, and with the
/// exponent's sign (1.0e-05), so that every YAML reader takes it for a number. Infinity is `.inf`.
std::string format_number(double value);

/// A value on one line, cut where it is very long: for messages.
std::string shown(const YAML::Node& value);

std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");

}  // namespace cloth
