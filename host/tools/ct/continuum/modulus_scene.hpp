// SPDX-License-Identifier: GPL-3.0-or-later
/// \file modulus_scene.hpp  Takes the moduli of the phases, the frequencies and the temperatures from a scene.
#pragma once

#include <optional>
#include <vector>

#include "host/tools/ct/continuum/mixing.hpp"
#include "macadam/scene.hpp"

namespace macadam::continuum {

/// A frequency and a temperature at which the modulus of a scan is computed.
struct ModulusPoint {
  double frequency_hz = 0;
  std::optional<double> temperature_c;  ///< empty if the scene gives none
  Material mastic;                      ///< at this frequency and temperature
};

/// The phases of a scan.
struct ScanPhases {
  Material rock;
  std::vector<ModulusPoint> points;  ///< all frequencies of one temperature, then of the next
};

/// Returns the phases of a scene with rule "series": `[materials.mastic]` and `[materials.aggregate]` give the laws and
/// Poisson's ratios, `[loading]` the frequencies and, as in a run, possibly temperatures. \throws InputError if one of
/// them is missing, if the test has no frequencies, or if the sides are held.
ScanPhases phases_of(const Scene& scene);

}  // namespace macadam::continuum
