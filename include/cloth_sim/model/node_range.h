#pragma once

#include <algorithm>

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// The nodes begin, begin + 1, ..., end - 1.
struct NodeRange
{
  int begin;
  int end;

  int size() const
  {
    return end - begin;
  }
};

inline NodeRange all_nodes(const ClothModel& model)
{
  return { 0, model.nodes() };
}

/// A sheet is worked through in stretches of this many nodes: whole rows, about 256 nodes, what is read and written of
/// them fits the nearest cache. They follow from the sheet alone, and so does the order in which forces are added up.
inline int stretch_length(const ClothModel& model)
{
  constexpr int wanted = 256;
  return model.cols * std::max(1, wanted / model.cols);
}

/// Calls work(stretch) for the stretches that have nodes of `nodes`, the first and the last of them whole.
template <typename Work>
void for_each_stretch(const ClothModel& model, NodeRange nodes, Work&& work)
{
  const int length = stretch_length(model);
  for (int begin = nodes.begin / length * length; begin < nodes.end; begin += length)
  {
    work(NodeRange{ begin, std::min(begin + length, model.nodes()) });
  }
}

/// `node_normals` of the nodes of some whole rows; `normals` must have a row for every node.
void node_normals(const ClothModel& model, const Vectors& positions, NodeRange nodes, Vectors& normals);

}  // namespace cloth
