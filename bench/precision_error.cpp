// What single precision adds to the error of xpbd, for docs/methods.md: precision_error FILE.csv
//
// A level sheet held at two corners falls for 0.2 s without a strain limit, in substeps of many lengths, in doubles and
// in mixed precision. The file gets the distance of both from the exact motion, and from each other, root mean square
// over the nodes, m. The exact motion is that of rk4 in steps so short that twice as long ones change it by less than a
// thousandth of the least error: the program ends with an error otherwise.

#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <sstream>

#include "cloth_sim/methods/method.h"

#include "level_sheet.h"

namespace cloth
{
namespace
{

constexpr int frames = 12;
constexpr double frame = 1.0 / 60.0;

Vectors positions_after(const LevelSheet& sheet, const char* method, double time_step, const MethodSettings& settings)
{
  Simulation simulation = simulation_of(sheet, { 0.0 }, method, time_step, settings);
  simulation.advance_to(frames * frame);
  return simulation.state().positions;
}

double rms(const Vectors& difference)
{
  return std::sqrt(difference.squaredNorm() / static_cast<double>(difference.rows()));
}

/// Returns how much the exact motion is in doubt, relative to the least error.
double write_rows(int nodes_a_side, std::ostream& output)
{
  const LevelSheet sheet(nodes_a_side);
  const double fine = frame / (16.0 * nodes_a_side);
  const Vectors exact = positions_after(sheet, "rk4", fine, one_iteration);
  const double doubt = rms(exact - positions_after(sheet, "rk4", 2.0 * fine, one_iteration));
  double least = std::numeric_limits<double>::infinity();
  for (int substeps = 8; substeps <= 4096; substeps *= 2)
  {
    const auto xpbd = [&](Precision precision) {
      return positions_after(sheet, "xpbd", frame, { 1e-3, substeps, 1.0, precision });
    };
    const Vectors in_double = xpbd(Precision::in_double);
    const Vectors mixed = xpbd(Precision::mixed);
    const double error = rms(in_double - exact);
    least = std::min(least, error);
    output << nodes_a_side << ',' << frame / substeps << ',' << error << ',' << rms(mixed - exact) << ','
           << rms(mixed - in_double) << '\n';
  }
  return doubt / least;
}

}  // namespace
}  // namespace cloth

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: precision_error FILE.csv\n";
    return 2;
  }
  std::ostringstream rows;
  rows << "nodes_a_side,substep,double,mixed,apart\n";
  for (const int nodes_a_side : { 16, 32, 64 })
  {
    const double doubt = cloth::write_rows(nodes_a_side, rows);
    if (!(doubt < 1e-3))
    {
      std::cerr << "precision_error: the exact motion of " << nodes_a_side << " x " << nodes_a_side
                << " nodes is not known to a thousandth of the least error, but to " << doubt << '\n';
      return 1;
    }
  }
  std::ofstream output(argv[1]);
  output << rows.str();
  if (!output.flush())
  {
    std::cerr << "precision_error: cannot write " << argv[1] << '\n';
    return 1;
  }
  return 0;
}
