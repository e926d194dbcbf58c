// SPDX-License-Identifier: GPL-3.0-or-later
/// \file shape_placement_test.cpp  Places shaped aggregates in small boxes: overlap checks, composition, placement by
/// insertion and by packing.
#include <gtest/gtest.h>
#include <omp.h>

#include <cstdio>

#include "host/specimen/packing/shape_body.hpp"
#include "host/specimen/packing/shape_packing.hpp"
#include "tests/support/long_tests.hpp"
#include "macadam/error.hpp"
#include "tests/support/shape_tests.hpp"

namespace macadam {
namespace {

using test::brute_overlap;

std::vector<ShapeTemplate> stones() {
  std::vector<ShapeTemplate> shapes;
  for (std::uint64_t k = 1; k <= 3; ++k) shapes.push_back(shape_template(test::stone(k, 1)));
  return shapes;
}

/// Returns a recipe of two classes that together fill the fraction `share` of a box of 20 mm.
SpecimenSpec small_mix(double share) {
  SpecimenSpec spec;
  spec.box = {{0.02, 0.02, 0.02}};
  spec.aggregate = {{0.002, 0.00475, share / 2, {}}, {0.00475, 0.008, share / 2, {}}};
  return spec;
}

bool small_ones(int, double size) { return size < 0.0026; }

bool same_bits(const ShapePlacement& a, const ShapePlacement& b) {
  const auto same = [](const PlacedAggregate& p, const PlacedAggregate& q) {
    const Vec3d c = p.pose.centre, d = q.pose.centre;
    return p.size_class == q.size_class && p.shape == q.shape && p.sphere == q.sphere && c.x == d.x && c.y == d.y &&
           c.z == d.z && p.pose.turn == q.pose.turn && p.pose.scale == q.pose.scale;
  };
  return std::equal(a.aggregate.begin(), a.aggregate.end(), b.aggregate.begin(), b.aggregate.end(), same);
}

/// Expects that all aggregates are inside the box and no two overlap, by the brute-force check.
void expect_sound(const Box& box, const ShapePlacement& p, const std::vector<ShapeTemplate>& shapes) {
  double radius = 0;
  for (const ShapeTemplate& t : shapes)
    for (const Vec3d& x : t.surface.points) radius = std::max(radius, norm(x) / t.d_intermediate);
  const auto reach = [&](const PlacedAggregate& a) { return a.pose.scale * shapes[a.shape].d_intermediate * radius; };
  for (std::size_t i = 0; i < p.aggregate.size(); ++i) {
    const PlacedAggregate& a = p.aggregate[i];
    const double r = a.sphere ? a.pose.scale * shapes[a.shape].d_intermediate / 2 : 0;
    std::vector<Vec3d> points = test::placed_surface(a, shapes).points;
    if (a.sphere) points = {a.pose.centre};
    for (const Vec3d& x : points) {
      // 1e-15 m is a few rounding errors of a position in a box of some centimetres.
      EXPECT_GE(std::min({x.x, x.y, x.z}), r - 1e-15) << i;
      EXPECT_GE(std::min({box.size.x - x.x, box.size.y - x.y, box.size.z - x.z}), r - 1e-15) << i;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const PlacedAggregate& b = p.aggregate[j];
      if (norm(a.pose.centre - b.pose.centre) > reach(a) + reach(b)) continue;
      EXPECT_FALSE(brute_overlap(a, b, shapes)) << i << " and " << j;
    }
  }
}

template <class Run>
std::string message_of(const Run& run) {
  try {
    run();
  } catch (const Error& error) { return error.what(); }
  return "(accepted)";
}

/// The overlap check agrees with a brute-force test of every edge of one particle against every facet of the second.
/// This must also hold if one particle is inside the second.
TEST(ShapeBody, OverlapAgreesWithEveryEdgeAgainstEveryFacet) {
  const std::vector<ShapeTemplate> shapes = stones();
  std::vector<std::unique_ptr<ShapeGeometry>> geometries;
  for (const ShapeTemplate& t : shapes) geometries.push_back(std::make_unique<ShapeGeometry>(t));
  RandomStream random(1, 1);
  int together = 0;
  constexpr int pairs = 400;
  for (int k = 0; k < pairs; ++k) {
    PlacedAggregate placed[2];
    ShapeBody body[2];
    for (int i = 0; i < 2; ++i) {
      placed[i] = {0, static_cast<int>(random.index(3)), random.uniform() < 0.2, {}};
      // small particles are sometimes completely inside the other
      const double size = random.uniform() < 0.3 ? 0.003 : 0.012;
      body[i] = ShapeBody(*geometries[placed[i].shape], size, placed[i].sphere);
      body[i].set_turn(random_turn(random));
      body[i].centre = {random.uniform(0, 0.011), random.uniform(0, 0.011), random.uniform(0, 0.011)};
      placed[i].pose = {body[i].centre, body[i].turn, body[i].scale};
    }
    EXPECT_EQ(overlap(body[0], body[1]), brute_overlap(placed[0], placed[1], shapes)) << k;
    together += overlap(body[0], body[1]);
    EXPECT_EQ(overlap(body[0], body[1]), overlap(body[1], body[0])) << k;
  }
  EXPECT_GT(together, pairs / 5);
  EXPECT_LT(together, 4 * pairs / 5);
}

/// The grid of distances gives a lower and an upper bound of the true distance to the surface.
TEST(ShapeBody, FieldBoundsTheTrueDistance) {
  const ShapeTemplate shape = shape_template(test::stone(2, 1));
  const ShapeGeometry geometry(shape);
  RandomStream random(3, 1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3d p{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    const double exact = test::signed_distance(shape.surface, p);
    // Node values are floats of distances below 4, which have 24 bits.
    EXPECT_LE(geometry.field.at_least(p), exact + 4 * 0x1p-24) << k;
    EXPECT_GE(geometry.field.at_most(p), exact - 4 * 0x1p-24) << k;
    EXPECT_EQ(geometry.solid.contains(p), exact <= 0) << k;
    EXPECT_NEAR(geometry.solid.distance(p), std::abs(exact), 1e-14) << k;  // a few roundings of numbers below 4
  }
}

/// Near the middle of a face, the distance from the box is the distance from the plane of the face.
TEST(DistanceField, PointsStraightOutOfTheFacesOfABox) {
  const Surface box = test::box_surface(2, 2, 2);
  const ShapeSolid solid(box);
  const DistanceField field(box, solid, 20);
  RandomStream random(4, 1);
  for (int k = 0; k < 600; ++k) {
    double p[] = {random.uniform(0.7, 1.3), random.uniform(0.7, 1.3), random.uniform(0.7, 1.3)}, out[] = {0, 0, 0};
    const int axis = k % 3;
    const double beyond = random.uniform(-0.2, 0.09);  // inside the grid, which extends 0.1 beyond the box
    out[axis] = k % 2 ? 1 : -1;
    p[axis] = k % 2 ? 2 + beyond : -beyond;
    const DistanceField::Value v = field.value({p[0], p[1], p[2]});
    // Nodes store distances below 0.5 as floats, with a rounding error of 1.5e-8. A slope is the difference of two
    // nodes divided by their distance, 0.1.
    EXPECT_NEAR(v.distance, beyond, 2e-8) << k;
    EXPECT_LT(norm(v.outward - Vec3d{out[0], out[1], out[2]}), 1e-6) << k;
  }
}

TEST(ShapeBody, DistanceFromASphereIsKnownExactly) {
  const ShapeTemplate shape = shape_template(test::stone(2, 1));
  const ShapeGeometry geometry(shape);
  ShapeBody sphere(geometry, 0.006, true);
  sphere.centre = {0.001, 0.002, 0.003};
  for (const double away : {0.001, 0.005}) {
    const Vec3d p = sphere.centre + away * Vec3d{0.36, 0.48, 0.8};
    EXPECT_NEAR(sphere.distance_at_least(p), away - sphere.sphere_radius(), 1e-17);
    EXPECT_NEAR(sphere.distance_at_most(p), away - sphere.sphere_radius(), 1e-17);
  }
}

TEST(ShapeComposition, ClassesHaveTheirVolumes) {
  const std::vector<ShapeTemplate> shapes = stones();
  const SpecimenSpec spec = small_mix(0.5);
  const ShapeComposition c = compose_shapes(spec, shapes, small_ones);
  ASSERT_EQ(c.row.size(), 2u);
  double sum[2] = {};
  for (const AggregateRequest& r : c.aggregate) {
    sum[r.size_class] += aggregate_volume(shapes[r.shape], r.size, r.sphere) / spec.box.volume();
    EXPECT_EQ(r.sphere, r.size < 0.0026);
    EXPECT_GE(r.size, r.size_class == 0 ? 0.002 : 0.00475);
    EXPECT_LE(r.size, r.size_class == 0 ? 0.00475 : 0.008);
  }
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(sum[k], 0.25, 0.25 * 1e-3) << k;         // the accuracy that compose_shapes() promises
    EXPECT_NEAR(sum[k], c.row[k].fraction, 1e-12) << k;  // sums of a hundred terms
    EXPECT_NEAR(c.row[k].fraction_asked, 0.25, 1e-15) << k;
  }
  EXPECT_TRUE(std::is_sorted(c.aggregate.begin(), c.aggregate.end(),
                             [](const AggregateRequest& a, const AggregateRequest& b) { return a.size > b.size; }));
}

TEST(ShapeComposition, FractionsAreOfTheSolidVolume) {
  SpecimenSpec spec = small_mix(0.5);
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  const ShapeComposition c = compose_shapes(spec, stones(), {});
  EXPECT_NEAR(c.row[0].fraction_asked, 0.95 * 0.25, 1e-15);
  EXPECT_NEAR(c.row[0].fraction, 0.95 * 0.25, 0.25 * 1e-3);
}

TEST(ShapeComposition, CountsAreKept) {
  SpecimenSpec spec = small_mix(0);
  spec.aggregate = {{0.002, 0.00475, {}, 17}};
  const ShapeComposition c = compose_shapes(spec, stones(), small_ones);
  EXPECT_EQ(c.aggregate.size(), 17u);
  EXPECT_EQ(c.row[0].count, 17);
}

/// For the logarithmic size law between a and b, sizes from c to d contribute (d³ − c³)/(3 ln(b/a)) to the mean cube of
/// all sizes. Here aggregates of sizes below √(a·b) become spheres. These spheres have a much smaller volume than the
/// stones.
TEST(ShapeComposition, TheNumberFollowsFromTheMeanVolumeOfSpheresAndStones) {
  std::vector<ShapeTemplate> shapes = stones();
  for (ShapeTemplate& t : shapes) t.sphere_size = 0.5;
  const double a = 0.004, b = 0.0066, middle = std::sqrt(a * b);
  SpecimenSpec spec;
  spec.box = {{0.06, 0.06, 0.06}};
  spec.aggregate = {{a, b, 0.4, {}}};
  const auto c = compose_shapes(spec, shapes, [&](int, double size) { return size < middle; });
  double sphere = 0, stone = 0;  // mean volumes of a sphere and a stone of size 1
  for (const ShapeTemplate& t : shapes) {
    sphere += aggregate_volume(t, 1, true) / static_cast<double>(shapes.size());
    stone += aggregate_volume(t, 1, false) / static_cast<double>(shapes.size());
  }
  const auto cube = [](double x) { return x * x * x; };
  const double mean = (sphere * (cube(middle) - cube(a)) + stone * (cube(b) - cube(middle))) / (3 * std::log(b / a));
  const double expected = 0.4 * spec.box.volume() / mean;
  ASSERT_GT(expected, 1000);
  EXPECT_NEAR(static_cast<double>(c.row[0].count), expected, 1.5);  // rounded, and possibly one more or less
}

/// Insertion and packing both place all requested particles inside the box and without overlap.
TEST(ShapePlacement, BothMethodsKeepThemApartAndInside) {
  const std::vector<ShapeTemplate> shapes = stones();
  for (const auto& [method, share] : {std::pair{PlacementMethod::insertion, 0.3}, {PlacementMethod::packing, 0.5}}) {
    const SpecimenSpec spec = small_mix(share);
    const ShapeComposition c = compose_shapes(spec, shapes, small_ones);
    ShapePlacementSpec how;
    how.method = method;
    const ShapePlacement p = place_shapes(spec.box, shapes, c, how);
    ASSERT_EQ(p.aggregate.size(), c.aggregate.size());
    expect_sound(spec.box, p, shapes);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(p.row[k].fraction, c.row[k].fraction, 1e-12);
    for (std::size_t k = 0; k < p.aggregate.size(); ++k) {
      const AggregateRequest& r = c.aggregate[k];
      EXPECT_EQ(p.aggregate[k].shape, r.shape);
      EXPECT_EQ(p.aggregate[k].sphere, r.sphere);
      EXPECT_NEAR(p.aggregate[k].pose.scale * shapes[r.shape].d_intermediate, r.size, 1e-15);
    }
  }
}

/// A contact pushes both particles with the same force. One of two similar aggregates is four times as large as the
/// second and has about 16 times the mass in this relaxation. So the larger aggregate moves 16 times less than the
/// smaller one, and rotates still less.
TEST(ShapePlacement, PackedStonesGiveWayByTheirMasses) {
  const ShapeTemplate shape = shape_template(test::stone(2, 1));
  const ShapeGeometry geometry(shape);
  std::vector<ShapeBody> bodies{{geometry, 0.008, false}, {geometry, 0.002, false}};
  const Vec3d start[] = {{0.02, 0.02, 0.02}, {0.0235, 0.0215, 0.0205}};
  for (std::size_t i = 0; i < 2; ++i) {
    bodies[i].scale *= 0.1;
    bodies[i].centre = start[i];
  }
  EXPECT_EQ(pack({{0.04, 0.04, 0.04}}, bodies, 0.1, 0.02, [](double) {}), 1);
  const Vec3d large = bodies[0].centre - start[0], small = bodies[1].centre - start[1];
  EXPECT_GT(norm(small), 1e-4);
  EXPECT_LT(norm(16 * large + small), 1e-6 * norm(small));
  const auto turn = [&](std::size_t i) { return 2 * std::acos(std::min(1.0, std::abs(bodies[i].turn[0]))); };
  EXPECT_LT(turn(0), 0.1 * turn(1));
}

TEST(ShapePlacement, SameBitsForAnyNumberOfThreadsOthersForAnotherSeed) {
  const std::vector<ShapeTemplate> shapes = stones();
  SpecimenSpec spec = small_mix(0.3);
  spec.box = {{0.035, 0.035, 0.035}};
  spec.aggregate[0].sieve_max = 0.0025;
  const ShapeComposition c = compose_shapes(spec, shapes, small_ones);
  ASSERT_GT(c.aggregate.size(), 1000u);  // fewer particles are processed by one thread
  const int threads = omp_get_max_threads();
  for (const PlacementMethod method : {PlacementMethod::insertion, PlacementMethod::packing}) {
    ShapePlacementSpec how;
    // the last attempts are in cells that may still have space
    how.method = method, how.allow_short = true, how.attempts = 3000;
    omp_set_num_threads(1);
    const ShapePlacement one = place_shapes(spec.box, shapes, c, how);
    for (int t : {2, 3, 16}) {
      omp_set_num_threads(t);
      EXPECT_TRUE(same_bits(one, place_shapes(spec.box, shapes, c, how))) << t << " threads";
    }
    how.seed = 2;
    EXPECT_FALSE(same_bits(one, place_shapes(spec.box, shapes, c, how)));
  }
  omp_set_num_threads(threads);
}

TEST(ShapePlacement, FailedInsertionSaysHowFarItGot) {
  const std::vector<ShapeTemplate> shapes = stones();
  const SpecimenSpec spec = small_mix(0.7);
  const ShapeComposition c = compose_shapes(spec, shapes, {});
  ShapePlacementSpec how;
  how.method = PlacementMethod::insertion, how.attempts = 3000;
  const std::string message = message_of([&] { place_shapes(spec.box, shapes, c, how); });
  EXPECT_NE(message.find("no space for aggregate"), std::string::npos) << message;
  EXPECT_NE(message.find("of class 4.75-8 mm"), std::string::npos) << message;
  EXPECT_NE(message.find("% of the class's volume"), std::string::npos) << message;
  double millimetres = 0;
  ASSERT_NE(message.find("D^I "), std::string::npos) << message;
  ASSERT_EQ(std::sscanf(message.c_str() + message.find("D^I "), "D^I %lf mm)", &millimetres), 1) << message;
  EXPECT_GE(millimetres, 4.75);
  EXPECT_LE(millimetres, 8);

  how.allow_short = true;
  const ShapePlacement p = place_shapes(spec.box, shapes, c, how);
  expect_sound(spec.box, p, shapes);
  EXPECT_LT(p.row[1].count, p.row[1].count_asked);
  EXPECT_LT(p.row[1].fraction, p.row[1].fraction_asked);
  EXPECT_GT(p.row[1].fraction, 0.1);
}

/// Returns two spheres for each shape, far apart and well inside of it.
std::vector<MultiSphere> dumbbells(const ShapeComposition& c, const std::vector<ShapeTemplate>& shapes) {
  std::vector<MultiSphere> out;
  for (const AggregateRequest& r : c.aggregate) {
    if (r.sphere)
      out.push_back({{Vec3d{}}, {r.size * shapes[r.shape].sphere_size / 2}});
    else
      out.push_back({{{-0.3 * r.size, 0, 0}, {0.3 * r.size, 0, 0}}, {0.15 * r.size, 0.2 * r.size}});
  }
  return out;
}

/// If overlap is tested with the spheres of the aggregates in place of their surfaces, the spheres keep their distance,
/// and surfaces may interlock. So more aggregates fit than if overlap is tested with surfaces.
TEST(ShapePlacement, TestedBySpheresTheyInterlock) {
  const std::vector<ShapeTemplate> shapes = stones();
  // more than fits if overlap is tested with surfaces, see FailedInsertionSaysHowFarItGot
  const SpecimenSpec spec = small_mix(0.7);
  const ShapeComposition c = compose_shapes(spec, shapes, small_ones);
  constexpr double spacing = 1e-4;
  ShapePlacementSpec how;
  how.method = PlacementMethod::insertion, how.attempts = 30'000;
  how.spheres = dumbbells(c, shapes), how.spacing = spacing;
  const ShapePlacement p = place_shapes(spec.box, shapes, c, how);
  ASSERT_EQ(p.aggregate.size(), c.aggregate.size());
  int interlocked = 0;
  for (std::size_t i = 0; i < p.aggregate.size(); ++i) {
    ASSERT_EQ(p.request[i], i);
    const auto moved = [&](std::size_t k) {
      MultiSphere s = how.spheres[k];
      for (Vec3d& x : s.centre) x = Pose{p.aggregate[k].pose.centre, p.aggregate[k].pose.turn, 1}(x);
      return s;
    };
    const MultiSphere a = moved(i);
    for (std::size_t m = 0; m < a.size(); ++m) {  // 1e-15 m: rounding of a position in this box, as above
      const Vec3d x = a.centre[m], l = spec.box.size;
      EXPECT_GE(std::min({x.x, x.y, x.z, l.x - x.x, l.y - x.y, l.z - x.z}), a.radius[m] - 1e-15);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const MultiSphere b = moved(j);
      for (std::size_t m = 0; m < a.size(); ++m)
        for (std::size_t n = 0; n < b.size(); ++n)
          EXPECT_GE(norm(a.centre[m] - b.centre[n]), a.radius[m] + b.radius[n] + spacing - 1e-15) << i << " " << j;
      if (interlocked > 0) continue;  // one interlocked pair is enough
      interlocked +=
          !p.aggregate[i].sphere && !p.aggregate[j].sphere && brute_overlap(p.aggregate[i], p.aggregate[j], shapes);
    }
  }
  EXPECT_GT(interlocked, 0);
}

TEST(ShapePlacement, SurfacesKeepTheSpacing) {
  const std::vector<ShapeTemplate> shapes = stones();
  const SpecimenSpec spec = small_mix(0.2);
  const ShapeComposition c = compose_shapes(spec, shapes, small_ones);
  ShapePlacementSpec how;
  how.method = PlacementMethod::insertion, how.spacing = 5e-4;
  const ShapePlacement p = place_shapes(spec.box, shapes, c, how);
  expect_sound(spec.box, p, shapes);
  std::vector<Surface> placed;
  for (const PlacedAggregate& a : p.aggregate) placed.push_back(test::placed_surface(a, shapes));
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (std::size_t j = 0; j < placed.size(); ++j) {
      const PlacedAggregate &a = p.aggregate[i], &b = p.aggregate[j];
      if (i == j || b.sphere) continue;
      const double reach = a.sphere ? a.pose.scale * shapes[a.shape].d_intermediate / 2 : 0;
      // Tolerance, about 0.03 of D^I: shapes are compared by sample points, which are within 0.003 of D^I of the
      // surface, and by a grid of distances, which has 40 cells along the longest side of a shape's bounding box.
      const double rough = a.sphere ? 1e-12 : 0.03 * b.pose.scale * shapes[b.shape].d_intermediate;
      for (const Vec3d& x : a.sphere ? std::vector{a.pose.centre} : placed[i].points)
        EXPECT_GT(test::signed_distance(placed[j], x) - reach, how.spacing - rough) << i << " " << j;
    }
}

TEST(ShapePlacement, JammedPackingSaysWhere) {
  const std::vector<ShapeTemplate> shapes = stones();
  SpecimenSpec spec = small_mix(0.9);
  spec.box = {{0.012, 0.012, 0.012}};
  spec.aggregate = {{0.005, 0.006, 0.85, {}}};
  const std::string message = message_of([&] { place_shapes(spec.box, shapes, compose_shapes(spec, shapes, {}), {}); });
  EXPECT_NE(message.find("jammed at"), std::string::npos) << message;
  EXPECT_NE(message.find("85 % is requested"), std::string::npos) << message;
  double size = 0, percent = 0;
  const std::size_t figures = message.find("jammed at");
  ASSERT_NE(figures, std::string::npos);
  ASSERT_EQ(
      std::sscanf(message.c_str() + figures, "jammed at %lf of their final size: they fill %lf %%", &size, &percent),
      2);
  EXPECT_NEAR(percent, 85 * size * size * size, 0.1) << "three digits are written";
}

TEST(ShapePlacement, SizesAndSettingsOutOfRangeAreRefused) {
  const std::vector<ShapeTemplate> shapes = stones();
  const Box box = small_mix(0).box;
  const ShapeComposition good{{{"all", 1, 1, 0.1, 0.1}}, {{0, 0, 0.004, false}}};
  const auto message = [&](const ShapeComposition& c, const ShapePlacementSpec& how) {
    return message_of([&] { place_shapes(box, shapes, c, how); });
  };
  EXPECT_EQ(message(good, {}), "(accepted)");
  for (const AggregateRequest bad :
       {AggregateRequest{0, 3, 0.004}, {0, -1, 0.004}, {1, 0, 0.004}, {0, 0, -1.0}, {0, 0, std::nan("")}}) {
    ShapeComposition c = good;
    c.aggregate[0] = bad;
    EXPECT_NE(message(c, {}).find("expected"), std::string::npos);
  }
  for (const auto& spoil :
       {+[](ShapePlacementSpec& s) { s.attempts = 0; }, +[](ShapePlacementSpec& s) { s.gap = 0; },
        // a spacing cannot be combined with packing
        +[](ShapePlacementSpec& s) { s.gap = 0.5; }, +[](ShapePlacementSpec& s) { s.spacing = 1e-3; },
        +[](ShapePlacementSpec& s) { s.method = PlacementMethod::insertion, s.spacing = -1e-3; },
        +[](ShapePlacementSpec& s) { s.spheres.resize(1); },
        +[](ShapePlacementSpec& s) {
          s.method = PlacementMethod::insertion;
          s.spheres.resize(2);
        }}) {
    ShapePlacementSpec how;
    spoil(how);
    EXPECT_NE(message(good, how).find("expected"), std::string::npos);
  }
  ShapeComposition vast = good;
  vast.aggregate[0].size = 0.1;
  EXPECT_NE(message(vast, {}).find("jammed"), std::string::npos);
  ShapePlacementSpec one_by_one;
  one_by_one.method = PlacementMethod::insertion, one_by_one.attempts = 100;
  EXPECT_NE(message(vast, one_by_one).find("no space"), std::string::npos);
  EXPECT_EQ(message({}, {}), "(accepted)");
  EXPECT_THROW(compose_shapes(small_mix(0.1), {}, {}), InputError);
}

TEST(ShapePlacement, DirectionsStayEvenAndClassesMixed) {
  const std::vector<ShapeTemplate> shapes = stones();
  SpecimenSpec spec = small_mix(0.45);
  spec.box = {{0.03, 0.03, 0.03}};
  for (std::uint64_t seed = 1; seed <= (test::long_tests ? 3 : 1); ++seed) {
    spec.seed = seed;
    ShapePlacementSpec how;
    how.seed = seed;
    const ShapePlacement p = place_shapes(spec.box, shapes, compose_shapes(spec, shapes, {}), how);
    ASSERT_GT(p.aggregate.size(), 300u);
    EXPECT_GT(test::evenness_of_directions(p.aggregate, shapes), 0.01) << seed;
    double height = 0, count = 0;
    for (const PlacedAggregate& a : p.aggregate)
      if (a.size_class == 0) height += a.pose.centre.z, count += 1;
    // The mean height of n uniformly distributed particles has the standard deviation L/√(12·n). The tolerance is four
    // standard deviations.
    EXPECT_NEAR(height / count, 0.015, 4 * 0.03 / std::sqrt(12 * count)) << seed;
  }
}

/// Two balls of 8 mm fit into a cube of 12.62 mm. In a smaller cube the balls reach their full size only if they
/// overlap by about twice the allowed gap, which does not count as packed.
TEST(ShapePlacement, FullSizeWithOverlapsIsNoPacking) {
  const ShapeTemplate shape = shape_template(test::stone(2, 1));
  const ShapeGeometry geometry(shape);
  constexpr double edge = 0.0123;
  std::vector<ShapeBody> bodies(2, ShapeBody(geometry, 0.008, true));
  for (std::size_t i = 0; i < 2; ++i) {
    const double at = (i == 0 ? 0.3 : 0.7) * edge;
    bodies[i].scale *= 0.1;
    bodies[i].centre = {at, at, at};
  }
  const double reached = pack({{edge, edge, edge}}, bodies, 0.1, 0.02, [](double) {});
  EXPECT_GT(reached, 0.999);
  EXPECT_LT(reached, 1);
}

}  // namespace
}  // namespace macadam
