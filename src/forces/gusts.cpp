#include "cloth_sim/forces/gusts.h"

#include <cmath>
#include <random>

namespace cloth
{
namespace
{

constexpr double pi = 3.141592653589793;

}  // namespace

Gusts::Gusts(const GustProperties& properties) : amplitude_(properties.strength * std::sqrt(2.0 / waves))
{
  std::mt19937 generator(static_cast<std::mt19937::result_type>(properties.seed));
  const auto part = [&] { return static_cast<double>(generator()) / (static_cast<double>(std::mt19937::max()) + 1.0); };
  for (int d = 0; d < 3; ++d)
  {
    for (int k = 0; k < waves; ++k)
    {
      const double u = ((d + k) % 3 + 0.25 + 0.5 * part()) / 3.0;
      Wave& wave = waves_[static_cast<size_t>(d)][static_cast<size_t>(k)];
      wave.frequency = std::tan(0.5 * pi * (k + u) / (waves + 1)) / properties.time_scale;
      wave.phase = 2.0 * pi * part();
    }
  }
}

Eigen::Vector3d Gusts::at(double time) const
{
  Eigen::Vector3d gust = Eigen::Vector3d::Zero();
  if (amplitude_ == 0.0)
  {
    return gust;
  }
  for (int d = 0; d < 3; ++d)
  {
    for (const Wave& wave : waves_[static_cast<size_t>(d)])
    {
      gust[d] += amplitude_ * std::sin(wave.frequency * time + wave.phase);
    }
  }
  return gust;
}

double Gusts::top_speed() const
{
  return std::sqrt(3.0) * waves * amplitude_;
}

}  // namespace cloth
