#include "matrix_options.h"

#include <charconv>
#include <cstring>

#include <getopt.h>

namespace cloth
{
namespace
{

template <typename Whole>
Whole whole_number(const char* option, const char* text, Whole low, Whole high)
{
  Whole number{};
  const char* const end = text + std::strlen(text);
  const auto [stopped, error] = std::from_chars(text, end, number);
  if (error != std::errc() || stopped != end || number < low || number > high)
  {
    throw MatrixUsageError(std::string(option) + " is " + text + "; allowed: a whole number from " +
                           std::to_string(low) + " to " + std::to_string(high));
  }
  return number;
}

std::vector<Half> halves_of(const std::string& text)
{
  if (text == "both")
  {
    return { Half::development, Half::held_out };
  }
  for (const Half half : { Half::development, Half::held_out })
  {
    if (text == name_of(half))
    {
      return { half };
    }
  }
  throw MatrixUsageError("--half is " + text + "; allowed: development, held_out, both");
}

void choose_work(const std::string& text, MatrixOptions& options)
{
  if (text != "search" && text != "plans")
  {
    throw MatrixUsageError("--only is " + text + "; allowed: search, plans");
  }
  options.searches = text == "search";
  options.plans = text == "plans";
}

void make_quick(MatrixOptions& options)
{
  options.settings.scenes = 6;
  options.settings.most_per_side = 12;
  options.settings.most_node_steps = 5e5;
}

}  // namespace

const char* const matrix_usage =
    R"(usage: plan_matrix [options]

Draws scenes at random, finds for each the cheapest method and step by an exhaustive search, has the planner plan it at
three tolerances, and holds the plans against what was found. It runs on one core; the halves may run at the same time.

  --out DIR        where everything goes; plan_matrix. What is there already is not done again
  --scenes N       how many; 60
  --seed S         which are held out; 7
  --most-nodes N   a side of a sheet, from 8; 96
  --half HALF      development (even numbers), held_out (odd ones), both
  --only WORK      search: no plans; plans: those of scenes that have been searched
  --no-parts       does not weigh the parts that are left out and kept
  --quick          6 small scenes
  --help           prints this

Exit status: 0 done, 1 no scene could be planned, 2 bad usage or folder.
)";

MatrixOptions parse_matrix_options(int argc, char** argv)
{
  static const option known[] = {
    { "out", required_argument, nullptr, 'o' },  { "scenes", required_argument, nullptr, 'n' },
    { "seed", required_argument, nullptr, 's' }, { "most-nodes", required_argument, nullptr, 'm' },
    { "half", required_argument, nullptr, 'h' }, { "only", required_argument, nullptr, 'w' },
    { "no-parts", no_argument, nullptr, 'p' },   { "quick", no_argument, nullptr, 'q' },
    { "help", no_argument, nullptr, 'i' },       { nullptr, 0, nullptr, 0 },
  };
  MatrixOptions options;
  opterr = 0;
  optind = 0;
  for (int letter = 0; (letter = getopt_long(argc, argv, ":", known, nullptr)) != -1;)
  {
    switch (letter)
    {
      case 'o':
        options.folder = optarg;
        break;
      case 'n':
        options.settings.scenes = whole_number("--scenes", optarg, 1, 1000);
        break;
      case 's':
        options.settings.held_out_seed = whole_number<std::uint64_t>("--seed", optarg, 0, 1000000000);
        break;
      case 'm':
        options.settings.most_per_side = whole_number("--most-nodes", optarg, 8, 256);
        break;
      case 'h':
        options.halves = halves_of(optarg);
        break;
      case 'w':
        choose_work(optarg, options);
        break;
      case 'p':
        options.trial.weighs_parts = false;
        break;
      case 'q':
        make_quick(options);
        break;
      case 'i':
        options.help = true;
        break;
      case ':':
        throw MatrixUsageError(std::string(argv[optind - 1]) + " needs a value");
      default:
        throw MatrixUsageError(std::string(argv[optind - 1]) + " is not an option");
    }
  }
  if (optind < argc)
  {
    throw MatrixUsageError(std::string(argv[optind]) + " is not an option");
  }
  if (options.folder.empty())
  {
    throw MatrixUsageError("--out is empty; allowed: a folder");
  }
  return options;
}

}  // namespace cloth
