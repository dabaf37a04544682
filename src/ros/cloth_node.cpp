#include "cloth_node.h"

#include <algorithm>
#include <chrono>

#include <ros/console.h>
#include <ros/init.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/ClothStats.h"
#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/scene/start_state.h"
#include "cloth_sim/scene/yaml_text.h"

#include "messages.h"
#include "pin_requests.h"
#include "wind_request.h"

namespace cloth
{
namespace
{

using WallClock = std::chrono::steady_clock;

/// The cloth of a node never changes its grid.
constexpr std::uint32_t topology_version = 1;

MeshColouring colouring_of(const SceneParams& scene)
{
  return { scene.node.fabric_colour, scene.node.colouring == "strain", scene.strain_limit.max_strain };
}

/// The direction of a chain's width at the start.
Eigen::Vector3d across_chain(const SceneParams& scene)
{
  const Eigen::Vector3d at_rest = scene.sheet.cols == 1 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  return rotation_of(scene.start.rpy) * at_rest;
}

}  // namespace

ClothNode::ClothNode(const ros::NodeHandle& private_node, const Plan& plan)
  : private_node_(private_node)
  , plan_(plan)
  , simulation_(build_simulation(plan_))
  , clock_(plan_.scene.node.rate, plan_.scene.node.real_time_factor)
  , statistics_(WallClock::now())
  , refusals_([](const std::string& cause) { ROS_WARN("refused: %s", cause.c_str()); })
  , transform_listener_(transforms_)
  , frames_(plan_.scene.frame_id, transforms_)
  , mesh_marker_(simulation_.model(), plan_.scene.frame_id, colouring_of(plan_.scene), across_chain(plan_.scene))
  , spring_marker_(simulation_.model(), plan_.scene.frame_id)
  , pin_markers_(simulation_.model(), plan_.scene.frame_id)
{
  state_message_.header.frame_id = plan_.scene.frame_id;
  state_message_.topology_version = topology_version;
  log_start();
  advertise();
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

void ClothNode::subscribe()
{
  wind_ = private_node_.subscribe("wind", 10, &ClothNode::take_wind, this);
  pin_ = private_node_.subscribe("pin", RequestQueue::most_waiting, &ClothNode::take_pin, this);
}

void ClothNode::log_start() const
{
  ROS_INFO("%s", joined(describe(plan_, simulation_), "\n").c_str());
  const std::string warning = time_step_warning(simulation_);
  if (!warning.empty())
  {
    ROS_WARN("%s: the cloth will diverge", warning.c_str());
  }
}

void ClothNode::take_wind(const geometry_msgs::Vector3Stamped& request)
{
  try
  {
    requests_.leave_wind(wind_of(request, frames_));
  }
  catch (const RefusedRequest& refusal)
  {
    refusals_.report("~wind: " + std::string(refusal.what()));
  }
}

void ClothNode::take_pin(const cloth_sim::Pin::ConstPtr& request)
{
  try
  {
    requests_.leave([this, request](Simulation& simulation) {
      apply_pin(*request, frames_, clock_.simulated_period(), simulation);
    });
  }
  catch (const RefusedRequest& refusal)
  {
    refusals_.report("~pin: " + std::string(refusal.what()));
  }
}

void ClothNode::run()
{
  publish_topology();
  publish_cloth(ros::Time::now());
  while (ros::ok())
  {
    if (const auto tick = clock_.take(ros::Time::now()))
    {
      run_tick(*tick);
    }
    else
    {
      wait_for_tick();
    }
    publish_stats_when_due();
  }
}

void ClothNode::run_tick(const Tick& tick)
{
  const auto start = WallClock::now();
  apply_requests();
  advance(tick.simulated_time);
  publish_cloth(tick.stamp);
  statistics_.add(WallClock::now() - start);
}

void ClothNode::apply_requests()
{
  for (const RequestQueue::Request& request : requests_.take_all())
  {
    try
    {
      request(simulation_);
    }
    catch (const RefusedRequest& refusal)
    {
      refusals_.report("~pin: " + std::string(refusal.what()));
    }
  }
}

void ClothNode::advance(double simulated_time)
{
  if (!simulation_.advance_to(simulated_time) && !divergence_reported_)
  {
    divergence_reported_ = true;
    ROS_ERROR("%s. The last good state is kept and published.", simulation_.divergence_report().c_str());
  }
}

void ClothNode::publish_cloth(const ros::Time& stamp)
{
  const Vectors& positions = simulation_.state().positions;
  state_message_.header.stamp = stamp;
  fill_state(simulation_, state_message_);
  state_.publish(state_message_);
  mesh_.publish(mesh_marker_.update(positions, stamp));
  if (springs_.getNumSubscribers() > 0)
  {
    springs_.publish(spring_marker_.update(positions, stamp));
  }
  if (const auto* markers = pin_markers_.update(simulation_.pins().all(), positions, stamp))
  {
    pins_.publish(*markers);
  }
}

void ClothNode::publish_topology()
{
  cloth_sim::ClothTopology message = topology_message(simulation_.model(), topology_version);
  message.header.stamp = ros::Time::now();
  message.header.frame_id = plan_.scene.frame_id;
  topology_.publish(message);
}

void ClothNode::publish_stats_when_due()
{
  const auto now = WallClock::now();
  if (!statistics_.due(now))
  {
    return;
  }
  cloth_sim::ClothStats message = stats_message(simulation_, statistics_.take(now, simulation_.state().time));
  message.header.stamp = ros::Time::now();
  message.header.frame_id = plan_.scene.frame_id;
  message.overruns = clock_.overruns();
  message.plan = joined(describe(plan_, simulation_), "\n");
  stats_.publish(message);
  const std::string unsolved = convergence_warning(simulation_);
  if (!unsolved.empty())
  {
    ROS_WARN_THROTTLE(60.0, "%s", unsolved.c_str());
  }
}

void ClothNode::wait_for_tick() const
{
  // Simulated ROS time may pass at any speed and a shutdown may come: look often.
  constexpr double longest_wait = 0.02;
  constexpr double simulated_clock_wait = 0.001;
  const double until_next = clock_.until_next(ros::Time::now()).toSec();
  ros::WallDuration(ros::Time::isSimTime() || until_next == 0.0 ? simulated_clock_wait :
                                                                  std::min(until_next, longest_wait))
      .sleep();
}

}  // namespace cloth
