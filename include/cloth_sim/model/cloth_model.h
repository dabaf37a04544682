#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "cloth_sim/model/spring_batch.h"
#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// How the sheet's mass and area are shared out to its nodes.
enum class MassLumping
{
  area,    ///< by tributary area: 1 inside, 1/2 on an edge, 1/4 at a corner, over their sum
  uniform  ///< equal shares (Provot 1995)
};

struct SpringProperties
{
  double stiffness = 0.0;  ///< k, N/m; 0: no springs of this kind
  double damping = 0.0;    ///< c, N s/m
};

/// A rectangular sheet at rest. A sheet of one column (or one row) is a chain; its width (or height) is then that of
/// the strip for which it stands, which sets its area.
struct SheetProperties
{
  int rows = 32;        ///< nodes down the sheet
  int cols = 32;        ///< nodes across
  double width = 1.0;   ///< m, between first and last column
  double height = 1.0;  ///< m, between first and last row
  double mass = 0.3;    ///< kg, whole sheet
  MassLumping mass_lumping = MassLumping::area;
  SpringProperties structural{ 100.0, 0.01 };
  SpringProperties shear{ 100.0, 0.01 };
  SpringProperties flex{ 10.0, 0.0 };
};

/// What is simulated: a grid of point masses joined by springs. Const while stepping.
/// Node (r, c), r rows down and c columns across, has the index r * cols + c.
struct ClothModel
{
  int rows = 0;
  int cols = 0;
  double width = 0.0;                ///< m
  double height = 0.0;               ///< m
  Eigen::VectorXd masses;            ///< kg, one a node
  Eigen::VectorXd areas;             ///< m2 of sheet that belong to each node
  std::vector<SpringBatch> springs;  ///< structural, shear, flex, in this order
  Vectors rest_positions;            ///< m; middle of the top edge at the origin, column along +x, row along -z

  int nodes() const
  {
    return rows * cols;
  }
  int node(int row, int col) const
  {
    return row * cols + col;
  }
  int row_of(int node) const
  {
    return node / cols;
  }
  int col_of(int node) const
  {
    return node % cols;
  }
  /// A chain has no quads: no triangles, no normals.
  bool is_chain() const
  {
    return rows == 1 || cols == 1;
  }
};

/// Builds the sheet at rest. Kinds of zero stiffness get no batch.
/// Throws std::invalid_argument unless rows, cols >= 1, rows * cols >= 2, sizes and mass > 0 and finite.
ClothModel make_sheet(const SheetProperties& properties);

/// The two triangles of every quad, as node indices; seen from +y of the sheet at rest they turn anticlockwise.
std::vector<std::array<int, 3>> triangles_of(const ClothModel& model);

/// The unit normal at every node: the normalised sum of (x_b - x_c) x (x_d - x_a) over the node's quads, a b above
/// c d, so that neither diagonal is preferred; +y for a sheet at rest. Zero on a chain and where a node's quads have
/// no area. `normals` is resized as needed.
void node_normals(const ClothModel& model, const Vectors& positions, Vectors& normals);

}  // namespace cloth
