#include <memory>
#include <vector>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

#include "../constraints/lane_tensions.h"
#include "../model/aligned_vectors.h"
#include "../model/lane_nodes.h"
#include "../model/spring_layout.h"
#include "lane_springs.h"
#include "rows.h"

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
/// strain limit is followed in every substep and kept at the end of each step. Wind along normals is worked out in
/// doubles.
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
      set_out(dynamics, substep, state);
      state.time = s == substeps_ ? begin + h : begin + s * substep;
      move_held(dynamics.pins(), state);
      if (records())
      {
        record_external_forces(dynamics, substep, state);
      }
      correct(dynamics.model());
      if (max_strain_ > 0.0)
      {
        report.limit_sweeps += shorten(s == substeps_);
      }
      arrive();
    }
    end_step(dynamics.pins(), substep, state);
    report.force_evaluations = substeps_;
    return report;
  }

private:
  /// What does not change from step to step, and what a step hands on to the next.
  struct Sheet
  {
    explicit Sheet(const ClothModel& model) : layout(model), springs(model, layout), limit(model, layout)
    {
      for (int node = 0; node < model.nodes(); ++node)
      {
        numbers.push_back(layout[node]);
      }
      for (AlignedVectors<float>* const vectors :
           { &positions.singles(), &velocities.singles(), &ways, &inertias })
      {
        vectors->set_zero(layout.nodes());
      }
    }

    const float* inverse_masses() const
    {
      return inertias.from(0)[0];
    }
    /// What the air leaves of a speed.
    const float* remainders() const
    {
      return inertias.from(0)[1];
    }
    LaneNodes nodes()
    {
      return { inverse_masses(), positions.singles().from(0), ways.from(0), layout.nodes() };
    }

    LaneLayout layout;
    std::vector<int> numbers;  ///< of the model's nodes
    LaneSprings springs;
    LaneTensions limit;
    double substep = 0.0;  ///< that springs and limit are prepared for, with these nodes held
    std::vector<int> held;
    SingleCopy positions;
    SingleCopy velocities;           ///< at the step's begin and end
    AlignedVectors<float> ways;      ///< of a substep, m
    AlignedVectors<float> inertias;  ///< inverse masses and remainders
    AlignedVectors<float> pulls;     ///< what springs gave to nodes in this step, kg m, where that is recorded
  };

  void begin_step(const Dynamics& dynamics, double substep, const ClothState& state)
  {
    const ClothModel& model = dynamics.model();
    Sheet& sheet = *sheet_;
    sheet.positions.take(state.positions, state.positions.colwise().mean(), sheet.numbers);
    sheet.velocities.take(state.velocities, Eigen::RowVector3d::Zero(), sheet.numbers);
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
    }
    prepare(dynamics, substep);
    find_ways(substep);
    if (records())
    {
      sheet.pulls.set_zero(sheet.layout.nodes());
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
    if (substep != sheet.substep || held != sheet.held)
    {
      sheet.substep = substep;
      sheet.held.swap(held);
      sheet.springs.prepare(dynamics.model(), compliance_, substep, sheet.inverse_masses());
      sheet.limit.prepare(sheet.inverse_masses(), sheet.held);
    }
  }

  /// Of a substep of length h at the velocities; held nodes stay.
  void find_ways(double h)
  {
    Sheet& sheet = *sheet_;
    const auto duration = static_cast<float>(h);
    const float* const w = sheet.inverse_masses();
    for_each_column([&](size_t d) {
      return [=, way = sheet.ways.from(0)[d], v = sheet.velocities.singles().from(0)[d]](int i) {
        way[i] = w[i] > 0.0F ? duration * v[i] : 0.0F;
      };
    });
  }

  /// Of nodes that are not held, from the ways of the last substep.
  void find_velocities(double h)
  {
    Sheet& sheet = *sheet_;
    const auto rate = static_cast<float>(1.0 / h);
    const float* const w = sheet.inverse_masses();
    for_each_column([&](size_t d) {
      return [=, way = sheet.ways.from(0)[d], v = sheet.velocities.singles().from(0)[d]](int i) {
        v[i] = w[i] > 0.0F ? rate * way[i] : v[i];
      };
    });
  }

  /// From the ways of the last substep to those that nothing but gravity and air changes; held nodes stay.
  void set_out(const Dynamics& dynamics, double h, ClothState& state)
  {
    Sheet& sheet = *sheet_;
    part_calls()[Part::gravity] += dynamics.gravity().isZero(0.0) ? 0 : 1;
    if (dynamics.air().is_coupled(dynamics.model()))
    {
      bring_up_to_date(h, state);
      state.velocities.rowwise() += h * dynamics.gravity().transpose();
      dynamics.air().damp_implicitly(dynamics.model(), state.time + h, state.positions, h, state.velocities);
      sheet.velocities.take(state.velocities, Eigen::RowVector3d::Zero(), sheet.numbers);
      find_ways(h);
      return;
    }
    const float* const remainders = sheet.remainders();
    const float* const w = sheet.inverse_masses();
    for_each_column([&](size_t d) {
      return [=, way = sheet.ways.from(0)[d],
              fall = static_cast<float>(h * h * dynamics.gravity()[static_cast<Eigen::Index>(d)])](int i) {
        way[i] = w[i] > 0.0F ? remainders[i] * (way[i] + fall) : 0.0F;
      };
    });
  }

  /// work_on(d)(i) for all coordinates d and nodes i.
  template <typename WorkOn>
  void for_each_column(WorkOn&& work_on)
  {
    const int n = sheet_->layout.nodes();
    in_widest_vectors([&, n](auto) {
      for (size_t d = 0; d < 3; ++d)
      {
        const auto work = work_on(d);
#pragma GCC ivdep
        for (int i = 0; i < n; ++i)
        {
          work(i);
        }
      }
    });
  }

  void bring_up_to_date(double h, ClothState& state)
  {
    find_velocities(h);
    sheet_->positions.add_gains_to(state.positions, sheet_->numbers);
    sheet_->velocities.add_gains_to(state.velocities, sheet_->numbers);
  }

  /// Puts held nodes where they are at the substep's end: their part of the state has been there already.
  void move_held(const Pins& pins, ClothState& state)
  {
    Sheet& sheet = *sheet_;
    const Columns<float> ways = sheet.ways.from(0);
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
      }
    }
  }

  void correct(const ClothModel& model)
  {
    for (const SpringBatch& batch : model.springs)
    {
      count_call(batch);
      part_calls()[Part::internal_damping] += compliance_ * batch.damping > 0.0 ? 1 : 0;
    }
    Sheet& sheet = *sheet_;
    sheet.springs.correct(sheet.nodes(), records() ? &sheet.pulls : nullptr);
  }

  /// The strain limit. Returns the passes that it took.
  int shorten(bool is_last)
  {
    Sheet& sheet = *sheet_;
    int passes = sheet.limit.follow(sheet.nodes(), max_strain_, passes_);
    if (is_last)
    {
      passes += sheet.limit.finish(sheet.nodes(), max_strain_, passes_);
    }
    if (records())
    {
      sheet.limit.add_tensions_to(sheet.pulls.from(0));
    }
    return passes;
  }

  void arrive()
  {
    Sheet& sheet = *sheet_;
    for_each_column([&](size_t d) {
      return [way = sheet.ways.from(0)[d], x = sheet.positions.singles().from(0)[d]](int i) { x[i] += way[i]; };
    });
  }

  void record_external_forces(const Dynamics& dynamics, double h, const ClothState& state)
  {
    dynamics.external_forces_on_all(state.time, forces_);
    dynamics.air().add_forces(dynamics.model(), state.time, state.positions, state.velocities, forces_);
    add_impulses(h, forces_);
  }

  void end_step(const Pins& pins, double substep, ClothState& state)
  {
    bring_up_to_date(substep, state);
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
