#include "method_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cloth
{
namespace
{

/// The longest step of a method that is stable at any, s, on the scene itself and in a trial.
constexpr double longest_step = 1.0 / 30.0;
constexpr double longest_trial_step = 1.0 / 16.0;
constexpr size_t most_runs = 10;
/// Errors that neither fall as the order says nor stay as they are by then need other trials to make sense of.
constexpr size_t enough_runs = 4;
constexpr size_t enough_runs_of_chaos = 6;
/// A step is believed to be as exact as the line through the errors says down to this part of the shortest one tried.
constexpr double least_of_finest = 0.5;
/// What a step that solves equations takes at least, in evaluations of the forces.
constexpr double evaluations_of_a_solve = 300.0;
/// And in parts of what it took in another method's longest steps.
constexpr double share_of_another_solve = 0.5;
/// What a trial may take that only makes an estimate better, s of work.
constexpr double cheap_trial = 0.1;
/// By how much errors of long steps that damp what they should not fall faster than the order says.
constexpr double order_of_lost_damping = 1.5;

/// A method whose steps are all as long as it is told.
class StepLengthSearch : public MethodSearch
{
public:
  StepLengthSearch(const MethodRow& row, const SearchedScene& searched)
    : row_(row)
    , searched_(searched)
    , is_limited_(std::isfinite(likely_limit(row, searched.trials.spectrum_of_the_sheet())))
  {
    take_limits(likely_limit(row, searched.trials.spectrum_of_the_sheet()), searched.trials.likely_limit(row));
  }

  bool is_over() const override
  {
    return is_over_;
  }

  double least_cost() const override
  {
    if (!errors_ || !errors_->is_known())
    {
      return longest_ >= Simulation::shortest_step ? cost_of(longest_) : std::numeric_limits<double>::infinity();
    }
    const double error = errors_->error_of_finest();
    const double steepest = row_.iterates_locally ? row_.order + order_of_lost_damping : row_.order;
    const double falls_best = std::isfinite(error) ? std::pow(allowed() / error, 1.0 / steepest) : 0.5;
    return cost_of(std::min(longest_, errors_->finest_step() / stretch() * std::min(1.0, falls_best)));
  }

  double next_cost() const override
  {
    return cost_of(errors_ ? std::min(longest_, 0.5 * errors_->finest_step() / stretch()) : longest_);
  }

  double trial_cost() const override
  {
    return searched_.trials.seconds_of_a_run(errors_ ? 0.5 * errors_->finest_step() : longest_on_trials_,
                                             evaluations_a_step());
  }

  void try_next(const MethodErrors::Reference& reference) override
  {
    if (!errors_)
    {
      take_limits(network_stability_limit(row_, searched_.trials.spectrum_of_the_sheet()),
                  searched_.trials.limit(row_));
      if (!(longest_ >= Simulation::shortest_step))
      {
        is_over_ = true;
        return;
      }
      errors_.emplace(searched_.trials, row_.order, stepping_of(longest_on_trials_));
    }
    if (reference.motion != nullptr && !errors_->has_reference())
    {
      hold_against(reference);
    }
    errors_->run_next();
    ++runs_;
    count_evaluations();
    look_for_steps();
    is_over_ = is_over_ || found_ || runs_ >= most_runs || errors_->finest_step() < Simulation::shortest_step;
  }

  void hold_against(const MethodErrors::Reference& reference) override
  {
    if (errors_)
    {
      errors_->hold_against(reference);
    }
  }

  std::optional<Candidate> found() const override
  {
    return found_;
  }

  std::optional<Candidate> nearest(double most_cost, double hardly_more) const override
  {
    if (!errors_ || !errors_->is_known() || !std::isfinite(errors_->error_of_finest()))
    {
      return {};
    }
    const double shortest_affordable = longest_ * cost_of(longest_) / most_cost;
    if (shortest_affordable > longest_)
    {
      return {};
    }
    const double shortest = std::clamp(errors_->finest_step() / stretch(), shortest_affordable, longest_);
    const double as_exact = errors_->step_for(hardly_more * errors_->error_of(shortest * stretch())) / stretch();
    return candidate_of(std::clamp(as_exact, shortest, longest_));
  }

  MethodErrors::Reference reference() const override
  {
    return errors_ && errors_->is_known() ? MethodErrors::Reference{ &errors_->finest(), errors_->error_of_finest() } :
                                            MethodErrors::Reference{};
  }

  double error_of_longest() const override
  {
    return errors_ && errors_->is_known() ? errors_->error_of(longest_on_trials_) :
                                            std::numeric_limits<double>::infinity();
  }

  bool knows_its_floor() const override
  {
    const bool is_clear = errors_ && (errors_->falls() || is_at_its_floor());
    return (runs_ > 2 && is_clear) || (runs_ >= enough_runs && !may_fall_yet());
  }
  bool is_at_its_floor() const override
  {
    return errors_ && errors_->is_at_its_floor() && !may_fall_yet();
  }

private:
  void take_limits(double limit, double limit_of_trials)
  {
    const double given = searched_.scene.params.solver.time_step;
    longest_ = is_limited_ ? Simulation::limit_share * limit : longest_step;
    is_given_ = given > 0.0 && given < longest_;
    longest_ = is_given_ ? given : longest_;
    const double of_trials = is_limited_ ? Simulation::limit_share * limit_of_trials : longest_trial_step;
    longest_on_trials_ = std::min(is_given_ ? longest_ * stretch() : of_trials, of_trials);
  }

  /// Another run is cheap, and errors that did not fall so far may do so in shorter steps.
  bool may_fall_yet() const
  {
    return runs_ < enough_runs_of_chaos && trial_cost() < cheap_trial;
  }

  /// Against a reference, or the method's own steps where those are exact enough for one.
  bool is_measured() const
  {
    const bool is_own_reference =
        errors_->falls() && errors_->error_of_finest() < reference_share * searched_.allowed.measured;
    return (errors_->has_reference() || is_own_reference) && !searched_.trials.is_coarser();
  }
  double allowed() const
  {
    return is_measured() ? searched_.allowed.measured : searched_.allowed.estimated;
  }

  /// How much longer a step on the coarser grid does the same.
  double stretch() const
  {
    return row_.iterates_locally ? searched_.trials.coarseness() : 1.0;
  }

  Stepping stepping_of(double time_step) const
  {
    Stepping stepping{ row_.name, time_step };
    const bool is_in_substeps = row_.iterates_locally && row_.linear_solves == 0;
    stepping.iterations = is_in_substeps ? 1 : searched_.scene.params.solver.iterations;
    return stepping;
  }

  double evaluations_a_step() const
  {
    const double of_a_solve =
        std::max(evaluations_of_a_solve, share_of_another_solve * searched_.trials.evaluations_of_a_solve());
    const double least =
        row_.force_evaluations + row_.linear_solves * (row_.iterates_locally ? evaluations_of_a_solve : of_a_solve);
    return std::max(counted_, row_.iterates_locally ? evaluations_of_a_pass * least : least);
  }

  double cost_of(double time_step) const
  {
    return evaluations_a_step() * searched_.trials.evaluation() / time_step;
  }

  /// In a step as long as asked for: equations take more or less, and a limit that falls shortens steps.
  void count_evaluations()
  {
    counted_ = evaluations_in(errors_->finest().counters) * errors_->finest_step() / Motion::horizon;
  }

  void look_for_steps()
  {
    if (!errors_->is_known())
    {
      return;
    }
    const bool is_seen = errors_->has_reference() && errors_->error_of_finest() <= allowed();
    if (!is_limited_ && !is_seen && !errors_->falls())
    {
      return;
    }
    const double finest = errors_->finest_step() / stretch();
    const double step = std::min(longest_, errors_->step_for(allowed()) / stretch());
    const bool is_stability = step == longest_;
    const bool is_guess = !errors_->has_two() && row_.order > 1;
    const bool may_be_measured = !is_measured() && !searched_.trials.is_coarser() && !is_at_its_floor();
    const bool may_be_longer = !is_stability && (is_guess || may_be_measured) && trial_cost() < cheap_trial;
    if ((step >= least_of_finest * finest && !may_be_longer) || is_stability)
    {
      found_ = candidate_of(step);
      found_->error = std::min(found_->error, allowed());  // but for rounding it is
    }
  }

  Candidate candidate_of(double time_step) const
  {
    const bool as_limited = is_limited_ && time_step == longest_ && !is_given_;
    const Stepping stepping = stepping_of(as_limited ? 0.0 : time_step);
    const bool counts_evaluations = row_.linear_solves == 0 && !row_.iterates_locally;
    const double of_a_step = counts_evaluations ? evaluations_a_step() * searched_.costs.of_an_evaluation(
                                                                             searched_.scene, stepping_of(time_step)) :
                                                  searched_.costs.of_a_step(searched_.scene, stepping_of(time_step));
    const double of_trials = std::min(longest_on_trials_, as_limited ? longest_on_trials_ : time_step * stretch());
    return { &row_,
             stepping,
             time_step,
             errors_->error_of(time_step * stretch()),
             of_a_step / time_step,
             stepping_of(of_trials),
             stretch(),
             time_step,
             longest_ };
  }

  const MethodRow& row_;
  const SearchedScene& searched_;
  bool is_limited_;
  bool is_given_;
  double longest_;
  double longest_on_trials_;
  std::optional<MethodErrors> errors_;
  size_t runs_ = 0;
  double counted_ = 0.0;
  std::optional<Candidate> found_;
  bool is_over_ = false;
};

/// A method that chooses its steps by a tolerance.
class ToleranceSearch : public MethodSearch
{
public:
  ToleranceSearch(const MethodRow& row, const SearchedScene& searched)
    : row_(row)
    , searched_(searched)
    , longest_(likely_limit(row, searched.trials.spectrum_of_the_sheet()))
    , shrinkage_(std::max(1.0, searched.trials.likely_limit(row) / longest_))
    , tolerance_(first_tolerance * searched.allowed.estimated)
  {
  }

  bool is_over() const override
  {
    return is_over_;
  }

  double least_cost() const override
  {
    return tried_.empty() ? row_.force_evaluations * searched_.trials.evaluation() / longest_ : cost_of_last();
  }

  double next_cost() const override
  {
    return least_cost();
  }

  double trial_cost() const override
  {
    return searched_.trials.seconds_of_a_run(longest_ * shrinkage_, row_.force_evaluations);
  }

  void try_next(const MethodErrors::Reference& reference) override
  {
    const Motion& motion = searched_.trials.motion(stepping_of(tolerance_));
    tried_.push_back(tolerance_);
    error_ = reference.motion != nullptr ? std::hypot(distance(motion, *reference.motion), reference.error) :
             tried_.size() > 1 ? distance(motion, searched_.trials.motion(stepping_of(tried_[tried_.size() - 2]))) :
                                 std::numeric_limits<double>::infinity();
    const bool is_measured = reference.motion != nullptr && !searched_.trials.is_coarser();
    if (error_ <= (is_measured ? searched_.allowed.measured : searched_.allowed.estimated))
    {
      found_ = candidate();
    }
    is_over_ = found_ || tried_.size() >= most_tolerances;
    tolerance_ *= 0.1;
  }

  void hold_against(const MethodErrors::Reference& reference) override
  {
    if (!tried_.empty())
    {
      error_ =
          std::hypot(distance(searched_.trials.motion(stepping_of(tried_.back())), *reference.motion), reference.error);
    }
  }

  std::optional<Candidate> found() const override
  {
    return found_;
  }

  std::optional<Candidate> nearest(double most_cost, double /*hardly_more*/) const override
  {
    const bool is_known = !tried_.empty() && std::isfinite(error_) && cost_of_last() <= most_cost;
    return is_known ? std::optional<Candidate>(candidate()) : std::nullopt;
  }

  MethodErrors::Reference reference() const override
  {
    return {};
  }

  double error_of_longest() const override
  {
    return std::numeric_limits<double>::infinity();
  }

private:
  static constexpr double first_tolerance = 0.3;
  static constexpr size_t most_tolerances = 4;

  Stepping stepping_of(double tolerance) const
  {
    return { row_.name, searched_.scene.params.solver.time_step, tolerance, searched_.scene.params.solver.iterations };
  }

  /// Steps are as much shorter on the scene's own grid as stability asks for there.
  double cost_of_last() const
  {
    return evaluations_in(counters_of_last()) * shrinkage_ * searched_.trials.evaluation() / Motion::horizon;
  }

  const Simulation::Counters& counters_of_last() const
  {
    return searched_.trials.motion(stepping_of(tried_.back())).counters;
  }

  Candidate candidate() const
  {
    const auto steps = static_cast<double>(std::max<std::uint64_t>(1, counters_of_last().steps));
    const double mean_step = Motion::horizon / (shrinkage_ * steps);
    const Stepping stepping = stepping_of(tried_.back());
    return { &row_, stepping, mean_step, error_, cost_of_last(), stepping, 1.0, mean_step, mean_step };
  }

  const MethodRow& row_;
  const SearchedScene& searched_;
  double longest_;
  double shrinkage_;
  double tolerance_;
  std::vector<double> tried_;
  double error_ = std::numeric_limits<double>::infinity();
  std::optional<Candidate> found_;
  bool is_over_ = false;
};

}  // namespace

std::unique_ptr<MethodSearch> search_of(const MethodRow& row, const SearchedScene& searched)
{
  if (!(likely_limit(row, searched.trials.spectrum_of_the_sheet()) >= Simulation::shortest_step))
  {
    return nullptr;
  }
  if (row.linear_solves > 0 && !row.iterates_locally && !searched.trials.can_afford_a_first_solve())
  {
    return nullptr;
  }
  if (row.is_adaptive)
  {
    return std::make_unique<ToleranceSearch>(row, searched);
  }
  return std::make_unique<StepLengthSearch>(row, searched);
}

}  // namespace cloth
