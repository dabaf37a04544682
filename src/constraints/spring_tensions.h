#pragma once

#include "cloth_sim/model/cloth_model.h"

#include "shortening.h"
#include "tension_passes.h"

namespace cloth
{

/// The shortest correction that obeys the limit: the positions closest to those given, by the sum of m |x' - x|^2,
/// among all in which no limited spring is longer than l_max. A spring's length is a convex function of the positions,
/// so that there is one such correction, and it is made of tensions: with one vector p along every spring that is as
/// long as it may be, and p = 0 for all others,
///
///   x'_i = x_i + (sum over its springs of p, towards the other end) / m_i
///
/// A pass visits spring after spring and gives each the tension that would be right if all others were,
///
///   d = l + (1/m_i + 1/m_j) p,   p <- max(0, 1 - l_max/|d|) d / (1/m_i + 1/m_j)
///
/// which is coordinate ascent on the dual problem (Hildreth 1957, Dykstra 1983 for convex sets): a visit to a spring
/// without tension is Provot's shortening of it, and what it did too much is given back later. The tensions of the last
/// step are the first guess at the next one's, as p ~ h^2 times a force that changes slowly; most of the work is done
/// by then, whatever the grid. As vectors they keep the guess stable: it is a correction that was right, not a force
/// along springs that have turned.
class SpringTensions : public Shortening
{
public:
  explicit SpringTensions(const ClothModel& model);

  StrainLimit::Report shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes, Vectors& positions,
                              Vectors* shifts) override;
  void go_on_from(const Shortening& before) override;

private:
  TensionPasses<double> passes_;
};

}  // namespace cloth
