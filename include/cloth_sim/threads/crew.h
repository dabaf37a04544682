#pragma once

#include <memory>

namespace cloth
{

/// Threads that wait for work and do it together, for parts of a step: a call of `run` costs about a microsecond while
/// calls follow one another closely. Those who wait look for work a while, then sleep until they are called. Nobody is
/// waited for who has not begun: on a busy machine the caller does the others' parts himself.
class Crew
{
public:
  /// The caller of `run` and `threads` - 1 more. Throws std::system_error where the machine has no more threads.
  explicit Crew(int threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  int threads() const;

  /// Calls work(t) for t = 0 ... threads() - 1, each in a thread of its own, t = 0 in the caller's, and returns when
  /// all are done. `work` must not throw. One call at a time.
  template <typename Work>
  void run(const Work& work)
  {
    run_all({ &work, [](const void* given, int part) { (*static_cast<const Work*>(given))(part); } });
  }

private:
  /// A function without the allocation that std::function may make.
  struct Task
  {
    const void* work = nullptr;
    void (*call)(const void* work, int part) = nullptr;
  };

  void run_all(const Task& task);

  struct Members;
  std::unique_ptr<Members> members_;
};

/// The threads that a machine lets this process use at the same time, 1 at least.
int usable_threads();

}  // namespace cloth
