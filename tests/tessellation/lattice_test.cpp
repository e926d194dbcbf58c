// SPDX-License-Identifier: GPL-3.0-or-later
/// \file lattice_test.cpp  Tests tessellations of lattices, whose cells are known exactly.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "host/tessellation/polygon.hpp"
#include "tests/support/test_spheres.hpp"
#include "tests/tessellation/tessellation_checks.hpp"

namespace macadam {
namespace {

using test::add, test::facets_of, test::expect_invariants, test::expect_order_and_orientation, test::empty_box,
    test::facet_tolerance;

// In a lattice every vertex is shared by more than four cells. If the coordinates are decimal, this holds only up to
// rounding.

/// `unit` 1 gives coordinates that are exact in binary. `unit` 1e-3 converts millimetres to metres, with rounding.
struct Lattice : ::testing::TestWithParam<double> {
  double unit = GetParam(), a = GetParam() == 1 ? 8 : 7;  ///< 7 mm is not an exact binary fraction of a metre
  double length(double x) const { return x * unit; }

  /// Returns `cells` periods of the basis (in units of the period). All spheres are inside the box.
  Specimen build(std::array<int, 3> cells, const Vec3d& period, const std::vector<Vec3d>& basis, double radius) {
    Specimen s = empty_box({length(cells[0] * period.x), length(cells[1] * period.y), length(cells[2] * period.z)});
    for (int i = 0; i < cells[0]; ++i)
      for (int j = 0; j < cells[1]; ++j)
        for (int k = 0; k < cells[2]; ++k)
          for (const Vec3d& b : basis)
            add(s, {length((i + b.x) * period.x), length((j + b.y) * period.y), length((k + b.z) * period.z)},
                length(radius));
    return s;
  }

  /// Calls `check` with the facets of each cell whose neighbours are all in the box. There must be such cells.
  void interior(const Specimen& s,
                const std::function<void(const std::map<int, std::pair<double, std::size_t>>&)>& check) {
    const Tessellation t = tessellate(s);
    EXPECT_TRUE(t.hidden.empty());
    expect_invariants(s, t);
    expect_order_and_orientation(t);
    int found = 0;
    for (int i = 0; i < static_cast<int>(s.size()); ++i) {
      const Vec3d &p = s.centre[i], &box = s.box.size;
      const double margin = length(1.1 * a);
      if (std::min({p.x, p.y, p.z, box.x - p.x, box.y - p.y, box.z - p.z}) < margin) continue;
      check(facets_of(t, i));
      ++found;
    }
    EXPECT_GT(found, 0);
  }

  /// Expects a cell with `number` facets; the area of a facet depends on its number of corners only.
  void expect_facets(const std::map<int, std::pair<double, std::size_t>>& facets, std::size_t number,
                     const std::map<std::size_t, double>& area) const {
    EXPECT_EQ(facets.size(), number);
    for (const auto& [other, facet] : facets) {
      ASSERT_TRUE(area.contains(facet.second)) << facet.second << " corners";
      EXPECT_NEAR(facet.first, area.at(facet.second), facet_tolerance * area.at(facet.second));
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Units, Lattice, ::testing::Values(1.0, 1e-3));

TEST_P(Lattice, SimpleCubic) {
  const std::array<int, 3> n{5, 6, 7};
  const Specimen s = build(n, {a, a, a}, {{0.5, 0.5, 0.5}}, a / 2);
  const Tessellation t = tessellate(s);
  const double area = length(a) * length(a);
  EXPECT_EQ(t.facets.size(),
            static_cast<std::size_t>(3 * n[0] * n[1] * n[2] + n[0] * n[1] + n[1] * n[2] + n[2] * n[0]));
  std::vector<int> facets(s.size(), 0);
  for (const Facet& f : t.facets) {
    EXPECT_EQ(t.polygon(f).size(), 4U);
    EXPECT_NEAR(f.area, area, facet_tolerance * area);
    ++facets[f.a];
    if (f.b >= 0) ++facets[f.b];
  }
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(facets[i], 6) << "particle " << i;
    EXPECT_NEAR(t.cell_volume[i], area * length(a), facet_tolerance * area * length(a));
  }
  expect_invariants(s, t);
  expect_order_and_orientation(t);
}

TEST_P(Lattice, BodyCentredCubicIsTruncatedOctahedra) {
  const double square = length(a) * length(a) / 8, hexagon = length(a) * length(a) * 3 * std::sqrt(3.0) / 16;
  interior(build({4, 4, 4}, {a, a, a}, {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}, 0.4 * a), [&](const auto& facets) {
    expect_facets(facets, 14, {{4, square}, {6, hexagon}});
  });
}

TEST_P(Lattice, FaceCentredCubicIsRhombicDodecahedra) {
  const double area = length(a) * length(a) * std::sqrt(2.0) / 8;
  const std::vector<Vec3d> basis{{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};
  interior(build({4, 4, 4}, {a, a, a}, basis, 0.35 * a), [&](const auto& facets) {
    expect_facets(facets, 12, {{4, area}});
  });
}

TEST_P(Lattice, HexagonalLayersArePrisms) {
  const double c = 0.9 * a, side = length(a) / std::sqrt(3.0) * length(c);
  const double top = length(a) * length(a) * std::sqrt(3.0) / 2;
  interior(build({5, 3, 5}, {a, a * std::sqrt(3.0), c}, {{0.25, 0.25, 0.5}, {0.75, 0.75, 0.5}}, a / 2),
           [&](const auto& facets) {
             expect_facets(facets, 8, {{4, side}, {6, top}});
           });
}

TEST_P(Lattice, ParticlesOnTheBoxBoundary) {
  // The grid begins and ends on the walls, so cells are cut into halves, quarters and eighths.
  const int n = 5;
  Specimen s = empty_box({length(a * (n - 1)), length(a * (n - 1)), length(a * (n - 1))});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) add(s, {length(a * i), length(a * j), length(a * k)}, length(a / 2));
  const Tessellation t = tessellate(s);
  EXPECT_TRUE(t.hidden.empty());
  EXPECT_EQ(t.facets.size(), static_cast<std::size_t>(3 * n * n * (n - 1) + 6 * n * n));
  EXPECT_NEAR(t.cell_volume[0], std::pow(length(a), 3) / 8, facet_tolerance * std::pow(length(a), 3));
  expect_invariants(s, t);
}

/// Rounding may add or remove a vertex in the middle of an edge, and with the vertex a contact point. The polygons must
/// be the same in metres and in millimetres.
TEST(Lattices, HaveTheSamePolygonsInAnyUnit) {
  const std::vector<std::vector<Vec3d>> bases{
      {{0.5, 0.5, 0.5}},
      {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}},
      {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}},
      {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}},
      {{0, 0, 0},
       {0.5, 0.5, 0},
       {0.5, 0, 0.5},
       {0, 0.5, 0.5},  // diamond lattice, with up to 144 vertices in the middle of edges
       {0.25, 0.25, 0.25},
       {0.75, 0.75, 0.25},
       {0.75, 0.25, 0.75},
       {0.25, 0.75, 0.75}}};
  for (std::size_t b = 0; b < bases.size(); ++b) {
    const auto build = [&](double unit) {
      constexpr int n = 3;
      Specimen s = empty_box({n * unit, n * unit, n * unit});
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
          for (int k = 0; k <= n; ++k)
            for (const Vec3d& p : bases[b]) {
              const Vec3d c = unit * (Vec3d(i, j, k) + p);
              if (std::max({c.x, c.y, c.z}) <= n * unit) add(s, c, 0.35 * unit);
            }
      return s;
    };
    const Tessellation exact = tessellate(build(1));
    for (const double unit : {1e-3, 3.7e-2, 0.1, 7.3e-4, 1.9, 1e3, 1.0 / 3}) {
      const Tessellation t = tessellate(build(unit));
      ASSERT_EQ(t.facets.size(), exact.facets.size()) << "lattice " << b << ", unit " << unit;
      for (std::size_t f = 0; f < t.facets.size(); ++f) {
        const auto p = t.polygon(t.facets[f]), q = exact.polygon(exact.facets[f]);
        ASSERT_EQ(p.size(), q.size()) << "lattice " << b << ", unit " << unit << ", facet " << f;
        EXPECT_NEAR(t.facets[f].area, exact.facets[f].area * unit * unit, facet_tolerance * unit * unit);
        // Returns the second moment about the centroid as the points of the contact give it: for each triangle of the
        // fan, a third of its area times Σ|x|² over its corners.
        const auto moment = [](const Facet& facet, const auto& polygon) {
          double sum = 0;
          for (std::size_t v = 0; v < polygon.size(); ++v) {
            const Vec3d x = polygon[v] - facet.centroid, y = polygon[(v + 1) % polygon.size()] - facet.centroid;
            sum += norm(cross(x, y)) / 6 * (dot(x, x) + dot(y, y));
          }
          return sum;
        };
        EXPECT_NEAR(moment(t.facets[f], p), moment(exact.facets[f], q) * std::pow(unit, 4),
                    facet_tolerance * std::pow(unit, 4));
      }
    }
  }
}

TEST(Polygons, LoseVerticesWithinTheToleranceOfALineOnly) {
  const Polygon square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Polygon p = square;
  drop_collinear(p, 1e-10);
  EXPECT_EQ(p.size(), 4U);
  p = {{0, 0.3, 0}, {0, 0, 0}, {0.5, -1e-11, 0}, {0.7, 1e-12, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0.7, 1e-12}};
  drop_collinear(p, 1e-10);
  ASSERT_EQ(p.size(), 4U);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(norm(p[k] - square[k]), 0) << k;
  p = {{0, 0, 0}, {0.5, -1e-9, 0}, {1, 0, 0}, {1, 1, 0}};
  drop_collinear(p, 1e-10);
  EXPECT_EQ(p.size(), 4U);
}

}  // namespace
}  // namespace macadam
