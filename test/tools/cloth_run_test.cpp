// What cloth_run accepts, refuses and says.

#include <chrono>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/program.h"

namespace cloth
{
namespace
{

using Names = std::vector<std::string>;

TEST_F(ClothRun, ExitsWith0WhenItIsDone)
{
  const Ended ended = run(small_scene() + " --duration 0.1");
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.output, "");
  EXPECT_EQ(ended.errors, "") << "no progress where stderr is no terminal";
}

TEST_F(ClothRun, RunsAnEmptySceneFile)
{
  EXPECT_EQ(run(write("empty.yaml", "") + " --duration 0.01").status, 0);
}

TEST_F(ClothRun, PrintsItsUsageOnRequest)
{
  const Ended ended = run("--help");
  EXPECT_EQ(ended.status, 0);
  EXPECT_TRUE(has(ended.output, { "usage: cloth_run SCENE.yaml", "Exit status: 0 done, 1 " }));
}

TEST_F(ClothRun, ExitsWith2AndTheUsageOnBadUsage)
{
  const std::vector<std::array<std::string, 2>> cases{
    { "", "one scene file is needed" },
    { "a.yaml b.yaml", "one scene file is needed" },
    { small_scene() + " --bogus", "--bogus is not an option" },
    { small_scene() + " --duration", "--duration needs a value" },
    { small_scene() + " --duration -1", "--duration is -1; allowed: a number of seconds >= 0" },
    { small_scene() + " --every 0", "--every is 0; allowed: a number of seconds > 0" },
    { small_scene() + " --set rows", "--set is rows; allowed: KEY=VALUE" },
  };
  for (const auto& [words, message] : cases)
  {
    const Ended ended = run(words);
    EXPECT_EQ(ended.status, 2) << words;
    EXPECT_EQ(ended.output, "") << words;
    EXPECT_TRUE(has(ended.errors, { "cloth_run: " + message, "usage: cloth_run" }));
  }
}

TEST_F(ClothRun, ExitsWith2AndNamesKeyValueAndWhatIsAllowedOnABadScene)
{
  const std::vector<std::array<std::string, 2>> cases{
    { path("missing.yaml"), path("missing.yaml") + " cannot be read" },
    { write("broken.yaml", "cloth: {"), path("broken.yaml") + " is no YAML: " },
    { write("bad.yaml", "cloth: {mass: -1}"), "cloth.mass is -1; allowed: a number > 0.0" },
    { write("typo.yaml", "cloth: {mas: 1}"), "cloth.mas is not a key; allowed in cloth: rows, cols, " },
    { write("off.yaml", "pins: [{name: a, nodes: [[99, 0]]}]"), "pins[0].nodes has [99, 0]; allowed: rows -32 to 31" },
    { small_scene() + " --set solver.method=leapfrog",
      "solver.method is leapfrog; allowed: one of auto, explicit_euler, " },
    { small_scene() + " --set cloth.rows=many", "cloth.rows is many; allowed: an integer from 1 to 4096" },
    { small_scene() + " --set gravity=[0,0", "gravity is [0,0, which is no YAML" },
  };
  for (const auto& [words, message] : cases)
  {
    const Ended ended = run(words + " --duration 0.01");
    EXPECT_EQ(ended.status, 2) << words;
    EXPECT_TRUE(has(ended.errors, { "cloth_run: " + message }));
    EXPECT_FALSE(contains(ended.errors, "usage")) << ended.errors;
  }
}

TEST_F(ClothRun, SaysAllFaultsOfASceneAtOnce)
{
  const Ended ended = run(small_scene() + " --set cloth.mass=0 --set springs.flex.stiffness=-1 --set colour=red");
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(has(ended.errors, { "cloth.mass is 0; ", "springs.flex.stiffness is -1; ", "colour is not a key; " }));
}

TEST_F(ClothRun, SetsSeveralKeysInTheOrderGiven)
{
  const Ended ended = run(small_scene() +
                          " --plan --set gravity='[0, 0, -2]' --set springs.shear.stiffness=0 "
                          "--set solver.method=rk4 --set gravity='[0, 0, -3]' --set solver.time_step=1e-3");
  EXPECT_EQ(ended.status, 0);
  EXPECT_TRUE(
      has(ended.output, { "gravity: kept, 3.0 m/s2\n", "shear springs: left out, stiffness is 0\n", "method: kept, rk4",
                          "time step: 0.001 s, as the scene says", "structural springs: kept, 31 " }));
}

TEST_F(ClothRun, PrintsThePlanAndDoesNotRun)
{
  const std::string old = write("old.csv", "old");
  const Ended ended =
      run(small_scene() + " --plan --duration 1e9 --output " + old + " --summary " + path("summary.yaml"));
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.errors, "");
  EXPECT_TRUE(has(ended.output, { "structural springs: kept, ", "strain limit: ", "pins: ", "time step: " }));
  EXPECT_EQ(text_of(old), "old");
  EXPECT_EQ(files(), (Names{ "old.csv", "small.yaml" }));
}

TEST_F(ClothRun, AcceptsAndIgnoresWhatOnlyTheNodeUses)
{
  const std::string node_keys =
      "rate: 7\nreal_time_factor: 0\nclock_mode: follow\nstart_paused: false\nstart_bag: /nowhere.bag\ntf_pins: "
      "{top_speed: 2}\nwind_timeout: "
      "3\n"
      "display: {colouring: strain, fabric_colour: [0, 0, 1]}\n";
  const std::string words = " --duration 0.1 --output /dev/stdout";
  const Ended with = run(write("with.yaml", "cloth: {rows: 4, cols: 5, ripple: 0.02}\n" + node_keys) + words);
  EXPECT_EQ(with.status, 0) << with.errors;
  EXPECT_EQ(with.output, run(small_scene() + words).output);
}

TEST_F(ClothRun, WarnsOfAStepBeyondTheLimitAndObeysIt)
{
  const Ended ended =
      run(small_scene() +
          " --set solver.method=velocity_verlet --set solver.time_step=0.0125 --duration 0.0125 --summary /dev/stdout");
  EXPECT_EQ(ended.status, 0);
  const std::string warning =
      "cloth_run: warning: solver.time_step is 0.0125 s, beyond the stability limit of velocity_verlet, ";
  ASSERT_EQ(ended.errors.substr(0, warning.size()), warning);
  const YAML::Node summary = YAML::Load(ended.output);
  EXPECT_EQ(summary["steps"].as<int>(), 1);
  EXPECT_EQ(summary["time_step"].as<double>(), 0.0125);
  const double limit = std::strtod(ended.errors.c_str() + warning.size(), nullptr);
  EXPECT_LT(limit, 0.0125);
  EXPECT_NEAR(limit, summary["stability_limit"].as<double>(), 0.2 * limit);
  EXPECT_EQ(
      run(small_scene() + " --set solver.method=velocity_verlet --set solver.time_step=1e-3 --duration 0.01").errors,
      "");
}

TEST_F(ClothRun, EndsADivergedRunWithItsLastGoodStateAndSaysWhatToChange)
{
  const Ended ended = run(
      small_scene() +
      " --set solver.method=velocity_verlet --set solver.time_step=0.03 --set strain_limit.max_strain=0 --duration 20 "
      "--output " +
      path("out.csv") + " --summary " + path("summary.yaml"));
  EXPECT_EQ(ended.status, 1);
  EXPECT_TRUE(has(ended.errors, { "cloth_run: diverged at ", " s, first seen at node [",
                                  "the stability limit of velocity_verlet is ", "take a smaller solver.time_step" }));
  const YAML::Node summary = YAML::LoadFile(path("summary.yaml"));
  EXPECT_EQ(summary["status"].as<std::string>(), "diverged");
  const std::vector<std::vector<double>> rows = rows_of(text_of(path("out.csv")));
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.size() % 20, 0u) << "the last sample is whole";
  EXPECT_EQ(rows.back()[0], summary["simulated_time"].as<double>());
  EXPECT_LT(rows.back()[0], std::strtod(ended.errors.c_str() + ended.errors.find("at ") + 3, nullptr));
  for (const std::vector<double>& row : rows)
  {
    for (const double value : row)
    {
      EXPECT_TRUE(std::isfinite(value));
    }
  }
}

TEST_F(ClothRun, EndsADivergedRunWithItsStartWhereNothingLaterIsGood)
{
  const Ended ended = run(small_scene() +
                          " --set solver.method=velocity_verlet --set solver.time_step=0.03 --set "
                          "strain_limit.max_strain=0 --duration 20 --every 20 "
                          "--output /dev/stdout");
  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(times_of(ended.output), std::vector<double>{ 0.0 });
}

TEST_F(ClothRun, LeavesAnOldOutputAloneWhenItFails)
{
  const std::string old = write("old.csv", "old");
  const std::string scene = small_scene();
  EXPECT_EQ(run(scene + " --set cloth.mass=0 --output " + old).status, 2);
  EXPECT_EQ(run(scene + " --duration 0.1 --output " + old + " --summary " + path("no_folder/summary.yaml")).status, 2);
  EXPECT_EQ(text_of(old), "old");
  EXPECT_EQ(files(), (Names{ "old.csv", "small.yaml" }));
}

TEST_F(ClothRun, ExitsWith2WhereAnOutputCannotBeWritten)
{
  for (const std::string& file : { path("no_folder/out.csv"), path("."), std::string("/dev/full") })
  {
    for (const std::string option : { "--output ", "--summary " })
    {
      const Ended ended = run(small_scene() + " --duration 0.01 " + option + file);
      EXPECT_EQ(ended.status, 2) << file;
      EXPECT_TRUE(has(ended.errors, { "cloth_run: " + file + " cannot be written" }));
    }
  }
  EXPECT_EQ(files(), Names{ "small.yaml" });
}

class InterruptedClothRun : public ClothRun, public testing::WithParamInterface<int>
{
};

INSTANTIATE_TEST_SUITE_P(By, InterruptedClothRun, testing::Values(SIGINT, SIGTERM));

TEST_P(InterruptedClothRun, LeavesOldOutputsAloneAndNothingElseEvenFarFromTheNextSample)
{
  const std::string scene = small_scene();
  const std::string old = write("old.csv", "old");
  const pid_t child = fork();
  if (child == 0)
  {
    // A cloth that may sleep is through at once.
    execl(CLOTH_RUN, CLOTH_RUN, scene.c_str(), "--set", "plan=full", "--duration", "1e6", "--every", "1e6", "--output",
          old.c_str(), "--summary", path("summary.yaml").c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  const auto in_time = [&] { return std::chrono::steady_clock::now() < deadline; };
  while (files().size() < 4 && in_time())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(files().size(), 4u) << "it is under way";
  kill(child, GetParam());
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0)
  {
    if (!in_time())
    {
      kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), GetParam());
  EXPECT_EQ(text_of(old), "old");
  EXPECT_EQ(files(), (Names{ "old.csv", "small.yaml" }));
}

}  // namespace
}  // namespace cloth
