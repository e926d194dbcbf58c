// SPDX-License-Identifier: GPL-3.0-or-later
// beam_strength.cpp  Computes fracture energy (RILEM TC 50-FMC), flexural strength and fracture toughness (ASTM E399)
// from the curve of load over displacement.
#include "host/experiments/transient/beam_strength.hpp"

#include <cmath>

#include "host/experiments/transient/load_curve.hpp"

namespace macadam {
namespace {

/// Span over height to which the formula of the toughness refers, and the relative difference that is allowed.
constexpr double span_of_toughness = experiments::ThreePointBending::usual_span, allowed_difference = 0.01;

/// Returns the factor f of the stress intensity K = load·span/(width·height^(3/2))·f for a span of four heights
/// (Srawley 1976; ASTM E399). `part`: length of the notch over the height, 0 to 1.
double beam_intensity_factor(double part) {
  const double rest = 1 - part;
  return 1.5 * std::sqrt(part) * (1.99 - part * rest * (2.15 - 3.93 * part + 2.7 * part * part)) /
         ((1 + 2 * part) * rest * std::sqrt(rest));
}

}  // namespace

experiments::BeamStrength beam_strength(std::span<const StressSample> samples, const experiments::FittedPeak& peak,
                                        const Domain& beam, const BottomNotch& notch) {
  const double height = beam.gauge_length(2), width = beam.gauge_length(1);
  const std::vector<double>& lower = beam.rollers()->bottom;
  const double span = lower.at(1) - lower.at(0);
  const LoadCurve curve(samples, peak, beam);
  experiments::BeamStrength out;
  static_cast<experiments::LoadResults&>(out) = curve.results();
  out.notch_m = notch.length;
  out.fracture_energy_j_m2 = out.work_j / (notch.ligament * width);
  if (notch.length == 0) {
    out.strength_pa = 3 * out.load_n * span / (2 * width * height * height);
    return out;
  }
  const bool has_span = std::abs(span / height - span_of_toughness) <= allowed_difference * span_of_toughness;
  if (notch.in_middle && has_span)
    out.toughness_pa_sqrt_m =
        out.load_n * span / (width * height * std::sqrt(height)) * beam_intensity_factor(notch.length / height);
  return out;
}

}  // namespace macadam
