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

constexpr int iterations_from_noise = 60;
constexpr int iterations_from_before = 3;
/// The power iteration's eigenvalue is raised by so much.
constexpr double margin = 1.05;
/// So much noise is mixed into the vector kept from before, lest it miss what has become stiff elsewhere.
constexpr double refreshment = 0.02;

using Product = void (*)(const ClothModel&, const Vectors&, const Vectors&, Vectors&);

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

/// Power iteration for the largest eigenvalue of M^-1 A; the return value is the Rayleigh quotient, which is never
/// above it.
double rayleigh_quotient(const Dynamics& dynamics, const Vectors& positions, Product add_product, Vectors& u)
{
  const ClothModel& model = dynamics.model();
  int iterations = iterations_from_before;
  if (u.rows() != model.nodes())
  {
    u = noise(model.nodes());
    iterations = iterations_from_noise;
  }
  else
  {
    u += refreshment / std::sqrt(model.nodes()) * noise(model.nodes());
  }
  dynamics.pins().clear_held(u);
  Vectors product(model.nodes(), 3);
  double quotient = 0.0;
  for (int i = 0; i < iterations; ++i)
  {
    product.setZero();
    add_product(model, positions, u, product);
    dynamics.pins().clear_held(product);
    const double mass = (u.array().square().colwise() * model.masses.array()).sum();
    quotient = mass > 0.0 ? u.cwiseProduct(product).sum() / mass : 0.0;
    dynamics.accelerations_of(product, u);
    const double length = u.norm();
    u *= length > 0.0 ? 1.0 / length : 0.0;
  }
  return quotient;
}

/// Upper bounds on the largest eigenvalues of M^-1 K and M^-1 C: each spring's 6 x 6 matrix [A -A; -A A] is at most
/// twice its diagonal blocks, so no eigenvalue exceeds 2/m_i times the largest of node i's block, sum of A.
struct Bounds
{
  double stiffness = 0.0;
  double damping = 0.0;
};

Bounds upper_bounds(const Dynamics& dynamics, const Vectors& positions)
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
      const Eigen::Matrix3d block =
          batch.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
      for (const int node : { i, j })
      {
        stiffness[static_cast<size_t>(node)] += block;
        damping[static_cast<size_t>(node)] += batch.damping * along;
      }
    });
  }
  const auto largest_eigenvalue = [](const Eigen::Matrix3d& block) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block, Eigen::EigenvaluesOnly).eigenvalues()[2];
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

}  // namespace

Mode Spectrum::stiffest_mode(const Dynamics& dynamics, const Vectors& positions)
{
  const Bounds bounds = upper_bounds(dynamics, positions);
  const double stiffness = rayleigh_quotient(dynamics, positions, add_stiffness_product, stiffness_vector_);
  Mode mode;
  mode.frequency = std::sqrt(std::min(bounds.stiffness, margin * stiffness));
  mode.air_damping = dynamics.air().damping_rate(dynamics.model());
  if (bounds.damping > 0.0)
  {
    const double damping = rayleigh_quotient(dynamics, positions, add_damping_product, damping_vector_);
    mode.spring_damping = std::min(bounds.damping, margin * damping);
  }
  return mode;
}

}  // namespace cloth
