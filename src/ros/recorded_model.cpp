#include "recorded_model.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "conversions.h"
#include "refused_request.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothTopology;

void require(bool holds, const ClothTopology& topology, const std::string& otherwise)
{
  if (!holds)
  {
    throw RefusedRequest("topology version " + std::to_string(topology.version) + " of " +
                         std::to_string(topology.rows) + " x " + std::to_string(topology.cols) +
                         " nodes: " + otherwise);
  }
}

void check(const ClothTopology& topology)
{
  const auto nodes = static_cast<std::uint64_t>(topology.rows) * topology.cols;
  require(nodes >= 2 && nodes <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()) / 3, topology,
          "no such sheet can be shown");
  require(topology.rest_positions.size() == 3 * nodes, topology, "it has not three rest_positions a node");
  require(topology.masses.size() == nodes, topology, "it has not one mass a node");
  const size_t springs = topology.rest_lengths.size();
  require(topology.spring_nodes.size() == 2 * springs && topology.spring_kinds.size() == springs, topology,
          "its lists of springs differ in length");
  require(std::all_of(topology.spring_nodes.begin(), topology.spring_nodes.end(),
                      [&](std::uint32_t node) { return node < nodes; }),
          topology, "a spring ends at a node that is not there");
}

/// Markers take the triangles of the grid.
void check_triangles(const ClothTopology& topology, const ClothModel& model)
{
  const auto triangles = triangles_of(model);
  bool same = topology.triangles.size() == 3 * triangles.size();
  for (size_t corner = 0; same && corner < topology.triangles.size(); ++corner)
  {
    same = topology.triangles[corner] == static_cast<std::uint32_t>(triangles[corner / 3][corner % 3]);
  }
  require(same, topology, "its triangles are not those of its grid");
}

SpringKind kind_of(std::uint8_t code)
{
  switch (code)
  {
    case ClothTopology::STRUCTURAL:
      return SpringKind::structural;
    case ClothTopology::SHEAR:
      return SpringKind::shear;
    default:
      return SpringKind::flex;
  }
}

SpringBatch single_spring(const ClothTopology& topology, size_t spring)
{
  SpringBatch batch{};
  batch.kind = kind_of(topology.spring_kinds[spring]);
  batch.first = static_cast<int>(topology.spring_nodes[2 * spring]);
  batch.offset = static_cast<int>(topology.spring_nodes[2 * spring + 1]) - batch.first;
  batch.rows = batch.cols = 1;
  batch.rest_length = static_cast<double>(topology.rest_lengths[spring]);
  return batch;
}

bool goes_on(const SpringBatch& row, const SpringBatch& next)
{
  return next.kind == row.kind && next.first == row.first + row.cols && next.offset == row.offset &&
         next.rest_length == row.rest_length;
}

std::vector<SpringBatch> springs_of(const ClothTopology& topology)
{
  std::vector<SpringBatch> rows;
  for (size_t spring = 0; spring < topology.rest_lengths.size(); ++spring)
  {
    const SpringBatch next = single_spring(topology, spring);
    if (!rows.empty() && goes_on(rows.back(), next))
    {
      ++rows.back().cols;
    }
    else
    {
      rows.push_back(next);
    }
  }
  return rows;
}

}  // namespace

ClothModel recorded_model(const ClothTopology& topology, const SheetProperties& strip)
{
  check(topology);
  ClothModel model;
  model.rows = static_cast<int>(topology.rows);
  model.cols = static_cast<int>(topology.cols);
  check_triangles(topology, model);
  from_float32(topology.rest_positions, model.rest_positions);
  const Eigen::RowVector3d diagonal =
      model.rest_positions.row(model.nodes() - 1) - model.rest_positions.row(model.node(0, 0));
  model.width = model.cols == 1 ? strip.width : diagonal.x();
  model.height = model.rows == 1 ? strip.height : -diagonal.z();
  model.masses = Eigen::Map<const Eigen::VectorXf>(topology.masses.data(), model.nodes()).cast<double>();
  model.springs = springs_of(topology);
  return model;
}

}  // namespace cloth
