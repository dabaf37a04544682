// Observed orders, for every method of the table, with damping, wind and a moving pin.

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/methods/method.h"
#include "support.h"

namespace cloth
{
namespace
{

/// A sheet driven along a motion that is known, by the force m x*'' - f(x*, x*'):
/// x*(t) = 1.15 rest + A (sin(2 pi f t + phase) - sin(phase)), A smooth over the sheet. One corner is pinned to that
/// motion. The sheet is under tension throughout, so that the motion is stable.
class ManufacturedMotion : public Dynamics
{
public:
  ManufacturedMotion()
    : Dynamics(make_sheet(small_sheet()), Eigen::Vector3d::Zero(), { 0.3, 1.1, { 0.4, 2.0, 0.0 }, {} })
  {
    const ClothModel& sheet = model();
    amplitudes_.resize(sheet.nodes(), 3);
    for (int i = 0; i < sheet.nodes(); ++i)
    {
      const double a = sheet.rest_positions(i, 0) / sheet.width;
      const double b = sheet.rest_positions(i, 2) / sheet.height;
      amplitudes_.row(i) << 0.003 * std::cos(2.0 * a + b), 0.03 * std::sin(3.0 * a - b + 0.5),
          0.003 * std::sin(a * b + 1.0);
    }
    Pin corner = still_pin("corner", { 0 }, 1.15 * sheet.rest_positions);
    corner.oscillation = { amplitudes_.row(0).transpose(), frequency_, phase_ };
    pins().hold(corner);
  }

  Vectors positions_at(double time) const
  {
    return 1.15 * model().rest_positions + amplitudes_ * (std::sin(angle(time)) - std::sin(phase_));
  }
  Vectors velocities_at(double time) const
  {
    return amplitudes_ * (turns() * std::cos(angle(time)));
  }

  void external_forces(double time, NodeRange nodes, Vectors& external) const override
  {
    const Vectors x = positions_at(time);
    const Vectors v = velocities_at(time);
    Vectors acting = Vectors::Zero(model().nodes(), 3);
    add_spring_forces(model(), x, v, acting);
    air().add_forces(model(), time, x, v, acting);
    const Vectors accelerations = amplitudes_ * (-turns() * turns() * std::sin(angle(time)));
    const Vectors all = (accelerations.array().colwise() * model().masses.array()).matrix() - acting;
    external.middleRows(nodes.begin, nodes.size()) = all.middleRows(nodes.begin, nodes.size());
  }

private:
  double turns() const
  {
    return 2.0 * M_PI * frequency_;
  }
  double angle(double time) const
  {
    return turns() * time + phase_;
  }

  const double frequency_ = 4.0;
  const double phase_ = 0.4;
  Vectors amplitudes_;
};

/// The states at the ends of equal parts of the way: an error at one time alone may be small by chance.
constexpr int parts = 20;

std::vector<ClothState> integrate(const MethodRow& row, const Dynamics& dynamics, ClothState state, double end,
                                  int steps)
{
  const std::unique_ptr<Method> method = make(row);
  std::vector<ClothState> samples;
  for (int s = 1; s <= steps; ++s)
  {
    method->step(dynamics, end / steps, state);
    if (s % (steps / parts) == 0)
    {
      samples.push_back(state);
    }
  }
  return samples;
}

double squared_distance(const ClothState& state, const Vectors& positions, const Vectors& velocities)
{
  return (state.positions - positions).squaredNorm() + 1e-4 * (state.velocities - velocities).squaredNorm();
}

/// Expects that the error falls with the claimed order from each of the step counts to the next, twice as many.
template <typename Error>
void expect_order(const MethodRow& row, int fewest, Error&& error_of)
{
  double coarser = error_of(fewest);
  for (int doubling = 1; doubling <= 3; ++doubling)
  {
    const int steps = fewest << doubling;
    const double finer = error_of(steps);
    EXPECT_NEAR(std::log2(coarser / finer), row.order, 0.1)
        << row.name << ", " << steps << " steps: errors " << coarser << " and " << finer;
    coarser = finer;
  }
}

class Order : public testing::TestWithParam<MethodRow>
{
};

INSTANTIATE_TEST_SUITE_P(Methods, Order, testing::ValuesIn(methods()), name_of_method);

TEST_P(Order, IsTheClaimedOneOnAManufacturedMotion)
{
  const ManufacturedMotion dynamics;
  const double end = 0.4;
  const ClothState start{ dynamics.positions_at(0.0), dynamics.velocities_at(0.0), 0.0 };
  expect_order(GetParam(),
               GetParam().order == 1 ? 6000 :
               GetParam().order > 4  ? 300 :
                                       600,
               [&](int steps) {
                 double sum = 0.0;
                 for (const ClothState& state : integrate(GetParam(), dynamics, start, end, steps))
                 {
                   sum +=
                       squared_distance(state, dynamics.positions_at(state.time), dynamics.velocities_at(state.time));
                 }
                 return std::sqrt(sum / parts);
               });
}

TEST_P(Order, IsTheClaimedOneOnASheetInWind)
{
  Dynamics dynamics(make_sheet(small_sheet()), { 0.0, 0.0, -9.81 }, { 0.3, 1.1, { 0.4, 2.0, 0.0 }, {} });
  const double end = 0.25;
  StartParams shape;
  shape.ripple = 0.01;
  shape.position.setZero();
  ClothState start = start_state(shape, dynamics.model());
  Pin left = still_pin("left", { 0 }, start.positions);
  left.oscillation = { { 0.02, 0.0, 0.01 }, 2.0, 0.3 };
  dynamics.pins().hold(left);
  dynamics.pins().hold(still_pin("right", { 5 }, start.positions));
  dynamics.pins().impose(0.0, start.positions, start.velocities);
  const std::vector<ClothState> reference = integrate(*find_method("rk4"), dynamics, start, end, 32000);
  expect_order(GetParam(),
               GetParam().order == 1 ? 4160 :
               GetParam().order > 4  ? 440 :
                                       520,
               [&](int steps) {
                 const std::vector<ClothState> states = integrate(GetParam(), dynamics, start, end, steps);
                 double sum = 0.0;
                 for (int p = 0; p < parts; ++p)
                 {
                   const size_t part = static_cast<size_t>(p);
                   sum += squared_distance(states[part], reference[part].positions, reference[part].velocities);
                 }
                 return std::sqrt(sum / parts);
               });
}

}  // namespace
}  // namespace cloth
