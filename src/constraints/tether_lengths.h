#pragma once

#include <utility>
#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "spring_ways.h"
#include "tension_passes.h"

namespace cloth
{

/// Tethers of a sheet to the nodes that it is held by.
class TetherLengths
{
public:
  explicit TetherLengths(const ClothModel& model)
    : nodes_(model.nodes()), has_ways_(has_springs(model, SpringKind::structural)), ways_(model)
  {
  }

  int nodes() const
  {
    return nodes_;
  }

  /// One for each held node where these are few: a pass visits every node for each of them. In arrays of `size`
  /// numbers, number_of(node) being a node's.
  template <typename Scalar, typename NumberOf>
  std::vector<Tether<Scalar>> tethers(const std::vector<int>& held, int size, NumberOf&& number_of) const
  {
    std::vector<Tether<Scalar>> tethers;
    for (const int anchor : held)
    {
      if (!has_ways_ || held.size() > most_tethers)
      {
        break;
      }
      std::vector<Scalar> lengths(static_cast<size_t>(size), Scalar(0));
      for (int node = 0; node < nodes_; ++node)
      {
        lengths[static_cast<size_t>(number_of(node))] = Scalar(ways_.between(anchor, node));
      }
      tethers.push_back({ number_of(anchor), std::move(lengths) });
    }
    return tethers;
  }

private:
  static constexpr size_t most_tethers = 4;

  int nodes_;
  bool has_ways_;
  SpringWays ways_;
};

}  // namespace cloth
