#pragma once

// How loops that correct the ends of springs, one spring after the other, are laid out.

#include <array>
#include <cstdlib>

namespace cloth
{

/// The most springs that are corrected in one go.
inline constexpr int spring_row_size = 32;

/// So many numbers are the widest vector.
template <typename Scalar>
inline constexpr int lanes_of = 64 / sizeof(Scalar);

/// Loops over the springs of a row go on to a whole number of the widest vectors, where they change nothing. Arrays of
/// what they read and write have so much room behind the last node or spring.
inline constexpr int row_padding = lanes_of<float>;

/// The columns x, y, z of vectors, one a node.
template <typename Scalar>
using Columns = std::array<Scalar*, 3>;

template <typename Derived>
Columns<typename Derived::Scalar> columns_of(Derived& vectors)
{
  return { vectors.col(0).data(), vectors.col(1).data(), vectors.col(2).data() };
}

/// At most `spring_row_size` springs in a row of a batch: spring k joins node i + k and the node `offset` further on.
struct SpringRow
{
  /// `vectors` are what is corrected: positions, shifts.
  SpringRow(const double* inverse_masses, const Columns<double>& vectors, int node, int offset, int springs)
    : w_i(inverse_masses + node)
    , w_j(w_i + offset)
    , i{ vectors[0] + node, vectors[1] + node, vectors[2] + node }
    , j{ i[0] + offset, i[1] + offset, i[2] + offset }
    , n(springs)
  {
  }

  /// n and what makes it a whole number of vectors.
  int padded() const
  {
    constexpr int lanes = lanes_of<double>;
    return (n + lanes - 1) / lanes * lanes;
  }

  const double* w_i;  ///< inverse masses of the first ends
  const double* w_j;
  std::array<double*, 3> i;  ///< x, y, z of the first ends
  std::array<double*, 3> j;
  int n;
};

/// A vector for each spring of a row, and zero for what makes it a whole number of vectors.
struct RowChanges
{
  alignas(64) double x[spring_row_size];
  alignas(64) double y[spring_row_size];
  alignas(64) double z[spring_row_size];
};

/// Moves the first ends by the changes over their masses, the second ends the other way.
inline void move_ends(const SpringRow& row, const RowChanges& changes)
{
  const double* const columns[] = { changes.x, changes.y, changes.z };
  const double* const w_i = row.w_i;
  const double* const w_j = row.w_j;
  const int n = row.padded();
  for (size_t d = 0; d < 3; ++d)
  {
    const double* const change = columns[d];
    double* const i = row.i[d];
    double* const j = row.j[d];
#pragma GCC ivdep
    for (int k = 0; k < n; ++k)
    {
      i[k] += w_i[k] * change[k];
    }
#pragma GCC ivdep
    for (int k = 0; k < n; ++k)
    {
      j[k] -= w_j[k] * change[k];
    }
  }
}

/// Calls correct(is_chosen) until every spring of a row has been chosen once, so that no two chosen ones share a node:
/// is_chosen(k) says whether spring k is. Springs as far apart as they are long take turns where they share nodes.
template <typename Correct>
void in_turns(int offset, int n, Correct&& correct)
{
  if (std::abs(offset) >= n)
  {
    correct([](int) { return true; });
    return;
  }
  correct([offset](int k) { return (k & offset) == 0; });
  correct([offset](int k) { return (k & offset) != 0; });
}

}  // namespace cloth
