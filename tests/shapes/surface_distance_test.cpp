// SPDX-License-Identifier: GPL-3.0-or-later
/// \file surface_distance_test.cpp  Compares the depth of points below a surface with closed forms.
#include "host/shapes/surface/surface_distance.hpp"

#include <gtest/gtest.h>

#include "host/spheres/random_stream.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam {
namespace {

constexpr double tolerance = 1e-13;  // a few roundings of lengths of order 1 to 10

/// Calls `visit` with random points in and around the cube from 0 to `edge`.
template <class Visit>
void at_random_points(double edge, const Visit& visit) {
  RandomStream random(1, 0);
  for (int k = 0; k < 20'000; ++k) {
    const double x = random.uniform(-0.3, 1.3), y = random.uniform(-0.3, 1.3);
    visit(Vec3d{edge * x, edge * y, edge * random.uniform(-0.3, 1.3)});
  }
}

TEST(SurfaceDistance, IsExactInAndAroundABox) {
  const SurfaceDistance distance(test::box_surface(3, 2, 1));
  at_random_points(3, [&](const Vec3d& p) {
    ASSERT_NEAR(distance.depth(p), test::depth_in_box(p, 3, 2, 1), tolerance) << p.x << " " << p.y << " " << p.z;
  });
}

TEST(SurfaceDistance, KnowsInsideFromOutsideAtAReentrantEdge) {
  const SurfaceDistance distance(test::l_surface(3, 1, 1));
  at_random_points(3, [&](const Vec3d& p) {
    // Outside, the distance from the union of two boxes is the distance from the nearer box. Inside, the depth in the
    // box in which the point lies deeper is a lower bound of the depth in the union.
    const double union_of_two = std::max(test::depth_in_box(p, 3, 1, 1), test::depth_in_box(p, 1, 3, 1));
    const double depth = distance.depth(p);
    ASSERT_EQ(depth > 0, union_of_two > 0) << p.x << " " << p.y << " " << p.z;
    if (depth > 0) {
      ASSERT_GE(depth, union_of_two - tolerance);
    } else {
      ASSERT_NEAR(depth, union_of_two, tolerance);
    }
  });
  // This point is on the bisector of the re-entrant edge. The edge is the nearest part of the surface; the four sides
  // are farther away.
  EXPECT_NEAR(distance.depth({0.7, 0.7, 0.5}), std::hypot(0.3, 0.3), tolerance);
}

TEST(SurfaceDistance, GrowsAlongTheDirectionItGives) {
  const SurfaceDistance distance(subdivided_icosahedron(1));
  at_random_points(1, [&](const Vec3d& p) {
    const Vec3d q = p - Vec3d{0.5, 0.5, 0.5};
    const auto [depth, inward] = distance.below(q, 10);
    ASSERT_NEAR(norm(inward), 1, tolerance);
    // A step of 0.1 against the direction `inward` reduces the depth by 0.1. Inside the surface, the step leads towards
    // the nearest point of the surface, and no other point becomes nearer. Outside of a convex surface, the step leads
    // away from the nearest point.
    ASSERT_NEAR(distance.depth(q - 0.1 * inward), depth - 0.1, 1e-12);
  });
}

TEST(SurfaceDistance, BeyondTheReachGivesALowerBound) {
  const SurfaceDistance distance(subdivided_icosahedron(1));
  int bounded = 0;
  at_random_points(1, [&](const Vec3d& p) {
    const double reach = 0.2, depth = distance.depth(p), found = distance.below(p, reach).depth;
    ASSERT_LE(found, depth + tolerance);
    if (found < depth - tolerance) {
      ++bounded;
      ASSERT_GT(found, reach);
    }
  });
  EXPECT_GT(bounded, 100);  // otherwise limiting the reach of the search would save nothing
}

}  // namespace
}  // namespace macadam
