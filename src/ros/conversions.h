#pragma once

#include <vector>

#include <Eigen/Core>

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Vector3.h>
#include <std_msgs/ColorRGBA.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// A tree of the parameter server as YAML. Numbers keep their value to the last bit; text stays a plain scalar, for
/// `read_scene` to take as the number or list that is due; dates and binary data become text that no key allows.
YAML::Node to_yaml(XmlRpc::XmlRpcValue value);

/// The other way: scalars become integers, numbers or truth values where they read as such, else text.
XmlRpc::XmlRpcValue to_parameter(const YAML::Node& value);

Eigen::Vector3d to_eigen(const geometry_msgs::Point& point);
Eigen::Vector3d to_eigen(const geometry_msgs::Vector3& vector);

/// Row `node` of `positions` as a point.
geometry_msgs::Point to_point(const Vectors& positions, int node);

/// Red, green and blue in [0, 1]; opaque.
std_msgs::ColorRGBA to_colour(const Eigen::Vector3d& colour);

/// x y z of each row in turn, as float32. `values` is resized as needed.
void to_float32(const Vectors& rows, std::vector<float>& values);

/// The other way: `values` are x y z of each row in turn, and keep their value. `rows` is resized as needed.
void from_float32(const std::vector<float>& values, Vectors& rows);

}  // namespace cloth
