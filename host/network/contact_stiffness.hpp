// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_stiffness.hpp  Stiffness of one contact between the motions of its ends (geometry of the start).
#pragma once

#include <Eigen/Core>

#include "macadam/contact_network.hpp"

namespace macadam {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Resisting load on end i (force [N], moment [N·m]) per motion of end j (displacement [m], rotation [rad]); ends: 0 is
/// A, 1 is B. `k` is the law's stiffness per area over distance [Pa].
Matrix6 contact_block(const Contact& contact, double k, double alpha, int i, int j);

}  // namespace macadam
