// An error of known size is measured.

#include <cmath>

#include "errors.h"
#include "small_problem.h"
#include "spatial.h"
#include "support.h"

#include "cloth_sim/forces/gravity.h"

namespace cloth
{
namespace
{

class ErrorsOfAMotion : public testing::Test
{
protected:
  Errors errors() const
  {
    return errors_of(simulation_.dynamics(), moved_, exact_);
  }

  const Problem problem_ = small_problem();
  const Simulation simulation_ = simulation_of(problem_, "rk4", 1.0, {});
  const std::vector<ClothState> exact_ = exact_motion(problem_).samples;
  std::vector<ClothState> moved_ = exact_;
};

TEST_F(ErrorsOfAMotion, AreZeroOfTheReferenceItself)
{
  const Errors none = errors();
  EXPECT_EQ(none.rms, 0.0);
  EXPECT_EQ(none.worst, 0.0);
  EXPECT_EQ(none.energy, 0.0);
  EXPECT_EQ(none.strain, 0.0);
}

TEST_F(ErrorsOfAMotion, AreThoseThatWerePutIn)
{
  for (const double size : { 1e-1, 1e-3, 1e-6 })
  {
    moved_ = StraySolver().run(problem_, size, 0.0).samples;
    EXPECT_NEAR(errors().rms, size, 0.01 * size);
    EXPECT_NEAR(errors().worst, size, 0.01 * size);
  }
}

TEST_F(ErrorsOfAMotion, CountEveryNodeAtEveryTimeAlike)
{
  moved_[3].positions.row(7) += Eigen::RowVector3d(0.0, 3e-3, 4e-3);
  EXPECT_NEAR(errors().rms, 5e-3 / std::sqrt(30.0 * Problem::samples), 1e-9);
  EXPECT_NEAR(errors().worst, 5e-3, 1e-9);
}

TEST_F(ErrorsOfAMotion, HaveTheEnergyThatIsTooMuch)
{
  moved_[5].positions.col(2).array() += 0.02;
  EXPECT_NEAR(errors().energy, 0.3 * 9.81 * 0.02, 1e-9);
  EXPECT_NEAR(errors().strain, 0.0, 1e-12);
  moved_ = exact_;
  moved_[1].velocities.setZero();
  EXPECT_NEAR(errors().energy, energies_of(simulation_.dynamics(), exact_[1]).kinetic, 1e-12);
}

TEST_F(ErrorsOfAMotion, HaveTheStrainThatIsTooMuch)
{
  for (ClothState& sample : moved_)
  {
    sample.positions = 1.5 * simulation_.model().rest_positions;
  }
  double least = 1.0;
  for (const ClothState& sample : exact_)
  {
    least = std::min(least, max_strain(simulation_.model(), sample.positions));
  }
  EXPECT_NEAR(errors().strain, 0.5 - least, 1e-12);
}

TEST(RefinedSheet, HasTheCoarseNodesWhereTheyWere)
{
  const SceneParams coarse =
      scene_of("cloth: {rows: 4, cols: 6}\npins: [{name: a, nodes: [[0, 0], [2, -1], [-2, 3]]}]");
  const SceneParams fine = refined(coarse, 4);
  EXPECT_EQ(fine.sheet.rows, 13);
  EXPECT_EQ(fine.sheet.cols, 21);
  using Nodes = std::vector<std::array<int, 2>>;
  EXPECT_EQ(fine.pins.at(0).nodes, (Nodes{ { 0, 0 }, { 8, -1 }, { -5, 12 } }));
  const ClothModel coarse_model = make_sheet(coarse.sheet);
  const ClothModel fine_model = make_sheet(fine.sheet);
  ClothState one{ coarse_model.rest_positions, {}, 0.0 };
  const ClothState other{ fine_model.rest_positions, {}, 0.0 };
  EXPECT_NEAR(errors_between_grids(coarse_model, { one }, fine_model, { other }, 4).worst, 0.0, 1e-12);
  one.positions(9, 1) += 0.3;
  const Errors errors = errors_between_grids(coarse_model, { one }, fine_model, { other }, 4);
  EXPECT_NEAR(errors.worst, 0.3, 1e-12);
  EXPECT_NEAR(errors.rms, 0.3 / std::sqrt(24.0), 1e-12);
}

}  // namespace
}  // namespace cloth
