#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/air.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// One entry of the list `pins`: which nodes, and how they move.
struct PinParams
{
  std::string name;
  std::string at;                         ///< a corner or edge by name; empty: `nodes`
  std::vector<std::array<int, 2>> nodes;  ///< [row, col], negative from the end
  Oscillation motion;
};

/// Where the sheet is at time 0, and how it moves.
struct StartParams
{
  Eigen::Vector3d position{ 0.0, 0.0, 1.5 };      ///< m, middle of the top edge
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();  ///< rad
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector2d initial_stretch = Eigen::Vector2d::Ones();  ///< across, down
  std::string shape = "flat";
  double ripple = 0.0;  ///< m
};

struct SolverParams
{
  std::string method = "auto";
  double time_step = 0.0;   ///< s; 0: from the stability limit
  double tolerance = 1e-3;  ///< m
  int iterations = 10;
  double compliance = 1.0;
  Precision precision = Precision::in_double;
  int threads = 0;  ///< 0: chosen
};

/// How pins follow the tf frames that carry them.
struct TfPinParams
{
  double top_speed = 5.0;  ///< m/s of simulated time
  double max_age = 1.0;    ///< s of ROS time; 0: any
};

/// What only the ROS node uses.
struct NodeParams
{
  double rate = 30.0;             ///< Hz
  double real_time_factor = 1.0;  ///< 0: as fast as it can
  std::string clock_mode = "follow";
  bool start_paused = false;
  std::string start_bag;    ///< a recording to go on from; empty: none
  double start_time = 0.0;  ///< s from its beginning
  TfPinParams tf_pins;
  double wind_timeout = 0.0;                          ///< s of ROS time; 0: none
  std::string colouring = "fabric";                   ///< fabric or strain
  Eigen::Vector3d fabric_colour{ 0.75, 0.16, 0.18 };  ///< red, green, blue in [0, 1]
};

/// A scene as it is written: the values of the table in parameter_table.h.
struct SceneParams
{
  std::string frame_id = "world";
  Eigen::Vector3d gravity{ 0.0, 0.0, -9.81 };
  SheetProperties sheet;
  StartParams start;
  StrainLimitProperties strain_limit;
  AirProperties air;
  std::vector<PinParams> pins{ { "left", "top_left", {}, {} }, { "right", "top_right", {}, {} } };
  SolverParams solver;
  std::string plan = "auto";  ///< auto or full
  NodeParams node;
};

}  // namespace cloth
