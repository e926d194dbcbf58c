// SPDX-License-Identifier: GPL-3.0-or-later
// disc_strength.cpp  Computes strength (EN 12697-23), fracture energy and CT index (ASTM D8225) from the curve of load
// over displacement.
#include "host/experiments/transient/disc_strength.hpp"

#include <numbers>

namespace macadam {
namespace {

/// The work counts until the load has fallen to this size [N] (ASTM D8225).
constexpr double end_of_work = 100;
/// Thickness to which the CT index refers [m].
constexpr double usual_thickness = 0.062;

}  // namespace

experiments::DiscStrength disc_strength(std::span<const StressSample> curve, const experiments::FittedPeak& peak,
                                        const Domain& disc) {
  const double area = section_area(disc), diameter = gauge_length(disc), thickness = area / diameter;
  const auto load = [&](const StressSample& s) { return -s.stress_pa * area; };
  const auto approach = [&](const StressSample& s) { return -s.strain * diameter; };
  experiments::DiscStrength out;
  out.load_n = -peak.stress_pa * area;
  out.displacement_m = -peak.strain * diameter;
  out.strength_pa = 2 * out.load_n / (std::numbers::pi * diameter * thickness);

  // displacements at which the load first falls below parts of its largest value
  constexpr double parts[] = {0.85, 0.75, 0.65};
  std::optional<double> at[3];
  StressSample last{};
  bool fell = false;  // below the load at which the work ends
  for (const StressSample& s : curve) {
    const double width = approach(s) - approach(last);
    if (!fell) out.work_j += 0.5 * (load(s) + load(last)) * width;
    const bool after = approach(s) > out.displacement_m;
    for (int k = 0; k < 3; ++k) {
      const double wanted = parts[k] * out.load_n;
      if (!after || at[k] || load(s) > wanted) continue;
      const double fall = load(last) - load(s), part = fall > 0 ? (load(last) - wanted) / fall : 1;
      at[k] = approach(last) + std::min(1.0, std::max(0.0, part)) * width;
    }
    fell = fell || (after && load(s) < end_of_work);
    last = s;
  }
  out.fracture_energy_j_m2 = out.work_j / area;
  if (!at[2] || !(*at[2] > *at[0])) return out;
  out.slope_n_m = (parts[0] - parts[2]) * out.load_n / (*at[2] - *at[0]);
  out.l75_m = at[1];
  out.ct_index =
      thickness / usual_thickness * (*out.l75_m / diameter) * 1e6 * out.fracture_energy_j_m2 / *out.slope_n_m;
  return out;
}

}  // namespace macadam
