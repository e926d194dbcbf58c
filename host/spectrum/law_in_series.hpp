// SPDX-License-Identifier: GPL-3.0-or-later
/// \file law_in_series.hpp  Computes the relaxation of a contact law with a spring in series.
#pragma once

#include "macadam/spectrum.hpp"

namespace macadam {

/// Returns the relaxation of a law with a spring of compliance `series` [1/Pa] in series. Units with a modulus below
/// 1e-14 of the instantaneous modulus are left out. \throws InputError as prony_series().
PronySeries relaxation_in_series(Law law, double series);

/// Returns a series whose moduli are multiplied by `factor`.
PronySeries times(double factor, PronySeries series);

}  // namespace macadam
