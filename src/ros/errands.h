#pragma once

#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <vector>

namespace cloth
{

/// What a service answers.
struct Answer
{
  bool success = true;
  std::string message;
};

/// Work that callbacks want the thread of the simulation to do, and whose answer they wait for. That thread never waits
/// for a callback, so that the two cannot lock each other.
class Errands
{
public:
  using Errand = std::function<Answer()>;

  /// While it lives, the thread that holds it is to do the errands; when it goes, those that wait are refused, and all
  /// that come later.
  class Doer
  {
  public:
    explicit Doer(Errands& errands) : errands_(errands)
    {
    }
    ~Doer()
    {
      errands_.close();
    }
    Doer(const Doer&) = delete;
    Doer& operator=(const Doer&) = delete;

  private:
    Errands& errands_;
  };

  /// Has `errand` done, and waits for its answer; throws what it throws. From any thread but the doer's.
  Answer send(Errand errand);

  /// Does all that waits, in the order in which it came. For the doer's thread alone.
  void do_all();

  /// Whether any errand waits to be done.
  bool any_waiting() const;

private:
  void close();

  mutable std::mutex mutex_;
  std::vector<std::packaged_task<Answer()>> waiting_;
  bool closed_ = false;
};

}  // namespace cloth
