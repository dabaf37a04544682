#include "plain_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cloth
{

PlainSheet::PlainSheet(int nodes_a_side, double side, double mass, double air_damping, Springs structural,
                       Springs shear, Springs flex)
  : n_(nodes_a_side), nodes_(n_ * n_), air_damping_(air_damping * side * side)
{
  const double spacing = side / (n_ - 1);
  for (std::vector<double>* const vectors : { &positions, &velocities, &accelerations_, &predicted_, &forces_ })
  {
    vectors->assign(3 * static_cast<std::size_t>(nodes_), 0.0);
  }
  for (std::vector<double>* const row : { &row_x_, &row_y_, &row_z_ })
  {
    row->assign(static_cast<std::size_t>(n_), 0.0);
  }
  double sum = 0.0;
  for (int r = 0; r < n_; ++r)
  {
    for (int c = 0; c < n_; ++c)
    {
      const double share = (r % (n_ - 1) == 0 ? 0.5 : 1.0) * (c % (n_ - 1) == 0 ? 0.5 : 1.0);
      shares_.push_back(share);
      sum += share;
    }
  }
  for (double& share : shares_)
  {
    share /= sum;
    masses_.push_back(mass * share);
  }
  const auto add = [&](int down, int across, const Springs& springs) {
    if (springs.stiffness > 0.0)
    {
      directions_.push_back({ down, across, springs.stiffness, springs.damping, spacing * std::hypot(down, across) });
    }
  };
  add(0, 1, structural);
  add(1, 0, structural);
  add(1, 1, shear);
  add(1, -1, shear);
  add(0, 2, flex);
  add(2, 0, flex);
}

std::size_t PlainSheet::springs() const
{
  std::size_t count = 0;
  for (const Direction& direction : directions_)
  {
    count += static_cast<std::size_t>(n_ - direction.down) * static_cast<std::size_t>(n_ - std::abs(direction.across));
  }
  return count;
}

void PlainSheet::step(double h)
{
  for (int i = 0; i < 3 * nodes_; ++i)
  {
    predicted_[i] = velocities[i] + h * accelerations_[i];
    velocities[i] += 0.5 * h * accelerations_[i];
    positions[i] += h * velocities[i];
  }
  hold_corners(predicted_);
  for (int d = 0; d < 3; ++d)
  {
    const double gravity = d == 2 ? -9.81 : 0.0;
    for (int i = 0; i < nodes_; ++i)
    {
      forces_[d * nodes_ + i] = gravity * masses_[i];
    }
  }
  for (const Direction& direction : directions_)
  {
    add_spring_forces(direction);
  }
  for (int i = 0; i < nodes_; ++i)
  {
    const double damping = air_damping_ * shares_[i];
    const double inverse_inertia = 1.0 / (masses_[i] + 0.5 * h * damping);
    for (int e = i; e < 3 * nodes_; e += nodes_)
    {
      accelerations_[e] = inverse_inertia * (forces_[e] - damping * velocities[e]);
      velocities[e] += 0.5 * h * accelerations_[e];
    }
  }
  hold_corners(accelerations_);
  hold_corners(velocities);
}

template <bool damped>
void PlainSheet::find_row_forces(const Direction& direction, int i, int count)
{
  const int offset = direction.down * n_ + direction.across;
  const double* const x = positions.data() + i;
  const double* const y = x + nodes_;
  const double* const z = y + nodes_;
  const double* const v_x = predicted_.data() + i;
  const double* const v_y = v_x + nodes_;
  const double* const v_z = v_y + nodes_;
  double* const row_x = row_x_.data();
  double* const row_y = row_y_.data();
  double* const row_z = row_z_.data();
  const double k = direction.stiffness;
  const double c = direction.damping;
  const double l0 = direction.rest_length;
  // Or the compiler doubts that the rows are apart from what is read, and does one spring after the other.
#pragma GCC ivdep
  for (int s = 0; s < count; ++s)
  {
    const double l_x = x[s + offset] - x[s];
    const double l_y = y[s + offset] - y[s];
    const double l_z = z[s + offset] - z[s];
    const double inverse = 1.0 / std::sqrt(l_x * l_x + l_y * l_y + l_z * l_z);
    const double approach =
        !damped ?
            0.0 :
            ((v_x[s + offset] - v_x[s]) * l_x + (v_y[s + offset] - v_y[s]) * l_y + (v_z[s + offset] - v_z[s]) * l_z) *
                inverse;
    const double factor = k + (c * approach - k * l0) * inverse;
    row_x[s] = factor * l_x;
    row_y[s] = factor * l_y;
    row_z[s] = factor * l_z;
  }
}

void PlainSheet::add_spring_forces(const Direction& direction)
{
  const int offset = direction.down * n_ + direction.across;
  const int count = n_ - std::abs(direction.across);
  for (int r = 0; r + direction.down < n_; ++r)
  {
    const int i = r * n_ + std::max(0, -direction.across);
    if (direction.damping == 0.0)
    {
      find_row_forces<false>(direction, i, count);
    }
    else
    {
      find_row_forces<true>(direction, i, count);
    }
    const std::vector<double>* const rows[] = { &row_x_, &row_y_, &row_z_ };
    for (int d = 0; d < 3; ++d)
    {
      const double* const row = rows[d]->data();
      double* const forces = forces_.data() + d * nodes_ + i;
      for (int s = 0; s < count; ++s)
      {
        forces[s] += row[s];
      }
      for (int s = 0; s < count; ++s)
      {
        forces[s + offset] -= row[s];
      }
    }
  }
}

void PlainSheet::hold_corners(std::vector<double>& vectors) const
{
  for (int d = 0; d < 3; ++d)
  {
    vectors[d * nodes_] = 0.0;
    vectors[d * nodes_ + n_ - 1] = 0.0;
  }
}

}  // namespace cloth
