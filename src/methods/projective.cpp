#include <cmath>
#include <vector>

#include <Eigen/Sparse>

#include "cloth_sim/model/part_calls.h"

#include "rows.h"

namespace cloth
{
namespace
{

/// The matrix of the global step over the free nodes, A = M + h C + h^2 L, one unknown a node: L is the Laplacian of
/// the springs weighted by their stiffness; C has the dampings, of the springs and of the air, as if they acted in
/// every direction. Factorised once for a step length, a set of pinned nodes and the springs and air as they are.
class GlobalMatrix
{
public:
  void prepare(const Dynamics& dynamics, double h)
  {
    Key key = key_of(dynamics, h);
    if (!(key == key_))
    {
      factorise(dynamics, h);
      key_ = std::move(key);
    }
  }

  /// Solves A x = b for the free nodes' rows of b; those of pinned nodes become zero.
  void solve(const Vectors& b, Vectors& x)
  {
    packed_.resize(static_cast<Eigen::Index>(free_.size()), 3);
    packed_ = b(free_, Eigen::all);
    packed_ = factors_.solve(packed_);
    x.setZero(b.rows(), 3);
    x(free_, Eigen::all) = packed_;
  }

private:
  struct Key
  {
    double h = 0.0;
    std::vector<double> coefficients;
    std::vector<bool> held;

    /// The steps of two ticks may differ by a rounding error, which is no reason for another factorisation.
    bool operator==(const Key& other) const
    {
      return std::abs(h - other.h) <= 1e-9 * h && coefficients == other.coefficients && held == other.held;
    }
  };

  static Key key_of(const Dynamics& dynamics, double h)
  {
    const ClothModel& model = dynamics.model();
    const AirProperties& air = dynamics.air().properties();
    Key key;
    key.h = h;
    key.coefficients = { air.viscous_damping, air.wind_coupling };
    for (const SpringBatch& batch : model.springs)
    {
      key.coefficients.insert(key.coefficients.end(), { batch.stiffness, batch.damping });
    }
    for (int i = 0; i < model.nodes(); ++i)
    {
      key.held.push_back(dynamics.pins().holds(i));
    }
    return key;
  }

  void factorise(const Dynamics& dynamics, double h)
  {
    const ClothModel& model = dynamics.model();
    std::vector<int> places(static_cast<size_t>(model.nodes()), -1);
    free_.clear();
    for (int i = 0; i < model.nodes(); ++i)
    {
      if (!dynamics.pins().holds(i))
      {
        places[static_cast<size_t>(i)] = static_cast<int>(free_.size());
        free_.push_back(i);
      }
    }
    std::vector<Eigen::Triplet<double>> entries;
    const double air_damping = dynamics.air().properties().viscous_damping +
                               (dynamics.air().is_coupled(model) ? dynamics.air().properties().wind_coupling : 0.0);
    for (const int i : free_)
    {
      const int place = places[static_cast<size_t>(i)];
      entries.emplace_back(place, place, model.masses[i] + h * air_damping * model.areas[i]);
    }
    for (const SpringBatch& batch : model.springs)
    {
      count_call(batch);
      const double weight = h * h * batch.stiffness + h * batch.damping;
      for_each_spring(batch, [&](int i, int j) {
        add_spring(places[static_cast<size_t>(i)], places[static_cast<size_t>(j)], weight, entries);
      });
    }
    const int size = static_cast<int>(free_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(matrix);
  }

  /// A pinned end is known: only the free one has an equation.
  static void add_spring(int i, int j, double weight, std::vector<Eigen::Triplet<double>>& entries)
  {
    if (i >= 0)
    {
      entries.emplace_back(i, i, weight);
    }
    if (j >= 0)
    {
      entries.emplace_back(j, j, weight);
    }
    if (i >= 0 && j >= 0)
    {
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(j, i, -weight);
    }
  }

  Key key_;
  std::vector<int> free_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  Vectors packed_;
};

/// Fast simulation of mass-spring systems (Liu, Bargteil, O'Brien and Kavan 2013): backward Euler by local-global
/// iterations. The local step projects every spring on its rest length, which is to say it works out its force; the
/// global step solves a system that never changes. Written, as Liu, Bouaziz and Kavan (2017) do, as the quasi-Newton
/// iteration v <- v - A^-1 r on the residual of backward Euler, r = M (v' - v) - h f(t', x', v'), so that what it
/// converges to is backward Euler, damping and wind included. The number of iterations is fixed.
class Projective : public Method
{
public:
  explicit Projective(int iterations) : iterations_(iterations)
  {
  }

  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    StepReport report;
    matrix_.prepare(dynamics, h);
    const double end = state.time + h;
    start_ = state;
    dynamics.external_forces_on_all(end, residual_);
    dynamics.accelerations_of(residual_, residual_);
    state.velocities += h * residual_;
    double first_change = 0.0;
    double last_change = 0.0;
    for (int i = 0; i < iterations_; ++i)
    {
      find_residual(dynamics, end, h, state);
      matrix_.solve(residual_, correction_);
      state.velocities -= correction_;
      last_change = correction_.norm();
      first_change = i == 0 ? last_change : first_change;
    }
    if (records())
    {
      record_last_iteration(dynamics, h);
    }
    state.positions = start_.positions + h * state.velocities;
    dynamics.pins().impose(end, state.positions, state.velocities);
    state.time = end;
    report.force_evaluations = iterations_;
    report.linear_solves = iterations_;
    report.converged = iterations_ == 1 || last_change <= largest_last_change * first_change;
    return report;
  }

private:
  /// The last iteration must change this part of what the first did at most, or the step counts as not converged.
  static constexpr double largest_last_change = 1e-2;

  void find_residual(const Dynamics& dynamics, double end, double h, ClothState& state)
  {
    state.positions = start_.positions + h * state.velocities;
    dynamics.pins().impose(end, state.positions, state.velocities);
    dynamics.forces(end, state.positions, state.velocities, forces_);
    residual_ = (state.velocities - start_.velocities).array().colwise() * dynamics.model().masses.array();
    residual_ -= h * forces_;
  }

  /// The forces that the last residual has, and what the springs of the matrix add by the correction that followed.
  void record_last_iteration(const Dynamics& dynamics, double h)
  {
    add_impulses(h, forces_);
    for (const SpringBatch& batch : dynamics.model().springs)
    {
      const double weight = h * h * batch.stiffness + h * batch.damping;
      for_each_spring(batch, [&](int i, int j) {
        impulses().row(i) -= weight * correction_.row(j);
        impulses().row(j) -= weight * correction_.row(i);
      });
    }
  }

  int iterations_;
  GlobalMatrix matrix_;
  ClothState start_;
  Vectors forces_;
  Vectors residual_;
  Vectors correction_;
};

}  // namespace

const MethodRow projective{ "projective",
                            1,
                            no_stability_limit,
                            { -1.0, 2 },
                            false,
                            false,
                            true,
                            1,
                            1,
                            "stable and too soft where the iterations are too few",
                            [](const MethodSettings& settings) -> std::unique_ptr<Method> {
                              return std::make_unique<Projective>(settings.iterations);
                            } };

}  // namespace cloth
