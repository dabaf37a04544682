#include <memory>
#include <vector>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

#include "../constraints/lane_tensions.h"
#include "../model/lane_nodes.h"
#include "../model/spring_layout.h"
#include "lane_springs.h"
#include "lane_wind.h"
#include "rows.h"

namespace cloth
{
namespace
{

/// The method of xpbd.cpp in mixed precision: the state is kept in doubles, and a step adds to it what its substeps
/// come to in single precision, positions relative to the sheet's middle. Nodes are in the order of LaneLayout. A
/// strain limit is followed in every substep and kept at the end of each step.
class MixedPositionBasedDynamics : public Method
{
public:
  MixedPositionBasedDynamics(int substeps, double compliance) : substeps_(substeps), compliance_(compliance)
  {
  }

  bool limit_strain(double max_strain, int passes) override
  {
    max_strain_ = max_strain;
    passes_ = passes;
    return true;
  }

  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    if (!sheet_ || static_cast<int>(sheet_->places.size()) != dynamics.model().nodes())
    {
      sheet_ = std::make_unique<Sheet>(dynamics.model());
    }
    const FlushedDenormals flushed;
    StepReport report;
    const double begin = state.time;
    const double substep = h / substeps_;
    begin_step(dynamics, substep, state);
    set_out(dynamics, substep, state);
    for (int s = 1; s <= substeps_; ++s)
    {
      state.time = s == substeps_ ? begin + h : begin + s * substep;
      count_calls(dynamics);
      move_held(dynamics.pins(), state);
      if (records())
      {
        give(state);
        record_external_forces(dynamics, substep, state);
      }
      correct();
      if (max_strain_ > 0.0)
      {
        report.limit_sweeps += shorten(s == substeps_);
      }
      if (s < substeps_)
      {
        go_on(dynamics, substep, state);
      }
    }
    arrive();
    end_step(dynamics.pins(), substep, state);
    report.force_evaluations = substeps_;
    return report;
  }

private:
  /// What does not change from step to step, and what a step hands on to the next.
  struct Sheet
  {
    explicit Sheet(const ClothModel& model)
      : layout(model), springs(model, layout), wind(model, layout), limit(model, layout)
    {
      for (int node = 0; node < model.nodes(); ++node)
      {
        places.push_back(LaneNodes::place_of(layout[node]));
      }
      nodes.set_zero(layout.nodes());
      remainders.set_zero(layout.nodes());
    }

    LaneLayout layout;
    std::vector<int> places;  ///< of the model's nodes among those of the layout
    LaneNodes nodes;
    LaneBlocks<1> remainders;  ///< what the air leaves of a speed
    LaneSprings springs;
    LaneWind wind;
    LaneTensions limit;
    float substep = 0.0F;  ///< that all is prepared for, s, with this air, N s/m per m2, and these nodes held
    double viscous_damping = 0.0;
    double wind_coupling = 0.0;
    std::vector<int> held;
    LaneVectors pulls;  ///< what springs gave to nodes in this step, kg m, where that is recorded
  };

  void begin_step(const Dynamics& dynamics, double substep, const ClothState& state)
  {
    prepare(dynamics, substep);
    take(substep, state);
    if (records())
    {
      sheet_->pulls.set_zero(sheet_->layout.nodes());
    }
  }

  void prepare(const Dynamics& dynamics, double substep)
  {
    std::vector<int> held;
    for (const Pin& pin : dynamics.pins().all())
    {
      held.insert(held.end(), pin.nodes.begin(), pin.nodes.end());
    }
    Sheet& sheet = *sheet_;
    const AirProperties& air = dynamics.air().properties();
    const auto rounded = static_cast<float>(substep);  // steps to points in time differ in their last digits
    if (rounded != sheet.substep || air.viscous_damping != sheet.viscous_damping ||
        air.wind_coupling != sheet.wind_coupling || held != sheet.held)
    {
      sheet.substep = rounded;
      sheet.viscous_damping = air.viscous_damping;
      sheet.wind_coupling = air.wind_coupling;
      sheet.held.swap(held);
      prepare_nodes(dynamics, substep);
      sheet.springs.prepare(dynamics.model(), compliance_, rounded, sheet.nodes);
      if (dynamics.air().is_coupled(dynamics.model()))
      {
        sheet.wind.prepare(dynamics.model(), air, substep, sheet.layout, sheet.nodes);
      }
      sheet.limit.prepare(sheet.nodes, sheet.held);
    }
  }

  void prepare_nodes(const Dynamics& dynamics, double substep)
  {
    const ClothModel& model = dynamics.model();
    Sheet& sheet = *sheet_;
    const double damping = substep * sheet.viscous_damping;
    Eigen::VectorXd inverse_masses(model.nodes());
    dynamics.pins().find_inverse_masses(model.masses, inverse_masses);
    for (int node = 0; node < model.nodes(); ++node)
    {
      const double mass = model.masses[node];
      sheet.nodes.data()[sheet.places[static_cast<size_t>(node)] + lane_node::inverse_mass] =
          static_cast<float>(inverse_masses[node]);
      sheet.remainders.data()[LaneBlocks<1>::place_of(sheet.layout[node])] =
          static_cast<float>(mass / (mass + damping * model.areas[node]));
    }
  }

  /// Positions, and the ways of a substep of length h at the velocities, 0 where nodes are held.
  void take(double h, const ClothState& state)
  {
    origin_ = state.positions.colwise().mean();
    rate_ = static_cast<float>(1.0 / h);
    for_each_coordinate([&](int node, int d, float& x, float& way, bool is_held) {
      x = from_origin(state, node, d);
      way = is_held ? 0.0F : static_cast<float>(state.velocities(node, d)) / rate_;
    });
  }

  /// Adds to positions and velocities what they have gained since they were taken.
  void give(ClothState& state)
  {
    for_each_coordinate([&](int node, int d, float& x, float& way, bool is_held) {
      const double gain = static_cast<double>(x) - static_cast<double>(from_origin(state, node, d));
      state.positions(node, d) += is_held ? 0.0 : gain;
      double& v = state.velocities(node, d);
      v += is_held ? 0.0 : static_cast<double>(rate_ * way) - static_cast<double>(static_cast<float>(v));
    });
  }

  float from_origin(const ClothState& state, int node, int d) const
  {
    return static_cast<float>(state.positions(node, d) - origin_[d]);
  }

  /// visit(node, d, x, way, is held) for all nodes of the model and coordinates d.
  template <typename Visit>
  void for_each_coordinate(Visit&& visit)
  {
    float* const nodes = sheet_->nodes.data();
    for (size_t node = 0; node < sheet_->places.size(); ++node)
    {
      float* const at = nodes + sheet_->places[node];
      const bool is_held = at[lane_node::inverse_mass] == 0.0F;
      for (int d = 0; d < 3; ++d)
      {
        visit(static_cast<int>(node), d, at[lane_node::x + d * lanes], at[lane_node::way_x + d * lanes], is_held);
      }
    }
  }

  /// From the ways of the last substep to those that nothing but gravity and air changes; held nodes stay.
  void set_out(const Dynamics& dynamics, double h, const ClothState& state)
  {
    for_each_vector([fall = fall_in(dynamics, h)](float* node, const float* remainder) {
#pragma GCC ivdep
      for (int k = 0; k < lanes; ++k)
      {
        set_out_one(node + k, remainder[k], fall);
      }
    });
    blow(dynamics, h, state);
  }

  void arrive()
  {
    for_each_vector([](float* node, const float* /*remainder*/) {
#pragma GCC ivdep
      for (int k = 0; k < lanes; ++k)
      {
        arrive_one(node + k);
      }
    });
  }

  /// Arrives, and sets out again.
  void go_on(const Dynamics& dynamics, double h, const ClothState& state)
  {
    for_each_vector([fall = fall_in(dynamics, h)](float* node, const float* remainder) {
#pragma GCC ivdep
      for (int k = 0; k < lanes; ++k)
      {
        arrive_one(node + k);
        set_out_one(node + k, remainder[k], fall);
      }
    });
    blow(dynamics, h, state);
  }

  void blow(const Dynamics& dynamics, double h, const ClothState& state)
  {
    const Air& air = dynamics.air();
    if (air.is_coupled(dynamics.model()))
    {
      sheet_->wind.blow((h * air.wind_at(state.time + h)).cast<float>(), sheet_->nodes);
    }
  }

  struct Fall
  {
    float x;
    float y;
    float z;
  };

  /// What gravity adds to a way in a substep.
  static Fall fall_in(const Dynamics& dynamics, double h)
  {
    const Eigen::Vector3f fall = (h * h * dynamics.gravity()).cast<float>();
    return { fall[0], fall[1], fall[2] };
  }

  static void arrive_one(float* node)
  {
    using namespace lane_node;
    node[x] += node[way_x];
    node[y] += node[way_y];
    node[z] += node[way_z];
  }

  static void set_out_one(float* node, float remainder, const Fall& fall)
  {
    using namespace lane_node;
    const float part = node[inverse_mass] > 0.0F ? remainder : 0.0F;
    node[way_x] = part * (node[way_x] + fall.x);
    node[way_y] = part * (node[way_y] + fall.y);
    node[way_z] = part * (node[way_z] + fall.z);
  }

  /// work(nodes, remainders) for all vectors of nodes.
  template <typename Work>
  void for_each_vector(Work&& work)
  {
    Sheet& sheet = *sheet_;
    in_widest_vectors([&](auto) {
      for (int v = 0; v < sheet.layout.nodes() / lanes; ++v)
      {
        work(sheet.nodes.data() + v * LaneNodes::size, sheet.remainders.data() + v * lanes);
      }
    });
  }

  /// Puts held nodes where they are at the substep's end: their part of the state has been there already.
  void move_held(const Pins& pins, ClothState& state)
  {
    Sheet& sheet = *sheet_;
    held_before_.clear();
    for (const int node : sheet.held)
    {
      held_before_.emplace_back(state.positions.row(node));
    }
    pins.impose(state.time, state.positions, state.velocities);
    for (size_t k = 0; k < sheet.held.size(); ++k)
    {
      const int node = sheet.held[k];
      float* const way = sheet.nodes.data() + sheet.places[static_cast<size_t>(node)] + lane_node::way_x;
      for (int d = 0; d < 3; ++d)
      {
        way[d * lanes] = static_cast<float>(state.positions(node, d) - held_before_[k][d]);
      }
    }
  }

  void count_calls(const Dynamics& dynamics) const
  {
    const Air& air = dynamics.air();
    part_calls()[Part::gravity] += dynamics.gravity().isZero(0.0) ? 0 : 1;
    part_calls()[Part::viscous_damping] += air.properties().viscous_damping > 0.0 ? 1 : 0;
    for (const Part part : { Part::wind, Part::normals })
    {
      part_calls()[part] += air.is_coupled(dynamics.model()) ? 1 : 0;
    }
    for (const SpringBatch& batch : dynamics.model().springs)
    {
      count_call(batch);
      part_calls()[Part::internal_damping] += compliance_ * batch.damping > 0.0 ? 1 : 0;
    }
  }

  void correct()
  {
    Sheet& sheet = *sheet_;
    sheet.springs.correct(sheet.nodes, records() ? &sheet.pulls : nullptr);
  }

  /// The strain limit. Returns the passes that it took.
  int shorten(bool is_last)
  {
    Sheet& sheet = *sheet_;
    int passes = sheet.limit.follow(sheet.nodes, max_strain_, passes_, sheet.substep);
    if (is_last)
    {
      passes += sheet.limit.finish(sheet.nodes, max_strain_, passes_);
    }
    if (records())
    {
      sheet.limit.add_tensions_to(sheet.pulls);
    }
    return passes;
  }

  void record_external_forces(const Dynamics& dynamics, double h, const ClothState& state)
  {
    dynamics.external_forces_on_all(state.time, forces_);
    dynamics.air().add_forces(dynamics.model(), state.time, state.positions, state.velocities, forces_);
    add_impulses(h, forces_);
  }

  void end_step(const Pins& pins, double substep, ClothState& state)
  {
    give(state);
    pins.impose(state.time, state.positions, state.velocities);
    for (const int node : records() ? sheet_->held : std::vector<int>())
    {
      const float* const pull = sheet_->pulls.data() + LaneVectors::place_of(sheet_->layout[node]);
      for (int d = 0; d < 3; ++d)
      {
        impulses()(node, d) += static_cast<double>(pull[d * lanes]) / substep;
      }
    }
  }

  int substeps_;
  double compliance_;
  double max_strain_ = 0.0;
  int passes_ = 0;
  std::unique_ptr<Sheet> sheet_;
  Eigen::RowVector3d origin_;  ///< that positions in single precision are relative to
  float rate_ = 0.0F;          ///< velocities over ways, 1/s
  std::vector<Eigen::RowVector3d> held_before_;
  Vectors forces_;
};

}  // namespace

std::unique_ptr<Method> make_mixed_xpbd(const MethodSettings& settings)
{
  return std::make_unique<MixedPositionBasedDynamics>(settings.iterations, settings.compliance);
}

}  // namespace cloth
