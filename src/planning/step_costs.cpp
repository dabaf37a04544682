#include "step_costs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "cloth_sim/model/wide_vectors.h"
#include "cloth_sim/scene/yaml_text.h"
#include "cloth_sim/threads/processor.h"

namespace cloth
{
namespace
{

constexpr const char* base_method = "velocity_verlet";
/// Between what was measured and its seconds, in a line of the file.
const std::string separator = ": ";
constexpr int base_rounds = 6;
constexpr int rounds = 3;
/// Seconds of one timing, about, and the steps in it: a simulation looks after itself every 64 steps.
constexpr double timing = 1e-3;
constexpr int least_steps = 2;
constexpr int most_steps = 64;

std::string key_of(const StartedScene& scene, const Stepping& stepping)
{
  const SceneParams& params = scene.params;
  const SheetProperties& sheet = params.sheet;
  const bool solves_equations = find_method(stepping.method)->linear_solves > 0;
  std::string parts;
  for (const SpringProperties& kind : { sheet.structural, sheet.shear, sheet.flex })
  {
    parts += kind.stiffness == 0.0 ? "-" : kind.damping == 0.0 ? "k" : "d";
  }
  parts += params.air.wind_coupling == 0.0 ? "" : " wind";
  parts += params.strain_limit.max_strain == 0.0 ? "" : " limit";
  return stepping.method + " " + std::to_string(sheet.rows) + " x " + std::to_string(sheet.cols) + " " + parts + " " +
         (solves_equations ? format_number(stepping.time_step) + " " : "") + std::to_string(stepping.iterations) + " " +
         std::to_string(params.solver.threads);
}

/// A few steps at a time of one simulation.
class TimedSteps
{
public:
  TimedSteps(const StartedScene& scene, const Stepping& stepping) : simulation_(simulation_of(scene, stepping))
  {
    seconds_of(1);  // with what is made once
    at_a_time_ =
        std::clamp(static_cast<int>(timing / std::max(seconds_of(least_steps), 1e-7)), least_steps, most_steps);
  }

  double seconds_a_step()
  {
    return seconds_of(at_a_time_);
  }

private:
  double seconds_of(int steps)
  {
    const std::uint64_t before = simulation_.counters().steps;
    const double end = simulation_.state().time + steps * simulation_.time_step();
    const double begin = processor_seconds();
    simulation_.advance_to(end);
    return (processor_seconds() - begin) /
           static_cast<double>(std::max<std::uint64_t>(1, simulation_.counters().steps - before));
  }

  Simulation simulation_;
  int at_a_time_ = 1;
};

double median(std::array<double, rounds> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  return numbers[rounds / 2];
}

}  // namespace

StepCosts::StepCosts(std::string path) : path_(std::move(path))
{
  std::ifstream file(path_);
  for (std::string line; std::getline(file, line);)
  {
    const size_t end = line.rfind(separator);
    const double seconds = end == std::string::npos ? 0.0 : std::strtod(line.c_str() + end + separator.size(), nullptr);
    if (seconds > 0.0 && std::isfinite(seconds))
    {
      seconds_[line.substr(0, end)] = seconds;
    }
  }
}

std::string StepCosts::usual_path()
{
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  const std::string folder = cache != nullptr && *cache != '\0' ? cache :
                             home != nullptr && *home != '\0'   ? std::string(home) + "/.cache" :
                                                                  std::string();
  if (folder.empty())
  {
    return {};
  }
  std::string machine = processor_name() + " " + std::to_string(static_cast<int>(vector_width()));
  std::replace_if(
      machine.begin(), machine.end(), [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
  return folder + "/cloth_sim/step_costs_" + machine + ".txt";
}

double StepCosts::of_a_step(const StartedScene& scene, const Stepping& stepping)
{
  const std::string key = key_of(scene, stepping);
  const auto kept = seconds_.find(key);
  if (kept != seconds_.end())
  {
    return kept->second;
  }
  const Stepping base_stepping{ base_method };
  TimedSteps base(scene, base_stepping);
  double seconds = 0.0;
  if (stepping.method == base_method)
  {
    std::array<double, base_rounds> times;
    for (double& time : times)
    {
      time = base.seconds_a_step();
    }
    seconds = *std::min_element(times.begin(), times.end());
  }
  else
  {
    TimedSteps own(scene, stepping);
    std::array<double, rounds> ratios;
    for (double& ratio : ratios)
    {
      const double before = base.seconds_a_step();
      const double time = own.seconds_a_step();
      ratio = 2.0 * time / (before + base.seconds_a_step());
    }
    seconds = median(ratios) * of_a_step(scene, base_stepping);
  }
  seconds_[key] = seconds;
  keep();
  return seconds;
}

double StepCosts::of_an_evaluation(StartedScene scene, const Stepping& stepping)
{
  scene.params.strain_limit.max_strain = 0.0;
  return of_a_step(scene, stepping) / find_method(stepping.method)->force_evaluations;
}

void StepCosts::keep()
{
  if (path_.empty())
  {
    return;
  }
  std::error_code fault;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), fault);
  const std::string unfinished = path_ + "." + std::to_string(::getpid());
  {
    std::ofstream file(unfinished);
    for (const auto& [key, seconds] : seconds_)
    {
      file << key << separator << format_number(seconds) << '\n';
    }
    if (!file)
    {
      std::filesystem::remove(unfinished, fault);
      return;
    }
  }
  std::filesystem::rename(unfinished, path_, fault);
}

}  // namespace cloth
