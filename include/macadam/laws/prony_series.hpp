// SPDX-License-Identifier: GPL-3.0-or-later
/// \file prony_series.hpp  Defines a relaxation modulus as a sum of exponentials: the relaxation of a contact law or of
/// a whole specimen.
#pragma once

#include <complex>
#include <vector>

namespace macadam {

/// Relaxation modulus as a sum of Maxwell units, in order of rising times. The functions are defined in host/spectrum.
struct PronySeries {
  struct Unit {
    double modulus;  ///< g [Pa], positive
    double time;     ///< τ [s]
  };
  double long_term = 0;  ///< E_∞ [Pa]; 0 for a fluid
  std::vector<Unit> units;

  double instantaneous() const;    ///< E(0) [Pa]
  double modulus(double t) const;  ///< E(t) [Pa]: stress after a step of strain, over the strain; 0 for t < 0
  /// Returns stress over strain if the strain grows linearly from t = 0 to `duration` and is then held; duration 0: a
  /// step.
  double after_ramp(double t, double duration) const;
  std::complex<double> stiffness(std::complex<double> s) const;  ///< E*(s) [Pa], for motions e^(s·t)
  std::complex<double> stiffness(double) const = delete;         // deleted, so that ω cannot be passed instead of iω
};

}  // namespace macadam
