#include "cloth_sim/simulation/statics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/gravity.h"
#include "cloth_sim/forces/spring_force.h"
#include "cloth_sim/forces/springs.h"

#include "grid_laplacian.h"
#include "steihaug_gradients.h"

namespace cloth
{
namespace
{

constexpr int most_iterations = 3000;
constexpr int most_products = 200000;
/// Of a question that is asked while time goes on.
constexpr double tolerance_near_rest = 1e-8;
constexpr int most_products_near_rest = 5000;
constexpr int most_multiplier_sets = 20;
/// From this set on a limit is out of reach that a set brings hardly nearer.
constexpr int first_telling_set = 6;
/// The residual at which the multipliers of the limit are found for the first time; then a tenth of it each time.
constexpr double first_accuracy = 1e-3;
constexpr int most_products_a_node = 10;
constexpr int most_products_at_a_saddle = 2000;
/// Less of the modelled change than this, and a step is refused.
constexpr double least_agreement = 1e-4;
/// A negative curvature, relative to M, from which a balance counts as a saddle.
constexpr double least_curvature = 1e-9;
/// A step of so many times the sheet's size goes nowhere.
constexpr double endless_step = 1e6;
/// The curvature of a limit that acts, as a multiple of the stiffest spring's: at first, its growth with each set of
/// multipliers, and at most. Soft at first, because a stiff limit cannot be trusted far.
constexpr double first_penalty = 1.0;
constexpr double penalty_growth = 3.0;
constexpr double last_penalty = 30.0;
/// The part of the strain limit's own tolerance within which it is obeyed here.
constexpr double limit_accuracy = 0.1;

double inner(const Vectors& one, const Vectors& other)
{
  return one.cwiseProduct(other).sum();
}

double longest_row(const Vectors& rows)
{
  return std::sqrt(rows.rowwise().squaredNorm().maxCoeff());
}

/// How much longer l gets when `change` is added, without the cancellation of two lengths.
double lengthening(const Eigen::Vector3d& l, const Eigen::Vector3d& change)
{
  const double sum = l.norm() + (l + change).norm();
  return sum > 0.0 ? change.dot(2.0 * l + change) / sum : 0.0;
}

/// Tangent stiffness n n^T along + (I - n n^T) across of a spring, n = l/|l|.
Eigen::Matrix3d tangent(const Eigen::Vector3d& l, double along, double across)
{
  const double squared = l.squaredNorm();
  const Eigen::Matrix3d plain = across * Eigen::Matrix3d::Identity();
  return squared > 0.0 ? Eigen::Matrix3d(plain + (along - across) / squared * l * l.transpose()) : plain;
}

/// A spring that must not be longer than `longest`. In the augmented Lagrangian it pulls with the tension
/// max(0, multiplier + penalty (|l| - longest)).
struct Tie
{
  int i;
  int j;
  double rest_length;  ///< m
  double longest;      ///< m
  double multiplier;   ///< N
};

std::vector<Tie> ties_of(const ClothModel& model, const Pins& pins, double max_strain)
{
  std::vector<Tie> ties;
  for (const SpringBatch& batch : model.springs)
  {
    if (batch.kind == SpringKind::flex || max_strain == 0.0)
    {
      continue;
    }
    for_each_spring(batch, [&](int i, int j) {
      if (!pins.holds(i) || !pins.holds(j))
      {
        ties.push_back({ i, j, batch.rest_length, batch.rest_length * (1.0 + max_strain), 0.0 });
      }
    });
  }
  return ties;
}

/// What is minimised: the energy of springs and gravity and the augmented Lagrangian of the limit, about the positions
/// that it was moved to last.
class Potential
{
public:
  Potential(const ClothModel& model, const Pins& pins, const Eigen::Vector3d& gravity, double max_strain)
    : model_(model)
    , pins_(pins)
    , gravity_(gravity)
    , max_strain_(max_strain)
    , ties_(ties_of(model, pins, max_strain))
    , at_rest_(Vectors::Zero(model.nodes(), 3))
  {
    double stiffest = 0.0;
    for (const SpringBatch& batch : model.springs)
    {
      stiffest = std::max(stiffest, batch.stiffness);
      strongest_ = std::max(strongest_, batch.stiffness * batch.rest_length);
    }
    penalty_ = first_penalty * stiffest;
    most_penalty_ = last_penalty * stiffest;
  }

  /// N.
  double force_scale() const
  {
    const double weight = model_.masses.sum() * gravity_.norm();
    return weight > 0.0 ? weight : strongest_;
  }

  double max_strain() const
  {
    return max_strain_;
  }
  const Vectors& positions() const
  {
    return positions_;
  }
  /// Minus the net force of every free node.
  const Vectors& gradient() const
  {
    return gradient_;
  }

  void move_to(const Vectors& positions)
  {
    positions_ = positions;
    pulls_.clear();
    Vectors forces = Vectors::Zero(model_.nodes(), 3);
    add_gravity(model_, gravity_, forces);
    add_spring_forces(model_, positions_, at_rest_, forces);
    for (const Tie& tie : ties_)
    {
      const Eigen::Vector3d l = difference(positions_, tie.i, tie.j);
      const double length = l.norm();
      const double tension = tension_of(tie, length);
      if (tension > 0.0)
      {
        add_to_both_ends(tension / length * l, tie.i, tie.j, forces);
        pulls_.push_back({ tie.i, tie.j, tangent(l, penalty_, tension / length) });
      }
    }
    pins_.clear_held(forces);
    gradient_ = -forces;
  }

  /// What the potential gains by `displacements`, each spring's part without cancellation: close to rest the whole is
  /// far below the rounding error of the energies.
  double change(const Vectors& displacements) const
  {
    double sum = gravitational_energy(model_, gravity_, displacements);
    for (const SpringBatch& batch : model_.springs)
    {
      for_each_spring(batch, [&](int i, int j) {
        const Eigen::Vector3d l = difference(positions_, i, j);
        const double longer = lengthening(l, difference(displacements, i, j));
        sum += batch.stiffness * longer * (l.norm() - batch.rest_length + 0.5 * longer);
      });
    }
    for (const Tie& tie : ties_)
    {
      const Eigen::Vector3d l = difference(positions_, tie.i, tie.j);
      const double longer = lengthening(l, difference(displacements, tie.i, tie.j));
      const double before = tension_of(tie, l.norm());
      const double after = tension_of(tie, l.norm() + longer);
      const double rise = before > 0.0 && after > 0.0 ? penalty_ * longer : after - before;
      sum += 0.5 * rise * (before + after) / penalty_;
    }
    return sum;
  }

  /// H u, for u that is zero at held nodes.
  void hessian_product(const Vectors& displacements, Vectors& product) const
  {
    product.setZero(model_.nodes(), 3);
    add_hessian_product(model_, positions_, displacements, product);
    for (const Pull& pull : pulls_)
    {
      add_to_both_ends(-pull.stiffness * difference(displacements, pull.i, pull.j), pull.i, pull.j, product);
    }
    pins_.clear_held(product);
  }

  /// Whether the multipliers are the limit's tensions, within the accuracy that the limit is to be obeyed with.
  bool knows_multipliers() const
  {
    return std::all_of(ties_.begin(), ties_.end(), [&](const Tie& tie) {
      const double tension = tension_of(tie, difference(positions_, tie.i, tie.j).norm());
      const double accuracy = limit_accuracy * StrainLimit::tolerance * max_strain_ * tie.rest_length;
      return std::abs(tension - tie.multiplier) <= penalty_ * accuracy;
    });
  }

  /// Takes the limit's tensions for the multipliers, and makes the limit stiffer.
  void update_multipliers()
  {
    for (Tie& tie : ties_)
    {
      tie.multiplier = tension_of(tie, difference(positions_, tie.i, tie.j).norm());
    }
    penalty_ = std::min(penalty_growth * penalty_, most_penalty_);
    move_to(Vectors(positions_));
  }

  /// The largest strain of a limited spring above max_strain.
  double excess() const
  {
    double largest = 0.0;
    for (const Tie& tie : ties_)
    {
      largest = std::max(largest, (difference(positions_, tie.i, tie.j).norm() - tie.longest) / tie.rest_length);
    }
    return largest;
  }

private:
  /// A tie under tension and its part of the Hessian.
  struct Pull
  {
    int i;
    int j;
    Eigen::Matrix3d stiffness;  ///< N/m
  };

  static Eigen::Vector3d difference(const Vectors& vectors, int i, int j)
  {
    return (vectors.row(j) - vectors.row(i)).transpose();
  }

  double tension_of(const Tie& tie, double length) const
  {
    return std::max(0.0, tie.multiplier + penalty_ * (length - tie.longest));
  }

  const ClothModel& model_;
  const Pins& pins_;
  const Eigen::Vector3d gravity_;
  const double max_strain_;
  std::vector<Tie> ties_;
  const Vectors at_rest_;
  double strongest_ = 0.0;  ///< the largest k l0, N
  double penalty_ = 0.0;    ///< N/m
  double most_penalty_ = 0.0;
  Vectors positions_;
  Vectors gradient_;
  std::vector<Pull> pulls_;
};

/// The search for rest.
class Settling
{
public:
  Settling(const ClothModel& model, const Pins& pins, const Eigen::Vector3d& gravity, double max_strain,
           double tolerance, const Vectors& positions)
    : pins_(pins), tolerance_(tolerance), potential_(model, pins, gravity, max_strain), laplacian_(model, pins)
  {
    size_ = std::hypot(model.width, model.height);
    accuracy_ = max_strain > 0.0 ? std::max(first_accuracy, tolerance) : tolerance;
    report_.force_scale = potential_.force_scale();
    move_to(positions);
  }

  /// Gives up after so many products.
  void run(int most_products)
  {
    bool is_lost = false;
    while (!report_.converged && !is_lost && report_.iterations < most_iterations &&
           report_.hessian_products < most_products)
    {
      if (report_.residual > accuracy_)
      {
        is_lost = !descend();
      }
      else if (!potential_.knows_multipliers())
      {
        is_lost = !pull_back();
        ask_for_more();
      }
      else if (accuracy_ > tolerance_)
      {
        ask_for_more();
      }
      else
      {
        report_.converged = !leave_saddle();
      }
    }
    report_.excess = potential_.excess();
  }

  const Vectors& positions() const
  {
    return potential_.positions();
  }
  const StaticsReport& report() const
  {
    return report_;
  }

private:
  void move_to(const Vectors& positions)
  {
    potential_.move_to(positions);
    find_residual();
  }

  void find_residual()
  {
    const double largest = longest_row(potential_.gradient());
    report_.residual = report_.force_scale > 0.0 ? largest / report_.force_scale : 0.0;
  }

  /// A new set of tensions for the limit. False: it is out of reach.
  bool pull_back()
  {
    const double excess = potential_.excess();
    const bool is_nearer = excess < 0.9 * last_excess_ || excess < StrainLimit::tolerance * potential_.max_strain();
    last_excess_ = excess;
    potential_.update_multipliers();
    find_residual();
    return ++multiplier_sets_ < most_multiplier_sets && (is_nearer || multiplier_sets_ < first_telling_set);
  }

  void ask_for_more()
  {
    accuracy_ = std::max(0.1 * accuracy_, tolerance_);
  }

  /// One step of Newton's method in its trust region, taken or refused. False: there is no end to the way down.
  bool descend()
  {
    ++report_.iterations;
    const Vectors& gradient = potential_.gradient();
    if (radius_ == 0.0)
    {
      Vectors steepest;
      laplacian_.solve(gradient, steepest);
      radius_ = std::sqrt(inner(gradient, steepest));
    }
    SteihaugGradients gradients = conjugate_gradients();
    const double reduction = std::min(0.1, std::sqrt(report_.residual));
    gradients.solve(-gradient, radius_, reduction, static_cast<int>(most_products_a_node * gradient.rows()));
    report_.hessian_products += gradients.products();
    const double change = potential_.change(gradients.step());
    const double agreement = change / gradients.modelled_change();
    if (agreement > least_agreement)
    {
      move_to(positions() + gradients.step());
    }
    adapt_radius(agreement, gradients.at_radius());
    return std::isfinite(change) && longest_row(gradients.step()) < endless_step * size_;
  }

  SteihaugGradients conjugate_gradients() const
  {
    return { [this](const Vectors& u, Vectors& product) { potential_.hessian_product(u, product); }, laplacian_ };
  }

  void adapt_radius(double agreement, bool at_radius)
  {
    if (!(agreement > 0.25))
    {
      radius_ *= 0.25;
    }
    else if (agreement > 0.75 && at_radius)
    {
      radius_ *= 3.0;
    }
  }

  /// Where a balance is no minimum, goes some way down from it. False: it is one, as far as can be seen. Noise meets
  /// directions that a symmetric sheet has no force along.
  bool leave_saddle()
  {
    SteihaugGradients gradients = conjugate_gradients();
    gradients.solve(noise(), std::numeric_limits<double>::infinity(), 1e-10, most_products_at_a_saddle);
    report_.hessian_products += gradients.products();
    if (!gradients.at_radius() || gradients.curvature() > -least_curvature)
    {
      return false;
    }
    Vectors step = gradients.direction() * (0.01 * size_ / longest_row(gradients.direction()));
    if (inner(step, potential_.gradient()) > 0.0)
    {
      step = -step;
    }
    for (int halvings = 0; halvings < 40; ++halvings, step *= 0.5)
    {
      if (potential_.change(step) < 0.0)
      {
        ++report_.iterations;
        radius_ = 0.0;
        move_to(positions() + step);
        return true;
      }
    }
    return false;
  }

  /// Reproducible numbers in [-1, 1] for the free nodes.
  Vectors noise() const
  {
    std::mt19937 generator{ 1986 };
    Vectors numbers(positions().rows(), 3);
    for (double& number : numbers.reshaped())
    {
      number = 2.0 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1.0;
    }
    pins_.clear_held(numbers);
    return numbers;
  }

  const Pins& pins_;
  const double tolerance_;
  Potential potential_;
  GridLaplacian laplacian_;
  double size_ = 0.0;      ///< of the sheet, m
  double radius_ = 0.0;    ///< of the trust region; 0: as long as the step of steepest descent
  double accuracy_ = 0.0;  ///< the residual that is small enough for now
  int multiplier_sets_ = 0;
  double last_excess_ = 0.0;  ///< with the last set
  StaticsReport report_;
};

}  // namespace

StaticsReport settle(const ClothModel& model, const Pins& pins, const Eigen::Vector3d& gravity, double max_strain,
                     double tolerance, Vectors& positions)
{
  Settling settling(model, pins, gravity, max_strain, tolerance, positions);
  settling.run(most_products);
  positions = settling.positions();
  return settling.report();
}

bool is_near_rest(const ClothModel& model, const Pins& pins, const Eigen::Vector3d& gravity, double max_strain,
                  double distance, const Vectors& positions)
{
  Settling settling(model, pins, gravity, max_strain, tolerance_near_rest, positions);
  settling.run(most_products_near_rest);
  return settling.report().converged && longest_row(settling.positions() - positions) <= distance;
}

bool holds_every_node(const ClothModel& model, const Pins& pins)
{
  std::vector<char> held(static_cast<size_t>(model.nodes()), 0);
  for (int node = 0; node < model.nodes(); ++node)
  {
    held[static_cast<size_t>(node)] = pins.holds(node) ? 1 : 0;
  }
  bool spread = true;
  while (spread)
  {
    spread = false;
    for (const SpringBatch& batch : model.springs)
    {
      for_each_spring(batch, [&](int i, int j) {
        char& one = held[static_cast<size_t>(i)];
        char& other = held[static_cast<size_t>(j)];
        spread = spread || one != other;
        one = other = one || other;
      });
    }
  }
  return std::find(held.begin(), held.end(), 0) == held.end();
}

}  // namespace cloth
