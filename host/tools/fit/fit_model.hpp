// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fit_model.hpp  Computes ln |E*| and φ from the unknowns of a fit. The functions are templates, used with plain
/// numbers and with Ceres' derivative type.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "macadam/fit.hpp"

namespace macadam::fitting {

/// Frequency and temperature at which a modulus is computed.
struct Place {
  double omega = 0;          ///< [1/s]
  double temperature = 0;    ///< [°C]
  std::size_t isotherm = 0;  ///< number of the isotherm, for a free shift
};

/// The unknowns θ, first of the model, then of the temperature shift. Kelvin chain: ln E_m, ln C_m (if it flows), ln
/// E_1, ln C_1, … 2S2P1D: ln E_0, ln E_00, k, h, ln δ, ln τ, ln β (Huet–Sayegh has no ln β). WLF shift: ln C1, ln C2.
/// Arrhenius: ln E_a. Free shift: log10 a_T of each isotherm except the reference.
struct Unknowns {
  FitModel model = FitModel::kelvin;
  int units = 0;
  bool flow = false;
  ShiftKind shift = ShiftKind::none;
  double reference_temperature = 0;  ///< [°C]
  std::size_t reference_isotherm = 0, isotherms = 1;

  /// Number of unknowns of the model.
  std::size_t of_model() const {
    if (model == FitModel::kelvin) return 1 + (flow ? 1 : 0) + 2 * static_cast<std::size_t>(units);
    return model == FitModel::two_s2p1d ? 7 : 6;
  }
  /// Number of unknowns of the shift.
  std::size_t of_shift() const {
    switch (shift) {
      case ShiftKind::wlf:
        return 2;
      case ShiftKind::arrhenius:
        return 1;
      case ShiftKind::free:
        return isotherms - 1;
      default:
        return 0;
    }
  }
  std::size_t count() const { return of_model() + of_shift(); }
  /// Position in θ of log10 a_T of an isotherm, for a free shift.
  std::size_t of_isotherm(std::size_t isotherm) const {
    return of_model() + isotherm - (isotherm > reference_isotherm ? 1 : 0);
  }
};

/// ln |E*| [|E*| in Pa] and φ [rad].
template <class T>
struct Polar {
  T log_modulus, phase;
};

/// Returns ln a_T at a place.
template <class T>
T log_shift(const Unknowns& u, const T* theta, const Place& place) {
  using std::exp;
  const T* constants = theta + u.of_model();
  const double d = place.temperature - u.reference_temperature;
  if (u.shift == ShiftKind::wlf) return -exp(constants[0]) * (d * std::numbers::ln10) / (exp(constants[1]) + d);
  if (u.shift == ShiftKind::arrhenius) {
    const double inverse =
        1 / (laws::zero_celsius + place.temperature) - 1 / (laws::zero_celsius + u.reference_temperature);
    return exp(constants[0]) * (inverse / laws::gas_constant);
  }
  if (u.shift == ShiftKind::free && place.isotherm != u.reference_isotherm)
    return theta[u.of_isotherm(place.isotherm)] * std::numbers::ln10;
  return T(0);
}

/// Returns the modulus of the chain, 1/J* with J* = 1/E_m + 1/(iω·C_m) + Σ 1/(E_l + iω·C_l).
template <class T>
Polar<T> chain_modulus(const Unknowns& u, const T* theta, const T& log_omega) {
  using std::atan2;
  using std::exp;
  using std::log;
  T real = exp(-theta[0]), loss = T(0);  // J* = real − i·loss
  const T* unit = theta + 1;
  if (u.flow) loss += exp(-log_omega - *unit++);
  for (int l = 0; l < u.units; ++l, unit += 2) {
    const T log_x = log_omega + unit[1] - unit[0];  // x = ω·τ
    const bool slow = log_x > 0.0;
    const T y = exp(slow ? T(-log_x) : log_x);  // the smaller of x and 1/x, to avoid overflow
    const T part = exp(-unit[0]) / (1.0 + y * y);
    real += slow ? T(part * y * y) : part;
    loss += part * y;
  }
  return {-0.5 * log(real * real + loss * loss), atan2(loss, real)};
}

/// Returns the modulus of 2S2P1D or Huet–Sayegh, model (24.2).
template <class T>
Polar<T> analogue_modulus(const Unknowns& u, const T* theta, const T& log_omega) {
  using std::atan2;
  using std::cos;
  using std::exp;
  using std::log;
  using std::sin;
  constexpr double quarter = std::numbers::pi / 2;
  const T &k = theta[2], &h = theta[3];
  const T x = log_omega + theta[5];  // ln ωτ
  const T slow = exp(theta[4] - k * x), fast = exp(-h * x);
  const T real = 1.0 + slow * cos(quarter * k) + fast * cos(quarter * h);
  T loss = slow * sin(quarter * k) + fast * sin(quarter * h);  // 1 + … of (24.2) is real − i·loss
  if (u.model == FitModel::two_s2p1d) loss += exp(-x - theta[6]);
  const T statics = exp(theta[1]), scale = (exp(theta[0]) - statics) / (real * real + loss * loss);
  const T storage = statics + scale * real, dissipated = scale * loss;
  return {0.5 * log(storage * storage + dissipated * dissipated), atan2(dissipated, storage)};
}

/// Returns the modulus of the model at a place, shifted by temperature.
template <class T>
Polar<T> modulus_at(const Unknowns& u, const T* theta, const Place& place) {
  const T log_omega = std::log(place.omega) + log_shift(u, theta, place);
  return u.model == FitModel::kelvin ? chain_modulus(u, theta, log_omega) : analogue_modulus(u, theta, log_omega);
}

}  // namespace macadam::fitting
