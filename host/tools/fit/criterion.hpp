// SPDX-License-Identifier: GPL-3.0-or-later
/// \file criterion.hpp  Computes information criteria, which decide how many parameters the data determine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "macadam/fit.hpp"

namespace macadam::fitting {

/// Returns the number of parameters that a criterion counts: one more if the size of the errors is estimated from the
/// misfit.
inline double counted(std::size_t parameters, bool deviations) {
  return static_cast<double>(parameters) + (deviations ? 0 : 1);
}

/// Returns whether this many measured numbers are enough for the parameters: at least one is left to estimate the size
/// of the errors, and the correction in AICc is finite.
inline bool enough(std::size_t numbers, std::size_t parameters, Criterion criterion) {
  return numbers >= parameters + (criterion == Criterion::aicc ? 3 : 1);
}

/// Returns −2·ln(likelihood) + penalty, for normally distributed errors whose size is known (if `deviations`) or
/// unknown: AICc = … + 2p + 2p(p + 1)/(n − p − 1) (Hurvich and Tsai), BIC = … + p·ln n (Schwarz).
inline double criterion(Criterion kind, double misfit, std::size_t numbers, std::size_t parameters, bool deviations) {
  // A misfit of 1e-16 per measured number corresponds to errors of 1e-8 standard deviations. Smaller misfits are
  // rounding errors and carry no information.
  constexpr double rounding = 1e-16;
  const auto n = static_cast<double>(numbers);
  const double p = counted(parameters, deviations);
  const double fit = deviations ? misfit : n * std::log(std::max(misfit / n, rounding));
  return fit + (kind == Criterion::bic ? p * std::log(n) : 2 * p + 2 * p * (p + 1) / (n - p - 1));
}

}  // namespace macadam::fitting
