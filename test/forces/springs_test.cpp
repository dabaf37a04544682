#include "cloth_sim/forces/springs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "cloth_sim/forces/spring_force.h"
#include "cloth_sim/model/wide_vectors.h"
#include "support.h"

namespace cloth
{
namespace
{

TEST(SpringForce, IsElasticAndDampingAlongTheSpring)
{
  // Along x: |l| = 0.5, l0 = 0.4, so k (0.5 - 0.4); the ends part at 2 m/s along the spring and slide at 7 m/s across.
  const Spring spring{ 30.0, 0.6, 0.4 };
  const Eigen::Vector3d force =
      spring_force(spring, { 1.0, 2.0, 3.0 }, { 1.5, 2.0, 3.0 }, { 1.0, 0.0, 0.0 }, { 3.0, 7.0, 0.0 });
  EXPECT_TRUE(force.isApprox(Eigen::Vector3d(30.0 * 0.1 + 0.6 * 2.0, 0.0, 0.0), 1e-14)) << force.transpose();
}

TEST(SpringForce, PushesWhenCompressed)
{
  EXPECT_LT(spring_force({ 30.0, 0.0, 0.4 }, { 0, 0, 0 }, { 0, 0, 0.3 }, { 0, 0, 0 }, { 0, 0, 0 }).z(), 0.0);
}

TEST(SpringForce, IsOppositeOnTheOtherEndToTheLastBit)
{
  Noise noise;
  const Spring spring{ 80.0, 0.3, 0.7 };
  for (int trial = 0; trial < 100; ++trial)
  {
    const Eigen::Vector3d x_i = noise.vector(), x_j = noise.vector(), v_i = noise.vector(), v_j = noise.vector();
    EXPECT_EQ(spring_force(spring, x_i, x_j, v_i, v_j), -spring_force(spring, x_j, x_i, v_j, v_i));
  }
}

TEST(SpringForce, OfASpringOfNoLengthIsZero)
{
  EXPECT_TRUE(spring_force({ 80.0, 0.3, 0.7 }, { 1, 1, 1 }, { 1, 1, 1 }, { 0, 0, 0 }, { 5, 0, 0 }).isZero(0.0));
}

TEST(SpringForce, AddedToBothEndsLeavesNoSum)
{
  Vectors forces = Vectors::Zero(4, 3);
  add_to_both_ends({ 0.1, -0.2, 0.3 }, 1, 3, forces);
  EXPECT_EQ(forces.row(1), Eigen::RowVector3d(0.1, -0.2, 0.3));
  EXPECT_EQ(forces.row(3), Eigen::RowVector3d(-0.1, 0.2, -0.3));
  EXPECT_TRUE(forces.row(0).isZero(0.0) && forces.row(2).isZero(0.0));
}

class DeformedSheet : public testing::TestWithParam<std::pair<int, int>>
{
protected:
  DeformedSheet()
  {
    Noise noise;
    positions_ = model_.rest_positions + 0.02 * noise.vectors(model_.nodes());
    velocities_ = noise.vectors(model_.nodes());
  }

  const ClothModel model_ = make_sheet(small_sheet(GetParam().first, GetParam().second));
  Vectors positions_;
  Vectors velocities_;
};

TEST_P(DeformedSheet, BatchesAddTheReferenceForce)
{
  Vectors reference = Vectors::Zero(model_.nodes(), 3);
  for (const SpringBatch& batch : model_.springs)
  {
    const Spring spring{ batch.stiffness, batch.damping, batch.rest_length };
    for_each_spring(batch, [&](int i, int j) {
      const Eigen::Vector3d force =
          spring_force(spring, positions_.row(i), positions_.row(j), velocities_.row(i), velocities_.row(j));
      add_to_both_ends(force, i, j, reference);
    });
  }
  Vectors forces = Vectors::Zero(model_.nodes(), 3);
  add_spring_forces(model_, positions_, velocities_, forces);
  EXPECT_LT((forces - reference).cwiseAbs().maxCoeff(), 1e-13 * reference.cwiseAbs().maxCoeff());
}

TEST_P(DeformedSheet, EveryVectorWidthWithFusedMultiplyAddsGivesTheSameBitsAndTheBuildsOwnHardlyOthers)
{
  std::vector<Vectors> forces;
  for (const VectorWidth width : vector_widths())
  {
    use_vector_width(width);
    forces.push_back(Vectors::Zero(model_.nodes(), 3));
    add_spring_forces(model_, positions_, velocities_, forces.back());
  }
  EXPECT_EQ(vector_width(), vector_widths().back());
  const double largest = forces.front().cwiseAbs().maxCoeff();
  for (size_t w = 1; w < forces.size(); ++w)
  {
    EXPECT_EQ(forces[w], forces[1]);
    EXPECT_LT((forces[w] - forces[0]).cwiseAbs().maxCoeff(), 1e-13 * largest);
  }
}

TEST_P(DeformedSheet, ForcesOfABandAreThoseOfTheWholeToTheLastBit)
{
  const Vectors start = Vectors::Constant(model_.nodes(), 3, 0.1);
  Vectors whole = start;
  add_spring_forces(model_, positions_, velocities_, whole);
  Vectors bands = start;
  for_each_stretch(model_, all_nodes(model_), [&](NodeRange band) {
    for_each_stretch(model_, { std::max(0, band.begin - longest_reach(model_)), band.end }, [&](NodeRange first_ends) {
      add_spring_forces(model_, positions_, velocities_, first_ends, band, bands);
    });
  });
  EXPECT_EQ(bands, whole);
}

TEST_P(DeformedSheet, ForcesAddToWhatIsThere)
{
  Vectors twice = Vectors::Zero(model_.nodes(), 3);
  add_spring_forces(model_, positions_, velocities_, twice);
  const Vectors once = twice;
  add_spring_forces(model_, positions_, velocities_, twice);
  EXPECT_TRUE(twice.isApprox(2.0 * once, 1e-13));
}

TEST_P(DeformedSheet, ForcesSumToNothing)
{
  Vectors forces = Vectors::Zero(model_.nodes(), 3);
  add_spring_forces(model_, positions_, velocities_, forces);
  EXPECT_LT(forces.colwise().sum().norm(), 1e-13 * forces.cwiseAbs().sum());
}

TEST_P(DeformedSheet, ElasticForceIsMinusTheGradientOfTheEnergy)
{
  Vectors forces = Vectors::Zero(model_.nodes(), 3);
  add_spring_forces(model_, positions_, Vectors::Zero(model_.nodes(), 3), forces);
  constexpr double difference = 1e-6;
  for (Eigen::Index element = 0; element < positions_.size(); ++element)
  {
    Vectors moved = positions_;
    moved.data()[element] += difference;
    const double ahead = elastic_energy(model_, moved);
    moved.data()[element] -= 2.0 * difference;
    const double behind = elastic_energy(model_, moved);
    EXPECT_NEAR(forces.data()[element], -(ahead - behind) / (2.0 * difference), 1e-7);
  }
}

TEST_P(DeformedSheet, DampingTakesEnergyOut)
{
  Vectors elastic = Vectors::Zero(model_.nodes(), 3);
  Vectors all = elastic;
  add_spring_forces(model_, positions_, Vectors::Zero(model_.nodes(), 3), elastic);
  add_spring_forces(model_, positions_, velocities_, all);
  EXPECT_LT((all - elastic).cwiseProduct(velocities_).sum(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, DeformedSheet,
                         testing::Values(std::pair(5, 6), std::pair(2, 2), std::pair(2, 1), std::pair(1, 7),
                                         std::pair(3, 140), std::pair(30, 20), std::pair(700, 1)));

/// Central differences of the elastic force along `direction`, with the sign of a stiffness.
Vectors change_of_force(const ClothModel& model, const Vectors& positions, const Vectors& direction)
{
  const Vectors at_rest = Vectors::Zero(model.nodes(), 3);
  constexpr double difference = 1e-6;
  Vectors ahead = at_rest;
  Vectors behind = at_rest;
  add_spring_forces(model, positions + difference * direction, at_rest, ahead);
  add_spring_forces(model, positions - difference * direction, at_rest, behind);
  return (behind - ahead) / (2.0 * difference);
}

TEST(StiffnessProduct, OfAStretchedSheetIsMinusTheChangeOfTheForceWithPosition)
{
  const ClothModel model = make_sheet(small_sheet());
  Noise noise;
  const Vectors positions = 1.4 * model.rest_positions + 0.005 * noise.vectors(model.nodes());
  const Vectors direction = noise.vectors(model.nodes());
  Vectors product = Vectors::Zero(model.nodes(), 3);
  add_stiffness_product(model, positions, direction, product);
  EXPECT_TRUE(product.isApprox(change_of_force(model, positions, direction), 1e-7));
}

TEST(StiffnessProduct, OfACompressedSpringHasNoNegativePart)
{
  const ClothModel model = make_sheet(chain(2, 100.0, 1.0));
  Vectors positions = model.rest_positions;
  positions(1, 2) = -0.5;
  Vectors across = Vectors::Zero(2, 3);
  across(1, 0) = 1.0;
  Vectors product = Vectors::Zero(2, 3);
  add_stiffness_product(model, positions, across, product);
  EXPECT_TRUE(product.isZero(0.0));
  Vectors along = Vectors::Zero(2, 3);
  along(1, 2) = 1.0;
  add_stiffness_product(model, positions, along, product);
  EXPECT_DOUBLE_EQ(product(1, 2), 100.0);
}

TEST(HessianProduct, IsMinusTheChangeOfTheForceWithPositionStretchedOrCompressed)
{
  const ClothModel model = make_sheet(small_sheet(3, 140));
  Noise noise;
  for (const double stretch : { 0.6, 1.0, 1.4 })
  {
    // Cells are 3.6 mm wide.
    const Vectors positions = stretch * model.rest_positions + 5e-4 * noise.vectors(model.nodes());
    const Vectors direction = noise.vectors(model.nodes());
    Vectors product = Vectors::Zero(model.nodes(), 3);
    add_hessian_product(model, positions, direction, product);
    EXPECT_TRUE(product.isApprox(change_of_force(model, positions, direction), 1e-6)) << "stretched to " << stretch;
  }
}

TEST(HessianProduct, AddsToWhatIsThereAndOfACompressedSpringIsNegativeAcross)
{
  const ClothModel model = make_sheet(chain(2, 100.0, 1.0));
  Vectors positions = model.rest_positions;
  positions(1, 2) = -0.5;
  Vectors across = Vectors::Zero(2, 3);
  across(1, 0) = 1.0;
  Vectors product = Vectors::Constant(2, 3, 7.0);
  add_hessian_product(model, positions, across, product);
  EXPECT_DOUBLE_EQ(product(1, 0), 7.0 - 100.0);
  EXPECT_DOUBLE_EQ(product(0, 0), 7.0 + 100.0);
  EXPECT_DOUBLE_EQ(product(1, 2), 7.0);
}

TEST(DampingProduct, IsMinusTheChangeOfTheForceWithVelocity)
{
  const ClothModel model = make_sheet(small_sheet(3, 140));
  Noise noise;
  const Vectors positions = model.rest_positions + 5e-4 * noise.vectors(model.nodes());
  const Vectors direction = noise.vectors(model.nodes());
  // Forces are linear in velocities.
  Vectors at_rest = Vectors::Zero(model.nodes(), 3);
  Vectors moving = at_rest;
  add_spring_forces(model, positions, Vectors::Zero(model.nodes(), 3), at_rest);
  add_spring_forces(model, positions, direction, moving);
  Vectors product = Vectors::Zero(model.nodes(), 3);
  add_damping_product(model, positions, direction, product);
  EXPECT_TRUE(product.isApprox(at_rest - moving, 1e-12));
}

TEST(ElasticEnergy, OfOneSpringIsHalfKTimesItsExtensionSquared)
{
  const ClothModel model = make_sheet(chain(2, 100.0, 1.0));
  Vectors positions = model.rest_positions;
  positions(1, 2) -= 0.2;
  EXPECT_NEAR(elastic_energy(model, positions), 0.5 * 100.0 * 0.04, 1e-14);
}

TEST(MaxStrain, IsThatOfTheLongestStructuralOrShearSpringAndNotOfFlex)
{
  SheetProperties sheet = small_sheet(3, 3);
  const ClothModel model = make_sheet(sheet);
  EXPECT_NEAR(max_strain(model, model.rest_positions), 0.0, 1e-15);
  EXPECT_NEAR(max_strain(model, 1.25 * model.rest_positions), 0.25, 1e-14);
  EXPECT_NEAR(max_strain(model, 0.5 * model.rest_positions), 0.0, 1e-15);
  sheet.structural.stiffness = 0.0;
  sheet.shear.stiffness = 0.0;
  const ClothModel flex_alone = make_sheet(sheet);
  EXPECT_EQ(max_strain(flex_alone, 1.25 * flex_alone.rest_positions), 0.0);
}

}  // namespace
}  // namespace cloth
