#include "pin_requests.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/yaml_text.h"

#include "conversions.h"
#include "refused_request.h"

namespace cloth
{
namespace
{

/// Farther than any cloth, and near enough to reckon with, m.
constexpr double farthest = 1e6;

std::string node_in_words(int row, int col)
{
  return "[" + std::to_string(row) + ", " + std::to_string(col) + "]";
}

Eigen::Vector3d point_of(const cloth_sim::Pin& request, const Frames& frames)
{
  const Eigen::Vector3d point = frames.from(request.point.header.frame_id) * to_eigen(request.point.point);
  if (!point.allFinite())
  {
    throw RefusedRequest("point is not finite");
  }
  if (point.lpNorm<Eigen::Infinity>() > farthest)
  {
    throw RefusedRequest("point is " + format_number(point.norm()) + " m away; allowed: up to " +
                         format_number(farthest) + " along each axis");
  }
  return point;
}

int requested_node(const cloth_sim::Pin& request, const ClothModel& model)
{
  if (request.row >= static_cast<std::uint32_t>(model.rows) || request.col >= static_cast<std::uint32_t>(model.cols))
  {
    throw RefusedRequest("there is no node at row " + std::to_string(request.row) + ", col " +
                         std::to_string(request.col) + "; the last is " +
                         node_in_words(model.rows - 1, model.cols - 1));
  }
  return model.node(static_cast<int>(request.row), static_cast<int>(request.col));
}

int nearest_node(const Eigen::Vector3d& point, const Vectors& positions)
{
  int nearest = 0;
  (positions.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

std::vector<int> nodes_within(double radius, const Eigen::Vector3d& point, const Vectors& positions)
{
  if (!std::isfinite(radius) || radius < 0.0)
  {
    throw RefusedRequest("radius is " + std::to_string(radius) + "; allowed: a number >= 0");
  }
  std::vector<int> nodes;
  for (int i = 0; i < positions.rows(); ++i)
  {
    if ((positions.row(i).transpose() - point).norm() <= radius)
    {
      nodes.push_back(i);
    }
  }
  if (nodes.empty())
  {
    throw RefusedRequest("no node lies within " + std::to_string(radius) + " m of the point");
  }
  return nodes;
}

std::vector<int> selected_nodes(const cloth_sim::Pin& request, const Frames& frames, const Simulation& simulation)
{
  const Vectors& positions = simulation.state().positions;
  switch (request.select)
  {
    case cloth_sim::Pin::NODE:
      return { requested_node(request, simulation.model()) };
    case cloth_sim::Pin::NEAREST:
      return { nearest_node(point_of(request, frames), positions) };
    case cloth_sim::Pin::RADIUS:
      return nodes_within(request.radius, point_of(request, frames), positions);
    default:
      throw RefusedRequest("select is " + std::to_string(request.select) +
                           "; allowed: 0 (NODE), 1 (NEAREST), 2 (RADIUS)");
  }
}

/// Pins of messages are called like those of scenes.
void check_name(const std::string& name)
{
  const auto& table = pin_table();
  const auto row = std::find_if(table.begin(), table.end(), [](const auto& entry) { return entry.key == "name"; });
  const YAML::Node value(name);
  try
  {
    PinParams named;
    row->set(value, named);
  }
  catch (const std::invalid_argument&)
  {
    throw RefusedRequest("name is " + shown(value) + "; allowed: " + row->allowed);
  }
}

void check_frame(const std::string& frame)
{
  if (!frame.empty() && frame[0] == '/')
  {
    throw RefusedRequest("attach_frame is '" + frame + "'; allowed: empty, or a tf frame, no leading slash");
  }
}

void pin(const cloth_sim::Pin& request, const Frames& frames, Simulation& simulation, PinAttachments& attachments)
{
  check_frame(request.attach_frame);
  if (!request.name.empty())
  {
    check_name(request.name);
  }
  const std::vector<int> nodes = selected_nodes(request, frames, simulation);
  const ClothModel& model = simulation.model();
  const std::string name = !request.name.empty() ? request.name :
                                                   "pin_" + std::to_string(model.row_of(nodes.front())) + "_" +
                                                       std::to_string(model.col_of(nodes.front()));
  simulation.hold(name, nodes);
  attachments.detach(name);
  if (!request.attach_frame.empty())
  {
    attachments.attach(name, request.attach_frame, request.keep_offset != 0);
  }
}

void check_known(const std::string& name, const Simulation& simulation)
{
  if (simulation.pins().find(name) == nullptr)
  {
    throw RefusedRequest("no pin has the name '" + name + "'");
  }
}

void release(const cloth_sim::Pin& request, Simulation& simulation)
{
  if (request.name.empty())
  {
    simulation.release_all();
    return;
  }
  check_known(request.name, simulation);
  simulation.release(request.name);
}

void move(const cloth_sim::Pin& request, const Frames& frames, double duration, Simulation& simulation,
          PinAttachments& attachments)
{
  check_known(request.name, simulation);
  simulation.carry(request.name, point_of(request, frames), duration);
  attachments.detach(request.name);
}

}  // namespace

void apply_pin(const cloth_sim::Pin& request, const Frames& frames, double duration, Simulation& simulation,
               PinAttachments& attachments)
{
  switch (request.action)
  {
    case cloth_sim::Pin::PIN:
      return pin(request, frames, simulation, attachments);
    case cloth_sim::Pin::RELEASE:
      return release(request, simulation);
    case cloth_sim::Pin::MOVE:
      return move(request, frames, duration, simulation, attachments);
    default:
      throw RefusedRequest("action is " + std::to_string(request.action) + "; allowed: 0 (PIN), 1 (RELEASE), 2 (MOVE)");
  }
}

cloth_sim::Pin pin_nearest_to(const geometry_msgs::PointStamped& point)
{
  cloth_sim::Pin request;
  request.action = cloth_sim::Pin::PIN;
  request.select = cloth_sim::Pin::NEAREST;
  request.point = point;
  return request;
}

}  // namespace cloth
