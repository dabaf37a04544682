#include "cvode_solver.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <new>

#include "first_order_system.h"
#include "interval_clock.h"

namespace cloth
{
namespace
{

/// One integration and all that CVODE needs for it.
class Integration
{
public:
  Integration(const Problem& problem, CvodeSolver::Formula formula, double tolerance, const IntervalClock& clock)
    : system_(problem), clock_(clock)
  {
    SUNContext_Create(nullptr, &context_);
    unknowns_ = N_VNew_Serial(system_.size(), context_);
    const bool is_adams = formula == CvodeSolver::Formula::adams;
    memory_ = unknowns_ != nullptr ? CVodeCreate(is_adams ? CV_ADAMS : CV_BDF, context_) : nullptr;
    if (memory_ == nullptr)
    {
      throw std::bad_alloc();
    }
    system_.copy_start(N_VGetArrayPointer(unknowns_));
    CVodeInit(memory_, &Integration::slope, 0.0, unknowns_);
    CVodeSetUserData(memory_, this);
    CVodeSStolerances(memory_, tolerance, tolerance);
    CVodeSetMaxNumSteps(memory_, -1);
    CVodeSetErrHandlerFn(memory_, &Integration::say_nothing, nullptr);
    if (is_adams)
    {
      fixed_point_ = SUNNonlinSol_FixedPoint(unknowns_, 0, context_);
      CVodeSetNonlinearSolver(memory_, fixed_point_);
    }
    else
    {
      krylov_ = SUNLinSol_SPGMR(unknowns_, SUN_PREC_NONE, 0, context_);
      CVodeSetLinearSolver(memory_, krylov_, nullptr);
    }
  }

  ~Integration()
  {
    CVodeFree(&memory_);
    if (fixed_point_ != nullptr)
    {
      SUNNonlinSolFree(fixed_point_);
    }
    if (krylov_ != nullptr)
    {
      SUNLinSolFree(krylov_);
    }
    N_VDestroy(unknowns_);
    SUNContext_Free(&context_);
  }

  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  /// It ends a step there: nothing is interpolated.
  Status advance_to(double time)
  {
    CVodeSetStopTime(memory_, time);
    double reached = 0.0;
    const int flag = CVode(memory_, time, unknowns_, &reached, CV_NORMAL);
    if (flag >= 0)
    {
      return system_.has_diverged(time, N_VGetArrayPointer(unknowns_)) ? Status::unstable : Status::ok;
    }
    return out_of_time_ ? Status::too_slow : Status::not_converged;
  }

  ClothState state_at(double time) const
  {
    return system_.state_at(time, N_VGetArrayPointer(unknowns_));
  }
  double evaluations() const
  {
    return static_cast<double>(system_.evaluations());
  }
  /// Newton's iterations, each of which solves a linear system.
  double linear_solves() const
  {
    long count = 0;
    if (krylov_ != nullptr)
    {
      CVodeGetNumNonlinSolvIters(memory_, &count);
    }
    return static_cast<double>(count);
  }

private:
  static int slope(double time, N_Vector y, N_Vector slopes, void* self)
  {
    constexpr int unrecoverable = -1;
    Integration& integration = *static_cast<Integration*>(self);
    if (integration.clock_.is_up())
    {
      integration.out_of_time_ = true;
      return unrecoverable;
    }
    integration.system_.find_slopes(time, N_VGetArrayPointer(y), N_VGetArrayPointer(slopes));
    return 0;
  }

  /// What goes wrong is told by the return value.
  static void say_nothing(int, const char*, const char*, char*, void*)
  {
  }

  FirstOrderSystem system_;
  const IntervalClock& clock_;
  bool out_of_time_ = false;
  SUNContext context_ = nullptr;
  N_Vector unknowns_ = nullptr;
  void* memory_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  SUNLinearSolver krylov_ = nullptr;
};

}  // namespace

Outcome CvodeSolver::run(const Problem& problem, double value, double most_seconds) const
{
  Outcome outcome;
  IntervalClock clock(problem, most_seconds);
  Integration integration(problem, formula_, value, clock);
  for (int s = 0; s < Problem::samples && outcome.status == Status::ok; ++s)
  {
    const double end = problem.time_of(s);
    clock.time([&] { outcome.status = integration.advance_to(end); });
    outcome.samples.push_back(integration.state_at(end));
  }
  clock.report(outcome);
  outcome.force_evaluations = integration.evaluations() / problem.horizon;
  outcome.linear_solves = integration.linear_solves() / problem.horizon;
  return outcome;
}

}  // namespace cloth
