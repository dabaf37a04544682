#pragma once

#include <string>
#include <vector>

#include "cloth_sim/methods/method.h"
#include "cloth_sim/scene/choice.h"
#include "cloth_sim/scene/scene_params.h"
#include "cloth_sim/scene/scene_start.h"
#include "cloth_sim/simulation/simulation.h"

namespace cloth
{

/// One part of the model: kept or left out, and why.
struct PlanLine
{
  std::string part;
  bool kept = true;
  std::string reason;
};

/// What of a scene is modelled, decided once before the simulation is built.
struct Plan
{
  SceneParams scene;  ///< without what is left out
  SceneParams asked;  ///< with it
  const MethodRow* method = nullptr;
  Choice choice;
  bool keeps_within_limit = false;  ///< the step was chosen, and is shortened where the stability limit asks for it
  ClothState start;                 ///< the sheet at time 0
  bool start_is_settled = false;
  double sleep_distance = 0.0;  ///< m, see SimulationSetup
  std::vector<PlanLine> lines;
};

/// Decides what the scene needs. Throws SceneError where its parts do not fit together (pins outside the sheet, a
/// node in two pins, a start that the scene does not have). A settled start is worked out here, and where solver.method
/// is auto, trial runs on a coarser grid find out which method, which step and, where plan is auto, which parts meet
/// solver.tolerance at the least cost; what steps cost is measured once on a machine and kept in a file.
Plan make_plan(const SceneParams& scene);

/// The same of a sheet that starts as `start` says, not as the scene does; pins hold their nodes where that has them.
Plan make_plan(const SceneParams& scene, const SceneStart& start);

/// The same with a choice that was made before: nothing is tried. Throws SceneError where it names a method or a part
/// that there is none of.
Plan make_plan(const SceneParams& scene, const Choice& choice);

/// In words the coarsest grid that would do for a plan's scene, found by runs on grids up to its own, and what that
/// would save; or that there is none. Takes longer than the plan. Throws SceneError where such a grid cannot be
/// simulated.
std::string described_grid(const Plan& plan);

/// The simulation of a plan, at time 0.
Simulation build_simulation(const Plan& plan);

/// The plan of a scene that differs from that of `running` in live keys alone; the start stays that of `running`.
/// Throws SceneError where its parts do not fit together.
Plan live_plan(const Plan& running, const SceneParams& scene);

/// The simulation of `plan`, a live plan, that carries on where `running` is; its wind is the plan's. Throws SceneError
/// where no step of the method is stable, and where forces are too large for any.
Simulation carry_on(const Plan& plan, const Simulation& running);

/// The plan's lines and one for the step as `simulation` takes it now, each as text: "flex springs: left out,
/// stiffness is 0".
std::vector<std::string> describe(const Plan& plan, const Simulation& simulation);
/// The same where `Simulation::stability_limit` is known already: to find it takes as long as some 20 steps.
std::vector<std::string> describe(const Plan& plan, const Simulation& simulation, double stability_limit);

/// One sentence with both numbers where the given step is beyond the stability limit; empty otherwise.
std::string time_step_warning(const Simulation& simulation);

/// One sentence with the number of steps whose equations the method did not solve to its bound; empty where there are
/// none.
std::string convergence_warning(const Simulation& simulation);

/// Which pins are too far apart for the strain limit as they are now, and by how much. Empty: none are.
std::string reach_warning(const Simulation& simulation);

}  // namespace cloth
