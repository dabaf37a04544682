#include "cloth_sim/model/cloth_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

namespace cloth
{
namespace
{

void check(const SheetProperties& sheet)
{
  if (sheet.rows < 1 || sheet.cols < 1 || static_cast<long>(sheet.rows) * sheet.cols < 2)
  {
    throw std::invalid_argument("a sheet needs at least one row, one column and two nodes");
  }
  for (const double size : { sheet.width, sheet.height, sheet.mass })
  {
    if (!(size > 0.0) || !std::isfinite(size))
    {
      throw std::invalid_argument("width, height and mass of a sheet must be positive and finite");
    }
  }
}

/// The distance between neighbours along one direction; of no meaning where there is only one node.
double spacing(double length, int nodes)
{
  return nodes > 1 ? length / (nodes - 1) : 0.0;
}

/// A node's part of its row or column: half of a cell towards each neighbour.
double tributary_length(int index, int count)
{
  const bool at_an_end = index == 0 || index == count - 1;
  return count > 1 && at_an_end ? 0.5 : 1.0;
}

/// Each node's share of the sheet; the shares' sum is 1.
Eigen::VectorXd node_shares(const SheetProperties& sheet)
{
  Eigen::VectorXd shares(sheet.rows * sheet.cols);
  for (int r = 0; r < sheet.rows; ++r)
  {
    for (int c = 0; c < sheet.cols; ++c)
    {
      shares[r * sheet.cols + c] = sheet.mass_lumping == MassLumping::uniform ?
                                       1.0 :
                                       tributary_length(r, sheet.rows) * tributary_length(c, sheet.cols);
    }
  }
  return shares / shares.sum();
}

/// Lays out the batches of a sheet, the same rule for every kind: one spring from each node that has a neighbour
/// `down` rows and `across` columns further on.
class BatchLayout
{
public:
  explicit BatchLayout(const SheetProperties& sheet) : sheet_(sheet)
  {
  }

  void add(SpringKind kind, const SpringProperties& properties, int down, int across)
  {
    SpringBatch batch{};
    batch.kind = kind;
    batch.first = std::max(0, -across);
    batch.offset = down * sheet_.cols + across;
    batch.rows = sheet_.rows - down;
    batch.cols = sheet_.cols - std::abs(across);
    batch.row_stride = sheet_.cols;
    batch.stiffness = properties.stiffness;
    batch.damping = properties.damping;
    batch.rest_length =
        std::hypot(across * spacing(sheet_.width, sheet_.cols), down * spacing(sheet_.height, sheet_.rows));
    if (properties.stiffness > 0.0 && batch.rows > 0 && batch.cols > 0)
    {
      batches_.push_back(in_longest_rows(batch));
    }
  }

  std::vector<SpringBatch> batches() const
  {
    return batches_;
  }

private:
  /// Rows without a gap between them are one row: the force kernel runs along rows.
  static SpringBatch in_longest_rows(SpringBatch batch)
  {
    if (batch.cols == batch.row_stride)
    {
      batch.cols = batch.row_stride = batch.size();
      batch.rows = 1;
    }
    return batch;
  }

  const SheetProperties& sheet_;
  std::vector<SpringBatch> batches_;
};

std::vector<SpringBatch> lay_out_springs(const SheetProperties& sheet)
{
  BatchLayout layout(sheet);
  layout.add(SpringKind::structural, sheet.structural, 0, 1);
  layout.add(SpringKind::structural, sheet.structural, 1, 0);
  layout.add(SpringKind::shear, sheet.shear, 1, 1);
  layout.add(SpringKind::shear, sheet.shear, 1, -1);
  layout.add(SpringKind::flex, sheet.flex, 0, 2);
  layout.add(SpringKind::flex, sheet.flex, 2, 0);
  return layout.batches();
}

Vectors lay_out_nodes(const SheetProperties& sheet)
{
  Vectors positions = Vectors::Zero(sheet.rows * sheet.cols, 3);
  const double across = spacing(sheet.width, sheet.cols);
  const double down = spacing(sheet.height, sheet.rows);
  for (int r = 0; r < sheet.rows; ++r)
  {
    for (int c = 0; c < sheet.cols; ++c)
    {
      positions.row(r * sheet.cols + c) << (c - 0.5 * (sheet.cols - 1)) * across, 0.0, -r * down;
    }
  }
  return positions;
}

}  // namespace

ClothModel make_sheet(const SheetProperties& sheet)
{
  check(sheet);
  const Eigen::VectorXd shares = node_shares(sheet);
  ClothModel model;
  model.rows = sheet.rows;
  model.cols = sheet.cols;
  model.width = sheet.width;
  model.height = sheet.height;
  model.masses = sheet.mass * shares;
  model.areas = sheet.width * sheet.height * shares;
  model.springs = lay_out_springs(sheet);
  model.rest_positions = lay_out_nodes(sheet);
  return model;
}

std::vector<std::array<int, 3>> triangles_of(const ClothModel& model)
{
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(2 * static_cast<size_t>(model.rows - 1) * (model.cols - 1));
  for (int r = 0; r + 1 < model.rows; ++r)
  {
    for (int c = 0; c + 1 < model.cols; ++c)
    {
      const int top_left = model.node(r, c);
      const int bottom_left = model.node(r + 1, c);
      triangles.push_back({ top_left, top_left + 1, bottom_left });
      triangles.push_back({ top_left + 1, bottom_left + 1, bottom_left });
    }
  }
  return triangles;
}

void node_normals(const ClothModel& model, const Vectors& positions, Vectors& normals)
{
  normals.setZero(model.nodes(), 3);
  for (int r = 0; r + 1 < model.rows; ++r)
  {
    for (int c = 0; c + 1 < model.cols; ++c)
    {
      const int a = model.node(r, c);
      const int b = a + 1;
      const int lower_left = model.node(r + 1, c);
      const int lower_right = lower_left + 1;
      const Eigen::RowVector3d rising = positions.row(b) - positions.row(lower_left);
      const Eigen::RowVector3d falling = positions.row(lower_right) - positions.row(a);
      const Eigen::RowVector3d area = rising.cross(falling);
      for (const int corner : { a, b, lower_left, lower_right })
      {
        normals.row(corner) += area;
      }
    }
  }
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double length = normals.row(i).norm();
    normals.row(i) *= length > 0.0 ? 1.0 / length : 0.0;
  }
}

}  // namespace cloth
