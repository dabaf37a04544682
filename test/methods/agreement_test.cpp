// Every method of the table against an independent solver: CVODE of SUNDIALS, on the same right-hand side.

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <cvode/cvode.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "cloth_sim/methods/method.h"
#include "support.h"

namespace cloth
{
namespace
{

/// A rippled sheet under gravity in wind, damped by springs and air, with one corner held and one swung.
class Scene
{
public:
  static constexpr int samples = 5;
  static constexpr double end = 0.1;  // s

  Scene() : dynamics_(make_sheet(small_sheet()), { 0.0, 0.0, -9.81 }, { 0.3, 1.1, { 0.4, 2.0, 0.0 }, {} })
  {
    StartParams shape;
    shape.ripple = 0.01;
    shape.position.setZero();
    start_ = start_state(shape, dynamics_.model());
    Pin left = still_pin("left", { 0 }, start_.positions);
    left.oscillation = { { 0.02, 0.0, 0.01 }, 2.0, 0.3 };
    dynamics_.pins().hold(left);
    dynamics_.pins().hold(still_pin("right", { 5 }, start_.positions));
    dynamics_.pins().impose(0.0, start_.positions, start_.velocities);
  }

  const Dynamics& dynamics() const
  {
    return dynamics_;
  }
  const ClothState& start() const
  {
    return start_;
  }
  static double time_of(int sample)
  {
    return end * (sample + 1) / samples;
  }

private:
  Dynamics dynamics_;
  ClothState start_;
};

/// The positions at the sampled times.
using Trajectory = std::vector<Vectors>;

/// The largest distance of a node from where it is on the other trajectory, at any of the sampled times, m.
double distance_between(const Trajectory& a, const Trajectory& b)
{
  double largest = 0.0;
  for (size_t s = 0; s < a.size(); ++s)
  {
    largest = std::max(largest, (a[s] - b[s]).rowwise().norm().maxCoeff<Eigen::PropagateNaN>());
  }
  return largest;
}

enum class Formula
{
  adams,  ///< of orders 1 to 12, by fixed-point iteration
  bdf     ///< of orders 1 to 5, by Newton's method with a dense Jacobian from differences
};

/// CVODE on (x, v)' = (v, a) of the free nodes, the pinned ones put where they are at each time that CVODE asks for.
class Cvode
{
public:
  Cvode(const Scene& scene, Formula formula) : scene_(scene), state_(scene.start())
  {
    for (int i = 0; i < scene.dynamics().model().nodes(); ++i)
    {
      if (!scene.dynamics().pins().holds(i))
      {
        free_.push_back(i);
      }
    }
    check(SUNContext_Create(nullptr, &context_));
    unknowns_ = N_VNew_Serial(static_cast<sunindextype>(6 * free_.size()), context_);
    positions_of(unknowns_) = state_.positions(free_, Eigen::all);
    velocities_of(unknowns_) = state_.velocities(free_, Eigen::all);
    memory_ = CVodeCreate(formula == Formula::adams ? CV_ADAMS : CV_BDF, context_);
    check(CVodeInit(memory_, &Cvode::slope, 0.0, unknowns_));
    check(CVodeSetUserData(memory_, this));
    check(CVodeSStolerances(memory_, tolerance, tolerance));
    check(CVodeSetMaxNumSteps(memory_, 1000000));
    formula == Formula::adams ? iterate_to_a_fixed_point() : iterate_by_newton();
  }

  ~Cvode()
  {
    CVodeFree(&memory_);
    SUNNonlinSolFree(fixed_point_);
    SUNLinSolFree(dense_);
    SUNMatDestroy(jacobian_);
    N_VDestroy(unknowns_);
    SUNContext_Free(&context_);
  }

  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  Trajectory trajectory()
  {
    Trajectory result;
    for (int s = 0; s < Scene::samples; ++s)
    {
      const double end = Scene::time_of(s);
      double reached = 0.0;
      // It ends a step there: nothing is interpolated.
      check(CVodeSetStopTime(memory_, end));
      check(CVode(memory_, end, unknowns_, &reached, CV_NORMAL));
      take(reached, unknowns_);
      result.push_back(state_.positions);
    }
    return result;
  }

private:
  static constexpr double tolerance = 1e-12;  // relative, and absolute in m and m/s

  using Rows = Eigen::Map<Vectors>;

  static void check(int flag)
  {
    if (flag < 0)
    {
      throw std::runtime_error("CVODE returned " + std::to_string(flag));
    }
  }

  static Rows positions_of(N_Vector y)
  {
    return Rows(N_VGetArrayPointer(y), N_VGetLength(y) / 6, 3);
  }
  static Rows velocities_of(N_Vector y)
  {
    return Rows(N_VGetArrayPointer(y) + N_VGetLength(y) / 2, N_VGetLength(y) / 6, 3);
  }

  void iterate_to_a_fixed_point()
  {
    fixed_point_ = SUNNonlinSol_FixedPoint(unknowns_, 0, context_);
    check(CVodeSetNonlinearSolver(memory_, fixed_point_));
  }

  void iterate_by_newton()
  {
    const sunindextype size = N_VGetLength(unknowns_);
    jacobian_ = SUNDenseMatrix(size, size, context_);
    dense_ = SUNLinSol_Dense(unknowns_, jacobian_, context_);
    check(CVodeSetLinearSolver(memory_, dense_, jacobian_));
  }

  static int slope(double time, N_Vector y, N_Vector derivative, void* self)
  {
    Cvode& cvode = *static_cast<Cvode*>(self);
    cvode.take(time, y);
    cvode.scene_.dynamics().accelerations(time, cvode.state_.positions, cvode.state_.velocities, cvode.accelerations_);
    positions_of(derivative) = velocities_of(y);
    velocities_of(derivative) = cvode.accelerations_(cvode.free_, Eigen::all);
    return 0;
  }

  void take(double time, N_Vector y)
  {
    state_.positions(free_, Eigen::all) = positions_of(y);
    state_.velocities(free_, Eigen::all) = velocities_of(y);
    scene_.dynamics().pins().impose(time, state_.positions, state_.velocities);
  }

  const Scene& scene_;
  std::vector<int> free_;
  ClothState state_;
  Vectors accelerations_;
  SUNContext context_ = nullptr;
  N_Vector unknowns_ = nullptr;
  void* memory_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  SUNMatrix jacobian_ = nullptr;
  SUNLinearSolver dense_ = nullptr;
};

Trajectory trajectory_by_cvode(Formula formula)
{
  const Scene scene;
  return Cvode(scene, formula).trajectory();
}

const Trajectory& reference()
{
  static const Trajectory trajectory = trajectory_by_cvode(Formula::adams);
  return trajectory;
}

/// In equal steps; a multiple of the number of samples.
Trajectory trajectory_of(const MethodRow& row, int steps)
{
  const Scene scene;
  const std::unique_ptr<Method> method = make(row);
  ClothState state = scene.start();
  Trajectory result;
  for (int s = 1; s <= steps; ++s)
  {
    method->step(scene.dynamics(), Scene::end / steps, state);
    if (s % (steps / Scene::samples) == 0)
    {
      result.push_back(state.positions);
    }
  }
  return result;
}

/// In steps of the method's own choice.
Trajectory adaptive_trajectory_of(const MethodRow& row, double tolerance)
{
  const Scene scene;
  MethodSettings settings;
  settings.tolerance = tolerance;
  const std::unique_ptr<Method> method = row.make(settings);
  ClothState state = scene.start();
  Trajectory result;
  for (int sample = 0; sample < Scene::samples; ++sample)
  {
    const double end = Scene::time_of(sample);
    while (state.time < end - 1e-14)
    {
      method->step(scene.dynamics(), end - state.time, state);
    }
    result.push_back(state.positions);
  }
  return result;
}

/// Richardson's extrapolation of two trajectories with errors of order 1, `finer` in steps half as long.
Trajectory extrapolated(const Trajectory& coarser, const Trajectory& finer)
{
  Trajectory result;
  for (size_t s = 0; s < finer.size(); ++s)
  {
    result.push_back(2.0 * finer[s] - coarser[s]);
  }
  return result;
}

/// With twice as many the error is still far above rounding, and below a micrometre.
int fewer_steps(const MethodRow& row)
{
  return row.order == 1 ? 4000 : row.order == 2 ? 1000 : 250;
}

class Agreement : public testing::TestWithParam<MethodRow>
{
};

INSTANTIATE_TEST_SUITE_P(Methods, Agreement, testing::ValuesIn(methods()), name_of_method);

TEST_P(Agreement, WithCvodeIsReachedAtTheClaimedOrderAndWithinAMicrometre)
{
  const int steps = fewer_steps(GetParam());
  const Trajectory coarser = trajectory_of(GetParam(), steps);
  const Trajectory finer = trajectory_of(GetParam(), 2 * steps);
  const double coarser_error = distance_between(coarser, reference());
  const double finer_error = distance_between(finer, reference());
  EXPECT_NEAR(std::log2(coarser_error / finer_error), GetParam().order, 0.1)
      << "errors " << coarser_error << " and " << finer_error;
  // A method of order 1 would need some 1e5 steps; its error is taken off instead.
  const bool is_extrapolated = GetParam().order == 1;
  EXPECT_LT(is_extrapolated ? distance_between(extrapolated(coarser, finer), reference()) : finer_error, 1e-6);
}

TEST(AgreementOfDopri5, WithCvodeAtATightToleranceIsWithinANanometre)
{
  EXPECT_LT(distance_between(adaptive_trajectory_of(*find_method("dopri5"), 1e-12), reference()), 1e-9);
}

TEST(AgreementOfCvode, WithItselfByAnotherFormulaIsCloserThanAllThatIsAskedOfOthers)
{
  EXPECT_LT(distance_between(trajectory_by_cvode(Formula::bdf), reference()), 1e-10);
}

}  // namespace
}  // namespace cloth
