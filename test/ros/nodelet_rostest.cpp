#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <nodelet/loader.h>
#include <ros/param.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/ClothState.h"

#include "listener.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;

/// Gets the messages of a topic as they come, and keeps one; not one of the first, which may be latched from a time
/// when nobody listened.
template <typename Message>
class Holder
{
public:
  using Pointer = boost::shared_ptr<const Message>;

  explicit Holder(const std::string& topic) : subscriber_(node_.subscribe(topic, 1, &Holder::take, this))
  {
  }

  const Pointer& held() const
  {
    return held_;
  }
  /// The kept one as it was when it came.
  const Message& copy() const
  {
    return copy_;
  }
  /// How many have come after it, and how many of those were the same object.
  int later() const
  {
    return later_;
  }
  int repeated() const
  {
    return repeated_;
  }

private:
  static constexpr int passed_over = 5;

  void take(const Pointer& message)
  {
    if (++taken_ <= passed_over)
    {
      return;
    }
    if (held_ == nullptr)
    {
      held_ = message;
      copy_ = *message;
      return;
    }
    ++later_;
    repeated_ += message == held_ ? 1 : 0;
  }

  ros::NodeHandle node_;
  int taken_ = 0;
  Pointer held_;
  Message copy_;
  int later_ = 0;
  int repeated_ = 0;
  ros::Subscriber subscriber_;
};

/// The nodelet /cloth_node in this process.
class Nodelet : public testing::Test
{
protected:
  void SetUp() override
  {
    ros::param::del("/cloth_node");
    ros::param::set("/cloth_node/cloth/rows", 8);
    ros::param::set("/cloth_node/cloth/cols", 6);
  }

  bool load()
  {
    return loader_.load("/cloth_node", "cloth_sim/ClothNodelet", {}, {});
  }

  nodelet::Loader loader_{ false };
};

template <typename Message>
void expect_held_uncopied(const std::string& topic)
{
  const Holder<Message> holder(topic);
  ASSERT_TRUE(wait_until([&] { return holder.later() >= 20; })) << topic;
  EXPECT_EQ(*holder.held(), holder.copy()) << topic;
  EXPECT_EQ(holder.repeated(), 0) << topic;
  constexpr long publisher_and_holder = 2;
  EXPECT_EQ(holder.held().use_count(), publisher_and_holder) << topic;
}

TEST_F(Nodelet, AListenerInTheSameProcessHoldsThePublishersOwnMessage)
{
  ASSERT_TRUE(load());
  expect_held_uncopied<ClothState>("/cloth_node/state");
  expect_held_uncopied<visualization_msgs::Marker>("/cloth_node/springs");
}

TEST_F(Nodelet, AHeldLatchedMessageStaysAsItIs)
{
  ASSERT_TRUE(load());
  expect_held_uncopied<visualization_msgs::Marker>("/cloth_node/mesh");
}

TEST_F(Nodelet, AnswersItsServices)
{
  ASSERT_TRUE(load());
  EXPECT_TRUE(set_paused(true).success);
  EXPECT_TRUE(trigger("step").success);
  EXPECT_TRUE(trigger("reset").success);
}

TEST_F(Nodelet, EndsWhenItIsUnloadedAndCanBeLoadedAgain)
{
  Listener<ClothState> state("/cloth_node/state");
  ASSERT_TRUE(load());
  ASSERT_TRUE(state.wait_for(1));
  ASSERT_TRUE(loader_.unload("/cloth_node"));
  ASSERT_TRUE(wait_until([&] { return state.publishers() == 0; }));
  ASSERT_TRUE(load());
  EXPECT_TRUE(state.wait_for_one([](const ClothState& message) { return message.sim_time < 1.0; }));
  EXPECT_TRUE(state.wait_for_more(2));
}

TEST_F(Nodelet, ASceneWithAFaultIsNotLoaded)
{
  ros::param::set("/cloth_node/cloth/rows", -1);
  EXPECT_FALSE(load());
  EXPECT_TRUE(loader_.listLoadedNodelets().empty());
  ros::param::set("/cloth_node/cloth/rows", 8);
  EXPECT_TRUE(load());
}

TEST(NodeletLaunch, LoadsTheClothIntoAManager)
{
  Listener<ClothState> state("/launched/state");
  EXPECT_TRUE(state.wait_for(2));
  nodelet::NodeletList list;
  ASSERT_TRUE(ros::service::call("/cloth_manager/list", list));
  EXPECT_EQ(list.response.nodelets, std::vector<std::string>{ "/launched" });
}

}  // namespace
}  // namespace cloth
