#pragma once

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>

namespace cloth
{

/// Messages of one stream that are published as shared pointers, so that listeners in the same process get them
/// uncopied. The memory of one is used again when nobody else holds it any more. For one thread.
template <typename Message>
class ReusedMessages
{
public:
  using Pointer = boost::shared_ptr<Message>;
  /// Those that a listener keeps beyond so many are left to it.
  static constexpr size_t most_kept = 8;

  /// Every message begins as a copy of `first`, or of a later one.
  explicit ReusedMessages(const Message& first = {}) : messages_{ boost::make_shared<Message>(first) }
  {
  }

  /// A message that nobody else holds, to be filled and published; its contents are those of an earlier one.
  Pointer take()
  {
    const auto free = std::find_if(messages_.begin(), messages_.end(),
                                   [](const Pointer& message) { return message.use_count() == 1; });
    if (free != messages_.end())
    {
      std::atomic_thread_fence(std::memory_order_acquire);  // what others read of it, they read before they let it go
      std::rotate(free, free + 1, messages_.end());
      return messages_.back();
    }
    if (messages_.size() == most_kept)
    {
      messages_.erase(messages_.begin());
    }
    messages_.push_back(boost::make_shared<Message>(*messages_.back()));
    return messages_.back();
  }

private:
  std::vector<Pointer> messages_;  ///< the latest last
};

}  // namespace cloth
