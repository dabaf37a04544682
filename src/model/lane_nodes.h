#pragma once

#include "cloth_sim/model/spring_rows.h"

#include "spring_layout.h"

namespace cloth
{

inline constexpr int lanes = lanes_of<float>;

/// A sheet's nodes in single precision while a step moves them, in the order of LaneLayout. All columns have room for
/// `row_padding` more.
struct LaneNodes
{
  const float* inverse_masses;  ///< 1/kg; 0: held
  Columns<float> positions;     ///< at the step's begin, m
  Columns<float> ways;          ///< since then, m: differences of them are not rounded as those of positions are
  int nodes;
};

/// The ends of a vector of springs. Loops over them are written out coordinate by coordinate, as compilers make vectors
/// of no others.
struct LaneEnds
{
  LaneEnds(const LaneNodes& nodes, const SpringRun& run)
    : w_i(nodes.inverse_masses + run.node)
    , w_j(w_i + run.offset)
    , x_i(nodes.positions[0] + run.node)
    , y_i(nodes.positions[1] + run.node)
    , z_i(nodes.positions[2] + run.node)
    , x_j(x_i + run.offset)
    , y_j(y_i + run.offset)
    , z_j(z_i + run.offset)
    , way_x_i(nodes.ways[0] + run.node)
    , way_y_i(nodes.ways[1] + run.node)
    , way_z_i(nodes.ways[2] + run.node)
    , way_x_j(way_x_i + run.offset)
    , way_y_j(way_y_i + run.offset)
    , way_z_j(way_z_i + run.offset)
  {
  }

  const float* w_i;
  const float* w_j;
  const float* x_i;
  const float* y_i;
  const float* z_i;
  const float* x_j;
  const float* y_j;
  const float* z_j;
  float* way_x_i;
  float* way_y_i;
  float* way_z_i;
  float* way_x_j;
  float* way_y_j;
  float* way_z_j;
};

}  // namespace cloth
