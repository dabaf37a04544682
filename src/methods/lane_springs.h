#pragma once

#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "../model/lane_nodes.h"
#include "../model/lane_table.h"
#include "../model/spring_layout.h"
#include "small_step_springs.h"

namespace cloth
{

/// A pass over the springs of a sheet as xpbd makes it, 16 springs at a time in single precision.
class LaneSprings
{
public:
  LaneSprings(const ClothModel& model, const LaneLayout& layout);

  /// To be called whenever the step, the compliance's factor or the nodes' masses have changed.
  void prepare(const ClothModel& model, double compliance, double h, const LaneNodes& nodes);

  /// Corrects spring after spring. `pulls`, unless null, gets what springs give to nodes added, kg m.
  void correct(LaneNodes& nodes, LaneVectors* pulls) const;

private:
  /// Runs of one batch that follow each other.
  struct Stretch
  {
    size_t batch;
    size_t begin;
    size_t end;
  };

  template <bool fused, bool records>
  void correct_all(float* nodes, float* pulls) const;
  template <bool fused, bool records, bool damped>
  void correct_stretch(const Stretch& stretch, float* nodes, float* pulls) const;

  std::vector<LaneRun> runs_;
  std::vector<Stretch> stretches_;
  std::vector<Gains<float>> gains_;  ///< of the batches
  LaneTable yields_;                 ///< of every run's springs one over the resistance, kg; 0: no spring
};

}  // namespace cloth
