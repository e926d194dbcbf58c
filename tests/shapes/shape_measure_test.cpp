// SPDX-License-Identifier: GPL-3.0-or-later
// shape_measure_test.cpp  Compares dimensions, volumes and indices of shapes with closed forms and with a calliper in
// random directions. D^L, D^I and D^S are the long, intermediate and short dimension: the longest chord, the longest
// chord perpendicular to it, and the longest chord perpendicular to these two.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "host/shapes/surface/interval_search.hpp"
#include "host/shapes/library/statistics.hpp"
#include "macadam/error.hpp"
#include "macadam/shape.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/long_tests.hpp"
#include "tests/support/test_scenes.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

/// Relative rounding error of a length. Coordinates of order 1 are rotated, moved and scaled, which costs a few ulp per
/// number, and a length takes about ten operations.
constexpr double rounding = 1e-13;

void expect_lengths(const ShapeMeasure& m, double l, double i, double s) {
  EXPECT_NEAR(m.d_long, l, rounding * l);
  EXPECT_NEAR(m.d_intermediate, i, rounding * l);
  EXPECT_NEAR(m.d_short, s, rounding * l);
}

/// Calls `expect` with the measures of the unrotated surface and of ten random rotations about random centres.
void in_all_poses(const Surface& surface, const std::function<void(const ShapeMeasure&)>& expect) {
  expect(measure_shape(surface));
  RandomStream random(test_seed(), 1);
  for (int k = 0; k < 10; ++k) {
    const Vec3d centre{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    expect(measure_shape(mapped(surface, random_pose(random, 1, centre))));
  }
}

TEST(ShapeFiles, AreScaledToALengthAboveZero) {
  const Surface ball = subdivided_icosahedron(1);
  EXPECT_NEAR(measure_shape(scale_to_radius(ball, 0.003)).d_intermediate, 0.006, 1e-15);
  for (const double length : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(scale_to_radius(ball, length), InputError) << length;
}

TEST(Stabbing, AnIntervalHoldsItsEnds) {
  std::vector<std::size_t> found;
  stab({{0, 1}}, {0, 1}, 0, [&](std::size_t, std::size_t p) { found.push_back(p); });
  EXPECT_EQ(found, (std::vector<std::size_t>{0, 1}));
}

TEST(Stabbing, AnIntervalHoldsWhatIsBeyondItsEndsByTheToleranceAndNoMore) {
  const std::vector<Interval> intervals{{0, 1}, {2, 2}};
  const std::vector<double> positions{1.2, -0.05, 2.05, 1.05, 0.5, 1.95, 1};
  std::vector<std::pair<std::size_t, std::size_t>> found;
  stab(intervals, positions, 0.1, [&](std::size_t i, std::size_t p) { found.emplace_back(i, p); });
  EXPECT_EQ(found, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {0, 4}, {0, 6}, {0, 3}, {1, 5}, {1, 2}}));
}

TEST(Dimensions, OfABox) {
  // D^L = (a, b, c). A chord perpendicular to D^L is a difference (w1, w2, w3) of two points with |w1| ≤ a, |w2| ≤ b,
  // |w3| ≤ c and w1·a + w2·b + w3·c = 0. These conditions describe a polygon, and the longest chord is at one of its
  // corners. If b² + c² ≤ a², this chord is (−(b² + c²)/a, b, c) with length √(b² + c²)·D^L/a. The direction
  // perpendicular to both chords is (0, −c, b). Along this direction the height c limits the chord to c/b·√(b² + c²).
  for (const auto& edges : {std::array{6., 4., 3.}, {5., 4., 1.}, {2., 1.2, 1.1}}) {
    const double a = edges[0], b = edges[1], c = edges[2];
    const double l = std::hypot(a, b, c), across = std::hypot(b, c);
    in_all_poses(box_surface(a, b, c), [&](const ShapeMeasure& m) {
      expect_lengths(m, l, across * l / a, across * c / b);
      EXPECT_NEAR(m.volume, a * b * c, 10 * rounding * a * b * c);
      EXPECT_NEAR(m.area, 2 * (a * b + b * c + c * a), 1e-12 * a * b);
      EXPECT_NEAR(m.radius_bounding, l / 2, rounding * l);
    });
  }
}

TEST(Dimensions, OfACubeWhoseFourLongAxesTie) {
  // Perpendicular to a space diagonal, the longest chord is a face diagonal (1, −1, 0). Perpendicular to these two
  // diagonals, along (1, 1, −2), the longest chord of the cube ends where two coordinates have changed by half of the
  // change of the third.
  in_all_poses(box_surface(1, 1, 1), [](const ShapeMeasure& m) {
    expect_lengths(m, std::sqrt(3.0), std::sqrt(2.0), std::sqrt(1.5));
    EXPECT_NEAR(dot(m.axis_long, m.axis_intermediate), 0, rounding);
    EXPECT_NEAR(dot(m.axis_long, m.axis_short), 0, rounding);
    EXPECT_NEAR(dot(m.axis_intermediate, m.axis_short), 0, rounding);
  });
}

TEST(Dimensions, OfARegularTetrahedron) {
  // Opposite edges are perpendicular, so D^L = D^I = 1. Perpendicular to these two edges is the line through their
  // midpoints, of length 1/√2.
  in_all_poses(tetrahedron(), [](const ShapeMeasure& m) {
    expect_lengths(m, 1, 1, std::sqrt(0.5));
    EXPECT_NEAR(m.volume, 1 / std::sqrt(72.0), rounding);
    EXPECT_NEAR(m.area, std::sqrt(3.0), 10 * rounding);
    EXPECT_NEAR(m.sphericity_true, std::cbrt(std::numbers::pi / 6 / std::sqrt(3.0)), 10 * rounding);
    EXPECT_NEAR(m.radius_bounding, std::sqrt(6.0) / 4, rounding);
  });
}

TEST(Dimensions, OfATriangularPrism) {
  // The triangle has side 1, the prism height 2, and D^L = (1, 0, 2). The difference of two points is (d, t): d lies in
  // the hexagon whose corners are the edges of the triangle, and t is along the height. For a chord perpendicular to
  // D^L, t = −d_x/2. Its squared length d_x² + d_y² + d_x²/4 is largest at the corner (1, 0) of the hexagon, so D^I =
  // √1.25. Perpendicular to both chords is y, along which the triangle is √0.75 high.
  in_all_poses(prism({{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}, 2), [](const ShapeMeasure& m) {
    expect_lengths(m, std::sqrt(5.0), std::sqrt(1.25), std::sqrt(0.75));
    EXPECT_NEAR(m.volume, std::sqrt(0.75), rounding * 10);
    EXPECT_NEAR(m.area, 6 + std::sqrt(0.75), rounding * 100);
  });
}

TEST(Dimensions, ATunnelDoesNotStopTheCalliper) {
  // The longest chord, and the two chords that are measured perpendicular to it, all cross the tunnel of the 6 × 4 × 3
  // box. The tunnel must not shorten them, because a calliper measures between the outer faces.
  in_all_poses(tunnel(6, 4, 3, 1), [](const ShapeMeasure& m) {
    const double l = std::sqrt(61.0);
    expect_lengths(m, l, 5 * l / 6, 3.75);
    EXPECT_NEAR(m.volume, 72 - 6, 1e-11);
    EXPECT_NEAR(m.area, 108 - 2 + 24, 1e-11);
    EXPECT_NEAR(m.sphericity_true, std::cbrt(36 * std::numbers::pi * 66 * 66) / 130, 1e-12);
  });
}

TEST(Dimensions, OfASphereHaveTheKnownLimitOfTheWorkingSphericity) {
  for (int level = 1; level <= 3; ++level) {  // the points of every level include three pairs on perpendicular axes
    const ShapeMeasure m = measure_shape(icosphere(level));
    expect_lengths(m, 2, 2, 2);
    EXPECT_NEAR(m.sphericity_working(), 12.8 / (3 + 6 * std::sqrt(3.0)), 1e-12);  // 0.956
    EXPECT_NEAR(m.radius_bounding, 1, 1e-12);
    EXPECT_NEAR(norm(m.centroid), 0, 1e-13);
  }
}

/// Returns the area of the ellipsoid with half axes 3, 2, 1, by Legendre's integrals.
double ellipsoid_area() {
  const double a = 3, b = 2, c = 1, phi = std::acos(c / a);
  const double k = std::sqrt(a * a * (b * b - c * c) / (b * b * (a * a - c * c)));
  const double e = std::ellint_2(k, phi), f = std::ellint_1(k, phi), sin = std::sin(phi), cos = std::cos(phi);
  return 2 * std::numbers::pi * (c * c + a * b / sin * (e * sin * sin + f * cos * cos));
}

TEST(Dimensions, OfAnEllipsoidConvergeAtSecondOrder) {
  RandomStream random(test_seed(), 2);
  const Pose pose = random_pose(random);  // no point of the mesh is at the end of an axis
  double earlier_volume = 0, earlier_area = 0;
  for (int level = 2; level <= 4; ++level) {
    const ShapeMeasure m = measure_shape(mapped(icosphere(level), [&](const Vec3d& p) {
      const Vec3d q = pose(p);
      return Vec3d{3 * q.x, 2 * q.y, q.z};
    }));
    // Edges of the sphere's mesh have a length h of about 1.1/2^level. Every point of the sphere has a mesh point
    // within an angle of 0.6·h, so D^L is too small by at most the fraction 0.6²/2·h². The directions of the chords are
    // wrong by the same angle, scaled by at most the ratio 3 of the half axes. For D^I and D^S, which depend on the
    // directions of the chords before them, this adds the fraction (3·0.6)²/2·h².
    const double h = 1.1 / std::pow(2, level), bound = 0.18 * h * h, tilted = bound + 1.62 * h * h;
    EXPECT_LE(m.d_long, 6);
    EXPECT_NEAR(m.d_long, 6, 6 * bound);
    EXPECT_NEAR(m.d_intermediate, 4, 4 * tilted);
    EXPECT_NEAR(m.d_short, 2, 2 * tilted);
    const double volume = 8 * std::numbers::pi - m.volume, area = ellipsoid_area() - m.area;
    if (level > 2) {  // the error falls to a quarter as edges are halved; 4 % allowed for the next order
      EXPECT_NEAR(earlier_volume / volume, 4, 0.16);
      EXPECT_NEAR(earlier_area / area, 4, 0.16);
    }
    earlier_volume = volume, earlier_area = area;
  }
}

/// Independent implementation of a calliper: returns the distance between the outermost intersections of a line with
/// the surface (Möller and Trumbore).
double calliper(const Surface& s, const Vec3d& origin, const Vec3d& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& [a, b, c] : s.facets) {
    const Vec3d e1 = s.points[b] - s.points[a], e2 = s.points[c] - s.points[a];
    const Vec3d p = cross(direction, e2), t = origin - s.points[a], q = cross(t, e1);
    const double det = dot(e1, p), u = dot(t, p) / det, v = dot(direction, q) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
    low = std::min(low, dot(e2, q) / det), high = std::max(high, dot(e2, q) / det);
  }
  return high > low ? high - low : 0;
}

TEST(Dimensions, OfLumpsAgainstACalliperOfManyTries) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Surface s = lump(test_seed() + seed, 2, {3, 2, 1.2}, 0.3);
    const ShapeMeasure m = measure_shape(s);
    EXPECT_LE(m.d_short, m.d_intermediate);
    EXPECT_LE(m.d_intermediate, m.d_long);
    // No line in the direction of D^S is longer than D^S, and lines through random points of the facets are almost as
    // long.
    RandomStream random(seed, 3);
    double found = 0;
    for (const auto& f : s.facets) {
      for (int k = 0; k < 10; ++k) {
        const double u = std::sqrt(random.uniform()), v = random.uniform();
        const Vec3d p = (1 - u) * s.points[f[0]] + (u * (1 - v)) * s.points[f[1]] + (u * v) * s.points[f[2]];
        const double length = calliper(s, p, m.axis_short);
        EXPECT_LE(length, m.d_short * (1 + rounding));
        found = std::max(found, length);
      }
    }
    // the 3,200 lines are about 1/50 of the size apart, so they miss the longest line
    EXPECT_GT(found, 0.95 * m.d_short);
    // Compares D^I with lines in all directions perpendicular to D^L, through random points of the facets.
    double across = 0;
    for (int k = 0; k < 20000; ++k) {
      const double angle = std::numbers::pi * random.uniform();
      const Vec3d direction = std::cos(angle) * m.axis_intermediate + std::sin(angle) * m.axis_short;
      const auto& f = s.facets[random.index(s.facets.size())];
      const double u = std::sqrt(random.uniform()), v = random.uniform();
      const Vec3d p = (1 - u) * s.points[f[0]] + (u * (1 - v)) * s.points[f[1]] + (u * v) * s.points[f[2]];
      const double length = calliper(s, p, direction);
      EXPECT_LE(length, m.d_intermediate * (1 + rounding));
      across = std::max(across, length);
    }
    // looser than above, because here a line must also have nearly the right direction
    EXPECT_GT(across, 0.92 * m.d_intermediate);
    double longest = 0;
    for (const Vec3d& p : s.points) {
      for (const Vec3d& q : s.points) longest = std::max(longest, norm(p - q));
    }
    EXPECT_NEAR(m.d_long, longest, rounding * longest);
  }
}

TEST(Dimensions, DoNotDependOnPoseOrScale) {
  const Surface s = lump(test_seed(), 2, {2, 1.5, 1}, 0.2);
  const ShapeMeasure m = measure_shape(s);
  RandomStream random(test_seed(), 4);
  for (const double scale : {1.0, 1e-3, 7e-6, 1e4}) {
    const Pose pose = random_pose(random, scale, 3 * scale * Vec3d{1, -2, 1});
    const ShapeMeasure t = measure_shape(mapped(s, pose));
    for (const ShapeProperty& property : shape_properties()) {
      if (property.column == std::string("flakiness")) continue;  // depends on sieve sizes, hence on scale
      const double dimension = property.column == std::string("volume_m3")    ? 3
                               : property.column == std::string("area_m2")    ? 2
                               : std::string(property.column).ends_with("_m") ? 1
                                                                              : 0;
      const double expected = property.value(m) * std::pow(scale, dimension);
      // The tolerance allows for rounding: the shape lies 7 times its own size from the origin, which costs one digit,
      // and its volume is a sum of 320 terms.
      EXPECT_NEAR(property.value(t), expected, 1e-12 * expected) << property.column;
    }
    EXPECT_NEAR(norm(t.centroid - pose(m.centroid)), 0, 1e-13 * scale);
    EXPECT_NEAR(t.radius_bounding, scale * m.radius_bounding, 1e-12 * scale);
    // this centre is ill-conditioned if few points determine the bounding sphere
    EXPECT_NEAR(norm(t.centre_bounding - pose(m.centre_bounding)), 0, 1e-7 * scale);
  }
}

TEST(Dimensions, OfAFaultySurfaceAreRefused) {
  Surface s = box_surface(1, 2, 3);
  s.facets.pop_back();
  try {
    measure_shape(s);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("box: surface: found open at 3 facets"), std::string::npos)
        << error.what();
  }
}

TEST(Dimensions, OfAWholeLibraryTakeNoTime) {
  if (!long_tests) GTEST_SKIP() << "sanitizers and coverage have their own time";
  Surface s = lump(1, 3, {2, 1.5, 1}, 0.1);  // a surface of 1,280 facets
  const double work = units_of_work([&] {
    for (int k = 0; k < 10; ++k) measure_shape(s);
  });
  // 82 shapes may take 5 s on one core, if a unit takes 0.1 s; they have 1.6 times fewer facets
  EXPECT_LT(work, 10 * 50.0 / 82);
}

TEST(Pose, TurnsScalesAndMoves) {
  const double h = std::sqrt(0.5);
  const Pose quarter{{1, 2, 3}, {h, 0, 0, h}, 2};  // 90° about z
  EXPECT_NEAR(norm(quarter({1, 0, 0}) - Vec3d{1, 4, 3}), 0, 1e-15);
  EXPECT_NEAR(norm(quarter({0, 1, 5}) - Vec3d{-1, 2, 13}), 0, 1e-14);
}

TEST(Indices, FollowTheirDefinitions) {
  ShapeMeasure m;
  m.d_long = 8e-3, m.d_intermediate = 5e-3, m.d_short = 4e-3;
  EXPECT_DOUBLE_EQ(m.shape_index(), 2);
  EXPECT_DOUBLE_EQ(m.flatness(), 0.8);
  EXPECT_DOUBLE_EQ(m.elongation(), 0.625);
  EXPECT_DOUBLE_EQ(m.flakiness(), 4 / 6.3);
  // With p = D^S/D^I = 0.8 and q = D^I/D^L = 0.625 the formula gives 12.8·∛0.4 / (1 + 1.3 + 6·√(1 + 0.64·1.390625)).
  EXPECT_NEAR(m.sphericity_working(), 12.8 * std::cbrt(0.4) / (2.3 + 6 * std::sqrt(1.89)), 1e-15);
  m.d_intermediate = 20e-3;
  EXPECT_TRUE(std::isnan(m.flakiness()));
}

TEST(Sieves, ClassesIncludeTheirLowerSieve) {
  using Class = std::array<double, 2>;
  EXPECT_EQ(sieve_class(0), (Class{0, 0.5e-3}));
  EXPECT_EQ(sieve_class(4e-3), (Class{4e-3, 6.3e-3}));
  EXPECT_EQ(sieve_class(std::nextafter(4e-3, 0)), (Class{2e-3, 4e-3}));
  EXPECT_EQ(sieve_class(12.59e-3), (Class{12.5e-3, 16e-3}));
  EXPECT_EQ(sieve_class(0.5), (Class{20e-3, std::numeric_limits<double>::infinity()}));
  EXPECT_THROW(sieve_class(-1e-3), InputError);
  EXPECT_THROW(sieve_class(std::nan("")), InputError);
}

TEST(Statistics, PearsonOfKnownSamples) {
  const double nan = std::nan("");
  const std::vector<double> x{1, 2, 3, 4, 5};
  EXPECT_NEAR(pearson(x, {3, 5, 7, 9, 11}), 1, 1e-15);
  EXPECT_NEAR(pearson(x, {-1, -2, -3, -4, -5}), -1, 1e-15);
  EXPECT_NEAR(pearson(x, {4, 1, 0, 1, 4}), 0, 1e-15);               // y = (x − 3)²
  EXPECT_NEAR(pearson(x, {2, 4, 5, 4, 5}), std::sqrt(0.6), 1e-15);  // Sxy = 6, Sxx = 10, Syy = 6
  EXPECT_NEAR(pearson({1, 2, nan, 3, 4, 5, 9}, {2, 4, 7, 5, 4, 5, nan}), std::sqrt(0.6), 1e-15);
  EXPECT_NEAR(pearson({1e9 + 1, 1e9 + 2, 1e9 + 3}, {1, 2, 3}), 1, 1e-15);
  EXPECT_TRUE(std::isnan(pearson(x, {7, 7, 7, 7, 7})));
  EXPECT_TRUE(std::isnan(pearson({1}, {2})));
}

TEST(Statistics, TablesOfThreeBoxes) {
  std::vector<ShapeMeasure> shapes;
  for (const double size : {1e-3, 2e-3, 4e-3}) shapes.push_back(measure_shape(box_surface(2 * size, size, size)));
  const auto property = [](const std::string& column) {
    const auto& all = shape_properties();
    return *std::find_if(all.begin(), all.end(), [&](const ShapeProperty& p) { return p.column == column; });
  };
  const Spread volume = spread_of(property("volume_m3"), shapes);
  EXPECT_NEAR(volume.min, 2e-9, 1e-21);
  EXPECT_NEAR(volume.average, 2e-9 * (1 + 8 + 64) / 3, 1e-21);
  EXPECT_NEAR(volume.max, 128e-9, 1e-20);
  EXPECT_EQ(volume.shapes, 3);
  // D^I is √2·√6/2 = 1.73 times 1, 2 and 4 mm, so only one box has more than 4 mm.
  EXPECT_EQ(spread_of(property("shape_index"), shapes).shapes, 1);
  EXPECT_EQ(spread_of(property("shape_index"), {}).shapes, 0);
  EXPECT_TRUE(std::isnan(spread_of(property("shape_index"), {}).average));

  const auto matrix = correlation_matrix(shapes);
  ASSERT_EQ(matrix.size(), 11u);
  EXPECT_NEAR(matrix[0][1], 1, 1e-14);  // all lengths are proportional
  // volumes 1, 8, 64 and lengths 1, 2, 4: Sxy = 89 − 3·(7/3)·(73/3) …
  const double sxy = 1 + 16 + 256 - 7 * 73 / 3.0, sxx = 21 - 49 / 3.0, syy = 1 + 64 + 4096 - 73 * 73 / 3.0;
  EXPECT_NEAR(matrix[3][0], sxy / std::sqrt(sxx * syy), 1e-14);
  EXPECT_EQ(matrix[3][0], matrix[0][3]);
  EXPECT_TRUE(std::isnan(matrix[5][0]));  // only one shape has an SI

  const std::string csv = shapes_csv({"a", "b,c", "d"}, shapes);
  EXPECT_EQ(csv.rfind("name,points,facets,d_long_m,d_intermediate_m,d_short_m,volume_m3,area_m2,shape_index,flatness,"
                      "flakiness,elongation,sphericity_true,sphericity_working,sieve_min_m,sieve_max_m\na,8,12,",
                      0),
            0u);
  EXPECT_NE(csv.find("\n\"b,c\",8,12,"), std::string::npos);
}

}  // namespace
}  // namespace macadam::test
