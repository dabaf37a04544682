#include <algorithm>

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/ClothState.h"

#include "child_process.h"
#include "listener.h"
#include "temporary_folder.h"

namespace cloth
{
namespace
{

constexpr int messages_a_topic = 20;

/// How many messages of type Message the bag has; each must be among those that `heard` on the wire.
template <typename Message>
int compare(const rosbag::Bag& bag, const std::string& topic, const Listener<Message>& heard)
{
  int count = 0;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic)))
  {
    const auto recorded = instance.instantiate<Message>();
    if (recorded == nullptr)
    {
      ADD_FAILURE() << topic << " is of another type";
      continue;
    }
    const bool known = std::any_of(heard.all().begin(), heard.all().end(), [&](Message message) {
      message.header.seq = recorded->header.seq;
      return message == *recorded;
    });
    EXPECT_TRUE(known) << topic << " at " << recorded->header.stamp;
    ++count;
  }
  return count;
}

TEST(Bag, GivesBackWhatWasPublished)
{
  Listener<visualization_msgs::Marker> mesh("/cloth_node/mesh");
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  ASSERT_TRUE(mesh.wait_for(1));
  ASSERT_TRUE(state.wait_for(1));

  TemporaryFolder folder;
  const std::string file = folder.file("cloth.bag");
  ChildProcess recorder({ "rosbag", "record", "--quiet", "--limit=" + std::to_string(messages_a_topic),
                          "--output-name=" + file, "/cloth_node/mesh", "/cloth_node/state" });
  ASSERT_TRUE(wait_until([&] { return recorder.exit_status().has_value(); })) << recorder.output();
  ASSERT_EQ(*recorder.exit_status(), 0) << recorder.output();
  ASSERT_TRUE(mesh.wait_for_more(2));
  ASSERT_TRUE(state.wait_for_more(2));

  const rosbag::Bag bag(file);
  EXPECT_EQ(compare(bag, "/cloth_node/mesh", mesh), messages_a_topic);
  EXPECT_EQ(compare(bag, "/cloth_node/state", state), messages_a_topic);
}

}  // namespace
}  // namespace cloth
