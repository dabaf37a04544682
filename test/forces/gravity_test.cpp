#include "cloth_sim/forces/gravity.h"

#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

TEST(Gravity, IsMinusTheGradientOfItsEnergy)
{
  const ClothModel model = make_sheet(small_sheet());
  const Eigen::Vector3d gravity(0.3, -1.2, -9.81);
  Vectors forces = Vectors::Zero(model.nodes(), 3);
  add_gravity(model, gravity, forces);
  for (Eigen::Index element = 0; element < forces.size(); ++element)
  {
    Vectors moved = model.rest_positions;
    moved.data()[element] += 1.0;
    const double change =
        gravitational_energy(model, gravity, moved) - gravitational_energy(model, gravity, model.rest_positions);
    EXPECT_NEAR(forces.data()[element], -change, 1e-14);
  }
}

TEST(Gravity, PullsWithTheSheetsWeight)
{
  const ClothModel model = make_sheet(small_sheet());
  Vectors forces = Vectors::Zero(model.nodes(), 3);
  add_gravity(model, { 0.0, 0.0, -9.81 }, forces);
  EXPECT_NEAR(forces.col(2).sum(), -0.04 * 9.81, 1e-14);
  EXPECT_NEAR(gravitational_energy(model, { 0.0, 0.0, -9.81 },
                                   model.rest_positions.rowwise() + Eigen::RowVector3d(5.0, 5.0, 2.0)),
              0.04 * 9.81 * (2.0 - 0.15), 1e-14);
}

}  // namespace
}  // namespace cloth
