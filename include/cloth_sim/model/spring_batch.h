#pragma once

namespace cloth
{

/// What a spring resists (Provot 1995, section 3): stretch, shear, or bending.
enum class SpringKind
{
  structural,
  shear,
  flex
};

/// The kind as it is written in scene files and messages.
const char* name_of(SpringKind kind);

/// All springs of one kind and direction on a grid. They share stiffness, damping and rest length, and need no index
/// list: spring (r, c), 0 <= r < rows and 0 <= c < cols, joins node first + r * row_stride + c to the node `offset`
/// further on.
struct SpringBatch
{
  SpringKind kind;
  int first;
  int offset;
  int rows;
  int cols;
  int row_stride;
  double stiffness;    ///< k, N/m
  double damping;      ///< c, N s/m
  double rest_length;  ///< l0, m

  int size() const
  {
    return rows * cols;
  }
};

/// Calls visit(i, j) with the two ends of every spring of the batch, in memory order.
template <typename Visit>
void for_each_spring(const SpringBatch& batch, Visit&& visit)
{
  for (int r = 0; r < batch.rows; ++r)
  {
    const int begin = batch.first + r * batch.row_stride;
    for (int i = begin; i < begin + batch.cols; ++i)
    {
      visit(i, i + batch.offset);
    }
  }
}

}  // namespace cloth
