// Steps of explicit methods take no memory from the heap. Counted where all of it comes from, malloc and its kin: what
// Eigen takes does not pass operator new.

#include <features.h>

#ifdef __GLIBC__

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"
#include "support.h"

namespace
{

std::atomic<long> allocations{ 0 };

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept
{
  ++allocations;
  return __libc_malloc(size);
}

void* calloc(std::size_t number, std::size_t size) noexcept
{
  ++allocations;
  return __libc_calloc(number, size);
}

void* realloc(void* memory, std::size_t size) noexcept
{
  ++allocations;
  return __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
  ++allocations;
  return __libc_memalign(alignment, size);
}
}

namespace cloth
{
namespace
{

const Eigen::Vector3d gravity{ 0.0, 0.0, -9.81 };

/// A sheet of several stretches in gusts, with a pin that swings and one that is turned.
class Allocations : public testing::TestWithParam<std::tuple<const char*, int>>
{
protected:
  Allocations()
  {
    const ClothModel& model = dynamics_.model();
    Noise noise;
    state_.positions = model.rest_positions + 5e-4 * noise.vectors(model.nodes());
    state_.velocities = 0.1 * noise.vectors(model.nodes());
    Pins& pins = dynamics_.pins();
    Pin swinging = still_pin("swinging", { 0, 1, 2 }, state_.positions);
    swinging.oscillation.amplitude = { 0.0, 0.01, 0.0 };
    swinging.oscillation.frequency = 2.0;
    pins.hold(swinging);
    pins.hold(still_pin("turned", { 30, 31, 67, 68 }, state_.positions));
    const Eigen::Isometry3d placement(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    pins.carry("turned", placement, pins.find("turned")->held_middle(), 0.0, 0.1);
  }

  Dynamics dynamics_{ make_sheet(small_sheet(25, 37)), gravity, { 0.3, 1.0, { 1.0, 2.0, 0.0 }, { 1.0, 0.5, 1 } } };
  ClothState state_;
};

TEST_P(Allocations, NoneAfterTheFirstSteps)
{
  const auto& [name, threads] = GetParam();
  dynamics_.use_threads(threads);
  const std::unique_ptr<Method> method = find_method(name)->make({});
  long before = allocations;
  for (int s = 0; s < 3; ++s)
  {
    method->step(dynamics_, 1e-4, state_);
  }
  EXPECT_GT(allocations, before) << "what is counted";
  before = allocations;
  for (int s = 0; s < 20; ++s)
  {
    method->step(dynamics_, 1e-4, state_);
  }
  EXPECT_EQ(allocations, before);
}

INSTANTIATE_TEST_SUITE_P(ExplicitMethods, Allocations,
                         testing::Combine(testing::Values("explicit_euler", "symplectic_euler", "velocity_verlet",
                                                          "midpoint", "rk4", "dopri5"),
                                          testing::Values(1, 2)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) + "_" + std::to_string(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace cloth

#endif
