#include "run_options.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using Words = std::vector<std::string>;

RunOptions parse(Words words)
{
  words.insert(words.begin(), "cloth_run");
  std::vector<char*> arguments;
  for (std::string& word : words)
  {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  return parse_run_options(static_cast<int>(words.size()), arguments.data());
}

std::string fault_of(const Words& words)
{
  try
  {
    parse(words);
    return {};
  }
  catch (const UsageError& error)
  {
    return error.what();
  }
}

TEST(RunOptions, HaveTheDefaultsOfTheInterface)
{
  const RunOptions options = parse({ "scene.yaml" });
  EXPECT_EQ(options.scene_file, "scene.yaml");
  EXPECT_EQ(options.duration, 5.0);
  EXPECT_EQ(options.every, 0.0333);
  EXPECT_TRUE(options.settings.empty());
  EXPECT_EQ(options.output_file, "");
  EXPECT_EQ(options.summary_file, "");
  EXPECT_FALSE(options.plan_only);
  EXPECT_FALSE(options.help);
}

TEST(RunOptions, AreTakenBeforeAndAfterTheSceneInBothSpellings)
{
  const RunOptions options = parse({ "--duration", "2.5", "--set", "a.b=1", "scene.yaml", "--every=1e-3",
                                     "--set=c=[0, 1]", "--output", "o.csv", "--summary=s.yaml", "--plan" });
  EXPECT_EQ(options.scene_file, "scene.yaml");
  EXPECT_EQ(options.duration, 2.5);
  EXPECT_EQ(options.every, 1e-3);
  const std::vector<std::pair<std::string, std::string>> settings{ { "a.b", "1" }, { "c", "[0, 1]" } };
  EXPECT_EQ(options.settings, settings);
  EXPECT_EQ(options.output_file, "o.csv");
  EXPECT_EQ(options.summary_file, "s.yaml");
  EXPECT_TRUE(options.plan_only);
}

TEST(RunOptions, MayNameTheSceneAfterTwoDashes)
{
  EXPECT_EQ(parse({ "--plan", "--", "--scene.yaml" }).scene_file, "--scene.yaml");
}

TEST(RunOptions, TakeASettingApartAtItsFirstEqualsSign)
{
  EXPECT_EQ(parse({ "s", "--set", "a=b=c" }).settings.at(0), (std::pair<std::string, std::string>("a", "b=c")));
  EXPECT_EQ(parse({ "s", "--set", "a=" }).settings.at(0), (std::pair<std::string, std::string>("a", "")));
  EXPECT_EQ(fault_of({ "s", "--set", "a" }), "--set is a; allowed: KEY=VALUE");
  EXPECT_EQ(fault_of({ "s", "--set", "=1" }), "--set is =1; allowed: KEY=VALUE");
}

TEST(RunOptions, RefuseBadSecondsWithWhatIsAllowed)
{
  for (const std::string seconds : { "-1", "a", "", ".nan", ".inf", "1s", "1,5" })
  {
    EXPECT_EQ(fault_of({ "s", "--duration", seconds }),
              "--duration is " + seconds + "; allowed: a number of seconds >= 0");
    EXPECT_EQ(fault_of({ "s", "--every", seconds }), "--every is " + seconds + "; allowed: a number of seconds > 0");
  }
  EXPECT_EQ(parse({ "s", "--duration", "0" }).duration, 0.0);
  EXPECT_EQ(fault_of({ "s", "--every", "0" }), "--every is 0; allowed: a number of seconds > 0");
}

TEST(RunOptions, NameTheOptionThatIsUnknownOrLacksItsValue)
{
  EXPECT_EQ(fault_of({ "s", "--bogus" }), "--bogus is not an option");
  EXPECT_EQ(fault_of({ "s", "--bogus=1", "--plan" }), "--bogus=1 is not an option");
  EXPECT_EQ(fault_of({ "s", "-xy" }), "-xy is not an option");
  for (const std::string option : { "--duration", "--every", "--set", "--output", "--summary" })
  {
    EXPECT_EQ(fault_of({ "s", option }), option + " needs a value");
  }
}

TEST(RunOptions, TakeALongOptionWithOneDash)
{
  EXPECT_EQ(parse({ "s", "-duration", "2" }).duration, 2.0);
}

TEST(RunOptions, WantOneScene)
{
  EXPECT_EQ(fault_of({}), "one scene file is needed, 0 were given");
  EXPECT_EQ(fault_of({ "a", "--plan", "b" }), "one scene file is needed, 2 were given");
}

TEST(RunOptions, WantTwoFilesForOutputAndSummary)
{
  EXPECT_EQ(fault_of({ "s", "--output", "f", "--summary", "f" }),
            "--output and --summary are both f; allowed: two files");
}

TEST(RunOptions, NeedNoSceneForHelp)
{
  EXPECT_TRUE(parse({ "--help" }).help);
  EXPECT_TRUE(parse({ "-h" }).help);
}

TEST(RunOptions, AreAllInTheUsage)
{
  const std::string usage = run_usage;
  for (const char* const option : { "--duration", "--every", "--set", "--output", "--summary", "--plan", "--help" })
  {
    EXPECT_NE(usage.find(option), std::string::npos) << option;
  }
}

}  // namespace
}  // namespace cloth
