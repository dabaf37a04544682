#include "cloth_sim/threads/crew.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__linux__)
#include <sched.h>
#endif

namespace cloth
{
namespace
{

/// How long those who wait look for work before they sleep: longer than what one thread does alone between two calls
/// in a step, shorter than anyone would notice.
constexpr std::chrono::microseconds patience{ 50 };

/// Leaves the processor to the other thread of its core for a moment. Not after every look: a virtual machine whose
/// processor pauses again and again is put aside by its host, and comes back microseconds late.
void pause()
{
#if defined(__x86_64__) && defined(__GNUC__)
  __builtin_ia32_pause();
#endif
}

/// Until is_met(), or until patience has ended: false.
template <typename Condition>
bool look_for(Condition&& is_met)
{
  constexpr int looks = 64;  // between two pauses and looks at the clock
  const auto end = std::chrono::steady_clock::now() + patience;
  do
  {
    for (int i = 0; i < looks; ++i)
    {
      if (is_met())
      {
        return true;
      }
    }
    pause();
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

struct Crew::Members
{
  explicit Members(int threads) : taken(static_cast<size_t>(threads))
  {
  }

  /// Not of the Crew, so that it is run where the machine has too few threads for its constructor.
  ~Members()
  {
    has_ended = true;
    call();
    for (std::thread& other : others)
    {
      other.join();
    }
  }

  void stand_by(int thread)
  {
    std::uint64_t seen = 0;
    for (;;)
    {
      const auto is_called = [&] { return calls.load(std::memory_order_acquire) != seen; };
      if (!look_for(is_called))
      {
        std::unique_lock<std::mutex> lock(mutex);
        ++sleepers;
        called.wait(lock, is_called);
        --sleepers;
      }
      seen = calls.load(std::memory_order_acquire);
      if (has_ended)
      {
        return;
      }
      work_off(thread, seen);
    }
  }

  /// Does what is left of a call, one's own part first. Who is too late finds nothing.
  void work_off(int thread, std::uint64_t call)
  {
    const int parts = static_cast<int>(taken.size());
    for (int p = 0; p < parts; ++p)
    {
      const int part = (thread + p) % parts;
      std::uint64_t before = call - 1;
      if (taken[static_cast<size_t>(part)].compare_exchange_strong(before, call, std::memory_order_acq_rel))
      {
        task.call(task.work, part);
        left.fetch_sub(1, std::memory_order_release);
      }
    }
  }

  void call()
  {
    // The mutex orders this against a thread that has looked in vain and is about to sleep.
    const std::lock_guard<std::mutex> lock(mutex);
    calls.fetch_add(1, std::memory_order_release);
    if (sleepers > 0)
    {
      called.notify_all();
    }
  }

  std::mutex mutex;
  std::condition_variable called;
  int sleepers = 0;
  std::atomic<bool> has_ended{ false };
  Task task;
  std::vector<std::thread> others;
  // In lines of the cache of their own: one is looked at while the other is written.
  alignas(64) std::atomic<std::uint64_t> calls{ 0 };
  alignas(64) std::atomic<int> left{ 0 };         ///< parts of this call that are not done yet
  std::vector<std::atomic<std::uint64_t>> taken;  ///< of each part, the call for which it was taken last
};

Crew::Crew(int threads) : members_(std::make_unique<Members>(std::max(1, threads)))
{
  for (int thread = 1; thread < threads; ++thread)
  {
    members_->others.emplace_back([members = members_.get(), thread] { members->stand_by(thread); });
  }
}

Crew::~Crew() = default;

int Crew::threads() const
{
  return static_cast<int>(members_->taken.size());
}

void Crew::run_all(const Task& task)
{
  members_->task = task;
  members_->left.store(threads(), std::memory_order_relaxed);
  members_->call();
  members_->work_off(0, members_->calls.load(std::memory_order_relaxed));
  // One that was put aside by the system in the middle of its part needs a processor.
  const auto are_done = [&] { return members_->left.load(std::memory_order_acquire) == 0; };
  while (!look_for(are_done))
  {
    std::this_thread::yield();
  }
}

int usable_threads()
{
#if defined(__linux__)
  cpu_set_t usable;
  if (sched_getaffinity(0, sizeof usable, &usable) == 0)
  {
    return std::max(1, CPU_COUNT(&usable));
  }
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace cloth
