// Charts speed against accuracy: cloth_bench [SCENE.yaml ...] [options], see bench_options.cpp; what the tables mean
// stands in README.md beside this file.

#include <cstdio>
#include <exception>
#include <iostream>

#include "bench.h"
#include "bench_options.h"
#include "charts.h"
#include "competitors.h"
#include "one_core.h"
#include "own_solver.h"
#include "provenance.h"
#include "replaced_file.h"
#include "shipped_files.h"

namespace
{

constexpr int done = 0;
constexpr int refused = 1;
constexpr int bad_usage = 2;

void say(const std::string& line)
{
  std::cerr << "cloth_bench: " << line << "\n";
}

/// As it was given, but for the folder that the program is in.
std::string command_of(int argc, char** argv)
{
  std::string command = "cloth_bench";
  for (int i = 1; i < argc; ++i)
  {
    command += std::string(" ") + argv[i];
  }
  return command;
}

cloth::Solvers all_solvers()
{
  cloth::Solvers solvers = cloth::own_solvers();
  for (std::unique_ptr<cloth::Solver>& competitor : cloth::competitors())
  {
    solvers.push_back(std::move(competitor));
  }
  return solvers;
}

int run(const cloth::BenchOptions& options, const std::string& command)
{
  const std::vector<cloth::BenchScene> scenes = cloth::read_scenes(
      options.scene_files.empty() ? cloth::scenes_of_the_program(options.quick) : options.scene_files);
  if (scenes.empty())
  {
    throw cloth::BenchUsageError("there are no scenes beside the program; give some");
  }
  if (!cloth::stay_on_one_core())
  {
    say("could not keep to one core: times will scatter more");
  }
  for (const std::string& line : cloth::left_out_competitors())
  {
    say(line);
  }
  cloth::Bench bench(options.folder, options.quick ? cloth::BenchSettings::quick() : cloth::BenchSettings(),
                     all_solvers(), cloth::independent_solver(), cloth::provenance_here());
  const bool any_accepted = bench.run(scenes);
  say("tables: " + options.folder + "/runs.csv and scenes.csv");
  if (options.charts && any_accepted)
  {
    const std::string failure = cloth::draw_charts(options.folder, command);
    say(failure.empty() ? "charts: " + options.folder : failure);
  }
  return any_accepted ? done : refused;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    const cloth::BenchOptions options = cloth::parse_bench_options(argc, argv);
    if (options.help)
    {
      std::cout << cloth::bench_usage;
      return done;
    }
    cloth::ReplacedFile::remove_uncommitted_when_ended();
    return run(options, command_of(argc, argv));
  }
  catch (const cloth::BenchUsageError& error)
  {
    std::cerr << "cloth_bench: " << error.what() << "\n\n" << cloth::bench_usage;
  }
  catch (const std::exception& error)
  {
    say(error.what());
  }
  return bad_usage;
}
