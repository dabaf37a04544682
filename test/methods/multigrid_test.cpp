#include "multigrid.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "conjugate_gradients.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double step = 0.01;  // s

/// The system of a long step of a stiff sheet that is not flat, held where pins say.
class StiffSystem
{
public:
  StiffSystem(int rows, int cols, const std::vector<int>& held)
    : dynamics_(make_sheet(stiff_sheet(rows, cols)), Eigen::Vector3d::Zero(), vacuum())
  {
    const ClothModel& model = dynamics_.model();
    Vectors positions = model.rest_positions;
    positions.col(1) = 0.1 * (6.0 * positions.col(0).array()).sin() * (5.0 * positions.col(2).array()).cos();
    if (!held.empty())
    {
      dynamics_.pins().hold(still_pin("pin", held, positions));
    }
    springs_.linearise(model, positions, step * step, step, 0.9 * model.masses.array());
    multigrid_.prepare(model, dynamics_.pins(), model.masses.array(), springs_);
    right_ = Noise().vectors(model.nodes());
    dynamics_.pins().clear_held(right_);
  }

  static SheetProperties stiff_sheet(int rows, int cols)
  {
    SheetProperties sheet;
    sheet.rows = rows;
    sheet.cols = cols;
    sheet.structural.stiffness = sheet.shear.stiffness = 1e4;
    sheet.flex.stiffness = 1e3;
    return sheet;
  }

  void multiply(const Vectors& u, Vectors& product) const
  {
    product = u.array().colwise() * masses().array();
    springs_.add_product(u, product);
    dynamics_.pins().clear_held(product);
  }

  Vectors preconditioned(const Vectors& r)
  {
    Vectors z;
    multigrid_.apply(r, z);
    return z;
  }

  /// Of A x = -right().
  Vectors solution(bool by_multigrid, double part)
  {
    const auto product = [&](const Vectors& u, Vectors& result) { multiply(u, result); };
    const auto precondition = [&](const Vectors& r, Vectors& z) { multigrid_.apply(r, z); };
    Vectors x;
    EXPECT_TRUE(by_multigrid ? solver_.solve(product, precondition, masses(), right_, part, x) :
                               solver_.solve(product, MassPreconditioner(masses()), masses(), right_, part, x));
    return x;
  }

  int iterations() const
  {
    return solver_.iterations();
  }
  const Vectors& right() const
  {
    return right_;
  }
  const Eigen::VectorXd& masses() const
  {
    return dynamics_.model().masses;
  }

private:
  Dynamics dynamics_;
  SpringJacobian springs_;
  Multigrid multigrid_;
  ConjugateGradients solver_;
  Vectors right_;
};

const std::vector<int> corners_of_13_by_8{ 0, 7 };

TEST(Multigrid, IsSymmetricAndPositiveDefinite)
{
  StiffSystem system(13, 8, corners_of_13_by_8);
  Noise noise;
  for (int i = 0; i < 20; ++i)
  {
    Vectors one = noise.vectors(13 * 8);
    Vectors other = noise.vectors(13 * 8);
    one(corners_of_13_by_8, Eigen::all).setZero();
    other(corners_of_13_by_8, Eigen::all).setZero();
    const double product = dot(one, system.preconditioned(other));
    EXPECT_NEAR(product, dot(other, system.preconditioned(one)),
                1e-12 * one.norm() * system.preconditioned(other).norm());
    EXPECT_GT(dot(one, system.preconditioned(one)), 0.0);
  }
}

TEST(Multigrid, LeavesHeldNodesWhereTheyAre)
{
  StiffSystem system(13, 8, corners_of_13_by_8);
  const Vectors z = system.preconditioned(system.right());
  for (const int node : corners_of_13_by_8)
  {
    EXPECT_EQ(z.row(node).norm(), 0.0);
  }
}

TEST(Multigrid, SolvesTheSameSystem)
{
  struct Sheet
  {
    int rows;
    int cols;
    std::vector<int> held;
  };
  for (const Sheet& sheet :
       { Sheet{ 9, 9, { 0, 8 } }, Sheet{ 13, 8, {} }, Sheet{ 2, 30, { 0, 1, 2, 3 } }, Sheet{ 21, 3, { 0, 1, 2 } },
         Sheet{ 2, 2, { 0 } }, Sheet{ 3, 3, { 0, 1, 2, 3, 4, 5, 6 } } })
  {
    StiffSystem system(sheet.rows, sheet.cols, sheet.held);
    const Vectors by_masses = system.solution(false, 1e-12);
    const Vectors by_multigrid = system.solution(true, 1e-12);
    EXPECT_LT((by_multigrid - by_masses).norm(), 1e-8 * by_masses.norm()) << sheet.rows << " x " << sheet.cols;
  }
}

TEST(Multigrid, NeedsHardlyMoreIterationsOnAFinerSheet)
{
  int coarsest = 0;
  int finest = 0;
  for (const int nodes_a_side : { 16, 32, 64 })
  {
    StiffSystem system(nodes_a_side, nodes_a_side, { 0, nodes_a_side - 1 });
    system.solution(true, 1e-3);
    finest = system.iterations();
    coarsest = coarsest == 0 ? finest : coarsest;
    EXPECT_LE(finest, 15) << nodes_a_side;
  }
  EXPECT_LE(finest, coarsest + 5);
  StiffSystem system(64, 64, { 0, 63 });
  system.solution(false, 1e-3);
  EXPECT_GT(system.iterations(), 5 * finest);
}

TEST(Multigrid, KeepsTheMomentumOfAFreeSheet)
{
  StiffSystem system(13, 8, {});
  const Vectors z = system.preconditioned(system.right());
  const Eigen::RowVector3d momentum = system.masses().transpose() * z;
  EXPECT_LT((momentum - system.right().colwise().sum()).norm(), 1e-12 * system.right().norm());
}

TEST(Multigrid, MakesStepsOfStiffSheetsCheap)
{
  SceneParams scene;
  scene.sheet = StiffSystem::stiff_sheet(48, 48);
  scene.strain_limit.max_strain = 0.0;
  scene.solver.method = "implicit_euler";
  scene.solver.time_step = step;
  Simulation simulation = build_simulation(make_plan(scene));
  ASSERT_TRUE(simulation.advance_to(0.05));
  const Simulation::Counters& counters = simulation.counters();
  EXPECT_GT(counters.linear_solves, 0u);
  EXPECT_LE(counters.linear_iterations, 20 * counters.linear_solves);
}

}  // namespace
}  // namespace cloth
