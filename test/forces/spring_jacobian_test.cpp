#include "cloth_sim/forces/spring_jacobian.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "support.h"

namespace cloth
{
namespace
{

class CrumpledSheet : public testing::Test
{
protected:
  CrumpledSheet()
  {
    Noise noise;
    positions_ = 0.9 * model_.rest_positions + 0.02 * noise.vectors(model_.nodes());
    u_ = noise.vectors(model_.nodes());
    unlimited_ = Eigen::ArrayXd::Constant(model_.nodes(), std::numeric_limits<double>::infinity());
  }

  /// (f(1) - f(-1))/2 h for forces as a function of a small step along u.
  template <typename Forces>
  Vectors difference(double h, Forces&& forces) const
  {
    Vectors ahead = Vectors::Zero(model_.nodes(), 3);
    Vectors behind = ahead;
    forces(h * u_, ahead);
    forces(-h * u_, behind);
    return (ahead - behind) / (2.0 * h);
  }

  Vectors product(double stiffness_factor, double damping_factor, const Eigen::ArrayXd& capacities,
                  const Vectors& vectors) const
  {
    SpringJacobian jacobian;
    jacobian.linearise(model_, positions_, stiffness_factor, damping_factor, capacities);
    Vectors result = Vectors::Zero(model_.nodes(), 3);
    jacobian.add_product(vectors, result);
    return result;
  }

  /// The whole matrix, diag(capacities) + P.
  Eigen::MatrixXd matrix(const Eigen::ArrayXd& capacities) const
  {
    const int n = 3 * model_.nodes();
    Eigen::MatrixXd columns(n, n);
    for (int c = 0; c < n; ++c)
    {
      Vectors unit = Vectors::Zero(model_.nodes(), 3);
      unit.data()[c] = 1.0;
      const Vectors column = product(1.0, 0.0, capacities, unit);
      columns.col(c) = Eigen::Map<const Eigen::VectorXd>(column.data(), n);
      columns(c, c) += capacities[c % model_.nodes()];
    }
    return columns;
  }

  const ClothModel model_ = make_sheet(small_sheet());
  Vectors positions_;
  Vectors u_;
  Eigen::ArrayXd unlimited_;
};

TEST_F(CrumpledSheet, HasTheElasticForcesDerivativeByThePositions)
{
  const Vectors at_rest = Vectors::Zero(model_.nodes(), 3);
  const Vectors derivative = difference(1e-6, [&](const Vectors& step, Vectors& forces) {
    add_spring_forces(model_, positions_ + step, at_rest, forces);
  });
  EXPECT_LT((product(1.0, 0.0, unlimited_, u_) + derivative).norm(), 1e-7 * derivative.norm());
  EXPECT_LT((product(0.3, 0.0, unlimited_, u_) + 0.3 * derivative).norm(), 1e-7 * derivative.norm());
}

TEST_F(CrumpledSheet, HasTheDampingForcesDerivativeByTheVelocities)
{
  const Vectors derivative = difference(
      1.0, [&](const Vectors& step, Vectors& forces) { add_spring_forces(model_, positions_, step, forces); });
  // The factor of K is small and not zero: both parts share the spring's direction.
  const Vectors elastic = product(1e-6, 0.0, unlimited_, u_);
  EXPECT_LT((product(1e-6, 1.0, unlimited_, u_) - elastic + derivative).norm(), 1e-12 * derivative.norm());
}

TEST_F(CrumpledSheet, IsIndefiniteUntilItIsCutToWhatTheCapacitiesCarry)
{
  const auto smallest = [](const Eigen::MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
  };
  const Eigen::ArrayXd generous = Eigen::ArrayXd::Constant(model_.nodes(), 1e6);
  const double most_negative = smallest(matrix(generous)) - 1e6;
  EXPECT_LT(most_negative, -10.0);
  for (const double capacity : { 0.0, 1.0, 30.0 })
  {
    EXPECT_GT(smallest(matrix(Eigen::ArrayXd::Constant(model_.nodes(), capacity))), -1e-10) << capacity;
  }
}

TEST_F(CrumpledSheet, KeepsTheWholeMatrixWhereTheCapacitiesSuffice)
{
  const Eigen::ArrayXd generous = Eigen::ArrayXd::Constant(model_.nodes(), 1e6);
  EXPECT_EQ(product(1.0, 0.1, generous, u_), product(1.0, 0.1, unlimited_, u_));
  const Eigen::ArrayXd scarce = Eigen::ArrayXd::Constant(model_.nodes(), 1.0);
  EXPECT_NE(product(1.0, 0.1, scarce, u_), product(1.0, 0.1, unlimited_, u_));
}

TEST_F(CrumpledSheet, MovesNothingWhenAllNodesMoveAlike)
{
  const Vectors alike = Eigen::RowVector3d(0.3, -1.0, 0.2).replicate(model_.nodes(), 1);
  EXPECT_TRUE(product(1.0, 0.1, unlimited_, alike).isZero(1e-13));
}

}  // namespace
}  // namespace cloth
