#include "competitors.h"

#ifdef CLOTH_BENCH_HAS_BULLET
#include "bullet_solver.h"
#endif
#ifdef CLOTH_BENCH_HAS_CVODE
#include "cvode_solver.h"
#endif
#ifdef CLOTH_BENCH_HAS_ODEINT
#include "odeint_solver.h"
#endif

namespace cloth
{

Solvers competitors()
{
  Solvers solvers;
#ifdef CLOTH_BENCH_HAS_CVODE
  solvers.push_back(std::make_unique<CvodeSolver>(CvodeSolver::Formula::adams));
  solvers.push_back(std::make_unique<CvodeSolver>(CvodeSolver::Formula::bdf));
#endif
#ifdef CLOTH_BENCH_HAS_ODEINT
  solvers.push_back(std::make_unique<OdeintSolver>(OdeintSolver::Formula::dopri5));
#endif
#ifdef CLOTH_BENCH_HAS_BULLET
  solvers.push_back(std::make_unique<BulletSolver>());
#endif
  return solvers;
}

std::unique_ptr<Solver> independent_solver()
{
#if defined(CLOTH_BENCH_HAS_ODEINT)
  return std::make_unique<OdeintSolver>(OdeintSolver::Formula::fehlberg78);
#elif defined(CLOTH_BENCH_HAS_CVODE)
  return std::make_unique<CvodeSolver>(CvodeSolver::Formula::adams);
#else
  return nullptr;
#endif
}

std::vector<std::string> left_out_competitors()
{
  std::vector<std::string> lines;
#ifndef CLOTH_BENCH_HAS_CVODE
  lines.push_back("CVODE is left out: built without SUNDIALS 6 (libsundials-dev)");
#endif
#ifndef CLOTH_BENCH_HAS_ODEINT
  lines.push_back("odeint is left out: built without Boost (libboost-dev)");
#endif
#ifndef CLOTH_BENCH_HAS_BULLET
  lines.push_back("Bullet is left out: built without it (libbullet-dev)");
#endif
  return lines;
}

}  // namespace cloth
