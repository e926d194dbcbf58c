// SPDX-License-Identifier: GPL-3.0-or-later
// hostile_networks.cpp  Checks whether the computed time step is safe and the result is right for networks with extreme
// stiffness ratios, size ratios and slivers.
#include <cmath>

#include <fmt/format.h>

#include "bench/stability/hostile_scenes.hpp"
#include "bench/stability/stability.hpp"
#include "host/reference/reference_spectrum.hpp"

namespace macadam::stability {
namespace {

/// Checks what every network of these cases must give: a safe time step, a run at 0.95 of this step that stays bounded,
/// and a modulus on which two solvers agree. `conditioning`: ratio of the largest to the smallest stiffness; the
/// rounding errors of both solvers grow with it. `residual`: residual that the frequency-domain solver must reach.
/// `compared`: whether to compare with the reference solver. The reference solver stops with an error unless it reaches
/// a residual of 1e-12, which is not possible for every network.
void judge(Rows& rows, const std::string& name, const test::TestScene& scene, Effort effort, double conditioning,
           double residual = 1e-11, bool compared = true) {
  const double limit = true_limit(scene);
  StepperOptions options;
  const double computed = critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  rows.push_back({name, "double", "computed / true limit", std::sqrt(0.5) * (1 - 1e-9), 1 + 1e-9,
                  "safe, and within √2 (see step_bound)", computed / limit});
  options.dt = 0.95 * computed;
  const auto steps = by_effort<std::int64_t>(effort, 1000, 3000, 100000);
  for (const Setting& setting : settings()) {
    if (effort == Effort::test && setting.precision == Precision::mixed) continue;
    rows.push_back({name, setting.name(), fmt::format("largest kinetic energy / bound, {} steps", steps), 0, 1.01,
                    "leapfrog keeps H (see step_sweep); a hundredth for the change of geometry",
                    energy_over_bound(setting, scene, options, limit, steps, 1e-5)});
  }
  const HarmonicResult found = harmonic_solution(scene, 10, 0, residual);
  rows.push_back({name, "harmonic", "residual", 0, 10 * residual,
                  "the residual that the solver promises, computed independently", found.residual});
  if (!compared) return;
  const double expected = reference_static_modulus(scene.specimen, scene.network, scene.laws);
  rows.push_back({name, "harmonic", "modulus against the reference's direct solution, relative", 0,
                  1e-10 + 1e-14 * conditioning,
                  "elastic: no frequency in it; both solve to 1e-11, times what the stiffnesses lie apart",
                  std::abs(found.top.e_star_pa / expected - 1)});
}

/// Returns the area of the smallest facet as a fraction of the mean area.
double smallest_share(const ContactNetwork& network) {
  double least = INFINITY, sum = 0;
  for (const Contact& c : network.contacts) least = std::min(least, c.area), sum += c.area;
  return least * static_cast<double>(network.contacts.size()) / sum;
}

}  // namespace

Rows stiffness_ratios(Effort effort) {
  Rows rows;
  for (const double ratio : {1e0, 1e2, 1e4, 1e6}) {
    judge(rows, fmt::format("A–A over M–M {:.0e}", ratio), stiff_aggregates(ratio), effort, ratio);
  }
  // Rounding changes K·u by 2⁻⁵³ of its stiffest part, while the load of the wall acts on the softest part. So no
  // solver reaches a residual below 2⁻⁵³ times the stiffness ratio. At a ratio of 1e6 that is 1e-10, more than the
  // 1e-12 that the reference solver needs.
  for (const double ratio : by_effort(effort, std::vector{1e6}, {1e2, 1e6}, {1e0, 1e2, 1e4, 1e6})) {
    judge(rows, fmt::format("clusters, inner over all others {:.0e}", ratio), stiff_clusters(ratio), effort, ratio,
          1e-11 + 0x1p-53 * ratio, ratio < 1e5);
  }
  return rows;
}

Rows size_ratios(Effort effort) {
  Rows rows;
  for (const double ratio : {3.0, 10.0, 25.0, 50.0}) {
    judge(rows, fmt::format("radii 1:{}", ratio), two_sizes(ratio), effort, ratio * ratio * ratio);
  }
  return rows;
}

Rows slivers(Effort effort) {
  Rows rows;
  for (const double jitter : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const test::TestScene scene = nearly_cubic(jitter);
    const std::string name = fmt::format("cubic lattice off by {:.0e} of its edge", jitter);
    const auto invariants = measure_invariants(scene.specimen, tessellate(scene.specimen));
    rows.push_back({name, "double", "smallest facet / mean facet", 0, jitter,
                    "such facets exist: the area of a facet at a corner grows with the square of the offset",
                    smallest_share(scene.network)});
    rows.push_back({name, "double", "volume and closure of the cells, relative", 0, jitter < 1e-7 ? 2e-10 : 1e-12,
                    "cells fill the box to rounding; at 1e-8 up to twelve facets, one at each edge, are narrower "
                    "than 1e-10 of the distance and are left out",
                    std::max(invariants.volume, invariants.closure)});
    judge(rows, name, scene, effort, 1);
    const double modulus = harmonic_solution(scene, 10).top.e_star_pa;
    rows.push_back({name, "harmonic", "modulus / E − 1", -20 * jitter - 1e-10, 20 * jitter + 1e-10,
                    "a column of equal contacts has the modulus E; areas and distances are off by up to four times "
                    "the offset, and each particle has up to three slivers of that size",
                    modulus / 3e10 - 1});
  }
  return rows;
}

}  // namespace macadam::stability
