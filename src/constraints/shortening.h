#pragma once

#include <vector>

#include "cloth_sim/constraints/strain_limit.h"

namespace cloth
{

/// The batches of structural and shear springs.
std::vector<SpringBatch> limited_batches(const ClothModel& model);

/// A way to shorten the structural and shear springs of one model that are too long.
class Shortening
{
public:
  virtual ~Shortening() = default;

  /// Corrects the positions (m), which have room for `row_padding` nodes more, so that no strain is above max_strain,
  /// in at most so many passes over the springs, at the end of a step of length h (s). Nodes of inverse mass 0 (1/kg)
  /// stay; `shifts`, unless null, gets what they were spared added to their rows, kg m: their springs' pull on them, as
  /// a mass times a way. Other rows are of no meaning.
  virtual StrainLimit::Report shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes, double h,
                                      Vectors& positions, Vectors* shifts) = 0;

  /// Takes over what `before`, of the same sheet, knows from its last call, where that is of use.
  virtual void go_on_from(const Shortening& before) = 0;
};

}  // namespace cloth
