#pragma once

#include <array>
#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "shortening.h"

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
  /// The longest of some springs.
  enum class Lengths
  {
    slack,
    taut,     ///< as long as tensions hold a spring, or longer: it gets one in the next pass
    too_long  ///< longer than the limit and its tolerance allow: there must be a next pass
  };

  explicit SpringTensions(const ClothModel& model);

  StrainLimit::Report shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes, Vectors& positions,
                              Vectors* shifts) override;
  void go_on_from(const Shortening& before) override;

private:
  /// The margin (StrainLimit::least_margin) grows while steps need more passes than `few` and dies away while they do
  /// not. Within a step it stays the same.
  static constexpr double margin_growth = 1.5;
  static constexpr double margin_decay = 0.98;
  static constexpr int few = 2;
  /// The most by which tensions grow before a step's passes: not at all where the last step did not reach the limit.
  static constexpr double most_growth = 2.0;
  static constexpr double most_growth_of_a_failure = 1.0;

  struct Batch
  {
    SpringBatch springs;
    int blocks_a_row;
    std::vector<double> tensions[3];   ///< x, y, z of one for each spring, kg m
    std::vector<char> is_taut;         ///< for each block: some spring has a tension, or was found taut
    std::vector<long> found_slack_at;  ///< for each block: when all of its springs were slack
  };

  /// At most spring_row_size springs in a row: the n springs of a batch from number `first` on, which begin at `node`
  /// and the nodes after it. Nodes are grouped in blocks of the same size.
  struct Block
  {
    size_t index;
    int first;
    int node;
    int n;
  };

  /// Calls visit(batch, block) for all blocks, row of nodes by row of nodes.
  template <typename Visit>
  void for_each_block(bool backwards, Visit&& visit);
  static std::array<double*, 3> tensions_of(Batch& batch, const Block& block);
  double target_length(const Batch& batch) const;
  /// Pulls with the tensions of the last step times the factor that is best for them. False: they are of no use.
  bool pull_as_before(const Eigen::VectorXd& inverse_masses, Vectors& positions);
  Lengths find_taut_blocks(const Eigen::VectorXd& inverse_masses, Vectors& positions);
  void relax_taut_blocks(bool backwards, const Eigen::VectorXd& inverse_masses, Vectors& positions);
  void add_tensions_to(Vectors& shifts);
  void let_go();
  void scale_tensions(double factor);
  void mark_moved(int node, int n);
  long last_move(int node, int n) const;

  int rows_;
  double max_strain_ = 0.0;  ///< of the step
  bool reached_ = true;
  double margin_ = StrainLimit::least_margin;
  std::vector<Batch> batches_;
  std::vector<long> moved_at_;  ///< for each block of nodes
  long now_ = 0;                ///< counts passes
  Vectors shifts_;              ///< what the tensions of the last step ask for, m
};

}  // namespace cloth
