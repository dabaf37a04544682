#pragma once

#include <string>

namespace cloth
{

/// Who subscribes to a topic of a node and then never reads.
class StalledListener
{
public:
  /// Connects to `topic` of `node`, both with their namespaces. Throws std::runtime_error where that fails.
  StalledListener(const std::string& node, const std::string& topic);
  ~StalledListener();
  StalledListener(const StalledListener&) = delete;
  StalledListener& operator=(const StalledListener&) = delete;

private:
  int socket_ = -1;
};

}  // namespace cloth
