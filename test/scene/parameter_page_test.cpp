#include <fstream>
#include <sstream>

#include "cloth_sim/scene/parameter_table.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

TEST(ParameterPage, IsTheOneInTheDocumentation)
{
  std::ifstream file("docs/parameters.md");
  ASSERT_TRUE(file) << "make it: rosrun cloth_sim parameter_page > docs/parameters.md";
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_TRUE(page.str() == parameter_page()) << "docs/parameters.md is not as the table is now; make it again: "
                                                 "rosrun cloth_sim parameter_page > docs/parameters.md";
}

TEST(ParameterPage, HasARowWithDefaultUnitAndRangeForEveryKey)
{
  const std::string page = parameter_page();
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    const std::string unit = parameter.unit.empty() ? "-" : parameter.unit;
    EXPECT_TRUE(has(page, { "| `" + parameter.key + "` | " + parameter.type + " | `" + parameter.get(SceneParams()) +
                            "` | " + unit + " | " + parameter.allowed + " | " }));
  }
  for (const Parameter<PinParams>& parameter : pin_table())
  {
    EXPECT_TRUE(has(page, { "| `" + parameter.key + "` | " + parameter.type + " | " }));
  }
}

}  // namespace
}  // namespace cloth
