// cloth_bench as a program, and what comes with it.

#include "bench_options.h"
#include "bench_scene.h"
#include "in_a_folder.h"
#include "scene/scene_text.h"
#include "shipped_files.h"
#include "support.h"

namespace cloth
{
namespace
{

class ClothBench : public InAFolder
{
protected:
  Ended run(const std::string& words) const
  {
    return run_program(CLOTH_BENCH, words);
  }
};

TEST_F(ClothBench, PrintsItsUsageOnRequest)
{
  const Ended ended = run("--help");
  EXPECT_EQ(ended.status, 0);
  EXPECT_TRUE(has(ended.output, { "usage: cloth_bench [SCENE.yaml ...]", "--quick", "Exit status: 0 done" }));
}

TEST_F(ClothBench, ExitsWith2OnBadUsageAndBadScenes)
{
  const std::vector<std::array<std::string, 2>> cases{
    { "--bogus", "--bogus is not an option" },
    { "--out", "--out needs a value" },
    { "--out ''", "--out is empty; allowed: a folder" },
    { path("missing.yaml"), path("missing.yaml") + " cannot be read" },
    { write("bad.yaml", "cloth: {mass: -1}"), path("bad.yaml") + ": cloth.mass is -1; allowed: a number > 0.0" },
    { write("a.yaml", "") + " " + path("a.yaml"), "two scenes are called a; allowed: files of different names" },
  };
  for (const auto& [words, message] : cases)
  {
    const Ended ended = run(words);
    EXPECT_EQ(ended.status, 2) << words;
    EXPECT_TRUE(has(ended.errors, { "cloth_bench: " + message }));
  }
}

TEST_F(ClothBench, ShipsScenesThatSpanWhatChangesTheAnswer)
{
  double softest = 1e9;
  double stiffest = 0.0;
  int coarsest = 1 << 20;
  int finest = 0;
  bool any_wind = false;
  bool any_limit = false;
  bool any_motion = false;
  const std::vector<std::string> files = scenes_of_the_program(false);
  for (const BenchScene& scene : read_scenes(files))
  {
    softest = std::min(softest, scene.params.sheet.structural.stiffness);
    stiffest = std::max(stiffest, scene.params.sheet.structural.stiffness);
    coarsest = std::min(coarsest, scene.params.sheet.rows);
    finest = std::max(finest, scene.params.sheet.rows);
    any_wind = any_wind || scene.params.air.wind.norm() > 0.0;
    any_limit = any_limit || scene.params.strain_limit.max_strain > 0.0;
    for (const PinParams& pin : scene.params.pins)
    {
      any_motion = any_motion || pin.motion.frequency > 0.0;
    }
  }
  EXPECT_EQ(softest, 100.0);
  EXPECT_EQ(stiffest, 1e5);
  EXPECT_EQ(coarsest, 16);
  EXPECT_EQ(finest, 128);
  EXPECT_TRUE(any_wind && any_limit && any_motion);
  EXPECT_LT(scenes_of_the_program(true).size(), files.size());
  EXPECT_GE(scenes_of_the_program(true).size(), 4U);
}

}  // namespace
}  // namespace cloth
