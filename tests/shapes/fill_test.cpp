// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fill_test.cpp  Tests shapes that are filled with spheres, and compares the report on a filling with closed
/// forms.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "host/shapes/fill/fill.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam {
namespace {

using std::numbers::pi;

FillSpec of_radius(double low, double high) {
  FillSpec spec;
  spec.radius_min = low, spec.radius_max = high;
  return spec;
}

bool same(const MultiSphere& a, const MultiSphere& b) {
  return a.radius == b.radius && std::equal(a.centre.begin(), a.centre.end(), b.centre.begin(), b.centre.end(),
                                            [](const Vec3d& p, const Vec3d& q) { return norm(p - q) == 0; });
}

/// Returns the largest distance by which a sphere protrudes from the surface, as a fraction of its radius.
double largest_protrusion(const Surface& surface, const MultiSphere& cluster) {
  const SurfaceDistance distance(surface);
  double largest = 0;
  for (std::size_t i = 0; i < cluster.size(); ++i)
    largest = std::max(largest, 1 - distance.depth(cluster.centre[i]) / cluster.radius[i]);
  return largest;
}

bool every_sphere_has_a_cell(const MultiSphere& cluster) {
  const Vec3d far{1, 1, 1};
  return particles_without_cell(in_box(cluster, -far, far)).empty();
}

/// The number of spheres in an icosahedron agrees with published numbers. A range of porosities would give the
/// published numbers; the tolerance covers this range.
TEST(Fill, IcosahedronTakesAsManySpheresAsThePublishedOne) {
  const Surface icosahedron = subdivided_icosahedron(6.295e-3);
  const std::pair<double, double> published[] = {{0.5e-3, 1568}, {2e-3, 24}};
  for (const auto& [radius, count] : published) {
    const MultiSphere cluster = fill_shape(icosahedron, of_radius(radius, radius));
    // The number of spheres follows from the porosity alone, rounded to an integer.
    const double of_porosity = 0.88 * measure_shape(icosahedron).volume / (4 * pi / 3 * std::pow(radius, 3));
    EXPECT_EQ(cluster.size(), static_cast<std::size_t>(std::llround(of_porosity)));
    // The porosity behind the published integers is 0.10 for 1568 and 0.10 to 0.14 for 24. The default, 0.12, is within
    // 0.02 of these.
    EXPECT_NEAR(static_cast<double>(cluster.size()), count, 0.02 / 0.88 * count);
    EXPECT_EQ(cluster.radius, std::vector(cluster.size(), radius));
    EXPECT_LT(largest_protrusion(icosahedron, cluster), 0.15);  // the wall is ten times as stiff as a pair of spheres
    EXPECT_TRUE(every_sphere_has_a_cell(cluster));

    const FillReport report = measure_fill(icosahedron, cluster);
    EXPECT_GT(report.covered, 0.7);  // twenty-four spheres; random positions would cover 1 − exp(−0.88) = 0.59
    EXPECT_LT(report.outside, 0.015);
    EXPECT_LT(report.largest_overlap, 0.5);           // no centre lies inside another sphere
    EXPECT_LT(report.deviation_mean, 0.25 * radius);  // a layer of spheres that touch the wall has 0.2 radii
    EXPECT_NEAR(report.d_long, 2 * 6.295e-3, 0.5 * radius);
  }
}

TEST(Fill, RadiiAreUniformAndTheirVolumeIsThatAskedFor) {
  const Surface icosahedron = subdivided_icosahedron(6.295e-3);
  FillSpec spec = of_radius(0.5e-3, 2e-3);
  spec.porosity = 0.2;
  const MultiSphere cluster = fill_shape(icosahedron, spec);
  double volume = 0, sum = 0;
  for (double r : cluster.radius) {
    EXPECT_GE(r, spec.radius_min);
    EXPECT_LE(r, spec.radius_max);
    volume += 4 * pi / 3 * r * r * r, sum += r;
  }
  EXPECT_NEAR(volume, 0.8 * measure_shape(icosahedron).volume, 1e-12 * volume);
  // One radius is taken from each of n equal parts of the range, then all are adjusted until the volume fits. The mean
  // radius equals the mean of the range to 3 %.
  EXPECT_NEAR(sum / static_cast<double>(cluster.size()), 1.25e-3, 0.03 * 1.25e-3);
  EXPECT_TRUE(every_sphere_has_a_cell(cluster));
  EXPECT_LT(largest_protrusion(icosahedron, cluster), 0.15);
}

TEST(Fill, SameSeedSameBitsForAnyNumberOfThreads) {
  const Surface shape = subdivided_icosahedron(6.295e-3);
  FillSpec spec = of_radius(0.55e-3, 0.6e-3);  // 1,037 spheres, enough to run the loops in parallel
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const MultiSphere one = fill_shape(shape, spec);
  omp_set_num_threads(2);
  const MultiSphere two = fill_shape(shape, spec);
  spec.seed = 2;
  const MultiSphere other = fill_shape(shape, spec);
  omp_set_num_threads(threads);
  ASSERT_GT(one.size(), 1000u);
  EXPECT_TRUE(same(one, two));
  EXPECT_FALSE(same(one, other));
}

TEST(Fill, ScaledCopyIsTheScaledCluster) {
  const Surface shape = test::l_surface(8e-3, 3e-3, 4e-3);
  const MultiSphere small = fill_shape(shape, of_radius(0.75e-3, 1e-3));
  const MultiSphere large = ShapeFiller(shape).fill(2, of_radius(1.5e-3, 2e-3));
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t i = 0; i < small.size(); ++i) {  // equal bit by bit, because 2 is a power of two
    EXPECT_EQ(large.radius[i], 2 * small.radius[i]);
    EXPECT_EQ(norm(large.centre[i] - 2.0 * small.centre[i]), 0);
  }
}

TEST(Fill, FewerThanLeastBecomeOneSphere) {
  const double a = 4e-3, b = 3e-3, c = 2e-3;
  const Surface box = test::box_surface(a, b, c);
  FillSpec spec = of_radius(0.8e-3, 0.8e-3);
  const std::int64_t count = ShapeFiller(box).spheres(1, spec);
  EXPECT_EQ(count, std::llround(0.88 * a * b * c / (4 * pi / 3 * std::pow(0.8e-3, 3))));
  spec.least = count;
  EXPECT_EQ(static_cast<std::int64_t>(fill_shape(box, spec).size()), count);
  spec.least = count + 1;
  const std::pair<SingleSphere, double> radii[] = {{SingleSphere::intermediate, measure_shape(box).d_intermediate / 2},
                                                   {SingleSphere::circumscribed, std::hypot(a, b, c) / 2},
                                                   {SingleSphere::volume, std::cbrt(a * b * c * 3 / (4 * pi))}};
  for (const auto& [rule, radius] : radii) {
    spec.single = rule;
    const MultiSphere one = fill_shape(box, spec);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_NEAR(one.radius[0], radius, 1e-9 * radius);  // the smallest enclosing sphere is found by iteration
    EXPECT_LT(norm(one.centre[0] - Vec3d{a / 2, b / 2, c / 2}), 1e-12 * a);
  }
  EXPECT_EQ(fill_shape(box, of_radius(5e-3, 6e-3)).size(), 1u);  // these spheres are larger than the shape
}

TEST(Fill, ThinPlateTakesOneEvenLayer) {
  const double side = 10e-3, thick = 1.1e-3;
  const Surface plate = test::box_surface(side, side, thick);
  // Spheres of the first radius just fit between the faces of the plate. Spheres of the second radius are too large, so
  // they protrude from both faces equally.
  for (const double radius : {0.5e-3, 0.7e-3}) {
    const MultiSphere cluster = fill_shape(plate, of_radius(radius, radius));
    ASSERT_GT(cluster.size(), 20u);
    EXPECT_TRUE(every_sphere_has_a_cell(cluster));
    std::array<int, 4> quarter{};
    for (const Vec3d& c : cluster.centre) {
      EXPECT_NEAR(c.z, thick / 2, 0.35 * radius);  // spheres in a compressed layer move to both sides
      EXPECT_GT(test::depth_in_box({c.x, c.y, thick / 2}, side, side, thick), 0.5 * thick - 0.35 * radius);
      ++quarter[(c.x > side / 2 ? 1 : 0) + (c.y > side / 2 ? 2 : 0)];
    }
    const double mean = static_cast<double>(cluster.size()) / 4;
    // if the positions were random, these numbers would scatter by √n, here 0.2 to 0.3 of the mean
    for (int n : quarter) EXPECT_NEAR(n, mean, 0.2 * mean);
  }
}

TEST(Fill, BothArmsOfAnLFillAndTheNotchStaysEmpty) {
  const double length = 12e-3, width = 4e-3, radius = 0.6e-3;
  const Surface l = test::l_surface(length, width, width);
  const MultiSphere cluster = fill_shape(l, of_radius(radius, radius));
  EXPECT_LT(largest_protrusion(l, cluster), 0.15);
  EXPECT_TRUE(every_sphere_has_a_cell(cluster));
  int right = 0, upper = 0;
  for (const Vec3d& c : cluster.centre) {
    EXPECT_FALSE(c.x > width && c.y > width);
    right += c.x > width ? 1 : 0, upper += c.y > width ? 1 : 0;
  }
  // each arm is two of the five cubes that make up the L
  const double arm = static_cast<double>(cluster.size()) * 2 / 5;
  EXPECT_NEAR(right, arm, 0.1 * arm);
  EXPECT_NEAR(upper, arm, 0.1 * arm);
}

TEST(Fill, ImpossibleSpecsNameTheCulprit) {
  struct Case {
    std::function<void(FillSpec&)> spoil;
    std::vector<std::string> words;
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {[](FillSpec& s) { s.radius_min = 0; }, {"radius_min", "found 0", "positive"}},
      {[](FillSpec& s) { s.radius_min = nan; }, {"radius_min", "nan"}},
      {[](FillSpec& s) { s.radius_max = 0.5e-3; }, {"radius_max", "found 5e-04", "at least radius_min, 0.001"}},
      {[](FillSpec& s) { s.radius_max = 1 / 0.0; }, {"radius_max", "inf"}},
      {[](FillSpec& s) { s.porosity = 1; }, {"porosity", "found 1", "below 1"}},
      {[](FillSpec& s) { s.porosity = nan; }, {"porosity", "nan"}},
      {[](FillSpec& s) { s.porosity = -3; }, {"porosity", "found -3", "-0.5"}},
      {[](FillSpec& s) { s.least = 0; }, {"least", "found 0", "at least 1"}},
      {[](FillSpec& s) { s.radius_min = s.radius_max = 1e-9; }, {"number of spheres", "at most 100000"}},
      {[](FillSpec& s) { s.radius_min = s.radius_max = 1, s.single = SingleSphere{7}; }, {"single", "found 7"}},
  };
  const Surface box = test::box_surface(4e-3, 3e-3, 2e-3);
  for (const Case& c : cases) {
    FillSpec spec = of_radius(1e-3, 1e-3);
    c.spoil(spec);
    std::string message = "(accepted)";
    try {
      fill_shape(box, spec);
    } catch (const InputError& error) { message = error.what(); }
    EXPECT_NE(message.find("box: "), std::string::npos) << message;
    for (const std::string& word : c.words) EXPECT_NE(message.find(word), std::string::npos) << message;
  }
  EXPECT_THROW(ShapeFiller(box).fill(0, of_radius(1e-3, 1e-3)), InputError);
  Surface open = box;
  open.facets.pop_back();
  EXPECT_THROW(fill_shape(open, of_radius(1e-3, 1e-3)), InputError);
}

/// Returns the mean distance of a unit cube's surface from its centre, ∫∫ √(x² + y² + 1/4) over a face, by the midpoint
/// rule.
double mean_distance_of_cube() {
  constexpr int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += std::hypot((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5, 0.5);
  return sum / (n * n);
}

TEST(FillReport, OneSphereInACube) {
  const Surface cube = test::box_surface(1, 1, 1);
  const FillReport r = measure_fill(cube, {{{0.5, 0.5, 0.5}}, {0.5}});
  EXPECT_NEAR(r.sphere_volume, pi / 6, 1e-15);
  EXPECT_NEAR(r.covered, pi / 6, 5e-5);  // computed with 400² columns
  EXPECT_NEAR(r.outside, 0, 1e-12);
  EXPECT_EQ(r.largest_overlap, 0);
  EXPECT_NEAR(r.deviation_mean, mean_distance_of_cube() - 0.5, 1e-4);  // 20,000 samples, second order
  EXPECT_NEAR(r.deviation_largest, std::sqrt(3) / 2 - 0.5, 1e-14);     // at a corner, which is one of the samples
  for (double d : {r.d_long, r.d_intermediate, r.d_short}) EXPECT_EQ(d, 1);
}

TEST(FillReport, ASphereThatComesOutOfItsCube) {
  const double radius = 0.6, cap = radius - 0.5;
  const double out = 6 * pi * cap * cap * (3 * radius - cap) / 3;
  const FillReport r = measure_fill(test::box_surface(1, 1, 1), {{{0.5, 0.5, 0.5}}, {radius}});
  EXPECT_NEAR(r.outside, out, 5e-5);
  EXPECT_NEAR(r.covered, 4 * pi / 3 * radius * radius * radius - out, 5e-5);
  // A larger sphere covers all corners of the cube. So the largest deviation is the distance by which the sphere
  // protrudes.
  const FillReport large = measure_fill(test::box_surface(1, 1, 1), {{{0.5, 0.5, 0.5}}, {1}});
  EXPECT_NEAR(large.deviation_largest, 0.5, 1e-14);
  EXPECT_NEAR(large.covered, 1, 1e-12);
}

TEST(FillReport, SphereInASphere) {
  Surface ball = subdivided_icosahedron(1);
  const double volume = measure_shape(ball).volume;
  const FillReport r = measure_fill(ball, {{{0, 0, 0}}, {0.5}});
  EXPECT_NEAR(r.covered, pi / 6 / volume, 5e-5);
  EXPECT_NEAR(r.deviation_largest, 0.5, 1e-14);
}

TEST(FillReport, TwoTouchingSpheresAndTwoThatOverlap) {
  const Surface box = test::box_surface(2, 1, 1);
  const FillReport touching = measure_fill(box, {{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}}, {0.5, 0.5}});
  EXPECT_NEAR(touching.covered, pi / 6, 5e-5);
  EXPECT_NEAR(touching.largest_overlap, 0, 1e-15);
  EXPECT_NEAR(touching.d_long, 2, 1e-15);
  EXPECT_NEAR(touching.d_intermediate, 1, 1e-15);
  EXPECT_NEAR(touching.d_short, 1, 1e-15);

  const FillReport half = measure_fill(box, {{{0.75, 0.5, 0.5}, {1.25, 0.5, 0.5}}, {0.5, 0.5}});
  EXPECT_NEAR(half.largest_overlap, 0.5, 1e-15);
  // Volume of the lens common to two spheres of radius R at distance d: π(4R + d)(2R − d)²/12.
  EXPECT_NEAR(half.covered * 2, pi / 3 - pi * 2.5 * 0.25 / 12, 5e-5);
}

TEST(FillReport, LengthsOfAClusterFollowFromItsLongestChords) {
  // The first two spheres determine D^L along x. The chord of the next two is not perpendicular to it, because their
  // centres differ by 1 in x. The last sphere lies above the third along z.
  const MultiSphere cluster{{{-5, 0, 0}, {5, 0, 0}, {0.5, 2, 0}, {-0.5, -3, 0}, {0.5, 2, 4}}, {1, 1, 1.5, 0.5, 0.5}};
  Surface around = test::box_surface(20, 20, 20);
  for (Vec3d& p : around.points) p = p - Vec3d{10, 10, 10};
  const FillReport r = measure_fill(around, cluster);
  EXPECT_NEAR(r.d_long, 12, 1e-14);
  EXPECT_NEAR(r.d_short, 6, 1e-14);
  // The chord's ends are at −u and 1 − u along x from the two centres. The longest such chord is found by trial.
  double longest = 0;
  for (double u = 0.5; u <= 1.5; u += 1e-5)
    longest = std::max(longest, 5 + std::sqrt(1.5 * 1.5 - u * u) + std::sqrt(std::max(0.0, 0.25 - (1 - u) * (1 - u))));
  EXPECT_NEAR(r.d_intermediate, longest, 1e-9);
}

TEST(FillReport, BadClustersNameTheSphere) {
  const Surface box = test::box_surface(1, 1, 1);
  EXPECT_THROW(measure_fill(box, {}), InputError);
  EXPECT_THROW(measure_fill(box, {{{0, 0, 0}}, {}}), InputError);
  try {
    measure_fill(box, {{{0, 0, 0}, {0, 0, 0}}, {1, -1}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("sphere 1: radius"), std::string::npos);
  }
}

}  // namespace
}  // namespace macadam
