#include "grid_laplacian.h"

#include <algorithm>

#include <Eigen/SparseCholesky>

namespace cloth
{

GridLaplacian::GridLaplacian(const ClothModel& model, const Pins& pins)
  : places_(static_cast<size_t>(model.nodes()), -1)
{
  for (int i = 0; i < model.nodes(); ++i)
  {
    if (!pins.holds(i))
    {
      places_[static_cast<size_t>(i)] = static_cast<int>(free_.size());
      free_.push_back(i);
    }
  }
  const Eigen::Index size = static_cast<Eigen::Index>(free_.size());
  const std::vector<Eigen::Triplet<double>> entries = entries_of(model);
  Eigen::SparseMatrix<double> laplacian(size, size);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky(laplacian);
  lower_ = cholesky.matrixL();
  order_.assign(cholesky.permutationP().indices().begin(), cholesky.permutationP().indices().end());
}

void GridLaplacian::solve(const Vectors& rows, Vectors& result) const
{
  const Eigen::Index size = static_cast<Eigen::Index>(free_.size());
  solution_.resize(4, size);
  for (Eigen::Index place = 0; place < size; ++place)
  {
    const int node = free_[static_cast<size_t>(place)];
    solution_.col(order_[static_cast<size_t>(place)]) << rows.row(node).transpose(), 0.0;
  }
  solve_in_place();
  result.setZero(rows.rows(), 3);
  for (Eigen::Index place = 0; place < size; ++place)
  {
    result.row(free_[static_cast<size_t>(place)]) =
        solution_.col(order_[static_cast<size_t>(place)]).head<3>().transpose();
  }
}

/// L L^T x = b for x, y and z at once, in place: the time goes into reading L.
void GridLaplacian::solve_in_place() const
{
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (Eigen::Index j = 0; j < lower_.cols(); ++j)
  {
    Entry entry(lower_, j);
    solution_.col(j) /= entry.value();
    const Eigen::Vector4d value = solution_.col(j);
    while (++entry)
    {
      solution_.col(entry.row()) -= entry.value() * value;
    }
  }
  for (Eigen::Index j = lower_.cols() - 1; j >= 0; --j)
  {
    Entry entry(lower_, j);
    const double diagonal = entry.value();
    Eigen::Vector4d value = solution_.col(j);
    while (++entry)
    {
      value -= entry.value() * solution_.col(entry.row());
    }
    solution_.col(j) = value / diagonal;
  }
}

/// The lower triangle.
std::vector<Eigen::Triplet<double>> GridLaplacian::entries_of(const ClothModel& model) const
{
  double stiffest = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    stiffest = std::max(stiffest, batch.stiffness);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int place = 0; place < static_cast<int>(free_.size()); ++place)
  {
    // A sheet that nothing holds would make the matrix singular.
    entries.emplace_back(place, place, 1e-6 * stiffest);
  }
  for (int i = 0; i < model.nodes(); ++i)
  {
    if (model.col_of(i) + 1 < model.cols)
    {
      add(i, i + 1, stiffest, entries);
    }
    if (model.row_of(i) + 1 < model.rows)
    {
      add(i, i + model.cols, stiffest, entries);
    }
  }
  return entries;
}

void GridLaplacian::add(int i, int j, double stiffness, std::vector<Eigen::Triplet<double>>& entries) const
{
  const int one = places_[static_cast<size_t>(i)];
  const int other = places_[static_cast<size_t>(j)];
  for (const int place : { one, other })
  {
    if (place >= 0)
    {
      entries.emplace_back(place, place, stiffness);
    }
  }
  if (one >= 0 && other >= 0)
  {
    entries.emplace_back(other, one, -stiffness);
  }
}

}  // namespace cloth
