// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_volumetric.hpp  Assembles the stiffness matrix of a specimen with the rule "volumetric" from its
/// energy (docs/model/contacts.md, section 26). The openings of free facets are unknowns of their own.
#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <vector>

#include "macadam/contact_network.hpp"

namespace macadam::reference {

/// Complex modulus [Pa] and Poisson's ratio of a phase.
struct PhaseModuli {
  std::complex<double> E;
  double poisson_ratio = 0;
};

/// The second derivative of the energy W. Its unknowns are six numbers per particle (displacement, rotation), then the
/// normal opening of each free facet, then the displacement of the top wall along z.
struct VolumetricMatrix {
  Eigen::SparseMatrix<std::complex<double>> K;
  std::size_t particles = 0, free_facets = 0;
};

/// `network` was built from `tessellation` with lumped moments; only its points, frames and lever arms are used.
/// `in_rock` is the length of each contact's line of centres that lies in rock [m]. \throws InputError if the numbers
/// of contacts and lengths differ.
VolumetricMatrix assemble_volumetric(const Specimen& specimen, const Tessellation& tessellation,
                                     const ContactNetwork& network, const std::vector<double>& in_rock,
                                     const PhaseModuli& mastic, const PhaseModuli& rock);

}  // namespace macadam::reference
