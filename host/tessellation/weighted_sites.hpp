// SPDX-License-Identifier: GPL-3.0-or-later
/// \file weighted_sites.hpp  What a regular triangulation is made of: particles, weighted by R², and six sites far
/// away.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "macadam/specimen.hpp"

namespace macadam {

struct WeightedSite {
  Vec3d centre;   ///< [m]
  double weight;  ///< [m²]

  double power(const Vec3d& p) const { return dot(p - centre, p - centre) - weight; }
};

inline constexpr std::int32_t bounding_site_count = 6;

/// Corners of a tetrahedron by number: particles count from 0, bounding sites from −1 down.
using SiteNumbers = std::array<std::int32_t, 4>;

/// The order that corners have in a tetrahedron, and tetrahedra in a diagram: particles by number, then bounding sites.
inline bool comes_before(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint32_t>(a) < static_cast<std::uint32_t>(b);
}
inline bool come_before(const SiteNumbers& a, const SiteNumbers& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), comes_before);
}

/// The sites of a specimen by number.
///
/// Bounding sites are on the axes through the box's centre, at L = 4·(Lx + Ly + Lz) from it, weight 0. They cut nothing
/// inside the box: for x in the box and any particle p, pow_p(x) = |x − p|² − R² ≤ diagonal², while a bounding site q
/// has pow_q(x) = |x − q|² ≥ (L − half an edge)² > (3·(Lx + Ly + Lz))² > diagonal². This holds for every radius. Their
/// hull |x| + |y| + |z| ≤ L about the centre holds the box, whose half edges sum to L/8, in its interior, so no edge
/// between particles is on the hull and all its tetrahedra are finite. As corners of the hull they are never hidden,
/// whatever the weights.
class WeightedSites {
 public:
  /// Of a specimen that outlives it.
  explicit WeightedSites(const Specimen& specimen) : specimen_(specimen) {
    const Vec3d &box = specimen.box.size, c = 0.5 * box;
    const double far = 4 * (box.x + box.y + box.z);
    const auto put = [&](int k, const Vec3d& p) { bounding_[k] = {p, 0}; };
    put(0, {c.x - far, c.y, c.z}), put(1, {c.x + far, c.y, c.z}), put(2, {c.x, c.y - far, c.z});
    put(3, {c.x, c.y + far, c.z}), put(4, {c.x, c.y, c.z - far}), put(5, {c.x, c.y, c.z + far});
  }

  std::size_t particles() const { return specimen_.size(); }

  WeightedSite operator[](std::int32_t number) const {
    if (number < 0) return bounding_[-1 - number];
    return {specimen_.centre[number], specimen_.radius[number] * specimen_.radius[number]};
  }

 private:
  const Specimen& specimen_;
  std::array<WeightedSite, bounding_site_count> bounding_;
};

}  // namespace macadam
