#include "reused_messages.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <std_msgs/String.h>

namespace cloth
{
namespace
{

using std_msgs::String;

String said(const std::string& text)
{
  String message;
  message.data = text;
  return message;
}

TEST(ReusedMessages, UseTheMemoryOfOneThatNobodyHolds)
{
  ReusedMessages<String> messages(said("first"));
  const String* const first = messages.take().get();
  EXPECT_EQ(messages.take().get(), first);
  EXPECT_EQ(messages.take()->data, "first");
}

TEST(ReusedMessages, LeaveAloneWhatIsHeld)
{
  ReusedMessages<String> messages;
  const String::Ptr held = messages.take();
  held->data = "held";
  for (int i = 0; i < 3; ++i)
  {
    const String::Ptr other = messages.take();
    EXPECT_NE(other, held);
    other->data = "other";
  }
  EXPECT_EQ(held->data, "held");
}

TEST(ReusedMessages, TakeBackOneThatIsLetGo)
{
  ReusedMessages<String> messages;
  String::Ptr held = messages.take();
  const String* const first = held.get();
  EXPECT_NE(messages.take().get(), first);
  held.reset();
  EXPECT_EQ(messages.take().get(), first);
}

TEST(ReusedMessages, LeaveManyToWhoeverKeepsThem)
{
  ReusedMessages<String> messages;
  std::vector<String::Ptr> kept;
  constexpr size_t more_than_enough = 3 * ReusedMessages<String>::most_kept;
  for (size_t i = 0; i < more_than_enough; ++i)
  {
    kept.push_back(messages.take());
    EXPECT_EQ(kept.back().use_count(), 2);
  }
  EXPECT_EQ(kept.front().use_count(), 1);
}

}  // namespace
}  // namespace cloth
