#include "cloth_node.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <boost/make_shared.hpp>
#include <ros/console.h>
#include <ros/init.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

#include "answering_services.h"
#include "messages.h"
#include "node_scene.h"
#include "pin_requests.h"
#include "wind_request.h"

namespace cloth
{
namespace
{

using WallClock = std::chrono::steady_clock;

void log_plan(const LiveCloth& cloth)
{
  ROS_INFO("%s", joined(describe(cloth.plan, cloth.simulation), "\n").c_str());
  const std::string warning = time_step_warning(cloth.simulation);
  if (!warning.empty())
  {
    ROS_WARN("%s: the cloth will diverge", warning.c_str());
  }
}

cloth_sim::ClothTopology topology_of(const LiveCloth& cloth, std::uint32_t version)
{
  cloth_sim::ClothTopology message = topology_message(cloth.simulation.model(), version);
  message.header.frame_id = cloth.plan.scene.frame_id;
  return message;
}

/// Whether the two say the same, whenever it was.
bool same_topology(cloth_sim::ClothTopology left, const cloth_sim::ClothTopology& right)
{
  left.header.stamp = right.header.stamp;
  left.header.seq = right.header.seq;
  return left == right;
}

/// Says, here and in the log, that a change has lowered the step; empty where it has not.
std::string step_report(const SceneParams& asked, const LiveCloth& cloth)
{
  const double lowered = cloth.scene.solver.time_step;
  if (lowered == asked.solver.time_step)
  {
    return {};
  }
  const std::string report = "tuning: solver.time_step lowered from " + format_number(asked.solver.time_step) +
                             " s to " + format_number(lowered) + " s, " + format_number(Simulation::limit_share) +
                             " of the stability limit of " + cloth.simulation.method().name;
  ROS_WARN("%s", report.c_str());
  return report;
}

void require_clock_mode(const SceneParams& scene, const std::string& mode)
{
  if (scene.node.clock_mode != mode)
  {
    throw SceneError("clock_mode is " + scene.node.clock_mode + "; allowed: " + mode +
                     ", with which the node was started");
  }
}

}  // namespace

ClothNode::ClothNode(const ros::NodeHandle& private_node, const SceneParams& scene)
  : private_node_(private_node)
  , cloth_(std::make_unique<LiveCloth>(scene))
  , clock_(scene.node)
  , statistics_(WallClock::now())
  , refusals_([](const std::string& cause) { ROS_WARN("refused: %s", cause.c_str()); })
  , pin_warnings_([](const std::string& warning) { ROS_WARN("%s", warning.c_str()); })
  , transform_listener_(transforms_)
  , frames_(scene.frame_id, transforms_)
  , topology_message_(topology_of(*cloth_, 1))
  , handles_(private_node_.getNamespace() + "/pin_handles",
             [this](const PinHandles::Feedback::ConstPtr& feedback) { take_feedback(feedback); })
  , wrenches_(private_node_)
  , health_(private_node_)
  , tuning_(private_node_, scene, [this](const SceneParams& changed) { return tune(changed); })
{
  log_plan(*cloth_);
  advertise();
  advertise_services();
  subscribe();
}

void ClothNode::advertise()
{
  constexpr bool latched = true;
  mesh_ = private_node_.advertise<visualization_msgs::Marker>("mesh", 5, latched);
  springs_ = private_node_.advertise<visualization_msgs::Marker>("springs", 5);
  pins_ = private_node_.advertise<visualization_msgs::MarkerArray>("pins", 5, latched);
  state_ = private_node_.advertise<cloth_sim::ClothState>("state", 100);
  topology_ = private_node_.advertise<cloth_sim::ClothTopology>("topology", 1, latched);
  stats_ = private_node_.advertise<cloth_sim::ClothStats>("stats", 10);
}

void ClothNode::advertise_services()
{
  const auto done_by_tick = [this](Answer (ClothNode::*action)()) {
    return [this, action] { return errands_.send([this, action] { return (this->*action)(); }); };
  };
  const auto pause = [this](bool paused) { return errands_.send([this, paused] { return set_paused(paused); }); };
  services_ = { advertise_switch(private_node_, "set_paused", pause),
                advertise_trigger(private_node_, "step", done_by_tick(&ClothNode::step)),
                advertise_trigger(private_node_, "reset", done_by_tick(&ClothNode::reset)),
                advertise_trigger(private_node_, "reload", [this] { return reload(); }) };
}

void ClothNode::subscribe()
{
  wind_ = private_node_.subscribe("wind", 10, &ClothNode::take_wind, this);
  pin_ = private_node_.subscribe("pin", RequestQueue::most_waiting, &ClothNode::take_pin, this);
  pin_point_ = private_node_.subscribe("pin_point", RequestQueue::most_waiting, &ClothNode::take_point, this);
}

void ClothNode::take_wind(const geometry_msgs::Vector3Stamped& request)
{
  report_refusal("~wind", [&] { requests_.leave_wind(wind_of(request, frames_)); });
}

void ClothNode::take_pin(const cloth_sim::Pin& request)
{
  leave_pin("~pin", request);
}

void ClothNode::take_point(const geometry_msgs::PointStamped& point)
{
  leave_pin("~pin_point", pin_nearest_to(point));
}

void ClothNode::leave_pin(const std::string& topic, const cloth_sim::Pin& request)
{
  leave(topic, [this, request](Simulation&) { apply(request); });
}

void ClothNode::apply(const cloth_sim::Pin& request)
{
  apply_pin(request, frames_, clock_.simulated_period(), cloth_->simulation, cloth_->attachments);
}

void ClothNode::take_feedback(const PinHandles::Feedback::ConstPtr& feedback)
{
  leave("~pin_handles", [this, feedback](Simulation&) {
    if (const auto request = handles_.take(*feedback))
    {
      apply(*request);
    }
  });
}

void ClothNode::leave(const std::string& topic, const RequestQueue::Request& request)
{
  report_refusal(topic, [&] {
    requests_.leave(
        [this, topic, request](Simulation& simulation) { report_refusal(topic, [&] { request(simulation); }); });
  });
}

void ClothNode::report_refusal(const std::string& topic, const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const RefusedRequest& refusal)
  {
    refusals_.report(topic + ": " + refusal.what());
  }
}

Answer ClothNode::set_paused(bool paused)
{
  clock_.set_paused(paused);
  return { true, paused ? "paused" : "running" };
}

Answer ClothNode::step()
{
  if (!clock_.paused())
  {
    return { false, "the cloth is running: only a paused one is stepped; ~set_paused pauses it" };
  }
  run_tick(clock_.step());
  const Simulation& simulation = cloth_->simulation;
  return simulation.divergence() ?
             Answer{ false, simulation.divergence_report() + "; ~reset brings the cloth back to its start" } :
             Answer{ true, "sim_time is " + format_number(simulation.state().time) + " s" };
}

Answer ClothNode::reset()
{
  apply_requests();  // what came before the reset is undone by it
  const double simulated_time = cloth_->simulation.state().time;
  cloth_->restart();
  statistics_.restart(simulated_time);
  start_over();
  return { true, "back at the start" };
}

/// In the caller's thread: the cloth on show goes on while the next is made.
Answer ClothNode::reload()
{
  try
  {
    Answer answer;
    tuning_.replace([&] {
      const SceneParams scene = scene_from_parameters(private_node_.getNamespace());
      require_clock_mode(scene, clock_.is_master() ? "master" : "follow");
      auto next = std::make_unique<LiveCloth>(scene);
      log_plan(*next);
      answer = errands_.send([&] { return replace_cloth(std::move(next)); });
      return scene;
    });
    return answer;
  }
  catch (const std::exception& error)
  {
    ROS_WARN("refused: ~reload: %s", error.what());
    return { false, error.what() };
  }
}

Answer ClothNode::replace_cloth(std::unique_ptr<LiveCloth> next)
{
  apply_requests();  // they were meant for the old cloth
  statistics_.restart(cloth_->simulation.state().time);
  if (const auto markers = cloth_->pins.update({}, cloth_->simulation.state().positions, clock_.now()))
  {
    pins_.publish(markers);
  }
  handles_.clear();
  cloth_ = std::move(next);
  powerless_wind_reported_ = false;
  frames_.set_frame_id(cloth_->plan.scene.frame_id);
  tuning_report_.clear();
  publish_topology_if_changed();
  start_over();
  return { true, "the scene of the parameter server is at its start" };
}

SceneParams ClothNode::tune(const SceneParams& scene)
{
  SceneParams in_force = scene;
  const Answer answer = errands_.send([&] {
    const Answer done = tune_cloth(scene);
    in_force = cloth_->scene;
    return done;
  });
  if (!answer.success)
  {
    throw SceneError(answer.message);
  }
  return in_force;
}

Answer ClothNode::tune_cloth(const SceneParams& scene)
{
  apply_requests();  // they were meant for the cloth as it was
  try
  {
    cloth_ = std::make_unique<LiveCloth>(*cloth_, scene);
  }
  catch (const SceneError& error)
  {
    tuning_report_ = std::string("tuning: refused: ") + error.what();
    return { false, error.what() };
  }
  tuning_report_ = step_report(scene, *cloth_);
  clock_.set_pace(cloth_->scene.node);
  publish_topology_if_changed();
  if (clock_.paused())
  {
    publish_cloth(clock_.now());
  }
  return { true, {} };
}

void ClothNode::start_over()
{
  clock_.restart(cloth_->plan.scene.node);
  divergence_reported_ = false;
  started_over_ = true;
  publish_cloth(clock_.now());
}

void ClothNode::run()
{
  const Errands::Doer doer(errands_);
  publish_topology();
  publish_cloth(clock_.now());
  while (goes_on())
  {
    errands_.do_all();
    if (const auto tick = clock_.take())
    {
      run_tick(*tick);
    }
    else
    {
      idle();
    }
    publish_stats_when_due();
    publish_diagnostics_when_due();
  }
}

bool ClothNode::goes_on() const
{
  return ros::ok() && !stops_;
}

void ClothNode::run_tick(const Tick& tick)
{
  const auto begin = WallClock::now();
  apply_requests();
  carry_pins(tick.simulated_time);
  const bool measures = prepare_wrenches();
  if (advance(tick.simulated_time))
  {
    clock_.show(tick);
    publish_cloth(tick.stamp);
    if (measures && !cloth_->simulation.divergence())
    {
      wrenches_.publish(cloth_->simulation, cloth_->plan.scene.frame_id, tick.stamp);
    }
  }
  statistics_.add(WallClock::now() - begin);
}

void ClothNode::idle()
{
  if (clock_.paused() && apply_requests())
  {
    publish_cloth(clock_.now());
  }
  clock_.rest().sleep();
}

bool ClothNode::apply_requests()
{
  const auto requests = requests_.take_all();
  if (!requests.empty())
  {
    bring_back_what_was_left_out();
  }
  for (const RequestQueue::Request& request : requests)
  {
    request(cloth_->simulation);
  }
  return apply_wind() || !requests.empty();
}

bool ClothNode::apply_wind()
{
  if (const auto wind = requests_.take_wind())
  {
    if (*wind != cloth_->simulation.dynamics().air().properties().wind)
    {
      bring_back_what_was_left_out();
    }
    warn_where_wind_has_no_effect();
    cloth_->simulation.set_wind(*wind);
    cloth_->wind_time_out.restart(clock_.now());
    return true;
  }
  if (cloth_->wind_time_out.is_over(clock_.now()))
  {
    ROS_WARN("no message on ~wind for more than wind_timeout, %s s: the scene's wind blows again",
             format_number(cloth_->plan.scene.node.wind_timeout).c_str());
    cloth_->simulation.set_wind(cloth_->plan.scene.air.wind);
    return true;
  }
  return false;
}

/// A trial holds for the scene as it was tried, not for what comes from outside.
void ClothNode::bring_back_what_was_left_out()
{
  const std::vector<std::string> left_out = cloth_->plan.choice.left_out;
  if (left_out.empty())
  {
    return;
  }
  try
  {
    cloth_ = std::make_unique<LiveCloth>(*cloth_, cloth_->scene);
    ROS_INFO("from now on with %s, since something came that was not there in the trial", joined(left_out).c_str());
    publish_topology_if_changed();
  }
  catch (const SceneError& error)
  {
    ROS_WARN("goes on without %s: %s", joined(left_out).c_str(), error.what());
  }
}

void ClothNode::warn_where_wind_has_no_effect()
{
  const Simulation& simulation = cloth_->simulation;
  if (powerless_wind_reported_ || simulation.dynamics().air().is_coupled(simulation.model()))
  {
    return;
  }
  powerless_wind_reported_ = true;
  ROS_WARN("~wind has no effect: %s",
           simulation.model().is_chain() ? "a chain has no normals, along which wind acts" : "air.wind_coupling is 0");
}

void ClothNode::carry_pins(double simulated_time)
{
  cloth_->attachments.carry(frames_, clock_.now(), simulated_time, cloth_->simulation,
                            [this](const std::string& warning) { pin_warnings_.report(warning); });
}

bool ClothNode::prepare_wrenches()
{
  wrenches_.offer(cloth_->simulation.pins().all());
  const bool measures = wrenches_.is_listened_to();
  cloth_->simulation.measure_reactions(measures);
  return measures;
}

bool ClothNode::advance(double simulated_time)
{
  constexpr std::chrono::milliseconds longest_wait{ 500 };
  started_over_ = false;
  tick_begin_ = WallClock::now();
  const auto first_break = *tick_begin_ + longest_wait;
  const auto needs_a_break = [&] {
    const auto now = WallClock::now();
    return !goes_on() || (now > first_break && (errands_.any_waiting() || statistics_.due(now)));
  };
  while (cloth_->simulation.advance_to(simulated_time, needs_a_break) &&
         cloth_->simulation.state().time < simulated_time)
  {
    errands_.do_all();
    if (started_over_ || !goes_on())
    {
      break;
    }
    publish_stats_when_due();
    publish_diagnostics_when_due();
  }
  tick_begin_.reset();
  report_divergence();
  return !started_over_ && goes_on();
}

void ClothNode::report_divergence()
{
  if (cloth_->simulation.divergence() && !divergence_reported_)
  {
    divergence_reported_ = true;
    ROS_ERROR("%s. The last good state is kept and published until ~reset or ~reload.",
              cloth_->simulation.divergence_report().c_str());
  }
}

void ClothNode::publish_cloth(const ros::Time& stamp)
{
  const Simulation& simulation = cloth_->simulation;
  const Vectors& positions = simulation.state().positions;
  const cloth_sim::ClothState::Ptr state = state_messages_.take();
  state->header.frame_id = cloth_->plan.scene.frame_id;
  state->header.stamp = stamp;
  state->topology_version = topology_message_.version;
  fill_state(simulation, *state);
  state_message_ = state;
  state_.publish(state_message_);
  mesh_.publish(cloth_->mesh.update(positions, stamp));
  if (springs_.getNumSubscribers() > 0)
  {
    springs_.publish(cloth_->springs.update(positions, stamp));
  }
  if (const auto markers = cloth_->pins.update(simulation.pins().all(), positions, stamp))
  {
    pins_.publish(markers);
  }
  show_handles();
}

void ClothNode::show_handles()
{
  const Simulation& simulation = cloth_->simulation;
  const ClothModel& model = simulation.model();
  const PinHandles::Style style{ cloth_->plan.scene.frame_id, 0.05 * std::max(model.width, model.height) };
  handles_.show(simulation.pins().all(), simulation.state().time, style);
}

void ClothNode::publish_topology()
{
  topology_message_.header.stamp = clock_.now();
  topology_.publish(boost::make_shared<cloth_sim::ClothTopology>(topology_message_));
}

void ClothNode::publish_topology_if_changed()
{
  if (!same_topology(topology_of(*cloth_, topology_message_.version), topology_message_))
  {
    topology_message_ = topology_of(*cloth_, topology_message_.version + 1);
    publish_topology();
  }
}

void ClothNode::publish_stats_when_due()
{
  const auto now = WallClock::now();
  if (!statistics_.due(now))
  {
    return;
  }
  const Simulation& simulation = cloth_->simulation;
  const TickReport ticks = statistics_.take(now, simulation.state().time);
  tick_rate_ = ticks.rate;
  stats_message_ = stats_message(simulation, ticks);
  stats_message_.header.stamp = clock_.now();
  stats_message_.header.frame_id = cloth_->plan.scene.frame_id;
  stats_message_.overruns = clock_.overruns();
  stats_message_.paused = clock_.paused() ? 1 : 0;
  stats_message_.plan = joined(describe(cloth_->plan, simulation, stats_message_.stability_limit), "\n");
  stats_message_.plan += tuning_report_.empty() ? "" : "\n" + tuning_report_;
  stats_.publish(boost::make_shared<cloth_sim::ClothStats>(stats_message_));
  if (clock_.paused())
  {
    state_.publish(state_message_);  // for those who came since
  }
  const std::string too_far = reach_warning(simulation);
  if (!too_far.empty())
  {
    ROS_WARN_THROTTLE(10.0, "%s", too_far.c_str());
  }
  const std::string unsolved = convergence_warning(simulation);
  if (!unsolved.empty())
  {
    ROS_WARN_THROTTLE(60.0, "%s", unsolved.c_str());
  }
}

void ClothNode::publish_diagnostics_when_due()
{
  const auto now = WallClock::now();
  const bool has_stats = !stats_message_.method.empty();
  if (!has_stats || !health_.due(now))
  {
    return;
  }
  Condition condition;
  condition.stats = stats_message_;
  condition.tick_rate = tick_rate_;
  condition.asked = cloth_->plan.scene.node;
  condition.strain_limit = cloth_->plan.scene.strain_limit.max_strain;
  condition.divergence = cloth_->simulation.divergence_report();
  condition.asleep_since = cloth_->simulation.asleep_since();
  condition.transform = frames_.last_use();
  condition.tick_under_way = tick_begin_ ? std::chrono::duration<double>(now - *tick_begin_).count() : 0.0;
  health_.publish(condition, now);
}

}  // namespace cloth
