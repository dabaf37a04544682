// Ways to solve the system of an implicit Euler step, (M + h C + h^2 K) dv = -r, of a sheet that hangs in folds.

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Sparse>
#include <benchmark/benchmark.h>

#include "assembled_matrix.h"
#include "cloth_sim/forces/spring_jacobian.h"
#include "cloth_sim/scene/plan.h"
#include "conjugate_gradients.h"
#include "multigrid.h"

namespace cloth
{
namespace
{

using Matrix = AssembledMatrix::Matrix;
using Factors = Eigen::SimplicialLDLT<Matrix>;
using MatrixOfRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Interleaved = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The sheet of config/hanging_sheet.yaml at another resolution and without strain limit, its springs so many times as
/// strong, after a fall of 0.5 s.
Simulation folded_sheet(int nodes_a_side, int strength)
{
  SceneParams scene;
  for (SpringProperties* const kind : { &scene.sheet.structural, &scene.sheet.shear, &scene.sheet.flex })
  {
    kind->stiffness *= strength;
    kind->damping *= strength;
  }
  scene.sheet.rows = nodes_a_side;
  scene.sheet.cols = nodes_a_side;
  scene.start.initial_stretch = { 0.9, 1.0 };
  scene.start.ripple = 0.02;
  scene.strain_limit.max_strain = 0.0;
  if (strength > 1)
  {
    scene.solver.method = "xpbd";  // stable steps of explicit methods would take minutes
    scene.solver.time_step = 1e-3;
  }
  Simulation simulation = build_simulation(make_plan(scene));
  if (!simulation.advance_to(0.5))
  {
    throw std::runtime_error(simulation.divergence_report());
  }
  return simulation;
}

const Simulation& the_folded_sheet(int nodes_a_side, int strength)
{
  static std::map<std::pair<int, int>, Simulation> sheets;
  const std::pair<int, int> key{ nodes_a_side, strength };
  const auto found = sheets.find(key);
  return found != sheets.end() ? found->second :
                                 sheets.emplace(key, folded_sheet(nodes_a_side, strength)).first->second;
}

/// The system of the first Newton iteration, as the implicit methods have it.
class System
{
public:
  System(const Simulation& sheet, double step)
    : dynamics_(sheet.dynamics()), h_(step), positions_(sheet.state().positions), assembled_(dynamics_)
  {
    Vectors velocities = sheet.state().velocities;
    const double end = sheet.state().time + h_;
    positions_ += h_ * velocities;
    dynamics_.pins().impose(end, positions_, velocities);
    dynamics_.forces(end, positions_, velocities, residual_);
    residual_ *= -h_;
    dynamics_.pins().clear_held(residual_);
    choose_capacities();
    assemble();
    compare_matrices();
  }

  void linearise()
  {
    springs_.linearise(dynamics_.model(), positions_, h_ * h_, h_, capacities_);
    node_normals(dynamics_.model(), positions_, normals_);
  }

  void assemble()
  {
    node_normals(dynamics_.model(), positions_, normals_);
    assembled_.assemble(positions_, normals_, h_, capacities_);
  }

  void multiply(const Vectors& u, Vectors& product) const
  {
    const Dynamics& dynamics = dynamics_;
    product.setZero(u.rows(), 3);
    dynamics.air().add_damping_product(dynamics.model(), normals_, u, product);
    product *= h_;
    product.array() += u.array().colwise() * dynamics.model().masses.array();
    springs_.add_product(u, product);
    dynamics.pins().clear_held(product);
  }

  bool solve(ConjugateGradients& solver, double part, Vectors& x) const
  {
    const Eigen::VectorXd& masses = dynamics_.model().masses;
    return solver.solve([this](const Vectors& u, Vectors& product) { multiply(u, product); },
                        MassPreconditioner(masses), masses, residual_, part, x);
  }

  void prepare(Multigrid& multigrid) const
  {
    const ClothModel& model = dynamics_.model();
    const double damping = dynamics_.air().properties().viscous_damping;
    multigrid.prepare(model, dynamics_.pins(), model.masses.array() + h_ * damping * model.areas.array(), springs_);
  }

  bool solve(Multigrid& multigrid, ConjugateGradients& solver, double part, Vectors& x) const
  {
    return solver.solve([this](const Vectors& u, Vectors& product) { multiply(u, product); },
                        [&](const Vectors& r, Vectors& z) { multigrid.apply(r, z); }, dynamics_.model().masses,
                        residual_, part, x);
  }

  /// |A x + r| / |r|
  double relative_residual(const Vectors& x) const
  {
    Vectors product;
    multiply(x, product);
    return (product + residual_).norm() / residual_.norm();
  }

  /// The destabilising part of K had to be cut down, or the matrix would be indefinite.
  bool is_cut() const
  {
    return std::isfinite(capacities_[0]);
  }
  const Matrix& matrix() const
  {
    return assembled_.matrix();
  }
  /// The same, which is symmetric, taken by rows: its products are quicker.
  Eigen::Map<const MatrixOfRows> matrix_of_rows() const
  {
    const Matrix& columns = matrix();
    return { columns.rows(),          columns.cols(),          columns.nonZeros(),
             columns.outerIndexPtr(), columns.innerIndexPtr(), columns.valuePtr() };
  }
  const Dynamics& dynamics() const
  {
    return dynamics_;
  }
  double step() const
  {
    return h_;
  }
  const Vectors& residual() const
  {
    return residual_;
  }
  /// -r, the components of a node side by side.
  Eigen::VectorXd right_hand_side() const
  {
    const Interleaved rows = -residual_;
    return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
  }

private:
  /// As ImplicitStage does.
  void choose_capacities()
  {
    capacities_.setConstant(positions_.rows(), std::numeric_limits<double>::infinity());
    linearise();
    ConjugateGradients solver;
    Vectors x;
    if (!solve(solver, 1e-8, x))
    {
      capacities_ = 0.9 * dynamics_.model().masses.array();
      linearise();
    }
  }

  void compare_matrices() const
  {
    const Eigen::VectorXd right = right_hand_side();
    const Eigen::VectorXd assembled = matrix() * right;
    Vectors product;
    multiply(-residual_, product);
    const Interleaved rows = product;
    if (!((assembled - Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size())).norm() <= 1e-12 * product.norm()))
    {
      throw std::runtime_error("the assembled matrix is not the one that the products are of");
    }
  }

  const Dynamics& dynamics_;
  double h_;
  Vectors positions_;
  Vectors residual_;
  Vectors normals_;
  Eigen::ArrayXd capacities_;
  SpringJacobian springs_;
  AssembledMatrix assembled_;
};

/// Of the benchmark's first three arguments: nodes a side, steps a second, and how many times as strong springs are.
System& the_system(const benchmark::State& state)
{
  static std::map<std::tuple<int, int, int>, std::unique_ptr<System>> systems;
  const int nodes_a_side = static_cast<int>(state.range(0));
  const int rate = static_cast<int>(state.range(1));
  const int strength = static_cast<int>(state.range(2));
  std::unique_ptr<System>& system = systems[{ nodes_a_side, rate, strength }];
  if (!system)
  {
    system = std::make_unique<System>(the_folded_sheet(nodes_a_side, strength), 1.0 / rate);
  }
  return *system;
}

/// Of the fourth argument, the digits to which the system is solved.
double wanted_part(const benchmark::State& state)
{
  return std::pow(10.0, -static_cast<double>(state.range(3)));
}

Vectors rows_of(const Eigen::VectorXd& side_by_side)
{
  return Eigen::Map<const Interleaved>(side_by_side.data(), side_by_side.size() / 3, 3);
}

void report(benchmark::State& state, const System& system, const Vectors& x, int iterations)
{
  state.counters["residual"] = system.relative_residual(x);
  state.counters["solver_iterations"] = iterations;
  state.counters["cut"] = system.is_cut();
}

void linearise(benchmark::State& state)
{
  System& system = the_system(state);
  for (auto _ : state)
  {
    system.linearise();
  }
}

void matrix_free_solve(benchmark::State& state)
{
  const System& system = the_system(state);
  ConjugateGradients solver;
  Vectors x;
  for (auto _ : state)
  {
    system.solve(solver, wanted_part(state), x);
    benchmark::DoNotOptimize(x.data());
  }
  report(state, system, x, solver.iterations());
}

/// The preparation of the preconditioner included.
void multigrid_solve(benchmark::State& state)
{
  const System& system = the_system(state);
  ConjugateGradients solver;
  Multigrid multigrid;
  Vectors x;
  for (auto _ : state)
  {
    system.prepare(multigrid);
    system.solve(multigrid, solver, wanted_part(state), x);
    benchmark::DoNotOptimize(x.data());
  }
  report(state, system, x, solver.iterations());
}

void multigrid_prepare(benchmark::State& state)
{
  const System& system = the_system(state);
  Multigrid multigrid;
  for (auto _ : state)
  {
    system.prepare(multigrid);
  }
}

void assemble(benchmark::State& state)
{
  System& system = the_system(state);
  for (auto _ : state)
  {
    system.assemble();
  }
}

void eigen_cg_solve(benchmark::State& state)
{
  const System& system = the_system(state);
  Eigen::ConjugateGradient<MatrixOfRows, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(wanted_part(state));
  const Eigen::VectorXd right = system.right_hand_side();
  const Eigen::Map<const MatrixOfRows> matrix = system.matrix_of_rows();
  Eigen::VectorXd x;
  for (auto _ : state)
  {
    solver.compute(matrix);
    x = solver.solve(right);
    benchmark::DoNotOptimize(x.data());
  }
  report(state, system, rows_of(x), static_cast<int>(solver.iterations()));
}

void ldlt_analyse(benchmark::State& state)
{
  const System& system = the_system(state);
  for (auto _ : state)
  {
    Factors factors;
    factors.analyzePattern(system.matrix());
  }
}

void ldlt_factorise(benchmark::State& state)
{
  const System& system = the_system(state);
  Factors factors;
  factors.analyzePattern(system.matrix());
  for (auto _ : state)
  {
    factors.factorize(system.matrix());
  }
}

void ldlt_solve(benchmark::State& state)
{
  const System& system = the_system(state);
  const Factors factors(system.matrix());
  const Eigen::VectorXd right = system.right_hand_side();
  Eigen::VectorXd x;
  for (auto _ : state)
  {
    x = factors.solve(right);
    benchmark::DoNotOptimize(x.data());
  }
  report(state, system, rows_of(x), 1);
}

/// The matrix of a projective step, M + h C + h^2 L with one unknown a node, and pinned nodes with their mass alone.
Matrix projective_matrix(const System& system)
{
  const ClothModel& model = system.dynamics().model();
  const Pins& pins = system.dynamics().pins();
  const AirProperties& air = system.dynamics().air().properties();
  const double h = system.step();
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double damping = pins.holds(i) ? 0.0 : (air.viscous_damping + air.wind_coupling) * model.areas[i];
    entries.emplace_back(i, i, model.masses[i] + h * damping);
  }
  for (const SpringBatch& batch : model.springs)
  {
    const double weight = h * h * batch.stiffness + h * batch.damping;
    for_each_spring(batch, [&](int i, int j) {
      for (const auto& [row, col, value] :
           { std::tuple(i, i, weight), std::tuple(j, j, weight), std::tuple(i, j, -weight), std::tuple(j, i, -weight) })
      {
        if (!pins.holds(row) && !pins.holds(col))
        {
          entries.emplace_back(row, col, value);
        }
      }
    });
  }
  Matrix matrix(model.nodes(), model.nodes());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void projective_factorise(benchmark::State& state)
{
  const Matrix matrix = projective_matrix(the_system(state));
  for (auto _ : state)
  {
    Factors factors(matrix);
    benchmark::DoNotOptimize(factors.vectorD().data());
  }
}

void projective_solve(benchmark::State& state)
{
  const System& system = the_system(state);
  const Factors factors(projective_matrix(system));
  Vectors x;
  for (auto _ : state)
  {
    x = factors.solve(system.residual());
    benchmark::DoNotOptimize(x.data());
  }
}

/// The same system by the iteration of the projective method, dv <- dv - A^-1 (J dv + r).
void projective_iterate(benchmark::State& state)
{
  constexpr int most_iterations = 300;
  const System& system = the_system(state);
  const Factors factors(projective_matrix(system));
  const double enough = wanted_part(state) * system.residual().norm();
  Vectors x;
  Vectors left;
  int iterations = 0;
  for (auto _ : state)
  {
    x.setZero(system.residual().rows(), 3);
    left = system.residual();
    for (iterations = 0; iterations < most_iterations && left.norm() > enough; ++iterations)
    {
      x -= factors.solve(left);
      system.multiply(x, left);
      left += system.residual();
    }
  }
  report(state, system, x, iterations);
}

const std::vector<std::int64_t> sides{ 32, 64, 128 };
const std::vector<std::int64_t> rates{ 240, 60 };

void once_a_system(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "nodes_a_side", "rate", "strength" });
  benchmark->ArgsProduct({ sides, rates, { 1 } })->Unit(benchmark::kMillisecond);
}

void once_a_precision(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "nodes_a_side", "rate", "strength", "digits" });
  benchmark->ArgsProduct({ sides, rates, { 1 }, { 3, 6 } })->Unit(benchmark::kMillisecond);
}

/// Stiff sheets in the steps for which they are made.
void once_a_strength(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "nodes_a_side", "rate", "strength", "digits" });
  benchmark->ArgsProduct({ sides, { 1000, 100 }, { 10, 100, 1000 }, { 3 } })->Unit(benchmark::kMillisecond);
}

void roughly(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgNames({ "nodes_a_side", "rate", "strength", "digits" });
  benchmark->ArgsProduct({ sides, rates, { 1 }, { 3 } })->Unit(benchmark::kMillisecond);
}

BENCHMARK(linearise)->Apply(once_a_system);
BENCHMARK(matrix_free_solve)->Apply(once_a_precision);
BENCHMARK(matrix_free_solve)->Apply(once_a_strength);
BENCHMARK(multigrid_solve)->Apply(once_a_precision);
BENCHMARK(multigrid_solve)->Apply(once_a_strength);
BENCHMARK(multigrid_prepare)->Apply(once_a_system);
BENCHMARK(assemble)->Apply(once_a_system);
BENCHMARK(eigen_cg_solve)->Apply(once_a_precision);
BENCHMARK(ldlt_analyse)->Apply(once_a_system);
BENCHMARK(ldlt_factorise)->Apply(once_a_system);
BENCHMARK(ldlt_solve)->Apply(once_a_system);
BENCHMARK(projective_factorise)->Apply(once_a_system);
BENCHMARK(projective_solve)->Apply(once_a_system);
BENCHMARK(projective_iterate)->Apply(roughly);

}  // namespace
}  // namespace cloth

BENCHMARK_MAIN();
