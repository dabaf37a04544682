#include "conversions.h"

#include <string>

#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

using Float32Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

YAML::Node map_of(XmlRpc::XmlRpcValue& value)
{
  YAML::Node map(YAML::NodeType::Map);
  for (auto& entry : value)
  {
    map[entry.first] = to_yaml(entry.second);
  }
  return map;
}

YAML::Node sequence_of(XmlRpc::XmlRpcValue& value)
{
  YAML::Node sequence(YAML::NodeType::Sequence);
  for (int i = 0; i < value.size(); ++i)
  {
    sequence.push_back(to_yaml(value[i]));
  }
  return sequence;
}

XmlRpc::XmlRpcValue to_scalar_parameter(const YAML::Node& scalar)
{
  int integer = 0;
  double number = 0.0;
  bool truth = false;
  if (YAML::convert<int>::decode(scalar, integer))
  {
    return XmlRpc::XmlRpcValue(integer);
  }
  if (YAML::convert<double>::decode(scalar, number))
  {
    return XmlRpc::XmlRpcValue(number);
  }
  if (YAML::convert<bool>::decode(scalar, truth))
  {
    return XmlRpc::XmlRpcValue(truth);
  }
  return XmlRpc::XmlRpcValue(scalar.Scalar());
}

}  // namespace

YAML::Node to_yaml(XmlRpc::XmlRpcValue value)
{
  switch (value.getType())
  {
    case XmlRpc::XmlRpcValue::TypeInvalid:
      return YAML::Node();
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool&>(value) ? "true" : "false");
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(std::to_string(static_cast<int&>(value)));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(format_number(static_cast<double&>(value)));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string&>(value));
    case XmlRpc::XmlRpcValue::TypeArray:
      return sequence_of(value);
    case XmlRpc::XmlRpcValue::TypeStruct:
      return map_of(value);
    case XmlRpc::XmlRpcValue::TypeDateTime:
      return YAML::Node("(a date)");
    default:
      return YAML::Node("(binary data)");
  }
}

XmlRpc::XmlRpcValue to_parameter(const YAML::Node& value)
{
  if (value.IsScalar())
  {
    return to_scalar_parameter(value);
  }
  XmlRpc::XmlRpcValue parameter;
  if (value.IsSequence())
  {
    parameter.setSize(static_cast<int>(value.size()));
    for (size_t i = 0; i < value.size(); ++i)
    {
      parameter[static_cast<int>(i)] = to_parameter(value[i]);
    }
  }
  for (const auto& entry : value.IsMap() ? value : YAML::Node())
  {
    parameter[entry.first.as<std::string>()] = to_parameter(entry.second);
  }
  return parameter;
}

Eigen::Vector3d to_eigen(const geometry_msgs::Point& point)
{
  return { point.x, point.y, point.z };
}

Eigen::Vector3d to_eigen(const geometry_msgs::Vector3& vector)
{
  return { vector.x, vector.y, vector.z };
}

geometry_msgs::Point to_point(const Vectors& positions, int node)
{
  geometry_msgs::Point point;
  point.x = positions(node, 0);
  point.y = positions(node, 1);
  point.z = positions(node, 2);
  return point;
}

std_msgs::ColorRGBA to_colour(const Eigen::Vector3d& colour)
{
  std_msgs::ColorRGBA message;
  message.r = static_cast<float>(colour.x());
  message.g = static_cast<float>(colour.y());
  message.b = static_cast<float>(colour.z());
  message.a = 1.0F;
  return message;
}

void to_float32(const Vectors& rows, std::vector<float>& values)
{
  values.resize(static_cast<size_t>(rows.size()));
  Eigen::Map<Float32Rows>(values.data(), rows.rows(), 3) = rows.cast<float>();
}

void from_float32(const std::vector<float>& values, Vectors& rows)
{
  rows = Eigen::Map<const Float32Rows>(values.data(), static_cast<Eigen::Index>(values.size() / 3), 3).cast<double>();
}

}  // namespace cloth
