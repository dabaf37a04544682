#pragma once

#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "../model/aligned_vectors.h"
#include "../model/spring_layout.h"
#include "dual_parabola.h"
#include "momentum.h"
#include "shortening.h"
#include "spring_tethers.h"

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
/// along springs that have turned. Tethers to the held nodes are springs like the others, visited once, before the
/// passes. Where two passes are not enough, the others have momentum.
class SpringTensions : public Shortening
{
public:
  explicit SpringTensions(const ClothModel& model);

  StrainLimit::Report shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes, double h,
                              Vectors& positions, Vectors* shifts) override;
  void go_on_from(const Shortening& before) override;

private:
  /// Made in every step in which springs are taut: one alone leaves a sheet restless.
  static constexpr int there_and_back = 2;
  /// The margin (StrainLimit::least_margin) grows while steps need more passes than these and dies away while they do
  /// not. Within a step it stays the same.
  static constexpr double margin_growth = 1.5;
  static constexpr double margin_decay = 0.98;
  static constexpr double margin_speed = 1.0;  ///< 1/s, at most: springs that are tightened faster shake the sheet
  /// The most by which tensions grow before a step's passes: not at all where the last step did not reach the limit.
  static constexpr double most_growth = 2.0;
  static constexpr double most_growth_of_a_failure = 1.0;
  static constexpr int mark_size = spring_row_size;  ///< nodes are marked as moved by so many

  /// The longest of some springs.
  enum class Lengths
  {
    slack,
    taut,     ///< as long as tensions hold a spring, or longer: it gets one in the next pass
    too_long  ///< longer than the limit and its tolerance allow: there must be a next pass
  };

  struct Run
  {
    SpringRun springs;
    int first;              ///< of its tensions
    bool is_taut = false;   ///< some spring has a tension, or was found taut
    bool was_taut = false;  ///< likewise, after the iteration before
    long found_slack = -1;  ///< when all of its springs were
  };

  /// Of springs at the margin, in lengths at rest.
  double stretch_held() const;
  double target_length(const Run& run) const;
  /// Pulls with the tensions of the last step times the factor that is best for them, then gives tethers their tension.
  /// False: neither did anything.
  bool pull_as_before(const double* inverse_masses, const Columns<double>& positions);
  Lengths find_taut(const double* inverse_masses, const Columns<double>& positions);
  void relax_taut(bool backwards, const double* inverse_masses, const Columns<double>& positions);
  template <bool fused>
  void relax_run(Run& run, const double* inverse_masses, const Columns<double>& positions);
  void begin_momentum(const Columns<double>& positions);
  /// Carries positions and tensions on along what the last iteration changed.
  void carry_on_all(const Columns<double>& positions);
  void add_tensions_to(const Columns<double>& shifts) const;
  void mark_moved(int node, int n);
  long last_move(int node, int n) const;

  std::vector<SpringBatch> batches_;
  std::vector<Run> runs_;
  SpringTethers tethers_;
  int nodes_;
  double max_strain_ = 0.0;  ///< of the step
  bool reached_ = true;
  double wanted_margin_ = StrainLimit::least_margin;  ///< that the margin approaches
  double margin_ = StrainLimit::least_margin;
  AlignedVectors<double> tensions_;  ///< one for each spring, kg m
  AlignedVectors<double> shifts_;    ///< what the tensions of the last step ask for, m
  std::vector<long> moved_at_;       ///< for each mark_size nodes
  long now_ = 0;                     ///< counts what moves nodes
  Momentum<double> momentum_;
  AlignedVectors<double> last_tensions_;  ///< after the iteration before; of runs that were taut then
  AlignedVectors<double> last_positions_;
  AlignedVectors<double> begins_;  ///< positions that the last iteration set out from
  long carried_on_at_ = 0;
};

}  // namespace cloth
