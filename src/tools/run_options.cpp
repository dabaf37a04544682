#include "run_options.h"

#include <cmath>
#include <limits>

#include <getopt.h>
#include <yaml-cpp/yaml.h>

namespace cloth
{

const char* const run_usage =
    R"(usage: cloth_run SCENE.yaml [options]

  --duration SECONDS   simulated time; 5
  --every SECONDS      time between two samples; 0.0333
  --set KEY=VALUE      sets a key of the scene, as in solver.time_step=1e-3; may be repeated
  --output FILE.csv    every node's position and velocity at time 0, at each sample and at the end
  --summary FILE.yaml  what the run cost and how it ended
  --plan               prints what is modelled and why, and which coarser grid would do, and does not run
  --plan-from FILE     takes the plan of an earlier run from its summary: nothing is tried, and the run is the same again
  --help               prints this

Exit status: 0 done, 1 the simulation diverged, 2 bad scene or usage.
)";

namespace
{

double parse_seconds(const char* option, const char* text, bool zero_allowed)
{
  double seconds = 0.0;
  const bool is_number = YAML::convert<double>::decode(YAML::Node(text), seconds) && std::isfinite(seconds);
  if (!is_number || seconds < 0.0 || (seconds == 0.0 && !zero_allowed))
  {
    throw UsageError(std::string("--") + option + " is " + text + "; allowed: a number of seconds " +
                     (zero_allowed ? ">= 0" : "> 0"));
  }
  return seconds;
}

std::pair<std::string, std::string> parse_setting(const std::string& text)
{
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
  {
    throw UsageError("--set is " + text + "; allowed: KEY=VALUE");
  }
  return { text.substr(0, equals), text.substr(equals + 1) };
}

}  // namespace

RunOptions parse_run_options(int argc, char** argv)
{
  static const option known[] = {
    { "duration", required_argument, nullptr, 'd' },
    { "every", required_argument, nullptr, 'e' },
    { "set", required_argument, nullptr, 's' },
    { "output", required_argument, nullptr, 'o' },
    { "summary", required_argument, nullptr, 'y' },
    { "plan", no_argument, nullptr, 'p' },
    { "plan-from", required_argument, nullptr, 'f' },
    { "help", no_argument, nullptr, 'h' },
    { nullptr, 0, nullptr, 0 },
  };
  RunOptions options;
  opterr = 0;
  optind = 0;
  for (int letter = 0; (letter = getopt_long_only(argc, argv, ":h", known, nullptr)) != -1;)
  {
    switch (letter)
    {
      case 'd':
        options.duration = parse_seconds("duration", optarg, true);
        break;
      case 'e':
        options.every = parse_seconds("every", optarg, false);
        break;
      case 's':
        options.settings.push_back(parse_setting(optarg));
        break;
      case 'o':
        options.output_file = optarg;
        break;
      case 'y':
        options.summary_file = optarg;
        break;
      case 'f':
        options.plan_file = optarg;
        break;
      case 'p':
        options.plan_only = true;
        break;
      case 'h':
        options.help = true;
        break;
      case ':':
        throw UsageError(std::string(argv[optind - 1]) + " needs a value");
      default:
        throw UsageError(std::string(argv[optind - 1]) + " is not an option");
    }
  }
  if (!options.help && optind + 1 != argc)
  {
    throw UsageError("one scene file is needed, " + std::to_string(argc - optind) + " were given");
  }
  if (!options.output_file.empty() && options.output_file == options.summary_file)
  {
    throw UsageError("--output and --summary are both " + options.output_file + "; allowed: two files");
  }
  options.scene_file = optind < argc ? argv[optind] : "";
  return options;
}

}  // namespace cloth
