#pragma once

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/node_range.h"

namespace cloth
{

/// Adds the elastic and the internal damping force of every spring to both of its ends: `spring_force`, batch by
/// batch. All arguments have one row a node; positions in m, velocities in m/s, forces in N.
void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities, Vectors& forces);

/// The same for the springs whose first ends are in `first_ends`, and of their ends for those in `nodes` alone. A node
/// has all its forces when stretch after stretch (`for_each_stretch`) has been done from the one in which the node lies
/// `longest_reach` before to its own; the forces have then been added in the order in which the whole sheet adds them,
/// and are the same to the last bit.
void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities,
                       NodeRange first_ends, NodeRange nodes, Vectors& forces);

/// The most nodes that a spring's second end is behind its first.
int longest_reach(const ClothModel& model);

/// The elastic energy, sum of k (|l| - l0)^2 / 2, in J. The elastic force is minus its gradient.
double elastic_energy(const ClothModel& model, const Vectors& positions);

/// The largest |l|/l0 - 1 of the structural and shear springs; 0 where there are none and where all are compressed.
double max_strain(const ClothModel& model, const Vectors& positions);

/// Adds K u, K = -df/dx of the elastic forces without the part that compression makes negative:
///
///   k [n n^T + max(0, 1 - l0/|l|) (I - n n^T)] (u_i - u_j),   n = l/|l|
///
/// so that K is positive semidefinite and its largest eigenvalue is never below that of the whole Jacobian.
/// `displacements` in m, `product` in N.
void add_stiffness_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                           Vectors& product);

/// Adds H u, H the Hessian of the elastic energy: the whole of -df/dx, which compressed springs make indefinite,
///
///   k [n n^T + (1 - l0/|l|) (I - n n^T)] (u_i - u_j),   n = l/|l|
///
/// A spring of no length counts as one of no rest length. `displacements` in m, `product` in N, one row a node.
void add_hessian_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                         Vectors& product);

/// Adds C v, C = -df/dv of the internal damping: c n n^T (v_i - v_j), n = l/|l|. `velocities` in m/s, `product` in N.
void add_damping_product(const ClothModel& model, const Vectors& positions, const Vectors& velocities,
                         Vectors& product);

}  // namespace cloth
