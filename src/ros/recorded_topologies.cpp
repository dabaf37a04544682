#include "recorded_topologies.h"

#include <iterator>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "bag_files.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothTopology;

bool same_but_for_seq(ClothTopology left, const ClothTopology& right)
{
  left.header.seq = right.header.seq;
  return left == right;
}

}  // namespace

void RecordedTopologies::add(const ClothTopology::ConstPtr& topology)
{
  ClothTopology::ConstPtr& known = topologies_[{ topology->version, topology->header.stamp }];
  if (known == nullptr || !same_but_for_seq(*known, *topology))  // who holds the known one need not change
  {
    known = topology;
  }
}

void RecordedTopologies::add_from_bags(const std::string& bags, const std::string& topic)
{
  for (const std::string& file : bag_files(bags))
  {
    const rosbag::Bag bag(file);
    for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic)))
    {
      if (const auto topology = instance.instantiate<ClothTopology>())
      {
        add(topology);
      }
    }
  }
}

ClothTopology::ConstPtr RecordedTopologies::find(std::uint32_t version, const ros::Time& stamp) const
{
  const auto later = topologies_.upper_bound({ version, stamp });
  if (later != topologies_.begin() && std::prev(later)->first.first == version)
  {
    return std::prev(later)->second;
  }
  return later != topologies_.end() && later->first.first == version ? later->second : nullptr;
}

}  // namespace cloth
