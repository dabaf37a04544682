#include "bench_options.h"

#include <getopt.h>

namespace cloth
{

const char* const bench_usage =
    R"(usage: cloth_bench [SCENE.yaml ...] [options]

Runs each scene by every method over a ladder of settings, and by other solvers on the same equations, and charts what
accuracy costs. Without scenes: those that come with the program. It runs on one core; leave the machine alone meanwhile.

  --out DIR      where everything goes: runs.csv, scenes.csv, charts; cloth_bench. What is there already is not run again
  --quick        in under two minutes: coarser, and of the program's own scenes the small ones
  --no-charts    tables only
  --help         prints this

Exit status: 0 done, 1 no scene has a reference that can be trusted, 2 bad scene or usage.
)";

BenchOptions parse_bench_options(int argc, char** argv)
{
  static const option known[] = {
    { "out", required_argument, nullptr, 'o' },
    { "quick", no_argument, nullptr, 'q' },
    { "no-charts", no_argument, nullptr, 'n' },
    { "help", no_argument, nullptr, 'h' },
    { nullptr, 0, nullptr, 0 },
  };
  BenchOptions options;
  opterr = 0;
  optind = 0;
  for (int letter = 0; (letter = getopt_long(argc, argv, ":h", known, nullptr)) != -1;)
  {
    switch (letter)
    {
      case 'o':
        options.folder = optarg;
        break;
      case 'q':
        options.quick = true;
        break;
      case 'n':
        options.charts = false;
        break;
      case 'h':
        options.help = true;
        break;
      case ':':
        throw BenchUsageError(std::string(argv[optind - 1]) + " needs a value");
      default:
        throw BenchUsageError(std::string(argv[optind - 1]) + " is not an option");
    }
  }
  if (options.folder.empty())
  {
    throw BenchUsageError("--out is empty; allowed: a folder");
  }
  options.scene_files.assign(argv + optind, argv + argc);
  return options;
}

}  // namespace cloth
