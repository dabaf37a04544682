#pragma once

#include <vector>

#include "cloth_sim/model/cloth_model.h"

#include "shortening.h"

namespace cloth
{

/// Provot's rule as he gives it: batches in the model's order, springs in memory order, every second pass backwards;
/// each spring that is too long is shortened along itself to exactly max_strain, until a pass finds none. It takes as
/// many passes as the sheet has rows, and more.
class PlainSweeps : public Shortening
{
public:
  explicit PlainSweeps(const ClothModel& model);

  StrainLimit::Report shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes, double h,
                              Vectors& positions, Vectors* shifts) override;

  void go_on_from(const Shortening&) override
  {
  }

private:
  std::vector<SpringBatch> batches_;
};

}  // namespace cloth
