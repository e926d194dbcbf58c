// SPDX-License-Identifier: GPL-3.0-or-later
// surface_check_test.cpp  Makes every kind of fault of a surface on purpose. The check must find each fault at the
// right place, and the repair must mend it if that is possible.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "macadam/error.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

using Facets = std::vector<std::int32_t>;

/// Expects that the surface has faults. `expect` must check the expected faults and remove them from the verdict; then
/// no other fault may remain.
void expect_only(SurfaceVerdict verdict, const std::function<void(SurfaceVerdict&)>& expect) {
  EXPECT_FALSE(verdict.good());
  EXPECT_NE(verdict.text(), "closed");
  expect(verdict);
  EXPECT_TRUE(verdict.good()) << "and also " << verdict.text();
}

TEST(CheckSurface, GoodOnesAreClosed) {
  RandomStream random(1, 0);
  for (const Surface& s :
       {tetrahedron(), box_surface(1, 2, 3), tunnel(6, 4, 3, 1), icosphere(3), lump(1, 3, {3, 2, 1}, 0.3)}) {
    for (const double scale : {1.0, 1e-4}) {
      const SurfaceVerdict verdict = check_surface(mapped(s, random_pose(random, scale, {scale, 0, 0})));
      EXPECT_TRUE(verdict.good()) << s.name << ": " << verdict.text();
      EXPECT_EQ(verdict.text(), "closed");
      EXPECT_EQ(verdict.pieces, 1);
    }
  }
}

TEST(CheckSurface, OpenNamesTheFacetsAroundTheHole) {
  Surface s = icosphere(2);
  const auto lost = s.facets[100];
  s.facets.erase(s.facets.begin() + 100);
  Facets around;
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    int shared = 0;
    for (const auto p : s.facets[f]) shared += static_cast<int>(std::count(lost.begin(), lost.end(), p));
    if (shared == 2) around.push_back(static_cast<std::int32_t>(f));
  }
  ASSERT_EQ(around.size(), 3u);
  expect_only(check_surface(s), [&](SurfaceVerdict& v) {
    EXPECT_EQ(v.text(), "open at 3 facets (" + std::to_string(around[0]) + ", " + std::to_string(around[1]) + ", " +
                            std::to_string(around[2]) + ")");
    EXPECT_EQ(std::exchange(v.open, {}), around);
  });
}

/// A point without facets is reported, because it would distort measures such as the bounding sphere.
TEST(CheckSurface, StrayNamesThePointThatWouldCount) {
  Surface s = icosphere(1);
  s.points.insert(s.points.begin() + 5, {9, 9, 9});
  for (auto& facet : s.facets) {
    for (std::int32_t& p : facet) p += p >= 5;
  }
  EXPECT_THROW(measure_shape(s), InputError);
  const Surface repaired = repair_surface(s);
  EXPECT_EQ(repaired.points.size(), s.points.size() - 1);
  EXPECT_TRUE(check_surface(repaired).good());
  expect_only(check_surface(s), [](SurfaceVerdict& v) {
    EXPECT_EQ(v.text(), "no facet at 1 point (5)");
    EXPECT_EQ(std::exchange(v.stray, {}), (Facets{5}));
  });
}

TEST(CheckSurface, MisorientedNamesTheFlippedFacetAlone) {
  Surface s = icosphere(2);
  for (const int f : {7, 200}) std::swap(s.facets[f][0], s.facets[f][1]);
  expect_only(check_surface(s), [](SurfaceVerdict& v) {
    EXPECT_EQ(v.text(), "misoriented at 2 facets (7, 200)");
    EXPECT_EQ(std::exchange(v.misoriented, {}), (Facets{7, 200}));
  });
}

TEST(CheckSurface, InsideOut) {
  Surface s = icosphere(1);
  for (auto& f : s.facets) std::swap(f[0], f[1]);
  expect_only(check_surface(s), [](SurfaceVerdict& v) {
    EXPECT_EQ(v.text(), "inside out");
    EXPECT_TRUE(std::exchange(v.inside_out, false));
  });
}

/// Returns whether an edge of facet f passes through the interior of facet g (Möller and Trumbore, in floating point).
bool pierces(const Surface& s, const std::array<std::int32_t, 3>& f, const std::array<std::int32_t, 3>& g) {
  const Vec3d o = s.points[g[0]], e1 = s.points[g[1]] - o, e2 = s.points[g[2]] - o;
  for (int k = 0; k < 3; ++k) {
    const Vec3d from = s.points[f[k]], along = s.points[f[(k + 1) % 3]] - from;
    const Vec3d p = cross(along, e2), q = cross(from - o, e1);
    const double det = dot(e1, p), u = dot(from - o, p) / det, v = dot(along, q) / det, at = dot(e2, q) / det;
    constexpr double inside = 1e-9;
    if (u > inside && v > inside && u + v < 1 - inside && at > inside && at < 1 - inside) return true;
  }
  return false;
}

TEST(CheckSurface, SelfIntersectingNamesAllThatCut) {
  Surface s = icosphere(1);
  s.points[3] = -1.5 * s.points[3] + Vec3d{0.01, 0.02, 0.03};  // moves the point through the opposite side
  std::set<std::int32_t> expected;
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    for (std::size_t g = 0; g < s.facets.size(); ++g) {
      if (pierces(s, s.facets[f], s.facets[g])) expected.insert({std::int32_t(f), std::int32_t(g)});
    }
  }
  ASSERT_GE(expected.size(), 6u);
  expect_only(check_surface(s), [&](SurfaceVerdict& v) {
    const std::string words = "self-intersecting at " + std::to_string(expected.size()) + " facets (";
    EXPECT_EQ(v.text().rfind(words + std::to_string(*expected.begin()) + ", ", 0), 0u) << v.text();
    EXPECT_EQ(std::exchange(v.self_intersecting, {}), Facets(expected.begin(), expected.end()));
  });
}

TEST(CheckSurface, SelfIntersectingWhereAFacetIsFoldedOntoItsNeighbour) {
  Surface s = tetrahedron();
  s.facets.push_back(s.facets[2]);
  const SurfaceVerdict twice = check_surface(s);
  EXPECT_EQ(twice.self_intersecting, (Facets{2, 4}));
  EXPECT_EQ(twice.non_manifold, (Facets{0, 1, 2, 3, 4}));  // each of its three edges has three facets

  Surface flat{"flat", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  EXPECT_EQ(check_surface(flat).self_intersecting, (Facets{0, 1}));
  flat.points[3] = {1, -1, 0};
  EXPECT_TRUE(check_surface(flat).self_intersecting.empty());
}

TEST(CheckSurface, NonManifoldEdge) {
  // Two boxes that share an edge by the same two points. The four facets at this edge are named.
  Surface s = box_surface(1, 1, 1);
  const Surface other = moved(s, {1, 1, 0});
  s = joined(s, other);
  for (auto& f : s.facets) {
    for (auto& p : f) p = p == 8 ? 2 : p == 12 ? 6 : p;  // the points (1, 1, 0) and (1, 1, 1)
  }
  Facets at_edge;
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    const auto has = [&](int p) { return std::count(s.facets[f].begin(), s.facets[f].end(), p) > 0; };
    if (has(2) && has(6)) at_edge.push_back(static_cast<std::int32_t>(f));
  }
  ASSERT_EQ(at_edge.size(), 4u);
  expect_only(check_surface(s), [&](SurfaceVerdict& v) {
    EXPECT_EQ(std::exchange(v.non_manifold, {}), at_edge);
    EXPECT_EQ(std::exchange(v.stray, {}), (Facets{8, 12}));
  });
}

TEST(CheckSurface, PinchedPointNamesTheFacetsAroundIt) {
  const Surface one = tetrahedron();
  Surface s = joined(one, mapped(one, [&](const Vec3d& p) { return 2.0 * one.points[0] - p; }));
  for (auto& f : s.facets) {
    for (auto& p : f) p = p == 4 ? 0 : p;
  }
  // reflection in a point reverses the orientation
  for (std::size_t f = 4; f < 8; ++f) std::swap(s.facets[f][0], s.facets[f][1]);
  expect_only(check_surface(s), [](SurfaceVerdict& v) {
    EXPECT_EQ(std::exchange(v.non_manifold, {}), (Facets{0, 1, 2, 4, 5, 6}));
    EXPECT_EQ(v.pieces, 1);
    EXPECT_EQ(std::exchange(v.stray, {}), Facets{4});
  });
}

TEST(CheckSurface, Pieces) {
  expect_only(check_surface(joined(tetrahedron(), moved(tetrahedron(), {3, 0, 0}))), [](SurfaceVerdict& v) {
    EXPECT_EQ(v.text(), "2 pieces");
    EXPECT_EQ(std::exchange(v.pieces, 1), 2);
  });
}

TEST(CheckSurface, PiecesInsideAnother) {
  const Surface box = box_surface(4, 4, 4);
  for (const bool inward : {true, false}) {
    Surface pore = moved(box_surface(1, 2, 1), {1, 1, 1});
    for (auto& f : pore.facets) {
      if (inward) std::swap(f[1], f[2]);
    }
    for (const Surface& s : {joined(box, pore), joined(pore, box)}) {
      expect_only(check_surface(s), [](SurfaceVerdict& v) {
        EXPECT_EQ(v.text(), "2 pieces, 1 inside the largest (closed pores)");
        EXPECT_EQ(std::exchange(v.pieces, 1), 2);
        EXPECT_EQ(v.inner, 1);
      });
    }
  }
  // A box that protrudes from the outer one, or is not closed, does not count as a pore.
  EXPECT_EQ(check_surface(joined(box, moved(box_surface(1, 1, 9), {1, 1, 1}))).inner, 0);
  Surface open = moved(box_surface(1, 1, 1), {1, 1, 1});
  open.facets.pop_back();
  EXPECT_EQ(check_surface(joined(box, open)).inner, 0);
}

TEST(CheckSurface, DegenerateInAnyPose) {
  // A point is placed on an edge, and one of the two facets at the edge is divided there. A flat facet without area
  // closes the gap between the two halves and the facet that is not divided.
  Surface s = box_surface(1, 1, 1);
  const auto flat = static_cast<std::int32_t>(s.facets.size());
  const auto [a, b, c] = s.facets[0];
  const auto middle = static_cast<std::int32_t>(s.points.size());
  s.points.push_back(0.5 * s.points[a] + 0.5 * s.points[b]);
  s.facets[0] = {a, middle, c};
  s.facets.push_back({middle, b, c});
  s.facets.push_back({a, b, middle});
  RandomStream random(1, 1);
  for (int k = 0; k < 20; ++k) {
    expect_only(check_surface(mapped(s, random_pose(random, 1e-3, {2e-3, 0, 0}))), [&](SurfaceVerdict& v) {
      EXPECT_EQ(std::exchange(v.degenerate, {}), (Facets{flat + 1}));
      // After rotation the point is off the edge by rounding, so that touching facets may be found to intersect.
      v.self_intersecting.clear();
    });
  }
  Surface twice = tetrahedron();
  twice.facets.push_back({0, 1, 1});
  expect_only(check_surface(twice), [](SurfaceVerdict& v) {
    EXPECT_EQ(v.text(), "degenerate at 1 facet (4)");
    EXPECT_EQ(std::exchange(v.degenerate, {}), (Facets{4}));
  });
}

TEST(CheckSurface, MoebiusStripIsMisorientedHoweverItIsTurned) {
  Surface s{"strip", {}, {}};
  constexpr int n = 12;
  for (int i = 0; i < n; ++i) {
    const double turn = 2 * std::numbers::pi * i / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(turn / 2);
      s.points.push_back({r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
    }
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    s.facets.push_back({a, c, b});
    s.facets.push_back({b, c, d});
  }
  EXPECT_FALSE(check_surface(s).misoriented.empty());
}

TEST(CheckSurface, NumbersWithoutSenseAreInputErrors) {
  const auto message = [](const Surface& s) -> std::string {
    try {
      check_surface(s);
      return "accepted";
    } catch (const InputError& error) { return error.what(); }
  };
  Surface s = tetrahedron();
  s.points[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(s).rfind("tetrahedron: point 2: found (", 0), 0u) << message(s);
  s = tetrahedron();
  s.points[1].x = 1e300;
  EXPECT_EQ(message(s).rfind("tetrahedron: point 1: found (1e+300", 0), 0u) << message(s);
  s = tetrahedron();
  for (const std::int32_t bad : {-1, 4, std::numeric_limits<std::int32_t>::max()}) {
    s.facets[3][1] = bad;
    EXPECT_EQ(message(s), "tetrahedron: facet 3: found point " + std::to_string(bad) + ", expected a number below 4");
  }
  EXPECT_EQ(message(Surface{"none", {}, {}}), "none: surface: found no facet, expected a closed surface");
}

}  // namespace
}  // namespace macadam::test
