// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tessellation_test.cpp  Tests tessellations of few particles, of degenerate and difficult input, and of random
/// specimens.
#include "macadam/tessellation.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <random>

#include "macadam/error.hpp"
#include "tests/support/test_spheres.hpp"
#include "tests/tessellation/tessellation_checks.hpp"

namespace macadam {
namespace {

using test::add, test::facets_of, test::expect_invariants, test::expect_order_and_orientation, test::empty_box,
    test::facet_tolerance;

/// Returns n spheres at random positions in a box of 1 × 0.7 × 1.3, with radii from `smallest` to `largest` on a
/// logarithmic scale.
Specimen random_specimen(int n, double smallest, double largest, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> u(0, 1);
  Specimen s = empty_box({1, 0.7, 1.3});
  for (int i = 0; i < n; ++i) {
    const double r = smallest * std::pow(largest / smallest, u(engine));
    add(s, {u(engine), 0.7 * u(engine), 1.3 * u(engine)}, r);
  }
  return s;
}

// Few particles

TEST(Tessellation, OneParticleOwnsTheBox) {
  for (const Vec3d& p : {Vec3d{0.3, 0.4, 0.5}, Vec3d{0, 0, 0}, Vec3d{1, 0.4, 0}, Vec3d{1, 2, 3}}) {
    Specimen s = empty_box({1, 2, 3});
    add(s, p, 0.1);
    const Tessellation t = tessellate(s);
    ASSERT_EQ(t.facets.size(), 6U);
    const double area[] = {2, 3, 3, 6, 6, 2};
    std::vector<double> found;
    for (const Facet& f : t.facets) found.push_back(f.area);
    EXPECT_EQ(t.facets.front().b, wall_z_hi);
    EXPECT_DOUBLE_EQ(found[0], area[0]);
    EXPECT_DOUBLE_EQ(std::accumulate(found.begin(), found.end(), 0.0), 22);
    EXPECT_DOUBLE_EQ(t.cell_volume[0], 6);
    expect_invariants(s, t);
    expect_order_and_orientation(t);
  }
}

TEST(Tessellation, TwoParticlesWithTheWeightedPlane) {
  Specimen s = empty_box({1, 1, 1});
  add(s, {0.25, 0.5, 0.5}, 0.3);
  add(s, {0.75, 0.5, 0.5}, 0.1);
  const Tessellation t = tessellate(s);
  EXPECT_EQ(t.facets.size(), 11U);
  const Facet& f = *std::find_if(t.facets.begin(), t.facets.end(), [](const Facet& g) { return g.b == 1; });
  const double x = 0.25 + (0.25 + 0.09 - 0.01) / (2 * 0.5);  // h = (d² + R_a² − R_b²)/(2d)
  EXPECT_NEAR(f.centroid.x, x, 1e-15);
  EXPECT_NEAR(f.centroid.y, 0.5, 1e-15);
  EXPECT_NEAR(f.area, 1, 1e-15);
  EXPECT_DOUBLE_EQ(f.normal.x, 1);
  EXPECT_NEAR(t.cell_volume[0], x, 1e-15);
  expect_invariants(s, t);
}

TEST(Tessellation, CentreOutsideItsOwnCell) {
  Specimen s = empty_box({1, 1, 1});
  add(s, {0.5, 0.5, 0.5}, 0.4);
  add(s, {0.6, 0.5, 0.5}, 0.3);  // the facet is at 0.5 + (0.01 + 0.16 − 0.09)/0.2 = 0.9
  const Tessellation t = tessellate(s);
  EXPECT_NEAR(t.cell_volume[0], 0.9, 1e-14);
  EXPECT_NEAR(t.cell_volume[1], 0.1, 1e-14);
  expect_invariants(s, t);
}

// Degenerate positions

TEST(Tessellation, CollinearCentresGiveSlabs) {
  Specimen s = empty_box({1, 1, 1});
  for (int i = 0; i < 9; ++i) add(s, {0.1 * (i + 1), 0.3, 0.7}, 0.05);
  const Tessellation t = tessellate(s);
  for (int i = 0; i + 1 < 9; ++i) EXPECT_NEAR(facets_of(t, i).at(i + 1).first, 1, facet_tolerance);
  EXPECT_EQ(t.facets.size(), 8U + 9 * 4 + 2);
  expect_invariants(s, t);
}

TEST(Tessellation, CoplanarAndCosphericalCentres) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> u(0, 1);
  std::normal_distribution<double> g;
  Specimen plane = empty_box({1, 1, 1}), ball = empty_box({1, 1, 1});
  for (int i = 0; i < 300; ++i) {
    add(plane, {u(engine), u(engine), 0.3}, 0.02);
    Vec3d v{g(engine), g(engine), g(engine)};
    add(ball, Vec3d{0.5, 0.5, 0.5} + (0.4 / norm(v)) * v, 0.02);
  }
  const Tessellation prisms = tessellate(plane);
  for (const Facet& f : prisms.facets) {
    if (f.b >= 0) { EXPECT_EQ(prisms.polygon(f).size(), 4U); }
  }
  expect_invariants(plane, prisms);
  const Tessellation cones = tessellate(ball);  // all cells meet in the centre of the ball
  EXPECT_TRUE(cones.hidden.empty());
  expect_invariants(ball, cones);
}

TEST(Tessellation, ThinFacetsAreKeptAndRoundingIsNot) {
  // One corner of a square of centres is pushed in by δ. The cell of this corner then touches the cell of the opposite
  // corner in a strip from (½, ½ − δ) to (½ − δ, ½). The ends of the strip are equidistant from three corners.
  for (const double delta : {1e-3, 1e-6, 1e-8, 0.0, 1e-14}) {
    Specimen s = empty_box({2, 2, 1});
    for (const Vec3d& p : {Vec3d{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.5, 1.5, 0.5}, {1.5 - delta, 1.5 - delta, 0.5}})
      add(s, p, 0.5);
    const Tessellation t = tessellate(s);
    const auto facets = facets_of(t, 0);
    if (delta < 1e-12) {
      EXPECT_EQ(facets.count(3), 0U) << delta;
      continue;
    }
    ASSERT_EQ(facets.count(3), 1U) << delta;
    EXPECT_NEAR(facets.at(3).first, std::numbers::sqrt2 * delta, 2e-15) << delta;  // tolerance: a few ε of the box
    expect_invariants(s, t);
  }
}

TEST(Tessellation, NearlyCoincidentCentresAreNamedWithTheirDistance) {
  Specimen s = random_specimen(200, 0.05, 0.05, 3);
  s.source = "stones.csv", s.first_line = 2;
  for (const double distance : {1e-3, 1e-6}) {  // the radius is 0.05
    s.centre[117] = s.centre[40] + Vec3d{0, 0, distance};
    EXPECT_NO_THROW(tessellate(s)) << distance;
  }
  for (const double distance : {4e-7, 1e-9, 1e-15, 1e-200, 5e-324}) {
    Specimen near = s;
    if (distance < 1e-20) near.centre[40].z = 0;
    near.centre[117] = near.centre[40] + Vec3d{0, 0, distance};
    try {
      tessellate(near);
      ADD_FAILURE() << "accepted " << distance;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what())
                    .rfind("stones.csv:119: distance between the centres of particles 40 and "
                           "117: found ",
                           0),
                0U)
          << error.what();
    }
  }
}

TEST(Tessellation, NamesFileAndLine) {
  Specimen s = random_specimen(20, 0.05, 0.05, 3);
  s.source = "stones.csv", s.first_line = 2;
  const auto message = [](const Specimen& specimen) -> std::string {
    try {
      tessellate(specimen);
      return "accepted";
    } catch (const InputError& error) { return error.what(); }
  };
  Specimen bad = s;
  bad.radius[7] = 1e9;
  EXPECT_EQ(message(bad).rfind("stones.csv:9: radius in metres of particle 7: found 1000000000", 0), 0U)
      << message(bad);
  bad.radius[7] = -1;
  EXPECT_EQ(message(bad).rfind("stones.csv:9: particle 7: radius: found -1", 0), 0U) << message(bad);
}

// Hidden particles

TEST(Tessellation, HiddenParticlesAreNamed) {
  Specimen s = empty_box({1, 1, 1});
  add(s, {0.50, 0.5, 0.5}, 0.3);
  add(s, {0.52, 0.5, 0.5}, 0.01);  // hidden by particle 0 in the whole box: its cell would be beyond x = 2.7
  add(s, {0.2, 0.2, 0.2}, 0.1);
  add(s, {0.205, 0.2, 0.2}, 0.02);  // hidden by 0 and 2
  const Tessellation t = tessellate(s);
  EXPECT_EQ(t.hidden, (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(particles_without_cell(s), t.hidden);
  EXPECT_EQ(t.cell_volume[1], 0);
  for (const Facet& f : t.facets) EXPECT_TRUE(f.a % 2 == 0 && (f.b < 0 || f.b % 2 == 0));
  expect_invariants(s, t);
}

TEST(Tessellation, SheetsOfRoundingAreNotCells) {
  // With R_a² − R_b² = d² (exact in binary) the facets a–b and b–c coincide, so the cell of b has no thickness. The
  // loop also tests radii of b that are larger by a rounding error, and one radius with which b has a cell.
  for (const double more : {0.0, 1e-15, -1e-15, 1e-13, 1e-6}) {
    Specimen s = empty_box({1, 1, 1});
    add(s, {0.25, 0.5, 0.5}, 0.3125);
    add(s, {0.50, 0.5, 0.5}, 0.1875 * (1 + more));
    add(s, {0.75, 0.5, 0.5}, 0.3125);
    const Tessellation t = tessellate(s);
    const bool open = more > 1e-9;
    EXPECT_EQ(t.hidden.size(), open ? 0U : 1U) << more;
    EXPECT_EQ(facets_of(t, 0).count(2), open ? 0U : 1U) << more;
    expect_invariants(s, t);
  }
}

TEST(Tessellation, CellThatOnlyTouchesTheWallIsHidden) {
  Specimen s = empty_box({1, 1, 1});
  add(s, {0.5, 0.5, 0.5}, 0.5);  // the facet is at 0.5 + (1/16 + 1/4 − 1/16)/(1/2) = 1, on the wall
  add(s, {0.75, 0.5, 0.5}, 0.25);
  const Tessellation t = tessellate(s);
  EXPECT_EQ(t.hidden, std::vector<std::int32_t>{1});
  EXPECT_EQ(t.facets.size(), 6U);
  expect_invariants(s, t);
}

// Random specimens

class RandomSpecimen : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(RadiusRatio, RandomSpecimen, ::testing::Values(1.0, 5.0, 50.0));

TEST_P(RandomSpecimen, FacetsBelongToTheirTwoParticles) {
  const Specimen s = random_specimen(400, 0.004, 0.004 * GetParam(), 11);
  const Tessellation t = tessellate(s);
  // loose tolerance: the smallest distances between random centres are 1e-2 of the spacing or less
  expect_invariants(s, t, 1e-9);
  expect_order_and_orientation(t);
  std::vector<std::uint8_t> hidden(s.size(), 0);
  for (const auto i : t.hidden) hidden[i] = 1;
  const auto power = [&](std::size_t i, const Vec3d& x) {
    const Vec3d v = x - s.centre[i];
    return dot(v, v) - s.radius[i] * s.radius[i];
  };
  // at the centroid of a facet no particle is nearer in power distance than the two owners
  for (const Facet& f : t.facets) {
    const double own = power(f.a, f.centroid);
    for (std::size_t i = 0; i < s.size(); ++i) ASSERT_GE(power(i, f.centroid), own - 1e-13) << f.a << ' ' << f.b;
    ASSERT_FALSE(hidden[f.a] || (f.b >= 0 && hidden[f.b]));
  }
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (int k = 0; k < 2000; ++k) {  // the particle that owns a point must have a cell
    const Vec3d x{u(engine), 0.7 * u(engine), 1.3 * u(engine)};
    std::size_t owner = 0;
    for (std::size_t i = 1; i < s.size(); ++i)
      if (power(i, x) < power(owner, x)) owner = i;
    ASSERT_FALSE(hidden[owner]) << owner;
  }
  if (GetParam() == 1) { EXPECT_TRUE(t.hidden.empty()); }
  if (GetParam() == 50) { EXPECT_FALSE(t.hidden.empty()); }
}

TEST(Tessellation, LengthUnitDoesNotMatter) {
  const Specimen s = random_specimen(200, 0.02, 0.1, 5);
  Specimen scaled = s;
  const double factor = 0x1p-30;  // a power of two, so that scaling is exact
  scaled.box.size = factor * s.box.size;
  for (auto& p : scaled.centre) p = factor * p;
  for (auto& r : scaled.radius) r *= factor;
  const Tessellation t = tessellate(s), u = tessellate(scaled);
  ASSERT_EQ(t.facets.size(), u.facets.size());
  for (std::size_t k = 0; k < t.facets.size(); ++k) EXPECT_EQ(u.facets[k].area, factor * factor * t.facets[k].area);
}

TEST(Tessellation, SameBitsEveryTimeAndForAnyNumberOfThreads) {
  const Specimen s = random_specimen(1500, 0.01, 0.1, 17);
  const auto run = [&](int threads) {
#ifdef _OPENMP
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    const Tessellation t = tessellate(s);
    omp_set_num_threads(before);
    return t;
#else
    return (void)threads, tessellate(s);
#endif
  };
  const Tessellation one = run(1);
  for (const int threads : {1, 2, 5}) {
    const Tessellation t = run(threads);
    ASSERT_EQ(t.vertices.size(), one.vertices.size());
    EXPECT_EQ(std::memcmp(t.vertices.data(), one.vertices.data(), t.vertices.size() * sizeof(Vec3d)), 0);
    ASSERT_EQ(t.facets.size(), one.facets.size());
    for (std::size_t k = 0; k < t.facets.size(); ++k) {
      EXPECT_TRUE(t.facets[k].a == one.facets[k].a && t.facets[k].b == one.facets[k].b);
      EXPECT_EQ(t.facets[k].area, one.facets[k].area);
    }
    EXPECT_EQ(t.cell_volume, one.cell_volume);
    EXPECT_EQ(t.hidden, one.hidden);
    EXPECT_EQ(t.null_facets, one.null_facets);
  }
}

TEST(Tessellation, BadInputIsNamed) {
  const auto message = [](const Specimen& s) -> std::string {
    try {
      tessellate(s);
    } catch (const InputError& e) { return e.what(); }
    return "no error";
  };
  Specimen s = random_specimen(20, 0.02, 0.05, 1);
  s.centre[7].x = 2;
  EXPECT_NE(message(s).find("particle 7"), std::string::npos) << message(s);
  s = random_specimen(20, 0.02, 0.05, 1);
  s.radius[9] = 1e200;  // its square would overflow
  EXPECT_NE(message(s).find("particle 9"), std::string::npos) << message(s);
}

}  // namespace
}  // namespace macadam
