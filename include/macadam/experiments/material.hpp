// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material.hpp  Defines the viscoelastic functions of the mixture. Tests in time (relaxation, creep, constant
/// rates) compute them in addition to the response to their own load.
#pragma once

#include "macadam/spectrum.hpp"

namespace macadam::experiments {

/// Viscoelastic functions of the mixture, and their accuracy.
struct Material {
  Spectrum spectrum;                     ///< spectrum as solved
  double shortest_s = 0, longest_s = 0;  ///< range of times for which the spectrum is accurate
  bool confined = false;                 ///< whether the sides were held, so that the moduli are confined ones
  /// Relaxation and creep as series with few units, which reproduce the spectrum with an error of `table_error`. Every
  /// table contains these series.
  PronySeries relaxation;
  CreepSeries creep;
  double table_error = 0;  ///< largest relative difference of E(t) from `spectrum`, within the range of times
  double seconds = 0;      ///< wall time of the solutions

  /// Returns the larger of Spectrum::error and Spectrum::checked, as the relative error of E(t) and J(t).
  double error() const { return spectrum.error > spectrum.checked ? spectrum.error : spectrum.checked; }
};

}  // namespace macadam::experiments
