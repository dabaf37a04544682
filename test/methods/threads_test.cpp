#include <memory>

#include <gtest/gtest.h>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"
#include "support.h"

namespace cloth
{
namespace
{

class Threads : public testing::TestWithParam<MethodRow>
{
protected:
  /// A sheet of three stretches and a part, in the wind, after some steps; flex springs reach across two rows.
  static ClothState after_some_steps(int threads)
  {
    constexpr int rows = 25;
    constexpr int cols = 37;
    Dynamics dynamics(make_sheet(small_sheet(rows, cols)), { 0.0, 0.0, -9.81 }, { 0.3, 1.0, { 1.0, 2.0, 0.0 }, {} });
    dynamics.use_threads(threads);
    Noise noise;
    const ClothModel& model = dynamics.model();
    ClothState state;
    state.positions = model.rest_positions + 5e-4 * noise.vectors(model.nodes());
    state.velocities = 0.1 * noise.vectors(model.nodes());
    dynamics.pins().hold(still_pin("corner", { 0 }, state.positions));
    const std::unique_ptr<Method> method = make(GetParam());
    for (int s = 0; s < 5; ++s)
    {
      method->step(dynamics, 1e-4, state);
    }
    return state;
  }
};

TEST_P(Threads, DoNotChangeABit)
{
  const ClothState of_one = after_some_steps(1);
  for (const int threads : { 2, 3, 7 })
  {
    const ClothState of_many = after_some_steps(threads);
    EXPECT_EQ(of_many.positions, of_one.positions) << threads << " threads";
    EXPECT_EQ(of_many.velocities, of_one.velocities) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Threads, testing::ValuesIn(methods()), name_of_method);

}  // namespace
}  // namespace cloth
