#include "block_bound.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/model/wide_vectors.h"

#include "../forces/spring_blocks.h"

namespace cloth
{
namespace
{

/// A symmetric 3 x 3 matrix.
struct SymmetricMatrix
{
  double xx;
  double yy;
  double zz;
  double xy;
  double yz;
  double zx;

  /// The largest eigenvalue, in closed form (Smith, "Eigenvalues of a symmetric 3 x 3 matrix", 1961), or up to 1e-6
  /// more.
  double largest_eigenvalue() const
  {
    const double mean = (xx + yy + zz) / 3.0;
    const double a = xx - mean;
    const double b = yy - mean;
    const double c = zz - mean;
    const double p = std::sqrt((a * a + b * b + c * c + 2.0 * (xy * xy + yz * yz + zx * zx)) / 6.0);
    const double determinant = a * b * c + 2.0 * xy * yz * zx - a * yz * yz - b * zx * zx - c * xy * xy;
    const double cube = 2.0 * p * p * p;
    const double cosine = cube > 0.0 ? determinant / cube : 1.0;
    return mean + 2.0 * p * cosine_of_third(std::sqrt(std::clamp(0.5 + 0.5 * cosine, 0.0, 1.0)));
  }

private:
  /// The cosine of a third of an angle, s being that of its half: a polynomial that is never below it for s in [0, 1].
  static double cosine_of_third(double s)
  {
    return 0.50000035 +
           s * (0.57733346 +
                s * (-0.11082304 + s * (0.05154791 + s * (-0.02653822 + s * (0.01062305 - s * 0.00214345)))));
  }
};

}  // namespace

Eigen::VectorXd block_bounds(const Dynamics& dynamics, const Vectors& positions,
                             const std::function<BlockCoefficients(const SpringBatch&)>& coefficients)
{
  constexpr double alike = 1.0;  // for both ends
  const ClothModel& model = dynamics.model();
  Vectors diagonals = Vectors::Zero(model.nodes(), 3);
  Vectors others = diagonals;
  Eigen::VectorXd inverse_masses(model.nodes());
  dynamics.pins().find_inverse_masses(model.masses, inverse_masses);
  Eigen::VectorXd bounds(model.nodes());
  in_widest_vectors([&](auto arithmetic) {
    // products(l): three entries of l l^T; of the identity they are `identity`.
    const auto add_entries = [&](Vectors& sums, double identity, auto&& products) {
      add_by_blocks(model, all_nodes(model), all_nodes(model), alike, sums,
                    [&](const SpringBatch& batch, int i, int n, Block& block) {
                      const auto [along, across] = coefficients(batch);
                      const double l0 = batch.rest_length;
                      const Differences lengths(positions, i, batch.offset);
                      for (int s = 0; s < n; ++s)
                      {
                        const Vector l = lengths[s];
                        const double inverse = inverse_length<arithmetic.has_fused_multiply_add>(l);
                        const double stretched = across * std::max(0.0, 1.0 - l0 * inverse);
                        const double factor = (along - stretched) * inverse * inverse;
                        const Vector entries = products(l);
                        block.x[s] = factor * entries.x + identity * stretched;
                        block.y[s] = factor * entries.y + identity * stretched;
                        block.z[s] = factor * entries.z + identity * stretched;
                      }
                    });
    };
    add_entries(diagonals, 1.0, [](const Vector& l) { return Vector{ l.x * l.x, l.y * l.y, l.z * l.z }; });
    add_entries(others, 0.0, [](const Vector& l) { return Vector{ l.x * l.y, l.y * l.z, l.z * l.x }; });
    const double* const xx = diagonals.col(0).data();
    const double* const yy = diagonals.col(1).data();
    const double* const zz = diagonals.col(2).data();
    const double* const xy = others.col(0).data();
    const double* const yz = others.col(1).data();
    const double* const zx = others.col(2).data();
    const double* const w = inverse_masses.data();
    double* const bound = bounds.data();
    const int nodes = model.nodes();
#pragma GCC ivdep
    for (int i = 0; i < nodes; ++i)
    {
      const SymmetricMatrix block{ xx[i], yy[i], zz[i], xy[i], yz[i], zx[i] };
      bound[i] = 2.0 * w[i] * block.largest_eigenvalue();
    }
  });
  return bounds.cwiseMax(0.0);
}

}  // namespace cloth
