#include "cloth_sim/model/cloth_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/node_range.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

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

/// The area vectors of some quads side by side: (x_b - x_c) x (x_d - x_a), a b above c d. Kept in an array of its
/// own, so that the loops over it vectorise.
class QuadRow
{
public:
  static constexpr int length = 128;

  /// `first` is the upper left corner of the first quad, `cols` further on is the row below.
  QuadRow(const Vectors& positions, int first, int cols, int quads)
  {
    const double* const x = positions.col(0).data() + first;
    const double* const y = positions.col(1).data() + first;
    const double* const z = positions.col(2).data() + first;
    for (int q = 0; q < quads; ++q)
    {
      const double rising_x = x[q + 1] - x[q + cols];
      const double rising_y = y[q + 1] - y[q + cols];
      const double rising_z = z[q + 1] - z[q + cols];
      const double falling_x = x[q + cols + 1] - x[q];
      const double falling_y = y[q + cols + 1] - y[q];
      const double falling_z = z[q + cols + 1] - z[q];
      areas_[0][q] = rising_y * falling_z - rising_z * falling_y;
      areas_[1][q] = rising_z * falling_x - rising_x * falling_z;
      areas_[2][q] = rising_x * falling_y - rising_y * falling_x;
    }
  }

  /// Adds each area to two neighbouring nodes, the first of which are `first`, `first` + 1.
  void add_to_corners(int first, int quads, Vectors& sums) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int corner : { 0, 1 })
      {
        double* const sum = sums.col(axis).data() + first + corner;
#pragma GCC ivdep
        for (int q = 0; q < quads; ++q)
        {
          sum[q] += areas_[axis][q];
        }
      }
    }
  }

private:
  double areas_[3][length];
};

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
  normals.resize(model.nodes(), 3);
  node_normals(model, positions, all_nodes(model), normals);
}

void node_normals(const ClothModel& model, const Vectors& positions, NodeRange nodes, Vectors& normals)
{
  part_calls()[Part::normals] += nodes.begin == 0 ? 1 : 0;
  normals.middleRows(nodes.begin, nodes.size()).setZero();
  in_widest_vectors([&](auto arithmetic) {
    const int begin = model.row_of(nodes.begin);
    const int end = model.row_of(nodes.end - 1) + 1;
    for (int r = std::max(0, begin - 1); r < std::min(end, model.rows - 1); ++r)
    {
      for (int c = 0; c + 1 < model.cols; c += QuadRow::length)
      {
        const int first = model.node(r, c);
        const int quads = std::min(QuadRow::length, model.cols - 1 - c);
        const QuadRow areas(positions, first, model.cols, quads);
        if (r >= begin)
        {
          areas.add_to_corners(first, quads, normals);
        }
        if (r + 1 < end)
        {
          areas.add_to_corners(first + model.cols, quads, normals);
        }
      }
    }
    double* const x = normals.col(0).data();
    double* const y = normals.col(1).data();
    double* const z = normals.col(2).data();
#pragma GCC ivdep
    for (int i = nodes.begin; i < nodes.end; ++i)
    {
      const double inverse = inverse_root<arithmetic.has_fused_multiply_add>(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
      x[i] *= inverse;
      y[i] *= inverse;
      z[i] *= inverse;
    }
  });
}

}  // namespace cloth
