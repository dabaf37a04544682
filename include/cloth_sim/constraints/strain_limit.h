#pragma once

#include <memory>
#include <vector>

#include "cloth_sim/constraints/pin_reach.h"
#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// How the springs that are too long are shortened.
enum class LimitSolver
{
  tensions,     ///< the shortest correction, from the tensions of the step before: mostly two passes
  plain_sweeps  ///< spring after spring, as Provot describes it: more passes than the grid is wide
};

struct StrainLimitProperties
{
  double max_strain = 0.1;  ///< critical deformation rate tau_c; 0: no limit
  int sweeps = 30;          ///< most passes over the springs after a step
  LimitSolver solver = LimitSolver::tensions;
};

class Shortening;

/// Provot's cure for super-elasticity (1995, section 4): after the positions have moved, structural and shear springs
/// whose strain |l|/l0 - 1 is above max_strain are shortened along themselves until none is. Their ends share the shift
/// by inverse mass; a pinned end stays. Velocities follow: v <- v + (x_corrected - x)/h; without this the method is
/// unstable. The momentum of what is not pinned stays.
///
/// The plain sweeps shorten every spring to exactly max_strain. Tensions hold springs at a margin below it, which is at
/// its least while steps need few passes, and grows while they need many.
class StrainLimit
{
public:
  /// A strain this much above max_strain, relative to it, counts as reached. What a spring is shortened by from there
  /// becomes speed, over the step: a larger tolerance throws nodes about in short steps.
  static constexpr double tolerance = 5e-4;
  /// Where tensions hold springs below max_strain, relative to it.
  static constexpr double least_margin = 5e-4;
  static constexpr double most_margin = 0.15;

  StrainLimit(const ClothModel& model, const StrainLimitProperties& properties);
  StrainLimit(StrainLimit&&) noexcept;
  StrainLimit& operator=(StrainLimit&&) noexcept;
  ~StrainLimit();

  /// False: max_strain is 0, and `apply` must not be called.
  bool active() const
  {
    return properties_.max_strain > 0.0;
  }
  const StrainLimitProperties& properties() const
  {
    return properties_;
  }
  /// The strain of a spring that the limit holds, of a sheet at rest, for pins as they were last; 0: there is no limit.
  double held_strain() const;

  /// Takes over what `before`, another limit of the same sheet, has found out about it, so that fewer passes do.
  void go_on_from(const StrainLimit& before);

  /// What the pins demanded of the sheet when `apply` was called last. Where that is more than max_strain, the limit is
  /// raised to 1.05 of it, so that there is a shape that obeys it.
  const PinReach& reach() const
  {
    return reach_;
  }

  /// max_strain, or where the pins demand more that which the sheet is held to while they are where they are.
  double max_strain_for(const ClothModel& model, const Pins& pins, const Vectors& positions);

  /// What one call did.
  struct Report
  {
    int sweeps = 0;       ///< passes made, the last of which may have found nothing
    bool moved = false;   ///< some node moved
    bool reached = true;  ///< no spring that can be shortened is above the limit
  };

  /// Corrects the positions and velocities of `state` after a step of length h (s). Where `impulses` is given, what the
  /// springs gave to held nodes is added to their rows, N s: minus what free nodes gained in momentum from them. Other
  /// rows are of no meaning.
  Report apply(const ClothModel& model, const Pins& pins, double h, ClothState& state, Vectors* impulses = nullptr);

private:
  static constexpr double room_of_reach = 1.05;

  double strain_in_force() const;
  void find_reach(const ClothModel& model, const Pins& pins, const Vectors& positions);

  StrainLimitProperties properties_;
  std::unique_ptr<Shortening> shortening_;
  Eigen::VectorXd inverse_masses_;  ///< and room behind the last node
  PinReach reach_;
  std::vector<double> held_;  ///< nodes and positions, pin by pin, that reach_ was found for
  Vectors corrected_;
};

}  // namespace cloth
