#include "refusal_log.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using std::chrono::seconds;

class RefusalLogTest : public testing::Test
{
protected:
  std::vector<std::string> warnings_;
  RefusalLog log_{ [this](const std::string& text) { warnings_.push_back(text); } };
  const RefusalLog::Clock::time_point start_{ seconds(1000) };
};

TEST_F(RefusalLogTest, WarnsOncePerCause)
{
  log_.report("a", start_);
  log_.report("a", start_ + seconds(1));
  log_.report("b", start_ + seconds(1));
  EXPECT_EQ(warnings_, (std::vector<std::string>{ "a", "b" }));
}

TEST_F(RefusalLogTest, WarnsAgainAfterAWhile)
{
  log_.report("a", start_);
  log_.report("a", start_ + RefusalLog::quiet_time);
  EXPECT_EQ(warnings_.size(), 2u);
}

TEST_F(RefusalLogTest, AFloodOfCausesIsCutShort)
{
  for (int i = 0; i < 1000; ++i)
  {
    log_.report(std::to_string(i), start_);
  }
  EXPECT_EQ(warnings_.size(), RefusalLog::max_causes);
  EXPECT_NE(warnings_.back().find("not shown"), std::string::npos);
}

TEST_F(RefusalLogTest, OfAHugeCauseTheBeginningIsShown)
{
  log_.report(std::string(1000000, 'x'), start_);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(warnings_[0] == std::string(RefusalLog::longest_cause, 'x') + "...");
}

}  // namespace
}  // namespace cloth
