#include "cloth_sim/model/inverse_root.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

/// In units in the last place of the result.
template <bool fused>
double error_at(double square)
{
  const long double exact = 1.0L / std::sqrt(static_cast<long double>(square));
  const double nearest = static_cast<double>(exact);
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return std::abs(static_cast<double>((inverse_root<fused>(square) - exact) / unit));
}

TEST(InverseRoot, IsWithinOneAndAHalfUnitsInTheLastPlace)
{
  double largest_of_root = 0.0;
  double largest_of_steps = 0.0;
  for (int i = 0; i < 200000; ++i)
  {
    // Over two powers of two, after which the guess repeats itself, and over all magnitudes.
    for (const double square : { 1.0 + 3.0 * i / 200000.0, std::exp2(-1021.0 + 2044.0 * i / 200000.0) })
    {
      largest_of_root = std::max(largest_of_root, error_at<false>(square));
      largest_of_steps = std::max(largest_of_steps, error_at<true>(square));
    }
  }
  EXPECT_LE(largest_of_root, 1.5);
  EXPECT_LE(largest_of_steps, 1.5);
}

TEST(InverseRoot, OfAVectorOfNoLengthIsZero)
{
  EXPECT_EQ(inverse_root<true>(0.0), 0.0);
  EXPECT_EQ(inverse_root<false>(0.0), 0.0);
  EXPECT_EQ(inverse_root<true>(1e-310), 0.0);
  EXPECT_EQ(inverse_root<false>(1e-310), 0.0);
}

}  // namespace
}  // namespace cloth
