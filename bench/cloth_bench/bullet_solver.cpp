#include "bullet_solver.h"

#include <algorithm>
#include <cmath>

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "interval_clock.h"

namespace cloth
{
namespace
{

constexpr int iterations = 10;
constexpr double longest_step = 1.0 / 60.0;
/// Bullet takes less for no time at all, s.
constexpr double shortest_step = 1e-6;

btVector3 vector_of(const Eigen::RowVector3d& v)
{
  return { btScalar(v.x()), btScalar(v.y()), btScalar(v.z()) };
}

class BulletSheet
{
public:
  BulletSheet(const Problem& problem, double step)
    : step_(btScalar(step))
    , simulation_(simulation_of(problem, "velocity_verlet", 1.0, {}))
    , state_(simulation_.state())
    , dispatcher_(&configuration_)
    , world_(&dispatcher_, &broadphase_, &solver_, &configuration_)
  {
    const ClothModel& model = simulation_.model();
    world_.setGravity(vector_of(problem.plan.scene.gravity.transpose()));
    information_.m_gravity = world_.getGravity();
    information_.m_broadphase = &broadphase_;
    information_.m_dispatcher = &dispatcher_;
    std::vector<btVector3> nodes;
    std::vector<btScalar> masses;
    for (int i = 0; i < model.nodes(); ++i)
    {
      nodes.push_back(vector_of(state_.positions.row(i)));
      masses.push_back(simulation_.pins().holds(i) ? btScalar(0) : btScalar(model.masses[i]));
    }
    body_ = std::make_unique<btSoftBody>(&information_, model.nodes(), nodes.data(), masses.data());
    append_springs(model);
    for (int i = 0; i < model.nodes(); ++i)
    {
      body_->m_nodes[i].m_v = vector_of(state_.velocities.row(i));
    }
    body_->m_cfg.piterations = iterations;
    body_->m_cfg.kDP = btScalar(step * problem.plan.scene.air.viscous_damping * model.areas.sum() / model.masses.sum());
    body_->m_cfg.collisions = 0;
    body_->setActivationState(DISABLE_DEACTIVATION);
    world_.addSoftBody(body_.get());
  }

  ~BulletSheet()
  {
    world_.removeSoftBody(body_.get());
  }

  BulletSheet(const BulletSheet&) = delete;
  BulletSheet& operator=(const BulletSheet&) = delete;

  void step()
  {
    constexpr int as_it_is_given = 0;
    world_.stepSimulation(step_, as_it_is_given);
  }

  const ClothState& state_at(double time)
  {
    state_.time = time;
    for (int i = 0; i < body_->m_nodes.size(); ++i)
    {
      const btSoftBody::Node& node = body_->m_nodes[i];
      state_.positions.row(i) << node.m_x.x(), node.m_x.y(), node.m_x.z();
      state_.velocities.row(i) << node.m_v.x(), node.m_v.y(), node.m_v.z();
    }
    return state_;
  }

private:
  /// Bullet takes the lengths as they are at the start for those at rest, unless it is told.
  void append_springs(const ClothModel& model)
  {
    std::vector<double> rest_lengths;
    for (const SpringBatch& batch : model.springs)
    {
      for_each_spring(batch, [&](int i, int j) {
        body_->appendLink(i, j);
        rest_lengths.push_back(batch.rest_length);
      });
    }
    body_->updateConstants();
    body_->m_bUpdateRtCst = false;
    for (int link = 0; link < body_->m_links.size(); ++link)
    {
      const btScalar length = btScalar(rest_lengths[static_cast<size_t>(link)]);
      body_->m_links[link].m_rl = length;
      body_->m_links[link].m_c1 = length * length;
    }
  }

  btScalar step_;
  Simulation simulation_;
  ClothState state_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_;
  btSoftBodyWorldInfo information_;
  std::unique_ptr<btSoftBody> body_;
};

}  // namespace

std::vector<double> BulletSolver::ladder(const Problem& problem, double ratio) const
{
  const double interval = problem.sample_interval();
  std::vector<double> steps;
  for (double n = std::max(1.0, std::ceil(interval / longest_step)); interval / n > shortest_step; n *= ratio)
  {
    steps.push_back(interval / n);
  }
  return steps;
}

Outcome BulletSolver::run(const Problem& problem, double value, double most_seconds) const
{
  const long steps = std::lround(problem.sample_interval() / value);
  Outcome outcome;
  IntervalClock clock(problem, most_seconds);
  BulletSheet sheet(problem, value);
  for (int s = 0; s < Problem::samples && outcome.status == Status::ok; ++s)
  {
    long taken = 0;
    clock.time([&] {
      for (; taken < steps && !clock.is_up(); ++taken)
      {
        sheet.step();
      }
    });
    outcome.samples.push_back(sheet.state_at(problem.time_of(s)));
    outcome.status = taken < steps                                 ? Status::too_slow :
                     !outcome.samples.back().positions.allFinite() ? Status::unstable :
                                                                     Status::ok;
  }
  clock.report(outcome);
  outcome.force_evaluations = iterations / value;
  return outcome;
}

std::string BulletSolver::obstacle(const Problem& problem) const
{
  const auto moves = [](const PinParams& pin) { return !pin.motion.amplitude.isZero(0.0); };
  const std::vector<PinParams>& pins = problem.plan.scene.pins;
  if (problem.kind == Kind::limited)
  {
    return "Bullet's cloth has no strain limit";
  }
  if (problem.plan.scene.air.wind_coupling > 0.0)
  {
    return "Bullet's wind acts otherwise";
  }
  return std::any_of(pins.begin(), pins.end(), moves) ? "Bullet's static nodes stand still" : "";
}

}  // namespace cloth
