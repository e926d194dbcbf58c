// SPDX-License-Identifier: GPL-3.0-or-later
// rock_lengths_test.cpp  Compares the lengths of lines of centres in rock, and the stiffness that follows from them by
// the rule "series", with closed forms.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "host/network/rock_lengths.hpp"
#include "host/spheres/random_stream.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

constexpr double rock = 60e9, nu = 0.35;

/// A specimen to which spheres are added one by one, in a box with edges of 20 mm.
struct Spheres : Specimen {
  Spheres() { box.size = {0.02, 0.02, 0.02}; }
  std::int32_t mastic(const Vec3d& c, double r) { return add(c, r, Phase::mastic, -1); }
  std::int32_t aggregate(const Vec3d& c, double r, std::int32_t number) { return add(c, r, Phase::aggregate, number); }

 private:
  std::int32_t add(const Vec3d& c, double r, Phase p, std::int32_t number) {
    centre.push_back(c), radius.push_back(r), phase.push_back(p), body.push_back(number);
    return static_cast<std::int32_t>(size()) - 1;
  }
};

Contact between(const Specimen& s, std::int32_t a, std::int32_t b, PairType pair) {
  Contact c;
  c.a = a, c.b = b, c.pair = pair;
  const Vec3d line = s.centre[static_cast<std::size_t>(b)] - s.centre[static_cast<std::size_t>(a)];
  c.distance = c.length = norm(line);
  c.n = (1 / c.distance) * line;
  return c;
}

Contact on_top_wall(const Specimen& s, std::int32_t a, PairType pair) {
  Contact c;
  c.a = a, c.b = wall_z_hi, c.pair = pair;
  c.distance = c.length = s.box.size.z - s.centre[static_cast<std::size_t>(a)].z;
  c.n = {0, 0, 1};
  return c;
}

/// Returns the contact with its length and compliance.
Contact applied(const Specimen& s, const Contact& c, const RockSurfaces& surfaces) {
  ContactNetwork network;
  network.contacts = {c};
  apply_series(network, s, surfaces, rock, nu);
  EXPECT_EQ(network.rule, ContactRule::series);
  return network.contacts[0];
}

/// Returns the normal stiffness per area of a contact whose law has the modulus E [Pa/m].
double normal(const Contact& c, double E) { return E / (1 + c.series * E) / c.length; }
double shear(const Contact& c, double E, double alpha) { return alpha * E / (1 + alpha * c.series * E) / c.length; }

/// Returns an aggregate whose surface is the first of a list.
Aggregate shaped(std::int32_t number, const Pose& pose) {
  Aggregate a;
  a.body = number, a.shape = "box", a.surface = 0, a.pose = pose, a.centre = pose.centre, a.size = pose.scale;
  return a;
}

/// Returns a cube with edges of 1 about the origin.
Surface unit_cube() {
  Surface s = box_surface(1, 1, 1);
  for (Vec3d& p : s.points) p -= {0.5, 0.5, 0.5};
  return s;
}

constexpr double near = 1e-14;  // [m], for lengths of millimetres

TEST(RockLengths, MasticBetweenTwoBalls) {
  Spheres s;
  const auto left = s.aggregate({0.004, 0.01, 0.01}, 0.003, 0);
  const auto middle = s.mastic({0.0082, 0.01, 0.01}, 0.001);
  const auto right = s.aggregate({0.013, 0.01, 0.01}, 0.004, 1);
  const RockSurfaces surfaces(s, {}, {});
  const Contact ma = applied(s, between(s, left, middle, PairType::ma), surfaces);
  EXPECT_NEAR(ma.length, 0.0042 - 0.003, near);
  EXPECT_NEAR(normal(ma, 5e9), 1 / (0.0012 / 5e9 + 0.003 / rock), 1e-12 / (0.0012 / 5e9));
  // M-A: the mastic has at least 0.05 and at most 0.95 of the distance; here it has 0.0008 of 0.0048.
  EXPECT_NEAR(applied(s, between(s, middle, right, PairType::ma), surfaces).length, 0.0008, near);

  const Contact aa = applied(s, between(s, left, right, PairType::aa), surfaces);
  const double g = 0.009 - 0.007, E = 5e9, mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  const double kn = 1 / (0.007 / rock + g / (lambda + 2 * mu)), ks = 1 / (0.007 / rock + g / mu);
  EXPECT_NEAR(normal(aa, E), kn, 1e-12 * kn);
  EXPECT_NEAR(shear(aa, E, (1 - 2 * nu) / (2 * (1 - nu))), ks, 1e-12 * ks);
}

TEST(RockLengths, AreLimited) {
  Spheres s;
  const auto stone = s.aggregate({0.01, 0.01, 0.01}, 0.004, 0);
  const auto inside = s.mastic({0.0135, 0.01, 0.01}, 0.001);     // centre in the stone
  const auto grazing = s.mastic({0.01405, 0.01, 0.01}, 0.0005);  // 0.05 mm from it
  const auto pebble = s.aggregate({0.017, 0.01, 0.01}, 1e-5, 1);
  const RockSurfaces surfaces(s, {}, {});
  EXPECT_EQ(mastic_centres_in_rock(s, surfaces), 1);
  EXPECT_DOUBLE_EQ(applied(s, between(s, stone, inside, PairType::ma), surfaces).length, 0.05 * 0.0035);
  const Contact thin = applied(s, between(s, stone, grazing, PairType::ma), surfaces);
  EXPECT_EQ(thin.length, 0.05 * thin.distance);
  EXPECT_NEAR(thin.series, 19 / rock, 1e-13 / rock);
  const Contact far = applied(s, between(s, grazing, pebble, PairType::ma), surfaces);
  EXPECT_EQ(far.length, 0.95 * far.distance);
}

TEST(RockLengths, BallsThatTouchOrOverlapHaveNoFilm) {
  for (const double overlap : {0.0, 0.5e-3}) {
    Spheres s;
    const auto a = s.aggregate({0.006, 0.01, 0.01}, 0.003, 0);
    const auto b = s.aggregate({0.012 - overlap, 0.01, 0.01}, 0.003, 1);
    const Contact c = applied(s, between(s, a, b, PairType::aa), RockSurfaces(s, {}, {}));
    EXPECT_NEAR(c.length, 1e-9 * c.distance * (1 + nu) * (1 - 2 * nu) / (1 - nu), 1e-15);
    EXPECT_NEAR(normal(c, 5e9), rock / c.distance, 1e-7 * rock / c.distance);
  }
}

TEST(RockLengths, CountOverlapsOnce) {
  Spheres s;
  const auto a = s.mastic({0.002, 0.01, 0.01}, 0.001), b = s.mastic({0.018, 0.01, 0.01}, 0.001);
  s.aggregate({0.008, 0.01, 0.01}, 0.002, 0);
  s.aggregate({0.010, 0.01, 0.01}, 0.002, 0);  // the same aggregate
  s.aggregate({0.011, 0.01, 0.01}, 0.002, 1);
  s.aggregate({0.010, 0.015, 0.01}, 0.005, 2);  // touches the line
  const RockSurfaces surfaces(s, {}, {});
  EXPECT_NEAR(surfaces.fraction_inside(s.centre[0], s.centre[1]), 0.007 / 0.016, 1e-13);
  const Contact c = applied(s, between(s, a, b, PairType::mm), surfaces);
  EXPECT_NEAR(c.length, 0.009, near);
  EXPECT_NEAR(c.series, 0.007 / (0.009 * rock), 1e-12 * c.series);
}

TEST(RockLengths, LinesInMasticKeepTheirDistance) {
  Spheres s;
  const auto a = s.mastic({0.0021, 0.0053, 0.0097}, 0.001), b = s.mastic({0.0035, 0.0047, 0.0101}, 0.001);
  const RockSurfaces surfaces(s, {}, {});
  const Contact mm = applied(s, between(s, a, b, PairType::mm), surfaces);
  EXPECT_EQ(mm.length, mm.distance);
  EXPECT_EQ(mm.series, 0);
  const Contact mw = applied(s, on_top_wall(s, a, PairType::mw), surfaces);
  EXPECT_EQ(mw.length, mw.distance);
  EXPECT_EQ(mw.series, 0);
}

TEST(RockLengths, WallsAndInnerContacts) {
  Spheres s;
  const auto mastic = s.mastic({0.01, 0.01, 0.015}, 0.001);
  const auto one = s.aggregate({0.01, 0.01, 0.018}, 0.001, 0), two = s.aggregate({0.011, 0.01, 0.018}, 0.001, 0);
  const RockSurfaces surfaces(s, {}, {});
  EXPECT_NEAR(applied(s, on_top_wall(s, mastic, PairType::mw), surfaces).length, 0.003, near);
  for (const Contact& c : {on_top_wall(s, one, PairType::aw), between(s, one, two, PairType::inner)}) {
    const Contact kept = applied(s, c, surfaces);
    EXPECT_EQ(kept.length, c.distance);
    EXPECT_EQ(kept.series, 0);
  }
}

// A segment through a cube at an angle; its length inside follows from the planes of two faces.
TEST(RockLengths, CrossACubeAtAnAngle) {
  Spheres s;
  const Vec3d middle{0.01, 0.01, 0.01};
  s.aggregate(middle, 0.001, 0);
  const double turn = 0.3, edge = 0.006;
  const Pose pose{middle, {std::cos(turn / 2), 0, 0, std::sin(turn / 2)}, edge};
  const std::vector<Surface> cube{unit_cube()};
  const std::vector<Aggregate> aggregates{shaped(0, pose)};
  const RockSurfaces surfaces(s, aggregates, cube);
  // along x through the middle: the cube is turned about z
  EXPECT_NEAR(surfaces.fraction_inside({0.001, 0.01, 0.01}, {0.019, 0.01, 0.01}), edge / std::cos(turn) / 0.018, 1e-13);
  // from the middle outwards, in the plane of the axis
  const Vec3d out{0.01 + 0.008 * std::cos(turn), 0.01 + 0.008 * std::sin(turn), 0.01};
  EXPECT_NEAR(surfaces.fraction_inside(middle, out), 0.003 / 0.008, 1e-13);
  EXPECT_TRUE(surfaces.contains({0.01, 0.01, 0.0125}));
  EXPECT_FALSE(surfaces.contains({0.01, 0.01, 0.0135}));  // inside the ball about the cube
  EXPECT_EQ(surfaces.fraction_inside({0.01, 0.01, 0.0135}, {0.01, 0.01, 0.019}), 0);
}

// Lines that begin on a face, run in a face or along an edge, or pass through a corner or through a diagonal of a face.
TEST(RockLengths, TouchSurfaces) {
  Spheres s;
  s.aggregate({0.01, 0.01, 0.01}, 0.001, 0);
  const std::vector<Surface> cube{unit_cube()};
  const std::vector<Aggregate> aggregates{shaped(0, {{0.01, 0.01, 0.01}, {1, 0, 0, 0}, 0.0078125})};
  const RockSurfaces surfaces(s, aggregates, cube);
  const double h = 0.00390625, m = 0.01;
  EXPECT_NEAR(surfaces.fraction_inside({m + h, m, m}, {m + 2 * h, m, m}), 0, 1e-12);
  EXPECT_NEAR(surfaces.fraction_inside({m + h, m, m}, {m - h, m, m}), 1, 1e-12);
  EXPECT_NEAR(surfaces.fraction_inside({m - 2 * h, m - 2 * h, m - 2 * h}, {m + 2 * h, m + 2 * h, m + 2 * h}), 0.5,
              1e-12);
  EXPECT_NEAR(surfaces.fraction_inside({m - 2 * h, m, m - 2 * h}, {m + 2 * h, m, m + 2 * h}), 0.5, 1e-12);
  EXPECT_NEAR(surfaces.fraction_inside({m, m, m}, {m + 1.5 * h, m + 0.1 * h, m}), 1 / 1.5, 1e-12);
  EXPECT_NEAR(surfaces.fraction_inside({m + h * (1 + 1e-9), m - 2 * h, m}, {m + h * (1 + 1e-9), m + 2 * h, m}), 0,
              1e-12);
}

// A ball that spheres fill is a ball; an aggregate that nothing is known of has the surfaces of its spheres.
TEST(RockLengths, UseTheBallThatASpecimenKnows) {
  Spheres s;
  s.aggregate({0.009, 0.01, 0.01}, 0.001, 0);
  s.aggregate({0.011, 0.01, 0.01}, 0.001, 0);
  Aggregate ball;
  ball.body = 0, ball.shape = "sphere", ball.size = 0.006, ball.centre = {0.01, 0.01, 0.01};
  const Vec3d p{0.002, 0.01, 0.01}, q{0.018, 0.01, 0.01};
  EXPECT_NEAR(RockSurfaces(s, {}, {}).fraction_inside(p, q), 0.004 / 0.016, 1e-13);
  EXPECT_NEAR(RockSurfaces(s, {&ball, 1}, {}).fraction_inside(p, q), 0.006 / 0.016, 1e-13);
}

// Many lines through many bodies, against a test of every body for every line, and with one and several threads.
TEST(RockLengths, MissNoBodyAndDoNotDependOnThreads) {
  Spheres s;
  RandomStream random(3, 0);
  const std::vector<Surface> cube{unit_cube()};
  std::vector<Aggregate> aggregates;
  const auto point = [&] { return Vec3d{0.02 * random.uniform(), 0.02 * random.uniform(), 0.02 * random.uniform()}; };
  for (std::int32_t k = 0; k < 40; ++k) {
    const Vec3d c = point();
    s.aggregate(c, 0.0005 + 0.002 * random.uniform(), k);
    if (k % 2) continue;
    std::array<double, 4> q{random.uniform(), random.uniform(), random.uniform(), random.uniform()};
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& part : q) part /= size;
    aggregates.push_back(shaped(k, {c, q, 0.001 + 0.003 * random.uniform()}));
  }
  const RockSurfaces all(s, aggregates, cube);
  ContactNetwork network;
  for (int k = 0; k < 6000; ++k) {
    const auto a = s.mastic(point(), 1e-4), b = s.mastic(point(), 1e-4);
    network.contacts.push_back(between(s, a, b, PairType::mm));
  }
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<double> one = rock_lengths(network, s, all);
  omp_set_num_threads(4);
  EXPECT_EQ(one, rock_lengths(network, s, all));
  omp_set_num_threads(threads);
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    const Contact& c = network.contacts[k];
    const Vec3d &p = s.centre[static_cast<std::size_t>(c.a)], &q = s.centre[static_cast<std::size_t>(c.b)];
    sum += one[k], total += c.distance;
    if (k % 20) continue;
    constexpr int points = 2000;
    int inside = 0;
    for (int i = 0; i < points; ++i) inside += all.contains(p + ((i + 0.5) / points) * (q - p)) ? 1 : 0;
    EXPECT_NEAR(one[k] / c.distance, inside / static_cast<double>(points), 0.01) << k;
  }
  EXPECT_GT(sum, 0.02 * total);
}

}  // namespace
}  // namespace macadam::test
