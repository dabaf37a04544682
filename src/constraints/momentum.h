#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "cloth_sim/model/spring_rows.h"

namespace cloth
{

/// Passes over tensions bring them nearer to what they are to be in proportion to their number; where they are carried
/// on along their last change before the next passes, to its square (Nesterov 1983). A pass there and one back are one
/// iteration: both ends of a way through the sheet are alike to the two together, as they must be. What is carried too
/// far begins anew (O'Donoghue and Candes, "Adaptive restart for accelerated gradient schemes", 2015).
template <typename Scalar>
class Momentum
{
public:
  /// What is to be done before the next pass, so many having been made.
  static bool is_to_begin(int passes)
  {
    return passes == passes_an_iteration;
  }
  static bool is_to_carry_on(int passes)
  {
    return passes > passes_an_iteration && passes % passes_an_iteration == 0;
  }

  void begin()
  {
    iterations_ = 0;
  }

  /// To be called after an iteration for all coordinates of the nodes, n at a time and what makes them a whole number
  /// of vectors: they are at `now`, were at `last` after the iteration before, and this one set out from `begin`.
  void compare(const Scalar* now, const Scalar* last, const Scalar* begin, int n)
  {
    for (int first = 0; first < n; first += lanes_of<Scalar>)
    {
#pragma GCC ivdep
      for (int k = 0; k < lanes_of<Scalar>; ++k)
      {
        const int at = first + k;
        taken_back_[k] += (begin[at] - now[at]) * (now[at] - last[at]);
      }
    }
  }

  /// And then: which part of the last iteration's change is to be added to it.
  Scalar next_part()
  {
    Scalar taken_back = 0;
    for (Scalar& sum : taken_back_)
    {
      taken_back += sum;
      sum = 0;
    }
    iterations_ = taken_back > 0 ? 0 : iterations_ + 1;
    return Scalar(iterations_) / Scalar(iterations_ + 3);
  }

private:
  static constexpr int passes_an_iteration = 2;

  int iterations_ = 0;
  alignas(64) Scalar taken_back_[lanes_of<Scalar>] = {};  ///< of the way that an iteration was carried on
};

/// Adds `part` of their last change to n numbers. `last` is where they were after the iteration before, and gets where
/// they are after this one.
template <typename Scalar>
void carry_on(Scalar* now, Scalar* last, int n, Scalar part)
{
#pragma GCC ivdep
  for (int k = 0; k < n; ++k)
  {
    const Scalar reached = now[k];
    now[k] = reached + part * (reached - last[k]);
    last[k] = reached;
  }
}

/// Likewise for the tensions of a run of springs, n in each column: those of a slack run are all 0, and their last ones
/// are of no meaning. Afterwards it counts as taut where it was so after one of both iterations.
template <typename Flag, typename Scalar, size_t columns>
void carry_on(Flag& is_taut, Flag& was_taut, const std::array<Scalar*, columns>& tensions,
              const std::array<Scalar*, columns>& last, int n, Scalar part)
{
  if (!is_taut && !was_taut)
  {
    return;
  }
  for (size_t c = 0; c < columns; ++c)
  {
    if (!was_taut)
    {
      std::fill_n(last[c], n, Scalar(0));
    }
    carry_on(tensions[c], last[c], n, part);
  }
  const Flag before = std::exchange(was_taut, is_taut);
  is_taut = is_taut || before;
}

}  // namespace cloth
