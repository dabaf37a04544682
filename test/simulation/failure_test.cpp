// How the methods fail that do not simply grow: each in its own way, measured.

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/simulation/energy.h"
#include "methods/oscillator.h"
#include "support.h"

namespace cloth
{
namespace
{

SceneParams hanging_sheet(const char* method, int nodes)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = nodes;
  scene.strain_limit.max_strain = 0.0;
  scene.solver.method = method;
  return scene;
}

Simulation simulation_of(const SceneParams& scene)
{
  return build_simulation(make_plan(scene));
}

TEST(ExplicitEuler, GrowsWithoutDampingAtEveryStepAsTheFormulaSays)
{
  // |1 + i z| = sqrt(1 + z^2) a step.
  for (const double z : { 1e-3, 1e-2, 0.1, 1.0 })
  {
    Oscillator oscillator("explicit_euler", 1.0, 0.0, 0.0);
    oscillator.put(1e-6, 0.0);
    const double before = oscillator.energy(1.0);
    for (int s = 0; s < 10; ++s)
    {
      oscillator.step(z);
    }
    // The spring's length is taken from positions of the size 1, and so has their rounding error.
    EXPECT_NEAR(oscillator.energy(1.0) / before, std::pow(1.0 + z * z, 10), 1e-8 * std::pow(1.0 + z * z, 10));
  }
}

TEST(ExplicitEuler, RefusesToChooseAStepWhereNoneIsStable)
{
  for (const char* const method : { "explicit_euler", "midpoint" })
  {
    SceneParams scene = hanging_sheet(method, 6);
    scene.air = vacuum();
    try
    {
      simulation_of(scene);
      FAIL() << method;
    }
    catch (const SceneError& error)
    {
      const std::string text = error.what();
      for (const char* const part : { "solver.time_step: 0", method, "no step", "damp" })
      {
        EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
      }
    }
    scene.solver.time_step = 1e-4;
    Simulation simulation = simulation_of(scene);
    EXPECT_EQ(simulation.stability_limit(), 0.0);
    EXPECT_FALSE(time_step_warning(simulation).empty());
  }
}

TEST(ExplicitEuler, StopsWithTheReasonWhereTheLastStableStepIsLostOnTheWay)
{
  // At rest every mode is damped in proportion; under tension those across the sheet are not damped at all.
  SheetProperties sheet = small_sheet();
  for (SpringProperties* const kind : { &sheet.structural, &sheet.shear, &sheet.flex })
  {
    kind->damping = 2e-4 * kind->stiffness;
  }
  SimulationSetup setup = springs_alone(sheet, "explicit_euler", 0.0);
  setup.pins = { still_pin("left", { 0, 6, 12, 18, 24 }, setup.start.positions),
                 still_pin("right", { 5, 11, 17, 23, 29 }, setup.start.positions) };
  Simulation simulation(setup);
  EXPECT_GT(simulation.time_step(), 1e-5);
  simulation.carry("right", { 0.4, 0.0, -0.15 }, 0.2);
  EXPECT_FALSE(simulation.advance_to(1.0));
  EXPECT_NE(simulation.divergence_report().find("no step of explicit_euler is stable any more"), std::string::npos)
      << simulation.divergence_report();
}

TEST(DormandPrince5, RejectsStepsBeyondItsLimitAndStaysRight)
{
  // Loose enough that stability bounds the step, and tight enough that accuracy does.
  SceneParams scene = hanging_sheet("dopri5", 10);
  scene.solver.tolerance = 1e-2;
  Simulation loose = simulation_of(scene);
  ASSERT_TRUE(loose.advance_to(1.0));
  EXPECT_GT(loose.counters().rejected_steps, 10u);
  const double mean_step = 1.0 / static_cast<double>(loose.counters().steps);
  EXPECT_LT(mean_step, 4.0 * loose.stability_limit());
  EXPECT_GT(mean_step, loose.stability_limit());

  scene.solver.tolerance = 1e-9;
  Simulation tight = simulation_of(scene);
  ASSERT_TRUE(tight.advance_to(1.0));
  EXPECT_LT(tight.counters().rejected_steps, tight.counters().steps / 10);
  EXPECT_GT(tight.counters().steps, 2 * loose.counters().steps);
}

TEST(DormandPrince5, MakesErrorsInProportionToItsTolerance)
{
  const auto end_for = [](double tolerance) {
    SceneParams scene = hanging_sheet("dopri5", 6);
    scene.solver.tolerance = tolerance;
    Simulation simulation = simulation_of(scene);
    simulation.advance_to(0.2);
    return simulation.state().positions;
  };
  const Vectors reference = end_for(1e-13);
  double coarser = (end_for(1e-5) - reference).rowwise().norm().maxCoeff();
  EXPECT_LT(coarser, 1e-3);
  for (const double tolerance : { 1e-7, 1e-9 })
  {
    const double finer = (end_for(tolerance) - reference).rowwise().norm().maxCoeff();
    EXPECT_LT(finer, 0.1 * coarser);
    EXPECT_GT(finer, 0.0);
    coarser = finer;
  }
}

TEST(DormandPrince5, TakesNoStepLongerThanTheGivenOne)
{
  SceneParams scene = hanging_sheet("dopri5", 6);
  scene.solver.time_step = 1e-4;
  Simulation simulation = simulation_of(scene);
  simulation.advance_to(0.05);
  EXPECT_GE(simulation.counters().steps, 500u);
  EXPECT_EQ(simulation.state().time, 0.05);
  EXPECT_TRUE(time_step_warning(simulation).empty());
}

TEST(ImplicitEuler, DampsAsItsFormulaSays)
{
  // 1/sqrt(1 + z^2) a step, whatever the spring's own damping, which here is none.
  for (const double z : { 0.05, 0.5, 5.0, 50.0 })
  {
    Oscillator oscillator("implicit_euler", 3.0, 0.0, 0.0);
    oscillator.put(0.01, 0.0);
    const double before = oscillator.energy(3.0);
    for (int s = 0; s < 4; ++s)
    {
      oscillator.step(z / 3.0);
    }
    const double exact = std::pow(1.0 + z * z, -4.0);
    EXPECT_NEAR(oscillator.energy(3.0) / before, exact, 1e-6 * exact) << "z = " << z;
  }
}

TEST(ImplicitEuler, TakesAsMuchFromSlowSwingsAtSixtyHertzAsTheTableSays)
{
  // A swing of 1 Hz loses 28 % of its amplitude in a period.
  Oscillator oscillator("implicit_euler", 2.0 * M_PI, 0.0, 0.0);
  oscillator.put(0.01, 0.0);
  const double before = oscillator.energy(2.0 * M_PI);
  for (int s = 0; s < 60; ++s)
  {
    oscillator.step(1.0 / 60.0);
  }
  EXPECT_NEAR(std::sqrt(oscillator.energy(2.0 * M_PI) / before), 0.72, 0.005);
}

TEST(TrBdf2, DampsWithTheRatioThatItsErrorConstantSays)
{
  // 0.0037 z^3, measured as the decay over many swings.
  const double z = 0.2;
  Oscillator oscillator("tr_bdf2", 3.0, 0.0, 0.0);
  oscillator.put(0.01, 0.0);
  const double before = oscillator.energy(3.0);
  const int steps = 10000;
  for (int s = 0; s < steps; ++s)
  {
    oscillator.step(z / 3.0);
  }
  const double ratio = -0.5 * std::log(oscillator.energy(3.0) / before) / (z * steps);
  EXPECT_NEAR(ratio, 0.0037 * z * z * z, 0.02 * ratio);
}

TEST(ImplicitMethods, CountTheStepsThatTheyCouldNotSolve)
{
  SceneParams scene = hanging_sheet("implicit_euler", 16);
  scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = 1e5;
  scene.solver.time_step = 0.1;
  Simulation rash = simulation_of(scene);
  rash.advance_to(0.3);
  EXPECT_GT(rash.counters().unconverged_steps, 0u);
  scene = hanging_sheet("implicit_euler", 12);
  scene.start.initial_stretch.setOnes();
  scene.solver.time_step = 1e-3;
  Simulation careful = simulation_of(scene);
  careful.advance_to(0.5);
  EXPECT_EQ(careful.counters().unconverged_steps, 0u);
}

TEST(ImplicitMidpoint, GrowsUnderStretchWhereTheStepIsLong)
{
  SceneParams scene = hanging_sheet("implicit_midpoint", 20);
  scene.solver.time_step = 0.01;
  Simulation simulation = simulation_of(scene);
  EXPECT_TRUE(std::isinf(simulation.stability_limit()));
  EXPECT_FALSE(simulation.advance_to(3.0));
  EXPECT_NE(simulation.divergence_report().find("energy of"), std::string::npos);
  scene.solver.time_step = 1e-3;
  Simulation careful = simulation_of(scene);
  EXPECT_TRUE(careful.advance_to(3.0)) << careful.divergence_report();
}

/// A sheet a hundred times as stiff as the default one.
SceneParams stiff_sheet(int iterations)
{
  SceneParams scene = hanging_sheet("projective", 12);
  scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = 1e4;
  scene.solver.iterations = iterations;
  scene.solver.time_step = 1.0 / 240.0;
  return scene;
}

/// The worst strain when that sheet falls into its pins.
double strain_at_the_jerk(int iterations)
{
  Simulation simulation = simulation_of(stiff_sheet(iterations));
  double worst = 0.0;
  for (int k = 1; k <= 60; ++k)
  {
    simulation.advance_to(0.02 * k);
    worst = std::max(worst, max_strain(simulation.model(), simulation.state().positions));
  }
  return worst;
}

TEST(Projective, IsTooSoftWhereIterationsAreFewAndSaysSo)
{
  const double converged = strain_at_the_jerk(400);
  const double many = strain_at_the_jerk(30);
  const double few = strain_at_the_jerk(3);
  EXPECT_GT(many, 1.1 * converged);
  EXPECT_GT(few, 1.5 * many);

  Simulation simulation = simulation_of(stiff_sheet(3));
  simulation.advance_to(0.5);
  EXPECT_GT(simulation.counters().unconverged_steps, simulation.counters().steps / 2);
}

TEST(Projective, ConvergesToImplicitEuler)
{
  // On a smooth motion, the more iterations the nearer.
  const auto end_of = [](const char* method, int iterations) {
    SceneParams scene = hanging_sheet(method, 8);
    scene.solver.iterations = iterations;
    scene.solver.time_step = 1e-3;
    Simulation simulation = simulation_of(scene);
    simulation.advance_to(0.3);
    return simulation.state().positions;
  };
  const Vectors exact = end_of("implicit_euler", 1);
  const double few = (end_of("projective", 4) - exact).rowwise().norm().maxCoeff();
  const double more = (end_of("projective", 8) - exact).rowwise().norm().maxCoeff();
  const double most = (end_of("projective", 40) - exact).rowwise().norm().maxCoeff();
  EXPECT_LT(more, 0.2 * few);
  EXPECT_LT(most, 1e-7);
}

/// How unlike the two halves of a symmetric sheet are after a while, m.
double asymmetry(const char* method, int substeps)
{
  SceneParams scene = hanging_sheet(method, 9);
  scene.start.ripple = 0.0;
  scene.start.initial_stretch.setOnes();
  scene.start.rpy = { 0.5, 0.0, 0.0 };
  scene.solver.iterations = substeps;
  scene.solver.time_step = 1e-3;
  Simulation simulation = simulation_of(scene);
  simulation.advance_to(0.2);
  const Vectors& x = simulation.state().positions;
  const ClothModel& model = simulation.model();
  double worst = 0.0;
  for (int i = 0; i < model.nodes(); ++i)
  {
    const int twin = model.node(model.row_of(i), model.cols - 1 - model.col_of(i));
    const Eigen::RowVector3d mirrored = x.row(twin).cwiseProduct(Eigen::RowVector3d(-1.0, 1.0, 1.0));
    worst = std::max(worst, (x.row(i) - mirrored).norm());
  }
  return worst;
}

TEST(ExtendedPositionBasedDynamics, DependsOnTheOrderOfItsSpringsTheLessTheShorterItsSubsteps)
{
  EXPECT_LT(asymmetry("velocity_verlet", 1), 1e-12);
  const double coarse = asymmetry("xpbd", 1);
  const double fine = asymmetry("xpbd", 10);
  EXPECT_GT(coarse, 1e-5);
  EXPECT_LT(fine, 0.2 * coarse);
}

TEST(ExtendedPositionBasedDynamics, MeansTheSameByStiffnessAsTheOtherMethods)
{
  // The sag of a chain at rest, for two stiffnesses: the others' exact answer, found in the limit of short substeps.
  for (const double k : { 50.0, 500.0 })
  {
    SimulationSetup setup = springs_alone(chain(5, k, 0.1), "xpbd", 1e-3);
    setup.method_settings.iterations = 4;
    setup.gravity = { 0.0, 0.0, -9.81 };
    setup.air.viscous_damping = 400.0;
    setup.pins.push_back(still_pin("hook", { 0 }, setup.start.positions));
    Simulation simulation(setup);
    simulation.advance_to(20.0);
    const double exact = 1.0 + 0.1 * 9.81 * 4 * 5 / (2.0 * k);
    EXPECT_NEAR(-simulation.state().positions(4, 2), exact, 2e-3 * (exact - 1.0)) << "k = " << k;
  }
}

TEST(ExtendedPositionBasedDynamics, WithoutComplianceIsPositionBasedDynamics)
{
  // Stiffness has no meaning, a chain of springs is one of rods as far as the passes reach, and one projection of one
  // spring is exact: both ends move by inverse mass.
  const auto end_for = [](double stiffness) {
    SceneParams scene = hanging_sheet("xpbd", 8);
    scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = scene.sheet.flex.stiffness = stiffness;
    scene.solver.compliance = 0.0;
    Simulation simulation = simulation_of(scene);
    simulation.advance_to(0.5);
    return simulation.state().positions;
  };
  EXPECT_EQ(end_for(10.0), end_for(1e4));

  SimulationSetup setup = springs_alone(chain(2, 10.0, 0.5), "xpbd", 1e-3);
  setup.model.masses << 0.1, 0.3;
  setup.start.positions(1, 2) = -1.4;
  const Dynamics dynamics(setup.model, Eigen::Vector3d::Zero(), vacuum());
  find_method("xpbd")->make({ 1e-3, 1, 0.0 })->step(dynamics, 1e-3, setup.start);
  EXPECT_NEAR(setup.start.positions(0, 2), -0.3, 1e-15);
  EXPECT_NEAR(setup.start.positions(1, 2), -1.3, 1e-15);

  SimulationSetup rods = springs_alone(chain(5, 10.0, 0.1), "xpbd", 1e-3);
  rods.method_settings = { 1e-3, 20, 0.0 };
  rods.gravity = { 0.0, 0.0, -9.81 };
  rods.air.viscous_damping = 100.0;
  rods.pins.push_back(still_pin("hook", { 0 }, rods.start.positions));
  Simulation hanging(rods);
  hanging.advance_to(2.0);
  EXPECT_NEAR(-hanging.state().positions(4, 2), 1.0, 1e-4);
}

TEST(Compliance, OfAnotherMethodThanXpbdIsRefused)
{
  SceneParams scene = hanging_sheet("velocity_verlet", 6);
  scene.solver.compliance = 0.0;
  EXPECT_THROW(make_plan(scene), SceneError);
}

}  // namespace
}  // namespace cloth
