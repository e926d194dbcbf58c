// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sliding_parts.hpp  Parts of a cluster that slide on one another, and particles that turn by themselves.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "host/harmonic/contact_operator.hpp"
#include "host/network/clusters.hpp"
#include "host/network/contact_stiffness.hpp"
#include "macadam/specimen.hpp"

namespace macadam::harmonic {

/// Splits a cluster where horizontal contacts without shear stiffness (alpha = 0, normal along z) join it. Particles of
/// a part ascend, and parts ascend by their first particle. Usually the cluster is one part.
std::vector<std::vector<std::int32_t>> sliding_parts(const Cluster& cluster, const ContactNetwork& network,
                                                     const PairStiffness& stiffness);

/// Motions of one particle that none of its contacts resists, where it has two contacts or more and all of their
/// normals are parallel: columns of translations and rotations times the radius [m], orthonormal; [6 × number], usually
/// none. Particles with other contacts that can move by themselves are mechanisms, and not looked for.
Eigen::Matrix<double, 6, Eigen::Dynamic> own_motions(std::int32_t particle, const Specimen& specimen,
                                                     const ContactNetwork& network, const PairStiffness& stiffness);

}  // namespace macadam::harmonic
