// Runs a scene without ROS: cloth_run SCENE.yaml [options], see run_options.cpp.

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>

#include <unistd.h>

#include "cloth_sim/scene/plan.h"
#include "cloth_sim/scene/scene_reader.h"
#include "replaced_file.h"
#include "run_options.h"
#include "run_report.h"

namespace
{

constexpr int done = 0;
constexpr int diverged = 1;
constexpr int bad_usage = 2;

cloth::SceneParams read_scene_with_settings(const cloth::RunOptions& options)
{
  YAML::Node tree = cloth::load_scene_file(options.scene_file);
  for (const auto& [key, value] : options.settings)
  {
    cloth::override_key(tree, key, value);
  }
  return cloth::read_scene(tree);
}

cloth::Plan plan_for(const cloth::RunOptions& options)
{
  const cloth::SceneParams scene = read_scene_with_settings(options);
  return options.plan_file.empty() ?
             cloth::make_plan(scene) :
             cloth::make_plan(scene, cloth::read_choice(cloth::load_scene_file(options.plan_file)));
}

/// A line on a terminal that is written over.
class Progress
{
public:
  explicit Progress(double duration) : duration_(duration), is_terminal_(isatty(STDERR_FILENO) != 0)
  {
  }

  void show(double time, double real_time_factor) const
  {
    if (is_terminal_)
    {
      std::fprintf(stderr, "\r%.2f of %.2f s, %.1f times real time ", time, duration_, real_time_factor);
    }
  }

  void end() const
  {
    if (is_terminal_)
    {
      std::fprintf(stderr, "\n");
    }
  }

private:
  double duration_;
  bool is_terminal_;
};

class Stopwatch
{
public:
  template <typename Work>
  void time(Work&& work)
  {
    const auto begin = std::chrono::steady_clock::now();
    work();
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  double seconds() const
  {
    return seconds_;
  }

private:
  double seconds_ = 0.0;
};

/// The time of sample k; the last one is the end, and a sample that rounding puts just before it is the end too.
double sample_time(std::uint64_t k, const cloth::RunOptions& options)
{
  const double time = static_cast<double>(k) * options.every;
  return time < options.duration * (1.0 - 1e-12) ? time : options.duration;
}

int run(const cloth::RunOptions& options)
{
  const cloth::Plan plan = plan_for(options);
  cloth::Simulation simulation = cloth::build_simulation(plan);
  const std::vector<std::string> plan_lines = cloth::describe(plan, simulation);
  if (options.plan_only)
  {
    for (const std::string& line : plan_lines)
    {
      std::cout << line << "\n";
    }
    std::cout << "grid: " << cloth::described_grid(plan) << "\n";
    return done;
  }
  const std::string warning = cloth::time_step_warning(simulation);
  if (!warning.empty())
  {
    std::cerr << "cloth_run: warning: " << warning << "\n";
  }

  std::optional<cloth::ReplacedFile> output;
  std::optional<cloth::ReplacedFile> summary;
  if (!options.output_file.empty())
  {
    output.emplace(options.output_file);
    cloth::write_csv_header(output->stream());
    cloth::write_csv_sample(output->stream(), simulation.state());
  }
  if (!options.summary_file.empty())
  {
    summary.emplace(options.summary_file);
  }

  const Progress progress(options.duration);
  Stopwatch stopwatch;
  double sampled = 0.0;
  for (std::uint64_t k = 1; sampled < options.duration && !simulation.divergence(); ++k)
  {
    stopwatch.time([&] { simulation.advance_to(sample_time(k, options)); });
    if (output && simulation.state().time > sampled)
    {
      cloth::write_csv_sample(output->stream(), simulation.state());
    }
    sampled = simulation.state().time;
    progress.show(sampled, sampled / stopwatch.seconds());
  }
  progress.end();
  for (const std::string& warning : { cloth::convergence_warning(simulation), cloth::reach_warning(simulation) })
  {
    if (!warning.empty())
    {
      std::cerr << "cloth_run: warning: " << warning << "\n";
    }
  }

  if (output)
  {
    output->commit();
  }
  if (summary)
  {
    cloth::write_summary(summary->stream(), simulation, stopwatch.seconds(), plan_lines, plan.choice);
    summary->commit();
  }
  if (simulation.divergence())
  {
    std::cerr << "cloth_run: " << simulation.divergence_report() << "\n";
    return diverged;
  }
  return done;
}

}  // namespace

int main(int argc, char** argv)
{
  try
  {
    const cloth::RunOptions options = cloth::parse_run_options(argc, argv);
    if (options.help)
    {
      std::cout << cloth::run_usage;
      return done;
    }
    cloth::ReplacedFile::remove_uncommitted_when_ended();
    return run(options);
  }
  catch (const cloth::UsageError& error)
  {
    std::cerr << "cloth_run: " << error.what() << "\n\n" << cloth::run_usage;
  }
  catch (const std::exception& error)
  {
    std::cerr << "cloth_run: " << error.what() << "\n";
  }
  return bad_usage;
}
