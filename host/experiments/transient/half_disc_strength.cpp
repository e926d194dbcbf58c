// SPDX-License-Identifier: GPL-3.0-or-later
// half_disc_strength.cpp  Computes fracture energy and flexibility index (AASHTO T 393), strength (EN 12697-44) and
// fracture toughness (AASHTO TP 105) from the curve of load over displacement.
#include "host/experiments/transient/half_disc_strength.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "host/experiments/transient/load_curve.hpp"

namespace macadam {
namespace {

/// Span over diameter to which the formulas of strength and toughness refer, and the relative difference that is
/// allowed.
constexpr double usual_span = 0.8, of_usual = 0.01;
/// The load must fall to this part of its largest value, so that the curve contains its steepest fall.
constexpr double fallen = 0.5;
/// Width of the window in which the slope of the curve is measured, over the displacement at the largest load.
constexpr double window = 0.1;

/// Returns the factor of the stress intensity K = Y·load/(2·radius·thickness)·√(π·notch) for a span of 0.8 of the
/// diameter (Lim, Johnston and Choi 1993; AASHTO TP 105). `part`: length of the notch over the radius.
double intensity_factor(double part) { return 4.782 - 1.219 * part + 0.063 * std::exp(7.045 * part); }

}  // namespace

experiments::HalfDiscStrength half_disc_strength(std::span<const StressSample> samples,
                                                 const experiments::FittedPeak& peak, const Domain& half_disc,
                                                 const BottomNotch& notch) {
  const double radius = half_disc.gauge_length(2), thickness = half_disc.gauge_length(1), diameter = 2 * radius;
  const LoadCurve curve(samples, peak, half_disc);
  experiments::HalfDiscStrength out;
  static_cast<experiments::LoadResults&>(out) = curve.results();
  out.notch_m = notch.length;
  out.fracture_energy_j_m2 = out.work_j / (notch.ligament * thickness);

  const std::vector<double>& lower = half_disc.rollers()->bottom;
  const double span = lower.at(1) - lower.at(0);
  if (std::abs(span / diameter - usual_span) <= of_usual * usual_span) {
    const double stress = out.load_n / (diameter * thickness);
    out.strength_pa = 4.263 * stress;
    if (notch.length > 0 && notch.in_middle)
      out.toughness_pa_sqrt_m =
          intensity_factor(notch.length / radius) * stress * std::sqrt(std::numbers::pi * notch.length);
  }

  if (!curve.displacement_at(fallen)) return out;
  out.slope_n_m = curve.steepest_fall(window * out.displacement_m);
  if (!out.slope_n_m) return out;
  const double slope_kn_mm = *out.slope_n_m / 1e6;
  out.flexibility_index = 0.01 * out.fracture_energy_j_m2 / slope_kn_mm;
  return out;
}

}  // namespace macadam
