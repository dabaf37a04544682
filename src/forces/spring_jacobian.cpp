#include "cloth_sim/forces/spring_jacobian.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"
#include "spring_blocks.h"

namespace cloth
{
namespace
{

/// Calls work(done, i, n) for the blocks of a batch: n springs, the first of which joins i and i + offset, after `done`
/// springs of the batch.
template <typename Work>
void for_each_counted_block(const SpringBatch& batch, Work&& work)
{
  int done = 0;
  for_each_block(batch, [&](int i, int n) {
    work(done, i, n);
    done += n;
  });
}

}  // namespace

void SpringJacobian::linearise(const ClothModel& model, const Vectors& positions, double stiffness_factor,
                               double damping_factor, const Eigen::ArrayXd& capacities)
{
  batches_.resize(model.springs.size());
  negative_sums_.setZero(model.nodes());
  for (size_t b = 0; b < batches_.size(); ++b)
  {
    count_call(model.springs[b]);
    batches_[b].batch = model.springs[b];
    take_directions(positions, stiffness_factor, batches_[b]);
  }
  const Eigen::ArrayXd kept_parts = (0.5 * capacities / negative_sums_).min(1.0);
  for (LinearisedBatch& linearised : batches_)
  {
    cut_negative_stiffness(kept_parts, linearised);
    scale_directions(stiffness_factor * linearised.batch.stiffness + damping_factor * linearised.batch.damping,
                     linearised);
  }
}

void SpringJacobian::take_directions(const Vectors& positions, double stiffness_factor, LinearisedBatch& linearised)
{
  const SpringBatch& batch = linearised.batch;
  const size_t size = static_cast<size_t>(batch.size());
  for (std::vector<double>* const values : { &linearised.across, &linearised.w_x, &linearised.w_y, &linearised.w_z })
  {
    values->resize(size);
  }
  for_each_counted_block(batch, [&](int done, int i, int n) {
    double* const across = linearised.across.data() + done;
    double* const w_x = linearised.w_x.data() + done;
    double* const w_y = linearised.w_y.data() + done;
    double* const w_z = linearised.w_z.data() + done;
    const Differences lengths(positions, i, batch.offset);
    for (int s = 0; s < n; ++s)
    {
      const Vector l = lengths[s];
      const double inverse = inverse_length<false>(l);
      across[s] = stiffness_factor * batch.stiffness * (1.0 - batch.rest_length * inverse);
      w_x[s] = inverse * l.x;
      w_y[s] = inverse * l.y;
      w_z[s] = inverse * l.z;
    }
    double* const first = negative_sums_.data() + i;
    double* const second = first + batch.offset;
    for (int s = 0; s < n; ++s)
    {
      first[s] += std::max(0.0, -across[s]);
    }
    for (int s = 0; s < n; ++s)
    {
      second[s] += std::max(0.0, -across[s]);
    }
  });
}

void SpringJacobian::cut_negative_stiffness(const Eigen::ArrayXd& kept_parts, LinearisedBatch& linearised) const
{
  const int offset = linearised.batch.offset;
  for_each_counted_block(linearised.batch, [&](int done, int i, int n) {
    double* const across = linearised.across.data() + done;
    const double* const first = kept_parts.data() + i;
    for (int s = 0; s < n; ++s)
    {
      across[s] = across[s] < 0.0 ? across[s] * std::min(first[s], first[s + offset]) : across[s];
    }
  });
}

void SpringJacobian::scale_directions(double along, LinearisedBatch& linearised)
{
  for (size_t s = 0; s < linearised.across.size(); ++s)
  {
    const double scale = std::sqrt(along - linearised.across[s]);
    linearised.w_x[s] *= scale;
    linearised.w_y[s] *= scale;
    linearised.w_z[s] *= scale;
  }
}

void SpringJacobian::add_product(const Vectors& u, Vectors& product) const
{
  in_widest_vectors([&](auto) {
    Block change;
    for (const LinearisedBatch& linearised : batches_)
    {
      const SpringBatch& batch = linearised.batch;
      count_call(batch);
      for_each_counted_block(batch, [&](int done, int i, int n) {
        const double* const across = linearised.across.data() + done;
        const double* const w_x = linearised.w_x.data() + done;
        const double* const w_y = linearised.w_y.data() + done;
        const double* const w_z = linearised.w_z.data() + done;
        const Differences approaches(u, i, batch.offset);
        // The compiler cannot see that `change` overlaps none of what is read.
#pragma GCC ivdep
        for (int s = 0; s < n; ++s)
        {
          const Vector d = approaches[s];
          const double along = w_x[s] * d.x + w_y[s] * d.y + w_z[s] * d.z;
          change.x[s] = -(across[s] * d.x + along * w_x[s]);
          change.y[s] = -(across[s] * d.y + along * w_y[s]);
          change.z[s] = -(across[s] * d.z + along * w_z[s]);
        }
        add_to_both_ends(change, i, batch.offset, n, product);
      });
    }
  });
}

}  // namespace cloth
