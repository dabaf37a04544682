#include "cloth_sim/constraints/pins.h"

#include <algorithm>
#include <cmath>

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
  if (time >= end)
  {
    return to;
  }
  const double part = std::max(0.0, time - start) / (end - start);
  return from + part * (to - from);
}

Eigen::Vector3d Carry::velocity(double time) const
{
  if (time <= start || time > end)
  {
    return Eigen::Vector3d::Zero();
  }
  return (to - from) / (end - start);
}

Eigen::Vector3d Pin::displacement(double time) const
{
  return oscillation.displacement(time) + carry.displacement(time);
}

Eigen::Vector3d Pin::velocity(double time) const
{
  return oscillation.velocity(time) + carry.velocity(time);
}

Eigen::Vector3d Pin::middle(double time) const
{
  return held.colwise().mean().transpose() + displacement(time);
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
  for (Pin& pin : pins_)
  {
    if (pin.name == name)
    {
      const Eigen::Vector3d now = pin.carry.displacement(start);
      const Eigen::Vector3d missing =
          target - (pin.held.colwise().mean().transpose() + pin.oscillation.displacement(end));
      pin.carry = { now, missing, start, end };
      return true;
    }
  }
  return false;
}

const Pin* Pins::find(const std::string& name) const
{
  const auto found = std::find_if(pins_.begin(), pins_.end(), [&](const Pin& pin) { return pin.name == name; });
  return found == pins_.end() ? nullptr : &*found;
}

void Pins::impose(double time, Vectors& positions, Vectors& velocities) const
{
  for (const Pin& pin : pins_)
  {
    const Eigen::RowVector3d displacement = pin.displacement(time).transpose();
    for (size_t i = 0; i < pin.nodes.size(); ++i)
    {
      positions.row(pin.nodes[i]) = pin.held.row(static_cast<Eigen::Index>(i)) + displacement;
    }
  }
  impose_velocities(time, velocities);
}

void Pins::impose_velocities(double time, Vectors& velocities) const
{
  for (const Pin& pin : pins_)
  {
    const Eigen::RowVector3d velocity = pin.velocity(time).transpose();
    for (const int node : pin.nodes)
    {
      velocities.row(node) = velocity;
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
