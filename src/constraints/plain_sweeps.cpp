#include "plain_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cloth_sim/model/part_calls.h"

namespace cloth
{
namespace
{

/// Springs are looked at in blocks: whether any of a block is too long is a loop that vectorises, and most blocks are
/// passed over. Nodes are grouped in blocks of the same size.
constexpr int block_size = 32;

/// Passes over limited springs. A block of springs that was found within the limit is looked at again only after one of
/// its nodes has moved.
class Sweeps
{
public:
  /// `shifts`, unless null, gets what the held ends of springs were spared: their mass times way, kg m.
  Sweeps(const std::vector<SpringBatch>& batches, double max_strain, const Eigen::VectorXd& inverse_masses,
         Vectors& positions, Vectors* shifts)
    : batches_(batches)
    , max_strain_(max_strain)
    , inverse_masses_(inverse_masses)
    , x_(positions.col(0).data())
    , y_(positions.col(1).data())
    , z_(positions.col(2).data())
    , shifts_(shifts)
    , moved_at_(static_cast<size_t>(positions.rows() / block_size + 1), 0)
  {
    for (const SpringBatch& batch : batches_)
    {
      found_short_at_.emplace_back(static_cast<size_t>(blocks_of(batch)), -1);
    }
  }

  /// Makes one pass. True: a spring was too long and was shortened.
  bool run(bool backwards)
  {
    corrected_ = false;
    const int batches = static_cast<int>(batches_.size());
    for (int b = 0; b < batches; ++b)
    {
      const size_t batch = static_cast<size_t>(backwards ? batches - 1 - b : b);
      run(batches_[batch], found_short_at_[batch], backwards);
    }
    ++part_calls()[Part::strain_watch];
    part_calls()[Part::strain_limit] += corrected_ ? 1 : 0;
    return corrected_;
  }

private:
  static int blocks_a_row(const SpringBatch& batch)
  {
    return (batch.cols + block_size - 1) / block_size;
  }

  static int blocks_of(const SpringBatch& batch)
  {
    return batch.rows * blocks_a_row(batch);
  }

  void run(const SpringBatch& batch, std::vector<long>& found_short_at, bool backwards)
  {
    limit_ = batch.rest_length * (1.0 + max_strain_);
    const double too_long = batch.rest_length * (1.0 + max_strain_ * (1.0 + StrainLimit::tolerance));
    squared_too_long_ = too_long * too_long;
    const int blocks = blocks_of(batch);
    for (int b = 0; b < blocks; ++b)
    {
      const int block = backwards ? blocks - 1 - b : b;
      const int done = block % blocks_a_row(batch) * block_size;
      const int begin = batch.first + block / blocks_a_row(batch) * batch.row_stride + done;
      const int n = std::min(block_size, batch.cols - done);
      ++now_;
      long& found_short = found_short_at[static_cast<size_t>(block)];
      if (last_move(begin, n) < found_short && last_move(begin + batch.offset, n) < found_short)
      {
        continue;
      }
      if (any_too_long(begin, batch.offset, n))
      {
        for (int s = 0; s < n; ++s)
        {
          const int i = begin + (backwards ? n - 1 - s : s);
          shorten(i, i + batch.offset);
        }
      }
      else
      {
        found_short = now_;
      }
    }
  }

  /// When one of the n nodes from `begin` on, or of their blocks, moved last.
  long last_move(int begin, int n) const
  {
    const size_t first = static_cast<size_t>(begin / block_size);
    const size_t last = static_cast<size_t>((begin + n - 1) / block_size);
    return std::max(moved_at_[first], moved_at_[last]);
  }

  double squared_length(int i, int j) const
  {
    const double x = x_[j] - x_[i];
    const double y = y_[j] - y_[i];
    const double z = z_[j] - z_[i];
    return x * x + y * y + z * z;
  }

  bool any_too_long(int begin, int offset, int n) const
  {
    std::int64_t any = 0;
    for (int i = begin; i < begin + n; ++i)
    {
      any |= squared_length(i, i + offset) > squared_too_long_ ? 1 : 0;
    }
    return any != 0;
  }

  /// Moves the ends of a spring that is too long along it until its strain is max_strain; the ends share the way by
  /// inverse mass.
  void shorten(int i, int j)
  {
    const double squared = squared_length(i, j);
    const double inverse_masses = inverse_masses_[i] + inverse_masses_[j];
    if (squared <= squared_too_long_ || inverse_masses == 0.0)
    {
      return;
    }
    const double part = (1.0 - limit_ / std::sqrt(squared)) / inverse_masses;
    if (shifts_ != nullptr)
    {
      const Eigen::RowVector3d pull(x_[j] - x_[i], y_[j] - y_[i], z_[j] - z_[i]);
      shifts_->row(i) += part * pull;
      shifts_->row(j) -= part * pull;
    }
    const double share_i = part * inverse_masses_[i];
    const double share_j = part * inverse_masses_[j];
    for (double* const column : { x_, y_, z_ })
    {
      const double difference = column[j] - column[i];
      column[i] += share_i * difference;
      column[j] -= share_j * difference;
    }
    moved_at_[static_cast<size_t>(i / block_size)] = now_;
    moved_at_[static_cast<size_t>(j / block_size)] = now_;
    corrected_ = true;
  }

  const std::vector<SpringBatch>& batches_;
  const double max_strain_;
  const Eigen::VectorXd& inverse_masses_;
  double* const x_;
  double* const y_;
  double* const z_;
  Vectors* const shifts_;
  long now_ = 0;  ///< counts the blocks looked at
  std::vector<long> moved_at_;
  std::vector<std::vector<long>> found_short_at_;
  double limit_ = 0.0;
  double squared_too_long_ = 0.0;
  bool corrected_ = false;
};

}  // namespace

PlainSweeps::PlainSweeps(const ClothModel& model) : batches_(limited_batches(model))
{
}

StrainLimit::Report PlainSweeps::shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes,
                                         double /*h*/, Vectors& positions, Vectors* shifts)
{
  Sweeps sweeps(batches_, max_strain, inverse_masses, positions, shifts);
  StrainLimit::Report report;
  bool corrected = true;
  while (corrected && report.sweeps < passes)
  {
    const bool backwards = report.sweeps % 2 == 1;
    corrected = sweeps.run(backwards);
    report.moved = report.moved || corrected;
    ++report.sweeps;
  }
  report.reached = !corrected;
  return report;
}

}  // namespace cloth
