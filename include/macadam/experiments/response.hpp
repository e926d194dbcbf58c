// SPDX-License-Identifier: GPL-3.0-or-later
/// \file response.hpp  What relaxation, creep and constant rates find: strain and stress at some times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "macadam/experiments/material.hpp"
#include "macadam/experiments/stepped.hpp"

namespace macadam::experiments {

/// At one time, tension positive.
struct ResponsePoint {
  double time_s, strain, stress_pa;
  /// Relaxation: E(t) after a step of strain [Pa]. Creep: J(t) after a step of stress [1/Pa]. Constant rate: stress
  /// over strain [Pa]. Stepped: of this strain and this stress; NaN where the load is off.
  double ratio;
};

/// From the relaxation spectrum, method "harmonic".
struct SpectrumResponse {
  std::string kind;  ///< of the test
  Material material;
  std::vector<ResponsePoint> points;
};

/// A point of a stepped run, and how near it is to equilibrium. Stresses are forces over the cross-section.
struct SteppedPoint : ResponsePoint {
  double top_pa, bottom_pa;  ///< of the particles on the walls
  double kinetic_j;          ///< kinetic energy of the particles, density scaling included
  double error;              ///< of the stress, or of the strain of a creep, from the answer without steps, relative
  std::int64_t broken_points = 0;  ///< contact points that are broken; 0 where no law can break
};

/// The largest stress of a test in the direction of its load, between its points too.
struct Peak {
  double time_s = 0, strain = 0, stress_pa = 0;
};

/// By method "explicit".
struct SteppedResponse : Stepped {
  std::string kind;
  bool confined = false;  ///< its sides were held
  std::vector<SteppedPoint> points;
  double ramp_s = 0;          ///< in which the load grew; constant rate: the whole test
  double platen_mass_kg = 0;  ///< of the top wall, density scaling not included; 0: it was moved
  double density_scaling = 1;
  Damping damping_kind = Damping::none;
  double damping = 0;  ///< χ, or β [1/s]
  double dt_s = 0;
  std::int64_t steps = 0;    ///< of the whole test
  double kinetic_share = 0;  ///< largest kinetic energy / (largest stress · largest strain · volume / 2)
  double seconds = 0;        ///< wall time of the stepping, of all processes of a resumed run

  std::optional<Rupture> rupture = {};  ///< why the test ended early
  std::optional<Peak> peak = {};        ///< constant rate: only if a law of the scene can break

  double error() const;  ///< largest of the points before the rupture
};

}  // namespace macadam::experiments
