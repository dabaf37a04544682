// Six small scenes from the draw to the table, and what of it is done again for another planner.

#include <cmath>

#include "competitors.h"
#include "errors.h"
#include "in_a_folder.h"
#include "matrix_options.h"
#include "own_solver.h"
#include "part.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

/// By another method than that which weighs parts.
std::vector<ClothState> motion_of(SceneParams scene)
{
  scene.plan = "full";
  const Problem problem = problem_of("scene", Kind::trajectory, scene, 1.0);
  return OwnSolver(*find_method("rk4"), Setting::step).run(problem, 1e-4, 100.0).samples;
}

const Provenance here{ "a machine", "a compiler", "a commit" };

class SmallMatrix : public InAFolder
{
protected:
  /// What the planner measures goes with the folder.
  SmallMatrix()
  {
    setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
  }
  ~SmallMatrix() override
  {
    unsetenv("XDG_CACHE_HOME");
  }

  static MatrixSettings small_settings()
  {
    MatrixSettings settings;
    settings.scenes = 6;
    settings.most_per_side = 9;
    settings.most_node_steps = 1e5;
    settings.search.most_repeats = 1;
    settings.search.least_timed = 0.0;
    return settings;
  }
  static TrialSettings quick_trial()
  {
    TrialSettings settings;
    settings.runs = 1;
    settings.least_timed = 0.0;
    return settings;
  }
  static Solvers few_solvers()
  {
    Solvers solvers;
    solvers.push_back(std::make_unique<OwnSolver>(*find_method("dopri5"), Setting::tolerance));
    solvers.push_back(std::make_unique<OwnSolver>(*find_method("velocity_verlet"), Setting::step));
    return solvers;
  }

  void search(Half half, const MatrixSettings& settings = small_settings()) const
  {
    const MatrixFolder folder(path("matrix"), half, here);
    SceneSearch(folder, half, settings, few_solvers(), independent_solver()).run();
  }
  bool plan(Half half, const std::string& build, const TrialSettings& settings = quick_trial()) const
  {
    const MatrixFolder folder(path("matrix"), half, here);
    return PlanTrial(folder, settings, here, build).run();
  }
  std::vector<std::string> lines(Half half, const std::string& table) const
  {
    std::istringstream text(text_of(path("matrix/") + name_of(half) + "/" + table));
    std::vector<std::string> lines;
    std::string line;
    std::getline(text, line);
    while (std::getline(text, line))
    {
      lines.push_back(line);
    }
    return lines;
  }
};

TEST_F(SmallMatrix, PlansSixScenesHonestly)
{
  for (const Half half : { Half::development, Half::held_out })
  {
    search(half);
    EXPECT_TRUE(plan(half, "a build"));
    const std::vector<std::string> plans = lines(half, "plans.csv");
    EXPECT_EQ(plans.size(), 9U);
    for (const std::string& line : plans)
    {
      const PlanRow row = plan_row_of(line);
      EXPECT_EQ(row.status, "ok") << line;
      EXPECT_FALSE(row.best_solver.empty()) << line;
      EXPECT_LE(row.best_error, row.tolerance) << line;
      EXPECT_GT(row.cost, 0.0) << line;
      EXPECT_TRUE(std::isfinite(row.true_error)) << line;
      EXPECT_GT(row.estimate, 0.0) << line;
      if (row.estimate <= row.tolerance)
      {
        EXPECT_LE(row.true_error, row.tolerance) << line;
      }
    }
  }
}

TEST_F(SmallMatrix, WeighsEachPartOfEachScene)
{
  MatrixSettings settings = small_settings();
  settings.scenes = 1;
  search(Half::development, settings);
  plan(Half::development, "a build");
  const std::vector<std::string> plans = lines(Half::development, "plans.csv");
  ASSERT_EQ(plans.size(), 3U);
  const PlanRow plan = plan_row_of(plans.front());
  const SceneParams scene = scene_of(text_of(path("matrix/development/scenes/" + plan.scene + ".yaml")));
  const PartNames all = parts_of(scene);
  size_t weighed = 0;
  for (const std::string& line : lines(Half::development, "parts.csv"))
  {
    const PartRow row = part_row_of(line);
    if (row.tolerance != plan.tolerance)
    {
      continue;
    }
    const PartNames as_planned = names_in(plan.left_out);
    PartNames otherwise = as_planned;
    EXPECT_EQ(row.is_left_out, otherwise.erase(row.part) == 1) << line;
    if (!row.is_left_out)
    {
      otherwise.insert(row.part);
    }
    const double change = rms_distance(motion_of(without(otherwise, scene)), motion_of(without(as_planned, scene)));
    EXPECT_NEAR(row.change, change, 1e-6) << line;
    EXPECT_EQ(all.count(row.part), 1U) << line;
    ++weighed;
  }
  EXPECT_EQ(weighed, all.size());
}

TEST_F(SmallMatrix, PlansAnewForAnotherBuildAlone)
{
  MatrixSettings settings = small_settings();
  settings.scenes = 3;
  search(Half::development, settings);
  const std::string searches = text_of(path("matrix/development/searches.csv"));
  plan(Half::development, "a build");
  const std::vector<std::string> first = lines(Half::development, "plans.csv");
  const std::vector<std::string> parts = lines(Half::development, "parts.csv");
  plan(Half::development, "a build");
  EXPECT_EQ(lines(Half::development, "plans.csv"), first);
  EXPECT_EQ(lines(Half::development, "parts.csv"), parts);
  plan(Half::development, "another build");
  EXPECT_EQ(lines(Half::development, "plans.csv").size(), 2 * first.size());
  search(Half::development, settings);
  EXPECT_EQ(text_of(path("matrix/development/searches.csv")), searches);
}

TEST_F(SmallMatrix, ListsDrawsThatHaveNoExactMotion)
{
  MatrixSettings settings = small_settings();
  settings.scenes = 1;
  settings.most_attempts = 3;
  settings.most_node_steps = 1.0;
  search(Half::development, settings);
  const std::vector<std::string> draws = lines(Half::development, "scenes.csv");
  ASSERT_EQ(draws.size(), 3U);
  for (const std::string& line : draws)
  {
    EXPECT_TRUE(has(line, { ",no,", "velocity_verlet would move" })) << line;
  }
  EXPECT_FALSE(plan(Half::development, "a build"));
}

TEST_F(SmallMatrix, RefusesTheMotionOfAnotherMachine)
{
  const MatrixFolder folder(path("matrix"), Half::development, here);
  EXPECT_THROW(MatrixFolder(path("matrix"), Half::development, { "another machine", "a compiler", "a commit" }),
               std::runtime_error);
  EXPECT_NO_THROW(MatrixFolder(path("matrix"), Half::development, { "a machine", "a compiler", "another commit" }));
}

TEST(PlanRow, ReadsBackAsItWas)
{
  PlanRow row;
  row.build = "a build";
  row.commit = "abc";
  row.scene = "007";
  row.tolerance = 1e-3;
  row.status = "refused";
  row.left_out = "flex springs+wind";
  row.iterations = 12;
  row.true_error = 0.25;
  row.message = "no, not\n\"that\"";
  const PlanRow read = plan_row_of(line_of(row));
  EXPECT_EQ(line_of(read), line_of(row));
  EXPECT_EQ(read.left_out, "flex springs+wind");
  EXPECT_EQ(read.iterations, 12);
  EXPECT_EQ(read.true_error, 0.25);
  EXPECT_TRUE(std::isnan(read.estimate));
  EXPECT_EQ(read.message, "no; not 'that'");
  EXPECT_THROW(plan_row_of("too,short"), std::runtime_error);
}

TEST(PartRow, ReadsBackAsItWas)
{
  const PartRow row{ "a build", "007", "ffff", 1e-4, "wind", true, 3e-5 };
  const PartRow read = part_row_of(line_of(row));
  EXPECT_EQ(line_of(read), line_of(row));
  EXPECT_TRUE(read.is_left_out);
  EXPECT_EQ(read.change, 3e-5);
}

MatrixOptions parsed(std::vector<std::string> words)
{
  words.insert(words.begin(), "plan_matrix");
  std::vector<char*> arguments;
  for (std::string& word : words)
  {
    arguments.push_back(word.data());
  }
  return parse_matrix_options(static_cast<int>(arguments.size()), arguments.data());
}

std::string fault_of(const std::vector<std::string>& words)
{
  try
  {
    parsed(words);
    return {};
  }
  catch (const MatrixUsageError& error)
  {
    return error.what();
  }
}

TEST(MatrixOptions, SayWhichScenesAndWhatIsDone)
{
  const MatrixOptions options =
      parsed({ "--scenes", "8", "--seed", "3", "--half", "held_out", "--only", "plans", "--out", "there" });
  EXPECT_EQ(options.settings.scenes, 8);
  EXPECT_EQ(options.settings.held_out_seed, 3U);
  EXPECT_EQ(options.halves, std::vector<Half>{ Half::held_out });
  EXPECT_FALSE(options.searches);
  EXPECT_TRUE(options.plans);
  EXPECT_EQ(options.folder, "there");
  EXPECT_EQ(parsed({}).settings.scenes, 60);
  EXPECT_EQ(parsed({ "--quick" }).settings.scenes, 6);
}

TEST(MatrixOptions, AreRefusedWithWhatIsAllowed)
{
  EXPECT_TRUE(has(fault_of({ "--scenes", "none" }), { "--scenes", "none", "from 1 to 1000" }));
  EXPECT_TRUE(has(fault_of({ "--scenes", "0" }), { "--scenes", "0" }));
  EXPECT_TRUE(has(fault_of({ "--half", "third" }), { "--half", "third", "development, held_out, both" }));
  EXPECT_TRUE(has(fault_of({ "--only", "talk" }), { "--only", "talk", "search, plans" }));
  EXPECT_TRUE(has(fault_of({ "--seed" }), { "--seed", "needs a value" }));
  EXPECT_TRUE(has(fault_of({ "scene.yaml" }), { "scene.yaml", "is not an option" }));
}

}  // namespace
}  // namespace cloth
