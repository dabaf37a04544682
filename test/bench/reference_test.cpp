// A reference counts only when two independent solvers agree.

#include "competitors.h"
#include "errors.h"
#include "reference.h"
#include "reference_file.h"
#include "in_a_folder.h"
#include "small_problem.h"
#include "support.h"

namespace cloth
{
namespace
{

/// Another formula than dopri5's, by far small enough steps, where none of others' solvers is there.
class SmallSteps : public OwnSolver
{
public:
  SmallSteps() : OwnSolver(*find_method("rk4"), Setting::step)
  {
  }
  Outcome run(const Problem& problem, double, double most_seconds) const override
  {
    return OwnSolver::run(problem, problem.sample_interval() / 512, most_seconds);
  }
};

std::unique_ptr<Solver> other_solver()
{
  std::unique_ptr<Solver> solver = independent_solver();
  return solver ? std::move(solver) : std::make_unique<SmallSteps>();
}

TEST(ReferenceOfAMotion, IsAcceptedWhereTwoSolversAgree)
{
  const Reference reference = find_reference(small_problem(), other_solver().get(), {});
  EXPECT_TRUE(reference.accepted) << reference.reason;
  EXPECT_EQ(reference.reason, "");
  EXPECT_EQ(reference.horizon, 0.1);
  EXPECT_GT(reference.disagreement, 0.0);
  EXPECT_LT(reference.disagreement, 1e-9);
  EXPECT_GT(reference.growth, 0.1);
  EXPECT_LT(reference.growth, 100.0);
  EXPECT_LT(rms_distance(reference.samples, exact_motion(small_problem()).samples), 1e-9);
}

TEST(ReferenceOfAMotion, IsRefusedWithTheReasonWhereItIsTooCoarse)
{
  ReferenceSettings settings;
  settings.first_tolerance = 1e-3;
  settings.tightest_tolerance = 1e-4;
  settings.most_halvings = 0;
  const Reference reference = find_reference(small_problem(), other_solver().get(), settings);
  EXPECT_FALSE(reference.accepted);
  EXPECT_GT(reference.disagreement, 1e-9);
  EXPECT_TRUE(has(reference.reason, { "dopri5 and ", " differ by ",
                                      " m at a tolerance of 0.0001 m; allowed is 1e-09 m, "
                                      "1 % of the smallest error drawn" }));
}

TEST(ReferenceOfAMotion, IsRefusedWhereTheTwoFindDifferentMotions)
{
  class Elsewhere : public StraySolver
  {
    Outcome run(const Problem& problem, double, double most_seconds) const override
    {
      return StraySolver::run(problem, 1e-6, most_seconds);
    }
  };
  const Elsewhere elsewhere;
  const Reference reference = find_reference(small_problem(), &elsewhere, {});
  EXPECT_FALSE(reference.accepted);
  EXPECT_TRUE(has(reference.reason, { "dopri5 and stray differ by 1e-06 m" }));
}

TEST(ReferenceOfAMotion, TakesAShorterHorizonWhereADisturbanceGrowsTooMuch)
{
  ReferenceSettings settings;
  settings.most_halvings = 0;
  const double growth = find_reference(small_problem(0.4), other_solver().get(), settings).growth;
  settings.most_halvings = 4;
  settings.rounding = 1.01 * settings.most_disagreement / growth;
  const Reference shorter = find_reference(small_problem(0.4), other_solver().get(), settings);
  EXPECT_TRUE(shorter.accepted);
  EXPECT_LT(shorter.horizon, 0.4);
  EXPECT_TRUE(has(shorter.reason,
                  { "horizon shortened: over 0.4 s a disturbance of 1e-9 m grows ", " times, and rounding with it" }));
}

TEST(ReferenceOfAMotion, IsRefusedWithoutAnIndependentSolver)
{
  const Reference reference = find_reference(small_problem(), nullptr, {});
  EXPECT_FALSE(reference.accepted);
  EXPECT_TRUE(has(reference.reason, { "no independent solver" }));
}

TEST(ReferenceWithAStrainLimit, IsTheRuleAtShortSteps)
{
  SceneParams scene = scene_of(small_scene);
  scene.strain_limit = { 0.05, 1000, LimitSolver::plain_sweeps };
  const Problem problem = problem_of("a", Kind::limited, scene, 0.1);
  ReferenceSettings settings;
  settings.most_disagreement = 1e-4;
  settings.most_seconds = 2.0;
  const Reference reference = find_limited_reference(problem, settings);
  EXPECT_TRUE(reference.accepted) << reference.reason;
  const OwnSolver solver(*find_method("velocity_verlet"), Setting::step);
  const double coarser = rms_distance(solver.run(problem, 1.25e-2 / 8, 10.0).samples, reference.samples);
  const double finer = rms_distance(solver.run(problem, 1.25e-2 / 16, 10.0).samples, reference.samples);
  EXPECT_LT(finer, 0.7 * coarser);
  EXPECT_LT(reference.disagreement, finer);
  settings.most_disagreement = 1e-9;
  EXPECT_TRUE(
      has(find_limited_reference(problem, settings).reason, { "differs from itself at twice that or from rk4" }));
}

class ReferenceFile : public InAFolder
{
};

TEST_F(ReferenceFile, GivesBackWhatWasWritten)
{
  const Problem problem = small_problem();
  Reference reference{ true, 0.1, 1.0 / 3.0, 2.5, "for a reason", exact_motion(problem).samples };
  write_reference(path("a.bin"), "print", reference);
  const std::optional<Reference> kept = read_reference(path("a.bin"), "print");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->accepted, true);
  EXPECT_EQ(kept->horizon, reference.horizon);
  EXPECT_EQ(kept->disagreement, reference.disagreement);
  EXPECT_EQ(kept->growth, reference.growth);
  EXPECT_EQ(kept->reason, reference.reason);
  ASSERT_EQ(kept->samples.size(), reference.samples.size());
  for (size_t s = 0; s < kept->samples.size(); ++s)
  {
    EXPECT_EQ(kept->samples[s].time, reference.samples[s].time);
    EXPECT_EQ(kept->samples[s].positions, reference.samples[s].positions);
    EXPECT_EQ(kept->samples[s].velocities, reference.samples[s].velocities);
  }
}

TEST_F(ReferenceFile, IsNotTakenForAnotherSceneNorWhereItIsCutShort)
{
  EXPECT_FALSE(read_reference(path("none.bin"), "print"));
  write_reference(path("a.bin"), "print", { true, 0.1, 0.0, 0.0, "", exact_motion(small_problem()).samples });
  EXPECT_FALSE(read_reference(path("a.bin"), "other"));
  const std::string whole = text_of(path("a.bin"));
  write("a.bin", whole.substr(0, whole.size() - 8));
  EXPECT_FALSE(read_reference(path("a.bin"), "print"));
}

}  // namespace
}  // namespace cloth
