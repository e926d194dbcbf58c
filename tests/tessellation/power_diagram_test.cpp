// SPDX-License-Identifier: GPL-3.0-or-later
/// \file power_diagram_test.cpp  Tests that a triangulation computed in parts equals, bit by bit, the triangulation
/// computed as a whole, and that searches for near sites agree with a comparison of all sites.
#include "host/tessellation/power_diagram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>

#include "host/tessellation/site_tree.hpp"
#include "tests/support/test_spheres.hpp"

namespace macadam {
namespace {

using test::add;

/// Returns spheres at random positions in a box that is not a cube. One sphere in fifty is up to ten times as large as
/// the others, so that it hides other spheres and reaches far beyond a part.
Specimen random_spheres(int number, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  Specimen s;
  s.box.size = {1, 0.7, 1.6};
  const double radius = 0.6 * std::cbrt(s.box.size.x * s.box.size.y * s.box.size.z / number);
  for (int i = 0; i < number; ++i) {
    const Vec3d p{s.box.size.x * share(random), s.box.size.y * share(random), s.box.size.z * share(random)};
    add(s, p, radius * (i % 50 == 0 ? 10 : 1) * share(random));
  }
  return s;
}

/// Returns equal spheres on a face-centred cubic lattice, where six or more spheres around each hole are cospherical.
Specimen lattice(int cells) {
  Specimen s;
  const double edge = cells;
  s.box.size = {edge, edge, edge};
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k)
        for (const Vec3d& p : {Vec3d{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}})
          add(s, Vec3d{i + p.x, j + p.y, k + p.z}, 0.35);
  return s;
}

/// Returns two distant groups of spheres with nothing between them, so that each part of the triangulation needs data
/// from far away.
Specimen two_crowds(int number) {
  Specimen s = random_spheres(number, 5);
  for (std::size_t i = 0; i < s.size(); ++i) {
    Vec3d& p = s.centre[i];
    p = 0.1 * p + (i % 2 ? Vec3d{0.85, 0.6, 1.4} : Vec3d{});
    s.radius[i] *= 0.1;
  }
  return s;
}

void expect_same_in_parts(const Specimen& s, const std::vector<std::uint8_t>& active) {
  const PowerDiagram whole = power_diagram(s, active, 1);
  ASSERT_GT(whole.tetrahedra.size(), 0U);
  for (const std::size_t parts : {2, 3, 5, 8, 31}) {
    const PowerDiagram joined = power_diagram(s, active, parts);
    ASSERT_EQ(joined.tetrahedra.size(), whole.tetrahedra.size()) << parts << " parts";
    for (std::size_t t = 0; t < whole.tetrahedra.size(); ++t) {
      ASSERT_EQ(joined.tetrahedra[t].site, whole.tetrahedra[t].site) << parts << " parts, tetrahedron " << t;
      ASSERT_EQ(joined.tetrahedra[t].neighbour, whole.tetrahedra[t].neighbour) << parts << " parts, tetrahedron " << t;
      ASSERT_EQ(std::memcmp(&joined.dual[t], &whole.dual[t], sizeof(Vec3d)), 0) << parts << " parts, tetrahedron " << t;
    }
  }
}

void expect_same_in_parts(const Specimen& s) { expect_same_in_parts(s, std::vector<std::uint8_t>(s.size(), 1)); }

TEST(PowerDiagram, PartsGiveTheWholeOfSpheresOfManySizes) {
  for (const unsigned seed : {1U, 2U, 3U}) expect_same_in_parts(random_spheres(2500, seed));
}
TEST(PowerDiagram, PartsGiveTheWholeOfALattice) { expect_same_in_parts(lattice(5)); }
TEST(PowerDiagram, PartsGiveTheWholeOfCrowdsFarApart) { expect_same_in_parts(two_crowds(600)); }
/// Large spheres lie among small spheres. A part may then need sites on the far side of a large sphere, beyond the
/// reach of the part's own spheres.
TEST(PowerDiagram, PartsGiveTheWholeOfBoulders) {
  Specimen s = random_spheres(3000, 13);
  for (std::size_t i = 0; i < s.size(); ++i) s.radius[i] = i < 6 ? 0.25 : std::min(s.radius[i], 0.03);
  expect_same_in_parts(s);
}
TEST(PowerDiagram, PartsGiveTheWholeOfAPlane) {
  Specimen s = random_spheres(300, 4);
  for (Vec3d& p : s.centre) p.z = 0.8;
  expect_same_in_parts(s);
}
/// The coordinates of dual points overflow here, so the search cannot decide which sites are near, and must include all
/// sites.
TEST(PowerDiagram, PartsGiveTheWholeOfCentresThatNearlyCoincide) {
  for (const double distance : {1e-12, 1e-200, 5e-324}) {
    Specimen s = random_spheres(200, 14);
    s.centre[40].z = 0;
    s.centre[117] = s.centre[40] + Vec3d{0, 0, distance};
    expect_same_in_parts(s);
  }
}
TEST(PowerDiagram, PartsGiveTheWholeOfFewerParticlesThanParts) {
  for (const int number : {1, 2, 7, 20}) expect_same_in_parts(random_spheres(number, 6));
}
TEST(PowerDiagram, PartsGiveTheWholeWithoutSomeParticles) {
  const Specimen s = random_spheres(1500, 7);
  std::vector<std::uint8_t> active(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) active[i] = i % 7 > 0;
  expect_same_in_parts(s, active);
}

/// Checks properties of the arrays that hold for any number of parts.
TEST(PowerDiagram, TetrahedraAreInOrderAndKnowTheirNeighbours) {
  const Specimen s = random_spheres(800, 8);
  const PowerDiagram d = power_diagram(s, std::vector<std::uint8_t>(s.size(), 1), 3);
  for (std::size_t t = 0; t < d.tetrahedra.size(); ++t) {
    const Tetrahedron& own = d.tetrahedra[t];
    EXPECT_TRUE(std::ranges::is_sorted(own.site, comes_before)) << t;
    EXPECT_GE(own.site[0], 0) << t;
    if (t > 0) { EXPECT_TRUE(come_before(d.tetrahedra[t - 1].site, own.site)) << t; }
    for (int k = 0; k < 4; ++k) {
      if (own.neighbour[k] < 0) {
        EXPECT_LT(own.site[k == 0 ? 1 : 0], 0) << "a face with a particle, tetrahedron " << t;
        continue;
      }
      const Tetrahedron& other = d.tetrahedra[own.neighbour[k]];
      for (int c = 0; c < 4; ++c)
        EXPECT_EQ(std::ranges::count(other.site, own.site[c]), c == k ? 0 : 1) << "tetrahedron " << t << ", face " << k;
      EXPECT_EQ(std::ranges::count(other.neighbour, static_cast<std::int32_t>(t)), 1) << t;
    }
  }
}

/// At the dual point of a tetrahedron, every site has at least the power of the tetrahedron's four corners. Powers are
/// computed from squared lengths of up to about 100 m² (distances to the bounding sites), which have a rounding error
/// of about 100 m² · 1e-16 = 1e-14 m². The tolerance is 1e3 times this error, for the flattest tetrahedron that is
/// solved in double precision.
TEST(PowerDiagram, NobodyIsInsideADualSphere) {
  const Specimen s = random_spheres(400, 9);
  const WeightedSites sites(s);
  const PowerDiagram d = power_diagram(s, std::vector<std::uint8_t>(s.size(), 1), 4);
  for (std::size_t t = 0; t < d.tetrahedra.size(); ++t) {
    const double own = sites[d.tetrahedra[t].site[0]].power(d.dual[t]);
    double least = own;
    for (std::int32_t i = 0; i < std::ssize(s.centre); ++i) least = std::min(least, sites[i].power(d.dual[t]));
    EXPECT_GE(least, own - 1e-11) << "tetrahedron " << t;
  }
}

/// The tree finds the same sites as a comparison of all sites.
TEST(SiteTree, FindsWhomALookAtEverybodyFinds) {
  const Specimen s = random_spheres(500, 10);
  const WeightedSites sites(s);
  std::vector<std::int32_t> numbers(s.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  const SiteTree tree(sites, numbers);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  std::size_t found_in_all = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3d p{share(random), share(random), share(random)};
    const BoundingBox bounds = BoundingBox{p, p}.wider(0.1);
    const double most = 0.02 * share(random);
    std::vector<std::int32_t> reaching, of_power, reach_wanted, power_wanted;
    tree.each_reaching(bounds, [&](std::int32_t i) { reaching.push_back(i); });
    tree.each_of_power(p, most, [&](std::int32_t i) { of_power.push_back(i); });
    for (std::int32_t i = 0; i < std::ssize(s.centre); ++i) {
      const Vec3d way = s.centre[i] - p;
      const double reach = 0.1 + s.radius[i];
      if (std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) <= reach) reach_wanted.push_back(i);
      if (dot(way, way) - s.radius[i] * s.radius[i] <= most) power_wanted.push_back(i);
    }
    std::ranges::sort(reaching), std::ranges::sort(of_power);
    EXPECT_EQ(reaching, reach_wanted) << k;
    EXPECT_EQ(of_power, power_wanted) << k;
    found_in_all += of_power.size();
  }
  EXPECT_GT(found_in_all, 0U);
}

TEST(SiteTree, PartsHaveAboutAsManyEach) {
  const Specimen s = random_spheres(1003, 12);
  const WeightedSites sites(s);
  std::vector<std::int32_t> numbers(s.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  for (const std::size_t parts : {1, 2, 3, 7, 16}) {
    const std::vector<std::size_t> begin = divide_into(sites, numbers, parts);
    ASSERT_EQ(begin.size(), parts + 1);
    EXPECT_EQ(begin.front(), 0U);
    EXPECT_EQ(begin.back(), s.size());
    for (std::size_t p = 0; p < parts; ++p)
      EXPECT_NEAR(static_cast<double>(begin[p + 1] - begin[p]), 1003.0 / static_cast<double>(parts), 5) << parts;
  }
  std::ranges::sort(numbers);
  for (std::int32_t i = 0; i < std::ssize(numbers); ++i) EXPECT_EQ(numbers[i], i);
}

}  // namespace
}  // namespace macadam
