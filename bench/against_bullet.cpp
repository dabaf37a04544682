// Bullet's soft body and ours on the same sheet, frame by frame in turn, in one process and on one thread:
//
//   against_bullet [SECONDS [NODES_A_SIDE...]]
//
// prints for sheets of 64 x 64 and 128 x 128 nodes, or of those asked for, how long a frame of 1/60 s takes each, as a
// median over the frames, and how far the worst spring of each is stretched. Bullet runs as it is usually run: a step a
// frame, 10 and 40 iterations. Ours runs xpbd in small steps, one pass over the springs each, with the strain limit at
// 0.05, in doubles (a step each) and in mixed precision (a step a frame, in substeps).

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "cloth_sim/forces/springs.h"
#include "level_sheet.h"

namespace
{

using namespace cloth;

constexpr double frame = 1.0 / 60.0;
constexpr double max_strain_of_ours = 0.05;
/// Ours takes as many substeps a frame as the sheet has nodes a side, over this.
constexpr int nodes_a_substep = 4;

class BulletCloth
{
public:
  BulletCloth(const LevelSheet& sheet, int iterations)
    : model_(sheet.model), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_)
  {
    world_.setGravity({ 0.0F, 0.0F, -9.81F });
    info_.m_gravity = world_.getGravity();
    info_.m_broadphase = &broadphase_;
    info_.m_dispatcher = &dispatcher_;
    std::vector<btVector3> nodes;
    std::vector<btScalar> masses;
    for (int i = 0; i < model_.nodes(); ++i)
    {
      nodes.emplace_back(btScalar(sheet.start(i, 0)), btScalar(sheet.start(i, 1)), btScalar(sheet.start(i, 2)));
      masses.push_back(i == sheet.left || i == sheet.right ? 0.0F : btScalar(model_.masses[i]));
    }
    body_ = new btSoftBody(&info_, model_.nodes(), nodes.data(), masses.data());
    for (const SpringBatch& batch : model_.springs)
    {
      for_each_spring(batch, [this](int i, int j) { body_->appendLink(i, j); });
    }
    body_->m_cfg.piterations = iterations;
    body_->m_cfg.kDP = 0.001F;
    body_->m_cfg.collisions = 0;
    world_.addSoftBody(body_);
  }

  ~BulletCloth()
  {
    world_.removeSoftBody(body_);
    delete body_;
  }

  BulletCloth(const BulletCloth&) = delete;
  BulletCloth& operator=(const BulletCloth&) = delete;

  void advance_a_frame()
  {
    world_.stepSimulation(btScalar(frame), 1, btScalar(frame));
  }

  double worst_strain() const
  {
    Vectors positions(model_.nodes(), 3);
    for (int i = 0; i < model_.nodes(); ++i)
    {
      const btVector3& x = body_->m_nodes[i].m_x;
      positions.row(i) << x.x(), x.y(), x.z();
    }
    return max_strain(model_, positions);
  }

private:
  const ClothModel& model_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_;
  btSoftBodyWorldInfo info_;
  btSoftBody* body_ = nullptr;
};

class OurCloth
{
public:
  OurCloth(const LevelSheet& sheet, double time_step, const MethodSettings& settings)
    : simulation_(simulation_of(sheet, { max_strain_of_ours, 300, LimitSolver::tensions }, "xpbd", time_step, settings))
  {
  }

  void advance_a_frame()
  {
    simulation_.advance_to(++frames_ * frame);
  }

  double worst_strain() const
  {
    return max_strain(simulation_.model(), simulation_.state().positions);
  }

private:
  Simulation simulation_;
  int frames_ = 0;
};

/// What was seen of a cloth so far.
class Record
{
public:
  template <typename Cloth>
  void advance_a_frame(Cloth& cloth)
  {
    const auto begin = std::chrono::steady_clock::now();
    cloth.advance_a_frame();
    milliseconds_.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    strain_ = cloth.worst_strain();
    worst_ = std::max(worst_, strain_);
  }

  double median() const
  {
    std::vector<double> sorted = milliseconds_;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
    return sorted[sorted.size() / 2];
  }

  double mean() const
  {
    double sum = 0.0;
    for (const double time : milliseconds_)
    {
      sum += time;
    }
    return sum / static_cast<double>(milliseconds_.size());
  }

  void print(const char* name, const Record& ours) const
  {
    std::printf("  %-22s %8.2f %8.2f %8.1f %12.2f %12.2f\n", name, median(), mean(), mean() / ours.mean(),
                100.0 * strain_, 100.0 * worst_);
  }

private:
  std::vector<double> milliseconds_;
  double strain_ = 0.0;
  double worst_ = 0.0;
};

void compare(int nodes_a_side, int steps_a_frame, double duration)
{
  const LevelSheet sheet(nodes_a_side);
  OurCloth ours(sheet, frame / steps_a_frame, one_iteration);
  OurCloth mixed(sheet, frame, { 1e-3, steps_a_frame, 1.0, Precision::mixed });
  BulletCloth ten(sheet, 10);
  BulletCloth forty(sheet, 40);
  Record our_record;
  Record record_of_mixed;
  Record record_of_ten;
  Record record_of_forty;
  const int frames = static_cast<int>(duration / frame + 0.5);
  for (int f = 0; f < frames; ++f)
  {
    our_record.advance_a_frame(ours);
    record_of_mixed.advance_a_frame(mixed);
    record_of_ten.advance_a_frame(ten);
    record_of_forty.advance_a_frame(forty);
  }
  std::printf("%d x %d nodes\n", nodes_a_side, nodes_a_side);
  std::printf("  %-22s %8s %8s %8s %12s %12s\n", "", "ms", "ms", "times", "worst strain", "of any");
  std::printf("  %-22s %8s %8s %8s %12s %12s\n", "", "median", "mean", "ours", "at the end %", "frame %");
  our_record.print("ours, double", our_record);
  record_of_mixed.print("ours, mixed", our_record);
  record_of_ten.print("Bullet, 10 iterations", our_record);
  record_of_forty.print("Bullet, 40 iterations", our_record);
}

}  // namespace

int main(int argc, char** argv)
{
  const double duration = argc > 1 ? std::atof(argv[1]) : 5.0;
  std::vector<int> sizes;
  for (int a = 2; a < argc; ++a)
  {
    sizes.push_back(std::atoi(argv[a]));
  }
  if (argc < 3)
  {
    sizes = { 64, 128 };
  }
  if (!(duration > frame) || *std::min_element(sizes.begin(), sizes.end()) < nodes_a_substep)
  {
    std::fprintf(stderr, "usage: against_bullet [SECONDS [NODES_A_SIDE...]], more than a frame, %d nodes or more\n",
                 nodes_a_substep);
    return 2;
  }
  for (const int nodes_a_side : sizes)
  {
    compare(nodes_a_side, nodes_a_side / nodes_a_substep, duration);
  }
  return 0;
}
