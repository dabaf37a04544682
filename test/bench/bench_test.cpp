// The whole of it: what is kept, what is run again, and what the tables say.

#include <map>

#include "bench.h"
#include "in_a_folder.h"
#include "small_problem.h"
#include "support.h"

namespace cloth
{
namespace
{

using Row = std::map<std::string, std::string>;

std::vector<std::string> fields_of(const std::string& line)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char letter : line)
  {
    quoted = quoted != (letter == '"');
    if (letter == ',' && !quoted)
    {
      fields.emplace_back();
    }
    else if (letter != '"')
    {
      fields.back() += letter;
    }
  }
  return fields;
}

std::vector<Row> rows_of_table(const std::string& csv)
{
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(lines, line))
  {
    const std::vector<std::string> fields = fields_of(line);
    EXPECT_EQ(fields.size(), names.size()) << line;
    Row row;
    for (size_t i = 0; i < names.size(); ++i)
    {
      row[names[i]] = fields.at(i);
    }
    rows.push_back(row);
  }
  return rows;
}

/// A solver that counts its runs.
class Counted : public OwnSolver
{
public:
  Counted(const char* method, int& runs) : OwnSolver(*find_method(method), Setting::step), runs_(runs)
  {
  }
  Outcome run(const Problem& problem, double value, double most_seconds) const override
  {
    ++runs_;
    return OwnSolver::run(problem, value, most_seconds);
  }

private:
  int& runs_;
};

/// Another formula than that of the reference.
class Rk4InSmallSteps : public OwnSolver
{
public:
  Rk4InSmallSteps() : OwnSolver(*find_method("rk4"), Setting::step)
  {
  }
  Outcome run(const Problem& problem, double, double most_seconds) const override
  {
    return OwnSolver::run(problem, problem.sample_interval() / 256, most_seconds);
  }
};

/// Every second run is on a machine half as fast, as the yardstick finds too.
class StrayOnAMachineThatSlowsDown : public StraySolver
{
public:
  explicit StrayOnAMachineThatSlowsDown(int& runs) : runs_(runs)
  {
  }
  Outcome run(const Problem& problem, double value, double most_seconds) const override
  {
    Outcome outcome = StraySolver::run(problem, value, most_seconds);
    const double slowness = runs_++ % 2 == 0 ? 1.0 : 2.0;
    outcome.seconds_per_second = 3.0 * slowness;
    outcome.yardstick = 1e-3 * slowness;
    return outcome;
  }

private:
  int& runs_;
};

class BenchInAFolder : public InAFolder
{
protected:
  /// So quick that no run is too slow.
  static BenchSettings small_settings()
  {
    BenchSettings settings;
    settings.longest_horizon = 0.1;
    settings.smallest_error = 1e-4;
    settings.reference.most_disagreement = 1e-6;
    settings.most_seconds = 60.0;
    settings.most_repeats = 2;
    settings.least_timed = 0.0;
    settings.spatial_seconds = 0.0;
    return settings;
  }

  Solvers two_methods()
  {
    Solvers solvers;
    solvers.push_back(std::make_unique<Counted>("explicit_euler", runs_));
    solvers.push_back(std::make_unique<Counted>("velocity_verlet", runs_));
    return solvers;
  }

  /// Runs the scene in a folder, at most so many runs and references.
  bool bench(const std::string& out, Solvers solvers, int most_runs = 1 << 30, const std::string& scene = small_scene,
             const BenchSettings& settings = small_settings())
  {
    Bench bench(path(out), settings, std::move(solvers), std::make_unique<Rk4InSmallSteps>(),
                { "a machine", "a compiler", "a commit" });
    int left = most_runs;
    return bench.run(read_scenes({ write("small.yaml", scene) }), [&left] { return left-- <= 0; });
  }

  std::vector<Row> rows(const std::string& out) const
  {
    return rows_of_table(text_of(path(out) + "/runs.csv"));
  }
  std::vector<Row> scene_rows(const std::string& out) const
  {
    return rows_of_table(text_of(path(out) + "/scenes.csv"));
  }

  int runs_ = 0;
};

/// The rows without what a clock says.
std::vector<Row> without_times(std::vector<Row> rows)
{
  for (Row& row : rows)
  {
    for (const char* name : { "seconds_per_second", "seconds_per_second_low", "seconds_per_second_high" })
    {
      row.erase(name);
    }
  }
  return rows;
}

TEST_F(BenchInAFolder, CountsTheTimeOfAMachineThatNothingSlowsDown)
{
  Solvers solvers;
  solvers.push_back(std::make_unique<StrayOnAMachineThatSlowsDown>(runs_));
  EXPECT_TRUE(bench("out", std::move(solvers)));
  const std::vector<Row> all = rows("out");
  ASSERT_EQ(all.size(), 3U);
  for (const Row& row : all)
  {
    EXPECT_EQ(row.at("repeats"), "2");
    for (const char* const name : { "seconds_per_second", "seconds_per_second_low", "seconds_per_second_high" })
    {
      EXPECT_DOUBLE_EQ(std::stod(row.at(name)), 3.0) << name;
    }
  }
}

TEST_F(BenchInAFolder, MeasuresAnErrorThatWasPutIn)
{
  Solvers solvers;
  solvers.push_back(std::make_unique<StraySolver>());
  EXPECT_TRUE(bench("out", std::move(solvers)));
  const std::vector<Row> all = rows("out");
  ASSERT_EQ(all.size(), 3U);
  for (const Row& row : all)
  {
    const double size = std::stod(row.at("value"));
    EXPECT_NEAR(std::stod(row.at("rms_error")), size, 0.01 * size);
    EXPECT_NEAR(std::stod(row.at("worst_error")), size, 0.01 * size);
    EXPECT_EQ(row.at("solver"), "stray");
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_EQ(row.at("repeats"), "2");
    EXPECT_EQ(row.at("nodes"), "30");
    EXPECT_EQ(row.at("machine"), "a machine");
    EXPECT_EQ(row.at("compiler"), "a compiler");
    EXPECT_EQ(row.at("commit"), "a commit");
  }
}

TEST_F(BenchInAFolder, LeavesOutWhatItsReferenceCannotTellFromNothing)
{
  class Close : public StraySolver
  {
    std::vector<double> ladder(const Problem&, double) const override
    {
      return { 1e-3, 1e-15 };
    }
  };
  Solvers solvers;
  solvers.push_back(std::make_unique<Close>());
  bench("out", std::move(solvers));
  ASSERT_EQ(rows("out").size(), 1U);
  EXPECT_EQ(rows("out").at(0).at("value"), "0.001");
}

TEST_F(BenchInAFolder, ListsFailures)
{
  bench("out", two_methods());
  const std::vector<Row> all = rows("out");
  EXPECT_EQ(all.front().at("solver"), "explicit_euler");
  EXPECT_EQ(all.front().at("status"), "unstable");
  EXPECT_EQ(all.front().at("rms_error"), "");
  EXPECT_EQ(all.front().at("seconds_per_second"), "");
  EXPECT_EQ(all.back().at("status"), "ok");
  EXPECT_LT(std::stod(all.back().at("rms_error")), 1e-4) << "a ladder ends below the smallest error";
}

TEST_F(BenchInAFolder, ListsWhatIsTooSlowAndTriesNothingFiner)
{
  class Slow : public OwnSolver
  {
  public:
    Slow() : OwnSolver(*find_method("symplectic_euler"), Setting::step)
    {
    }
    std::vector<double> ladder(const Problem& problem, double) const override
    {
      return { problem.sample_interval() / 8, problem.sample_interval() / (1 << 22), 1e-9 };
    }
  };
  Solvers solvers;
  solvers.push_back(std::make_unique<Slow>());
  BenchSettings brief = small_settings();
  brief.most_seconds = 0.05;
  bench("out", std::move(solvers), 1 << 30, small_scene, brief);
  const std::vector<Row> all = rows("out");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all.at(0).at("status"), "ok");
  EXPECT_EQ(all.at(1).at("status"), "too_slow");
  EXPECT_EQ(all.at(1).at("rms_error"), "");
}

TEST_F(BenchInAFolder, GoesOnWhereItWasCutShort)
{
  bench("whole", two_methods());
  const int runs_of_whole = runs_;
  runs_ = 0;
  bench("cut", two_methods(), 1);
  EXPECT_EQ(runs_, 0) << "the reference alone was found";
  const std::string reference = text_of(path("cut") + "/references/small_trajectory.bin");
  for (int sittings = 0; sittings < 100 && without_times(rows("cut")) != without_times(rows("whole")); ++sittings)
  {
    const int before = runs_;
    bench("cut", two_methods(), 3);
    EXPECT_LE(runs_ - before, 3);
  }
  EXPECT_EQ(without_times(rows("cut")), without_times(rows("whole")));
  EXPECT_EQ(runs_, runs_of_whole) << "nothing was run twice";
  EXPECT_EQ(text_of(path("cut") + "/references/small_trajectory.bin"), reference);
  bench("cut", two_methods());
  EXPECT_EQ(runs_, runs_of_whole) << "there was nothing left to run";
}

TEST_F(BenchInAFolder, RunsAgainWhatWasBeingWrittenWhenItWasKilled)
{
  bench("out", two_methods());
  const std::vector<Row> whole = rows("out");
  const std::string journal = text_of(path("out") + "/measurements.csv");
  write("out/measurements.csv", journal.substr(0, journal.size() - 20));
  runs_ = 0;
  bench("out", two_methods());
  EXPECT_EQ(runs_, 1);
  EXPECT_EQ(without_times(rows("out")), without_times(whole));
}

TEST_F(BenchInAFolder, BeginsASceneAnewThatHasChanged)
{
  bench("out", two_methods());
  const std::vector<Row> before = rows("out");
  runs_ = 0;
  testing::internal::CaptureStderr();
  bench("out", two_methods(), 1 << 30, std::string(small_scene) + "gravity: [0, 0, -5]\n");
  EXPECT_TRUE(has(testing::internal::GetCapturedStderr(), { "small (trajectory) begins anew: " }));
  EXPECT_GT(runs_, 4);
  EXPECT_EQ(rows("out").front().at("scene"), "small");
  EXPECT_NE(rows("out").back().at("rms_error"), before.back().at("rms_error"));
  runs_ = 0;
  bench("out", two_methods());
  EXPECT_EQ(runs_, 0) << "what was measured of the scene as it was is still there";
  EXPECT_EQ(without_times(rows("out")), without_times(before));
}

TEST_F(BenchInAFolder, RefusesAFolderOfAnotherMachineOrProgram)
{
  bench("out", two_methods(), 1);
  for (const Provenance& other :
       { Provenance{ "another", "a compiler", "a commit" }, Provenance{ "a machine", "another", "a commit" },
         Provenance{ "a machine", "a compiler", "another" } })
  {
    try
    {
      const Bench bench(path("out"), small_settings(), two_methods(), nullptr, other);
      FAIL() << "taken";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_TRUE(has(error.what(), { "/out has measurements of another ", "here another", "--out" }));
    }
  }
}

TEST_F(BenchInAFolder, RefusesAFolderThatIsInUse)
{
  const Bench first(path("out"), small_settings(), two_methods(), nullptr, { "a", "b", "c" });
  EXPECT_THROW(Bench(path("out"), small_settings(), two_methods(), nullptr, { "a", "b", "c" }), std::runtime_error);
}

TEST_F(BenchInAFolder, RunsNothingOfASceneWithoutAReference)
{
  BenchSettings strict = small_settings();
  strict.reference.most_disagreement = 1e-25;
  EXPECT_FALSE(bench("out", two_methods(), 1 << 30, small_scene, strict));
  EXPECT_EQ(runs_, 0);
  EXPECT_TRUE(rows("out").empty());
  ASSERT_EQ(scene_rows("out").size(), 1U);
  EXPECT_EQ(scene_rows("out").at(0).at("accepted"), "no");
  EXPECT_TRUE(has(scene_rows("out").at(0).at("reason"), { "a disturbance of 1e-9 m grows " }));
}

TEST_F(BenchInAFolder, ChartsASceneWithAStrainLimitWithItAndWithoutIt)
{
  const std::string limited =
      "cloth: {rows: 5, cols: 6, ripple: 0.02}\nstrain_limit: {max_strain: 0.05, sweeps: 1000}\n";
  BenchSettings brief = small_settings();
  brief.limited_seconds = 0.5;
  brief.limited_disagreement = 1e-3;
  brief.spatial_seconds = 60.0;
  Solvers solvers;
  solvers.push_back(std::make_unique<Counted>("velocity_verlet", runs_));
  bench("out", std::move(solvers), 1 << 30, limited, brief);
  std::map<std::string, int> rows_of_kind;
  for (const Row& row : rows("out"))
  {
    ++rows_of_kind[row.at("kind")];
    EXPECT_EQ(row.at("solver"), row.at("kind") == "spatial" ? "dopri5" : "velocity_verlet");
  }
  EXPECT_GT(rows_of_kind["trajectory"], 2);
  EXPECT_GT(rows_of_kind["limited"], 2);
  EXPECT_EQ(rows_of_kind["spatial"], 2);
  const std::vector<Row> scenes = scene_rows("out");
  ASSERT_EQ(scenes.size(), 3U);
  for (const Row& scene : scenes)
  {
    EXPECT_EQ(scene.at("accepted"), "yes") << scene.at("kind") << ": " << scene.at("reason");
  }
  const std::vector<Row> all = rows("out");
  EXPECT_EQ(all.back().at("setting"), "nodes_per_side");
  EXPECT_EQ(all.back().at("value"), "9");
  EXPECT_EQ(all.back().at("nodes"), "99");
  EXPECT_LT(std::stod(all.back().at("rms_error")), std::stod(all.at(all.size() - 2).at("rms_error")));
}

}  // namespace
}  // namespace cloth
