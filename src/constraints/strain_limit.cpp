#include "cloth_sim/constraints/strain_limit.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// Springs are looked at in blocks: whether any of a block is too long is a loop that vectorises, and most blocks are
/// passed over.
constexpr int block_size = 32;

/// One pass over the limited springs of a model.
class Sweep
{
public:
  Sweep(double max_strain, const std::vector<double>& inverse_masses, Vectors& positions)
    : max_strain_(max_strain)
    , inverse_masses_(inverse_masses)
    , x_(positions.col(0).data())
    , y_(positions.col(1).data())
    , z_(positions.col(2).data())
  {
  }

  /// True: a spring was too long and was shortened.
  bool run(const std::vector<SpringBatch>& batches, bool backwards)
  {
    corrected_ = false;
    const int last = static_cast<int>(batches.size()) - 1;
    for (int b = 0; b <= last; ++b)
    {
      const SpringBatch& batch = batches[static_cast<size_t>(backwards ? last - b : b)];
      if (batch.kind != SpringKind::flex)
      {
        run(batch, backwards);
      }
    }
    return corrected_;
  }

private:
  void run(const SpringBatch& batch, bool backwards)
  {
    limit_ = batch.rest_length * (1.0 + max_strain_);
    const double too_long = batch.rest_length * (1.0 + max_strain_ * (1.0 + StrainLimit::tolerance));
    squared_too_long_ = too_long * too_long;
    const int blocks_a_row = (batch.cols + block_size - 1) / block_size;
    const int blocks = batch.rows * blocks_a_row;
    for (int b = 0; b < blocks; ++b)
    {
      const int block = backwards ? blocks - 1 - b : b;
      const int done = block % blocks_a_row * block_size;
      const int begin = batch.first + block / blocks_a_row * batch.row_stride + done;
      const int n = std::min(block_size, batch.cols - done);
      if (any_too_long(begin, batch.offset, n))
      {
        for (int s = 0; s < n; ++s)
        {
          const int i = begin + (backwards ? n - 1 - s : s);
          shorten(i, i + batch.offset);
        }
      }
    }
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
    double longest = 0.0;
    for (int i = begin; i < begin + n; ++i)
    {
      longest = std::max(longest, squared_length(i, i + offset));
    }
    return longest > squared_too_long_;
  }

  /// Moves the ends of a spring that is too long along it until its strain is max_strain; the ends share the way by
  /// inverse mass.
  void shorten(int i, int j)
  {
    const double squared = squared_length(i, j);
    const double inverse_masses = inverse_masses_[static_cast<size_t>(i)] + inverse_masses_[static_cast<size_t>(j)];
    if (squared <= squared_too_long_ || inverse_masses == 0.0)
    {
      return;
    }
    const double part = (1.0 - limit_ / std::sqrt(squared)) / inverse_masses;
    const double share_i = part * inverse_masses_[static_cast<size_t>(i)];
    const double share_j = part * inverse_masses_[static_cast<size_t>(j)];
    for (double* const column : { x_, y_, z_ })
    {
      const double difference = column[j] - column[i];
      column[i] += share_i * difference;
      column[j] -= share_j * difference;
    }
    corrected_ = true;
  }

  const double max_strain_;
  const std::vector<double>& inverse_masses_;
  double* const x_;
  double* const y_;
  double* const z_;
  double limit_ = 0.0;
  double squared_too_long_ = 0.0;
  bool corrected_ = false;
};

}  // namespace

StrainLimit::StrainLimit(const ClothModel& model, const StrainLimitProperties& properties) : properties_(properties)
{
  inverse_masses_.resize(static_cast<size_t>(model.nodes()));
}

StrainLimit::Report StrainLimit::apply(const ClothModel& model, const Pins& pins, double h, ClothState& state)
{
  for (int i = 0; i < model.nodes(); ++i)
  {
    inverse_masses_[static_cast<size_t>(i)] = pins.holds(i) ? 0.0 : 1.0 / model.masses[i];
  }
  uncorrected_ = state.positions;
  Sweep sweep(properties_.max_strain, inverse_masses_, state.positions);
  Report report;
  bool corrected = true;
  while (corrected && report.sweeps < properties_.sweeps)
  {
    const bool backwards = report.sweeps % 2 == 1;
    corrected = sweep.run(model.springs, backwards);
    report.moved = report.moved || corrected;
    ++report.sweeps;
  }
  report.reached = !corrected;
  if (report.moved)
  {
    state.velocities += (state.positions - uncorrected_) / h;
  }
  return report;
}

}  // namespace cloth
