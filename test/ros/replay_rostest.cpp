#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>
#include <ros/param.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothTopology.h"

#include "child_process.h"
#include "launch.h"
#include "listener.h"
#include "messages.h"
#include "node_process.h"
#include "temporary_folder.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothTopology;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const std::string state_topic = "/cloth_node/state";
const std::string topology_topic = "/cloth_node/topology";

/// The node under test, with nothing left on the parameter server by another.
ChildProcess start_replay(std::vector<std::string> arguments = {})
{
  ros::param::del("/cloth_replay");
  arguments.insert(arguments.begin(), CLOTH_REPLAY);
  return ChildProcess(arguments);
}

bool ends(ChildProcess& process)
{
  return wait_until([&] { return process.exit_status().has_value(); });
}

/// `rosbag play` of some files; ended properly, because it is a script that has the player as a child of its own.
class Player
{
public:
  explicit Player(const std::vector<std::string>& bags, bool loop = false) : process_(command(bags, loop))
  {
  }
  ~Player()
  {
    process_.signal(SIGINT);
    EXPECT_TRUE(ends(process_)) << output();
  }
  std::string output() const
  {
    return process_.output();
  }

private:
  static std::vector<std::string> command(const std::vector<std::string>& bags, bool loop)
  {
    std::vector<std::string> words{ "rosbag", "play", "--quiet", "--clock", "--wait-for-subscribers" };
    if (loop)
    {
      words.emplace_back("--loop");
    }
    words.insert(words.end(), bags.begin(), bags.end());
    words.insert(words.end(), { "--topics", state_topic, topology_topic });
    return words;
  }

  ChildProcess process_;
};

template <typename Message>
std::vector<boost::shared_ptr<Message>> read(const std::string& file, const std::string& topic)
{
  const rosbag::Bag bag(file);
  std::vector<boost::shared_ptr<Message>> messages;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic)))
  {
    messages.push_back(instance.instantiate<Message>());
  }
  return messages;
}

/// A topology as a node of `rows` x 3 nodes publishes it.
ClothTopology topology_of(int rows, std::uint32_t version)
{
  SheetProperties sheet;
  sheet.rows = rows;
  sheet.cols = 3;
  ClothTopology message = topology_message(make_sheet(sheet), version);
  message.header.frame_id = "world";
  message.header.stamp = ros::Time(10.0);
  return message;
}

/// A state at rest of that topology, its first node held.
ClothState state_of(const ClothTopology& topology, double stamp)
{
  ClothState message;
  message.header.frame_id = "world";
  message.header.stamp = ros::Time(stamp);
  message.topology_version = topology.version;
  message.positions = topology.rest_positions;
  message.flags.assign(topology.masses.size(), 0);
  message.flags[0] = ClothState::PINNED;
  return message;
}

template <typename Message>
void write(rosbag::Bag& bag, const std::string& topic, const Message& message, double stamp)
{
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["latching"] = topic == topology_topic ? "1" : "0";
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  bag.write(topic, ros::Time(stamp), message, header);
}

/// States of a tenth of a second from `begin` (s) on, after their topology where that is asked for.
void write_recording(const std::string& file, const ClothTopology& topology, double begin, bool with_topology)
{
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  if (with_topology)
  {
    write(bag, topology_topic, topology, begin);
  }
  for (int i = 1; i <= 10; ++i)
  {
    const double stamp = begin + 0.01 * i;
    write(bag, state_topic, state_of(topology, stamp), stamp);
  }
}

std::array<float, 3> as_float(const geometry_msgs::Point& point)
{
  return { static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z) };
}

std::vector<std::array<float, 3>> as_float(const std::vector<geometry_msgs::Point>& points)
{
  std::vector<std::array<float, 3>> values;
  for (const auto& point : points)
  {
    values.push_back(as_float(point));
  }
  return values;
}

std::set<std::array<float, 3>> shown_points(const MarkerArray& array)
{
  std::set<std::array<float, 3>> points;
  for (const Marker& marker : array.markers)
  {
    for (const auto& point : marker.points)
    {
      points.insert(as_float(point));
    }
  }
  return points;
}

bool shows_all(const Marker& mesh, const ClothTopology& topology)
{
  return mesh.points.size() == topology.triangles.size();
}

/// Every point has the very value of the state's float32.
void expect_equal(const Marker& mesh, const ClothState& state, const ClothTopology& topology)
{
  ASSERT_EQ(mesh.points.size(), topology.triangles.size());
  for (size_t corner = 0; corner < topology.triangles.size(); ++corner)
  {
    const float* const position = &state.positions[3 * topology.triangles[corner]];
    ASSERT_EQ(mesh.points[corner].x, static_cast<double>(position[0]));
    ASSERT_EQ(mesh.points[corner].y, static_cast<double>(position[1]));
    ASSERT_EQ(mesh.points[corner].z, static_cast<double>(position[2]));
  }
}

/// Markers of the live node and of the replay at the same stamp; the number of such pairs.
int expect_same_lines(const std::deque<Marker>& live, const std::deque<Marker>& replayed)
{
  int pairs = 0;
  for (const Marker& marker : replayed)
  {
    const auto same = std::find_if(live.begin(), live.end(),
                                   [&](const Marker& other) { return other.header.stamp == marker.header.stamp; });
    if (same == live.end())
    {
      continue;
    }
    ++pairs;
    EXPECT_EQ(as_float(same->points), as_float(marker.points));
    EXPECT_EQ(same->colors, marker.colors);
    EXPECT_EQ(same->ns, marker.ns);
    EXPECT_EQ(same->type, marker.type);
    EXPECT_EQ(same->header.frame_id, marker.header.frame_id);
    EXPECT_NEAR(same->scale.x, marker.scale.x, 1e-7 * same->scale.x);
  }
  return pairs;
}

/// Records what a live node publishes, while listening to its markers.
class RoundTrip : public testing::Test
{
protected:
  ~RoundTrip() override
  {
    ros::param::del("/use_sim_time");  // which replay.launch sets
  }

  void record(const std::string& file, const std::string& options, const std::function<bool()>& recorded_enough)
  {
    NodeProcess node({ "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=6", "_cloth/height:=0.7", "_frame_id:=stage" });
    Listener<Marker> springs("/cloth_node/springs");
    Listener<MarkerArray> pins("/cloth_node/pins");
    Launch recorder({ "record.launch", "bag:=" + file, "options:=" + options });
    ASSERT_TRUE(wait_until(recorded_enough)) << recorder.output();
    recorder.end();
    node.signal(SIGINT);
    ASSERT_TRUE(node.wait_for_end());
    ASSERT_TRUE(wait_until([&] { return springs.publishers() + pins.publishers() == 0; }));
    live_springs_ = springs.all();
    live_pins_ = pins.all();
  }

  TemporaryFolder folder_;
  std::deque<Marker> live_springs_;
  std::deque<MarkerArray> live_pins_;
};

TEST_F(RoundTrip, ShowsWhatTheLiveNodeShowed)
{
  const std::string file = folder_.file("a cloth.bag");
  record(file, "--chunksize=1",
         [&] { return std::ifstream(file + ".active", std::ios::ate | std::ios::binary).tellg() > 40000; });
  ASSERT_FALSE(HasFatalFailure());
  const auto states = read<ClothState>(file, state_topic);
  const auto topologies = read<ClothTopology>(file, topology_topic);
  ASSERT_GT(states.size(), 10u);
  ASSERT_EQ(topologies.size(), 1u);

  Listener<Marker> mesh("/cloth_replay/mesh");
  Listener<Marker> springs("/cloth_replay/springs");
  Listener<MarkerArray> pins("/cloth_replay/pins");
  ChildProcess replay = start_replay();
  ASSERT_TRUE(wait_until([&] { return springs.publishers() > 0; })) << replay.output();
  const Player player({ file });
  ASSERT_TRUE(wait_until([&] {
    return !mesh.all().empty() && mesh.last().header.stamp == states.back()->header.stamp;
  })) << player.output();

  std::map<ros::Time, const ClothState*> by_stamp;
  for (const auto& state : states)
  {
    by_stamp[state->header.stamp] = state.get();
  }
  for (const Marker& marker : mesh.all())
  {
    ASSERT_EQ(by_stamp.count(marker.header.stamp), 1u);
    EXPECT_EQ(marker.header.frame_id, "stage");
    expect_equal(marker, *by_stamp[marker.header.stamp], *topologies[0]);
  }
  EXPECT_TRUE(mesh.latched());
  EXPECT_GT(expect_same_lines(live_springs_, springs.all()), 5);

  ASSERT_TRUE(pins.wait_for(1));
  EXPECT_TRUE(pins.latched());
  ASSERT_EQ(pins.last().markers.size(), 1u);
  EXPECT_EQ(shown_points(pins.last()), shown_points(live_pins_.back()));
  const Marker& live_pin = live_pins_.back().markers[0];
  EXPECT_EQ(pins.last().markers[0].type, live_pin.type);
  EXPECT_EQ(pins.last().markers[0].color, live_pin.color);
  EXPECT_NEAR(pins.last().markers[0].scale.x, live_pin.scale.x, 1e-7);
}

TEST_F(RoundTrip, EachFileOfASplitRecordingIsShownAlone)
{
  const std::string later = folder_.file("a cloth_1.bag");
  record(folder_.file("a cloth.bag"), "--split --duration=1", [&] { return std::ifstream(later).good(); });
  ASSERT_FALSE(HasFatalFailure());
  const auto states = read<ClothState>(later, state_topic);
  ASSERT_FALSE(states.empty());

  Listener<Marker> mesh("/cloth_replay/mesh");
  const Launch player({ "replay.launch", "rviz:=false", "bag:=" + folder_.file("a\\ cloth_1.bag") });
  EXPECT_TRUE(mesh.wait_for_one([&](const Marker& marker) {
    return marker.header.stamp == states.back()->header.stamp;
  })) << player.output();
}

/// A running replay, and what it shows.
class Replay : public testing::Test
{
protected:
  bool shows(const ClothTopology& topology)
  {
    return mesh_.wait_for_one([&](const Marker& mesh) { return shows_all(mesh, topology); });
  }

  ros::NodeHandle node_;
  TemporaryFolder folder_;
  const ClothTopology first_ = topology_of(4, 1);
  const ClothTopology second_ = topology_of(5, 2);
  Listener<Marker> mesh_{ "/cloth_replay/mesh" };
  Listener<MarkerArray> pins_{ "/cloth_replay/pins" };
};

TEST_F(Replay, ABagThatStartsInTheMiddleWaitsForItsTopology)
{
  const std::string middle = folder_.file("middle.bag");
  write_recording(middle, first_, 20.0, false);
  ChildProcess replay = start_replay();
  const Player player({ middle });
  ASSERT_TRUE(wait_until([&] { return replay.output().find("waiting for topology version 1") != std::string::npos; }));
  EXPECT_NE(replay.output().find("~bag"), std::string::npos);
  EXPECT_TRUE(mesh_.all().empty());

  ros::Publisher topology = node_.advertise<ClothTopology>(topology_topic, 1, true);
  topology.publish(first_);
  EXPECT_TRUE(shows(first_));
  EXPECT_TRUE(pins_.wait_for(1));
}

TEST_F(Replay, ABagThatStartsInTheMiddleGetsItsTopologyFromAFile)
{
  const std::string beginning = folder_.file("beginning.bag");
  const std::string middle = folder_.file("middle.bag");
  write_recording(beginning, first_, 10.0, true);
  write_recording(middle, first_, 20.0, false);
  ChildProcess replay = start_replay({ "_bag:=" + middle + " " + beginning });
  const Player player({ middle });
  EXPECT_TRUE(shows(first_)) << replay.output();
  EXPECT_EQ(replay.output().find("waiting"), std::string::npos) << replay.output();
}

TEST_F(Replay, ABagThatIsNotThereEndsTheNode)
{
  ChildProcess replay = start_replay({ "_bag:=/nowhere.bag" });
  ASSERT_TRUE(ends(replay));
  EXPECT_EQ(*replay.exit_status(), 1);
  EXPECT_NE(replay.output().find("/nowhere.bag"), std::string::npos) << replay.output();
}

TEST_F(Replay, SplitBagsPlayedAgainAndAgainChangeTheirTopology)
{
  const std::vector<std::string> parts{ folder_.file("0.bag"), folder_.file("1.bag"), folder_.file("2.bag") };
  write_recording(parts[0], first_, 10.0, true);
  write_recording(parts[1], first_, 10.2, false);
  write_recording(parts[2], second_, 10.4, true);
  ChildProcess replay = start_replay();
  const Player player(parts, true);
  for (int turn = 0; turn < 2; ++turn)
  {
    ASSERT_TRUE(mesh_.wait_for_one([&](const Marker& mesh) {
      return shows_all(mesh, first_) && mesh.header.stamp == ros::Time(10.3);
    })) << replay.output()
        << player.output();
    ASSERT_TRUE(shows(second_));
  }
  ASSERT_TRUE(pins_.wait_for_one([&](const MarkerArray& array) {
    return array.markers.size() == 1 && array.markers[0].action == Marker::ADD &&
           array.markers[0].header.stamp < ros::Time(10.2);
  }));
}

TEST_F(Replay, AStateThatDoesNotFitIsRefusedAndTheNextIsShown)
{
  ros::Publisher topology = node_.advertise<ClothTopology>(topology_topic, 1, true);
  ros::Publisher state = node_.advertise<ClothState>(state_topic, 10, true);
  ChildProcess replay = start_replay();
  topology.publish(first_);
  ClothState misfit = state_of(first_, 10.1);
  misfit.positions.pop_back();
  state.publish(misfit);
  ASSERT_TRUE(wait_until([&] { return replay.output().find("does not fit") != std::string::npos; }));
  EXPECT_TRUE(mesh_.all().empty());
  state.publish(state_of(first_, 10.2));
  EXPECT_TRUE(shows(first_));
}

TEST_F(Replay, PinsAreShownAgainWhenTimeJumpsBack)
{
  ros::Publisher topology = node_.advertise<ClothTopology>(topology_topic, 1, true);
  ros::Publisher state = node_.advertise<ClothState>(state_topic, 10, true);
  ChildProcess replay = start_replay();
  topology.publish(first_);
  for (const double stamp : { 10.5, 10.1 })
  {
    state.publish(state_of(first_, stamp));
    ASSERT_TRUE(wait_until([&] {
      return !pins_.all().empty() && !pins_.last().markers.empty() &&
             pins_.last().markers[0].header.stamp == ros::Time(stamp);
    })) << stamp;
  }
}

}  // namespace
}  // namespace cloth
