#include "level_sheet.h"

#include <utility>

namespace cloth
{
namespace
{

SheetProperties square(int nodes_a_side)
{
  SheetProperties sheet;
  sheet.rows = nodes_a_side;
  sheet.cols = nodes_a_side;
  return sheet;
}

Pin pin_of(const LevelSheet& sheet, const char* name, int node)
{
  Pin pin;
  pin.name = name;
  pin.nodes = { node };
  pin.held = sheet.start.row(node);
  return pin;
}

}  // namespace

LevelSheet::LevelSheet(int nodes_a_side)
  : model(make_sheet(square(nodes_a_side))), start(model.rest_positions), right(nodes_a_side - 1)
{
  start.col(1).swap(start.col(2));
}

Simulation simulation_of(const LevelSheet& sheet, const StrainLimitProperties& limit, const char* method,
                         double time_step, const MethodSettings& settings)
{
  SimulationSetup setup;
  setup.model = sheet.model;
  setup.gravity = { 0.0, 0.0, -9.81 };
  setup.air.wind_coupling = 0.0;
  setup.start.positions = sheet.start;
  setup.start.velocities = Vectors::Zero(sheet.model.nodes(), 3);
  setup.pins = { pin_of(sheet, "left", sheet.left), pin_of(sheet, "right", sheet.right) };
  setup.strain_limit = limit;
  setup.method = find_method(method);
  setup.method_settings = settings;
  setup.time_step = time_step;
  return Simulation(std::move(setup));
}

}  // namespace cloth
