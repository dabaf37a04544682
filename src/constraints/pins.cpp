#include "cloth_sim/constraints/pins.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/model/part_calls.h"

namespace cloth
{
namespace
{

constexpr double two_pi = 6.283185307179586;

/// The pin with those of its nodes that are not among `taken`.
Pin without(const Pin& pin, const std::vector<int>& taken)
{
  Pin rest = pin;
  rest.nodes.clear();
  for (size_t i = 0; i < pin.nodes.size(); ++i)
  {
    if (std::find(taken.begin(), taken.end(), pin.nodes[i]) == taken.end())
    {
      rest.held.row(static_cast<Eigen::Index>(rest.nodes.size())) = pin.held.row(static_cast<Eigen::Index>(i));
      rest.nodes.push_back(pin.nodes[i]);
    }
  }
  rest.held.conservativeResize(static_cast<Eigen::Index>(rest.nodes.size()), 3);
  return rest;
}

/// The part of the way that is behind at `time`.
double part_at(const Carry& carry, double time)
{
  return time >= carry.end ? 1.0 : std::max(0.0, time - carry.start) / (carry.end - carry.start);
}

bool is_under_way(const Carry& carry, double time)
{
  const double duration = carry.end - carry.start;
  return duration > 0.0 && time >= carry.start && time <= carry.end + 1e-6 * duration;
}

Eigen::Vector3d displacement_of(const Pin& pin, double time)
{
  if (!pin.moves_at(time))
  {
    return pin.carry.to;
  }
  ++part_calls()[Part::pin_motions];
  return pin.oscillation.displacement(time) + pin.carry.displacement(time);
}

/// Where node i of a carried pin was held, as seen from its pivot, turned.
Eigen::RowVector3d arm_of(const Pin& pin, Eigen::Index i, const Eigen::Matrix3d& rotation)
{
  return (pin.held.row(i) - pin.carry.pivot.transpose()) * rotation.transpose();
}

}  // namespace

Eigen::Vector3d Oscillation::displacement(double time) const
{
  return amplitude * (std::sin(two_pi * frequency * time + phase) - std::sin(phase));
}

Eigen::Vector3d Oscillation::velocity(double time) const
{
  return amplitude * two_pi * frequency * std::cos(two_pi * frequency * time + phase);
}

Eigen::Vector3d Carry::displacement(double time) const
{
  return time >= end ? to : Eigen::Vector3d(from + part_at(*this, time) * (to - from));
}

Eigen::Vector3d Carry::velocity(double time) const
{
  return is_under_way(*this, time) ? Eigen::Vector3d((to - from) / (end - start)) : Eigen::Vector3d::Zero();
}

Eigen::Matrix3d Carry::rotation(double time) const
{
  const double angle = turn.norm();
  if (angle == 0.0)
  {
    return turned;
  }
  return Eigen::AngleAxisd(part_at(*this, time) * angle, turn / angle) * turned;
}

Eigen::Vector3d Carry::angular_velocity(double time) const
{
  return is_under_way(*this, time) ? Eigen::Vector3d(turn / (end - start)) : Eigen::Vector3d::Zero();
}

bool Carry::is_straight() const
{
  return turn.isZero(0.0) && turned.isIdentity(0.0);
}

Eigen::Isometry3d Carry::placement(double time) const
{
  return Eigen::Translation3d(pivot + displacement(time)) * Eigen::Isometry3d(rotation(time)) *
         Eigen::Translation3d(-pivot);
}

Eigen::Vector3d Pin::held_middle() const
{
  return held.colwise().mean().transpose();
}

Eigen::Vector3d Pin::middle(double time) const
{
  const Eigen::Vector3d still = held_middle();
  const Eigen::Vector3d carried =
      carry.is_straight() ? Eigen::Vector3d(still + carry.displacement(time)) : carry.placement(time) * still;
  return carried + oscillation.displacement(time);
}

double Pin::reach() const
{
  return std::sqrt((held.rowwise() - held.colwise().mean()).rowwise().squaredNorm().maxCoeff());
}

bool Pin::moves_at(double time) const
{
  const bool goes_somewhere = carry.from != carry.to || !carry.turn.isZero(0.0);
  return !oscillation.amplitude.isZero(0.0) || (goes_somewhere && (time < carry.end || is_under_way(carry, time)));
}

Pins::Pins(int nodes) : held_(static_cast<size_t>(nodes), 0)
{
}

void Pins::hold(const Pin& pin)
{
  release(pin.name);
  for (Pin& other : pins_)
  {
    other = without(other, pin.nodes);
  }
  pins_.erase(std::remove_if(pins_.begin(), pins_.end(), [](const Pin& other) { return other.nodes.empty(); }),
              pins_.end());
  pins_.push_back(pin);
  mark_held();
}

bool Pins::release(const std::string& name)
{
  const auto found = std::find_if(pins_.begin(), pins_.end(), [&](const Pin& pin) { return pin.name == name; });
  if (found == pins_.end())
  {
    return false;
  }
  pins_.erase(found);
  mark_held();
  return true;
}

void Pins::release_all()
{
  pins_.clear();
  mark_held();
}

bool Pins::carry(const std::string& name, const Eigen::Vector3d& target, double start, double end)
{
  Pin* const pin = look_up(name);
  if (pin == nullptr)
  {
    return false;
  }
  const Eigen::Vector3d pivot = pin->held_middle();
  const Eigen::Vector3d from = pin->carry.is_straight() ? pin->carry.displacement(start) :
                                                          Eigen::Vector3d(pin->carry.placement(start) * pivot - pivot);
  const Eigen::Vector3d to = target - (pivot + pin->oscillation.displacement(end));
  pin->carry = { from, to, start, end, pivot, pin->carry.rotation(start), Eigen::Vector3d::Zero() };
  return true;
}

bool Pins::carry(const std::string& name, const Eigen::Isometry3d& placement, const Eigen::Vector3d& pivot,
                 double start, double end)
{
  Pin* const pin = look_up(name);
  if (pin == nullptr)
  {
    return false;
  }
  const Eigen::Isometry3d now = pin->carry.placement(start);
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(placement.linear() * now.linear().transpose()));
  pin->carry = { now * pivot - pivot, placement * pivot - pivot, start, end, pivot,
                 now.linear(),        turn.angle() * turn.axis() };
  return true;
}

const Pin* Pins::find(const std::string& name) const
{
  return const_cast<Pins*>(this)->look_up(name);
}

Pin* Pins::look_up(const std::string& name)
{
  const auto found = std::find_if(pins_.begin(), pins_.end(), [&](const Pin& pin) { return pin.name == name; });
  return found == pins_.end() ? nullptr : &*found;
}

void Pins::impose(double time, Vectors& positions, Vectors& velocities) const
{
  for (const Pin& pin : pins_)
  {
    const Eigen::Vector3d displacement = displacement_of(pin, time);
    const bool is_straight = pin.carry.is_straight();
    const Eigen::RowVector3d pivot = (pin.carry.pivot + displacement).transpose();
    const Eigen::Matrix3d rotation = pin.carry.rotation(time);
    for (Eigen::Index i = 0; i < pin.held.rows(); ++i)
    {
      auto position = positions.row(pin.nodes[static_cast<size_t>(i)]);
      if (is_straight)
      {
        position = pin.held.row(i) + displacement.transpose();
      }
      else
      {
        position = pivot + arm_of(pin, i, rotation);
      }
    }
  }
  impose_velocities(time, velocities);
}

void Pins::impose_velocities(double time, Vectors& velocities) const
{
  part_calls()[Part::pins] += pins_.empty() ? 0 : 1;
  for (const Pin& pin : pins_)
  {
    if (!pin.moves_at(time))
    {
      for (const int node : pin.nodes)
      {
        velocities.row(node).setZero();
      }
      continue;
    }
    ++part_calls()[Part::pin_motions];
    const Eigen::RowVector3d velocity = (pin.oscillation.velocity(time) + pin.carry.velocity(time)).transpose();
    const Eigen::RowVector3d angular_velocity = pin.carry.angular_velocity(time).transpose();
    const bool turns = !angular_velocity.isZero(0.0);
    const Eigen::Matrix3d rotation = pin.carry.rotation(time);
    for (Eigen::Index i = 0; i < pin.held.rows(); ++i)
    {
      auto node_velocity = velocities.row(pin.nodes[static_cast<size_t>(i)]);
      node_velocity = velocity;
      if (turns)
      {
        node_velocity += angular_velocity.cross(arm_of(pin, i, rotation));
      }
    }
  }
}

void Pins::find_inverse_masses(const Eigen::VectorXd& masses, Eigen::VectorXd& inverse_masses) const
{
  inverse_masses.head(masses.size()) = masses.cwiseInverse();
  for (const Pin& pin : pins_)
  {
    for (const int node : pin.nodes)
    {
      inverse_masses[node] = 0.0;
    }
  }
}

void Pins::clear_held(Vectors& rows) const
{
  for (const Pin& pin : pins_)
  {
    for (const int node : pin.nodes)
    {
      rows.row(node).setZero();
    }
  }
}

void Pins::mark_held()
{
  std::fill(held_.begin(), held_.end(), 0);
  for (const Pin& pin : pins_)
  {
    for (const int node : pin.nodes)
    {
      held_[static_cast<size_t>(node)] = 1;
    }
  }
}

}  // namespace cloth
