#include "cloth_sim/scene/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cloth_sim/scene/pin_selection.h"
#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/scene_start.h"
#include "cloth_sim/scene/yaml_text.h"

#include "../planning/grid_report.h"
#include "../planning/model_parts.h"
#include "../planning/planner.h"
#include "../planning/step_search.h"

namespace cloth
{
namespace
{

constexpr const char* automatic = "auto";
/// Where nothing was tried: no other explicit method is as cheap for its order.
constexpr const char* untried_method = "velocity_verlet";

PlanLine spring_line(const SheetProperties& sheet, SpringKind kind, const SpringProperties& properties)
{
  PlanLine line{ std::string(name_of(kind)) + " springs", false, "stiffness is 0" };
  if (properties.stiffness == 0.0)
  {
    return line;
  }
  int count = 0;
  for (const SpringBatch& batch : make_sheet(sheet).springs)
  {
    count += batch.kind == kind ? batch.size() : 0;
  }
  if (count == 0)
  {
    line.reason =
        "the grid of " + std::to_string(sheet.rows) + " x " + std::to_string(sheet.cols) + " nodes has no room for one";
    return line;
  }
  line.kept = true;
  line.reason = std::to_string(count) + " of " + format_number(properties.stiffness) + " N/m" +
                (properties.damping == 0.0 ? ", undamped" : " and " + format_number(properties.damping) + " N s/m");
  return line;
}

PlanLine internal_damping_line(const SheetProperties& sheet)
{
  double most = 0.0;
  for (const SpringProperties& kind : { sheet.structural, sheet.shear, sheet.flex })
  {
    most = kind.stiffness > 0.0 ? std::max(most, kind.damping) : most;
  }
  return { "internal damping", most > 0.0,
           most > 0.0 ? "at most " + format_number(most) + " N s/m" : "no spring is damped" };
}

PlanLine gravity_line(const SceneParams& scene)
{
  const bool kept = !scene.gravity.isZero(0.0);
  return { "gravity", kept, kept ? format_number(scene.gravity.norm()) + " m/s2" : "it is 0" };
}

PlanLine viscous_damping_line(const SceneParams& scene)
{
  const double coefficient = scene.air.viscous_damping;
  return { "viscous damping", coefficient > 0.0,
           coefficient > 0.0 ? format_number(coefficient) + " N s/m per m2" : "the coefficient is 0" };
}

std::string gusts_in_words(const GustProperties& gusts)
{
  return gusts.strength == 0.0 ? "" : " with gusts of " + format_number(gusts.strength) + " m/s";
}

PlanLine wind_line(const SceneParams& scene)
{
  if (scene.air.wind_coupling == 0.0)
  {
    return { "wind", false, "air.wind_coupling is 0; no normals are computed" };
  }
  if (scene.sheet.rows == 1 || scene.sheet.cols == 1)
  {
    return { "wind", false, "a chain has no normals" };
  }
  return { "wind", true,
           format_number(scene.air.wind_coupling) + " N s/m per m2, air at " + format_number(scene.air.wind.norm()) +
               " m/s" + gusts_in_words(scene.air.gusts) + "; still air drags too" };
}

PlanLine strain_limit_line(const SceneParams& scene)
{
  if (scene.strain_limit.max_strain == 0.0)
  {
    return { "strain limit", false, "max_strain is 0" };
  }
  if (scene.sheet.structural.stiffness == 0.0 && scene.sheet.shear.stiffness == 0.0)
  {
    return { "strain limit", false, "there are no structural and no shear springs" };
  }
  return { "strain limit", true,
           format_number(scene.strain_limit.max_strain) + " in at most " + std::to_string(scene.strain_limit.sweeps) +
               " sweeps a step" };
}

std::string counted(size_t number, const std::string& noun)
{
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

PlanLine pin_line(const std::vector<Pin>& pins)
{
  size_t nodes = 0;
  size_t moving = 0;
  for (const Pin& pin : pins)
  {
    nodes += pin.nodes.size();
    moving += pin.oscillation.amplitude.isZero(0.0) ? 0 : 1;
  }
  if (nodes == 0)
  {
    return { "pins", false, "the scene has none" };
  }
  return { "pins", true,
           counted(nodes, "node") + " in " + counted(pins.size(), "pin") + ", " + std::to_string(moving) +
               " of them moving" };
}

/// What the scene's settings make of a method, to be added to its name.
std::string settings_of(const SolverParams& solver)
{
  if (solver.method == "dopri5")
  {
    return "; each step's error at most " + format_number(solver.tolerance) + " m";
  }
  if (solver.method == "projective")
  {
    return "; " + counted(static_cast<size_t>(solver.iterations), "local-global iteration") + " a step";
  }
  if (solver.method == "xpbd")
  {
    return "; " + counted(static_cast<size_t>(solver.iterations), "substep") +
           " a step, the springs' compliance times " + format_number(solver.compliance) +
           (solver.compliance == 0.0 ? ": position-based dynamics" : "") +
           (solver.precision == Precision::mixed ? ", in mixed precision" : "");
  }
  return "";
}

constexpr const char* method_part = "method";
constexpr const char* start_part = "start";

/// What the scene leaves open is not chosen yet.
Planned as_the_scene_says(const SceneParams& scene)
{
  Planned planned;
  const bool is_open = scene.solver.method == automatic;
  planned.choice.method = is_open ? untried_method : scene.solver.method;
  planned.choice.time_step = scene.solver.time_step;
  planned.choice.tolerance = scene.solver.tolerance;
  planned.choice.iterations = scene.solver.iterations;
  planned.reason = is_open ? std::string(untried_method) + ", until the scene is loaded again and others are tried" :
                             scene.solver.method + ", as the scene says" + settings_of(scene.solver);
  return planned;
}

constexpr const char* sleep_part = "sleep";
/// A cloth sleeps where going on would move no node by more than this part of the tolerance.
constexpr double share_of_sleep = 0.25;

double sleep_distance(const SceneParams& scene)
{
  const bool may_sleep = scene.plan == "auto" && scene.solver.method == automatic;
  return may_sleep ? share_of_sleep * scene.solver.tolerance : 0.0;
}

PlanLine sleep_line(const SceneParams& scene)
{
  if (scene.plan != "auto")
  {
    return { sleep_part, false, "plan is " + scene.plan };
  }
  if (scene.solver.method != automatic)
  {
    return { sleep_part, false, "solver.method is " + scene.solver.method + ", not auto" };
  }
  return { sleep_part, true,
           "no steps while the sheet is at rest, within " + format_number(sleep_distance(scene)) +
               " m, a quarter of the tolerance" };
}

constexpr const char* error_part = "error watch";
/// What is run again takes twice as long besides; a node has other things to do as well.
constexpr double most_cost_to_check = 0.3;
/// Steps may take so much of real time.
constexpr double most_cost = 0.5;
constexpr double longest_chosen_step = 1.0 / 30.0;  // s

/// In words why the steps of a choice are not checked while they run; empty: they are.
std::string reason_for_no_checks(const SceneParams& scene, const Choice& choice)
{
  if (scene.solver.method != automatic)
  {
    return "solver.method is " + scene.solver.method + ", not auto";
  }
  if (find_method(choice.method) != nullptr && find_method(choice.method)->is_adaptive)
  {
    return choice.method + " watches each of its steps";
  }
  if (!(choice.cost <= most_cost_to_check))
  {
    return std::isnan(choice.cost) ?
               "nothing was tried" :
               "steps of " + in_two_digits(choice.cost) + " s of work a second leave no time to run any of them again";
  }
  return {};
}

/// What cannot be had is not asked for again while it runs.
double watched_tolerance(const SceneParams& scene, const Choice& choice)
{
  return choice.error > scene.solver.tolerance ? 2.0 * choice.error : scene.solver.tolerance;
}

PlanLine error_line(const SceneParams& scene, const Choice& choice)
{
  const std::string reason = reason_for_no_checks(scene, choice);
  if (!reason.empty())
  {
    return { error_part, false, reason };
  }
  return { error_part, true,
           "now and then a second is run again by half steps; they are corrected where they err by more than " +
               in_two_digits(watched_tolerance(scene, choice)) + " m" };
}

ErrorBounds error_bounds(const SceneParams& scene, const Choice& choice)
{
  if (!reason_for_no_checks(scene, choice).empty())
  {
    return {};
  }
  const double given = scene.solver.time_step;
  return { watched_tolerance(scene, choice), std::min(1.0, choice.cost / most_cost),
           given > 0.0 ? given : longest_chosen_step };
}

Planned planned_for(const SceneParams& scene, const SceneStart& start)
{
  if (scene.solver.method != automatic)
  {
    return as_the_scene_says(scene);
  }
  StepCosts costs(StepCosts::usual_path());
  return plan_by_trial({ scene, start }, costs);
}

/// A line of the scene, with what a trial said of its part.
PlanLine after_trial(PlanLine line, const Planned& planned, double tolerance)
{
  const auto tried = std::find_if(planned.tried.begin(), planned.tried.end(),
                                  [&](const TriedPart& part) { return part.part == line.part; });
  if (tried == planned.tried.end())
  {
    return line;
  }
  const std::vector<std::string>& left_out = planned.choice.left_out;
  const std::string change = in_two_digits(tried->change) + " m";
  if (std::find(left_out.begin(), left_out.end(), line.part) == left_out.end())
  {
    line.reason += "; without, the answer changes by " + change + " or more";
    return line;
  }
  return { line.part, false,
           "it changes the answer by " + change + ", the tolerance is " + format_number(tolerance) + " m (" +
               line.reason + ")" };
}

void require_fitting_compliance(const SolverParams& solver)
{
  if (solver.compliance != 1.0 && solver.method != "xpbd")
  {
    throw SceneError("solver.compliance: " + format_number(solver.compliance) +
                     ", but only xpbd has a compliance of its own; 1 is allowed with solver.method " + solver.method);
  }
}

void require_fitting_precision(const SolverParams& solver)
{
  if (solver.precision == Precision::mixed && solver.method != "xpbd")
  {
    throw SceneError(
        "solver.precision: mixed, but only xpbd has a mixed precision; double is allowed with "
        "solver.method " +
        solver.method);
  }
}

Plan plan_with(const SceneParams& scene, const ClothModel& model, const SceneStart& start, const Planned& planned)
{
  Plan plan;
  plan.asked = scene;
  plan.choice = planned.choice;
  plan.method = find_method(plan.choice.method);
  plan.scene = without(scene, plan.choice.left_out);
  plan.scene.solver.method = plan.choice.method;
  plan.scene.solver.time_step = plan.choice.time_step;
  plan.scene.solver.tolerance = plan.choice.tolerance;
  plan.scene.solver.iterations = plan.choice.iterations;
  plan.keeps_within_limit = scene.solver.method == automatic;
  plan.start = start.state;
  plan.start_is_settled = start.is_settled;
  plan.sleep_distance = sleep_distance(scene);
  plan.lines = {
    spring_line(scene.sheet, SpringKind::structural, scene.sheet.structural),
    spring_line(scene.sheet, SpringKind::shear, scene.sheet.shear),
    spring_line(scene.sheet, SpringKind::flex, scene.sheet.flex),
    internal_damping_line(scene.sheet),
    gravity_line(scene),
    viscous_damping_line(scene),
    wind_line(scene),
    strain_limit_line(scene),
    pin_line(pins_of(scene.pins, model, model.rest_positions)),
    { start_part, true, start.description },
    { method_part, true, planned.reason },
    error_line(scene, plan.choice),
    sleep_line(scene),
  };
  for (PlanLine& line : plan.lines)
  {
    line = after_trial(line, planned, scene.solver.tolerance);
  }
  if (!strain_limit_line(scene).kept)
  {
    plan.scene.strain_limit.max_strain = 0.0;
  }
  return plan;
}

SimulationSetup setup_of(const Plan& plan)
{
  const SceneParams& scene = plan.scene;
  SimulationSetup setup;
  setup.model = make_sheet(scene.sheet);
  setup.gravity = scene.gravity;
  setup.air = scene.air;
  setup.strain_limit = scene.strain_limit;
  setup.method = plan.method;
  setup.method_settings = { scene.solver.tolerance, scene.solver.iterations, scene.solver.compliance,
                            scene.solver.precision };
  setup.time_step = scene.solver.time_step;
  setup.keeps_within_limit = plan.keeps_within_limit;
  setup.threads = scene.solver.threads;
  setup.start = plan.start;
  setup.start_is_settled = plan.start_is_settled;
  setup.sleep_distance = plan.sleep_distance;
  setup.error_bounds = error_bounds(plan.asked, plan.choice);
  setup.pins = pins_of(scene.pins, setup.model, setup.start.positions);
  return setup;
}

/// `given` is the step of the scene, s.
void require_a_stable_step(double given, const Simulation& simulation)
{
  if (!simulation.method().is_adaptive && !(simulation.time_step() >= Simulation::shortest_step))
  {
    throw SceneError(
        "solver.time_step: " +
        (given == 0.0 ? std::string("0, to be chosen from") : format_number(given) + ", to be kept within") +
        " the stability limit, but no step of " + std::string(simulation.method().name) +
        " is stable for this scene, since nothing damps some of its modes; damp the air and the springs, "
        "give a step and watch it grow, or take another method");
  }
}

/// No method can step with forces whose squares overflow.
void require_forces_to_reckon_with(const Simulation& simulation)
{
  const ClothState& state = simulation.state();
  Vectors accelerations;
  simulation.dynamics().accelerations(state.time, state.positions, state.velocities, accelerations);
  if (!std::isfinite(accelerations.squaredNorm()))
  {
    throw SceneError("the forces on the cloth as it is would be too large to reckon with; take smaller values");
  }
}

}  // namespace

Plan make_plan(const SceneParams& scene)
{
  require_fitting_compliance(scene.solver);
  require_fitting_precision(scene.solver);
  return make_plan(scene, scene_start(scene, make_sheet(scene.sheet)));
}

Plan make_plan(const SceneParams& scene, const SceneStart& start)
{
  require_fitting_compliance(scene.solver);
  require_fitting_precision(scene.solver);
  return plan_with(scene, make_sheet(scene.sheet), start, planned_for(scene, start));
}

Plan make_plan(const SceneParams& scene, const Choice& choice)
{
  require_fitting_compliance(scene.solver);
  require_fitting_precision(scene.solver);
  const ClothModel model = make_sheet(scene.sheet);
  Planned planned = as_the_scene_says(scene);
  if (scene.solver.method == automatic)
  {
    planned.choice = choice;
    planned.reason = choice.method + ", as it was chosen before";
  }
  return plan_with(scene, model, scene_start(scene, model), planned);
}

Plan live_plan(const Plan& running, const SceneParams& scene)
{
  require_fitting_compliance(scene.solver);
  require_fitting_precision(scene.solver);
  SceneStart start{ running.start, {}, false };
  for (const PlanLine& line : running.lines)
  {
    start.description = line.part == start_part ? line.reason : start.description;
  }
  Planned planned = as_the_scene_says(scene);
  if (scene.solver.method == automatic && running.asked.solver.method == automatic)
  {
    planned.choice = running.choice;
    planned.choice.left_out.clear();
    if (scene.solver.time_step != running.asked.solver.time_step)
    {
      planned.choice.time_step = scene.solver.time_step;
    }
    for (const PlanLine& line : running.lines)
    {
      planned.reason = line.part == method_part ? line.reason : planned.reason;
    }
  }
  return plan_with(scene, make_sheet(scene.sheet), start, planned);
}

std::string described_grid(const Plan& plan)
{
  StepCosts costs(StepCosts::usual_path());
  return grid_report({ plan.asked, { plan.start, {}, plan.start_is_settled } }, plan.choice, costs);
}

Simulation build_simulation(const Plan& plan)
{
  Simulation simulation(setup_of(plan));
  require_a_stable_step(plan.scene.solver.time_step, simulation);
  return simulation;
}

Simulation carry_on(const Plan& plan, const Simulation& running)
{
  Simulation simulation = running.gone_over_to(setup_of(plan));
  require_forces_to_reckon_with(simulation);
  require_a_stable_step(plan.scene.solver.time_step, simulation);
  return simulation;
}

namespace
{

std::string described_step(const Plan& plan, const Simulation& simulation, double stability_limit)
{
  const double given = plan.scene.solver.time_step;
  const std::string name = simulation.method().name;
  const std::string limit = format_number(stability_limit) + " s";
  if (simulation.method().is_adaptive)
  {
    return "chosen by " + name + (given > 0.0 ? ", at most " + format_number(given) + " s" : "") +
           "; steps beyond its stability limit, " + limit + ", would be rejected";
  }
  const std::string step = format_number(simulation.time_step()) + " s, ";
  const std::optional<double>& corrected = simulation.error_watch().corrected_step();
  if (corrected && *corrected == simulation.time_step())
  {
    return step + "as a check of the error has corrected it; the stability limit of " + name + " is " + limit;
  }
  if (given > 0.0 && plan.keeps_within_limit && !std::isfinite(stability_limit))
  {
    return step + "as chosen; " + name + " is stable at any";
  }
  if (given > 0.0 && plan.keeps_within_limit)
  {
    return step + "as chosen, and never above " + format_number(Simulation::limit_share) +
           " of the stability limit of " + name + ", " + limit;
  }
  if (given > simulation.time_step())
  {
    return step + format_number(Simulation::limit_share) + " of the stability limit of " + name + ", " + limit +
           ", which the " + format_number(given) + " s of the scene are beyond";
  }
  if (given > 0.0)
  {
    return step + "as the scene says; the stability limit of " + name + " is " + limit;
  }
  if (std::isfinite(stability_limit))
  {
    const bool is_of_a_bound = simulation.time_step() < (Simulation::limit_share - 0.02) * stability_limit;
    return step + (is_of_a_bound ? "from a bound within " : "") + format_number(Simulation::limit_share) +
           " of the stability limit of " + name + ", " + limit + ", and with it as the sheet deforms";
  }
  return step + "1/240 s, since nothing here limits the step of " + name;
}

std::string described_threads(const Simulation& simulation)
{
  const int threads = simulation.dynamics().threads();
  return counted(static_cast<size_t>(threads), "thread") + " for " +
         counted(static_cast<size_t>(simulation.model().nodes()), "node") + "; one more is worth its while for every " +
         std::to_string(Simulation::nodes_a_thread);
}

}  // namespace

std::vector<std::string> describe(const Plan& plan, const Simulation& simulation)
{
  return describe(plan, simulation, simulation.stability_limit());
}

std::vector<std::string> describe(const Plan& plan, const Simulation& simulation, double stability_limit)
{
  std::vector<std::string> lines;
  for (const PlanLine& line : plan.lines)
  {
    lines.push_back(line.part + ": " + (line.kept ? "kept, " : "left out, ") + line.reason);
    if (line.part == sleep_part && simulation.asleep_since())
    {
      lines.back() += "; asleep since " + format_number(*simulation.asleep_since()) + " s";
    }
    const std::optional<ErrorWatch::Finding>& finding = simulation.error_watch().finding();
    if (line.part == error_part && finding)
    {
      lines.back() += "; in the second before " + format_number(finding->time) + " s those of " +
                      in_two_digits(finding->step) + " s erred by " + in_two_digits(finding->error) + " m";
    }
  }
  lines.push_back("threads: " + described_threads(simulation));
  lines.push_back("time step: " + described_step(plan, simulation, stability_limit));
  return lines;
}

std::string time_step_warning(const Simulation& simulation)
{
  const double limit = simulation.stability_limit();
  if (simulation.method().is_adaptive || simulation.time_step() <= limit)
  {
    return {};
  }
  return "solver.time_step is " + format_number(simulation.time_step()) + " s, beyond the stability limit of " +
         simulation.method().name + ", " + format_number(limit) + " s";
}

std::string convergence_warning(const Simulation& simulation)
{
  const Simulation::Counters& counters = simulation.counters();
  if (counters.unconverged_steps == 0)
  {
    return {};
  }
  return std::to_string(counters.unconverged_steps) + " of " + std::to_string(counters.steps) + " steps of " +
         simulation.method().name + " were not solved to its bound; a shorter solver.time_step helps" +
         (std::string(simulation.method().name) == "projective" ? ", and so do more solver.iterations" : "");
}

std::string reach_warning(const Simulation& simulation)
{
  const StrainLimit& limit = simulation.strain_limit();
  if (!limit.active() || limit.reach().strain <= limit.properties().max_strain)
  {
    return {};
  }
  return "the pins " + limit.reach().first + " and " + limit.reach().second +
         " are so far apart that springs between them are strained by " + format_number(limit.reach().strain) +
         " at least, and strain_limit.max_strain is " + format_number(limit.properties().max_strain) +
         ": the limit gives way; bring the pins nearer to each other";
}

}  // namespace cloth
