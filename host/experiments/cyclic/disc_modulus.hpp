// SPDX-License-Identifier: GPL-3.0-or-later
/// \file disc_modulus.hpp  Computes the complex modulus of a disc between two strips from its deformations, with the
/// closed form of Hondros (1959).
#pragma once

#include "macadam/experiments/frequency.hpp"
#include "macadam/experiments/indirect_tension.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// Coefficients of the deformations of an elastic disc in plane stress under a uniform radial pressure on two strips:
/// with the force P, the modulus E and the thickness t, the horizontal diameter grows by (a + b·ν)·P/(E·t), and the
/// middle part of the loaded diameter shrinks by (c + d·ν)·P/(E·t).
struct HondrosCoefficients {
  double a = 0, b = 0, c = 0, d = 0;
};

/// Returns the coefficients for strips that span the angle 2·`half_angle` [rad] at the axis of the disc: integrals of
/// the strains along the two diameters, with an error below 1e-9. `middle_part`: length of the middle part over the
/// diameter. For narrow strips a is 4/π − 1 and b is 1.
HondrosCoefficients hondros_coefficients(double half_angle, double middle_part);

/// Replaces the moduli in `out` by those of the disc, and sets the Poisson's ratio and the compliances of the disc.
/// `cells`: the tessellation of the specimen, whose domain is a disc with strips. \throws RunError if no particle lies
/// at a place where the deformation is measured.
void observe_disc(const experiments::IndirectTension& test, const Specimen& specimen, const Tessellation& cells,
                  const HarmonicResult& state, experiments::HarmonicFrequency& out);

}  // namespace macadam
