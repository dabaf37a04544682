// What cloth_run writes.

#include <cmath>
#include <regex>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/scene/plan.h"
#include "cloth_sim/scene/scene_reader.h"
#include "tools/program.h"

namespace cloth
{
namespace
{

using Times = std::vector<double>;

class ClothRunCsv : public ClothRun
{
protected:
  std::string csv_of(const std::string& words) const
  {
    const Ended ended = run(small_scene() + " " + words + " --output " + path("out.csv"));
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return text_of(path("out.csv"));
  }
};

TEST_F(ClothRunCsv, HasItsHeaderAndEveryNodeInOrderAtEverySample)
{
  const std::string csv = csv_of("--duration 0.1 --every 0.05");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "time,node,x,y,z,vx,vy,vz");
  EXPECT_EQ(csv.back(), '\n');
  const std::vector<std::vector<double>> rows = rows_of(csv);
  ASSERT_EQ(rows.size(), 3u * 20u);
  for (size_t i = 0; i < rows.size(); ++i)
  {
    ASSERT_EQ(rows[i].size(), 8u);
    EXPECT_EQ(rows[i][0], rows[i - i % 20][0]);
    EXPECT_EQ(rows[i][1], static_cast<double>(i % 20));
  }
}

TEST_F(ClothRunCsv, HasSeventeenSignificantDigits)
{
  std::istringstream lines(csv_of("--duration 0.1"));
  std::string line;
  std::getline(lines, line);
  const std::string number = "-?[0-9]\\.[0-9]{16}e[-+][0-9]+";
  const std::regex form(number + ",[0-9]+(," + number + "){6}");
  while (std::getline(lines, line))
  {
    EXPECT_TRUE(std::regex_match(line, form)) << line;
  }
}

TEST_F(ClothRunCsv, BeginsWithTheStartStateInItsNodesOrder)
{
  const std::vector<std::vector<double>> rows = rows_of(csv_of("--duration 0"));
  ASSERT_EQ(rows.size(), 20u);
  const SceneParams scene = read_scene(load_scene_file(path("small.yaml")));
  const Simulation simulation = build_simulation(make_plan(scene));
  for (int row = 0; row < 4; ++row)
  {
    for (int col = 0; col < 5; ++col)
    {
      const std::vector<double>& written = rows[static_cast<size_t>(row * 5 + col)];
      EXPECT_NEAR(written[2], -0.5 + col / 4.0, 1e-15);
      EXPECT_NEAR(written[4], 1.5 - row / 3.0, 1e-15);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(written[static_cast<size_t>(2 + axis)], simulation.state().positions(row * 5 + col, axis));
        EXPECT_EQ(written[static_cast<size_t>(5 + axis)], 0.0);
      }
    }
  }
}

TEST_F(ClothRunCsv, SamplesEveryMultipleAndTheEndOnce)
{
  EXPECT_EQ(times_of(csv_of("--duration 0.1 --every 0.025")), (Times{ 0.0, 0.025, 0.05, 3 * 0.025, 0.1 }));
  EXPECT_EQ(times_of(csv_of("--duration 0.3 --every 0.1")), (Times{ 0.0, 0.1, 0.2, 0.3 })) << "3 * 0.1 > 0.3";
  EXPECT_EQ(times_of(csv_of("--duration 0.66 --every 0.06")).size(), 12u) << "11 * 0.06 < 0.66";
  EXPECT_EQ(times_of(csv_of("--duration 0.1 --every 0.04")), (Times{ 0.0, 0.04, 0.08, 0.1 }));
  EXPECT_EQ(times_of(csv_of("--duration 0.1 --every 1")), (Times{ 0.0, 0.1 }));
  EXPECT_EQ(times_of(csv_of("--duration 0 --every 1")), (Times{ 0.0 }));
  EXPECT_EQ(times_of(csv_of("--duration 0.1")), (Times{ 0.0, 0.0333, 2 * 0.0333, 3 * 0.0333, 0.1 }));
}

TEST_F(ClothRunCsv, HasTheSameBytesTwice)
{
  const std::string words = "--duration 1 --set air.wind='[1, 2, 0]'";
  const std::string first = csv_of(words);
  EXPECT_GT(first.size(), 10000u);
  EXPECT_TRUE(first == csv_of(words));
}

TEST_F(ClothRunCsv, GoesToStandardOutputToo)
{
  const std::string csv = csv_of("--duration 0.1");
  EXPECT_EQ(run(small_scene() + " --duration 0.1 --output /dev/stdout").output, csv);
}

TEST_F(ClothRunCsv, ReplacesAnOldFile)
{
  const std::string csv = csv_of("--duration 0.1");
  write("out.csv", std::string(100000, 'x'));
  EXPECT_TRUE(csv_of("--duration 0.1") == csv);
  EXPECT_EQ(files(), (std::vector<std::string>{ "out.csv", "small.yaml" }));
}

class ClothRunSummary : public ClothRun
{
protected:
  YAML::Node summary_of(const std::string& words) const
  {
    const Ended ended =
        run(small_scene() + " " + words + " --output " + path("out.csv") + " --summary " + path("summary.yaml"));
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return YAML::LoadFile(path("summary.yaml"));
  }
};

TEST_F(ClothRunSummary, HasEveryKeyOfTheInterface)
{
  const YAML::Node summary = summary_of("--duration 0.1");
  for (const char* const key : { "simulated_time", "wall_time", "real_time_factor", "time_step", "stability_limit",
                                 "kinetic_energy", "elastic_energy", "gravitational_energy", "max_strain" })
  {
    EXPECT_TRUE(std::isfinite(summary[key].as<double>())) << key;
  }
  for (const char* const key : { "steps", "force_evaluations", "linear_solves", "linear_iterations" })
  {
    EXPECT_GE(summary[key].as<int>(), 0) << key;
  }
  EXPECT_EQ(summary["momentum"].as<Times>().size(), 3u);
  EXPECT_EQ(summary["angular_momentum"].as<Times>().size(), 3u);
  EXPECT_EQ(summary["method"].as<std::string>(), summary["choice"]["method"].as<std::string>());
  EXPECT_EQ(summary["status"].as<std::string>(), "ok");
  EXPECT_EQ(summary["simulated_time"].as<double>(), 0.1);
  EXPECT_GT(summary["wall_time"].as<double>(), 0.0);
  EXPECT_DOUBLE_EQ(summary["real_time_factor"].as<double>(), 0.1 / summary["wall_time"].as<double>());
  EXPECT_EQ(summary["linear_solves"].as<int>(), 0);
  EXPECT_GE(summary["force_evaluations"].as<int>(), summary["steps"].as<int>());
  // The step follows the limit as the sheet deforms, and need not do so at once.
  EXPECT_NEAR(summary["time_step"].as<double>() / summary["stability_limit"].as<double>(), 0.9, 0.02);
}

TEST_F(ClothRunSummary, HasNumbersThatEveryYamlReaderTakesForNumbers)
{
  summary_of("--duration 0.1");
  const std::string text = text_of(path("summary.yaml"));
  const std::regex line_of_a_number(" *[a-z_]+: ([-+]?[0-9]+\\.[0-9]+(e[-+][0-9]+)?|[-+]?\\.inf|[0-9]+)");
  std::istringstream lines(text.substr(0, text.find("plan:")));
  int numbers = 0;
  for (std::string line; std::getline(lines, line);)
  {
    const bool is_number = std::regex_match(line, line_of_a_number);
    numbers += is_number ? 1 : 0;
    EXPECT_TRUE(is_number || contains(line, "status") || contains(line, "method") || contains(line, "momentum") ||
                line == "calls:")
        << line;
  }
  EXPECT_EQ(numbers, 28);
}

TEST_F(ClothRunSummary, HasThePlanThatPlanPrints)
{
  std::string lines;
  for (const YAML::Node& line : summary_of("--duration 0.1")["plan"])
  {
    lines += line.as<std::string>() + "\n";
  }
  const std::string printed = run(small_scene() + " --plan").output;
  EXPECT_EQ(printed.substr(0, lines.size()), lines);
  EXPECT_EQ(printed.substr(lines.size(), 6), "grid: ");
}

TEST_F(ClothRunSummary, HasTheChoiceFromWhichTheSameRunIsMadeAgain)
{
  const YAML::Node first = summary_of("--duration 0.1 --output " + path("first.csv"));
  EXPECT_TRUE(find_method(first["choice"]["method"].as<std::string>()) != nullptr);
  const std::string kept = write("kept.yaml", text_of(path("summary.yaml")));
  const YAML::Node second = summary_of("--duration 0.1 --plan-from " + kept + " --output " + path("second.csv"));
  EXPECT_EQ(text_of(path("first.csv")), text_of(path("second.csv")));
  EXPECT_EQ(second["method"].as<std::string>(), first["choice"]["method"].as<std::string>());
  const Ended refused = run(small_scene() + " --plan-from " + write("bad.yaml", "method: euler\n"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.errors, { "choice.method is euler; allowed: one of " }));
}

TEST_F(ClothRunSummary, CountsTheStepsBetweenSamplesEqualAndAsFewAsTheStepAllows)
{
  // Samples at 0.04, 0.08, 0.1, steps of at most 0.003: 14 + 14 + 7.
  EXPECT_EQ(summary_of(
                "--set solver.method=velocity_verlet --duration 0.1 --every 0.04 --set solver.time_step=0.003")["steps"]
                .as<int>(),
            35);
  EXPECT_EQ(summary_of(
                "--set solver.method=velocity_verlet --duration 0.1 --every 0.04 --set solver.time_step=0.002")["steps"]
                .as<int>(),
            50);
  EXPECT_EQ(
      summary_of("--set solver.method=velocity_verlet --duration 0.1 --every 1 --set solver.time_step=0.003")["steps"]
          .as<int>(),
      34);
  const YAML::Node none = summary_of("--duration 0");
  EXPECT_EQ(none["steps"].as<int>(), 0);
  EXPECT_EQ(none["simulated_time"].as<double>(), 0.0);
  const YAML::Node rk4 = summary_of(
      "--duration 0.1 --every 0.04 --set solver.method=rk4 --set solver.time_step=0.003 "
      "--set strain_limit.max_strain=0");
  EXPECT_EQ(rk4["force_evaluations"].as<int>(), 4 * 35);
}

TEST_F(ClothRunSummary, HasNoStabilityLimitWithoutSprings)
{
  const YAML::Node summary = summary_of(
      "--set solver.method=velocity_verlet --duration 0.1 --every 0.05 --set springs.structural.stiffness=0 --set "
      "springs.shear.stiffness=0 "
      "--set springs.flex.stiffness=0 --set air.viscous_damping=0 --set air.wind_coupling=0 --set pins=[]");
  EXPECT_TRUE(contains(text_of(path("summary.yaml")), "\nstability_limit: .inf\n"));
  EXPECT_EQ(summary["time_step"].as<double>(), 1.0 / 240.0);
  EXPECT_EQ(summary["steps"].as<int>(), 24);
  EXPECT_EQ(summary["max_strain"].as<double>(), 0.0);
  EXPECT_EQ(summary["elastic_energy"].as<double>(), 0.0);
  // A free fall: p = -m g t, energies that add up to those of the start.
  EXPECT_NEAR(summary["momentum"][2].as<double>(), -0.3 * 9.81 * 0.1, 1e-12);
  EXPECT_NEAR(summary["kinetic_energy"].as<double>(), 0.5 * 0.3 * 0.981 * 0.981, 1e-12);
}

TEST_F(ClothRunSummary, HasTheValuesOfTheLastSample)
{
  const YAML::Node summary =
      summary_of("--duration 0.5 --set cloth.velocity='[0.5, 1, 0]' --set cloth.position='[1, 2, 3]'");
  const std::vector<std::vector<double>> rows = rows_of(text_of(path("out.csv")));
  const ClothModel model = make_sheet(read_scene(load_scene_file(path("small.yaml"))).sheet);
  Vectors positions(20, 3);
  double kinetic = 0.0;
  double gravitational = 0.0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 20; ++i)
  {
    const double* const row = rows[rows.size() - 20 + static_cast<size_t>(i)].data();
    const Eigen::Map<const Eigen::Vector3d> x(row + 2);
    const Eigen::Map<const Eigen::Vector3d> v(row + 5);
    const int edges = (i / 5 % 3 == 0 ? 1 : 0) + (i % 5 % 4 == 0 ? 1 : 0);
    const double mass = 0.3 / 12.0 / (1 << edges);
    positions.row(i) = x.transpose();
    kinetic += 0.5 * mass * v.squaredNorm();
    gravitational += mass * 9.81 * x[2];
    momentum += mass * v;
    angular_momentum +=
        mass * Eigen::Vector3d(x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]);
  }
  EXPECT_GT(kinetic, 1e-3);
  EXPECT_NEAR(summary["kinetic_energy"].as<double>(), kinetic, 1e-14);
  EXPECT_NEAR(summary["gravitational_energy"].as<double>(), gravitational, 1e-13);
  double elastic = 0.0;
  double strain = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      const double length = (positions.row(i) - positions.row(j)).norm();
      elastic += 0.5 * batch.stiffness * std::pow(length - batch.rest_length, 2);
      strain = std::max(strain, batch.kind == SpringKind::flex ? 0.0 : length / batch.rest_length - 1.0);
    });
  }
  EXPECT_GT(elastic, 1e-3);
  EXPECT_GT(strain, 0.01);
  EXPECT_NEAR(summary["elastic_energy"].as<double>(), elastic, 1e-13);
  EXPECT_NEAR(summary["max_strain"].as<double>(), strain, 1e-13);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(summary["momentum"][axis].as<double>(), momentum[axis], 1e-14);
    EXPECT_NEAR(summary["angular_momentum"][axis].as<double>(), angular_momentum[axis], 1e-13);
  }
}

}  // namespace
}  // namespace cloth
