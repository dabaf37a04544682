#include "cloth_sim/scene/start_state.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace cloth
{
namespace
{

constexpr double pi = 3.14159265358979323846;

double fraction(int index, int count)
{
  return static_cast<double>(index) / std::max(1, count - 1);
}

}  // namespace

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& rpy)
{
  return (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::VectorXd ripple_of(const StartParams& start, const ClothModel& model)
{
  Eigen::VectorXd ripple(model.nodes());
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double a = fraction(model.col_of(i), model.cols);
    const double b = fraction(model.row_of(i), model.rows);
    ripple[i] = start.ripple * (std::sin(2.0 * pi * a + 0.3) + 0.5 * std::sin(3.0 * pi * b + 1.1)) * b;
  }
  return ripple;
}

ClothState start_state(const StartParams& start, const ClothModel& model)
{
  ClothState state;
  state.positions = model.rest_positions;
  state.positions.col(0) *= start.initial_stretch[0];
  state.positions.col(2) *= start.initial_stretch[1];
  state.positions.col(1) += ripple_of(start, model);
  state.positions = (state.positions * rotation_of(start.rpy).transpose()).rowwise() + start.position.transpose();
  state.velocities = start.velocity.transpose().replicate(model.nodes(), 1);
  return state;
}

}  // namespace cloth
