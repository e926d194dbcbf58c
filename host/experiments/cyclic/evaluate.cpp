// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate.cpp  Computes |E*| and φ from the samples of a cyclic test: by a fit of the fundamental, and by Eq. 24–25
// from the peaks of the last cycle.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

#include "macadam/error.hpp"
#include "macadam/results.hpp"

namespace macadam {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// The fundamental of a signal, and the residual of its fit.
struct Fundamental {
  std::complex<double> value;  ///< c in Re(c·exp(iωt))
  double rms = 0;              ///< rms of the fit's residual
};

/// Fits offset + trend·t + fundamental + second harmonic by least squares, so that drift and start-up offsets do not
/// leak into the phasor. The second harmonic is fitted because it is not orthogonal to the trend. Without it in the
/// fit, a second harmonic of amplitude h over one cycle would add −0.78·h to the fundamental. A fit of fewer than 16
/// samples has no second harmonic.
template <class Value>
Fundamental fit(std::span<const ResponseSample> samples, double frequency, Value value) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  const bool second = n >= 16;
  Eigen::MatrixXd a(n, second ? 6 : 4);
  Eigen::VectorXd y(n);
  const double t0 = samples.front().time_s;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& s = samples[static_cast<std::size_t>(k)];
    // the time is in periods, because the fit is well conditioned only if all columns are of order one
    const double periods = (s.time_s - t0) * frequency;
    const double phase = two_pi * (s.time_s * frequency - std::floor(s.time_s * frequency));
    a.row(k).head<4>() << 1, periods, std::cos(phase), std::sin(phase);
    if (second) a.row(k).tail<2>() << std::cos(2 * phase), std::sin(2 * phase);
    y(k) = value(s);
  }
  const Eigen::VectorXd x = a.colPivHouseholderQr().solve(y);
  return {{x(2), -x(3)}, (a * x - y).norm() / std::sqrt(static_cast<double>(n))};
}

Stiffness from_phasors(std::complex<double> strain, std::complex<double> stress) {
  const std::complex<double> modulus = stress / strain;
  return {std::abs(modulus), std::arg(modulus) * 180 / std::numbers::pi};
}

/// Returns the extreme value of one cycle and its time, by a parabola through the largest sample (sign = +1) or the
/// smallest (−1) and its neighbours. The cycle is taken as periodic, so that a peak at its end has two neighbours.
template <class Value>
std::pair<double, double> peak(std::span<const ResponseSample> cycle, double sign, Value value) {
  const std::size_t n = cycle.size();
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k) {
    if (sign * value(cycle[k]) > sign * value(cycle[best])) best = k;
  }
  const double l = value(cycle[(best + n - 1) % n]), m = value(cycle[best]), r = value(cycle[(best + 1) % n]);
  const double curvature = l - 2 * m + r;
  const double shift = curvature != 0 ? std::clamp(0.5 * (l - r) / curvature, -1.0, 1.0) : 0.0;
  return {m - 0.25 * (l - r) * shift, cycle[best].time_s + shift * (cycle[1].time_s - cycle[0].time_s)};
}

/// Returns Poisson's ratio by fits of both strains to those samples that have a lateral strain.
std::optional<std::complex<double>> ratio_of(std::span<const ResponseSample> samples, double frequency) {
  std::vector<ResponseSample> measured;
  std::ranges::copy_if(samples, std::back_inserter(measured),
                       [](const ResponseSample& s) { return std::isfinite(s.lateral_strain); });
  if (measured.size() < 5) return {};
  const auto lateral = fit(std::span<const ResponseSample>(measured), frequency,
                           [](const ResponseSample& s) { return s.lateral_strain; });
  const auto axial =
      fit(std::span<const ResponseSample>(measured), frequency, [](const ResponseSample& s) { return s.strain; });
  return -lateral.value / axial.value;
}

}  // namespace

CyclicResult evaluate_cyclic(std::span<const ResponseSample> samples, double frequency, int fit_cycles) {
  if (samples.size() < 5 || !(frequency > 0) || fit_cycles < 1) {
    throw InputError("cyclic evaluation: found " + std::to_string(samples.size()) + " samples at " +
                     std::to_string(frequency) + " Hz over " + std::to_string(fit_cycles) +
                     " cycles, expected at least one cycle of 5 samples");
  }
  const double period = 1 / frequency, end = samples.back().time_s;
  const double spacing = samples[1].time_s - samples[0].time_s;
  // Returns the samples of the last `cycles` cycles, ending `skip` cycles before the end. The window contains only one
  // of its two ends, because both ends have the same phase of the cycle.
  auto window = [&](int cycles, int skip) {
    const double from = end - (cycles + skip) * period + 0.5 * spacing, to = end - skip * period + 0.5 * spacing;
    auto at = [&](double t) {
      return std::partition_point(samples.begin(), samples.end(), [&](const auto& s) { return s.time_s < t; });
    };
    return samples.subspan(static_cast<std::size_t>(at(from) - samples.begin()),
                           static_cast<std::size_t>(at(to) - at(from)));
  };
  const auto strain = [](const ResponseSample& s) { return s.strain; };
  const auto stress = [](const ResponseSample& s) { return s.stress_pa; };
  auto stiffness = [&](std::span<const ResponseSample> part) {
    return from_phasors(fit(part, frequency, strain).value, fit(part, frequency, stress).value);
  };
  const double available = (end - samples.front().time_s) * frequency + 1e-6;
  if (available < fit_cycles) {
    throw InputError("cyclic evaluation: found " + std::to_string(available) +
                     " cycles of samples, expected at least " + std::to_string(fit_cycles));
  }

  CyclicResult out;
  const auto last = window(fit_cycles, 0);
  const Fundamental stress_fit = fit(last, frequency, stress);
  out.fit = from_phasors(fit(last, frequency, strain).value, stress_fit.value);
  out.fit_rms = stress_fit.rms / std::abs(stress_fit.value);
  out.poisson_ratio = ratio_of(last, frequency);

  const auto cycle = window(1, 0);
  const auto [strain_max, t_strain] = peak(cycle, +1, strain);
  const auto [stress_max, t_stress] = peak(cycle, +1, stress);
  const auto [strain_min, unused_1] = peak(cycle, -1, strain);
  const auto [stress_min, unused_2] = peak(cycle, -1, stress);
  double lag = (t_strain - t_stress) * frequency;
  lag -= std::round(lag);
  out.peaks = {(stress_max - stress_min) / (strain_max - strain_min), 360 * lag};  // Eq. 24, 25

  out.change_e_star = out.change_phase_deg = std::numeric_limits<double>::quiet_NaN();
  if (available >= 2) {
    const Stiffness now = stiffness(cycle), before = stiffness(window(1, 1));
    out.change_e_star = now.e_star_pa / before.e_star_pa - 1;
    out.change_phase_deg = now.phase_deg - before.phase_deg;
  }
  return out;
}

}  // namespace macadam
