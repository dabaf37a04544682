#include "errands.h"

#include <chrono>
#include <future>
#include <optional>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

std::future<Answer> sent(Errands& errands, const Errands::Errand& errand)
{
  return std::async(std::launch::async, [&errands, errand] { return errands.send(errand); });
}

Answer done(Errands& errands, std::future<Answer>& answer)
{
  while (answer.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready)
  {
    errands.do_all();
  }
  return answer.get();
}

TEST(Errands, AreAnsweredByTheDoersThread)
{
  Errands errands;
  const Errands::Doer doer(errands);
  std::thread::id thread;
  auto answer = sent(errands, [&] {
    thread = std::this_thread::get_id();
    return Answer{ true, "done" };
  });
  EXPECT_EQ(done(errands, answer).message, "done");
  EXPECT_EQ(thread, std::this_thread::get_id());
}

TEST(Errands, WhatOneThrowsGoesToItsSender)
{
  Errands errands;
  const Errands::Doer doer(errands);
  auto answer = sent(errands, []() -> Answer { throw std::runtime_error("broken"); });
  EXPECT_THROW(done(errands, answer), std::runtime_error);
}

TEST(Errands, AreSeenToWaitUntilTheyAreDone)
{
  Errands errands;
  const Errands::Doer doer(errands);
  EXPECT_FALSE(errands.any_waiting());
  auto answer = sent(errands, [] { return Answer{}; });
  while (!errands.any_waiting())
  {
    std::this_thread::yield();
  }
  errands.do_all();
  EXPECT_FALSE(errands.any_waiting());
  EXPECT_TRUE(answer.get().success);
}

TEST(Errands, AreRefusedWhenTheDoerGoes)
{
  Errands errands;
  std::optional<Errands::Doer> doer(std::in_place, errands);
  const auto never = [] {
    ADD_FAILURE() << "done after the end";
    return Answer{};
  };
  auto answer = sent(errands, never);
  doer.reset();
  EXPECT_FALSE(answer.get().success) << "whether it came before the end or after";
  EXPECT_FALSE(errands.send(never).success);
}

}  // namespace
}  // namespace cloth
