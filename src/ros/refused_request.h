#pragma once

#include <stdexcept>

namespace cloth
{

/// A message from outside that cannot be obeyed: what is wrong with it, in a sentence for the log.
class RefusedRequest : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

}  // namespace cloth
