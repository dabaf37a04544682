#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <ros/time.h>

#include "cloth_sim/ClothTopology.h"

namespace cloth
{

/// All topologies of a recording that are known so far, in whatever order they come, and however often.
class RecordedTopologies
{
public:
  void add(const cloth_sim::ClothTopology::ConstPtr& topology);

  /// Adds those that were recorded on `topic` to `bags`: as `bag_files` reads them. Throws rosbag::BagException.
  void add_from_bags(const std::string& bags, const std::string& topic);

  /// That of a state with this topology_version and stamp; null: it has not come yet. Versions count from the start of
  /// the recorded node, and a recording may hold several starts: of those of one version it is the last before `stamp`.
  cloth_sim::ClothTopology::ConstPtr find(std::uint32_t version, const ros::Time& stamp) const;

private:
  std::map<std::pair<std::uint32_t, ros::Time>, cloth_sim::ClothTopology::ConstPtr> topologies_;
};

}  // namespace cloth
