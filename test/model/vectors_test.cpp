#include "cloth_sim/model/vectors.h"

#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

bool begins_a_line(const Vectors& vectors)
{
  return reinterpret_cast<std::uintptr_t>(vectors.data()) % 64 == 0;
}

TEST(Vectors, BeginWhereTheWidestRegisterDoesHoweverTheyAreMade)
{
  for (const int n : { 1, 7, 64, 1000, 100000 })
  {
    const Vectors made = Vectors::Constant(n, 3, 2.0);
    EXPECT_TRUE(begins_a_line(made)) << n;
    const Vectors copied = made;
    EXPECT_TRUE(begins_a_line(copied)) << n;
    const Vectors worked_out = made + copied.cwiseProduct(made);
    EXPECT_TRUE(begins_a_line(worked_out)) << n;
    EXPECT_EQ(worked_out.sum(), 18.0 * n);
    Vectors resized;
    resized.resize(n, 3);
    EXPECT_TRUE(begins_a_line(resized)) << n;
  }
}

TEST(Vectors, AreCopiedMovedAndSwappedAsOtherMatricesAre)
{
  Vectors one = Vectors::Constant(5, 3, 1.0);
  Vectors other = one;
  other(4, 2) = 7.0;
  EXPECT_EQ(one(4, 2), 1.0);
  one.swap(other);
  EXPECT_EQ(one(4, 2), 7.0);
  const double* const memory = one.data();
  const Vectors moved = std::move(one);
  EXPECT_EQ(moved.data(), memory);
  EXPECT_EQ(moved.rows(), 5);
  other.conservativeResize(6, 3);
  EXPECT_EQ(other.topRows(5), Vectors::Constant(5, 3, 1.0));
  other = moved.topRows(2);
  EXPECT_EQ(other.rows(), 2);
}

}  // namespace
}  // namespace cloth
