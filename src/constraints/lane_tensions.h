#pragma once

#include <cstdint>
#include <vector>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/model/cloth_model.h"

#include "../model/lane_nodes.h"
#include "../model/lane_table.h"
#include "../model/spring_layout.h"
#include "dual_parabola.h"
#include "lane_tethers.h"
#include "momentum.h"

namespace cloth
{

/// SpringTensions in single precision, 16 springs at a time, for a method that takes short substeps: tensions change so
/// little from one to the next that two passes in each, there and back, keep up with them; a single one leaves a sheet
/// restless. More are made where it falls behind, and at a step's end until the limit is kept. As substeps leave
/// springs a little longer than a pass aims at, it aims at a margin below the limit, which grows when the end of a step
/// takes many passes, and dies away while it does not.
class LaneTensions
{
public:
  LaneTensions(const ClothModel& model, const LaneLayout& layout);

  /// To be called whenever the nodes' masses have changed. `held`: numbers of nodes in the model.
  void prepare(const LaneNodes& nodes, const std::vector<int>& held);

  /// To be called in every substep, of length h (s), after the springs have had their say: a pass there and one back,
  /// and more where the strain is far above max_strain, but at most `passes`. Returns how many.
  int follow(LaneNodes& nodes, double max_strain, int passes, double h);

  /// To be called once more in the last substep of a step: as many passes as max_strain takes, at most `passes`.
  int finish(LaneNodes& nodes, double max_strain, int passes);

  /// Adds the pull of the tensions on every node, kg m.
  void add_tensions_to(LaneVectors& pulls) const;

private:
  /// Relative to max_strain. The margin is the first to begin with, or as much less as it takes to tighten no spring at
  /// once, and grows from the first when the sheet falls behind.
  static constexpr double first_margin = 0.15;
  /// At less, single precision shakes springs of a sheet at rest out of it.
  static constexpr double least_margin = 0.01;
  static constexpr double most_margin = 0.3;
  static constexpr double margin_growth = 1.5;  ///< a step
  static constexpr double margin_decay = 0.99;
  static constexpr double margin_speed = 0.3;  ///< 1/s, at most: springs that are tightened faster shake the sheet
  /// The excess that there may be, relative to max_strain. Rounding of the positions takes its part of
  /// StrainLimit::tolerance.
  static constexpr double most_excess_between = 0.2;
  /// Between substeps it is less where they are so short that taking it back at once would throw nodes about, m/s.
  static constexpr double most_speed_of_excess = 0.5;
  static constexpr double excess_at_end = 0.5 * StrainLimit::tolerance;
  static constexpr int there_and_back = 2;
  static constexpr int most_passes_between = 24;
  /// So seldom are slack springs and the excess looked at while nothing falls behind, unless substeps are short: what
  /// has been missed in some of them is taken back in one, as a speed so many times as high.
  static constexpr int follows_a_watch = 4;
  static constexpr double most_growth = 2.0;  ///< of tensions, from one substep to the next

  enum class Springs  ///< that are looked at; those that have grown too long join the taut ones
  {
    taut,
    all
  };

  struct Run
  {
    LaneRun springs;
    bool is_taut = false;   ///< some spring has a tension
    bool was_taut = false;  ///< likewise, after the iteration before
  };

  double excess_between(double max_strain, double h) const;
  /// Of springs at the margin, in lengths at rest.
  float stretch_held(double max_strain) const;
  void choose_first_margin(const LaneNodes& nodes, double max_strain);
  /// Pulls with the tensions of the last substep times the factor that is best for them, and returns it: tensions are
  /// multiplied by it in the pass that follows.
  float pull_as_before(LaneNodes& nodes, float stretch);
  /// A pass, the other way from the last. Returns whether any spring is taut.
  bool relax(LaneNodes& nodes, float stretch, float factor, Springs springs);
  template <bool is_first>
  void relax_taut(LaneNodes& nodes, float stretch, float factor);
  /// Lists the runs that are taut, and those with a spring that is too long.
  void find_taut(const LaneNodes& nodes, float stretch);
  /// Lists those that are taut.
  void list_taut();
  /// To be called before each pass, so many having been made.
  void give_momentum(LaneNodes& nodes, int passes);
  void begin_momentum(const LaneNodes& nodes);
  void carry_on_all(LaneNodes& nodes);
  bool has_longer(const LaneNodes& nodes, float stretch, Springs springs) const;
  float* tensions_of(size_t run)
  {
    return tensions_.data() + run * LaneVectors::size;
  }
  float* last_tensions_of(size_t run)
  {
    return last_tensions_.data() + run * LaneVectors::size;
  }
  const float* tensions_of(size_t run) const
  {
    return tensions_.data() + run * LaneVectors::size;
  }

  std::vector<float> rest_lengths_;  ///< of the batches, m
  std::vector<Run> runs_;
  std::vector<std::uint32_t> taut_;  ///< the numbers of the taut ones
  LaneTethers tethers_;
  int vectors_;                          ///< of nodes
  double wanted_margin_ = first_margin;  ///< that the margin approaches
  double margin_ = first_margin;
  bool falls_behind_ = false;  ///< two passes a substep were not enough
  bool backwards_ = false;     ///< the last pass
  std::uint64_t follows_ = 0;
  LaneVectors tensions_;      ///< of every run, kg m
  LaneTable reduced_masses_;  ///< of every run's springs 1/(1/m_i + 1/m_j), kg; 0: none, or held at both ends
  LaneVectors shifts_;        ///< what the tensions of the last substep ask for, m
  Momentum<float> momentum_;
  LaneVectors last_tensions_;  ///< after the iteration before; of runs that were taut then
  LaneVectors last_ways_;      ///< of nodes, likewise
  LaneVectors begins_;         ///< ways that the last iteration set out from
};

}  // namespace cloth
