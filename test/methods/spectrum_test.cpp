#include "cloth_sim/methods/spectrum.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "support.h"

namespace cloth
{
namespace
{

/// -df/dx or -df/dv of the springs by central differences of their forces, mass-scaled, free nodes only: no analytic
/// Jacobian is involved.
class LinearisedNetwork
{
public:
  LinearisedNetwork(const Dynamics& dynamics, const Vectors& positions)
  {
    const ClothModel& model = dynamics.model();
    for (int i = 0; i < model.nodes(); ++i)
    {
      for (int d = 0; d < 3; ++d)
      {
        if (!dynamics.pins().holds(i))
        {
          freedoms_.push_back({ i, d });
        }
      }
    }
    const Vectors at_rest = Vectors::Zero(model.nodes(), 3);
    stiffness_ = jacobian(model, [&](const Vectors& step, Vectors& forces) {
      add_spring_forces(model, positions + step, at_rest, forces);
    });
    damping_ = jacobian(
        model, [&](const Vectors& step, Vectors& forces) { add_spring_forces(model, positions, step, forces); });
  }

  double largest_stiffness() const
  {
    return largest(stiffness_);
  }

  double largest_damping() const
  {
    return largest(damping_);
  }

  /// The step at which h^2/4 K + h C reaches the eigenvalue 1: where velocity Verlet's first eigenvalue passes -1.
  double verlet_limit() const
  {
    double h = 2.0 / std::sqrt(largest_stiffness());
    for (int i = 0; i < 6; ++i)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.25 * h * h * stiffness_ + h * damping_);
      const Eigen::VectorXd mode = solver.eigenvectors().rightCols<1>();
      const double k = mode.dot(stiffness_ * mode);
      const double c = mode.dot(damping_ * mode);
      h = 2.0 / (std::sqrt(c * c + k) + c);
    }
    return h;
  }

private:
  template <typename AddForces>
  Eigen::MatrixXd jacobian(const ClothModel& model, AddForces&& add_forces) const
  {
    const Eigen::Index n = static_cast<Eigen::Index>(freedoms_.size());
    constexpr double difference = 1e-6;
    Eigen::MatrixXd matrix(n, n);
    Vectors step = Vectors::Zero(model.nodes(), 3);
    for (Eigen::Index column = 0; column < n; ++column)
    {
      const auto [node, axis] = freedoms_[static_cast<size_t>(column)];
      Vectors forwards = Vectors::Zero(model.nodes(), 3);
      Vectors backwards = forwards;
      step(node, axis) = difference;
      add_forces(step, forwards);
      step(node, axis) = -difference;
      add_forces(step, backwards);
      step(node, axis) = 0.0;
      for (Eigen::Index row = 0; row < n; ++row)
      {
        const auto [other, direction] = freedoms_[static_cast<size_t>(row)];
        matrix(row, column) = (backwards(other, direction) - forwards(other, direction)) / (2.0 * difference) /
                              std::sqrt(model.masses[node] * model.masses[other]);
      }
    }
    return 0.5 * (matrix + matrix.transpose());
  }

  static double largest(const Eigen::MatrixXd& matrix)
  {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  }

  std::vector<std::pair<int, int>> freedoms_;
  Eigen::MatrixXd stiffness_;
  Eigen::MatrixXd damping_;
};

/// A shipped scene on a grid that is small enough for a dense eigenvalue problem.
Simulation coarse(const std::string& name)
{
  SceneParams scene = shipped_scene(name);
  scene.sheet.rows = std::min(scene.sheet.rows, 11);
  scene.sheet.cols = std::min(scene.sheet.cols, 11);
  for (PinParams& pin : scene.pins)
  {
    for (std::array<int, 2>& node : pin.nodes)
    {
      node[1] = std::min(node[1], scene.sheet.cols - 1);
    }
  }
  return build_simulation(make_plan(scene));
}

class ShippedScene : public testing::TestWithParam<std::string>
{
};

TEST_P(ShippedScene, StabilityLimitIsBelowTheTrueOneByTenPercentAtMostWhereverTheSheetIs)
{
  Simulation simulation = coarse(GetParam());
  for (const double time : { 0.0, 0.2, 0.6 })
  {
    simulation.advance_to(time);
    const double truth = LinearisedNetwork(simulation.dynamics(), simulation.state().positions).verlet_limit();
    const double claimed = simulation.stability_limit();
    EXPECT_LE(claimed, truth) << "at " << time << " s";
    EXPECT_GE(claimed, 0.9 * truth) << "at " << time << " s";
  }
}

/// omega^2 by so many plain power iterations that they have converged: never above the true one.
double converged_power_iteration(const Dynamics& dynamics, const Vectors& positions)
{
  const ClothModel& model = dynamics.model();
  Noise noise;
  Vectors u = noise.vectors(model.nodes());
  dynamics.pins().clear_held(u);
  double quotient = 0.0;
  for (int i = 0; i < 1500; ++i)
  {
    Vectors product = Vectors::Zero(model.nodes(), 3);
    add_stiffness_product(model, positions, u, product);
    dynamics.pins().clear_held(product);
    quotient = u.cwiseProduct(product).sum() / (u.array().square().colwise() * model.masses.array()).sum();
    dynamics.accelerations_of(product, u);
    u.normalize();
  }
  return quotient;
}

TEST_P(ShippedScene, FrequencyOfTheWholeSheetIsNotBelowTheTrueOneAndHardlyAbove)
{
  Simulation simulation = build_simulation(make_plan(shipped_scene(GetParam())));
  for (const double time : { 0.0, 0.3 })
  {
    simulation.advance_to(time);
    const double truth = std::sqrt(converged_power_iteration(simulation.dynamics(), simulation.state().positions));
    const double claimed = spectrum_of(simulation.dynamics(), simulation.state().positions).frequency;
    EXPECT_GE(claimed, truth) << "at " << time << " s";
    EXPECT_LE(claimed, 1.03 * truth) << "at " << time << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped_scenes));

TEST(Spectrum, FrequencyOfTheChainIsThatOfItsStiffestMode)
{
  const int links = 12;
  const double k = 300.0;
  const double m = 0.02;
  const Dynamics dynamics(make_sheet(chain(links + 1, k, m)), Eigen::Vector3d::Zero(), vacuum());
  const Spectrum mode = spectrum_of(dynamics, dynamics.model().rest_positions);
  // Free ends: omega = 2 sqrt(k/m) sin(p pi / 2(links + 1)), the stiffest with p = links.
  const double exact = 2.0 * std::sqrt(k / m) * std::sin(links * M_PI / (2.0 * (links + 1)));
  EXPECT_GE(mode.frequency, exact);
  EXPECT_LE(mode.frequency, 1.02 * exact);
  EXPECT_EQ(mode.most_spring_damping, 0.0);
}

TEST(Spectrum, PinnedNodesDoNotCount)
{
  Dynamics dynamics(make_sheet(chain(2, 100.0, 0.5)), Eigen::Vector3d::Zero(), vacuum());
  dynamics.pins().hold(still_pin("end", { 0 }, dynamics.model().rest_positions));
  // One mass on one spring: omega = sqrt(k/m); the free pair would have sqrt(2 k/m).
  EXPECT_NEAR(spectrum_of(dynamics, dynamics.model().rest_positions).frequency, std::sqrt(200.0),
              0.03 * std::sqrt(200.0));
}

TEST(Spectrum, BoundByBlocksHoldsAndIsExactInsideAFlatUniformSheet)
{
  SheetProperties sheet = small_sheet(11, 11);
  sheet.width = sheet.height = 1.0;
  sheet.mass_lumping = MassLumping::uniform;
  sheet.flex = { 0.0, 0.0 };
  const Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  const Vectors& rest = dynamics.model().rest_positions;
  const double bound = spectrum_bounds(dynamics, rest).stiffness;
  EXPECT_NEAR(bound, 4.0 * (sheet.structural.stiffness + sheet.shear.stiffness) / dynamics.model().masses[0],
              1e-6 * bound);
  Noise noise;
  for (int trial = 0; trial < 5; ++trial)
  {
    const Vectors positions = rest + 0.03 * noise.vectors(dynamics.model().nodes());
    EXPECT_GE(spectrum_bounds(dynamics, positions).stiffness,
              LinearisedNetwork(dynamics, positions).largest_stiffness());
  }
}

TEST(Spectrum, BoundByBlocksIsTwiceTheLargestEigenvalueOfAnyFreeNodesBlock)
{
  const SheetProperties sheet = small_sheet(6, 90);
  Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  const ClothModel& model = dynamics.model();
  dynamics.pins().hold(still_pin("corner", { 0 }, model.rest_positions));
  Noise noise;
  // Cells are 6 mm wide: springs are stretched and compressed, one has no length.
  Vectors positions = model.rest_positions + 0.003 * noise.vectors(model.nodes());
  positions.row(101) = positions.row(100);
  std::vector<Eigen::Matrix3d> blocks(static_cast<size_t>(model.nodes()), Eigen::Matrix3d::Zero());
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      const Eigen::Vector3d l = (positions.row(j) - positions.row(i)).transpose();
      const double length = l.norm();
      const Eigen::Matrix3d along =
          length > 0.0 ? Eigen::Matrix3d(l * l.transpose() / l.squaredNorm()) : Eigen::Matrix3d::Zero();
      const double stretch = length > 0.0 ? std::max(0.0, 1.0 - batch.rest_length / length) : 1.0;
      const Eigen::Matrix3d block = batch.stiffness * (along + stretch * (Eigen::Matrix3d::Identity() - along));
      blocks[static_cast<size_t>(i)] += block;
      blocks[static_cast<size_t>(j)] += block;
    });
  }
  double largest = 0.0;
  for (int i = 1; i < model.nodes(); ++i)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(blocks[static_cast<size_t>(i)]);
    largest = std::max(largest, 2.0 / model.masses[i] * solver.eigenvalues()[2]);
  }
  const double bound = spectrum_bounds(dynamics, positions).stiffness;
  EXPECT_GE(bound, largest * (1.0 - 1e-12));
  EXPECT_LE(bound, largest * (1.0 + 2e-6));
}

/// Internal damping, not stiffness, says how long steps may be. What it does to crumpled cloth is far from its bound.
TEST(Spectrum, StabilityLimitOfAHeavilyDampedSheetIsBelowTheTrueOneByFivePercentAtMost)
{
  SheetProperties sheet = small_sheet(10, 9);
  sheet.structural.damping = 1.0;
  sheet.shear.damping = 0.2;
  Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  dynamics.pins().hold(still_pin("corner", { 0 }, dynamics.model().rest_positions));
  Noise noise;
  for (const double crumpled : { 0.0, 0.01, 0.05 })
  {
    const Vectors positions = dynamics.model().rest_positions + crumpled * noise.vectors(dynamics.model().nodes());
    const double truth = LinearisedNetwork(dynamics, positions).verlet_limit();
    const double claimed = network_stability_limit(*find_method("velocity_verlet"), spectrum_of(dynamics, positions));
    EXPECT_LE(claimed, truth) << "crumpled by " << crumpled << " m";
    EXPECT_GE(claimed, 0.95 * truth) << "crumpled by " << crumpled << " m";
  }
}

TEST(Spectrum, BoundOfTheDampingHolds)
{
  SheetProperties sheet = small_sheet(6, 7);
  sheet.structural.damping = 1.0;
  const Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  Noise noise;
  for (int trial = 0; trial < 5; ++trial)
  {
    const Vectors positions = dynamics.model().rest_positions + 0.03 * noise.vectors(dynamics.model().nodes());
    EXPECT_GE(spectrum_bounds(dynamics, positions).damping, LinearisedNetwork(dynamics, positions).largest_damping());
  }
}

TEST(Spectrum, OfAnyShapeHoldsForAllOfThem)
{
  SheetProperties sheet = small_sheet(6, 7);
  sheet.structural.damping = 1.0;
  Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  dynamics.pins().hold(still_pin("corner", { 0 }, dynamics.model().rest_positions));
  const Spectrum of_any_shape = spectrum_of_any_shape(dynamics);
  const double most_stiffness = of_any_shape.frequency * of_any_shape.frequency;
  Noise noise;
  for (const double stretch : { 0.1, 1.0, 10.0 })
  {
    const Vectors positions =
        stretch * (dynamics.model().rest_positions + 0.03 * noise.vectors(dynamics.model().nodes()));
    const LinearisedNetwork network(dynamics, positions);
    EXPECT_GE(most_stiffness, network.largest_stiffness()) << stretch;
    EXPECT_GE(of_any_shape.most_spring_damping, network.largest_damping()) << stretch;
  }
  const SpectrumBounds flat = spectrum_bounds(dynamics, dynamics.model().rest_positions);
  EXPECT_LE(most_stiffness, 2.0 * flat.stiffness);
  EXPECT_LE(of_any_shape.most_spring_damping, 2.0 * flat.damping);
}

TEST(Spectrum, NothingFreeToMoveHasNoMode)
{
  Dynamics dynamics(make_sheet(chain(2, 100.0, 0.5)), Eigen::Vector3d::Zero(), vacuum());
  dynamics.pins().hold(still_pin("both", { 0, 1 }, dynamics.model().rest_positions));
  EXPECT_EQ(spectrum_of(dynamics, dynamics.model().rest_positions).frequency, 0.0);
}

}  // namespace
}  // namespace cloth
