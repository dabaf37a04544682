#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <random>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <ros/rate.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>

#include "node_process.h"
#include "pin_message.h"
#include "stalled_listener.h"
#include "state_message.h"
#include "tick_ledger.h"
#include "time_services.h"
#include "tuning_client.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothStats;
using geometry_msgs::Vector3Stamped;
using visualization_msgs::InteractiveMarkerFeedback;
using PinMessage = cloth_sim::Pin;

constexpr double rate = 50.0;
constexpr int size = 8;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Vector3Stamped wind(double x, double y, double z, const std::string& frame = "")
{
  Vector3Stamped message;
  message.header.frame_id = frame;
  message.vector.x = x;
  message.vector.y = y;
  message.vector.z = z;
  return message;
}

/// Whatever has been asked for: back to a cloth that any computer is fast enough for.
Change calm()
{
  return Change()
      .set("solver_method", "auto")
      .set("solver_time_step", 0.0)
      .set("solver_compliance", 1.0)
      .set("springs_structural_stiffness", 100.0)
      .set("springs_shear_stiffness", 100.0)
      .set("springs_structural_damping", 0.0)
      .set("springs_shear_damping", 0.0)
      .set("springs_flex_damping", 0.0)
      .set("air_viscous_damping", 1.0);
}

/// How many periods lie between two states, by the numbers that the node gave them: some may be lost on the way.
int periods_between(const ClothState& earlier, const ClothState& later)
{
  return static_cast<int>(later.header.seq - earlier.header.seq);
}

/// Random requests, the same in every run.
class Requests
{
public:
  Vector3Stamped some_wind()
  {
    return wind(number(-20, 20), number(-20, 20), number(-20, 20));
  }

  PinMessage some_pin()
  {
    // Each pin has a node and stays near the place where that hangs.
    const int row = 2 * integer(0, 4);  // the last of each is not on the sheet
    const int col = 2 * integer(0, 4);
    const std::string name = "pin_" + std::to_string(row) + std::to_string(col);
    const double x = static_cast<double>(col) / (size - 1) - 0.5 + number(-0.05, 0.05);
    const double z = 1.5 - static_cast<double>(row) / (size - 1) + number(-0.05, 0.05);
    switch (integer(0, 5))
    {
      case 0:
        return release_pin(name);
      case 1:
      case 2:
        return move_pin(name, { x, number(-0.05, 0.05), z });
      default:
        return pin_node(name, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(col));
    }
  }

  /// Some key, to some value: often a good one, sometimes out of range or not finite.
  Change some_change()
  {
    static const std::vector<std::pair<const char*, double>> numbers{ { "springs_structural_stiffness", 2000 },
                                                                      { "springs_structural_damping", 0.05 },
                                                                      { "springs_shear_stiffness", 2000 },
                                                                      { "springs_shear_damping", 0.05 },
                                                                      { "springs_flex_stiffness", 200 },
                                                                      { "springs_flex_damping", 0.05 },
                                                                      { "air_viscous_damping", 5 },
                                                                      { "air_wind_coupling", 5 },
                                                                      { "air_wind_x", 20 },
                                                                      { "gravity_y", 20 },
                                                                      { "gravity_z", 20 },
                                                                      { "solver_time_step", 0.01 },
                                                                      { "solver_compliance", 1 } };
    static const std::vector<const char*> methods{
      "auto",           "explicit_euler",    "symplectic_euler", "midpoint",   "rk4",  "dopri5",
      "implicit_euler", "implicit_midpoint", "tr_bdf2",          "projective", "xpbd", "no_such_method"
    };
    static const std::vector<double> bad{ nan, infinity, -infinity, -1.0, 1e300, 1e-300 };
    Change change;
    const int kind = integer(0, static_cast<int>(numbers.size()) + 2);
    if (kind < static_cast<int>(numbers.size()))
    {
      const auto& [name, scale] = numbers[static_cast<size_t>(kind)];
      const bool is_bad = integer(0, 4) == 0;
      change.set(name, is_bad ? bad[static_cast<size_t>(integer(0, 5))] : number(0, scale));
    }
    else if (kind == static_cast<int>(numbers.size()))
    {
      change.set("strain_limit_sweeps", integer(-5, 60));
    }
    else
    {
      change.set("solver_method", methods[static_cast<size_t>(integer(0, static_cast<int>(methods.size()) - 1))]);
    }
    return change;
  }

  int integer(int low, int high)
  {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }

private:
  double number(double low, double high)
  {
    return low + (high - low) * static_cast<double>(random_()) / static_cast<double>(std::mt19937::max());
  }

  std::mt19937 random_{ 1 };
};

class Robustness : public testing::Test
{
protected:
  /// Without a strain limit, which no sheet can keep whose pins are drawn farther apart than it allows.
  static std::vector<std::string> sheet()
  {
    return { "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8", "_cloth/ripple:=0.02", "_strain_limit/max_strain:=0" };
  }

  bool wait_for_node()
  {
    return wait_until([&] {
      return pins_.getNumSubscribers() > 0 && winds_.getNumSubscribers() > 0 && points_.getNumSubscribers() > 0 &&
             feedback_.getNumSubscribers() > 0 && ledger_.states().all().size() > 2;
    });
  }

  /// Waits until what was sent is there, and a tick after it.
  bool wait_for_marked_tick()
  {
    pins_.publish(pin_node("mark", size - 1, size / 2));
    const size_t mark = (size - 1) * size + size / 2;
    return ledger_.states().wait_for_one([=](const ClothState& state) { return state.flags[mark] != 0; });
  }

  void send_one_of(Requests& requests)
  {
    switch (requests.integer(0, 3))
    {
      case 0:
        ASSERT_TRUE(requests.some_change().ask());
        break;
      case 1:
        winds_.publish(requests.some_wind());
        break;
      default:
        pins_.publish(requests.some_pin());
    }
    ros::getGlobalCallbackQueue()->callAvailable();
  }

  ros::NodeHandle node_;
  TickLedger ledger_{ rate };
  ros::Publisher pins_ = node_.advertise<PinMessage>("/cloth_node/pin", 5000);
  ros::Publisher points_ = node_.advertise<geometry_msgs::PointStamped>("/cloth_node/pin_point", 5000);
  ros::Publisher winds_ = node_.advertise<Vector3Stamped>("/cloth_node/wind", 5000);
  ros::Publisher feedback_ = node_.advertise<InteractiveMarkerFeedback>("/cloth_node/pin_handles/feedback", 5000);
};

TEST_F(Robustness, AThousandRandomRequestsLeaveAFiniteClothAndLoseNoTickUncounted)
{
  NodeProcess node(sheet());
  ASSERT_TRUE(wait_for_node()) << node.output();
  Requests requests;
  int balanced = 0;
  for (int round = 0; round < 5; ++round)
  {
    SCOPED_TRACE(round);
    ledger_.open();
    const size_t said_before = node.output().size();
    for (int i = 0; i < 200; ++i)
    {
      ASSERT_NO_FATAL_FAILURE(send_one_of(requests)) << node.output();
    }
    ASSERT_TRUE(calm().ask());
    ASSERT_TRUE(ledger_.states().wait_for_more(2));
    if (node.output().find("diverged", said_before) != std::string::npos)
    {
      // Some of what was asked for may be beyond a method; that is said, no simulated time passes until it is undone.
      ASSERT_TRUE(trigger("reset").success);
      continue;
    }
    ledger_.expect_balance();
    ++balanced;
  }
  EXPECT_GT(balanced, 0);
  ledger_.expect_finite_states();
}

TEST_F(Robustness, AFloodOfWindAndPinsLosesNoTickUncounted)
{
  NodeProcess node(sheet());
  ASSERT_TRUE(wait_for_node()) << node.output();
  ledger_.open();
  Requests requests;
  ros::WallRate kilohertz(1000.0);
  for (int i = 0; i < 3000; ++i)
  {
    winds_.publish(requests.some_wind());
    pins_.publish(requests.some_pin());
    ros::getGlobalCallbackQueue()->callAvailable();
    kilohertz.sleep();
  }
  winds_.publish(wind(0, 0, 0));
  // Again and again: the node refuses a pin where a thousand wait.
  ASSERT_TRUE(wait_until([&] {
    pins_.publish(release_pin(""));
    return pinned_nodes(ledger_.states().last()) == 0;
  }));
  EXPECT_EQ(node.output().find("diverged"), std::string::npos) << node.output();
  ledger_.expect_balance();
  ledger_.expect_finite_states();
}

TEST_F(Robustness, EmptyHugeAndNotFiniteFieldsChangeNothing)
{
  NodeProcess node(sheet());
  ASSERT_TRUE(wait_for_node()) << node.output();
  ASSERT_TRUE(ledger_.states().wait_for_more(1));
  const auto flags = ledger_.states().last().flags;
  ledger_.open();
  const std::string huge(1000000, 'x');
  for (const double bad : { nan, infinity, -infinity, 1e300, -1e300 })
  {
    winds_.publish(wind(bad, 0, 0));
    winds_.publish(wind(0, bad, bad));
    pins_.publish(pin_nearest("a", { bad, 0, 0 }));
    pins_.publish(move_pin("left", { 0, bad, 0 }));
    pins_.publish(pin_within("a", { 0, 0, 9 }, bad > 0.0 ? -1.0 : bad));
    geometry_msgs::PointStamped point;
    point.point.z = bad;
    points_.publish(point);
    InteractiveMarkerFeedback drag;
    drag.event_type = InteractiveMarkerFeedback::POSE_UPDATE;
    drag.marker_name = "left";
    drag.pose.position.x = bad;
    feedback_.publish(drag);
  }
  winds_.publish(wind(1, 1, 1, huge));
  pins_.publish(pin_node(huge, 1, 1));
  pins_.publish(release_pin(huge));
  pins_.publish(move_pin("", { 0, 0, 0 }));
  constexpr std::uint32_t far_off = std::numeric_limits<std::uint32_t>::max();
  pins_.publish(pin_node("a", far_off, far_off));
  PinMessage nothing_known = pin_node("a", 1, 1);
  nothing_known.action = 255;
  pins_.publish(nothing_known);
  feedback_.publish(InteractiveMarkerFeedback());
  InteractiveMarkerFeedback nobody;
  nobody.event_type = 200;
  nobody.marker_name = huge;
  nobody.header.frame_id = huge;
  feedback_.publish(nobody);
  ASSERT_TRUE(ledger_.states().wait_for_more(25));
  EXPECT_EQ(ledger_.states().last().flags, flags);
  ASSERT_TRUE(wait_for_marked_tick());
  ledger_.expect_balance();
  ledger_.expect_finite_states();
  EXPECT_EQ(node.output().find("diverged"), std::string::npos) << node.output().substr(0, 5000);
  EXPECT_LT(node.output().size(), 100000u) << "the log does not repeat what is huge";
}

TEST_F(Robustness, EveryRealTimeFactorTakesTheClothOnByItsShare)
{
  NodeProcess node(sheet());
  ASSERT_TRUE(wait_for_node()) << node.output();
  for (const double factor : { 0.1, 1.0, 10.0, 0.0 })
  {
    SCOPED_TRACE(factor);
    ASSERT_TRUE(Change().set("real_time_factor", factor).ask());
    const double period = (factor == 0.0 ? 1.0 : factor) / rate;
    Listener<ClothState>& states = ledger_.states();
    ClothState before = states.last();
    ASSERT_TRUE(states.wait_for_one([&](const ClothState& state) {
      const double gap = state.sim_time - before.sim_time;
      const int periods = periods_between(before, state);
      before = state;
      return std::abs(gap - periods * period) < 1e-9;
    }));
    states.forget();
    ASSERT_TRUE(states.wait_for(10));
    for (size_t i = 1; i < 10; ++i)
    {
      const ClothState& before_it = states.all()[i - 1];
      const ClothState& state = states.all()[i];
      EXPECT_NEAR(state.sim_time - before_it.sim_time, periods_between(before_it, state) * period, 1e-9);
    }
  }
  ledger_.expect_finite_states();
}

TEST_F(Robustness, OverloadIsCountedAndTheClothGoesOnTickByTick)
{
  NodeProcess node({ "_rate:=50", "_cloth/rows:=16", "_cloth/cols:=16" });
  ASSERT_TRUE(wait_for_node()) << node.output();
  ledger_.open();
  // Twenty thousand steps a tick.
  ASSERT_TRUE(Change().set("solver_time_step", 1e-6).ask());
  ASSERT_TRUE(ledger_.stats().wait_for_one([](const ClothStats& stats) { return stats.overruns > 50; }));
  ASSERT_TRUE(Change().set("solver_time_step", 0.0).ask());
  ledger_.expect_balance();
  const auto& states = ledger_.states().all();
  for (size_t i = 1; i < states.size(); ++i)
  {
    EXPECT_NEAR(states[i].sim_time - states[i - 1].sim_time, periods_between(states[i - 1], states[i]) / rate, 1e-9);
  }
}

TEST_F(Robustness, AfterAResetOverrunsAreCountedAnewAndNoTickIsLostUncounted)
{
  NodeProcess node({ "_rate:=50", "_cloth/rows:=16", "_cloth/cols:=16" });
  ASSERT_TRUE(wait_for_node()) << node.output();
  // Overruns amid the simulated times that come again after the reset.
  ASSERT_TRUE(ledger_.states().wait_for_one([](const ClothState& state) { return state.sim_time > 2.0; }));
  ASSERT_TRUE(Change().set("solver_time_step", 1e-6).ask());
  ASSERT_TRUE(ledger_.stats().wait_for_one([](const ClothStats& stats) { return stats.overruns > 50; }));
  ASSERT_TRUE(Change().set("solver_time_step", 0.0).ask());
  ASSERT_TRUE(ledger_.states().wait_for_one([](const ClothState& state) { return state.sim_time > 5.0; }));
  ASSERT_TRUE(trigger("reset").success);
  ledger_.open();
  EXPECT_LT(ledger_.stats().last().overruns, 50u);
  ledger_.expect_balance();
}

TEST_F(Robustness, ATickThatDoesNotEndIsShownAndTakenBack)
{
  Listener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  NodeProcess node(sheet());
  ASSERT_TRUE(wait_for_node()) << node.output();
  ledger_.open();
  // Twenty million steps a tick.
  ASSERT_TRUE(Change().set("solver_time_step", 1e-9).ask());
  ASSERT_TRUE(ledger_.stats().wait_for_one([](const ClothStats& stats) { return stats.time_step == 1e-9; }));
  EXPECT_TRUE(diagnostics.wait_for_one([](const diagnostic_msgs::DiagnosticArray& array) {
    return std::any_of(array.status.begin(), array.status.end(), [](const auto& status) {
      return status.message.find("a tick has taken") == 0 && status.level == diagnostic_msgs::DiagnosticStatus::WARN;
    });
  }));
  ASSERT_TRUE(Change().set("solver_time_step", 0.0).ask());
  ASSERT_TRUE(ledger_.states().wait_for_more(10));
  ledger_.expect_balance();

  ASSERT_TRUE(Change().set("solver_time_step", 1e-9).ask());
  ASSERT_TRUE(ledger_.stats().wait_for_one([](const ClothStats& stats) { return stats.time_step == 1e-9; }));
  ASSERT_TRUE(trigger("reset").success);
  EXPECT_TRUE(ledger_.states().wait_for_one([](const ClothState& state) { return state.sim_time == 0.0; }));
  node.signal(SIGTERM);
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_EQ(node.exit_status(), 0);
}

TEST_F(Robustness, AListenerThatNeverReadsHoldsNothingUp)
{
  NodeProcess node({ "_rate:=50", "_cloth/rows:=24", "_cloth/cols:=24" });
  ASSERT_TRUE(wait_for_node()) << node.output();
  const StalledListener mesh("/cloth_node", "/cloth_node/mesh");
  const StalledListener state("/cloth_node", "/cloth_node/state");
  ledger_.open();
  // Some 20 MB of meshes: more than fits between the two.
  ASSERT_TRUE(ledger_.states().wait_for_more(150));
  ledger_.expect_balance();
}

}  // namespace
}  // namespace cloth
