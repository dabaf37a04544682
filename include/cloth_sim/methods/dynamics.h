#pragma once

#include <algorithm>
#include <memory>

#include <Eigen/Core>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/forces/air.h"
#include "cloth_sim/forces/springs.h"
#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/node_range.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/threads/crew.h"

namespace cloth
{

/// The differential equation that a method advances, m_i a_i = f_i(t, x, v) with the pinned nodes' motion prescribed.
/// Const while stepping.
class Dynamics
{
public:
  Dynamics(ClothModel model, const Eigen::Vector3d& gravity, const AirProperties& air);
  virtual ~Dynamics() = default;
  Dynamics(Dynamics&&) = default;
  Dynamics& operator=(Dynamics&&) = default;

  /// From now on for_each_band shares its work out to so many threads, this one among them. Throws std::system_error
  /// where there are no more threads to be had. The results are the same to the last bit for any number.
  void use_threads(int threads);
  int threads() const
  {
    return crew_ ? crew_->threads() : 1;
  }

  const ClothModel& model() const
  {
    return model_;
  }
  const Eigen::Vector3d& gravity() const
  {
    return gravity_;
  }
  const Air& air() const
  {
    return air_;
  }
  Air& air()
  {
    return air_;
  }
  const Pins& pins() const
  {
    return pins_;
  }
  Pins& pins()
  {
    return pins_;
  }

  /// The forces that depend on time alone, N: gravity. Those on `nodes` are overwritten.
  virtual void external_forces(double time, NodeRange nodes, Vectors& forces) const;
  /// Of all nodes; `forces` is overwritten.
  void external_forces_on_all(double time, Vectors& forces) const;

  /// The force on every node but for the air's: springs and external forces, N. `forces` is overwritten.
  void forces_without_air(double time, const Vectors& positions, const Vectors& velocities, Vectors& forces) const;

  /// The force on every node, N. `forces` is overwritten.
  void forces(double time, const Vectors& positions, const Vectors& velocities, Vectors& forces) const;

  /// M^-1 f of every node, in m/s2: of pinned ones what they would do if they were let go. May be done in place.
  void unheld_accelerations_of(const Vectors& forces, Vectors& accelerations) const;

  /// M^-1 f, in m/s2, zero for pinned nodes. May be done in place.
  void accelerations_of(const Vectors& forces, Vectors& accelerations) const;

  /// The acceleration of every node, air included, zero for pinned nodes: the right-hand side as a whole.
  void accelerations(double time, const Vectors& positions, const Vectors& velocities, Vectors& accelerations) const;

  /// The same with what pinned nodes would do if they were let go.
  void unheld_accelerations(double time, const Vectors& positions, const Vectors& velocities,
                            Vectors& accelerations) const;

  // The same by parts, for work that is shared out to threads or to be done while its data are in the nearest cache.

  /// Shares the sheet out to the threads: work(nodes) is called for bands of whole stretches, together all nodes. Calls
  /// are made at the same time; they may write to their own nodes alone, and read of others what none writes.
  template <typename Work>
  void for_each_band(Work&& work) const;

  /// The forces without air on the nodes of a band, N, which are overwritten. done(stretch) is called for stretch after
  /// stretch of the band as soon as its forces are complete.
  template <typename Done>
  void forces_without_air(double time, const Vectors& positions, const Vectors& velocities, NodeRange band,
                          Vectors& forces, Done&& done) const;

  /// M^-1 f of some nodes; pinned ones are not told apart.
  void divide_by_masses(NodeRange nodes, Vectors& forces) const;

private:
  /// The band of one of the threads; it may be empty.
  NodeRange band_of(int thread) const;

  ClothModel model_;
  Eigen::Vector3d gravity_;
  Air air_;
  Pins pins_;
  Eigen::ArrayXd inverse_masses_;
  int longest_reach_;
  std::unique_ptr<Crew> crew_;
};

template <typename Work>
void Dynamics::for_each_band(Work&& work) const
{
  if (!crew_)
  {
    work(all_nodes(model_));
    return;
  }
  const PartCalls calls_before = part_calls();
  PartCalls calls_of_first;  // whichever thread does it
  const auto share = [&](int thread) {
    const NodeRange band = band_of(thread);
    const PartCalls begin = part_calls();
    if (band.size() > 0)
    {
      work(band);
    }
    if (thread == 0)
    {
      calls_of_first.add_difference(begin, part_calls());
    }
  };
  crew_->run(share);
  part_calls() = calls_before;
  part_calls().add_difference({}, calls_of_first);
}

template <typename Done>
void Dynamics::forces_without_air(double time, const Vectors& positions, const Vectors& velocities, NodeRange band,
                                  Vectors& forces, Done&& done) const
{
  int begun = band.begin;
  for_each_stretch(model_, { std::max(0, band.begin - longest_reach_), band.end }, [&](NodeRange stretch) {
    const int reached = std::min(stretch.end + longest_reach_, band.end);
    if (reached > begun)
    {
      external_forces(time, { begun, reached }, forces);
      begun = reached;
    }
    add_spring_forces(model_, positions, velocities, stretch, band, forces);
    if (stretch.begin >= band.begin)
    {
      done(stretch);
    }
  });
}

}  // namespace cloth
