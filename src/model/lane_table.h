#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aligned_vectors.h"
#include "lane_nodes.h"

namespace cloth
{

/// 16 numbers for each run of springs. Most runs of a sheet have the same, which are kept once: they stay in the
/// nearest cache.
class LaneTable
{
public:
  using Row = std::array<float, lanes>;

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

/// number(w) of the springs of a run, w being the sum of their ends' inverse masses; 0 where there is no spring, and
/// where both ends are held.
template <typename Number>
LaneTable::Row numbers_of_springs(const LaneNodes& nodes, const LaneRun& run, Number&& number)
{
  const float* const i = nodes.data() + LaneNodes::place_of(run.i);
  const float* const j = nodes.data() + LaneNodes::place_of(run.j);
  LaneTable::Row row{};
  for (int k = 0; k < run.n; ++k)
  {
    const float w = i[lane_node::inverse_mass + k] + j[lane_node::inverse_mass + k];
    row[static_cast<size_t>(k)] = w > 0.0F ? number(w) : 0.0F;
  }
  return row;
}

}  // namespace cloth
