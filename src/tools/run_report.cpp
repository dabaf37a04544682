#include "run_report.h"

#include <cstdio>

#include <yaml-cpp/yaml.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

void emit(YAML::Emitter& emitter, const char* key, double value)
{
  emitter << YAML::Key << key << YAML::Value << format_number(value);
}

void emit(YAML::Emitter& emitter, const char* key, std::uint64_t count)
{
  emitter << YAML::Key << key << YAML::Value << std::to_string(count);
}

void emit(YAML::Emitter& emitter, const char* key, const std::string& text)
{
  emitter << YAML::Key << key << YAML::Value << text;
}

void emit(YAML::Emitter& emitter, const char* key, const Eigen::Vector3d& vector)
{
  emitter << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double element : vector)
  {
    emitter << format_number(element);
  }
  emitter << YAML::EndSeq;
}

void emit(YAML::Emitter& emitter, const char* key, const PartCalls& calls)
{
  emitter << YAML::Key << key << YAML::Value << YAML::BeginMap;
  for (std::size_t part = 0; part < number_of_parts; ++part)
  {
    emit(emitter, name_of(static_cast<Part>(part)), calls.counts[part]);
  }
  emitter << YAML::EndMap;
}

}  // namespace

void write_csv_header(std::ostream& stream)
{
  stream << "time,node,x,y,z,vx,vy,vz\n";
}

void write_csv_sample(std::ostream& stream, const ClothState& state)
{
  char line[256];
  const Vectors& x = state.positions;
  const Vectors& v = state.velocities;
  for (int i = 0; i < x.rows(); ++i)
  {
    const int length = std::snprintf(line, sizeof line, "%.16e,%d,%.16e,%.16e,%.16e,%.16e,%.16e,%.16e\n", state.time, i,
                                     x(i, 0), x(i, 1), x(i, 2), v(i, 0), v(i, 1), v(i, 2));
    stream.write(line, length);
  }
}

void write_summary(std::ostream& stream, const Simulation& simulation, double wall_time,
                   const std::vector<std::string>& plan, const Choice& choice)
{
  const ClothState& state = simulation.state();
  const Simulation::Counters& counters = simulation.counters();
  const Energies energies = energies_of(simulation.dynamics(), state);
  YAML::Emitter emitter;
  emitter << YAML::BeginMap;
  emit(emitter, "status", std::string(simulation.divergence() ? "diverged" : "ok"));
  emit(emitter, "simulated_time", state.time);
  emit(emitter, "wall_time", wall_time);
  emit(emitter, "real_time_factor", wall_time > 0.0 ? state.time / wall_time : 0.0);
  emit(emitter, "steps", counters.steps);
  emit(emitter, "force_evaluations", counters.force_evaluations);
  emit(emitter, "linear_solves", counters.linear_solves);
  emit(emitter, "linear_iterations", counters.linear_iterations);
  emit(emitter, "rejected_steps", counters.rejected_steps);
  emit(emitter, "unconverged_steps", counters.unconverged_steps);
  emit(emitter, "limit_sweeps", counters.limit_sweeps);
  emit(emitter, "calls", counters.calls);
  if (simulation.asleep_since())
  {
    emit(emitter, "asleep_since", *simulation.asleep_since());
  }
  emit(emitter, "method", std::string(simulation.method().name));
  emit(emitter, "time_step", simulation.time_step());
  emit(emitter, "stability_limit", simulation.stability_limit());
  emit(emitter, "kinetic_energy", energies.kinetic);
  emit(emitter, "elastic_energy", energies.elastic);
  emit(emitter, "gravitational_energy", energies.gravitational);
  emit(emitter, "max_strain", max_strain(simulation.model(), state.positions));
  emit(emitter, "momentum", momentum_of(simulation.model(), state));
  emit(emitter, "angular_momentum", angular_momentum_of(simulation.model(), state));
  emitter << YAML::Key << "plan" << YAML::Value << plan;
  emitter << YAML::Key << "choice" << YAML::Value;
  write_choice(emitter, choice);
  emitter << YAML::EndMap;
  stream << emitter.c_str() << "\n";
}

}  // namespace cloth
