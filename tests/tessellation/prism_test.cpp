// SPDX-License-Identifier: GPL-3.0-or-later
// prism_test.cpp  Tests cells, facets and sections of specimens whose domain is a disc, a half disc, a beam or a
// trapezoid.
#include <cmath>
#include <random>

#include "macadam/contact_network.hpp"
#include "macadam/cross_section.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_spheres.hpp"
#include "tests/tessellation/tessellation_checks.hpp"

namespace macadam {
namespace {

using test::add;

const Domain disc = domain_of("disc", {0.1, 0.04}), half_disc = domain_of("half_disc", {0.15, 0.05}),
             beam = domain_of("beam", {0.16, 0.04, 0.05}),
             trapezoid = domain_of("trapezoid", {0.056, 0.025, 0.025, 0.25});

/// Returns spheres at random places of a domain. Radii differ by up to a factor of two.
Specimen random_spheres(const Domain& domain, int spheres, unsigned seed) {
  Specimen s;
  s.box = domain;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double spacing = std::cbrt(domain.volume() / spheres);
  while (static_cast<int>(s.size()) < spheres) {
    const Vec3d p{unit(random) * domain.size.x, unit(random) * domain.size.y, unit(random) * domain.size.z};
    const double r = spacing * (0.3 + 0.3 * unit(random));
    if (domain.contains(p)) add(s, p, r);
  }
  return s;
}

// The facets on every wall sum to the wall's area, and the cells to the volume. Both are those of planes, which the
// polygons of curved sides are too, so they agree up to rounding of some thousand terms (expect_invariants: 1e-12).
// 1e-10: facets have an accuracy of 1e-11 of the spacing, and a facet may be as narrow as a tenth of the spacing.
TEST(Prisms, CellsFillThem) {
  for (const Domain& domain : {disc, half_disc, beam, trapezoid}) {
    for (const int spheres : {1, 2, 40, 700, 4000}) {
      const Specimen s = random_spheres(domain, spheres, 3);
      const Tessellation t = tessellate(s);
      SCOPED_TRACE(std::string(domain.name()) + " with " + std::to_string(spheres) + " spheres");
      test::expect_invariants(s, t, 1e-10);
      for (const Facet& f : t.facets)
        if (f.b < 0) { EXPECT_GT(domain.wall_area(-1 - f.b), 0) << f.b; }
    }
  }
}

TEST(Prisms, VerticesLieInsideOrOnTheirPlanes) {
  for (const Domain& domain : {disc, half_disc, beam, trapezoid}) {
    const Specimen s = random_spheres(domain, 500, 5);
    const Tessellation t = tessellate(s);
    // planes: rounding; the edges of the planes of an arc are 2.6e-5 radii outside
    const double beyond = domain.wall_area(5) > 0 ? 1e-15 : 1.3e-5 * domain.size.x;
    for (const Vec3d& v : t.vertices) EXPECT_LT(domain.signed_distance(v), beyond) << domain.name();
    for (const Facet& f : t.facets) {
      if (f.b >= 0) continue;
      for (const Vec3d& v : t.polygon(f)) EXPECT_NEAR(domain.signed_distance(v), 0, beyond) << domain.name() << f.b;
    }
  }
}

// The cell of a single sphere is the whole domain.
TEST(Prisms, OneSphereHasAllOfIt) {
  const auto facets = [](const Domain& domain) {
    Specimen s;
    s.box = domain;
    add(s, {0.4 * domain.size.x, 0.3 * domain.size.y, 0.4 * domain.size.z}, 0.005);
    const Tessellation t = tessellate(s);
    EXPECT_NEAR(t.cell_volume[0] / domain.volume(), 1, 1e-13) << domain.name();  // rounding of 360 terms
    return t.facets.size();
  };
  EXPECT_EQ(facets(disc), static_cast<std::size_t>(domains::Disc::sides + 2));
  EXPECT_EQ(facets(half_disc), static_cast<std::size_t>(domains::HalfDisc::sides + 3));
  EXPECT_EQ(facets(beam), 6U);
  EXPECT_EQ(facets(trapezoid), 6U);
}

TEST(Prisms, SectionsHaveTheirWidths) {
  const auto area = [](const Domain& domain, const SectionPlane& plane) {
    const Specimen s = random_spheres(domain, 400, 7);
    double sum = 0;
    for (const SectionCell& c : cut(s, tessellate(s), plane).cells) sum += c.area;
    return sum;
  };
  // Sections perpendicular to the axis of the prism, and those of planes, are exact up to rounding.
  EXPECT_NEAR(area(disc, {'y', 0.015}) / disc.section_area(1), 1, 1e-11);
  EXPECT_NEAR(area(half_disc, {'y', 0.015}) / half_disc.section_area(1), 1, 1e-11);
  EXPECT_NEAR(area(beam, {'x', 0.03}) / beam.section_area(0), 1, 1e-11);
  EXPECT_NEAR(area(trapezoid, {'y', 0.01}) / trapezoid.section_area(1), 1, 1e-11);
  EXPECT_NEAR(area(trapezoid, {'z', 0.125}) / trapezoid.section_area(), 1, 1e-11);
  EXPECT_NEAR(area(trapezoid, {'x', 0.028}) / trapezoid.section_area(0), 1, 1e-11);
  // Near the side x = 0 the section is the triangle below an inclined side, which rises by 0.25 m over 0.0155 m.
  EXPECT_NEAR(area(trapezoid, {'x', 0.004}) / (0.004 / 0.0155 * 0.25 * 0.025), 1, 1e-11);
  // Chords: the planes of an arc are within 2.6e-5 radii of it, and cross the section at 45 degrees or more.
  EXPECT_NEAR(area(disc, {'z', 0.05}) / disc.section_area(), 1, 1e-4);
  EXPECT_NEAR(area(half_disc, {'z', 0.0375}) / half_disc.section_area(), 1, 1e-4);
  EXPECT_NEAR(area(half_disc, {'x', 0.075}) / half_disc.section_area(0), 1, 1e-4);
}

TEST(Prisms, OnlyPlatensAreContacts) {
  for (const Domain& domain : {disc, half_disc, trapezoid}) {
    Specimen s = random_spheres(domain, 300, 9);
    s.radius.assign(s.size(), 0.003);  // with equal radii no sphere is hidden
    const Tessellation t = tessellate(s);
    const ContactNetwork network = build_network(s, t);
    double platens = 0;
    for (const Contact& c : network.contacts)
      if (c.b < 0) {
        EXPECT_LE(c.b, wall_z_lo) << domain.name();
        platens += c.area;
      }
    EXPECT_NEAR(platens, domain.wall_area(4) + domain.wall_area(5), 1e-15) << domain.name();  // rounding, in m²
    NetworkSpec held;
    held.lateral_walls = true;
    EXPECT_THROW(build_network(s, t, held), InputError) << domain.name();
  }
}

// With rollers, the flat side of a half disc and a strip on its crown are the walls −z and +z. The facets within the
// two lower rollers and within the strip are contacts. The polygon of the tessellation differs from the arc by 1e-5 to
// 1e-4.
TEST(Prisms, RollersTouchAHalfDisc) {
  Domain domain = half_disc;
  const double width = 0.012, radius = 0.075, thickness = 0.05;
  ASSERT_TRUE(domain.set_rollers({{0.015, 0.135}, {radius}, width}));
  EXPECT_FALSE(Domain(disc).set_rollers({}));
  EXPECT_EQ(half_disc.rollers(), nullptr);
  Specimen s = random_spheres(domain, 4000, 11);
  s.radius.assign(s.size(), 0.003);  // with equal radii no sphere is hidden
  const Tessellation t = tessellate(s);
  test::expect_invariants(s, t, 1e-10);
  double flat = 0, crown = 0, within_rollers = 0, bottom = 0, top = 0;
  for (const Facet& f : t.facets) {
    if (f.b == wall_z_lo) {
      flat += f.area;
      if (std::abs(std::abs(f.centroid.x - radius) - 0.06) <= 0.5 * width) within_rollers += f.area;
    }
    if (f.b == wall_z_hi) crown += f.area;
  }
  for (const Contact& c : build_network(s, t).contacts) {
    if (c.b == wall_z_lo) bottom += c.area;
    if (c.b == wall_z_hi) top += c.area;
    EXPECT_TRUE(c.b >= 0 || c.b <= wall_z_lo) << c.b;
  }
  EXPECT_NEAR(flat / (2 * radius * thickness), 1, 1e-4);
  EXPECT_NEAR(crown / (2 * std::asin(0.5 * width / radius) * radius * thickness), 1, 1e-4);
  EXPECT_NEAR(top, crown, 1e-15);  // rounding, in m²
  EXPECT_NEAR(bottom, within_rollers, 1e-15);
  EXPECT_NEAR(bottom / (2 * width * thickness), 1, 0.2);  // some 26 facets on each roller
}

TEST(Prisms, ParticlesOutsideThemAreNamed) {
  Specimen s = random_spheres(half_disc, 5, 2);
  s.centre[3] = {0.001, 0.01, 0.07};  // a corner of the bounding box
  s.source = "scb.csv", s.first_line = 2;
  try {
    tessellate(s);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* words : {"scb.csv:5: particle 3: centre", "(0.001, 0.01, 0.07)",
                              "a point in the half disc with a diameter of 0.15 m and a thickness of 0.05 m"})
      EXPECT_NE(text.find(words), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace macadam
