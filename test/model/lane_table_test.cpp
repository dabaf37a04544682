#include "lane_table.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

LaneTable::Row row_of(int number)
{
  LaneTable::Row row;
  for (size_t k = 0; k < row.size(); ++k)
  {
    row[k] = static_cast<float>(100 * number) + static_cast<float>(k);
  }
  return row;
}

bool has(const LaneTable& table, size_t run, const LaneTable::Row& row)
{
  return std::equal(row.begin(), row.end(), table[run]);
}

TEST(LaneTable, KeepsEqualRowsOnce)
{
  LaneTable table;
  for (const int number : { 1, 2, 1, 1, 2 })
  {
    table.add(row_of(number));
  }
  EXPECT_EQ(table[0], table[2]);
  EXPECT_EQ(table[0], table[3]);
  EXPECT_EQ(table[1], table[4]);
  EXPECT_NE(table[0], table[1]);
  EXPECT_TRUE(has(table, 3, row_of(1)));
  EXPECT_TRUE(has(table, 4, row_of(2)));
}

TEST(LaneTable, HasTheRightRowsHoweverManyDiffer)
{
  LaneTable table;
  constexpr int different = 1000;
  for (int i = 0; i < 2 * different; ++i)
  {
    table.add(row_of(i % different));
  }
  for (int i = 0; i < 2 * different; ++i)
  {
    EXPECT_TRUE(has(table, static_cast<size_t>(i), row_of(i % different))) << i;
  }
  table.clear();
  table.add(row_of(7));
  EXPECT_TRUE(has(table, 0, row_of(7)));
}

TEST(LaneTable, HasNothingWhereThereIsNoSpringAndWhereBothEndsAreHeld)
{
  LaneNodes nodes;
  nodes.set_zero(2 * lanes);
  for (int node = 1; node < 2 * lanes; ++node)
  {
    nodes.data()[LaneNodes::place_of(node) + lane_node::inverse_mass] = 2.0F;
  }
  nodes.data()[LaneNodes::place_of(lanes) + lane_node::inverse_mass] = 0.0F;
  const LaneRun run({ 0, 0, lanes, 14 });
  const LaneTable::Row row = numbers_of_springs(nodes, run, [](float w) { return 1.0F / w; });
  EXPECT_EQ(row[0], 0.0F) << "held at both ends";
  EXPECT_EQ(row[1], 0.25F);
  EXPECT_EQ(row[13], 0.25F);
  EXPECT_EQ(row[14], 0.0F) << "no spring";
}

}  // namespace
}  // namespace cloth
