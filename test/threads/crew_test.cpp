#include "cloth_sim/threads/crew.h"

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

TEST(Crew, DoesEachPartOnce)
{
  Crew crew(3);
  EXPECT_EQ(crew.threads(), 3);
  std::array<int, 3> calls{};
  crew.run([&](int part) { ++calls[static_cast<size_t>(part)]; });
  EXPECT_EQ(calls, (std::array<int, 3>{ 1, 1, 1 }));
}

TEST(Crew, WorksInThreadsOfItsOwnBesidesTheCallers)
{
  Crew crew(2);
  // Each part ends only when the other has begun, so that neither thread can do both.
  std::atomic<int> begun{ 0 };
  std::array<std::thread::id, 2> ids;
  crew.run([&](int part) {
    ids[static_cast<size_t>(part)] = std::this_thread::get_id();
    ++begun;
    while (begun < 2)
    {
      std::this_thread::yield();
    }
  });
  EXPECT_NE(ids[0], ids[1]);
  EXPECT_EQ(ids[0], std::this_thread::get_id());
}

TEST(Crew, HasDoneEverythingWhenACallReturns)
{
  Crew crew(2);
  std::array<int, 2> done{};
  for (int round = 1; round <= 20000; ++round)
  {
    crew.run([&](int thread) { done[static_cast<size_t>(thread)] += round; });
    ASSERT_EQ(done[1], done[0]) << "in round " << round;
  }
}

TEST(Crew, WakesUpFromItsSleep)
{
  Crew crew(2);
  std::atomic<int> calls{ 0 };
  for (int round = 0; round < 5; ++round)
  {
    // Longer than anyone looks for work.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    crew.run([&](int) { ++calls; });
  }
  EXPECT_EQ(calls, 10);
}

TEST(Crew, OfOneIsTheCallerAlone)
{
  Crew crew(1);
  int calls = 0;
  crew.run([&](int thread) { calls += 1 + thread; });
  EXPECT_EQ(calls, 1);
}

TEST(UsableThreads, AreAtLeastOne)
{
  EXPECT_GE(usable_threads(), 1);
}

}  // namespace
}  // namespace cloth
