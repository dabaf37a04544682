#include "refusal_log.h"

#include <iterator>
#include <utility>

namespace cloth
{

RefusalLog::RefusalLog(std::function<void(const std::string&)> warn) : warn_(std::move(warn))
{
}

void RefusalLog::report(const std::string& whole_cause, Clock::time_point now)
{
  const std::string cause =
      whole_cause.size() <= longest_cause ? whole_cause : whole_cause.substr(0, longest_cause) + "...";
  const std::lock_guard<std::mutex> lock(mutex_);
  forget_before(now - quiet_time);
  if (warned_.size() >= max_causes || !warned_.emplace(cause, now).second)
  {
    return;
  }
  warn_(warned_.size() < max_causes ? cause : cause + " (further refusals are not shown for a few seconds)");
}

void RefusalLog::forget_before(Clock::time_point time)
{
  for (auto entry = warned_.begin(); entry != warned_.end();)
  {
    entry = entry->second <= time ? warned_.erase(entry) : std::next(entry);
  }
}

}  // namespace cloth
