#include "bag_files.h"

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using Files = std::vector<std::string>;

TEST(BagFiles, AreSeparatedByBlanks)
{
  EXPECT_EQ(bag_files(""), Files{});
  EXPECT_EQ(bag_files("  "), Files{});
  EXPECT_EQ(bag_files("/a.bag"), Files{ "/a.bag" });
  EXPECT_EQ(bag_files(" /a.bag  /b.bag "), (Files{ "/a.bag", "/b.bag" }));
}

TEST(BagFiles, MayHaveBlanksThatAreEscaped)
{
  EXPECT_EQ(bag_files("/my\\ cloth.bag /b.bag"), (Files{ "/my cloth.bag", "/b.bag" }));
  EXPECT_EQ(bag_files("/back\\\\slash.bag"), Files{ "/back\\slash.bag" });
}

}  // namespace
}  // namespace cloth
