// SPDX-License-Identifier: GPL-3.0-or-later
// domain_test.cpp  Tests what the shapes of domains answer about points, spheres, areas and volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "macadam/specimen.hpp"

namespace macadam {
namespace {

constexpr double pi = std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();

const Domain box{{2, 3, 5}}, cylinder = cylinder_domain(2, 5), disc = domain_of("disc", {4, 3}),
                             half_disc = domain_of("half_disc", {4, 3}), beam = domain_of("beam", {7, 2, 3}),
                             trapezoid = domain_of("trapezoid", {4, 2, 1.5, 5});

TEST(Domain, MeasuresOfTheBoxAreProductsOfItsEdges) {
  EXPECT_TRUE(Domain{}.is_box());
  EXPECT_EQ(box.volume(), 30);
  EXPECT_EQ(box.section_area(), 6);
  EXPECT_EQ(box.gauge_length(), 5);
  EXPECT_EQ(box.wall_area(0), 15);
  EXPECT_EQ(box.wall_area(3), 10);
  EXPECT_EQ(box.wall_area(5), 6);
  EXPECT_STREQ(box.wall_name(2), "-y");
  EXPECT_EQ(box.dimensions(), "box of 2 x 3 x 5 m");
}

TEST(Domain, MeasuresOfTheCylinderAreThoseOfACircle) {
  EXPECT_FALSE(cylinder.is_box());
  EXPECT_DOUBLE_EQ(cylinder.section_area(), pi);
  EXPECT_DOUBLE_EQ(cylinder.volume(), 5 * pi);
  EXPECT_EQ(cylinder.gauge_length(), 5);
  EXPECT_STREQ(cylinder.name(), "cylinder");
  EXPECT_STREQ(cylinder.wall_name(0), "side");
  EXPECT_EQ(cylinder.dimensions(), "cylinder with a diameter of 2 m and a height of 5 m");
  for (int k = 1; k < 4; ++k) EXPECT_EQ(cylinder.wall_area(k), 0);
  // The circumference of a regular polygon with the circle's area is 1 + (π/n)²/6 times the circle's.
  const double excess = std::pow(pi / domains::Cylinder::sides, 2) / 6;
  EXPECT_NEAR(cylinder.wall_area(0) / (2 * pi * 5), 1 + excess, 1e-8);  // the next term is of order (π/n)⁴ = 6e-9
}

TEST(Domain, SignedDistancesAreThoseToTheNearestPoint) {
  EXPECT_DOUBLE_EQ(box.signed_distance({1, 1.5, 1}), -1);
  EXPECT_DOUBLE_EQ(box.signed_distance({1, 1.5, 4.75}), -0.25);
  EXPECT_DOUBLE_EQ(box.signed_distance({-3, 7, 2}), 5);  // from an edge of the box
  EXPECT_DOUBLE_EQ(cylinder.signed_distance({1, 1, 0.5}), -0.5);
  EXPECT_DOUBLE_EQ(cylinder.signed_distance({1.75, 1, 2}), -0.25);
  EXPECT_DOUBLE_EQ(cylinder.signed_distance({1, 4, 2}), 2);
  EXPECT_DOUBLE_EQ(cylinder.signed_distance({1, 5, 9}), 5);  // from the rim: 3 sideways, 4 upwards
}

TEST(Domain, PointsOnTheSurfaceBelongToIt) {
  for (const Domain& d : {box, cylinder}) {
    EXPECT_TRUE(d.contains({1, 0, 0}));
    EXPECT_TRUE(d.contains({2, 1, 5}));
    EXPECT_FALSE(d.contains({2.0000001, 1, 1}));
    EXPECT_FALSE(d.contains({1, 1, -1e-12}));
    EXPECT_FALSE(d.contains({nan, 1, 1}));
    EXPECT_FALSE(d.contains({1, nan, 1}));
    EXPECT_FALSE(d.contains({1, 1, nan}));
  }
  EXPECT_TRUE(box.contains({0, 0, 0}));
  EXPECT_FALSE(cylinder.contains({0, 0, 0}));  // a corner of the bounding box
}

// A sphere that touches the surface from inside does not overlap it; one that reaches beyond it is pushed inwards.
TEST(Domain, OverlapsPushSpheresInwards) {
  for (const Domain& d : {box, cylinder}) {
    const domains::Overlap none = d.overlap({1, 1, 2}, 1);
    EXPECT_EQ(norm(none.push) + norm(none.squares), 0);
    const domains::Overlap end = d.overlap({1, 1, 4.75}, 0.5);
    EXPECT_DOUBLE_EQ(end.push.z, -0.25);
    EXPECT_DOUBLE_EQ(end.squares.z, 0.0625);
  }
  const Vec3d c{1 + 0.6 * 0.9, 1 + 0.8 * 0.9, 2};  // 0.1 from the side
  const domains::Overlap side = cylinder.overlap(c, 0.3);
  EXPECT_NEAR(side.push.x, -0.6 * 0.2, 1e-15);
  EXPECT_NEAR(side.push.y, -0.8 * 0.2, 1e-15);
  EXPECT_EQ(side.push.z, 0);
  EXPECT_NEAR(side.squares.x + side.squares.y, 0.04, 1e-15);
}

TEST(Domain, PointsArePulledInsideAndInnerPointsStay) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-6, 8);
  for (const Domain& d : {box, cylinder, disc, half_disc, beam, trapezoid}) {
    for (int k = 0; k < 1000; ++k) {
      const Vec3d p{anywhere(random), anywhere(random), anywhere(random)}, q = d.pulled_inside(p);
      EXPECT_LT(d.signed_distance(q), -1e-3);
      // 1e-15: rounding of a point that is moved by a factor of 1
      if (d.signed_distance(p) < -0.02) { EXPECT_LT(norm(q - p), 1e-15) << d.name(); }
    }
  }
}

// The polygon between the planes has the area of the circle, and its surface is within 2.6e-5 radii of the cylinder's.
TEST(Domain, PlanesOfTheSideStandForTheCircle) {
  EXPECT_TRUE(box.side_planes().empty());
  const auto planes = cylinder.side_planes();
  ASSERT_EQ(planes.size(), static_cast<std::size_t>(domains::Cylinder::sides));
  const double x = pi / domains::Cylinder::sides;
  for (const domains::Plane& p : planes) {
    EXPECT_NEAR(norm(p.normal), 1, 1e-15);
    EXPECT_EQ(p.normal.z, 0);
    const double inner = -p.height({1, 1, 2}), edge = inner / std::cos(x);
    EXPECT_NEAR(inner, 1 - x * x / 6, 1e-9);  // terms of order x⁴ = 6e-9, with coefficients below 1/30
    EXPECT_NEAR(edge, 1 + x * x / 3, 1e-8);
    EXPECT_LT(std::max(1 - inner, edge - 1), 2.6e-5);
  }
}

TEST(Domain, ShapesHaveNames) {
  EXPECT_EQ(domains::shape_names(),
            (std::vector<std::string>{"box", "cylinder", "disc", "half_disc", "beam", "trapezoid"}));
  EXPECT_TRUE(std::holds_alternative<domains::Cylinder>(domains::shape_named("cylinder").value()));
  EXPECT_FALSE(domains::shape_named("sphere"));
  EXPECT_EQ(cylinder.expected_size(), nullptr);
  EXPECT_NE((Domain{{1, 2, 3}, domains::Cylinder{}}).expected_size(), nullptr);
}

TEST(Domain, MeasuresOfTheOtherShapesFollowFromTheirProfiles) {
  EXPECT_DOUBLE_EQ(disc.volume(), 4 * pi * 3);
  EXPECT_DOUBLE_EQ(disc.section_area(1), 4 * pi);
  EXPECT_EQ(disc.section_area(), 12);  // through the axis: diameter times thickness
  EXPECT_EQ(disc.section_area(0), 12);
  EXPECT_EQ(disc.gauge_length(), 4);
  EXPECT_EQ(disc.gauge_length(1), 3);
  EXPECT_DOUBLE_EQ(half_disc.volume(), 2 * pi * 3);
  EXPECT_DOUBLE_EQ(half_disc.section_area(), 2 * std::sqrt(3.0) * 3);  // at half of the height 2
  EXPECT_DOUBLE_EQ(half_disc.section_area(0), 6);
  EXPECT_EQ(half_disc.gauge_length(), 2);
  EXPECT_EQ(beam.volume(), 42);
  EXPECT_EQ(beam.section_area(0), 6);
  EXPECT_EQ(beam.section_area(), 14);
  EXPECT_DOUBLE_EQ(trapezoid.volume(), 3 * 5 * 1.5);
  EXPECT_DOUBLE_EQ(trapezoid.section_area(1), 15);
  EXPECT_DOUBLE_EQ(trapezoid.section_area(), 4.5);
  EXPECT_DOUBLE_EQ(trapezoid.section_area(0), 7.5);
  EXPECT_TRUE(beam.is_box());
  for (const Domain& d : {box, cylinder, beam}) EXPECT_TRUE(d.has_uniform_section()) << d.name();
  for (const Domain& d : {disc, half_disc, trapezoid}) EXPECT_FALSE(d.has_uniform_section()) << d.name();
  EXPECT_EQ(half_disc.smallest_dimension().length, 2);
  EXPECT_EQ(trapezoid.smallest_dimension().length, 1.5);
  EXPECT_EQ(disc.dimensions(), "disc with a diameter of 4 m and a thickness of 3 m");
}

// The walls of a prism have the areas of its ends and of its sides. The circumference of the polygon of a disc is
// 1 + (π/n)²/6 times the circumference of the circle, as for a cylinder.
TEST(Domain, WallsOfPrismsHaveTheirAreas) {
  const double excess = 1 + std::pow(pi / domains::Disc::sides, 2) / 6;
  EXPECT_NEAR(disc.wall_area(0) / (4 * pi * 3), excess, 1e-8);
  EXPECT_NEAR(half_disc.wall_area(0) / (2 * pi * 3), excess, 1e-8);
  EXPECT_NEAR(half_disc.wall_area(1) / 12, 1, 2.6e-5);  // the corners of the polygon are 2.6e-5 radii outside the arc
  EXPECT_DOUBLE_EQ(half_disc.wall_area(3), 2 * pi);
  for (const Domain& d : {disc, half_disc})
    for (const int k : {4, 5}) EXPECT_EQ(d.wall_area(k), 0) << d.name();
  const double inclined = std::hypot(1, 5) * 1.5;
  for (const int k : {0, 1}) EXPECT_DOUBLE_EQ(trapezoid.wall_area(k), inclined);
  for (const int k : {2, 3}) EXPECT_DOUBLE_EQ(trapezoid.wall_area(k), 15);
  EXPECT_DOUBLE_EQ(trapezoid.wall_area(4), 6);
  EXPECT_DOUBLE_EQ(trapezoid.wall_area(5), 3);
  EXPECT_EQ(beam.wall_area(5), 14);
}

TEST(Domain, DistancesFromPrismsAreThoseToTheNearestPoint) {
  EXPECT_DOUBLE_EQ(disc.signed_distance({2, 1.5, 2}), -1.5);  // from the faces
  EXPECT_DOUBLE_EQ(disc.signed_distance({2, 1.5, 3}), -1);
  EXPECT_DOUBLE_EQ(disc.signed_distance({2, 7, 7}), 5);  // from the rim: 4 along y, 3 upwards
  EXPECT_DOUBLE_EQ(half_disc.signed_distance({2, 1.5, 0.25}), -0.25);
  EXPECT_DOUBLE_EQ(half_disc.signed_distance({2, 1.5, 1.5}), -0.5);
  EXPECT_DOUBLE_EQ(half_disc.signed_distance({2, 1.5, -1}), 1);
  EXPECT_DOUBLE_EQ(half_disc.signed_distance({7, 1.5, -4}), 5);  // from the corner
  EXPECT_DOUBLE_EQ(trapezoid.signed_distance({2, 0.75, 2}), -0.75);
  // an inclined side leans by 1 over 5: a point at a horizontal distance of 0.26 is 0.26·5/√26 from it
  EXPECT_NEAR(trapezoid.signed_distance({0.4 + 0.26, 0.75, 2}), -0.26 * 5 / std::sqrt(26.0), 1e-15);
  EXPECT_NEAR(trapezoid.signed_distance({0.4 - 0.26, 0.75, 2}), 0.26 * 5 / std::sqrt(26.0), 1e-15);
  EXPECT_DOUBLE_EQ(trapezoid.signed_distance({-3, 0.75, -4}), 5);  // from the corner of the base
  EXPECT_DOUBLE_EQ(trapezoid.signed_distance({2, 0.75, 7}), 2);
}

// The signed distance changes by at most the distance of two points, and the distance of a point outside is the
// distance of the nearest of many points inside.
TEST(Domain, DistancesOfAllShapesAreConsistent) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-2, 8);
  const auto point = [&] { return Vec3d{anywhere(random), anywhere(random), anywhere(random)}; };
  for (const Domain& d : {box, cylinder, disc, half_disc, beam, trapezoid}) {
    int inside = 0;
    for (int k = 0; k < 4000; ++k) {
      const Vec3d p = point(), q = point();
      const double at_p = d.signed_distance(p), at_q = d.signed_distance(q);
      EXPECT_LE(std::abs(at_p - at_q), norm(p - q) * (1 + 1e-14)) << d.name();
      EXPECT_EQ(d.contains(p), at_p <= 0) << d.name();
      // a sphere overlaps the walls exactly if it reaches beyond the nearest one
      if (at_p < 0) {
        const domains::Overlap clear = d.overlap(p, -at_p * (1 - 1e-12)), beyond = d.overlap(p, -at_p + 1e-3);
        EXPECT_EQ(norm(clear.push) + norm(clear.squares), 0) << d.name();
        EXPECT_GT(norm(beyond.squares), 0) << d.name();
      }
      inside += at_p <= 0;
    }
    // The number of points inside, of 4000 in a cube of 10 m, is binomial with a standard deviation below
    // √(4000·V/1000).
    EXPECT_NEAR(inside, 4000 * d.volume() / 1000, 4 * std::sqrt(4000 * d.volume() / 1000)) << d.name();
  }
}

TEST(Domain, DimensionsGiveTheDomainAgain) {
  for (const Domain& d : {box, cylinder, disc, half_disc, beam, trapezoid}) {
    const Domain again = domain_of(d.name(), d.values());
    EXPECT_EQ(norm(again.size - d.size), 0) << d.name();
    EXPECT_EQ(again.volume(), d.volume()) << d.name();
    EXPECT_EQ(d.expected_size(), nullptr) << d.name();
  }
  EXPECT_NE(domain_of("beam", {2, 3, 1}).expected_size(), nullptr);
  EXPECT_NE(domain_of("trapezoid", {2, 3, 1, 1}).expected_size(), nullptr);
  EXPECT_NE((Domain{{2, 1, 2}, domains::HalfDisc{}}).expected_size(), nullptr);
  EXPECT_NE((Domain{{2, 1, 3}, domains::Disc{}}).expected_size(), nullptr);
}

TEST(Domain, SidesAreAskedForWithAnInset) {
  EXPECT_TRUE(half_disc.inside_sides({2, 0, 1}, 1));
  EXPECT_FALSE(half_disc.inside_sides({2, 0, 0.9}, 1));
  EXPECT_FALSE(half_disc.inside_sides({2, 0, 1.1}, 1));
  EXPECT_FALSE(trapezoid.inside_sides({0.5, 0, 4}, 0));
  EXPECT_TRUE(box.inside_sides({0, 0, 0}, 1));
  EXPECT_TRUE(cylinder.inside_sides({1.5, 1, 0}, 0.5));
  EXPECT_FALSE(cylinder.inside_sides({1.5, 1, 0}, 0.51));
}

}  // namespace
}  // namespace macadam
