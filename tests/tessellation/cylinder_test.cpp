// SPDX-License-Identifier: GPL-3.0-or-later
// cylinder_test.cpp  Tests cells, facets and sections of specimens whose domain is a cylinder.
#include <cmath>
#include <numbers>
#include <random>

#include "macadam/cross_section.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_spheres.hpp"
#include "tests/tessellation/tessellation_checks.hpp"

namespace macadam {
namespace {

using test::add;

constexpr double diameter = 0.05, height = 0.08, radius = diameter / 2, section = std::numbers::pi * radius * radius;

/// Returns a cylinder with spheres at random places. Radii differ by up to a factor of two.
Specimen random_cylinder(int spheres, unsigned seed) {
  Specimen s;
  s.box = cylinder_domain(diameter, height);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double spacing = std::cbrt(s.box.volume() / spheres);
  while (static_cast<int>(s.size()) < spheres) {
    const Vec3d p{unit(random) * diameter, unit(random) * diameter, unit(random) * height};
    const double r = spacing * (0.3 + 0.3 * unit(random));
    if (s.box.contains(p)) add(s, p, r);
  }
  return s;
}

double area_on(const Tessellation& t, std::int32_t wall) {
  double sum = 0;
  for (const Facet& f : t.facets)
    if (f.b == wall) sum += f.area;
  return sum;
}

// The sides of the tessellation are planes whose prism has the area of the circle, so areas and volumes agree up to
// rounding of some thousand terms. 1e-10: facets have an accuracy of 1e-11 of the spacing (tessellation_checks.hpp),
// and a facet on the side may be as narrow as a tenth of the spacing.
TEST(Cylinder, CellsFillIt) {
  for (const int spheres : {1, 2, 40, 700, 4000}) {
    const Specimen s = random_cylinder(spheres, 3);
    const Tessellation t = tessellate(s);
    test::expect_invariants(s, t, 1e-10);
    EXPECT_NEAR(area_on(t, wall_z_lo) / section, 1, 1e-12) << spheres;
    EXPECT_NEAR(area_on(t, wall_z_hi) / section, 1, 1e-12) << spheres;
    double volume = 0;
    for (const double v : t.cell_volume) volume += v;
    EXPECT_NEAR(volume / (section * height), 1, 1e-12) << spheres;
    for (const Facet& f : t.facets) EXPECT_TRUE(f.b >= 0 || f.b == wall_x_lo || f.b <= wall_z_lo) << f.b;
  }
}

TEST(Cylinder, VerticesLieInsideOrOnThePlanesOfTheSide) {
  const Specimen s = random_cylinder(500, 5);
  const Tessellation t = tessellate(s);
  for (const Vec3d& v : t.vertices) {
    EXPECT_LT(s.box.signed_distance(v), 2.6e-5 * radius);  // the edges of the planes
    EXPECT_GE(v.z, 0);
    EXPECT_LE(v.z, height);
  }
  for (const Facet& f : t.facets) {
    if (f.b != wall_x_lo) continue;
    for (const Vec3d& v : t.polygon(f)) EXPECT_NEAR(std::hypot(v.x - radius, v.y - radius), radius, 2.6e-5 * radius);
  }
}

// The cell of a single sphere is the whole cylinder.
TEST(Cylinder, OneSphereHasAllOfIt) {
  Specimen s;
  s.box = cylinder_domain(diameter, height);
  add(s, {0.03, 0.02, 0.05}, 0.01);
  const Tessellation t = tessellate(s);
  ASSERT_EQ(t.facets.size(), static_cast<std::size_t>(domains::Cylinder::sides + 2));
  EXPECT_EQ(t.facets[0].b, wall_z_hi);
  EXPECT_EQ(t.facets[1].b, wall_z_lo);
  EXPECT_EQ(t.polygon(t.facets[0]).size(), static_cast<std::size_t>(domains::Cylinder::sides));
  EXPECT_NEAR(t.cell_volume[0] / (section * height), 1, 1e-13);
}

TEST(Cylinder, SectionsFillTheCircleOrTheChord) {
  const Specimen s = random_cylinder(600, 7);
  const Tessellation t = tessellate(s);
  const auto area = [&](const SectionPlane& plane) {
    double sum = 0;
    for (const SectionCell& c : cut(s, t, plane).cells) sum += c.area;
    return sum;
  };
  EXPECT_NEAR(area({'z', 0.03}) / section, 1, 1e-11);
  EXPECT_NEAR(area({'z', 0.0}) / section, 1, 1e-11);
  for (const char axis : {'x', 'y'}) {
    for (const double at : {0.4 * radius, radius, 1.7 * radius}) {
      const double chord = 2 * std::sqrt(radius * radius - (at - radius) * (at - radius));
      // The planes of the side are within 2.6e-5 radii of the cylinder. A chord at 0.7 radii from the axis crosses the
      // side at an angle of 45 degrees, so its length differs by at most 2·√2·2.6e-5 radii.
      EXPECT_NEAR(area({axis, at}), chord * height, 1e-4 * radius * height) << axis << at;
    }
  }
}

TEST(Cylinder, ParticlesOutsideItAreNamed) {
  Specimen s = random_cylinder(5, 2);
  s.centre[3] = {0.001, 0.001, 0.04};  // a corner of the bounding box
  s.source = "core.csv", s.first_line = 2;
  try {
    tessellate(s);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* words : {"core.csv:5: particle 3: centre", "(0.001, 0.001, 0.04)",
                              "a point in the cylinder with a diameter of 0.05 m and a height of 0.08 m"})
      EXPECT_NE(text.find(words), std::string::npos) << text;
  }
}

TEST(Cylinder, ItsSideIsFree) {
  Specimen s = random_cylinder(300, 9);
  s.radius.assign(s.size(), 0.003);  // with equal radii no sphere is hidden
  const Tessellation t = tessellate(s);
  const ContactNetwork network = build_network(s, t);
  double platens = 0;
  for (const Contact& c : network.contacts) {
    EXPECT_TRUE(c.b >= 0 || c.b <= wall_z_lo);
    if (c.b < 0) platens += c.area;
  }
  EXPECT_NEAR(platens / (2 * section), 1, 1e-12);
  NetworkSpec held;
  held.lateral_walls = true;
  EXPECT_THROW(build_network(s, t, held), InputError);
}

}  // namespace
}  // namespace macadam
