#pragma once

#include <vector>

#include "cloth_sim/model/spring_rows.h"

#include "aligned_vectors.h"
#include "spring_layout.h"

namespace cloth
{

inline constexpr int lanes = lanes_of<float>;

/// Springs are visited batch by batch for so many rows of nodes: these stay in the nearest cache, and springs that
/// follow each other seldom wait for one another's ends.
inline constexpr int rows_a_band = 8;

/// Some numbers for each of 16 nodes or springs, a vector of each number side by side, and so on for the next 16: what
/// a loop over 16 reads is in one piece, and one address is enough for all of it. Numbers that lie a lane further on
/// than a vector begins (LaneLayout) reach into the next vector by one, which loops must leave as it is.
template <int numbers>
class LaneBlocks
{
public:
  static constexpr int size = numbers * lanes;  ///< of a block

  void set_zero(int nodes)
  {
    values_.assign(static_cast<size_t>((nodes + lanes - 1) / lanes * size + lanes), 0.0F);
  }

  /// Where the node of this number in a LaneLayout has its first number; the others are a vector further on each.
  static int place_of(int node)
  {
    const int first_of_block = node & -lanes;
    return numbers * first_of_block + (node - first_of_block);
  }

  float* data()
  {
    return values_.data();
  }
  const float* data() const
  {
    return values_.data();
  }

private:
  AlignedNumbers<float> values_;
};

/// A sheet's nodes while a step moves them: where each of their numbers begins in a block.
namespace lane_node
{
inline constexpr int inverse_mass = 0;  ///< 1/kg; 0: held
inline constexpr int x = 1 * lanes;     ///< at the substep's begin, m
inline constexpr int y = 2 * lanes;
inline constexpr int z = 3 * lanes;
inline constexpr int way_x = 4 * lanes;  ///< since then, m: differences of them are not rounded as those of x are
inline constexpr int way_y = 5 * lanes;
inline constexpr int way_z = 6 * lanes;
}  // namespace lane_node

using LaneNodes = LaneBlocks<7>;

/// A vector of each coordinate, of what springs do to nodes or have as tensions.
namespace lane_vector
{
inline constexpr int x = 0 * lanes;
inline constexpr int y = 1 * lanes;
inline constexpr int z = 2 * lanes;
}  // namespace lane_vector

using LaneVectors = LaneBlocks<3>;

/// The same address, kept in a register as it is: what lies near it is then loaded and stored at a distance from it,
/// where compilers make up an address for every number otherwise.
template <typename Number>
Number* kept(Number* address)
{
#if defined(__GNUC__)
  asm("" : "+r"(address));
#endif
  return address;
}

/// Adds a vector of spring k, times a number for each end, to what `i` has at its first end, and takes it from what `j`
/// has at its second: all is read before anything is written, as the two may lie in one block.
inline void add_to_ends(float* i, float* j, int k, float x, float y, float z, float times_i, float times_j)
{
  const float x_i = i[lane_vector::x + k] + times_i * x;
  const float y_i = i[lane_vector::y + k] + times_i * y;
  const float z_i = i[lane_vector::z + k] + times_i * z;
  const float x_j = j[lane_vector::x + k] - times_j * x;
  const float y_j = j[lane_vector::y + k] - times_j * y;
  const float z_j = j[lane_vector::z + k] - times_j * z;
  i[lane_vector::x + k] = x_i;
  i[lane_vector::y + k] = y_i;
  i[lane_vector::z + k] = z_i;
  j[lane_vector::x + k] = x_j;
  j[lane_vector::y + k] = y_j;
  j[lane_vector::z + k] = z_j;
}

/// A vector of springs: the numbers of their first ends, and of the second, and where both are among LaneNodes.
struct LaneRun
{
  explicit LaneRun(const SpringRun& run)
    : batch(run.batch)
    , i(run.node)
    , j(run.node + run.offset)
    , n(run.n)
    , place_i(LaneNodes::place_of(i))
    , place_j(LaneNodes::place_of(j))
  {
  }

  size_t batch;
  int i;
  int j;
  int n;
  int place_i;
  int place_j;
};

}  // namespace cloth
