#include <algorithm>
#include <csignal>
#include <fstream>
#include <set>

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/ClothTopology.h"

#include "child_process.h"
#include "launch.h"
#include "listener.h"
#include "messages.h"
#include "node_process.h"
#include "pin_message.h"
#include "state_message.h"
#include "temporary_folder.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothTopology;
using visualization_msgs::MarkerArray;

const std::string state_topic = "/cloth_node/state";
const std::string topology_topic = "/cloth_node/topology";
// Plain sweeps shorten a spring without regard to what was before the step, of which a recording knows nothing; and
// auto would try anew what to take from the recorded state on. A step that follows stability is worked out now and
// then.
const std::vector<std::string> scene{ "_rate:=50",
                                      "_cloth/rows:=8",
                                      "_cloth/cols:=6",
                                      "_strain_limit/solver:=sweeps",
                                      "_solver/method:=velocity_verlet",
                                      "_solver/time_step:=1.0e-3",
                                      "_pins:=[{name: left, at: top_left}, {name: swung, at: top_right, "
                                      "motion: {amplitude: [0.0, 0.2, 0.0], frequency: 2.0, phase: 0.3}}]" };

/// The same as a file, to be started paused.
void write_scene(const std::string& file)
{
  std::ofstream(file) << "rate: 50\n"
                         "start_paused: true\n"
                         "cloth: {rows: 8, cols: 6}\n"
                         "strain_limit: {solver: sweeps}\n"
                         "solver: {method: velocity_verlet, time_step: 1.0e-3}\n"
                         "pins:\n"
                         "  - {name: left, at: top_left}\n"
                         "  - {name: swung, at: top_right,\n"
                         "     motion: {amplitude: [0.0, 0.2, 0.0], frequency: 2.0, phase: 0.3}}\n";
}

std::vector<std::string> scene_with(const std::vector<std::string>& more)
{
  std::vector<std::string> arguments = scene;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The states of a bag, in their order, and when each was recorded, s from the beginning of the bag.
struct Recorded
{
  explicit Recorded(const std::string& file)
  {
    const rosbag::Bag bag(file);
    rosbag::View whole(bag);
    for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(state_topic)))
    {
      states.push_back(*instance.instantiate<ClothState>());
      times.push_back((instance.getTime() - whole.getBeginTime()).toSec());
    }
  }

  std::vector<ClothState> states;
  std::vector<double> times;
};

/// The scene's cloth, with a node of its lower edge held by topic.
void record(const std::string& file)
{
  NodeProcess node(scene);
  ros::NodeHandle handle;
  ros::Publisher pins = handle.advertise<cloth_sim::Pin>("/cloth_node/pin", 1);
  ASSERT_TRUE(wait_until([&] { return pins.getNumSubscribers() > 0; })) << node.output();
  pins.publish(pin_node("hand", 7, 2));
  Listener<ClothState> states(state_topic);
  ASSERT_TRUE(states.wait_for_one([](const ClothState& state) { return is_pinned(state, 7 * 6 + 2); }));
  ChildProcess recorder({ "rosbag", "record", "--quiet", "--lz4", "--chunksize=1", "--output-name=" + file, state_topic,
                          topology_topic });
  const auto recorded_enough = [&] {
    return std::ifstream(file + ".active", std::ios::ate | std::ios::binary).tellg() > 80000;
  };
  ASSERT_TRUE(wait_until(recorded_enough)) << recorder.output();
  recorder.signal(SIGINT);
  ASSERT_TRUE(wait_until([&] { return recorder.exit_status().has_value(); })) << recorder.output();
  node.signal(SIGINT);
  ASSERT_TRUE(node.wait_for_end());
}

double farthest(const std::vector<float>& left, const std::vector<float>& right)
{
  double distance = 0.0;
  for (size_t i = 0; i < left.size(); ++i)
  {
    distance = std::max(distance, std::abs(static_cast<double>(left[i]) - static_cast<double>(right[i])));
  }
  return distance;
}

void expect_equal(const ClothState& state, const ClothState& recorded)
{
  EXPECT_EQ(state.positions, recorded.positions);
  EXPECT_EQ(state.flags, recorded.flags);
  ASSERT_EQ(state.velocities.size(), recorded.velocities.size());
  for (size_t node = 0; node < state.flags.size(); ++node)
  {
    for (size_t i = 3 * node; i < 3 * node + 3; ++i)
    {
      // that of a held node is not taken over: it follows from its pin's motion
      ASSERT_NEAR(state.velocities[i], recorded.velocities[i], is_pinned(state, node) ? 1e-5 : 0.0) << "node " << node;
    }
  }
}

TEST(StartBag, GoesOnFromTheRecordedState)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a cloth.bag");
  record(file);
  ASSERT_FALSE(testing::Test::HasFatalFailure());
  const Recorded recorded(file);
  ASSERT_GT(recorded.states.size(), 30u);
  constexpr size_t middle = 20;
  const double start_time = 0.5 * (recorded.times[middle - 1] + recorded.times[middle]);

  const std::string scene_file = folder.file("scene.yaml");
  write_scene(scene_file);
  Launch node(
      { "cloth.launch", "scene:=" + scene_file, "start_bag:=" + file, "start_time:=" + std::to_string(start_time) });
  Listener<ClothState> states(state_topic);
  Listener<MarkerArray> pins("/cloth_node/pins");
  ASSERT_TRUE(states.wait_for(1)) << node.output();
  expect_equal(states.last(), recorded.states[middle]);
  EXPECT_EQ(states.last().sim_time, 0.0);

  constexpr int ticks = 5;
  for (int i = 0; i < ticks; ++i)
  {
    ASSERT_TRUE(trigger("step").success);
  }
  ASSERT_TRUE(wait_until([&] { return states.last().sim_time > 4.5 / 50.0; }));
  const ClothState& later = recorded.states[middle + ticks];
  EXPECT_NEAR(later.sim_time - recorded.states[middle].sim_time, states.last().sim_time, 1e-9);
  EXPECT_GT(farthest(later.positions, recorded.states[middle].positions), 1e-2);
  EXPECT_LT(farthest(states.last().positions, later.positions), 1e-4);

  std::set<std::string> names;
  ASSERT_TRUE(pins.wait_for(1));
  for (const auto& marker : pins.last().markers)
  {
    names.insert(marker.ns);
  }
  EXPECT_EQ(names, (std::set<std::string>{ "left", "recorded", "swung" }));

  ASSERT_TRUE(trigger("reset").success);
  ASSERT_TRUE(wait_until([&] { return states.last().sim_time == 0.0; }));
  expect_equal(states.last(), recorded.states[middle]);
}

template <typename Message>
void write(rosbag::Bag& bag, const std::string& topic, const Message& message, double stamp)
{
  bag.write(topic, ros::Time(stamp), message);
}

/// A bag of the scene's cloth as it is flat, from 10 s to 11 s, on the topics of `nodes`.
void write_bag(const std::string& file, const std::vector<std::string>& nodes, int rows, bool with_velocities)
{
  SheetProperties sheet;
  sheet.rows = rows;
  sheet.cols = 6;
  ClothTopology topology = topology_message(make_sheet(sheet), 1);
  topology.header.frame_id = "world";
  topology.header.stamp = ros::Time(10.0);
  ClothState state;
  state.header.frame_id = "world";
  state.topology_version = 1;
  state.positions = topology.rest_positions;
  if (with_velocities)
  {
    state.velocities.assign(state.positions.size(), 0.25F);
  }
  state.flags.assign(topology.masses.size(), 0);
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  for (const std::string& node : nodes)
  {
    write(bag, node + "/topology", topology, 10.0);
    for (const double stamp : { 10.5, 11.0 })
    {
      state.header.stamp = ros::Time(stamp);
      write(bag, node + "/state", state, stamp);
    }
  }
}

TEST(StartBag, HasNoVelocitiesWhereNoneWereRecordedAndNoPinsWhereNoneHeld)
{
  for (const bool with_velocities : { true, false })
  {
    TemporaryFolder folder;
    const std::string file = folder.file("cloth.bag");
    write_bag(file, { "/other" }, 8, with_velocities);
    NodeProcess node(scene_with({ "_start_bag:=" + file, "_start_paused:=true" }));
    Listener<ClothState> states(state_topic);
    ASSERT_TRUE(states.wait_for(1)) << node.output();
    const ClothState& state = states.last();
    EXPECT_EQ(state.velocities, std::vector<float>(state.positions.size(), with_velocities ? 0.25F : 0.0F));
    EXPECT_EQ(state.flags, std::vector<std::uint8_t>(state.flags.size(), 0));
  }
}

/// The node must not start, and say so in these words.
void expect_refused(const std::vector<std::string>& arguments, const std::string& words)
{
  NodeProcess node(scene_with(arguments));
  ASSERT_TRUE(node.wait_for_end()) << words;
  EXPECT_EQ(node.exit_status(), 1) << words;
  EXPECT_NE(node.output().find(words), std::string::npos) << node.output();
}

TEST(StartBag, IsRefusedWithTheReason)
{
  TemporaryFolder folder;
  const std::string good = folder.file("good.bag");
  write_bag(good, { "/cloth_node" }, 8, true);
  const std::string other_grid = folder.file("other_grid.bag");
  write_bag(other_grid, { "/cloth_node" }, 9, true);
  const std::string two = folder.file("two.bag");
  write_bag(two, { "/left", "/right" }, 8, true);

  expect_refused({ "_start_bag:=/nowhere.bag" }, "start_bag: /nowhere.bag: Error opening file");
  expect_refused({ "_start_bag:=" + good, "_start_time:=1.5" },
                 "no state at start_time 1.5 s or later; allowed: up to 1.0 s");
  expect_refused({ "_start_bag:=" + good, "_start_time:=-1" }, "start_time");
  expect_refused({ "_start_bag:=" + other_grid }, "a cloth of 9 x 6 nodes was recorded; the scene has 8 x 6 nodes");
  expect_refused({ "_start_bag:=" + two }, "it has states on 2 topics: /left/state, /right/state");
  expect_refused({ "_start_bag:=" + good, "_frame_id:=stage" },
                 "it was recorded in frame_id world; the scene has stage");
  expect_refused({ "_start_bag:=" + good, "_cloth/width:=2.0" }, "allowed: the same cloth.width and cloth.height");
}

}  // namespace
}  // namespace cloth
