#pragma once

#include <Eigen/Core>

namespace cloth
{

/// One 3-vector a node: n rows, and the columns x, y, z each contiguous in memory (structure of arrays).
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3>;

}  // namespace cloth
