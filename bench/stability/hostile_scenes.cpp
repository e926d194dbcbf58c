// SPDX-License-Identifier: GPL-3.0-or-later
// hostile_scenes.cpp  Makes networks with extreme stiffness ratios, size ratios and slivers.
#include "bench/stability/hostile_scenes.hpp"

#include <cmath>

#include "bench/stability/stability.hpp"
#include "tests/support/cluster_specimens.hpp"

namespace macadam::stability {
namespace {

/// Returns large spheres on a jittered grid of edge 2R, and four small ones of radius R/ratio in each gap between eight
/// large ones.
Specimen spheres_of_two_sizes(double ratio) {
  std::mt19937 random(77);
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(random()) / 4294967296.0);
  };
  constexpr int n = 3;
  const double radius = 1e-3, edge = 2 * radius, small = std::min(radius / ratio, 0.35 * radius);
  Specimen out;
  out.box.size = {n * edge, n * edge, n * edge};
  const auto add = [&](const Vec3d& centre, double r, Phase phase) {
    out.centre.push_back(centre);
    out.radius.push_back(r);
    out.phase.push_back(phase);
    out.body.push_back(phase == Phase::mastic ? -1 : static_cast<std::int32_t>(out.size()) - 1);
  };
  const auto jitter = [&](double size) {
    return Vec3d{uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  };
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3d cell{i % n + 0.5, i / n % n + 0.5, i / (n * n) + 0.5};
    add(edge * cell + jitter(0.03 * radius), ratio == 1 ? small : radius, Phase::aggregate);
  }
  constexpr int m = n - 1;
  // The small spheres in a gap are placed on four corners of a cube; `apart` is half the edge of this cube.
  const double apart = std::max(1.2 * small, 0.02 * radius);
  for (int i = 0; i < m * m * m; ++i) {
    const Vec3d gap{i % m + 1.0, i / m % m + 1.0, i / (m * m) + 1.0};
    for (const Vec3d& corner : {Vec3d{1, 1, 1}, Vec3d{1, -1, -1}, Vec3d{-1, 1, -1}, Vec3d{-1, -1, 1}}) {
      add(edge * gap + apart * corner + jitter(0.1 * apart), small, Phase::mastic);
    }
  }
  return out;
}

/// Returns a cubic lattice of 3 × 3 × 3 equal spheres whose centres are moved by up to `jitter` edges. Two of the four
/// cells that meet along an edge then share a facet that is about jitter·edge wide and one edge long. Some of the eight
/// cells that meet at a corner share a facet of about (jitter·edge)².
Specimen disturbed_lattice(double jitter) {
  std::mt19937 random(5);
  const auto offset = [&] { return jitter * (2 * (static_cast<double>(random()) / 4294967296.0) - 1); };
  constexpr int n = 3;
  const double edge = 2e-3;
  Specimen out;
  out.box.size = {n * edge, n * edge, n * edge};
  for (int i = 0; i < n * n * n; ++i) {
    out.centre.push_back(edge *
                         Vec3d{i % n + 0.5 + offset(), i / n % n + 0.5 + offset(), i / (n * n) + 0.5 + offset()});
    out.radius.push_back(edge / 2);
    out.phase.push_back(Phase::mastic);
    out.body.push_back(-1);
  }
  return out;
}

}  // namespace

test::TestScene stiff_aggregates(double ratio) {
  const double soft = 1e9;
  test::Laws laws = test::same_law(laws::Elastic{soft, 0.3});
  laws[static_cast<std::size_t>(PairType::ma)] = laws::Elastic{soft * std::sqrt(ratio), 0.3};
  for (const PairType pair : {PairType::aa, PairType::inner, PairType::aw}) {
    laws[static_cast<std::size_t>(pair)] = laws::Elastic{soft * ratio, 0.3};
  }
  return test::make_scene(test::random_specimen(8), {}, laws);
}

test::TestScene stiff_clusters(double ratio) {
  test::Laws laws = test::same_law(laws::Elastic{1e9, 0.3});
  laws[static_cast<std::size_t>(PairType::inner)] = laws::Elastic{1e9 * ratio, 0.3};
  return test::make_scene(test::few_clusters(8), {}, laws);
}

test::TestScene two_sizes(double ratio) { return test::make_scene(spheres_of_two_sizes(ratio), {}, elastic_laws()); }

test::TestScene nearly_cubic(double jitter) { return test::make_scene(disturbed_lattice(jitter), {}, elastic_laws()); }

}  // namespace macadam::stability
