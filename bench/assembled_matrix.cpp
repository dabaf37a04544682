#include "assembled_matrix.h"

#include <algorithm>

namespace cloth
{
namespace
{

/// The stiffness across a spring in parts of h^2 k: negative under compression.
double part_across(const SpringBatch& batch, double length)
{
  return 1.0 - batch.rest_length / length;
}

}  // namespace

AssembledMatrix::AssembledMatrix(const Dynamics& dynamics) : dynamics_(dynamics)
{
  find_pattern();
  for (int i = 0; i < dynamics.model().nodes(); ++i)
  {
    of_nodes_.push_back(block_of(i, i));
  }
  for (const SpringBatch& batch : dynamics.model().springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      of_springs_.push_back({ { is_free(i) ? block_of(i, i) : Block(), is_free(j) ? block_of(j, j) : Block() },
                              { block_of(i, j), block_of(j, i) } });
    });
  }
}

void AssembledMatrix::find_pattern()
{
  const ClothModel& model = dynamics_.model();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&](int row_node, int col_node) {
    for (int entry = 0; entry < 9; ++entry)
    {
      entries.emplace_back(3 * row_node + entry % 3, 3 * col_node + entry / 3, 0.0);
    }
  };
  for (int i = 0; i < model.nodes(); ++i)
  {
    add_block(i, i);
  }
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      if (is_free(i) && is_free(j))
      {
        add_block(i, j);
        add_block(j, i);
      }
    });
  }
  matrix_.resize(3 * model.nodes(), 3 * model.nodes());
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

AssembledMatrix::Block AssembledMatrix::block_of(int row_node, int col_node) const
{
  const int* const begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[3 * col_node];
  const int* const end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[3 * col_node + 1];
  const int* const found = std::lower_bound(begin, end, 3 * row_node);
  if (found == end || *found != 3 * row_node)
  {
    return {};
  }
  return { static_cast<int>(found - matrix_.innerIndexPtr()), static_cast<int>(end - begin) };
}

void AssembledMatrix::assemble(const Vectors& positions, const Vectors& normals, double h,
                               const Eigen::ArrayXd& capacities)
{
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  add_masses_and_air(normals, h);
  const Eigen::ArrayXd kept_parts = (0.5 * capacities / negative_sums(positions, h)).min(1.0);
  auto blocks = of_springs_.begin();
  for (const SpringBatch& batch : dynamics_.model().springs)
  {
    const double along = h * h * batch.stiffness + h * batch.damping;
    for_each_spring(batch, [&](int i, int j) {
      const Eigen::Vector3d l = (positions.row(j) - positions.row(i)).transpose();
      const double length = l.norm();
      double across = h * h * batch.stiffness * part_across(batch, length);
      across *= across < 0.0 ? std::min(kept_parts[i], kept_parts[j]) : 1.0;
      const Eigen::Matrix3d values =
          (along - across) / (length * length) * l * l.transpose() + across * Eigen::Matrix3d::Identity();
      add(blocks->of_ends[0], values);
      add(blocks->of_ends[1], values);
      add(blocks->across[0], -values);
      add(blocks->across[1], -values);
      ++blocks;
    });
  }
}

void AssembledMatrix::add(const Block& block, const Eigen::Matrix3d& values)
{
  if (block.first < 0)
  {
    return;
  }
  for (int col = 0; col < 3; ++col)
  {
    double* const target = matrix_.valuePtr() + block.first + col * block.stride;
    for (int row = 0; row < 3; ++row)
    {
      target[row] += values(row, col);
    }
  }
}

void AssembledMatrix::add_masses_and_air(const Vectors& normals, double h)
{
  const ClothModel& model = dynamics_.model();
  const AirProperties& air = dynamics_.air().properties();
  for (int i = 0; i < model.nodes(); ++i)
  {
    Eigen::Matrix3d values = model.masses[i] * Eigen::Matrix3d::Identity();
    if (is_free(i))
    {
      const Eigen::Vector3d n = normals.row(i).transpose();
      values += h * model.areas[i] *
                (air.viscous_damping * Eigen::Matrix3d::Identity() + air.wind_coupling * n * n.transpose());
    }
    add(of_nodes_[static_cast<size_t>(i)], values);
  }
}

Eigen::ArrayXd AssembledMatrix::negative_sums(const Vectors& positions, double h) const
{
  Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(positions.rows());
  for (const SpringBatch& batch : dynamics_.model().springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      const double length = (positions.row(j) - positions.row(i)).norm();
      const double negative = std::max(0.0, -h * h * batch.stiffness * part_across(batch, length));
      sums[i] += negative;
      sums[j] += negative;
    });
  }
  return sums;
}

}  // namespace cloth
