#include "part_trials.h"

#include <algorithm>

namespace cloth
{
namespace
{

/// Of the tolerance: what a part may change the answer by, and all that is left out together.
constexpr double share_of_a_part = 0.25;
constexpr double share_of_all = 0.5;
/// What trials of parts may take, s of work.
constexpr double most_seconds_with_scouts = 1.0;

class PartTrials
{
public:
  PartTrials(Trials& trials, const Probe& probe)
    : trials_(trials), probe_(probe), tolerance_(trials.scene().params.solver.tolerance)
  {
  }

  std::vector<TriedPart> tried_alone()
  {
    std::vector<TriedPart> tried;
    for (const ModelPart& part : optional_parts())
    {
      if (part.is_there(trials_.scene().params))
      {
        tried.push_back({ part.name, change({}, { part.name }) });
      }
    }
    std::stable_sort(tried.begin(), tried.end(),
                     [](const TriedPart& one, const TriedPart& other) { return one.change < other.change; });
    return tried;
  }

  LeftOut left_out(std::vector<TriedPart>& tried)
  {
    LeftOut left_out;
    for (TriedPart& part : tried)
    {
      const bool is_first = left_out.parts.empty();
      if (part.change >= (is_first ? share_of_a_part : share_of_all) * tolerance_)
      {
        break;
      }
      PartList parts = left_out.parts;
      parts.push_back(part.part);
      const double together = is_first ? part.change : change({}, parts);
      part.change = is_first ? part.change : change(left_out.parts, parts);
      if (part.change < share_of_a_part * tolerance_ && together < share_of_all * tolerance_)
      {
        left_out = { parts, together };
      }
    }
    return left_out;
  }

private:
  /// Of the answer where `more` is left out instead of `parts`, m; or at least, where that is more than all that is
  /// left out may change it by. Where a coarser grid is not believed, the sheet itself tells.
  double change(const PartList& parts, const PartList& more)
  {
    const double enough = share_of_all * tolerance_;
    const Belief belief = belief_in_a_coarser_grid(more);
    const double much = belief.more * share_of_a_part * tolerance_;
    const double little = belief.less * share_of_a_part * tolerance_;
    const double on_trials =
        trials_.change(parts, more, probe_.on_trials, trials_.is_coarser() ? std::max(enough, much) : enough);
    const bool is_clear = on_trials < little || on_trials >= much;
    return is_clear ? on_trials : trials_.change_on_the_sheet(parts, more, probe_, on_trials, enough);
  }

  Trials& trials_;
  const Probe& probe_;
  double tolerance_;
};

}  // namespace

LeftOut parts_to_leave_out(Trials& trials, const Probe& probe, bool allows_any, std::vector<TriedPart>& tried)
{
  PartTrials part_trials(trials, probe);
  tried = part_trials.tried_alone();
  return allows_any ? part_trials.left_out(tried) : LeftOut();
}

bool can_afford_scouts(const Trials& trials)
{
  const double runs = 1.0 + static_cast<double>(optional_parts().size());
  const Stepping longest = trials.longest_of_scout();
  return runs * trials.seconds_of_a_run(longest.time_step, 1.0) < most_seconds_with_scouts;
}

Probe scouts(const Trials& trials)
{
  return { trials.longest_of_scout(), trials.longest_of_scout_on_the_sheet() };
}

}  // namespace cloth
