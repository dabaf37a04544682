#include "problem.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/methods/spectrum.h"
#include "cloth_sim/scene/scene_start.h"
#include "cloth_sim/scene/start_state.h"

namespace cloth
{
namespace
{

constexpr double pi = 3.14159265358979323846;

void displace_asymmetrically(const SceneParams& scene, const ClothModel& model, ClothState& state)
{
  StartParams shape = scene.start;
  shape.ripple = 0.01 * std::min(model.width, model.height);
  const Eigen::RowVector3d normal = rotation_of(shape.rpy).col(1).transpose();
  state.positions += ripple_of(shape, model) * normal;
}

}  // namespace

const char* name_of(Kind kind)
{
  return kind == Kind::trajectory ? "trajectory" : kind == Kind::limited ? "limited" : "spatial";
}

Problem problem_of(const std::string& name, Kind kind, SceneParams scene, double horizon)
{
  if (kind != Kind::limited)
  {
    scene.strain_limit.max_strain = 0.0;
  }
  scene.solver.method = "velocity_verlet";
  scene.solver.time_step = 0.0;
  scene.solver.compliance = 1.0;
  scene.solver.precision = Precision::in_double;
  scene.solver.threads = 1;
  const ClothModel model = make_sheet(scene.sheet);
  SceneStart start = scene_start(scene, model);
  if (scene.start.shape != "flat" || scene.start.ripple == 0.0)
  {
    displace_asymmetrically(scene, model, start.state);
  }
  return { name, kind, make_plan(scene, start), horizon };
}

Problem disturbed(Problem problem, double size)
{
  const ClothModel model = make_sheet(problem.plan.scene.sheet);
  Vectors displacement(model.nodes(), 3);
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double a = static_cast<double>(model.col_of(i)) / std::max(1, model.cols - 1);
    const double b = static_cast<double>(model.row_of(i)) / std::max(1, model.rows - 1);
    displacement.row(i) << std::sin(pi * a + 0.7 * b), std::cos(2.0 * pi * b - a), std::sin(1.5 * pi * (a + b) + 0.4);
  }
  const double root_mean_square = std::sqrt(displacement.squaredNorm() / model.nodes());
  problem.plan.start.positions += size / root_mean_square * displacement;
  return problem;
}

double horizon_of(const SceneParams& scene, double longest, double most_node_steps)
{
  const Problem problem = problem_of({}, Kind::trajectory, scene, longest);
  const Simulation simulation = simulation_of(problem, "velocity_verlet", 1.0, {});
  const double nodes = simulation.model().nodes();
  const double affordable = most_node_steps / nodes * simulation.stability_limit();
  double power = 1.0;
  double horizon = 0.5;
  for (int i = 1; horizon > std::min(longest, affordable); ++i)
  {
    power *= i % 3 == 0 ? 10.0 : 1.0;
    horizon = (i % 3 == 0 ? 0.5 : i % 3 == 1 ? 0.25 : 0.1) / power;
  }
  return horizon;
}

Simulation simulation_of(const Problem& problem, const std::string& method, double time_step,
                         const MethodSettings& settings)
{
  Plan plan = problem.plan;
  plan.method = find_method(method);
  plan.scene.solver.method = method;
  plan.scene.solver.time_step = time_step;
  plan.scene.solver.tolerance = settings.tolerance;
  plan.scene.solver.iterations = settings.iterations;
  return build_simulation(plan);
}

}  // namespace cloth
