#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace cloth
{

/// Memory that begins where a vector register does: loads that lie across two lines of the cache take twice as long.
template <typename Scalar>
struct AlignedAllocator
{
  using value_type = Scalar;

  AlignedAllocator() = default;
  template <typename Other>
  AlignedAllocator(const AlignedAllocator<Other>& /*other*/)
  {
  }

  Scalar* allocate(std::size_t n)
  {
    return static_cast<Scalar*>(::operator new(n * sizeof(Scalar), alignment));
  }
  void deallocate(Scalar* memory, std::size_t /*n*/)
  {
    ::operator delete(memory, alignment);
  }
  friend bool operator==(const AlignedAllocator& /*a*/, const AlignedAllocator& /*b*/)
  {
    return true;
  }
  friend bool operator!=(const AlignedAllocator& /*a*/, const AlignedAllocator& /*b*/)
  {
    return false;
  }

  static constexpr std::align_val_t alignment{ 64 };
};

template <typename Scalar>
using AlignedNumbers = std::vector<Scalar, AlignedAllocator<Scalar>>;

}  // namespace cloth
