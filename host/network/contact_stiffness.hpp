// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_stiffness.hpp  The 6×6 stiffness blocks of one contact with respect to the motions of its two
/// particles, for the initial geometry.
#pragma once

#include <Eigen/Core>

#include "macadam/contact_network.hpp"

namespace macadam {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Returns the derivative of the load on end i (force [N], moment [N·m]) that resists the motion of end j (displacement
/// [m], rotation [rad]) with respect to this motion. End 0 is A, end 1 is B. `k` is the stiffness of the law per unit
/// of area over distance [Pa]; `alpha` is the ratio of shear to normal stiffness.
Matrix6 contact_block(const Contact& contact, double k, double alpha, int i, int j);

}  // namespace macadam
