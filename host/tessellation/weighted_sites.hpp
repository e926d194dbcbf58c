// SPDX-License-Identifier: GPL-3.0-or-later
/// \file weighted_sites.hpp  Makes the sites of a regular triangulation: particles with the weight R², and six bounding
/// sites far away.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "macadam/specimen.hpp"

namespace macadam {

/// A point with a weight.
struct WeightedSite {
  Vec3d centre;   ///< [m]
  double weight;  ///< [m²]

  /// Returns the power of p with respect to the site [m²].
  double power(const Vec3d& p) const { return dot(p - centre, p - centre) - weight; }
};

inline constexpr std::int32_t bounding_site_count = 6;

/// The corners of a tetrahedron. Particles are numbered from 0 up, bounding sites from −1 down.
using SiteNumbers = std::array<std::int32_t, 4>;

/// The order of the corners of a tetrahedron, and of the tetrahedra of a diagram: particles by number, then bounding
/// sites.
inline bool comes_before(std::int32_t a, std::int32_t b) {
  return static_cast<std::uint32_t>(a) < static_cast<std::uint32_t>(b);
}
inline bool come_before(const SiteNumbers& a, const SiteNumbers& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), comes_before);
}

/// The sites of a specimen by number: its particles and six bounding sites.
///
/// The bounding sites lie on the axes through the centre of the box, at the distance L = 4·(Lx + Ly + Lz) from it, and
/// have weight 0. The bounding sites cut nothing off the cells inside the box: for x in the box and any particle p,
/// pow_p(x) = |x − p|² − R² ≤ diagonal², whereas a bounding site q has pow_q(x) = |x − q|² ≥ (L − half an edge)² >
/// (3·(Lx + Ly + Lz))² > diagonal². This holds for every radius. The sites' convex hull |x| + |y| + |z| ≤ L (relative
/// to the centre) contains the box, whose half edges sum to L/8, in its interior. Therefore no edge between particles
/// lies on the hull, and all tetrahedra around such an edge are finite. Because the bounding sites are the corners of
/// the hull, they are never hidden, whatever the weights are.
class WeightedSites {
 public:
  /// `specimen` must outlive this object.
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
