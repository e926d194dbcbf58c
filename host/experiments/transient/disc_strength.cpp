// SPDX-License-Identifier: GPL-3.0-or-later
// disc_strength.cpp  Computes strength (EN 12697-23), fracture energy and CT index (ASTM D8225) from the curve of load
// over displacement.
#include "host/experiments/transient/disc_strength.hpp"

#include <numbers>

#include "host/experiments/transient/load_curve.hpp"

namespace macadam {
namespace {

/// Thickness to which the CT index refers [m].
constexpr double usual_thickness = 0.062;
/// A slope needs this number of samples within its range. A sudden drop has fewer, and its slope is that of an
/// increment.
constexpr int least_samples = 2;

}  // namespace

experiments::DiscStrength disc_strength(std::span<const StressSample> samples, const experiments::FittedPeak& peak,
                                        const Domain& disc) {
  const double area = section_area(disc), diameter = gauge_length(disc), thickness = area / diameter;
  const LoadCurve curve(samples, peak, disc);
  experiments::DiscStrength out;
  static_cast<experiments::LoadResults&>(out) = curve.results();
  out.strength_pa = 2 * out.load_n / (std::numbers::pi * diameter * thickness);
  out.fracture_energy_j_m2 = out.work_j / area;

  constexpr double first = 0.85, middle = 0.75, last = 0.65;  // parts of the largest load
  const auto begin = curve.displacement_at(first), end = curve.displacement_at(last);
  if (!begin || !end || curve.samples_between(*begin, *end) < least_samples) return out;
  out.slope_n_m = (first - last) * out.load_n / (*end - *begin);
  out.l75_m = curve.displacement_at(middle);
  out.ct_index =
      thickness / usual_thickness * (*out.l75_m / diameter) * 1e6 * out.fracture_energy_j_m2 / *out.slope_n_m;
  return out;
}

}  // namespace macadam
