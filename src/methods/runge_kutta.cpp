#include "runge_kutta.h"

#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace cloth
{

RungeKuttaStages::RungeKuttaStages(Tableau tableau) : tableau_(std::move(tableau)), slopes_(tableau_.times.size())
{
}

void RungeKuttaStages::work_out(const Dynamics& dynamics, double h, const ClothState& state, bool first_is_known)
{
  for (size_t i = first_is_known ? 1 : 0; i < slopes_.size(); ++i)
  {
    stage_ = state;
    stage_.time = state.time + tableau_.times[i] * h;
    add_weighted(h, tableau_.stages[i], stage_.positions, stage_.velocities);
    dynamics.pins().impose(stage_.time, stage_.positions, stage_.velocities);
    dynamics.forces(stage_.time, stage_.positions, stage_.velocities, slopes_[i].acceleration);
    dynamics.unheld_accelerations_of(slopes_[i].acceleration, slopes_[i].acceleration);
    slopes_[i].velocity = stage_.velocities;
  }
}

ClothState RungeKuttaStages::advanced(const Dynamics& dynamics, double h, const ClothState& state) const
{
  ClothState end = state;
  end.time += h;
  add_weighted(h, tableau_.weights, end.positions, end.velocities);
  dynamics.pins().impose(end.time, end.positions, end.velocities);
  return end;
}

void RungeKuttaStages::add_weighted(double h, const std::vector<double>& weights, Vectors& positions,
                                    Vectors& velocities) const
{
  for (size_t i = 0; i < weights.size(); ++i)
  {
    if (weights[i] != 0.0)
    {
      positions += h * weights[i] * slopes_[i].velocity;
      velocities += h * weights[i] * slopes_[i].acceleration;
    }
  }
}

void RungeKuttaStages::add_impulses(const Dynamics& dynamics, double h, Vectors& impulses) const
{
  for (size_t i = 0; i < slopes_.size(); ++i)
  {
    const Eigen::ArrayXd factors = h * tableau_.weights[i] * dynamics.model().masses.array();
    impulses.array() += slopes_[i].acceleration.array().colwise() * factors;
  }
}

void RungeKuttaStages::keep_last_as_first()
{
  std::swap(slopes_.front(), slopes_.back());
}

RungeKutta::RungeKutta(const Tableau& tableau) : stages_(tableau)
{
}

StepReport RungeKutta::step(const Dynamics& dynamics, double h, ClothState& state)
{
  stages_.work_out(dynamics, h, state);
  if (records())
  {
    stages_.add_impulses(dynamics, h, impulses());
  }
  state = stages_.advanced(dynamics, h, state);
  StepReport report;
  report.force_evaluations = stages_.count();
  return report;
}

namespace
{

/// The coefficients of R: 1, then b A^(k-1) 1.
std::vector<double> stability_polynomial(const Tableau& tableau)
{
  const Eigen::Index stages = static_cast<Eigen::Index>(tableau.times.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(stages, stages);
  for (Eigen::Index i = 0; i < stages; ++i)
  {
    const std::vector<double>& row = tableau.stages[static_cast<size_t>(i)];
    a.row(i).head(static_cast<Eigen::Index>(row.size())) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), row.size());
  }
  const Eigen::Map<const Eigen::VectorXd> b(tableau.weights.data(), stages);
  Eigen::VectorXd power = Eigen::VectorXd::Ones(stages);
  std::vector<double> polynomial{ 1.0 };
  for (Eigen::Index k = 0; k < stages; ++k)
  {
    polynomial.push_back(b.dot(power));
    power = a * power;
  }
  return polynomial;
}

/// (|R(s d)|^2 - 1)/s along a direction d of length 1, as a polynomial in s. The 1 is taken off before anything is
/// added up, so that growth as slow as rounding is seen for what it is.
std::vector<double> growth_along(const std::vector<double>& polynomial, std::complex<double> direction)
{
  std::vector<std::complex<double>> terms;  // of R at s = 1
  std::complex<double> power = 1.0;
  for (const double coefficient : polynomial)
  {
    terms.push_back(coefficient * power);
    power *= direction;
  }
  std::vector<double> growth(2 * polynomial.size() - 2, 0.0);
  for (size_t j = 0; j < terms.size(); ++j)
  {
    for (size_t k = 0; k < terms.size(); ++k)
    {
      if (j + k > 0)
      {
        growth[j + k - 1] += terms[j].real() * terms[k].real() + terms[j].imag() * terms[k].imag();
      }
    }
  }
  return growth;
}

double value_at(const std::vector<double>& polynomial, double s)
{
  double value = 0.0;
  for (size_t k = polynomial.size(); k-- > 0;)
  {
    value = value * s + polynomial[k];
  }
  return value;
}

/// Where growth begins, looked for in small strides up to beyond every region of such methods; infinite: nowhere.
double first_growth(const std::vector<double>& growth)
{
  constexpr double stride = 0.05;
  constexpr double farthest = 10.0;
  double inside = 0.0;
  double outside = stride;
  while (value_at(growth, outside) <= 0.0)
  {
    inside = outside;
    outside += stride;
    if (outside > farthest)
    {
      return std::numeric_limits<double>::infinity();
    }
  }
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (inside + outside);
    (value_at(growth, middle) <= 0.0 ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

double stability_limit(const Tableau& tableau, const Mode& mode)
{
  const double w = mode.frequency;
  const double d = mode.air_damping + mode.spring_damping;
  if (w == 0.0 && d == 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  // Of two real eigenvalues the larger one is met first.
  const bool is_undamped = d == 0.0;
  const std::complex<double> eigenvalue =
      is_undamped ? std::complex<double>(0.0, w) : -0.5 * d - std::sqrt(std::complex<double>(0.25 * d * d - w * w));
  const double size = std::abs(eigenvalue);
  return first_growth(growth_along(stability_polynomial(tableau), eigenvalue / size)) / size;
}

}  // namespace cloth
