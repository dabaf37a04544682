#include "step_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_sim/scene/yaml_text.h"

#include "part_trials.h"

namespace cloth
{
namespace
{

/// A dearer method is not worth a change.
constexpr double level = 0.9;
/// The part of real time that steps may take: a node makes and publishes messages besides.
constexpr double real_time_share = 0.75;
/// A trial is made where it may save more than it takes in a run so long, s.
constexpr double expected_run = 10.0;
/// What trials may take while nothing is found, in parts of such a run by the scout, or at what real time allows.
constexpr double most_trials = 0.2;
/// And then by the scout alone, s, and until something comes near in real time.
constexpr double most_seconds = 3.0;
constexpr double most_seconds_of_an_approach = 2.0;
/// Once trials have taken so long, s, one more has to promise to save so many times what it takes.
constexpr double quick_search = 0.5;
constexpr double saving_of_late_trials = 4.0;
constexpr double long_search = 1.0;
constexpr double saving_of_last_trials = 8.0;

/// What comes nearest in real time is made longer only where it errs by hardly more, by this factor at most.
constexpr double hardly_more = 1.05;

/// The first samples are enough to compare a sheet's errors with those of a coarser one, unless they are larger than
/// this part of what they may be.
constexpr double critical_share = 0.1;

/// How many steps are tried to come between this part of what is allowed and all of it; how errors may grow with the
/// step, and by what factor it may change at a time.
constexpr int most_fits = 6;
constexpr double cheap_fit = 0.1;  // s of work, whatever trials have taken
constexpr double fit = 0.85;
constexpr double least_slope = 0.4;
constexpr double most_slope = 3.0;
constexpr double most_change = 4.0;
/// By what factor the sheet itself may allow longer steps.
constexpr double most_lengthening = 10.0;

/// A motion that errs by more than this part of how far the nodes move is of no use, and one that is slower than real
/// time is better where it errs by so many times less.
constexpr double useless_share = 0.25;
constexpr double worth_waiting_for = 10.0;

/// How much longer than the sheet's cells may be which still fold as it does.
constexpr double cells_that_fold = 2.0;

std::string in_words(const Candidate& candidate)
{
  const std::string steps = candidate.row->is_adaptive ?
                                "at a tolerance of " + in_two_digits(candidate.stepping.tolerance) + " m a step" :
                                "at steps of " + in_two_digits(candidate.time_step) + " s";
  return std::string(candidate.row->name) + " " + steps + " errs by " + in_two_digits(candidate.error) + " m over " +
         format_number(Motion::horizon) + " s for " + in_two_digits(candidate.cost) + " s of work a second";
}

bool is_cheaper(const Candidate& one, const Candidate& other)
{
  return one.cost < other.cost;
}

}  // namespace

std::string in_two_digits(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

StepSearch::StepSearch(const StartedScene& scene, Trials& trials, const Allowance& allowed, StepCosts& costs)
  : searched_{ scene, allowed, trials, costs }
{
  for (const MethodRow& row : methods())
  {
    if (std::unique_ptr<MethodSearch> search = search_of(row, searched_))
    {
      scout_of_trials_ = &row == &trials.scout() ? search.get() : scout_of_trials_;
      scout_of_second_order_ = &row == &Trials::scout_of_second_order() ? search.get() : scout_of_second_order_;
      searches_.push_back(std::move(search));
    }
  }
  scout_ = scout_of_trials_;
}

void StepSearch::run()
{
  find_more();
  while (!is_cheapest_checked())
  {
    check_cheapest();
    find_more();
  }
  choose();
}

void StepSearch::find_more()
{
  while (MethodSearch* const search = next_search())
  {
    search->try_next(search == scout_ ? MethodErrors::Reference{} : reference_for(*search));
    if (const std::optional<Candidate> candidate = search->found())
    {
      found_.push_back(is_fitted_at_once(*candidate) ? fitted_on_the_sheet(*candidate).value_or(*candidate) :
                                                       *candidate);
      found_.back().is_checked = found_.back().is_checked || !searched_.trials.is_coarser();
      std::stable_sort(found_.begin(), found_.end(), is_cheaper);
    }
    // Where errors of first order do not fall, those of second order still may.
    const bool is_at_its_floor = scout_ != nullptr && scout_->is_at_its_floor();
    scout_ = is_at_its_floor && scout_of_second_order_ != nullptr ? scout_of_second_order_ : scout_;
  }
}

/// None: nothing more can come of any, or what may come is not worth the trials.
MethodSearch* StepSearch::next_search() const
{
  const bool is_scout_known = scout_ != nullptr && scout_->reference().motion != nullptr;
  if (scout_ != nullptr && !is_scout_known && !scout_->is_over() && can_afford_scouts(searched_.trials))
  {
    return scout_;
  }
  if (!found_.empty() || !is_scout_known)
  {
    return most_promising();
  }
  if (scout_->is_at_its_floor())
  {
    return nullptr;
  }
  const bool has_time = searched_.trials.seconds() + scout_->trial_cost() < long_search;
  if (!scout_->knows_its_floor() && !scout_->is_over() && has_time)
  {
    return scout_;
  }
  if (searched_.trials.seconds() < most_trials * expected_run * std::min(scout_->least_cost(), real_time_share))
  {
    return most_promising();
  }
  // It goes on alone as far as real time allows, to say what can be had.
  const bool goes_on = !scout_->is_over() && scout_->next_cost() <= real_time_share &&
                       searched_.trials.seconds() + scout_->trial_cost() < most_seconds;
  return goes_on ? scout_ : nullptr;
}

/// The one that may lead to the cheapest steps. Explicit methods that promise more than the scout are held against it,
/// so it goes first.
MethodSearch* StepSearch::most_promising() const
{
  MethodSearch* best = nullptr;
  for (const std::unique_ptr<MethodSearch>& search : searches_)
  {
    if (is_worth_a_trial(*search) && (best == nullptr || search->least_cost() < best->least_cost()))
    {
      best = search.get();
    }
  }
  const bool is_scout_new = scout_ != nullptr && scout_->reference().motion == nullptr;
  const bool is_near_the_scout = best != nullptr && is_scout_new && best->trial_cost() > 0.3 * scout_->trial_cost();
  return is_near_the_scout && is_worth_a_trial(*scout_) ? scout_ : best;
}

MethodErrors::Reference StepSearch::most_exact_but(const MethodSearch& asking) const
{
  MethodErrors::Reference best;
  for (const std::unique_ptr<MethodSearch>& search : searches_)
  {
    if (search.get() != &asking && (search.get() == scout_ || search->found()))
    {
      const MethodErrors::Reference reference = search->reference();
      best = reference.error < best.error ? reference : best;
    }
  }
  return best;
}

MethodErrors::Reference StepSearch::reference_for(const MethodSearch& asking) const
{
  const MethodErrors::Reference best = most_exact_but(asking);
  const double allowed = searched_.trials.is_coarser() ? searched_.allowed.estimated : searched_.allowed.measured;
  return best.error < reference_share * allowed ? best : MethodErrors::Reference{};
}

bool StepSearch::is_worth_a_trial(const MethodSearch& search) const
{
  const bool needs_reference = search.is_at_its_floor();
  const bool has_reference = &search != scout_ && reference_for(search).motion != nullptr;
  if (search.is_over() || (needs_reference && !has_reference))
  {
    return false;
  }
  if (found_.empty())
  {
    return true;
  }
  const double best = found_.front().cost;
  return search.least_cost() < level * best && is_worth(search.trial_cost(), best - search.least_cost());
}

/// Whether to find out for so many seconds pays where it may save so much for each simulated second.
bool StepSearch::is_worth(double seconds, double saved_cost) const
{
  const double together = searched_.trials.seconds() + seconds;
  const double times = together < quick_search ? 1.0 :
                       together < long_search  ? saving_of_late_trials :
                                                 saving_of_last_trials;
  return seconds < expected_run * saved_cost / times;
}

/// What takes longer than real time allows is checked only where nothing else is of use.
bool StepSearch::is_cheapest_checked() const
{
  return found_.empty() || found_.front().is_checked || found_.front().cost > real_time_share;
}

/// What is the cheapest may be another then, or one that is worth a trial only now. Where something else is checked
/// already, a check over the whole second has to pay.
void StepSearch::check_cheapest()
{
  const Candidate candidate = found_.front();
  const auto next = std::find_if(found_.begin(), found_.end(), [](const Candidate& other) { return other.is_checked; });
  const bool pays =
      next == found_.end() ||
      is_worth(searched_.trials.seconds_of_a_check(steps_of_a_check(candidate).on_scene), next->cost - candidate.cost);
  const std::optional<Candidate> fitted =
      may_be_fitted(candidate) ? fitted_on_the_sheet(candidate) : std::optional<Candidate>();
  found_.front() = fitted ? *fitted : made_exact_enough(pays ? checked(candidate) : checked_early(candidate));
  std::stable_sort(found_.begin(), found_.end(), is_cheaper);
}

/// What passes that work locally leave undone on a coarser grid says little of the sheet itself.
bool StepSearch::is_fitted_at_once(const Candidate& candidate) const
{
  return candidate.row->iterates_locally && may_be_fitted(candidate) &&
         (found_.empty() || candidate.cost < most_lengthening * found_.front().cost);
}

/// The scout's longest steps are exact enough to hold others against, and cheap.
bool StepSearch::may_be_fitted(const Candidate& candidate) const
{
  return !candidate.row->is_adaptive && candidate.row != &searched_.trials.scout() &&
         searched_.trials.can_afford_the_scout_on_the_sheet() &&
         error_of_scout_on_the_sheet() < reference_share * searched_.allowed.measured;
}

/// Of its longest steps, m.
double StepSearch::error_of_scout_on_the_sheet() const
{
  return factor_.value_or(1.0) * scout_of_trials_->error_of_longest();
}

/// With steps that err there by what is allowed, as the line through the last two errors has it. None: they do not come
/// to it, or cost more by then than something else.
std::optional<Candidate> StepSearch::fitted_on_the_sheet(Candidate candidate) const
{
  const double allowed = searched_.allowed.measured;
  const bool as_limited = candidate.stepping.time_step == 0.0;
  std::optional<Candidate> best;
  candidate.is_checked = true;
  double error_before = 0.0;
  double step_before = 0.0;
  const auto other =
      std::find_if(found_.begin(), found_.end(), [&](const Candidate& found) { return found.row != candidate.row; });
  const double most_cost = other == found_.end() ? std::numeric_limits<double>::infinity() : other->cost;
  const auto pays = [&] {
    const double seconds = candidate.cost * Motion::horizon;
    return candidate.cost < most_cost && (seconds < cheap_fit || searched_.trials.seconds() + seconds < long_search);
  };
  for (int run = 0; run == 0 || (run < most_fits && pays()); ++run)
  {
    const bool is_longest = candidate.time_step >= candidate.longest_of_all;
    candidate.stepping.time_step = candidate.time_step;
    candidate.error =
        std::hypot(searched_.trials.error_on_the_sheet(candidate.stepping), error_of_scout_on_the_sheet());
    candidate.stepping.time_step = as_limited && is_longest ? 0.0 : candidate.time_step;
    const bool is_exact_enough = candidate.error <= allowed;
    if (is_exact_enough && (!best || candidate.time_step > best->time_step))
    {
      best = candidate;
    }
    if (!std::isfinite(candidate.error) || (is_exact_enough && (is_longest || candidate.error > fit * allowed)))
    {
      break;
    }
    const double slope = run == 0 ?
                             candidate.row->order :
                             std::log(candidate.error / error_before) / std::log(candidate.time_step / step_before);
    error_before = candidate.error;
    step_before = candidate.time_step;
    const double aim = 0.5 * (1.0 + fit) * allowed;
    const double factor = std::pow(aim / candidate.error, 1.0 / std::clamp(slope, least_slope, most_slope));
    const double step =
        std::min(candidate.time_step * std::clamp(factor, 1.0 / most_change, most_change), candidate.longest_of_all);
    candidate.cost *= candidate.time_step / step;
    candidate.time_step = step;
  }
  return best;
}

/// The sheet itself has more modes to be wrong about than the coarser one of the trials, and what differs there may
/// come late: the whole second tells where that is cheap, or where the error may come near to what is allowed and there
/// is time for it.
Candidate StepSearch::checked(const Candidate& candidate)
{
  const double allowed = searched_.allowed.estimated;
  const auto is_critical = [&](double error) { return candidate.error <= allowed && error > critical_share * allowed; };
  const bool tells_all =
      is_critical(candidate.error) || searched_.trials.can_afford_a_whole_check(steps_of_a_check(candidate).on_scene);
  std::optional<Candidate> whole = tells_all ? checked_over_the_second(candidate) : std::nullopt;
  if (whole)
  {
    return *whole;
  }
  const Candidate early = checked_early(candidate);
  whole = !tells_all && is_critical(early.error) ? checked_over_the_second(candidate) : std::nullopt;
  return whole.value_or(early);
}

/// The sheet itself tells something of these steps, and there is time to ask it.
bool StepSearch::may_be_checked(const Candidate& candidate) const
{
  return searched_.trials.is_coarser() && !candidate.row->is_adaptive &&
         (!factor_ || searched_.trials.seconds() < long_search);
}

/// Shorter steps are compared with the candidate's own, or with longer ones where the method may take them: that takes
/// less time.
Probe StepSearch::steps_of_a_check(const Candidate& candidate) const
{
  const double longer = shorter_in_a_check * candidate.time_step;
  Probe probe{ candidate.stepping, candidate.stepping };
  probe.on_scene.time_step = longer <= candidate.longest_of_all ? longer : candidate.time_step;
  probe.on_trials.time_step = probe.on_scene.time_step * candidate.stretch;
  return probe;
}

/// By the factor of the check before where trials have taken long already.
Candidate StepSearch::checked_early(Candidate candidate)
{
  candidate.is_checked = true;
  if (may_be_checked(candidate))
  {
    const Probe probe = steps_of_a_check(candidate);
    factor_ = searched_.trials.early_factor(probe.on_scene, probe.on_trials).value_or(untried_allowance);
  }
  const bool is_of_a_coarser_one = searched_.trials.is_coarser() && !candidate.row->is_adaptive;
  candidate.error *= is_of_a_coarser_one ? *factor_ : 1.0;
  return candidate;
}

/// What shorter steps change tells the error: by the order, or of passes that work locally, whose errors fall slower
/// than that, as on the coarser grid. None: that takes too long.
std::optional<Candidate> StepSearch::checked_over_the_second(Candidate candidate)
{
  const Probe probe = steps_of_a_check(candidate);
  const std::optional<double> difference =
      may_be_checked(candidate) ? searched_.trials.difference_on_the_sheet(probe.on_scene) : std::nullopt;
  if (!difference)
  {
    return std::nullopt;
  }
  const double gain = std::pow(shorter_in_a_check, order_of(candidate));
  const double of_shorter = *difference / (gain - 1.0);
  const double error = candidate.row->iterates_locally ?
                           candidate.error * *difference / searched_.trials.difference_on_trials(probe.on_trials) :
                       probe.on_scene.time_step > candidate.time_step ? of_shorter :
                                                                        gain * of_shorter;
  const double factor = error / std::max(candidate.error, std::numeric_limits<double>::min());
  factor_ = std::isfinite(factor) ? std::clamp(factor, 1.0, most_allowance) : most_allowance;
  candidate.error = std::isfinite(error) ? std::max(candidate.error, error) : most_allowance * candidate.error;
  candidate.is_checked = true;
  return candidate;
}

/// Of what was exact enough until it was checked.
Candidate StepSearch::made_exact_enough(Candidate candidate) const
{
  const double allowed = searched_.allowed.estimated;
  if (candidate.error > allowed)
  {
    const double shorter = std::pow(allowed / candidate.error, 1.0 / order_of(candidate));
    candidate.time_step *= shorter;
    candidate.stepping.time_step = candidate.time_step;
    candidate.cost /= shorter;
    candidate.error = allowed;
  }
  return candidate;
}

/// A strain limit acts after a step, whatever the method: errors fall as the steps do, at best.
int StepSearch::order_of(const Candidate& candidate) const
{
  return searched_.scene.params.strain_limit.max_strain > 0.0 ? 1 : candidate.row->order;
}

void StepSearch::choose()
{
  const bool is_found = !found_.empty();
  if (is_found && found_.front().cost <= real_time_share)
  {
    best_ = found_.front();
    return;
  }
  dearer_ = is_found ? in_words(found_.front()) : "";
  best_ = parts_from_itself() ? parted(scout_->nearest(real_time_share, level_errors)) :
          is_found            ? lengthened() :
                                std::nullopt;
  best_ = best_ ? best_ : nearest_in_real_time();
  best_ = best_ && !best_->is_checked ? checked_early(*best_) : best_;
  if (best_ && !is_useless(*best_))
  {
    return;
  }
  std::optional<Candidate> slower = is_found ? found_.front() :
                                    scout_ != nullptr ?
                                               scout_->nearest(std::numeric_limits<double>::infinity(), level_errors) :
                                               std::nullopt;
  slower = parts_from_itself() ? parted(slower) : slower;
  if (slower && (!best_ || worth_waiting_for * slower->error < best_->error))
  {
    in_real_time_ = best_ ? in_words(*best_) : "";
    best_ = slower->is_checked ? *slower : checked_early(*slower);
  }
}

/// By how much a motion parts from itself half of its cells tell as well as all; fewer fold less.
std::optional<Candidate> StepSearch::parted(std::optional<Candidate> candidate) const
{
  if (candidate)
  {
    candidate->error *= std::max(1.0, searched_.trials.coarseness() / cells_that_fold);
    candidate->is_checked = true;
  }
  return candidate;
}

/// The cheapest that was found, as exact as real time allows. None: not even its longest steps are affordable.
std::optional<Candidate> StepSearch::lengthened() const
{
  Candidate candidate = found_.front();
  const double longer = candidate.cost / real_time_share;
  candidate.time_step *= longer;
  candidate.stepping.time_step = candidate.time_step;
  candidate.cost /= longer;
  candidate.error *= std::pow(longer, order_of(candidate));
  const bool is_tried = !candidate.row->is_adaptive && candidate.time_step <= candidate.longest;
  return is_tried ? std::optional<Candidate>(candidate) : std::nullopt;
}

bool StepSearch::parts_from_itself() const
{
  return scout_ != nullptr && scout_->is_at_its_floor();
}

bool StepSearch::is_useless(const Candidate& candidate) const
{
  const MethodErrors::Reference reference = scout_ != nullptr ? scout_->reference() : MethodErrors::Reference{};
  return reference.motion != nullptr && candidate.error > useless_share * searched_.trials.travel(*reference.motion);
}

std::optional<Candidate> StepSearch::nearest_in_real_time()
{
  approach_in_real_time();
  std::vector<Candidate> candidates;
  for (const std::unique_ptr<MethodSearch>& search : searches_)
  {
    if (const std::optional<Candidate> candidate = search->nearest(real_time_share, hardly_more))
    {
      candidates.push_back(*candidate);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& candidate : candidates)
  {
    least = std::min(least, candidate.error);
  }
  std::stable_sort(candidates.begin(), candidates.end(), is_cheaper);
  const auto nearest = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    return candidate.error <= level_errors * least;
  });
  return nearest == candidates.end() ? std::nullopt : std::optional<Candidate>(*nearest);
}

/// Long steps may all err alike, and differ little from each other: against the most exact motion that is known,
/// however far it parts from itself, they do. Steps are tried until the last one is not affordable, or of such a motion
/// as long as they are.
void StepSearch::approach_in_real_time() const
{
  const double most_cost = parts_from_itself() ? real_time_share : 2.0 * real_time_share;
  for (const std::unique_ptr<MethodSearch>& search : searches_)
  {
    const MethodErrors::Reference reference = most_exact_but(*search);
    if (search.get() == scout_ || reference.motion == nullptr)
    {
      continue;
    }
    search->hold_against(reference);
    while (!search->is_over() && search->next_cost() <= most_cost &&
           searched_.trials.seconds() + search->trial_cost() < most_seconds_of_an_approach)
    {
      search->try_next(reference);
    }
  }
}

std::string StepSearch::reason(double tolerance) const
{
  std::string words = in_words(*best_);
  words += best_->cost > 1.0 ? ", slower than real time" : "";
  words += in_real_time_.empty() ? "" : "; in real time there is nothing of use: " + in_real_time_;
  if (best_->error > tolerance)
  {
    words += "; the tolerance of " + format_number(tolerance) + " m cannot be had";
    if (parts_from_itself())
    {
      return words + ", since the motion parts from itself: shorter steps bring it nearer to nothing";
    }
    return words + (dearer_.empty() ? "" : " in real time: " + dearer_);
  }
  const bool is_next = found_.size() > 1 && found_.front().row == best_->row;
  return words + (is_next ? "; next: " + in_words(found_[1]) : "");
}

}  // namespace cloth
