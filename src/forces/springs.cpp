#include "cloth_sim/forces/springs.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"
#include "spring_blocks.h"

namespace cloth
{
namespace
{

/// What a spring does to its second end, in parts of what it does to the first.
constexpr double opposite = -1.0;

template <bool fused>
void find_elastic_forces(const SpringBatch& batch, const Vectors& positions, int i, int n, Block& force)
{
  const double k = batch.stiffness;
  const double l0 = batch.rest_length;
  const Differences lengths(positions, i, batch.offset);
  for (int s = 0; s < n; ++s)
  {
    const Vector l = lengths[s];
    put(force, s, k - k * l0 * inverse_length<fused>(l), l);
  }
}

template <bool fused>
void find_elastic_and_damping_forces(const SpringBatch& batch, const Vectors& positions, const Vectors& velocities,
                                     int i, int n, Block& force)
{
  const double k = batch.stiffness;
  const double c = batch.damping;
  const double l0 = batch.rest_length;
  const Differences lengths(positions, i, batch.offset);
  const Differences approaches(velocities, i, batch.offset);
  for (int s = 0; s < n; ++s)
  {
    const Vector l = lengths[s];
    const double inverse = inverse_length<fused>(l);
    put(force, s, k + (c * approaches[s].dot(l) * inverse - k * l0) * inverse, l);
  }
}

/// Adds k [n n^T + a (I - n n^T)] (u_i - u_j), k being the `coefficient` of a batch and a what `part_across` makes of
/// 1 - l0/|l|.
template <typename PartAcross>
void add_product(const ClothModel& model, const Vectors& positions, double SpringBatch::*coefficient,
                 const Vectors& displacements, Vectors& product, PartAcross&& part_across)
{
  in_widest_vectors([&](auto arithmetic) {
    const auto work = [&](const SpringBatch& batch, int i, int n, Block& change) {
      const double k = batch.*coefficient;
      const double l0 = batch.rest_length;
      const Differences lengths(positions, i, batch.offset);
      const Differences approaches(displacements, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        const Vector l = lengths[s];
        const Vector u = approaches[s];
        const double inverse = inverse_length<arithmetic.has_fused_multiply_add>(l);
        const double across = k * part_across(1.0 - l0 * inverse);
        const double along = (k - across) * inverse * inverse * l.dot(u);
        change.x[s] = -(across * u.x + along * l.x);
        change.y[s] = -(across * u.y + along * l.y);
        change.z[s] = -(across * u.z + along * l.z);
      }
    };
    for_each_stretch(model, all_nodes(model), [&](NodeRange first_ends) {
      add_by_blocks(model, first_ends, all_nodes(model), opposite, product, work);
    });
  });
}

}  // namespace

void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities, Vectors& forces)
{
  for_each_stretch(model, all_nodes(model), [&](NodeRange first_ends) {
    add_spring_forces(model, positions, velocities, first_ends, all_nodes(model), forces);
  });
}

void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities,
                       NodeRange first_ends, NodeRange nodes, Vectors& forces)
{
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    add_by_blocks(model, first_ends, nodes, opposite, forces,
                  [&](const SpringBatch& batch, int i, int n, Block& force) {
                    const bool is_first = i == batch.first && i >= nodes.begin;
                    if (is_first)
                    {
                      count_call(batch);
                    }
                    if (batch.damping == 0.0)
                    {
                      find_elastic_forces<fused>(batch, positions, i, n, force);
                    }
                    else
                    {
                      part_calls()[Part::internal_damping] += is_first ? 1 : 0;
                      find_elastic_and_damping_forces<fused>(batch, positions, velocities, i, n, force);
                    }
                  });
  });
}

int longest_reach(const ClothModel& model)
{
  int reach = 0;
  for (const SpringBatch& batch : model.springs)
  {
    reach = std::max(reach, batch.offset);
  }
  return reach;
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
  add_product(model, positions, &SpringBatch::stiffness, displacements, product,
              [](double part) { return std::max(0.0, part); });
}

void add_hessian_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                         Vectors& product)
{
  add_product(model, positions, &SpringBatch::stiffness, displacements, product, [](double part) { return part; });
}

void add_damping_product(const ClothModel& model, const Vectors& positions, const Vectors& velocities, Vectors& product)
{
  add_product(model, positions, &SpringBatch::damping, velocities, product, [](double /*part*/) { return 0.0; });
}

}  // namespace cloth
