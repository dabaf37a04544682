#pragma once

// What tests of several rooms share.

#include <limits>
#include <memory>
#include <ostream>
#include <random>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/cloth_state.h"
#include "cloth_sim/scene/plan.h"
#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/start_state.h"
#include "cloth_sim/simulation/simulation.h"

namespace cloth
{

inline const std::vector<std::string> shipped_scenes{ "hanging_sheet", "curtain", "flag",      "hammock",
                                                      "trampoline",    "chain",   "free_sheet" };

inline SceneParams shipped_scene(const std::string& name)
{
  return read_scene(load_scene_file("config/" + name + ".yaml"));
}

/// How a failing test names the method that it was run with.
inline void PrintTo(const MethodRow& row, std::ostream* stream)
{
  *stream << row.name;
}

/// The name that a test of every method has.
inline std::string name_of_method(const testing::TestParamInfo<MethodRow>& info)
{
  return info.param.name;
}

/// Settings with which a method does what its row says at every step that it is given: dopri5 takes it as it is, xpbd
/// makes no substeps of it, projective iterates until nothing moves.
inline MethodSettings one_step_a_call(const MethodRow& row)
{
  MethodSettings settings;
  settings.tolerance = std::numeric_limits<double>::infinity();
  settings.iterations = std::string(row.name) == "projective" ? 8 : 1;
  return settings;
}

inline std::unique_ptr<Method> make(const MethodRow& row)
{
  return row.make(one_step_a_call(row));
}

/// Reproducible numbers in [-1, 1].
class Noise
{
public:
  double number()
  {
    return 2.0 * static_cast<double>(generator_()) / generator_.max() - 1.0;
  }
  Eigen::Vector3d vector()
  {
    return { number(), number(), number() };
  }
  Vectors vectors(int nodes)
  {
    Vectors result(nodes, 3);
    for (int i = 0; i < nodes; ++i)
    {
      result.row(i) = vector().transpose();
    }
    return result;
  }

private:
  std::mt19937 generator_{ 20 };
};

/// A small sheet of unequal cells with all three kinds of springs, each damped.
inline SheetProperties small_sheet(int rows = 5, int cols = 6)
{
  SheetProperties sheet;
  sheet.rows = rows;
  sheet.cols = cols;
  sheet.width = 0.5;
  sheet.height = 0.3;
  sheet.mass = 0.04;
  sheet.structural = { 80.0, 0.02 };
  sheet.shear = { 50.0, 0.01 };
  sheet.flex = { 7.0, 0.005 };
  return sheet;
}

/// A chain of `links` equal masses more than one, 1 m long, of undamped springs.
inline SheetProperties chain(int nodes, double stiffness, double node_mass)
{
  SheetProperties sheet;
  sheet.rows = nodes;
  sheet.cols = 1;
  sheet.width = 0.01;
  sheet.height = 1.0;
  sheet.mass = node_mass * nodes;
  sheet.mass_lumping = MassLumping::uniform;
  sheet.structural = { stiffness, 0.0 };
  sheet.shear = { 0.0, 0.0 };
  sheet.flex = { 0.0, 0.0 };
  return sheet;
}

/// No air at all.
inline AirProperties vacuum()
{
  return { 0.0, 0.0, Eigen::Vector3d::Zero(), {} };
}

/// The start of a simulation in which nothing but springs acts.
inline SimulationSetup springs_alone(const SheetProperties& sheet, const char* method, double time_step)
{
  SimulationSetup setup;
  setup.model = make_sheet(sheet);
  setup.air = vacuum();
  setup.strain_limit.max_strain = 0.0;
  setup.method = find_method(method);
  setup.time_step = time_step;
  setup.start.positions = setup.model.rest_positions;
  setup.start.velocities = Vectors::Zero(setup.model.nodes(), 3);
  return setup;
}

inline Pin still_pin(const std::string& name, const std::vector<int>& nodes, const Vectors& positions)
{
  return { name, nodes, positions(nodes, Eigen::all), {}, {} };
}

}  // namespace cloth
