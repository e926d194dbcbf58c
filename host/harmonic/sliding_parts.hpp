// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sliding_parts.hpp  Finds the parts of a cluster that can slide on one another, and free motions of single
/// particles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "host/network/clusters.hpp"
#include "host/network/contact_stiffness.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// Splits a cluster (a set of particles that contacts join) at flat horizontal contacts without shear stiffness (alpha
/// = 0, normal along z). Particles of a part are in ascending order, and parts are ordered by their first particle.
/// Most clusters have one part.
std::vector<std::vector<std::int32_t>> sliding_parts(const Cluster& cluster, const ContactNetwork& network,
                                                     const PairStiffness& stiffness);

/// Returns the motions of one particle that none of its contacts resists, if it has at least two contacts and all
/// normals are parallel. Columns are orthonormal, [6 × number], with rotations multiplied by the radius [m]; most
/// particles have no such motion. Other particles are not examined; if such a particle can move by itself, the specimen
/// is a mechanism, which the solvers refuse.
Eigen::Matrix<double, 6, Eigen::Dynamic> own_motions(std::int32_t particle, const Specimen& specimen,
                                                     const ContactNetwork& network, const PairStiffness& stiffness);

}  // namespace macadam::harmonic
