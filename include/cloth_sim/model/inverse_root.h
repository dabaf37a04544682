#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace cloth
{

/// 1/sqrt(square) within 1.5 units in the last place, or 0 where `square` is no normal number above 0: vectors of no
/// length (below 1.5e-154) have no direction. Written so that loops over it vectorise.
///
/// A square root and a division take as long as sixty multiply-adds in vectors of eight doubles. With `fused`, where
/// multiply-adds are one operation, they are avoided: a first guess from the halved exponent, within 3.5 % (Lomont,
/// "Fast inverse square root", 2003), and two steps y <- y (1 - h)^(-1/2), h = 1 - square y^2 (Householder). In the
/// first the root is the cubic polynomial closest to it for |h| < 0.0691, and leaves 8e-7; in the second its series up
/// to h^2, which leaves rounding alone.
template <bool fused>
inline double inverse_root(double square)
{
  constexpr double least = std::numeric_limits<double>::min();
  if constexpr (!fused)
  {
    return square >= least ? 1.0 / std::sqrt(square) : 0.0;
  }
  std::int64_t bits;
  std::memcpy(&bits, &square, sizeof bits);
  bits = 0x5FE6EB50C7B537A9 - (bits >> 1);
  double y;
  std::memcpy(&y, &bits, sizeof y);
  double h = 1.0 - square * y * y;
  y *= 0.9999992549848017 + h * (0.5000013195662306 + h * (0.3762781196169194 + h * 0.31279764017634387));
  h = 1.0 - square * y * y;
  y += y * h * (0.5 + h * 0.375);
  return square >= least ? y : 0.0;
}

/// The same in single precision, within 3 units in the last place: one step is enough, in which the root is the
/// polynomial of fourth degree closest to it, relatively, which leaves 2.5e-8.
template <bool fused>
inline float inverse_root(float square)
{
  constexpr float least = std::numeric_limits<float>::min();
  if constexpr (!fused)
  {
    return square >= least ? 1.0F / std::sqrt(square) : 0.0F;
  }
  std::int32_t bits;
  std::memcpy(&bits, &square, sizeof bits);
  bits = 0x5F37642F - (bits >> 1);
  float y;
  std::memcpy(&y, &bits, sizeof y);
  const float h = 1.0F - square * y * y;
  y *= 1.0F + h * (0.49999824F + h * (0.37499721F + h * (0.31397508F + h * 0.27503636F)));
  return square >= least ? y : 0.0F;
}

}  // namespace cloth
