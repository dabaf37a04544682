// What `settle` finds, against exact statics and an independent minimiser.

#include "cloth_sim/simulation/statics.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/gravity.h"
#include "cloth_sim/forces/springs.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double g = 9.81;
constexpr double tolerance = 1e-8;
const Eigen::Vector3d gravity(0.0, 0.0, -g);

Pins held(const ClothModel& model, const std::vector<int>& nodes)
{
  Pins pins(model.nodes());
  pins.hold(still_pin("pin", nodes, model.rest_positions));
  return pins;
}

/// The largest net force of springs and gravity on a free node, N.
double net_force(const ClothModel& model, const Pins& pins, const Vectors& positions)
{
  Vectors forces = Vectors::Zero(model.nodes(), 3);
  add_gravity(model, gravity, forces);
  add_spring_forces(model, positions, Vectors::Zero(model.nodes(), 3), forces);
  pins.clear_held(forces);
  return forces.rowwise().norm().maxCoeff();
}

double energy(const ClothModel& model, const Vectors& positions)
{
  return elastic_energy(model, positions) + gravitational_energy(model, gravity, positions);
}

double length_of_link(const Vectors& positions, int i)
{
  return (positions.row(i) - positions.row(i - 1)).norm();
}

TEST(Settle, StretchesEachLinkOfAHangingChainByWhatHangsBelow)
{
  // T_i = (N - i + 1) m g, l_i = l0 + T_i/k; in all N l0 + m g N (N + 1)/2k. It starts level, and must swing down.
  const int links = 20;
  const double k = 200.0;
  const double m = 0.01;
  const ClothModel model = make_sheet(chain(links + 1, k, m));
  Vectors positions = model.rest_positions;
  positions.col(0) = -model.rest_positions.col(2);
  positions.col(2).setZero();
  const StaticsReport report = settle(model, held(model, { 0 }), gravity, 0.0, tolerance, positions);
  ASSERT_TRUE(report.converged);
  EXPECT_LT(report.residual, tolerance);
  EXPECT_DOUBLE_EQ(report.force_scale, (links + 1) * m * g);
  for (int i = 1; i <= links; ++i)
  {
    EXPECT_NEAR(length_of_link(positions, i), 1.0 / links + (links - i + 1) * m * g / k, 1e-9);
  }
  EXPECT_NEAR(positions(0, 2) - positions(links, 2), 1.0 + m * g * links * (links + 1) / (2.0 * k), 1e-8);
  EXPECT_LT(positions.col(0).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Settle, LeavesTheChainThatStandsUpright)
{
  // Balanced on its hook, every link compressed, without a force to the side: a saddle.
  const ClothModel model = make_sheet(chain(6, 200.0, 0.01));
  Vectors positions = -model.rest_positions;
  const Pins pins = held(model, { 0 });
  ASSERT_TRUE(settle(model, pins, gravity, 0.0, tolerance, positions).converged);
  for (int i = 1; i <= 5; ++i)
  {
    EXPECT_NEAR(positions(i - 1, 2) - positions(i, 2), 0.2 + (6 - i) * 0.01 * g / 200.0, 1e-8);
  }
}

/// The elastic catenary of links of equal nodes, held level at both ends: the force (H, V_i) in link i, V_i = V_0 - i m
/// g, V_0 half of the hanging weight; l_i = l0 + T_i/k. H by bisection, so that sum l_i H/T_i is the span.
std::vector<Eigen::Vector2d> elastic_catenary(int links, double k, double m, double rest_length, double span)
{
  const auto link = [&](int i, double horizontal) {
    const double vertical = (0.5 * (links - 1) - i) * m * g;
    const double tension = std::hypot(horizontal, vertical);
    return Eigen::Vector2d((rest_length + tension / k) / tension * Eigen::Vector2d(horizontal, -vertical));
  };
  double low = 1e-9;
  double high = 1e4;
  for (int halving = 0; halving < 200; ++halving)
  {
    const double middle = std::sqrt(low * high);
    double width = 0.0;
    for (int i = 0; i < links; ++i)
    {
      width += link(i, middle).x();
    }
    (width < span ? low : high) = middle;
  }
  std::vector<Eigen::Vector2d> nodes{ Eigen::Vector2d::Zero() };
  for (int i = 0; i < links; ++i)
  {
    nodes.push_back(nodes.back() + link(i, low));
  }
  return nodes;
}

/// A chain of 17 nodes across, its ends `span` apart, sagging in a parabola; rest length 1 m.
struct LevelChain
{
  explicit LevelChain(double span, double k = 300.0, double m = 0.02)
  {
    SheetProperties sheet = chain(17, k, m);
    std::swap(sheet.rows, sheet.cols);
    std::swap(sheet.width, sheet.height);
    model = make_sheet(sheet);
    positions = model.rest_positions;
    for (int i = 0; i <= 16; ++i)
    {
      const double along = i / 16.0;
      positions.row(i) << span * (along - 0.5), 0.0, -1.2 * along * (1.0 - along);
    }
  }

  ClothModel model;
  Vectors positions;
};

TEST(Settle, HangsAChainInTheElasticCatenary)
{
  for (const double span : { 0.3, 0.7, 1.05 })
  {
    LevelChain level(span);
    ASSERT_TRUE(settle(level.model, held(level.model, { 0, 16 }), gravity, 0.0, tolerance, level.positions).converged);
    const std::vector<Eigen::Vector2d> exact = elastic_catenary(16, 300.0, 0.02, 1.0 / 16.0, span);
    for (int i = 0; i <= 16; ++i)
    {
      EXPECT_NEAR(level.positions(i, 0), exact[static_cast<size_t>(i)].x() - 0.5 * span, 1e-8) << span;
      EXPECT_NEAR(level.positions(i, 1), 0.0, 1e-8) << span;
      EXPECT_NEAR(level.positions(i, 2), exact[static_cast<size_t>(i)].y(), 1e-8) << span;
    }
  }
}

TEST(Settle, HangsASheetByItsTopRowAsThatChainColumnByColumn)
{
  SheetProperties sheet = small_sheet(7, 4);
  sheet.mass_lumping = MassLumping::uniform;
  sheet.shear.stiffness = 0.0;
  sheet.flex.stiffness = 0.0;
  const ClothModel model = make_sheet(sheet);
  Vectors positions = model.rest_positions;
  ASSERT_TRUE(settle(model, held(model, { 0, 1, 2, 3 }), gravity, 0.0, tolerance, positions).converged);
  for (int i = 4; i < model.nodes(); ++i)
  {
    const double stretched = sheet.height / 6 + (7 - i / 4) * sheet.mass / 28 * g / sheet.structural.stiffness;
    EXPECT_NEAR((positions.row(i) - positions.row(i - 4)).norm(), stretched, 1e-9);
    EXPECT_NEAR(positions(i, 0), model.rest_positions(i, 0), 1e-7);
  }
}

/// A plain Newton minimiser on a dense Hessian, written without the core's kernels.
class DenseMinimiser
{
public:
  DenseMinimiser(const ClothModel& model, const Pins& pins) : model_(model), pins_(pins)
  {
  }

  /// The largest net force on a free node that is left, N.
  double minimise(Vectors& positions)
  {
    double shift = 1.0;
    double value = assemble(positions);
    for (int iteration = 0; iteration < 2000 && gradient_.norm() > 1e-13; ++iteration)
    {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hessian_);
      const double lowest = solver.eigenvalues()[0];
      const Eigen::VectorXd curvatures = solver.eigenvalues().array() + shift + std::max(0.0, -2.0 * lowest);
      const Eigen::VectorXd step =
          -(solver.eigenvectors() * (solver.eigenvectors().transpose() * gradient_).cwiseQuotient(curvatures).eval());
      Vectors moved = positions;
      for (int i = 0; i < model_.nodes(); ++i)
      {
        moved.row(i) += step.segment<3>(3 * i).transpose();
      }
      const Eigen::VectorXd before = gradient_;
      const Eigen::MatrixXd hessian = hessian_;
      const double there = assemble(moved);
      // Close to rest the energies no longer tell, but the forces do.
      if (there < value || (there < value + 1e-13 && gradient_.norm() < before.norm()))
      {
        positions = moved;
        value = there;
        shift = std::max(1e-9, 0.2 * shift);
      }
      else
      {
        gradient_ = before;
        hessian_ = hessian;
        shift *= 5.0;
      }
    }
    return gradient_.lpNorm<Eigen::Infinity>();
  }

  /// The lowest curvature of the energy, N/m, at the positions seen last; held nodes count 1.
  double lowest_curvature() const
  {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian_).eigenvalues()[0];
  }

private:
  double assemble(const Vectors& positions)
  {
    const int size = 3 * model_.nodes();
    gradient_ = Eigen::VectorXd::Zero(size);
    hessian_ = Eigen::MatrixXd::Zero(size, size);
    double value = 0.0;
    for (int i = 0; i < model_.nodes(); ++i)
    {
      value += model_.masses[i] * g * positions(i, 2);
      gradient_[3 * i + 2] += model_.masses[i] * g;
    }
    for (const SpringBatch& batch : model_.springs)
    {
      for_each_spring(batch, [&](int i, int j) {
        const Eigen::Vector3d l = (positions.row(j) - positions.row(i)).transpose();
        const Eigen::Vector3d n = l.normalized();
        const double extension = l.norm() - batch.rest_length;
        value += 0.5 * batch.stiffness * extension * extension;
        gradient_.segment<3>(3 * j) += batch.stiffness * extension * n;
        gradient_.segment<3>(3 * i) -= batch.stiffness * extension * n;
        const Eigen::Matrix3d block =
            batch.stiffness *
            (n * n.transpose() + extension / l.norm() * (Eigen::Matrix3d::Identity() - n * n.transpose()));
        hessian_.block<3, 3>(3 * i, 3 * i) += block;
        hessian_.block<3, 3>(3 * j, 3 * j) += block;
        hessian_.block<3, 3>(3 * i, 3 * j) -= block;
        hessian_.block<3, 3>(3 * j, 3 * i) -= block;
      });
    }
    for (int i = 0; i < model_.nodes(); ++i)
    {
      if (pins_.holds(i))
      {
        gradient_.segment<3>(3 * i).setZero();
        hessian_.middleRows<3>(3 * i).setZero();
        hessian_.middleCols<3>(3 * i).setZero();
        hessian_.block<3, 3>(3 * i, 3 * i).setIdentity();
      }
    }
    return value;
  }

  const ClothModel& model_;
  const Pins& pins_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;
};

TEST(Settle, AgreesWithAnIndependentMinimiserOnADrapedSheet)
{
  // Held at its corners, drawn together and sagging: stretched enough everywhere to have one rest nearby.
  const ClothModel model = make_sheet(small_sheet(5, 6));
  Vectors positions = model.rest_positions;
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double a = model.col_of(i) / 5.0;
    const double b = model.row_of(i) / 4.0;
    positions.row(i) << 0.45 * a, 0.27 * b, -0.3 * (a * (1.0 - a) + b * (1.0 - b)) + 0.002 * a * b;
  }
  const Pins pins = held(model, { 0, 5, 24, 29 });
  Vectors reference = positions;
  const double scale = model.masses.sum() * g;
  const StaticsReport report = settle(model, pins, gravity, 0.0, tolerance, positions);
  ASSERT_TRUE(report.converged);
  EXPECT_LT(net_force(model, pins, positions), tolerance * scale);
  DenseMinimiser minimiser(model, pins);
  ASSERT_LT(minimiser.minimise(reference), 1e-10 * scale);
  EXPECT_NEAR(energy(model, positions), energy(model, reference), 1e-9 * scale);
  DenseMinimiser judge(model, pins);
  Vectors found = positions;
  ASSERT_LT(judge.minimise(found), 1e-10 * scale);
  EXPECT_LT((found - positions).cwiseAbs().maxCoeff(), 1e-5) << "what was found is no rest";
  EXPECT_GT(judge.lowest_curvature(), -1e-6) << "what was found is no minimum";
}

TEST(Settle, BucklesAFlatSheetThatIsDrawnTogetherWithoutGravity)
{
  // Flat and compressed it balances: only the curvature says that it is no rest.
  const ClothModel model = make_sheet(small_sheet(5, 6));
  Vectors positions = model.rest_positions;
  positions.col(0) *= 0.8;
  const double flat = elastic_energy(model, positions);
  Pins pins(model.nodes());
  std::vector<int> sides;
  for (int r = 0; r < 5; ++r)
  {
    sides.push_back(model.node(r, 0));
    sides.push_back(model.node(r, 5));
  }
  pins.hold(still_pin("sides", sides, positions));
  const StaticsReport report = settle(model, pins, Eigen::Vector3d::Zero(), 0.0, tolerance, positions);
  ASSERT_TRUE(report.converged);
  EXPECT_DOUBLE_EQ(report.force_scale, 80.0 * 0.1) << "the largest k l0";
  EXPECT_LT(elastic_energy(model, positions), 0.1 * flat);
  EXPECT_GT(positions.col(1).cwiseAbs().maxCoeff(), 0.05);
}

TEST(Settle, ObeysTheStrainLimitOnAHangingChain)
{
  // A link is stretched by T/k, but to no more than the limit: the rest of the load is the limit's tension.
  const double k = 20.0;
  const double m = 0.01;
  const double limit = 0.1;
  const ClothModel model = make_sheet(chain(11, k, m));
  Vectors positions = model.rest_positions;
  const StaticsReport report = settle(model, held(model, { 0 }), gravity, limit, tolerance, positions);
  ASSERT_TRUE(report.converged);
  EXPECT_LE(report.excess, StrainLimit::tolerance * limit);
  int limited = 0;
  for (int i = 1; i <= 10; ++i)
  {
    const double elastic = 0.1 + (11 - i) * m * g / k;
    limited += elastic > 0.11 ? 1 : 0;
    EXPECT_NEAR(length_of_link(positions, i), std::min(elastic, 0.11), StrainLimit::tolerance * limit * 0.1);
  }
  EXPECT_EQ(limited, 8);
}

TEST(Settle, BalancesASheetWithTheTensionsOfTheLimit)
{
  const double limit = 0.015;
  const ClothModel model = make_sheet(small_sheet(7, 8));
  Vectors positions = model.rest_positions;
  positions.col(0) *= 0.9;
  for (int i = 0; i < model.nodes(); ++i)
  {
    positions(i, 1) += 0.01 * std::sin(3.0 * i);
  }
  Pins pins(model.nodes());
  pins.hold(still_pin("corners", { 0, 7 }, positions));
  Vectors unlimited = positions;
  const StaticsReport report = settle(model, pins, gravity, limit, tolerance, positions);
  ASSERT_TRUE(report.converged);
  EXPECT_LE(max_strain(model, positions), limit * (1.0 + StrainLimit::tolerance));
  ASSERT_TRUE(settle(model, pins, gravity, 0.0, tolerance, unlimited).converged);
  EXPECT_GT(max_strain(model, unlimited), 1.5 * limit) << "the limit does nothing";

  // The tensions that balance the rest best, by least squares over the springs at the limit.
  std::vector<std::pair<int, int>> limited;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      const double strain = (positions.row(j) - positions.row(i)).norm() / batch.rest_length - 1.0;
      if (batch.kind != SpringKind::flex && strain > limit * (1.0 - StrainLimit::tolerance))
      {
        limited.push_back({ i, j });
      }
    });
  }
  ASSERT_GE(limited.size(), 2u);
  Vectors forces = Vectors::Zero(model.nodes(), 3);
  add_gravity(model, gravity, forces);
  add_spring_forces(model, positions, Vectors::Zero(model.nodes(), 3), forces);
  pins.clear_held(forces);
  Eigen::MatrixXd pulls(3 * model.nodes(), static_cast<Eigen::Index>(limited.size()));
  for (size_t s = 0; s < limited.size(); ++s)
  {
    const auto [i, j] = limited[s];
    Vectors pull = Vectors::Zero(model.nodes(), 3);
    pull.row(i) = (positions.row(j) - positions.row(i)).normalized();
    pull.row(j) = -pull.row(i);
    pins.clear_held(pull);
    pulls.col(static_cast<Eigen::Index>(s)) = pull.reshaped();
  }
  const Eigen::VectorXd tensions = pulls.completeOrthogonalDecomposition().solve(-forces.reshaped());
  const double left = (pulls * tensions + forces.reshaped()).lpNorm<Eigen::Infinity>();
  EXPECT_GT(forces.cwiseAbs().maxCoeff(), 1e-3 * report.force_scale) << "the limit carries nothing";
  EXPECT_LT(left, 2.0 * tolerance * report.force_scale);
  EXPECT_GT(tensions.minCoeff(), -1e-4 * report.force_scale) << "the limit pushes";
}

TEST(Settle, SaysWhenThereIsNoRest)
{
  const ClothModel model = make_sheet(small_sheet(3, 3));
  Vectors falling = model.rest_positions;
  EXPECT_FALSE(settle(model, Pins(model.nodes()), gravity, 0.0, tolerance, falling).converged);
  // Pins farther apart than the limit allows.
  Vectors torn = 1.5 * model.rest_positions;
  Pins pins(model.nodes());
  pins.hold(still_pin("corners", { 0, 2 }, torn));
  const StaticsReport report = settle(model, pins, gravity, 0.1, tolerance, torn);
  EXPECT_FALSE(report.converged);
  EXPECT_GT(report.excess, 0.1);
}

TEST(Settle, DoesNotMoveHeldNodesNorWhatIsAtRest)
{
  const ClothModel model = make_sheet(small_sheet());
  Vectors positions = model.rest_positions;
  const StaticsReport report = settle(model, held(model, { 0, 5 }), Eigen::Vector3d::Zero(), 0.0, tolerance, positions);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(positions, model.rest_positions);
}

/// What becomes of a settled scene in a second of still air.
struct Second
{
  explicit Second(const SceneParams& scene)
  {
    Simulation simulation = build_simulation(make_plan(scene));
    const Vectors before = simulation.state().positions;
    for (int sample = 1; sample <= 20; ++sample)
    {
      simulation.advance_to(0.05 * sample);
      moved = std::max(moved, (simulation.state().positions - before).rowwise().norm().maxCoeff());
      kinetic = std::max(kinetic, energies_of(simulation.dynamics(), simulation.state()).kinetic);
    }
  }

  double moved = 0.0;    ///< m
  double kinetic = 0.0;  ///< J
};

SceneParams settled_scene(double max_strain)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = 16;
  scene.sheet.cols = 16;
  scene.start.shape = "settled";
  scene.strain_limit.max_strain = max_strain;
  return scene;
}

TEST(SettledStart, StaysAtRest)
{
  const Second second(settled_scene(0.0));
  EXPECT_LT(second.moved, 1e-5);
  EXPECT_LT(second.kinetic, 1e-10);
}

TEST(SettledStart, StaysNearRestUnderTheStrainLimit)
{
  // The limit lets every step fall a little before it pulls back: about M (g h)^2/2 is always there.
  const Second second(settled_scene(0.1));
  EXPECT_LT(second.moved, 1e-3);
  EXPECT_LT(second.kinetic, 2e-5);
}

}  // namespace
}  // namespace cloth
