#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aligned_vectors.h"

namespace cloth
{

/// 16 numbers for each run of springs. Most runs of a sheet have the same, which are kept once: they stay in the nearest
/// cache.
class LaneTable
{
public:
  using Row = std::array<float, row_padding>;

  void clear()
  {
    begins_.clear();
    rows_.clear();
  }

  void add(const Row& row)
  {
    const size_t most = std::min(rows_.size(), farthest_looked_back * row.size());
    for (size_t back = row.size(); back <= most; back += row.size())
    {
      const size_t begin = rows_.size() - back;
      if (std::equal(row.begin(), row.end(), rows_.begin() + static_cast<std::ptrdiff_t>(begin)))
      {
        begins_.push_back(static_cast<std::uint32_t>(begin));
        return;
      }
    }
    begins_.push_back(static_cast<std::uint32_t>(rows_.size()));
    rows_.insert(rows_.end(), row.begin(), row.end());
  }

  /// Of the run that was added as number `run`.
  const float* operator[](size_t run) const
  {
    return rows_.data() + begins_[run];
  }

private:
  static constexpr size_t farthest_looked_back = 64;

  std::vector<std::uint32_t> begins_;
  AlignedNumbers<float> rows_;
};

}  // namespace cloth
