#pragma once

#include <cstddef>
#include <vector>

namespace cloth
{

/// What our kernels are measured against: a sheet held at its two upper corners, stepped by velocity Verlet in loops as
/// one writes them down first, row by row, springs damped at the predicted velocities, air that damps alone,
/// implicitly. Its source is compiled for the machine at hand (-O3 -march=native).
class PlainSheet
{
public:
  struct Springs
  {
    double stiffness;
    double damping;
  };

  PlainSheet(int nodes_a_side, double side, double mass, double air_damping, Springs structural, Springs shear,
             Springs flex);

  void step(double h);

  std::size_t springs() const;

  /// The three columns of an n x 3 matrix one after the other.
  std::vector<double> positions;
  std::vector<double> velocities;

private:
  struct Direction
  {
    int down;
    int across;
    double stiffness;
    double damping;
    double rest_length;
  };

  void add_spring_forces(const Direction& direction);
  template <bool damped>
  void find_row_forces(const Direction& direction, int i, int count);
  void hold_corners(std::vector<double>& vectors) const;

  int n_;
  int nodes_;
  double air_damping_;  // N s/m, of the sheet
  std::vector<Direction> directions_;
  std::vector<double> masses_;
  std::vector<double> shares_;
  std::vector<double> accelerations_;
  std::vector<double> predicted_;
  std::vector<double> forces_;
  std::vector<double> row_x_;
  std::vector<double> row_y_;
  std::vector<double> row_z_;
};

}  // namespace cloth
