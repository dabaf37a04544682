// How long a step may be, measured and predicted, for every method of the table and a range of damping ratios: one mass
// on one spring along its axis, damped by the spring.

#include "measured_stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cloth_sim/methods/method.h"

namespace cloth
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A mass of 1 kg that swings at omega = 1 rad/s below a pinned node, so that a step of length z has z = omega h.
class Oscillator
{
public:
  Oscillator(const MethodRow& row, double damping_ratio)
    : dynamics_(make_sheet(sheet(damping_ratio)), Eigen::Vector3d::Zero(), { 0.0, 0.0, Eigen::Vector3d::Zero() })
    , method_(row.make(one_step_a_call()))
  {
    const Vectors& rest = dynamics_.model().rest_positions;
    dynamics_.pins().hold({ "top", { 0 }, rest.topRows(1), {}, {} });
    state_.positions = rest;
    state_.positions(1, 2) -= start;
    state_.velocities = Vectors::Zero(2, 3);
  }

  void step(double z)
  {
    method_->step(dynamics_, z, state_);
  }

  /// x^2 + (v/omega)^2 in parts of what it was at the start.
  double squared_amplitude() const
  {
    const double displacement = dynamics_.model().rest_positions(1, 2) - state_.positions(1, 2);
    const double velocity = state_.velocities(1, 2);
    return (displacement * displacement + velocity * velocity) / (start * start);
  }

private:
  // The spring is 1 m long: a swing that has grown a thousandfold has not turned it over, and is linear. Nor does
  // Newton's method begin beyond the pin in the longest step: in tr_bdf2 it begins (0.29 z)^2 of the swing away.
  static constexpr double start = 1e-5;

  static SheetProperties sheet(double damping_ratio)
  {
    SheetProperties properties;
    properties.rows = 2;
    properties.cols = 1;
    properties.mass = 2.0;
    properties.structural = { 1.0, 2.0 * damping_ratio };
    properties.shear = { 0.0, 0.0 };
    properties.flex = { 0.0, 0.0 };
    return properties;
  }

  /// Every step is taken as it is given. The problem is linear: one iteration solves it.
  static MethodSettings one_step_a_call()
  {
    MethodSettings settings;
    settings.tolerance = infinity;
    settings.iterations = 1;
    return settings;
  }

  Dynamics dynamics_;
  std::unique_ptr<Method> method_;
  ClothState state_;
};

/// Two windows of this many steps each are compared.
constexpr int window = 10000;

/// The mean of the squared amplitude over the window that begins now. Its weights, sin^4, fade the window in and out,
/// so that it does not matter at which part of a swing it begins and ends.
double mean_over_window(Oscillator& oscillator, double z, double most, double least)
{
  double sum = 0.0;
  double weights = 0.0;
  for (int s = 0; s < window; ++s)
  {
    const double squared = oscillator.squared_amplitude();
    if (!(squared < most) || squared < least)
    {
      return squared;
    }
    const double weight = std::pow(std::sin(M_PI * (s + 0.5) / window), 4);
    sum += weight * squared;
    weights += weight;
    oscillator.step(z);
  }
  return sum / weights;
}

/// Whether steps of length z make the swing grow: a thousandfold in two windows, or, where growth is slower, by more
/// than 1e-8 a step from the first window to the second. Growth by less than a thousandfold at first is no sign of
/// anything: where the two eigenvalues of a step are equal, a swing that decays may well grow a hundredfold before.
/// Swings that neither grow nor decay differ by 1e-10 a step, and the slowest growth that there is, that of dopri5
/// undamped, is 1e-6 a step at 0.2 % beyond its limit.
bool grows(const MethodRow& row, double damping_ratio, double z)
{
  constexpr double most = 1e6;
  constexpr double least = 1e-12;
  constexpr double slowest_growth = 1e-8;
  Oscillator oscillator(row, damping_ratio);
  const double first = mean_over_window(oscillator, z, most, least);
  if (!(first < most) || first < least)
  {
    return !(first < most);
  }
  const double second = mean_over_window(oscillator, z, most, least);
  return !(0.5 * std::log(second / first) / window <= slowest_growth);
}

/// Where growth begins on the way up from the shortest step, by bisection to 1e-4 of it; infinite: nowhere; 0: even the
/// shortest step grows.
double measured_limit(const MethodRow& row, double damping_ratio)
{
  constexpr double shortest = 0.03;
  constexpr double longest = 1e3;
  double stable = 0.0;
  double growing = shortest;
  while (!grows(row, damping_ratio, growing))
  {
    if (growing == longest)
    {
      return infinity;
    }
    stable = growing;
    // The explicit methods have their limits below 5; for the others every stride is one probe more.
    growing = std::min(longest, (growing < 5.0 ? 1.05 : 1.5) * growing);
  }
  if (stable == 0.0)
  {
    return 0.0;
  }
  while (growing - stable > 1e-4 * stable)
  {
    const double middle = 0.5 * (stable + growing);
    (grows(row, damping_ratio, middle) ? growing : stable) = middle;
  }
  return stable;
}

const std::vector<double>& damping_ratios()
{
  static const std::vector<double> ratios{ 0.0,  0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.25, 0.3,
                                           0.35, 0.4,  0.45, 0.5,  0.55, 0.6, 0.7,  0.8, 0.9,  1.0,
                                           1.01, 1.03, 1.06, 1.1,  1.2,  1.4, 1.6,  1.8, 2.0 };
  return ratios;
}

std::string text(double number)
{
  return std::isinf(number) ? ".inf" : std::to_string(number);
}

}  // namespace

void write_stability_map(std::ostream& output)
{
  output << "method,zeta,measured,predicted,ratio\n";
  for (const MethodRow& row : methods())
  {
    for (const double ratio : damping_ratios())
    {
      const double measured = measured_limit(row, ratio);
      const double predicted = row.stability_limit({ 1.0, 0.0, 2.0 * ratio });
      const bool is_comparable = std::isfinite(predicted) && predicted > 0.0;
      output << row.name << ',' << text(ratio) << ',' << text(measured) << ',' << text(predicted) << ','
             << (is_comparable ? text(measured / predicted) : "") << std::endl;
    }
  }
}

}  // namespace cloth
