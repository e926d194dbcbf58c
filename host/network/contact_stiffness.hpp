// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_stiffness.hpp  Computes the 6×6 stiffness blocks of one contact with respect to the motions of its two
/// particles, for the initial geometry.
#pragma once

#include <Eigen/Core>

#include "macadam/contact_network.hpp"

namespace macadam {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Return the moments of a facet's area as 3 × 3 matrices: the stiffness in opening and bending, and the stiffness in
/// slip and twist for α = 1, each divided by k/d, where k is the stiffness of the law and d the length of the contact.
/// They contain the sums of kernels::condensed_load() and of model (7.1).
Eigen::Matrix3d normal_moments(const AreaMoments& m);
Eigen::Matrix3d shear_moments(const AreaMoments& m);

/// Returns the stiffness block (i, j) of a contact: load on end i (force [N], moment [N·m]) per motion of end j
/// (displacement [m], rotation [rad]). Diagonal blocks are positive semidefinite; the contact exerts the negative of
/// this load. End 0 is A, end 1 is B. `k` [Pa] is the stiffness of the law: a facet of area A between centres at
/// distance d has the normal stiffness k·A/d. `alpha` is the ratio of shear to normal stiffness. The length and the
/// rock in series of the contact are taken into account.
Matrix6 contact_block(const Contact& contact, double k, double alpha, int i, int j);

}  // namespace macadam
