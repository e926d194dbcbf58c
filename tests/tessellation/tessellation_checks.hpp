// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tessellation_checks.hpp  Invariants that every tessellation must have.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "macadam/tessellation.hpp"

namespace macadam::test {

// Tolerance of facets. A facet follows from a few operations on coordinates that are accurate to ε times the size of
// the box, about 1e-15 · (box / spacing) of a spacing. With up to ten spacings per box, and tetrahedra solved in double
// precision down to a flatness of 1e-3, this is 1e-11.
inline constexpr double facet_tolerance = 1e-11;

inline Specimen empty_box(const Vec3d& box) {
  Specimen s;
  s.box.size = box;
  return s;
}

inline void expect_invariants(const Specimen& s, const Tessellation& t, double limit = facet_tolerance) {
  const TessellationInvariants i = measure_invariants(s, t);
  EXPECT_LT(i.volume, 1e-12);
  EXPECT_LT(i.walls, 1e-12);
  EXPECT_LT(i.closure, limit);
  EXPECT_LT(i.flatness, limit);
  EXPECT_LT(i.power, limit);
}

inline void expect_order_and_orientation(const Tessellation& t) {
  for (std::size_t k = 0; k < t.facets.size(); ++k) {
    const Facet& f = t.facets[k];
    const auto p = t.polygon(f);
    ASSERT_GE(p.size(), 3U);
    EXPECT_GT(f.area, 0);
    EXPECT_TRUE(f.b < 0 || f.a < f.b);
    if (k > 0) {
      const Facet& e = t.facets[k - 1];
      EXPECT_TRUE(e.a < f.a || (e.a == f.a && e.b < f.b)) << "facet " << k;
    }
    Vec3d twice{};
    for (std::size_t v = 1; v + 1 < p.size(); ++v) twice += cross(p[v] - p[0], p[v + 1] - p[0]);
    EXPECT_NEAR(0.5 * dot(twice, f.normal), f.area, 1e-12 * f.area);
  }
}

/// Returns area and number of corners of each facet of one particle. The key is the number of the particle or wall on
/// the opposite side of the facet.
inline std::map<int, std::pair<double, std::size_t>> facets_of(const Tessellation& t, int particle) {
  std::map<int, std::pair<double, std::size_t>> out;
  for (const Facet& f : t.facets)
    if (f.a == particle || f.b == particle) out[f.a == particle ? f.b : f.a] = {f.area, t.polygon(f).size()};
  return out;
}

}  // namespace macadam::test
