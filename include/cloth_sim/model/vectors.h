#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "cloth_sim/model/aligned_numbers.h"

namespace cloth
{

/// One 3-vector a node: n rows, and the columns x, y, z each contiguous in memory (structure of arrays). Memory begins
/// where the widest vector register does, whatever the machine that a program is built for: Eigen itself aligns to what
/// that one needs, and steps would take an eighth longer.
///
/// DontAlign says that Eigen leaves it to the storage below; it makes this a type of its own, so that nothing else in a
/// program is touched.
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::DontAlign>;

}  // namespace cloth

/// The memory of cloth::Vectors, with what Eigen asks of every DenseStorage. Throws std::bad_alloc where there is no
/// more.
template <>
class Eigen::DenseStorage<double, Eigen::Dynamic, Eigen::Dynamic, 3, Eigen::DontAlign>
{
public:
  DenseStorage() = default;
  explicit DenseStorage(internal::constructor_without_unaligned_array_assert /*tag*/)
  {
  }
  DenseStorage(Index size, Index /*rows*/, Index /*cols*/) : numbers_(static_cast<std::size_t>(size))
  {
  }

  void swap(DenseStorage& other)
  {
    numbers_.swap(other.numbers_);
  }
  Index rows() const
  {
    return static_cast<Index>(numbers_.size()) / cols();
  }
  static Index cols()
  {
    return 3;
  }
  void resize(Index size, Index /*rows*/, Index /*cols*/)
  {
    numbers_.resize(static_cast<std::size_t>(size));
  }
  void conservativeResize(Index size, Index rows, Index cols)
  {
    resize(size, rows, cols);
  }
  const double* data() const
  {
    return numbers_.data();
  }
  double* data()
  {
    return numbers_.data();
  }

private:
  cloth::AlignedNumbers<double> numbers_;
};
