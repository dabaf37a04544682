#include "messages.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

ClothModel small_sheet()
{
  SheetProperties properties;
  properties.rows = 4;
  properties.cols = 3;
  return make_sheet(properties);
}

TEST(TopologyMessage, SpringsAreAsLongAsTheirRestLengths)
{
  const auto message = topology_message(small_sheet(), 5);
  EXPECT_EQ(message.version, 5u);
  ASSERT_EQ(message.spring_nodes.size(), 2 * message.rest_lengths.size());
  ASSERT_EQ(message.spring_kinds.size(), message.rest_lengths.size());
  const auto position = [&](size_t end) {
    return Eigen::Map<const Eigen::Vector3f>(&message.rest_positions[3 * message.spring_nodes[end]]);
  };
  for (size_t s = 0; s < message.rest_lengths.size(); ++s)
  {
    EXPECT_NEAR((position(2 * s) - position(2 * s + 1)).norm(), message.rest_lengths[s], 1e-6);
  }
  EXPECT_EQ(std::count(message.spring_kinds.begin(), message.spring_kinds.end(), message.STRUCTURAL), 17);
  EXPECT_EQ(std::count(message.spring_kinds.begin(), message.spring_kinds.end(), message.SHEAR), 12);
  EXPECT_EQ(std::count(message.spring_kinds.begin(), message.spring_kinds.end(), message.FLEX), 10);
}

TEST(TopologyMessage, HasTwoTrianglesAQuadAndTheSheetsMass)
{
  const auto message = topology_message(small_sheet(), 1);
  EXPECT_EQ(message.triangles.size(), 3u * 2u * 3u * 2u);
  EXPECT_LT(*std::max_element(message.triangles.begin(), message.triangles.end()), 12u);
  double mass = 0.0;
  for (const float share : message.masses)
  {
    mass += static_cast<double>(share);
  }
  EXPECT_NEAR(mass, 0.3, 1e-6);
}

TEST(StateMessage, UsesItsMemoryAgain)
{
  SceneParams scene;
  scene.sheet.rows = 4;
  scene.sheet.cols = 3;
  Simulation simulation = build_simulation(make_plan(scene));
  cloth_sim::ClothState message;
  fill_state(simulation, message);
  const float* const memory = message.positions.data();
  simulation.release("left");
  simulation.advance_to(0.1);
  fill_state(simulation, message);
  EXPECT_EQ(message.positions.data(), memory);
  EXPECT_EQ(message.sim_time, 0.1);
  EXPECT_EQ(message.step, simulation.counters().steps);
  EXPECT_EQ(message.flags[0], 0);
  EXPECT_EQ(message.flags[2], cloth_sim::ClothState::PINNED);
  EXPECT_EQ(message.positions[3 * 11 + 2], static_cast<float>(simulation.state().positions(11, 2)));
}

TEST(StatsMessage, GivesTheEnergiesOfTheStart)
{
  SceneParams scene;
  scene.start.velocity = { 2.0, 0.0, 0.0 };
  scene.start.position = { 0.0, 0.0, 1.5 };
  scene.pins.clear();
  const Simulation simulation = build_simulation(make_plan(scene));
  const auto message = stats_message(simulation, { 1.5, 2.0, 3.0 });
  EXPECT_NEAR(message.kinetic_energy, 0.5 * 0.3 * 4.0, 1e-12);
  EXPECT_NEAR(message.elastic_energy, 0.0, 1e-12);
  EXPECT_NEAR(message.gravitational_energy, 0.3 * 9.81 * 1.0, 1e-9);
  EXPECT_NEAR(message.max_strain, 0.0, 1e-12);
  EXPECT_EQ(message.real_time_factor, 1.5);
  EXPECT_EQ(message.tick_ms_mean, 2.0);
  EXPECT_EQ(message.tick_ms_max, 3.0);
  EXPECT_EQ(message.time_step, simulation.time_step());
  EXPECT_EQ(message.stability_limit, simulation.stability_limit());
  EXPECT_EQ(message.unconverged_steps, simulation.counters().unconverged_steps);
  EXPECT_EQ(message.rejected_steps, 0u);
}

}  // namespace
}  // namespace cloth
