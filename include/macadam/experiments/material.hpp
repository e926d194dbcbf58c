// SPDX-License-Identifier: GPL-3.0-or-later
/// \file material.hpp  What a test in time finds of the mixture itself, besides its own response.
#pragma once

#include "macadam/spectrum.hpp"

namespace macadam::experiments {

struct Material {
  Spectrum spectrum;                     ///< as solved
  double shortest_s = 0, longest_s = 0;  ///< times for which it holds
  bool confined = false;                 ///< its sides were held: the moduli are those of a confined specimen
  /// Few units that give the same to `table_error`, in every table that is written.
  PronySeries relaxation;
  CreepSeries creep;
  double table_error = 0;  ///< largest relative difference of E(t) from `spectrum`, at these times
  double seconds = 0;      ///< wall time of the solutions

  /// What is known of E(t) and J(t) of the points, relative.
  double error() const { return spectrum.error > spectrum.checked ? spectrum.error : spectrum.checked; }
};

}  // namespace macadam::experiments
