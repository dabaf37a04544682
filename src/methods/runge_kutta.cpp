#include "runge_kutta.h"

#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "node_loops.h"

namespace cloth
{

RungeKuttaStages::RungeKuttaStages(Tableau tableau) : tableau_(std::move(tableau)), slopes_(tableau_.times.size())
{
}

void RungeKuttaStages::work_out(const Dynamics& dynamics, double h, const ClothState& state, bool first_is_known)
{
  stage_positions_.resizeLike(state.positions);
  for (size_t i = first_is_known ? 1 : 0; i < slopes_.size(); ++i)
  {
    const double time = state.time + tableau_.times[i] * h;
    Vectors& stage_velocities = slopes_[i].velocity;
    stage_velocities.resizeLike(state.velocities);
    dynamics.for_each_band([&](NodeRange band) {
      stage_positions_.middleRows(band.begin, band.size()) = state.positions.middleRows(band.begin, band.size());
      stage_velocities.middleRows(band.begin, band.size()) = state.velocities.middleRows(band.begin, band.size());
    });
    add_weighted(dynamics, h, tableau_.stages[i], stage_positions_, stage_velocities);
    dynamics.pins().impose(time, stage_positions_, stage_velocities);
    dynamics.unheld_accelerations(time, stage_positions_, stage_velocities, slopes_[i].acceleration);
  }
}

void RungeKuttaStages::advance(const Dynamics& dynamics, double h, ClothState& state) const
{
  state.time += h;
  add_weighted(dynamics, h, tableau_.weights, state.positions, state.velocities);
  dynamics.pins().impose(state.time, state.positions, state.velocities);
}

void RungeKuttaStages::add_weighted(const Dynamics& dynamics, double h, const std::vector<double>& weights,
                                    Vectors& positions, Vectors& velocities) const
{
  dynamics.for_each_band([&](NodeRange band) {
    for_each_stretch(dynamics.model(), band, [&](NodeRange nodes) {
      for (size_t i = 0; i < weights.size(); ++i)
      {
        if (weights[i] != 0.0)
        {
          add_scaled(nodes, h * weights[i], slopes_[i].velocity, positions);
          add_scaled(nodes, h * weights[i], slopes_[i].acceleration, velocities);
        }
      }
    });
  });
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
  stages_.advance(dynamics, h, state);
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

StabilityRegion::StabilityRegion(const Tableau& tableau) : polynomial_(stability_polynomial(tableau))
{
}

double StabilityRegion::limit(const Mode& mode) const
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
  return first_growth(growth_along(polynomial_, eigenvalue / size)) / size;
}

}  // namespace cloth
