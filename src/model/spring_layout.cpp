#include "spring_layout.h"

#include <algorithm>
#include <cstdlib>

#include "cloth_sim/model/spring_rows.h"

namespace cloth
{

std::vector<SpringRun> runs_by_rows(const std::vector<SpringBatch>& batches, int rows)
{
  std::vector<SpringRun> runs;
  for (int r = 0; r < rows; ++r)
  {
    for (size_t b = 0; b < batches.size(); ++b)
    {
      const SpringBatch& batch = batches[b];
      for (int done = 0; r < batch.rows && done < batch.cols; done += spring_row_size)
      {
        runs.push_back({ b, batch.first + r * batch.row_stride + done, batch.offset,
                         std::min(spring_row_size, batch.cols - done) });
      }
    }
  }
  return runs;
}

// Springs reach two columns. Where they go on from a row's last vectors to its first, a lane further, what is loaded and
// stored for the second ends takes in some of the vector of nodes behind them, which must not be the first ends': hence
// four vectors at least.
LaneLayout::LaneLayout(const ClothModel& model)
  : rows_(model.rows), cols_(model.cols), vectors_a_row_(std::max(4, (model.cols + lanes - 1) / lanes))
{
}

LaneLayout::Way LaneLayout::way_of(const SpringBatch& batch) const
{
  switch (batch.kind)
  {
    case SpringKind::structural:
      return batch.offset == cols_ ? Way{ 1, 0 } : Way{ 0, 1 };
    case SpringKind::shear:
      return batch.offset == cols_ + 1 ? Way{ 1, 1 } : Way{ 1, -1 };
    case SpringKind::flex:
      break;
  }
  return batch.offset == 2 * cols_ ? Way{ 2, 0 } : Way{ 0, 2 };
}

SpringRun LaneLayout::run_from(Way way, int row, int vector) const
{
  const int across = std::abs(way.across);
  const int down = way.across < 0 ? -way.down : way.down;  // from the end further left
  const int begin = way.across < 0 ? row + way.down : row;
  const bool wraps = vector + across >= vectors_a_row_;
  const int vectors_on = down * vectors_a_row_ + across - (wraps ? vectors_a_row_ : 0);
  const int columns = std::max(0, cols_ - across - vector);
  return { 0, (begin * vectors_a_row_ + vector) * lanes, vectors_on * lanes + (wraps ? 1 : 0),
           std::min(lanes, (columns + vectors_a_row_ - 1) / vectors_a_row_) };
}

std::vector<SpringRun> LaneLayout::runs(const std::vector<SpringBatch>& batches, int rows_a_band) const
{
  std::vector<SpringRun> runs;
  for (int band = 0; band < rows_; band += rows_a_band)
  {
    for (size_t b = 0; b < batches.size(); ++b)
    {
      const Way way = way_of(batches[b]);
      const int end = std::min(band + rows_a_band, rows_ - way.down);
      const int reach = way.down > 0 ? way.down : std::abs(way.across);
      for (const int colour : { 0, 1 })
      {
        for (int row = band; row < end; ++row)
        {
          for (int vector = 0; vector < vectors_a_row_; ++vector)
          {
            SpringRun run = run_from(way, row, vector);
            run.batch = b;
            if (run.n > 0 && (way.down > 0 ? row : vector) / reach % 2 == colour)
            {
              runs.push_back(run);
            }
          }
        }
      }
    }
  }
  return runs;
}

}  // namespace cloth
