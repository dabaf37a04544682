#pragma once

#include <cstdint>
#include <random>

namespace cloth
{

/// Draws that come out the same on any machine: the standard settles what std::mt19937_64 gives, but not what its
/// distributions make of that.
class Draw
{
public:
  /// A stream of its own for each scene and each attempt at it: what one scene draws changes no other.
  Draw(std::uint64_t seed, std::uint64_t number, std::uint64_t attempt);

  /// In [0, 1), a multiple of 2^-53.
  double part();
  /// In [low, high], each alike.
  int whole(int low, int high);
  /// True in `chances` of `of` cases.
  bool once_in(int chances, int of);
  /// In [low, high], to three digits.
  double even(double low, double high);
  /// In [low, high], both above 0, evenly in its logarithm, to three digits.
  double logarithmic(double low, double high);

private:
  std::mt19937_64 engine_;
};

}  // namespace cloth
