// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_network_test.cpp  Tests the contacts of a network: frames, lever arms, point areas, moments, pair
/// types, filters, and the rows that list contacts by particle.
#include "macadam/contact_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "host/base/counted.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_spheres.hpp"

namespace macadam {
namespace {

using test::add;

/// Returns n spheres of mixed phases at random positions in a unit box; all of them have cells.
Specimen random_specimen(int n = 300, unsigned seed = 4) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> u(0.02, 0.98), r(0.05, 0.06);
  Specimen s;
  s.box.size = {1, 1, 1};
  for (int i = 0; i < n; ++i) {
    const bool aggregate = i % 3 == 0;
    add(s, {u(engine), u(engine), u(engine)}, r(engine), aggregate ? Phase::aggregate : Phase::mastic,
        aggregate ? i / 60 : -1);
  }
  // If two centres nearly coincide, one sphere may have no cell. Such spheres are removed.
  const auto hidden = particles_without_cell(s);
  for (auto it = hidden.rbegin(); it != hidden.rend(); ++it) {
    s.centre.erase(s.centre.begin() + *it);
    s.radius.erase(s.radius.begin() + *it);
    s.phase.erase(s.phase.begin() + *it);
    s.body.erase(s.body.begin() + *it);
  }
  return s;
}

NetworkSpec walls(bool bottom_top, bool lateral) {
  NetworkSpec spec;
  spec.bottom_top_walls = bottom_top, spec.lateral_walls = lateral;
  return spec;
}

NetworkSpec filters(std::optional<double> gap_max, std::optional<double> area_min) {
  NetworkSpec spec = walls(false, false);
  spec.gap_max = gap_max, spec.area_min = area_min;
  return spec;
}

struct RandomNetwork : ::testing::Test {
  Specimen specimen = random_specimen();
  Tessellation tessellation = tessellate(specimen);
  NetworkSpec spec = walls(true, true);
  ContactNetwork network = build_network(specimen, tessellation, spec);
};

std::string message(const Specimen& s, const NetworkSpec& spec = {}) {
  try {
    build_network(s, tessellate(s), spec);
  } catch (const InputError& e) { return e.what(); }
  return "no error";
}

/// Returns n³ equal spheres on a cubic lattice of spacing a that fills the box.
Specimen cubic(int n, double a) {
  Specimen s;
  s.box.size = {n * a, n * a, n * a};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) add(s, {(i + 0.5) * a, (j + 0.5) * a, (k + 0.5) * a}, a / 2);
  return s;
}

TEST(CanonicalFrame, IsOrthonormalAndRightHandedEverywhere) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> g;
  std::vector<Vec3d> normals{{0, 0, 1},  {0, 0, -1},   {1, 0, 0},     {-1, 0, 0},
                             {0, -1, 0}, {0, 1, -0.0}, {1e-9, 0, -1}, {1e-170, 1e-170, -1}};
  for (int k = 0; k < 1000; ++k) {
    const Vec3d v{g(engine), g(engine), g(engine)};
    normals.push_back((1 / norm(v)) * v);
  }
  constexpr double tolerance = 2e-15;  // a few products of numbers up to 1, and the rounding of the normal's length
  for (const Vec3d& n : normals) {
    Vec3d s, t;
    canonical_frame(n, s, t);
    EXPECT_NEAR(norm(s), 1, tolerance);
    EXPECT_NEAR(norm(t), 1, tolerance);
    EXPECT_NEAR(dot(s, t), 0, tolerance);
    EXPECT_NEAR(dot(s, n), 0, tolerance);
    EXPECT_NEAR(norm(cross(s, t) - n), 0, tolerance);
  }
}

TEST_F(RandomNetwork, EveryFacetIsAContactInOrder) {
  ASSERT_EQ(network.contacts.size(), tessellation.facets.size());
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    EXPECT_EQ(network.contacts[k].a, tessellation.facets[k].a);
    EXPECT_EQ(network.contacts[k].b, tessellation.facets[k].b);
    EXPECT_EQ(network.contacts[k].area, tessellation.facets[k].area);
  }
  EXPECT_EQ(network.point_s.size(), network.point_t.size());
  EXPECT_EQ(network.point_s.size(), network.point_area.size());
}

/// The lever arms put the reference point x0 into the plane of the facet, and equal the lever arms of Eq. 5–7 of [1].
TEST_F(RandomNetwork, ArmsPutTheReferencePointOnTheFacetsPlane) {
  int outside = 0;
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    const Contact& c = network.contacts[k];
    const Facet& f = tessellation.facets[k];
    const Vec3d x0 = specimen.centre[c.a] + c.arm_a * c.n;
    // The error of a vertex is ε times the size of the box, divided by the flatness of its tetrahedron. Tetrahedra
    // solved in double precision have a flatness of at least 1e-3.
    for (const Vec3d& v : tessellation.polygon(f)) EXPECT_NEAR(dot(v - x0, c.n), 0, 1e-12);
    if (c.b < 0) {
      EXPECT_EQ(c.arm_b, 0);
      EXPECT_EQ(c.arm_a, c.distance);
      continue;
    }
    const double ra = specimen.radius[c.a], rb = specimen.radius[c.b];
    EXPECT_NEAR(norm(specimen.centre[c.b] - c.arm_b * c.n - x0), 0, 1e-15 * (1 + std::abs(c.arm_a)));
    // Eq. 5–7 of [1]: the lever arm is R_a − Un/2 − dv with dv = ½ (R_a − R_b)(d − R_a − R_b)/d.
    const double overlap = ra + rb - c.distance, dv = 0.5 * (ra - rb) * -overlap / c.distance;
    EXPECT_NEAR(c.arm_a, ra - overlap / 2 - dv, 1e-15 * (1 + ra / c.distance));
    outside += c.arm_a < 0 || c.arm_b < 0;
  }
  EXPECT_GT(outside, 0) << "the specimen should contain a centre outside its own cell";
}

/// The areas of a contact's points add up to the area of the facet. Their first moments about x0 add up to the first
/// moment of the facet.
TEST_F(RandomNetwork, PointAreasAndFirstMoments) {
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    const Contact& c = network.contacts[k];
    const Facet& f = tessellation.facets[k];
    const Vec3d x0 = specimen.centre[c.a] + c.arm_a * c.n;
    ASSERT_EQ(c.point_end - c.point_begin, f.vertex_end - f.vertex_begin + 1);
    double area = 0, s = 0, t = 0, reach = 0;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
      // Rounding may leave a facet slightly non-convex. Then a triangle of the fan can have a negative area of about ε
      // times the area of the facet.
      EXPECT_GT(network.point_area[j], -1e-12 * c.area);
      area += network.point_area[j];
      s += network.point_area[j] * network.point_s[j];
      t += network.point_area[j] * network.point_t[j];
      reach = std::max(reach, std::hypot(network.point_s[j], network.point_t[j]));
    }
    // Local coordinates have an error of ε times the sum of the size of the box and the distance to x0. The area of a
    // facet of length l therefore has a relative error of about 1e-16/l.
    const double relative = 1e-14 / std::sqrt(c.area) * (1 + reach);
    EXPECT_NEAR(area, c.area, relative * c.area);
    EXPECT_NEAR(c.moments.a, area, 1e-14 * area);
    EXPECT_NEAR(s, c.area * dot(f.centroid - x0, c.s), relative * c.area * reach);
    EXPECT_NEAR(t, c.area * dot(f.centroid - x0, c.t), relative * c.area * reach);
    EXPECT_NEAR(c.moments.s, s, 1e-14 * c.area * reach);
    EXPECT_NEAR(c.moments.t, t, 1e-14 * c.area * reach);
    // The first point is the first vertex of the polygon, the last point its centroid.
    const Vec3d first = x0 + network.point_s[c.point_begin] * c.s + network.point_t[c.point_begin] * c.t;
    EXPECT_NEAR(norm(first - tessellation.polygon(f)[0]), 0, 1e-12);
    const Vec3d last = x0 + network.point_s[c.point_end - 1] * c.s + network.point_t[c.point_end - 1] * c.t;
    EXPECT_NEAR(norm(last - f.centroid), 0, 1e-12);
  }
}

TEST_F(RandomNetwork, LumpedMomentsAreThoseOfThePoints) {
  for (const Contact& c : network.contacts) {
    double ss = 0, st = 0, tt = 0;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
      ss += network.point_area[j] * network.point_s[j] * network.point_s[j];
      st += network.point_area[j] * network.point_s[j] * network.point_t[j];
      tt += network.point_area[j] * network.point_t[j] * network.point_t[j];
    }
    const double tolerance = 1e-13 * (ss + tt);  // about ten products, each accurate to ε
    EXPECT_NEAR(c.moments.ss, ss, tolerance);
    EXPECT_NEAR(c.moments.st, st, tolerance);
    EXPECT_NEAR(c.moments.tt, tt, tolerance);
  }
}

/// Exact second moments agree with a fine midpoint rule, and are less than the second moments of the contact points
/// (lumped quadrature).
TEST_F(RandomNetwork, ExactMomentsAgreeWithFineQuadrature) {
  spec.quadrature = Quadrature::exact;
  const ContactNetwork exact = build_network(specimen, tessellation, spec);
  // the midpoint rule with m strips per side of each triangle has an error of 1/m² of the squared extent of the facet
  constexpr int m = 40;
  double difference = 0, total = 0;
  for (std::size_t k = 0; k < exact.contacts.size(); k += 7) {
    const Contact& c = exact.contacts[k];
    const double *s = &exact.point_s[c.point_begin], *t = &exact.point_t[c.point_begin];
    const std::size_t n = c.point_end - c.point_begin - 1;
    double ss = 0, st = 0, tt = 0, spread = 0;
    const auto cell = [&](double area, double x, double y) {
      ss += area * x * x, st += area * x * y, tt += area * y * y;
    };
    // Divides the polygon into a fan of triangles from vertex 0. The code under test uses a fan about the centroid.
    for (std::size_t v = 1; v + 1 < n; ++v) {
      const double us = s[v] - s[0], ut = t[v] - t[0], ws = s[v + 1] - s[0], wt = t[v + 1] - t[0];
      const double area = 0.5 * (us * wt - ws * ut) / (m * m);
      const auto at = [&](double p, double q) { cell(area, s[0] + p * us + q * ws, t[0] + p * ut + q * wt); };
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < m - i; ++j) {
          at((i + 1.0 / 3) / m, (j + 1.0 / 3) / m);
          if (j < m - i - 1) at((i + 2.0 / 3) / m, (j + 2.0 / 3) / m);
        }
      spread = std::max({spread, us * us + ut * ut, ws * ws + wt * wt});
    }
    const double tolerance = c.area * spread / (m * m) + 1e-12 * (ss + tt);
    EXPECT_NEAR(c.moments.ss, ss, tolerance);
    EXPECT_NEAR(c.moments.st, st, tolerance);
    EXPECT_NEAR(c.moments.tt, tt, tolerance);
  }
  for (std::size_t k = 0; k < exact.contacts.size(); ++k) {
    const AreaMoments &e = exact.contacts[k].moments, &l = network.contacts[k].moments;
    EXPECT_GE(l.ss + l.tt, e.ss + e.tt);  // vertices lie farther out than the area between them
    difference += l.ss + l.tt - e.ss - e.tt;
    total += e.ss + e.tt;
  }
  EXPECT_NEAR(network.second_moment_difference, difference / total, 1e-10);
  EXPECT_EQ(network.second_moment_difference, exact.second_moment_difference);
  EXPECT_GT(network.second_moment_difference, 0.01);
}

TEST_F(RandomNetwork, RowsListEachContactOfAParticle) {
  ASSERT_EQ(network.row_begin.size(), specimen.size() + 1);
  std::vector<std::vector<std::uint32_t>> expected(specimen.size());
  for (std::uint32_t k = 0; k < network.contacts.size(); ++k) {
    expected[network.contacts[k].a].push_back(k);
    if (network.contacts[k].b >= 0) expected[network.contacts[k].b].push_back(k);
  }
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const auto row = network.row(i);
    EXPECT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()), expected[i]);
  }
}

TEST_F(RandomNetwork, CountsAndPairTypes) {
  std::array<std::int64_t, pair_types> count{};
  for (const Contact& c : network.contacts) ++count[static_cast<std::size_t>(c.pair)];
  EXPECT_EQ(count, network.count);
  for (const std::int64_t n : count) EXPECT_GT(n, 0);
}

TEST_F(RandomNetwork, Filters) {
  double mean = 0;
  std::int64_t particle_facets = 0, wide = 0, small = 0, on_walls = 0;
  for (const Facet& f : tessellation.facets)
    if (f.b >= 0) mean += f.area, ++particle_facets;
  mean /= static_cast<double>(particle_facets);
  const double gap_max = 0.4, area_min = 0.1;
  double lost = 0, kept = 0;
  for (const Facet& f : tessellation.facets) {
    if (f.b < 0) {
      ++on_walls;
      continue;
    }
    const double sum = specimen.radius[f.a] + specimen.radius[f.b];
    const double gap = norm(specimen.centre[f.b] - specimen.centre[f.a]) - sum;
    if (gap > gap_max * sum / 2)
      ++wide;
    else if (f.area < area_min * mean)
      ++small, lost += f.area;
    else
      kept += f.area;
  }
  ASSERT_GT(wide, 0);
  ASSERT_GT(small, 0);
  spec.gap_max = gap_max, spec.area_min = area_min;
  const ContactNetwork n = build_network(specimen, tessellation, spec);
  EXPECT_EQ(n.dropped_gap, wide);
  EXPECT_EQ(n.dropped_area, small);
  EXPECT_DOUBLE_EQ(n.dropped_share, lost / (lost + kept));
  EXPECT_EQ(static_cast<std::int64_t>(n.contacts.size()), particle_facets + on_walls - wide - small);
}

/// A filter limit that is set for one pair type replaces the limit of the network, for this pair type only.
TEST_F(RandomNetwork, LimitsOfOnePair) {
  const auto left = [&](const NetworkSpec& s) { return build_network(specimen, tessellation, s).count; };
  const auto filtered = [&](auto set) {
    NetworkSpec s = spec;
    set(s);
    return left(s);
  };
  const auto all = left(spec);
  const auto none = filtered([](NetworkSpec& s) { s.gap_max = -1.9; });
  for (int k = 0; k < particle_pair_types; ++k) {
    ASSERT_GT(all[k], none[k]) << to_string(static_cast<PairType>(k));
    const auto one = filtered([k](NetworkSpec& s) { s.of_pair[k].gap_max = -1.9; });
    const auto others = filtered([k](NetworkSpec& s) { s.gap_max = -1.9, s.of_pair[k].gap_max = 1e9; });
    const auto large = filtered([k](NetworkSpec& s) { s.of_pair[k].area_min = 1e9; });
    const auto others_large = filtered([k](NetworkSpec& s) { s.area_min = 1e9, s.of_pair[k].area_min = 0; });
    for (int pair = 0; pair < particle_pair_types; ++pair) {
      EXPECT_EQ(one[pair], pair == k ? none[pair] : all[pair]);
      EXPECT_EQ(others[pair], pair == k ? all[pair] : none[pair]);
      EXPECT_EQ(large[pair], pair == k ? 0 : all[pair]);
      EXPECT_EQ(others_large[pair], pair == k ? all[pair] : 0);
    }
  }
}

TEST(ContactNetwork, PairTypesOfAChain) {
  Specimen s;
  s.box.size = {1, 1, 6};
  const auto z = [](int k) { return Vec3d{0.5, 0.5, k + 0.5}; };
  add(s, z(0), 0.5, Phase::aggregate, 3);
  add(s, z(1), 0.5, Phase::aggregate, 3);
  add(s, z(2), 0.5, Phase::aggregate, 4);
  add(s, z(3), 0.5);
  add(s, z(4), 0.5, Phase::aggregate, 5);
  add(s, z(5), 0.5);
  const ContactNetwork n = build_network(s, tessellate(s));
  std::vector<std::string> names;
  for (const Contact& c : n.contacts) names.emplace_back(to_string(c.pair));
  EXPECT_EQ(names, (std::vector<std::string>{"A-W", "inner", "A-A", "M-A", "M-A", "M-A", "M-W"}));
  EXPECT_STREQ(to_string(PairType::mm), "M-M");
}

TEST(ContactNetwork, CubicLattice) {
  const int n = 4;
  const double a = 0.007;
  const Specimen s = cubic(n, a);
  const Tessellation t = tessellate(s);
  const ContactNetwork network = build_network(s, t);
  EXPECT_EQ(network.contacts.size(), static_cast<std::size_t>(3 * n * n * (n - 1) + 2 * n * n));
  EXPECT_EQ(network.count[static_cast<int>(PairType::mw)], 2 * n * n);
  // coordinates up to four lattice spacings are accurate to ε, and so are their products
  constexpr double relative = 1e-12;
  for (const Contact& c : network.contacts) {
    EXPECT_NEAR(c.distance, c.b < 0 ? a / 2 : a, relative * a);
    EXPECT_NEAR(c.arm_a, a / 2, relative * a);
    EXPECT_NEAR(c.area, a * a, relative * a * a);
    ASSERT_EQ(c.point_end - c.point_begin, 5U);
    // Each corner has a third of the area of two triangles of a²/4, and the centroid has a third of all four triangles.
    // So the lumped second moment is 4·(a²/6)·(a/2)² = a⁴/6; the exact one is a⁴/12.
    for (std::uint32_t j = c.point_begin; j < c.point_begin + 4; ++j)
      EXPECT_NEAR(network.point_area[j], a * a / 6, relative * a * a);
    EXPECT_NEAR(network.point_area[c.point_begin + 4], a * a / 3, relative * a * a);
    const double a4 = a * a * a * a;
    EXPECT_NEAR(c.moments.ss, a4 / 6, relative * a4);
    EXPECT_NEAR(c.moments.tt, a4 / 6, relative * a4);
    EXPECT_NEAR(c.moments.st, 0, relative * a4);
    EXPECT_NEAR(c.moments.s, 0, relative * a * a * a);
  }
  EXPECT_NEAR(network.second_moment_difference, 1, relative);
  const ContactNetwork all = build_network(s, t, walls(true, true));
  EXPECT_EQ(all.contacts.size(), static_cast<std::size_t>(3 * n * n * (n - 1) + 6 * n * n));
  const ContactNetwork none = build_network(s, t, walls(false, false));
  EXPECT_EQ(none.contacts.size(), static_cast<std::size_t>(3 * n * n * (n - 1)));
}

TEST(ContactNetwork, WallContact) {
  Specimen s;
  s.box.size = {1, 1, 1};
  add(s, {0.5, 0.25, 0.3}, 0.2);
  const ContactNetwork n = build_network(s, tessellate(s));
  ASSERT_EQ(n.contacts.size(), 2U);
  const Contact &top = n.contacts[0], &bottom = n.contacts[1];
  EXPECT_EQ(top.b, wall_z_hi);
  EXPECT_EQ(bottom.b, wall_z_lo);
  EXPECT_DOUBLE_EQ(top.distance, 0.7);
  EXPECT_DOUBLE_EQ(bottom.arm_a, 0.3);
  EXPECT_EQ(top.n.z, 1);
  EXPECT_EQ(bottom.n.z, -1);
  // The origin is the foot of the perpendicular, (0.5, 0.25). The first moment of a unit square about it is 0.25.
  EXPECT_NEAR(std::hypot(top.moments.s, top.moments.t), 0.25, 1e-15);
}

TEST(ContactNetwork, CentreOnALoadedWallIsNamed) {
  Specimen s = cubic(3, 0.01);
  s.centre[4].z = 0;
  EXPECT_NE(message(s).find("particle 4"), std::string::npos) << message(s);
  EXPECT_NE(message(s).find("-z wall"), std::string::npos) << message(s);
  EXPECT_EQ(message(s, walls(false, false)), "no error");
  s = cubic(3, 0.01);
  s.centre[26].z = s.box.size.z - 1e-10 * s.radius[26];
  EXPECT_NE(message(s).find("particle 26"), std::string::npos) << message(s);
  s = cubic(3, 0.01);
  s.centre[0].x = 0;  // lateral walls are not contacts by default, so a centre may lie on them
  EXPECT_EQ(message(s), "no error");
  EXPECT_NE(message(s, walls(true, true)).find("particle 0"), std::string::npos);
}

TEST(ContactNetwork, HiddenParticlesAreNamed) {
  Specimen s;
  s.box.size = {1, 1, 1};
  add(s, {0.5, 0.5, 0.5}, 0.4);
  for (int i = 0; i < 12; ++i) add(s, {0.45 + 0.005 * i, 0.51, 0.5}, 1e-3);
  const std::string text = message(s);
  EXPECT_NE(text.find("12 without"), std::string::npos) << text;
  EXPECT_NE(text.find("1, 2, 3, 4, 5, 6, 7, 8, 9, 10, …"), std::string::npos) << text;
  EXPECT_EQ(text.find("11"), std::string::npos) << text;
}

TEST(ContactNetwork, MessagesNameFileAndLine) {
  Specimen s = cubic(3, 0.01);
  s.source = "stones.csv", s.first_line = 2;
  s.centre[4].z = 0;
  EXPECT_EQ(message(s).rfind("stones.csv:6: distance between the centre of particle 4 and the -z wall", 0), 0U)
      << message(s);
  s = cubic(3, 0.01);
  s.source = "stones.csv", s.first_line = 2;
  s.radius[13] = 1e-6, s.centre[13] = s.centre[12] + Vec3d{1e-6, 0, 0};
  EXPECT_EQ(message(s).rfind("stones.csv:15: Laguerre cells inside the box: found no cell for 1 of ", 0), 0U)
      << message(s);
}

TEST(ContactNetwork, NothingLeftIsAnError) {
  Specimen s = cubic(2, 0.01);
  for (double& r : s.radius) r *= 0.5;
  const NetworkSpec no_contact = filters(0.1, {});
  EXPECT_NE(message(s, no_contact).find("12 dropped by gap_max"), std::string::npos) << message(s, no_contact);
  EXPECT_NE(message(s, filters({}, -1)).find("area_min"), std::string::npos);
  EXPECT_NE(message(s, filters(NAN, {})).find("gap_max"), std::string::npos);
  NetworkSpec of_pair;
  of_pair.of_pair[static_cast<int>(PairType::aa)].area_min = -1;
  EXPECT_NE(message(s, of_pair).find("area_min of A-A"), std::string::npos);
}

TEST(ContactNetwork, TessellationOfAnotherSpecimenIsRefused) {
  const Specimen s = cubic(2, 0.01);
  EXPECT_THROW(build_network(s, tessellate(cubic(3, 0.01))), InputError);
}

// A network with more contacts than 32 bits can count does not fit on a test machine, so only the conversion that
// guards the counts is tested.
TEST(ContactNetwork, CountsBeyond32BitsAreRefused) {
  EXPECT_EQ(counted<std::uint32_t>(4294967295u, "contact points"), 4294967295u);
  EXPECT_THROW(counted<std::uint32_t>(std::size_t{4294967296u}, "contact points"), RunError);
  EXPECT_THROW(counted<int>(std::size_t{2147483648u}, "entries of the stiffness"), RunError);
}

}  // namespace
}  // namespace macadam
