// SPDX-License-Identifier: GPL-3.0-or-later
// misfit.cpp  Computes the residuals of |E*| and φ, or of the real and imaginary parts E' and E'' of E*.
#include "host/tools/calibration/misfit.hpp"

#include <cmath>
#include <numbers>

namespace macadam {

const char* to_string(Misfit misfit) {
  switch (misfit) {
    case Misfit::modulus_and_phase:
      return "modulus-and-phase";
    case Misfit::modulus:
      return "modulus";
    case Misfit::phase:
      return "phase";
    case Misfit::parts:
      return "parts";
  }
  return "unknown";
}

Measured measured_for(Misfit misfit) {
  return misfit == Misfit::modulus ? Measured::modulus
         : misfit == Misfit::phase ? Measured::phase
                                   : Measured::modulus_and_phase;
}

namespace calibration {

using Complex = std::complex<double>;

int residuals_each(Misfit misfit) { return misfit == Misfit::modulus_and_phase || misfit == Misfit::parts ? 2 : 1; }

void add_residuals(const ModulusData& data, const CalibrationOptions& options, const std::vector<Predicted>& predicted,
                   std::vector<double>& residuals, std::vector<double>& jacobian) {
  constexpr double degree = std::numbers::pi / 180;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const ModulusPoint& m = data.points[i];
    const Predicted& p = predicted[i];
    const double modulus_deviation = data.deviations ? m.e_star_std / m.e_star_pa : options.e_star_deviation;
    const double phase_deviation = degree * (data.deviations ? m.phase_std : options.phase_deviation);
    const Complex measured = std::polar(data.moduli ? m.e_star_pa : 1, degree * m.phase_deg);
    const auto row = [&](double residual, auto&& derivative) {
      residuals.push_back(residual);
      for (const Complex& change : p.by) jacobian.push_back(derivative(change));
    };
    if (options.misfit == Misfit::parts) {
      const double c = std::cos(degree * m.phase_deg), s = std::sin(degree * m.phase_deg);
      const double storage = m.e_star_pa * std::hypot(c * modulus_deviation, s * phase_deviation);
      const double loss = m.e_star_pa * std::hypot(s * modulus_deviation, c * phase_deviation);
      row((p.modulus - measured).real() / storage, [&](Complex change) { return change.real() / storage; });
      row((p.modulus - measured).imag() / loss, [&](Complex change) { return change.imag() / loss; });
      continue;
    }
    // the argument of this ratio is the difference of the phases, which is far from ±180°
    const Complex ratio = p.modulus / measured;
    if (options.misfit != Misfit::phase) {
      row(std::log(std::abs(ratio)) / modulus_deviation,
          [&](Complex change) { return (change / p.modulus).real() / modulus_deviation; });
    }
    if (options.misfit != Misfit::modulus) {
      row(std::arg(ratio) / phase_deviation,
          [&](Complex change) { return (change / p.modulus).imag() / phase_deviation; });
    }
  }
}

}  // namespace calibration
}  // namespace macadam
