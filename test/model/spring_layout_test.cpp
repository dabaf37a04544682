#include "spring_layout.h"

#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

ClothModel sheet_of(int rows, int cols)
{
  SheetProperties sheet;
  sheet.rows = rows;
  sheet.cols = cols;
  return make_sheet(sheet);
}

class LaneLayoutOf : public testing::TestWithParam<std::pair<int, int>>
{
};

TEST_P(LaneLayoutOf, HasEverySpringOnceAndNoNodeTwiceInARun)
{
  const ClothModel model = sheet_of(GetParam().first, GetParam().second);
  const LaneLayout layout(model);
  using Spring = std::pair<int, int>;
  std::vector<std::multiset<Spring>> expected(model.springs.size());
  for (size_t b = 0; b < model.springs.size(); ++b)
  {
    for_each_spring(model.springs[b], [&](int i, int j) { expected[b].insert(std::minmax(layout[i], layout[j])); });
  }
  std::vector<std::multiset<Spring>> found(model.springs.size());
  for (const SpringRun& run : layout.runs(model.springs, 3))
  {
    EXPECT_EQ(run.node % 16, 0);
    const int reached = (run.node + run.offset + 15) / 16;
    EXPECT_NE(reached, run.node / 16) << "what is stored for the second ends takes in some of the first";
    std::set<int> nodes;
    for (int k = 0; k < run.n; ++k)
    {
      const int i = run.node + k;
      found[run.batch].insert(std::minmax(i, i + run.offset));
      EXPECT_TRUE(nodes.insert(i).second && nodes.insert(i + run.offset).second);
    }
  }
  EXPECT_EQ(found, expected);
}

INSTANTIATE_TEST_SUITE_P(Sheets, LaneLayoutOf,
                         testing::Values(std::pair(1, 2), std::pair(2, 1), std::pair(9, 1), std::pair(1, 70),
                                         std::pair(3, 3), std::pair(5, 16), std::pair(4, 47), std::pair(7, 48),
                                         std::pair(20, 49), std::pair(3, 64), std::pair(5, 100)));

}  // namespace
}  // namespace cloth
