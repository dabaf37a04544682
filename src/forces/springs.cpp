#include "cloth_sim/forces/springs.h"

#include <algorithm>
#include <cmath>

#include "spring_blocks.h"

namespace cloth
{
namespace
{

void add_elastic_forces(const SpringBatch& batch, const Vectors& positions, Vectors& forces)
{
  const double k = batch.stiffness;
  const double l0 = batch.rest_length;
  Block force;
  for_each_block(batch, [&](int i, int n) {
    const Differences lengths(positions, i, batch.offset);
    for (int s = 0; s < n; ++s)
    {
      const Vector l = lengths[s];
      put(force, s, k - k * l0 * inverse_length(l), l);
    }
    add_to_both_ends(force, i, batch.offset, n, forces);
  });
}

void add_elastic_and_damping_forces(const SpringBatch& batch, const Vectors& positions, const Vectors& velocities,
                                    Vectors& forces)
{
  const double k = batch.stiffness;
  const double c = batch.damping;
  const double l0 = batch.rest_length;
  Block force;
  for_each_block(batch, [&](int i, int n) {
    const Differences lengths(positions, i, batch.offset);
    const Differences approaches(velocities, i, batch.offset);
    for (int s = 0; s < n; ++s)
    {
      const Vector l = lengths[s];
      const double inverse = inverse_length(l);
      put(force, s, k + (c * approaches[s].dot(l) * inverse - k * l0) * inverse, l);
    }
    add_to_both_ends(force, i, batch.offset, n, forces);
  });
}

/// Adds k [n n^T + a (I - n n^T)] (u_i - u_j), a the part of 1 - l0/|l| that `stiffness_across` lets through.
template <typename StiffnessAcross>
void add_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements, Vectors& product,
                 StiffnessAcross&& stiffness_across)
{
  Block change;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_block(batch, [&](int i, int n) {
      const Differences lengths(positions, i, batch.offset);
      const Differences approaches(displacements, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        const Vector l = lengths[s];
        const Vector u = approaches[s];
        const double inverse = inverse_length(l);
        const double across = batch.stiffness * stiffness_across(1.0 - batch.rest_length * inverse);
        const double along = (batch.stiffness - across) * inverse * inverse * l.dot(u);
        change.x[s] = -(across * u.x + along * l.x);
        change.y[s] = -(across * u.y + along * l.y);
        change.z[s] = -(across * u.z + along * l.z);
      }
      add_to_both_ends(change, i, batch.offset, n, product);
    });
  }
}

}  // namespace

void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities, Vectors& forces)
{
  for (const SpringBatch& batch : model.springs)
  {
    if (batch.damping == 0.0)
    {
      add_elastic_forces(batch, positions, forces);
    }
    else
    {
      add_elastic_and_damping_forces(batch, positions, velocities, forces);
    }
  }
}

double elastic_energy(const ClothModel& model, const Vectors& positions)
{
  double energy = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    double squares = 0.0;
    for_each_block(batch, [&](int i, int n) {
      const Differences lengths(positions, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        const double extension = std::sqrt(lengths[s].dot(lengths[s])) - batch.rest_length;
        squares += extension * extension;
      }
    });
    energy += 0.5 * batch.stiffness * squares;
  }
  return energy;
}

double max_strain(const ClothModel& model, const Vectors& positions)
{
  double largest = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    if (batch.kind == SpringKind::flex)
    {
      continue;
    }
    double squared_length = 0.0;
    for_each_block(batch, [&](int i, int n) {
      const Differences lengths(positions, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        squared_length = std::max(squared_length, lengths[s].dot(lengths[s]));
      }
    });
    largest = std::max(largest, std::sqrt(squared_length) / batch.rest_length - 1.0);
  }
  return largest;
}

void add_stiffness_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                           Vectors& product)
{
  add_product(model, positions, displacements, product, [](double across) { return std::max(0.0, across); });
}

void add_hessian_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                         Vectors& product)
{
  add_product(model, positions, displacements, product, [](double across) { return across; });
}

}  // namespace cloth
