// Whether the planner's choices hold, on scenes drawn at random: plan_matrix [options], see matrix_options.cpp; what
// the tables mean stands in README.md beside this file.

#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>

#include "bench_scene.h"
#include "competitors.h"
#include "matrix_options.h"
#include "one_core.h"
#include "replaced_file.h"

namespace
{

constexpr int done = 0;
constexpr int refused = 1;
constexpr int bad_usage = 2;

void say(const std::string& line)
{
  std::cerr << "plan_matrix: " << line << "\n";
}

/// A commit does not tell a program from one that was built after another change.
std::string build_of_this_program()
{
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return cloth::fingerprint_of(content.str());
}

int run(const cloth::MatrixOptions& options)
{
  if (!cloth::stay_on_one_core())
  {
    say("could not keep to one core: times will scatter more");
  }
  bool any = false;
  for (const cloth::Half half : options.halves)
  {
    const cloth::Provenance provenance = cloth::provenance_here();
    const cloth::MatrixFolder folder(options.folder, half, provenance);
    if (options.searches)
    {
      cloth::SceneSearch(folder, half, options.settings, cloth::solvers_to_search(), cloth::independent_solver()).run();
    }
    if (options.plans)
    {
      any = cloth::PlanTrial(folder, options.trial, provenance, build_of_this_program()).run() || any;
    }
  }
  return any || !options.plans ? done : refused;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    const cloth::MatrixOptions options = cloth::parse_matrix_options(argc, argv);
    if (options.help)
    {
      std::cout << cloth::matrix_usage;
      return done;
    }
    cloth::ReplacedFile::remove_uncommitted_when_ended();
    return run(options);
  }
  catch (const cloth::MatrixUsageError& error)
  {
    std::cerr << "plan_matrix: " << error.what() << "\n\n" << cloth::matrix_usage;
  }
  catch (const std::exception& error)
  {
    say(error.what());
  }
  return bad_usage;
}
