#include "shading.h"

#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

const Eigen::Vector3d grey(0.5, 0.5, 0.5);

TEST(Shading, BothSidesLookTheSame)
{
  Noise noise;
  for (int i = 0; i < 100; ++i)
  {
    const Eigen::Vector3d normal = noise.vector().normalized();
    EXPECT_EQ(lit(grey, normal), lit(grey, -normal));
    EXPECT_EQ(softly_lit(grey, normal), softly_lit(grey, -normal));
  }
}

TEST(Shading, IsNeverBlackAndNeverBeyondWhite)
{
  Noise noise;
  for (int i = 0; i < 1000; ++i)
  {
    const Eigen::Vector3d normal = noise.vector().normalized();
    EXPECT_GT(lit(grey, normal).minCoeff(), 0.25 * 0.5);
    EXPECT_LE(lit(Eigen::Vector3d::Ones(), normal).maxCoeff(), 1.0);
  }
  EXPECT_GT(lit(grey, Eigen::Vector3d::Zero()).minCoeff(), 0.1);
}

TEST(Shading, TheTwoFlanksOfAFoldDiffer)
{
  const Eigen::Vector3d one_flank(0.6, 0.8, 0.0);
  const Eigen::Vector3d other_flank(-0.6, 0.8, 0.0);
  EXPECT_GT(lit(grey, one_flank).sum(), 1.3 * lit(grey, other_flank).sum());
}

TEST(StrainColour, RunsFromBlueToRed)
{
  const Eigen::Vector3d slack = strain_colour(0.0, 0.1);
  const Eigen::Vector3d stretched = strain_colour(0.1, 0.1);
  EXPECT_GT(slack.z(), slack.x());
  EXPECT_GT(stretched.x(), stretched.z());
  EXPECT_EQ(strain_colour(-0.5, 0.1), slack);
  EXPECT_EQ(strain_colour(0.5, 0.1), stretched);
  for (double strain = 0.0; strain < 0.1; strain += 0.001)
  {
    EXPECT_LT((strain_colour(strain + 0.001, 0.1) - strain_colour(strain, 0.1)).norm(), 0.05) << "a jump at " << strain;
  }
}

}  // namespace
}  // namespace cloth
