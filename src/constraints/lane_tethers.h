#pragma once

#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "../model/lane_nodes.h"
#include "../model/spring_layout.h"
#include "dual_parabola.h"
#include "momentum.h"
#include "spring_ways.h"

namespace cloth
{

/// A spring from every node to each of those that are held, as long as the shortest way along springs between them
/// (Kim, Chentanez and Mueller-Fischer, "Long range attachments", 2012). It forbids nothing that they allow, and says
/// in one pass what they pass on from one to the next; but which of both is to pull is open, so that the last digits of
/// a correction from nothing take more passes than without. Tensions are those of LaneTensions.
class LaneTethers
{
public:
  LaneTethers(const ClothModel& model, const LaneLayout& layout);

  /// To be called whenever the nodes' masses have changed. These nodes of the model are held from now on; where they
  /// are many there are no tethers: a pass visits every node for each of them.
  void prepare(const LaneNodes& nodes, const std::vector<int>& held);

  /// Adds what the tensions ask for to the shifts of nodes and to the parabola. `stretch`: how long tethers may be, in
  /// lengths at rest.
  void add_shifts(const LaneNodes& nodes, float stretch, LaneVectors& shifts, DualParabola<float>& parabola) const;

  /// A pass. Tensions are multiplied by `factor` before.
  void relax(LaneNodes& nodes, float stretch, float factor);

  void begin_momentum();
  /// Adds `part` of their last change to the tensions.
  void carry_on_all(float part);

  /// Adds the pull of the tensions on both ends, kg m.
  void add_tensions_to(LaneVectors& pulls) const;

private:
  static constexpr size_t most = 4;
  static constexpr int passes_between_looks = 8;  ///< at slack tethers: springs forbid what they do in any case

  struct Tether
  {
    int node;                       ///< the held one
    AlignedNumbers<float> lengths;  ///< from all others, m; 0: none
    LaneVectors tensions;
    std::vector<char> is_taut;  ///< of every vector of nodes: some have a tension
    LaneVectors last_tensions;  ///< after the iteration before; of vectors that were taut then
    std::vector<char> was_taut;
  };

  const LaneLayout layout_;
  const int nodes_;  ///< of the model
  const bool has_ways_;
  const SpringWays ways_;
  AlignedNumbers<float> masses_;  ///< of the nodes, kg; 0: held
  std::vector<int> held_;
  std::vector<Tether> tethers_;
  int passes_ = 0;
};

}  // namespace cloth
