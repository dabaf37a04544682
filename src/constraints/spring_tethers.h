#pragma once

#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "../model/aligned_vectors.h"
#include "dual_parabola.h"
#include "spring_ways.h"

namespace cloth
{

/// A spring from every node to each of those that are held, as long as the shortest way along springs between them
/// (Kim, Chentanez and Mueller-Fischer, "Long range attachments", 2012). It forbids nothing that they allow, and says
/// at once what they pass on from one to the next. Tensions are those of SpringTensions.
class SpringTethers
{
public:
  explicit SpringTethers(const ClothModel& model);

  /// The nodes of inverse mass 0 (1/kg) are held from now on. Where they are many there are no tethers: a pass would
  /// visit every node for each of them, and no node is far from one.
  void prepare(const Eigen::VectorXd& inverse_masses);

  /// Takes over the tensions of `before`, of the same sheet.
  void go_on_from(const SpringTethers& before);

  /// Adds what the tensions ask for to the shifts of nodes and to the parabola. `stretch`: how long tethers may be, in
  /// lengths at rest.
  void add_shifts(const double* inverse_masses, const Columns<double>& positions, double stretch,
                  const Columns<double>& shifts, DualParabola<double>& parabola) const;

  /// A pass. Tensions are multiplied by `factor` before. Returns whether any tether was or is taut.
  bool relax(const double* inverse_masses, const Columns<double>& positions, double stretch, double factor);

  /// Adds the pull of the tensions on the held nodes, kg m.
  void add_tensions_to(const Columns<double>& pulls) const;

private:
  static constexpr size_t most = 4;

  struct Tether
  {
    int node;                        ///< the held one
    AlignedNumbers<double> lengths;  ///< from all others, m; 0: none
    AlignedVectors<double> tensions;
    std::vector<char> is_taut;  ///< of every vector of nodes: some have a tension
  };

  int nodes_;
  bool has_ways_;
  SpringWays ways_;
  std::vector<int> held_;
  std::vector<Tether> tethers_;
};

}  // namespace cloth
