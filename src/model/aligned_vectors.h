#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "cloth_sim/model/spring_rows.h"

namespace cloth
{

/// Memory that begins where a vector register does.
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

/// Vectors by columns, each of which begins where a vector register does: loads that lie across two lines of the cache
/// take twice as long.
template <typename Scalar>
class AlignedVectors
{
public:
  /// All zero, with room for `row_padding` more.
  void set_zero(int n)
  {
    stride_ = (n + 2 * row_padding - 1) / row_padding * row_padding;
    values_.assign(static_cast<size_t>(3 * stride_), Scalar(0));
  }

  int size() const
  {
    return stride_ - row_padding;
  }

  /// From the vector of this number on.
  Columns<Scalar> from(int first)
  {
    Scalar* const begin = values_.data() + first;
    return { begin, begin + stride_, begin + 2 * stride_ };
  }
  Columns<const Scalar> from(int first) const
  {
    const Scalar* const begin = values_.data() + first;
    return { begin, begin + stride_, begin + 2 * stride_ };
  }

private:
  int stride_ = 0;
  AlignedNumbers<Scalar> values_;
};

}  // namespace cloth
