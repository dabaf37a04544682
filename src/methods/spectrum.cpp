#include "cloth_sim/methods/spectrum.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>

#include "cloth_sim/forces/springs.h"

namespace cloth
{
namespace
{

constexpr int lanczos_steps = 16;
constexpr double margin = 1.02;

Vectors noise(int nodes)
{
  std::mt19937 generator(1);
  Vectors vectors(nodes, 3);
  for (Eigen::Index i = 0; i < vectors.size(); ++i)
  {
    vectors.data()[i] = static_cast<double>(generator()) / generator.max() - 0.5;
  }
  return vectors;
}

/// The largest eigenvalue of the symmetric tridiagonal matrix that Lanczos made, and how far an eigenvalue of the
/// whole matrix can be from it.
double ritz_value_and_residual(const std::vector<double>& diagonal, const std::vector<double>& beside)
{
  const Eigen::Index n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1));
  return solver.eigenvalues()[n - 1] + beside.back() * std::abs(solver.eigenvectors()(n - 1, n - 1));
}

/// Lanczos for B = M^-1/2 K M^-1/2, which has the eigenvalues of M^-1 K.
double lanczos_estimate(const Dynamics& dynamics, const Vectors& positions)
{
  const ClothModel& model = dynamics.model();
  const Eigen::ArrayXd roots = model.masses.array().sqrt();
  Vectors q = noise(model.nodes());
  dynamics.pins().clear_held(q);
  if (q.isZero(0.0))
  {
    return 0.0;
  }
  q.normalize();
  Vectors previous = Vectors::Zero(model.nodes(), 3);
  Vectors product(model.nodes(), 3);
  std::vector<double> diagonal;
  std::vector<double> beside;
  double beta = 0.0;
  for (int step = 0; step < lanczos_steps; ++step)
  {
    product.setZero();
    add_stiffness_product(model, positions, q.array().colwise() / roots, product);
    dynamics.pins().clear_held(product);
    product.array().colwise() /= roots;
    diagonal.push_back(q.cwiseProduct(product).sum());
    product -= diagonal.back() * q + beta * previous;
    beta = product.norm();
    beside.push_back(beta);
    if (beta <= 1e-12 * std::abs(diagonal.front()))
    {
      break;
    }
    previous.swap(q);
    q = product / beta;
  }
  return ritz_value_and_residual(diagonal, beside);
}

struct Bounds
{
  double stiffness = 0.0;
  double damping = 0.0;
};

Bounds bounds_by_blocks(const Dynamics& dynamics, const Vectors& positions)
{
  const ClothModel& model = dynamics.model();
  std::vector<Eigen::Matrix3d> stiffness(static_cast<size_t>(model.nodes()), Eigen::Matrix3d::Zero());
  std::vector<Eigen::Matrix3d> damping = stiffness;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      const Eigen::Vector3d l = (positions.row(j) - positions.row(i)).transpose();
      const double length = l.norm();
      if (length == 0.0)
      {
        return;
      }
      const Eigen::Matrix3d along = l * l.transpose() / (length * length);
      const double across = std::max(0.0, 1.0 - batch.rest_length / length);
      const Eigen::Matrix3d block = batch.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
      for (const int node : { i, j })
      {
        stiffness[static_cast<size_t>(node)] += block;
        damping[static_cast<size_t>(node)] += batch.damping * along;
      }
    });
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  const auto largest_eigenvalue = [&solver](const Eigen::Matrix3d& block) {
    return solver.computeDirect(block, Eigen::EigenvaluesOnly).eigenvalues()[2];
  };
  Bounds bounds;
  for (int i = 0; i < model.nodes(); ++i)
  {
    if (!dynamics.pins().holds(i))
    {
      const size_t node = static_cast<size_t>(i);
      bounds.stiffness = std::max(bounds.stiffness, 2.0 / model.masses[i] * largest_eigenvalue(stiffness[node]));
      bounds.damping = std::max(bounds.damping, 2.0 / model.masses[i] * largest_eigenvalue(damping[node]));
    }
  }
  return bounds;
}

double largest_damping_ratio(const ClothModel& model)
{
  double largest = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    largest = std::max(largest, batch.damping / batch.stiffness);
  }
  return largest;
}

}  // namespace

Mode stiffest_mode(const Dynamics& dynamics, const Vectors& positions)
{
  const Bounds bounds = bounds_by_blocks(dynamics, positions);
  const double stiffness = std::min(bounds.stiffness, margin * lanczos_estimate(dynamics, positions));
  Mode mode;
  mode.frequency = std::sqrt(stiffness);
  mode.air_damping = dynamics.air().damping_rate(dynamics.model());
  mode.spring_damping = std::min(bounds.damping, largest_damping_ratio(dynamics.model()) * stiffness);
  return mode;
}

double stiffness_bound(const Dynamics& dynamics, const Vectors& positions)
{
  return bounds_by_blocks(dynamics, positions).stiffness;
}

}  // namespace cloth
