#pragma once

#include "cloth_sim/model/aligned_numbers.h"
#include "cloth_sim/model/spring_rows.h"

namespace cloth
{

/// Vectors by columns, each of which begins where a vector register does.
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
