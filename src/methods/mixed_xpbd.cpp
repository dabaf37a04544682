#include <memory>
#include <optional>
#include <vector>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/spring_rows.h"
#include "cloth_sim/model/wide_vectors.h"

#include "../constraints/shortening.h"
#include "../constraints/tension_passes.h"
#include "../constraints/tether_lengths.h"
#include "../model/aligned_vectors.h"
#include "../model/spring_layout.h"
#include "rows.h"
#include "small_step_springs.h"

namespace cloth
{
namespace
{

/// Vectors in single precision of a state that is in doubles: what they gain is added to it.
class SingleCopy
{
public:
  /// `origin` is what they are relative to.
  void take(const Vectors& doubles, const Eigen::RowVector3d& origin, const std::vector<int>& numbers)
  {
    for (int d = 0; d < 3; ++d)
    {
      float* const column = singles_.from(0)[static_cast<size_t>(d)];
      for (size_t node = 0; node < numbers.size(); ++node)
      {
        column[numbers[node]] = static_cast<float>(doubles(static_cast<Eigen::Index>(node), d) - origin[d]);
      }
    }
    taken_ = singles_;
  }

  void add_gains_to(Vectors& doubles, const std::vector<int>& numbers)
  {
    for (int d = 0; d < 3; ++d)
    {
      const float* const now = singles_.from(0)[static_cast<size_t>(d)];
      const float* const then = taken_.from(0)[static_cast<size_t>(d)];
      for (size_t node = 0; node < numbers.size(); ++node)
      {
        const int number = numbers[node];
        doubles(static_cast<Eigen::Index>(node), d) +=
            static_cast<double>(now[number]) - static_cast<double>(then[number]);
      }
    }
    taken_ = singles_;
  }

  AlignedVectors<float>& singles()
  {
    return singles_;
  }

private:
  AlignedVectors<float> singles_;
  AlignedVectors<float> taken_;
};

/// The method of xpbd.cpp in mixed precision: the state is kept in doubles, and a step adds to it what its substeps
/// come to in single precision, positions relative to the sheet's middle. Nodes are in the order of LaneLayout. A
/// strain limit is kept after every substep. Wind along normals is worked out in doubles.
class MixedPositionBasedDynamics : public Method
{
public:
  MixedPositionBasedDynamics(int substeps, double compliance) : substeps_(substeps), compliance_(compliance)
  {
  }

  void limit_strain(double max_strain, int passes) override
  {
    max_strain_ = max_strain;
    passes_ = passes;
  }

  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    if (!sheet_ || static_cast<int>(sheet_->numbers.size()) != dynamics.model().nodes())
    {
      sheet_ = std::make_unique<Sheet>(dynamics.model());
    }
    const FlushedDenormals flushed;
    StepReport report;
    const double begin = state.time;
    const double substep = h / substeps_;
    begin_step(dynamics, substep, state);
    for (int s = 1; s <= substeps_; ++s)
    {
      predict(dynamics, substep, state);
      state.time = s == substeps_ ? begin + h : begin + s * substep;
      move_held(dynamics.pins(), state);
      if (records())
      {
        record_external_forces(dynamics, substep, state);
      }
      project(dynamics.model(), substep);
      go_the_way(substep);
      if (max_strain_ > 0.0)
      {
        report.limit_sweeps += shorten(substep);
      }
    }
    end_step(dynamics.pins(), substep, state);
    report.force_evaluations = substeps_;
    return report;
  }

private:
  static constexpr int rows_a_band = 8;  ///< whose springs are done batch by batch: they stay in the nearest cache

  /// What does not change from step to step, and the tensions of the last.
  struct Sheet
  {
    explicit Sheet(const ClothModel& model)
      : layout(model)
      , springs(layout.runs(model.springs, rows_a_band))
      , limit(limited_batches(model), layout.runs(limited_batches(model), 1), layout.nodes())
      , tether_lengths(model)
    {
      for (int node = 0; node < model.nodes(); ++node)
      {
        numbers.push_back(layout[node]);
      }
      const int room = layout.nodes();
      for (AlignedVectors<float>* const vectors :
           { &positions.singles(), &velocities.singles(), &accelerations.singles(), &ways, &before, &inertias })
      {
        vectors->set_zero(room);
      }
    }

    const float* inverse_masses() const
    {
      return inertias.from(0)[0];
    }

    LaneLayout layout;
    std::vector<int> numbers;  ///< of the model's nodes
    std::vector<SpringRun> springs;
    TensionPasses<float> limit;
    TetherLengths tether_lengths;
    std::vector<int> held;  ///< nodes that there are tethers to
    SingleCopy positions;
    SingleCopy velocities;
    SingleCopy accelerations;
    AlignedVectors<float> ways;      ///< since the substep's begin, m
    AlignedVectors<float> before;    ///< positions at the substep's begin, or before the limit
    AlignedVectors<float> inertias;  ///< inverse masses, what the air leaves of a speed, and one
    AlignedVectors<float> pulls;     ///< what springs gave to nodes in this step, kg m, where that is recorded
  };

  void begin_step(const Dynamics& dynamics, double substep, const ClothState& state)
  {
    const ClothModel& model = dynamics.model();
    Sheet& sheet = *sheet_;
    dynamics.external_forces_on_all(state.time, forces_);
    dynamics.accelerations_of(forces_, forces_);
    sheet.positions.take(state.positions, state.positions.colwise().mean(), sheet.numbers);
    sheet.velocities.take(state.velocities, Eigen::RowVector3d::Zero(), sheet.numbers);
    sheet.accelerations.take(forces_, Eigen::RowVector3d::Zero(), sheet.numbers);
    inverse_masses_.resize(model.nodes());
    dynamics.pins().find_inverse_masses(model.masses, inverse_masses_);
    const Air& air = dynamics.air();
    const double damping = air.is_coupled(model) ? 0.0 : substep * air.properties().viscous_damping;
    const Columns<float> inertias = sheet.inertias.from(0);
    for (int node = 0; node < model.nodes(); ++node)
    {
      const int number = sheet.numbers[static_cast<size_t>(node)];
      const double mass = model.masses[node];
      inertias[0][number] = static_cast<float>(inverse_masses_[node]);
      inertias[1][number] = static_cast<float>(mass / (mass + damping * model.areas[node]));
      inertias[2][number] = 1.0F;
    }
    use_tethers(dynamics.pins());
    if (records())
    {
      sheet.pulls.set_zero(sheet.layout.nodes());
    }
  }

  void use_tethers(const Pins& pins)
  {
    std::vector<int> held;
    for (const Pin& pin : pins.all())
    {
      held.insert(held.end(), pin.nodes.begin(), pin.nodes.end());
    }
    Sheet& sheet = *sheet_;
    if (held != sheet.held)
    {
      sheet.held.swap(held);
      sheet.limit.use_tethers(sheet.tether_lengths.tethers<float>(sheet.held, sheet.layout.nodes(),
                                                                  [&](int node) { return sheet.layout[node]; }));
    }
  }

  /// The ways of nodes that nothing but gravity and air moves; held ones stay.
  void predict(const Dynamics& dynamics, double h, ClothState& state)
  {
    Sheet& sheet = *sheet_;
    const auto step = static_cast<float>(h);
    for_each_column(sheet.velocities.singles(), sheet.accelerations.singles(),
                    [=](float* v, const float* a, int i) { v[i] += step * a[i]; });
    if (dynamics.air().is_coupled(dynamics.model()))
    {
      bring_up_to_date(state);
      dynamics.air().damp_implicitly(dynamics.model(), state.time + h, state.positions, h, state.velocities);
      sheet.velocities.take(state.velocities, Eigen::RowVector3d::Zero(), sheet.numbers);
    }
    const float* const part = sheet.inertias.from(0)[1];
    const float* const w = sheet.inverse_masses();
    for_each_column(sheet.ways, sheet.velocities.singles(),
                    [=](float* way, const float* v, int i) { way[i] = w[i] > 0.0F ? step * (part[i] * v[i]) : 0.0F; });
    sheet.before = sheet.positions.singles();
  }

  /// work(first[d], second[d], i) for all d and i.
  template <typename Work>
  void for_each_column(AlignedVectors<float>& first, const AlignedVectors<float>& second, Work&& work)
  {
    const int n = sheet_->layout.nodes();
    in_widest_vectors([&, n](auto) {
      for (size_t d = 0; d < 3; ++d)
      {
        float* const a = first.from(0)[d];
        const float* const b = second.from(0)[d];
        const auto local = work;
#pragma GCC ivdep
        for (int i = 0; i < n; ++i)
        {
          local(a, b, i);
        }
      }
    });
  }

  void bring_up_to_date(ClothState& state)
  {
    sheet_->positions.add_gains_to(state.positions, sheet_->numbers);
    sheet_->velocities.add_gains_to(state.velocities, sheet_->numbers);
  }

  /// Puts held nodes where they are at the substep's end: their part of the state has been there already.
  void move_held(const Pins& pins, ClothState& state)
  {
    Sheet& sheet = *sheet_;
    const Columns<float> ways = sheet.ways.from(0);
    const Columns<float> velocities = sheet.velocities.singles().from(0);
    held_before_.clear();
    for (const int node : sheet.held)
    {
      held_before_.emplace_back(state.positions.row(node));
    }
    pins.impose(state.time, state.positions, state.velocities);
    for (size_t k = 0; k < sheet.held.size(); ++k)
    {
      const int node = sheet.held[k];
      const int number = sheet.layout[node];
      for (int d = 0; d < 3; ++d)
      {
        ways[static_cast<size_t>(d)][number] = static_cast<float>(state.positions(node, d) - held_before_[k][d]);
        velocities[static_cast<size_t>(d)][number] = static_cast<float>(state.velocities(node, d));
      }
    }
  }

  void project(const ClothModel& model, double h)
  {
    gains_.clear();
    for (const SpringBatch& batch : model.springs)
    {
      count_call(batch);
      part_calls()[Part::internal_damping] += compliance_ * batch.damping > 0.0 ? 1 : 0;
      gains_.push_back(gains_of<float>(batch, compliance_, h));
    }
    Sheet& sheet = *sheet_;
    in_widest_vectors([&](auto arithmetic) {
      const float* const w = sheet.inverse_masses();
      const Columns<float> all_ways = sheet.ways.from(0);
      const Columns<float> all_before = sheet.before.from(0);
      for (const SpringRun& run : sheet.springs)
      {
        const SpringRow<float> ways(w, all_ways, run.node, run.offset, run.n);
        const SpringRow<float> before(w, all_before, run.node, run.offset, run.n);
        RowChanges<float> changes;
        find_changes<arithmetic.has_fused_multiply_add>(
            ways, before, gains_[run.batch], [](int) { return true; }, changes);
        move_ends(ways, changes);
        if (records())
        {
          const Columns<float> inertias = sheet.inertias.from(0);
          move_ends(SpringRow<float>(inertias[2], sheet.pulls.from(0), run.node, run.offset, run.n), changes);
        }
      }
    });
  }

  void go_the_way(double h)
  {
    Sheet& sheet = *sheet_;
    const auto rate = static_cast<float>(1.0 / h);
    const float* const w = sheet.inverse_masses();
    for_each_column(sheet.velocities.singles(), sheet.ways,
                    [=](float* v, const float* way, int i) { v[i] = w[i] > 0.0F ? rate * way[i] : v[i]; });
    for_each_column(sheet.positions.singles(), sheet.ways, [](float* x, const float* way, int i) { x[i] += way[i]; });
  }

  /// The strain limit. Returns the passes that it took.
  int shorten(double h)
  {
    Sheet& sheet = *sheet_;
    sheet.before = sheet.positions.singles();
    const StrainLimit::Report report =
        sheet.limit.shorten(sheet.inverse_masses(), max_strain_, passes_, sheet.positions.singles().from(0));
    if (report.moved)
    {
      const auto rate = static_cast<float>(1.0 / h);
      for_each_column(sheet.before, sheet.positions.singles(),
                      [](float* x, const float* after, int i) { x[i] = after[i] - x[i]; });
      for_each_column(sheet.velocities.singles(), sheet.before,
                      [=](float* v, const float* way, int i) { v[i] += rate * way[i]; });
    }
    if (records())
    {
      sheet.limit.add_tensions_to(sheet.pulls.from(0));
    }
    return report.sweeps;
  }

  void record_external_forces(const Dynamics& dynamics, double h, const ClothState& state)
  {
    dynamics.external_forces_on_all(state.time, forces_);
    dynamics.air().add_forces(dynamics.model(), state.time, state.positions, state.velocities, forces_);
    add_impulses(h, forces_);
  }

  void end_step(const Pins& pins, double substep, ClothState& state)
  {
    bring_up_to_date(state);
    pins.impose(state.time, state.positions, state.velocities);
    for (const int node : records() ? sheet_->held : std::vector<int>())
    {
      for (int d = 0; d < 3; ++d)
      {
        const float pull = sheet_->pulls.from(0)[static_cast<size_t>(d)][sheet_->layout[node]];
        impulses()(node, d) += static_cast<double>(pull) / substep;
      }
    }
  }

  int substeps_;
  double compliance_;
  double max_strain_ = 0.0;
  int passes_ = 0;
  std::unique_ptr<Sheet> sheet_;
  std::vector<Gains<float>> gains_;
  std::vector<Eigen::RowVector3d> held_before_;
  Vectors forces_;
  Eigen::VectorXd inverse_masses_;
};

}  // namespace

std::unique_ptr<Method> make_mixed_xpbd(const MethodSettings& settings)
{
  return std::make_unique<MixedPositionBasedDynamics>(settings.iterations, settings.compliance);
}

}  // namespace cloth
