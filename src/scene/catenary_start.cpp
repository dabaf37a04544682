#include "cloth_sim/scene/catenary_start.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "cloth_sim/scene/catenary.h"
#include "cloth_sim/scene/start_state.h"

namespace cloth
{
namespace
{

/// Less slack than this, as a part of the rest distance, is rounding.
constexpr double least_slack = 1e-9;

double rest_distance(const ClothModel& model, int i, int j)
{
  return (model.rest_positions.row(i) - model.rest_positions.row(j)).norm();
}

StartParams without_ripple(StartParams start)
{
  start.ripple = 0.0;
  return start;
}

/// Nodes on their way to their places. Those of one stage see the places of the stages before.
class Hanging
{
public:
  Hanging(const StartParams& start, const ClothModel& model, const std::vector<int>& pinned,
          const Eigen::Vector3d& down)
    : model_(model)
    , down_(down)
    , smooth_(start_state(without_ripple(start), model).positions)
    , positions_(start_state(start, model).positions)
    , placed_(static_cast<size_t>(model.nodes()), 0)
    , claims_(Vectors::Zero(model.nodes(), 3))
    , claimed_(placed_)
  {
    for (const int node : pinned)
    {
      placed_[static_cast<size_t>(node)] = 1;
    }
  }

  void hang_between(const std::vector<int>& pinned)
  {
    for (size_t p = 0; p < pinned.size(); ++p)
    {
      for (size_t q = p + 1; q < pinned.size(); ++q)
      {
        hang_along_line(pinned[p], pinned[q]);
      }
    }
    place_claims();
  }

  void hang_along_rows_and_columns()
  {
    for (int r = 0; r < model_.rows; ++r)
    {
      hang_along_row_or_column(model_.node(r, 0), 1, model_.cols);
    }
    for (int c = 0; c < model_.cols; ++c)
    {
      hang_along_row_or_column(model_.node(0, c), model_.cols, model_.rows);
    }
    place_claims();
  }

  void hang_the_rest()
  {
    const std::vector<int> nearest = nearest_in_columns();
    for (int i = 0; i < model_.nodes(); ++i)
    {
      if (placed_[static_cast<size_t>(i)])
      {
        continue;
      }
      const int above = nearest_of_row(nearest, i);
      claim(i, position(above) + rest_distance(model_, i, above) * down_);
    }
    place_claims();
  }

  const Vectors& positions() const
  {
    return positions_;
  }

private:
  Eigen::Vector3d position(int node) const
  {
    return positions_.row(node).transpose();
  }

  Catenary curve_between(int i, int j) const
  {
    return { position(i), position(j), rest_distance(model_, i, j), down_ };
  }

  /// Keeps the higher of all claims on a node that has no place yet.
  void claim(int node, const Eigen::Vector3d& point)
  {
    const size_t index = static_cast<size_t>(node);
    if (placed_[index] || (claimed_[index] && claims_.row(node).dot(down_) <= point.dot(down_)))
    {
      return;
    }
    claims_.row(node) = point.transpose();
    claimed_[index] = 1;
  }

  void place_claims()
  {
    for (int i = 0; i < model_.nodes(); ++i)
    {
      if (claimed_[static_cast<size_t>(i)])
      {
        positions_.row(i) = claims_.row(i);
        placed_[static_cast<size_t>(i)] = 1;
        claimed_[static_cast<size_t>(i)] = 0;
      }
    }
  }

  /// The nodes that are nearest to the straight line between two nodes of the grid, each as far beside the curve as
  /// it is beside the line.
  void hang_along_line(int i, int j)
  {
    const int down = model_.row_of(j) - model_.row_of(i);
    const int across = model_.col_of(j) - model_.col_of(i);
    const int steps = std::max(std::abs(down), std::abs(across));
    const Catenary curve = curve_between(i, j);
    const Eigen::Vector3d line = (model_.rest_positions.row(j) - model_.rest_positions.row(i)).transpose();
    for (int s = 1; s < steps; ++s)
    {
      const double part = static_cast<double>(s) / steps;
      const int node = model_.node(model_.row_of(i) + static_cast<int>(std::lround(part * down)),
                                   model_.col_of(i) + static_cast<int>(std::lround(part * across)));
      const double foot = (model_.rest_positions.row(node) - model_.rest_positions.row(i)).dot(line) / line.norm();
      const double part_of_foot = foot / line.norm();
      const Eigen::RowVector3d beside =
          smooth_.row(node) - (1.0 - part_of_foot) * smooth_.row(i) - part_of_foot * smooth_.row(j);
      claim(node, curve.at(foot) + beside.transpose());
    }
  }

  /// Between each two neighbours of those that are placed among `count` nodes, `stride` apart from `first` on.
  void hang_along_row_or_column(int first, int stride, int count)
  {
    int last = -1;
    for (int n = 0; n < count; ++n)
    {
      const int node = first + n * stride;
      if (!placed_[static_cast<size_t>(node)])
      {
        continue;
      }
      if (last >= 0 && node > last + stride)
      {
        hang_along_line(last, node);
      }
      last = node;
    }
  }

  /// For every node the nearest placed node of its column, or -1.
  std::vector<int> nearest_in_columns() const
  {
    std::vector<int> nearest(static_cast<size_t>(model_.nodes()), -1);
    for (int c = 0; c < model_.cols; ++c)
    {
      int seen = -1;
      for (int i = model_.node(0, c); i < model_.nodes(); i += model_.cols)
      {
        seen = placed_[static_cast<size_t>(i)] ? i : seen;
        nearest[static_cast<size_t>(i)] = seen;
      }
      seen = -1;
      for (int i = model_.node(model_.rows - 1, c); i >= 0; i -= model_.cols)
      {
        seen = placed_[static_cast<size_t>(i)] ? i : seen;
        int& other = nearest[static_cast<size_t>(i)];
        other = seen >= 0 && (other < 0 || seen - i < i - other) ? seen : other;
      }
    }
    return nearest;
  }

  /// The nearest to a node of those that are nearest in the columns of its row.
  int nearest_of_row(const std::vector<int>& nearest, int node) const
  {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    const int first = node - model_.col_of(node);
    for (int i = first; i < first + model_.cols; ++i)
    {
      const int candidate = nearest[static_cast<size_t>(i)];
      const double distance = candidate >= 0 ? rest_distance(model_, node, candidate) : least;
      if (distance < least)
      {
        least = distance;
        best = candidate;
      }
    }
    return best;
  }

  const ClothModel& model_;
  const Eigen::Vector3d down_;
  const Vectors smooth_;  ///< the flat sheet without ripple, m
  Vectors positions_;
  std::vector<char> placed_;
  Vectors claims_;
  std::vector<char> claimed_;
};

}  // namespace

bool has_slack(const ClothModel& model, const std::vector<int>& nodes, const Vectors& positions)
{
  for (size_t p = 0; p < nodes.size(); ++p)
  {
    for (size_t q = p + 1; q < nodes.size(); ++q)
    {
      const double distance = (positions.row(nodes[p]) - positions.row(nodes[q])).norm();
      if (distance < rest_distance(model, nodes[p], nodes[q]) * (1.0 - least_slack))
      {
        return true;
      }
    }
  }
  return false;
}

Vectors hung_in_catenaries(const StartParams& start, const ClothModel& model, const std::vector<int>& pinned,
                           const Eigen::Vector3d& down)
{
  Hanging hanging(start, model, pinned, down);
  hanging.hang_between(pinned);
  hanging.hang_along_rows_and_columns();
  hanging.hang_the_rest();
  Vectors ripple = ripple_of(start, model) * rotation_of(start.rpy).col(1).transpose();
  for (const int node : pinned)
  {
    ripple.row(node).setZero();
  }
  return hanging.positions() + ripple;
}

}  // namespace cloth
