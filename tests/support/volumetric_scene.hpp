// SPDX-License-Identifier: GPL-3.0-or-later
/// \file volumetric_scene.hpp  Specimens with the rule "volumetric", and their laws.
#pragma once

#include <algorithm>
#include <complex>
#include <numbers>
#include <vector>

#include "host/harmonic/law_stiffness.hpp"
#include "host/network/cell_volumes.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {

/// Returns the law with α = 1, or with another α.
inline Law with_alpha(Law law, double alpha) {
  std::visit([alpha](auto& l) { l.alpha = alpha; }, law);
  return law;
}

/// Returns the laws of the pairs that follow from the laws of mastic and rock, with platens without friction.
inline Laws laws_of_phases(const Law& mastic, const PhaseConstants& of) {
  const double nu = of.mastic_poisson_ratio;
  Laws out;
  const auto set = [&](PairType pair, const Law& law, double alpha) {
    out[static_cast<std::size_t>(pair)] = with_alpha(law, alpha);
  };
  set(PairType::mm, mastic, 1), set(PairType::ma, mastic, 1), set(PairType::mw, mastic, 0);
  set(PairType::aa, mastic, (1 - 2 * nu) / (2 * (1 - nu)));
  const laws::Elastic rock{of.rock_modulus > 0 ? of.rock_modulus : 1, 1};
  set(PairType::inner, rock, 1), set(PairType::aw, rock, 0);
  return out;
}

/// A specimen with the rule "volumetric" and the laws of its pairs.
struct VolumetricScene {
  Specimen specimen;
  Tessellation cells;
  ContactNetwork network;
  std::vector<double> in_rock;
  Laws laws;
  PhaseConstants constants;

  VolumetricScene(Specimen of, const Law& mastic, const PhaseConstants& constants, const NetworkSpec& spec = {})
      : specimen(std::move(of)),
        cells(tessellate(specimen)),
        network(build_network(specimen, cells, spec)),
        laws(laws_of_phases(mastic, constants)),
        constants(constants) {
    const RockSurfaces rock(specimen, {}, {});
    in_rock = rock_lengths(network, specimen, rock);
    apply_volumetric(network, specimen, cells, rock, constants);
  }

  HarmonicResult solve(double frequency, LinearMethod linear = LinearMethod::direct, double tolerance = 1e-12) const {
    const Inertia inertia = make_inertia(specimen, 2630, 2110);
    return Harmonic(specimen, network, laws, inertia, {.tolerance = tolerance, .linear = linear}, frequency)
        .solve(frequency);
  }
};

/// Returns the specimen with all particles of mastic.
inline Specimen all_mastic(Specimen specimen) {
  std::fill(specimen.phase.begin(), specimen.phase.end(), Phase::mastic);
  std::fill(specimen.body.begin(), specimen.body.end(), -1);
  return specimen;
}

/// Returns a network with walls at the four sides.
inline NetworkSpec held_sides() {
  NetworkSpec out;
  out.lateral_walls = true;
  return out;
}

inline std::complex<double> modulus_of(const Stiffness& s) {
  return std::polar(s.e_star_pa, s.phase_deg * std::numbers::pi / 180);
}

/// Returns k* of a law at a frequency [Hz].
inline std::complex<double> stiffness_of(const Law& law, double frequency) {
  return with_stiffness<std::complex<double>>(PairType::mm, law, [&](const auto& l) {
    return l.stiffness(std::complex<double>(0, 2 * std::numbers::pi * frequency));
  });
}

}  // namespace macadam::test
