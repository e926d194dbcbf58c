// SPDX-License-Identifier: GPL-3.0-or-later
// domain_test.cpp  Tests what box and cylinder answer about points, spheres, areas and volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "macadam/specimen.hpp"

namespace macadam {
namespace {

constexpr double pi = std::numbers::pi, nan = std::numeric_limits<double>::quiet_NaN();

const Domain box{{2, 3, 5}}, cylinder = cylinder_domain(2, 5);

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
  for (const Domain& d : {box, cylinder}) {
    for (int k = 0; k < 1000; ++k) {
      const Vec3d p{anywhere(random), anywhere(random), anywhere(random)}, q = d.pulled_inside(p);
      EXPECT_LT(d.signed_distance(q), -1e-3);
      // 1e-15: rounding of a point that is moved by a factor of 1
      if (d.signed_distance(p) < -0.01) { EXPECT_LT(norm(q - p), 1e-15); }
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
  EXPECT_EQ(domains::shape_names(), (std::vector<std::string>{"box", "cylinder"}));
  EXPECT_TRUE(std::holds_alternative<domains::Cylinder>(domains::shape_named("cylinder").value()));
  EXPECT_FALSE(domains::shape_named("sphere"));
  EXPECT_EQ(cylinder.expected_size(), nullptr);
  EXPECT_NE((Domain{{1, 2, 3}, domains::Cylinder{}}).expected_size(), nullptr);
}

TEST(Domain, SidesAreAskedForWithAnInset) {
  EXPECT_TRUE(box.inside_sides({0, 0, 0}, 1));
  EXPECT_TRUE(cylinder.inside_sides({1.5, 1, 0}, 0.5));
  EXPECT_FALSE(cylinder.inside_sides({1.5, 1, 0}, 0.51));
}

}  // namespace
}  // namespace macadam
