// SPDX-License-Identifier: GPL-3.0-or-later
/// \file response.hpp  Defines the results of relaxation, creep and monotonic tests and of strain histories:
/// strain and stress at given times.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "macadam/experiments/cooling.hpp"
#include "macadam/experiments/cracks.hpp"
#include "macadam/experiments/energies.hpp"
#include "macadam/experiments/increments.hpp"
#include "macadam/experiments/indirect_tensile_strength.hpp"
#include "macadam/experiments/material.hpp"
#include "macadam/experiments/semicircular_bending.hpp"
#include "macadam/experiments/stepped.hpp"
#include "macadam/experiments/three_point_bending.hpp"

namespace macadam::experiments {

/// Strain and stress at one time, tension positive.
struct ResponsePoint {
  double time_s, strain, stress_pa;
  /// Relaxation: E(t) after a step of strain [Pa]. Creep: J(t) after a step of stress [1/Pa]. Constant rate and
  /// history: stress over strain [Pa], NaN at a strain of 0. In stepped tests it is computed from the strain and the
  /// stress of this point; NaN while the load is off.
  double ratio;
};

/// Result of method "harmonic", which computes the response from the relaxation spectrum.
struct SpectrumResponse {
  std::string kind;  ///< kind of the test
  Material material;
  std::vector<ResponsePoint> points;
};

/// A point of a stepped test, with measures of how near the specimen is to equilibrium. Stresses are forces over the
/// cross-section.
struct SteppedPoint : ResponsePoint {
  double top_pa, bottom_pa;  ///< stresses from the forces of the particles on the top and bottom walls
  double kinetic_j;          ///< kinetic energy of the particles, density scaling included
  double error;  ///< relative difference of the stress (creep: strain) from a solution computed without time steps
  std::int64_t broken_points = 0;  ///< number of broken contact points; 0 if no law can break
  CrackSums cracks = {};           ///< zero if no law has a crack
  Energies energies = {};          ///< zero if no law has a crack
  double temperature_c = std::numeric_limits<double>::quiet_NaN();  ///< of the specimen; NaN if it does not change
  /// Minus the mean lateral strain over the strain; NaN if the strain is 0, or if a side is held or has no cell.
  double poisson_ratio = std::numeric_limits<double>::quiet_NaN();
};

/// The largest stress of the cubic polynomial that fits the stress around the largest stress of a test, so that
/// vibrations do not count as strength (docs/cracks.md).
struct FittedPeak {
  double strain = 0, stress_pa = 0;
  double deviation_pa = 0;  ///< root mean square of the differences from the polynomial
};

/// Result of methods "explicit" and "quasi_static".
struct SteppedResponse : Stepped {
  std::string kind;
  bool confined = false;  ///< whether the sides were held
  std::vector<SteppedPoint> points;
  double ramp_s = 0;          ///< duration of the rise of the load; for a constant rate, of the whole test
  double platen_mass_kg = 0;  ///< mass of the top wall, without density scaling; 0: its displacement was prescribed
  double density_scaling = 1;
  Damping damping_kind = Damping::none;
  double damping = 0;  ///< χ, or β [1/s]
  double dt_s = 0;
  std::int64_t steps = 0;    ///< steps of the whole test
  double kinetic_share = 0;  ///< largest kinetic energy / (largest stress · largest strain · volume / 2)
  double seconds = 0;        ///< wall time of the stepping; for a resumed run, of all its processes

  std::optional<Cracks> cracks = {};      ///< empty if no law of the scene can break
  std::optional<Rupture> rupture = {};    ///< the rupture, if it ended the test early
  std::optional<Peak> peak = {};          ///< constant rate only, and only if a law of the scene can break
  std::optional<FittedPeak> fitted = {};  ///< as `peak`, only if a law has a crack and a polynomial fits

  std::optional<DiscStrength> disc = {};           ///< only kind "indirect_tensile_strength"
  std::optional<HalfDiscStrength> half_disc = {};  ///< only kind "semicircular_bending"
  std::optional<BeamStrength> beam = {};           ///< only kind "three_point_bending"
  std::optional<CoolingResults> cooling = {};      ///< only kind "cooling"

  std::optional<Increments> increments = {};  ///< only method "quasi_static"

  double error() const;  ///< Returns the largest error of the points before the rupture.
  /// Returns the largest |Energies::missing()| of all points, divided by the largest work. Empty if no law has a crack,
  /// if an energy is not known, or if damping takes energy, which is then the remainder of the balance.
  std::optional<double> energy_error() const;
};

}  // namespace macadam::experiments
