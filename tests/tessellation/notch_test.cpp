// SPDX-License-Identifier: GPL-3.0-or-later
// notch_test.cpp  Tests notches: which parts of facets they remove, the areas that remain, and which notches are
// refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_spheres.hpp"

namespace macadam {
namespace {

using test::add;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns spheres of equal radius at random places of a domain.
Specimen random_spheres(const Domain& domain, int spheres, unsigned seed) {
  Specimen s;
  s.box = domain;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double spacing = std::cbrt(domain.volume() / spheres);
  while (static_cast<int>(s.size()) < spheres) {
    const Vec3d p{unit(random) * domain.size.x, unit(random) * domain.size.y, unit(random) * domain.size.z};
    if (domain.contains(p)) add(s, p, 0.5 * spacing);
  }
  return s;
}

Notch notch_at(int axis, double position, std::array<double, 3> low = {-infinity, -infinity, -infinity},
               std::array<double, 3> high = {infinity, infinity, infinity}) {
  Notch out;
  out.axis = axis, out.position = position, out.low = low, out.high = high;
  return out;
}

NetworkSpec with(std::vector<Notch> notches) {
  NetworkSpec out;
  out.notches = std::move(notches);
  return out;
}

/// Returns the projected area of the contacts between particles on opposite sides of a plane x = position.
double area_across(const Specimen& s, const ContactNetwork& network, double position) {
  double sum = 0;
  for (const Contact& c : network.contacts)
    if (c.b >= 0 && (s.centre[c.a].x < position) != (s.centre[c.b].x < position)) sum += c.area * std::abs(c.n.x);
  return sum;
}

const Domain beam = domain_of("beam", {0.1, 0.03, 0.04});

// Without a notch the facets between the two sides of a plane cover the section once. With a notch they cover the
// ligament. Facets are accurate to 1e-11 of the spacing, and some hundred of them are summed.
TEST(Notches, LeaveTheLigament) {
  for (const int spheres : {30, 400, 2500}) {
    const Specimen s = random_spheres(beam, spheres, 3);
    const Tessellation t = tessellate(s);
    EXPECT_NEAR(area_across(s, build_network(s, t), 0.05) / (0.03 * 0.04), 1, 1e-9) << spheres;
    // a notch from below over the whole width, less deep than a particle or deeper than many
    for (const double depth : {0.0005, 0.015, 0.037}) {
      const Notch n = notch_at(0, 0.05, {-infinity, -infinity, 0}, {infinity, infinity, depth});
      const ContactNetwork network = build_network(s, t, with({n}));
      EXPECT_NEAR(area_across(s, network, 0.05) / (0.03 * (0.04 - depth)), 1, 1e-9) << spheres << " " << depth;
      ASSERT_EQ(network.notches.size(), 1U);
      EXPECT_NEAR(network.notches[0].ligament / (0.03 * (0.04 - depth)), 1, 1e-9);
      EXPECT_NEAR(network.notches[0].cut_area / (0.03 * depth), 1, 1e-9);
      EXPECT_GT(network.notches[0].removed + network.notches[0].shortened, 0);
    }
  }
}

// A rectangle inside the section, a notch narrower than a particle, and overlapping notches in one plane.
TEST(Notches, OfAnyExtentAreExact) {
  const Specimen s = random_spheres(beam, 600, 4);
  const Tessellation t = tessellate(s);
  const auto left = [&](std::vector<Notch> notches) {
    const ContactNetwork network = build_network(s, t, with(notches));
    double cut = 0;
    std::int64_t shortened = 0, removed = 0;
    for (const NotchCut& c : network.notches) cut += c.cut_area, shortened += c.shortened, removed += c.removed;
    // every contact that lost area counts once for each notch that cuts it
    std::map<std::pair<std::int32_t, std::int32_t>, double> whole;
    for (const Contact& c : build_network(s, t).contacts) whole[{c.a, c.b}] = c.area;
    const auto changed = std::ranges::count_if(network.contacts, [&](const Contact& c) {
      return c.area < whole.at({c.a, c.b}) * (1 - 1e-12);
    });
    EXPECT_GE(shortened, changed);
    EXPECT_LE(shortened, changed * static_cast<std::int64_t>(notches.size()));
    EXPECT_EQ(removed, static_cast<std::int64_t>(whole.size() - network.contacts.size()));
    const double area = area_across(s, network, 0.031);
    EXPECT_NEAR(area + cut, 0.03 * 0.04, 1e-9 * 0.03 * 0.04);
    return area;
  };
  const auto cut = [&](double area) { return 0.03 * 0.04 - area; };
  const Notch hole = notch_at(0, 0.031, {0, 0.011, 0.013}, {0, 0.017, 0.022});
  EXPECT_NEAR(left({hole}), cut(0.006 * 0.009), 1e-12);
  const Notch narrow = notch_at(0, 0.031, {0, 0.0101, 0.02}, {0, 0.0102, 0.0203});  // spheres have radii of 2.9 mm
  EXPECT_NEAR(left({narrow}), cut(1e-4 * 3e-4), 1e-12);
  const Notch across = notch_at(0, 0.031, {0, 0, 0.018}, {0, 0.03, 0.03});
  EXPECT_NEAR(left({hole, across}), cut(0.006 * 0.005 + 0.03 * 0.012), 1e-12);
  EXPECT_NEAR(left({across, hole}), cut(0.006 * 0.005 + 0.03 * 0.012), 1e-12);
}

// Notches in different planes cut their own contacts only.
TEST(Notches, InDifferentPlanesAreIndependent) {
  const Specimen s = random_spheres(beam, 800, 5);
  const Tessellation t = tessellate(s);
  const Notch left = notch_at(0, 0.03, {0, 0, 0}, {0, 0.03, 0.01}),
              right = notch_at(0, 0.07, {0, 0, 0.02}, {0, 0.03, 0.04});
  const ContactNetwork network = build_network(s, t, with({left, right}));
  EXPECT_NEAR(area_across(s, network, 0.03), 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(area_across(s, network, 0.07), 0.03 * 0.02, 1e-12);
  EXPECT_NEAR(area_across(s, network, 0.05), 0.03 * 0.04, 1e-12);
}

// All contacts but those through the notch keep their bits. Shortened contacts have points whose areas sum to their
// area, and whose first moments are the first moments of the contact.
TEST(Notches, LeaveOtherContactsAsTheyAre) {
  const Specimen s = random_spheres(beam, 500, 6);
  const Tessellation t = tessellate(s);
  const Notch n = notch_at(0, 0.05, {0, 0.01, 0}, {0, 0.02, 0.02});
  for (const Quadrature quadrature : {Quadrature::lumped, Quadrature::exact, Quadrature::one_point}) {
    NetworkSpec spec = with({n}), plain;
    spec.quadrature = plain.quadrature = quadrature;
    const ContactNetwork cut = build_network(s, t, spec), whole = build_network(s, t, plain);
    std::map<std::pair<std::int32_t, std::int32_t>, const Contact*> before;
    for (const Contact& c : whole.contacts) before[{c.a, c.b}] = &c;
    EXPECT_EQ(whole.contacts.size(), cut.contacts.size() + static_cast<std::size_t>(cut.notches[0].removed));
    std::int64_t shortened = 0;
    for (const Contact& c : cut.contacts) {
      const Contact& old = *before.at({c.a, c.b});
      double area = 0, moment_s = 0, moment_t = 0;
      for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
        area += cut.point_area[j];
        moment_s += cut.point_area[j] * cut.point_s[j], moment_t += cut.point_area[j] * cut.point_t[j];
      }
      // Coordinates of up to 1 cm have rounding errors of 1e-18 m, which change the area of a polygon with an extent
      // of up to 1 cm by 1e-20 m², however narrow it is. 1e-18: some hundred such errors.
      EXPECT_NEAR(area, c.area, 1e-18);
      EXPECT_NEAR(moment_s, c.moments.s, 1e-20);
      EXPECT_NEAR(moment_t, c.moments.t, 1e-20);
      EXPECT_EQ(c.distance, old.distance);
      EXPECT_EQ(c.arm_a, old.arm_a);
      if (c.area == old.area) {
        EXPECT_EQ(c.moments.ss, old.moments.ss);
        EXPECT_EQ(c.moments.st, old.moments.st);
        EXPECT_EQ(c.point_end - c.point_begin, old.point_end - old.point_begin);
      } else {
        ++shortened;
        EXPECT_LT(c.area, old.area);
        EXPECT_TRUE((s.centre[c.a].x < 0.05) != (s.centre[c.b].x < 0.05));
      }
    }
    EXPECT_EQ(shortened, cut.notches[0].shortened);
    EXPECT_GT(shortened, 0);
  }
}

// Two half spheres of mastic: the facet is the middle of the box, so the contact is the rectangle that remains, and its
// exact moments are those of this rectangle.
TEST(Notches, ShortenedContactsHaveTheMomentsOfTheirParts) {
  Specimen s;
  s.box = {{0.02, 0.01, 0.01}};
  add(s, {0.005, 0.005, 0.005}, 0.005);
  add(s, {0.015, 0.005, 0.005}, 0.005);
  const Tessellation t = tessellate(s);
  NetworkSpec spec = with({notch_at(0, 0.01, {0, 0, 0}, {0, 0.01, 0.004})});
  spec.quadrature = Quadrature::exact;
  const auto between = [&] {
    for (const Contact& c : build_network(s, t, spec).contacts)
      if (c.b == 1) return c;
    return Contact{};
  };
  const Contact ligament = between();
  EXPECT_NEAR(ligament.area, 0.01 * 0.006, 1e-17);
  // about the line of centres: b·h³/12 + A·(2 mm)² along z, h·b³/12 along y; s and t are y and z in some order
  const double along_z = 0.01 * std::pow(0.006, 3) / 12 + 6e-5 * 4e-6, along_y = 0.006 * 1e-6 / 12;
  EXPECT_NEAR(ligament.moments.ss + ligament.moments.tt, along_y + along_z, 1e-22);
  EXPECT_NEAR(std::hypot(ligament.moments.s, ligament.moments.t), 6e-5 * 0.002, 1e-19);
  // a notch in the middle leaves two parts above and below it
  spec.notches = {notch_at(0, 0.01, {0, 0, 0.004}, {0, 0.01, 0.006})};
  const Contact both = between();
  EXPECT_NEAR(both.area, 8e-5, 1e-17);
  EXPECT_NEAR(std::hypot(both.moments.s, both.moments.t), 0, 1e-19);
  EXPECT_EQ(both.point_end - both.point_begin, 10U);  // four vertices and a centroid, twice
}

TEST(Notches, OutsideTheSpecimenOrThroughItAreRefused) {
  const auto refusal = [](const Domain& domain, std::vector<Notch> notches) {
    const Specimen s = random_spheres(domain, 300, 7);
    return test::message_of([&] { build_network(s, tessellate(s), with(notches)); });
  };
  EXPECT_HAS(refusal(beam, {notch_at(0, 0.11)}), "a notch at x = 0.11 m, which is outside the specimen");
  EXPECT_HAS(refusal(beam, {notch_at(1, 0.02, {0, 0, 0.05}, {0.1, 0, 0.06})}), "limits outside the specimen");
  EXPECT_HAS(refusal(beam, {notch_at(2, 1e-6, {0, 0, 0}, {0.05, 0.03, 0})}),
             "a notch at z = 1e-06 m that meets no contact, expected a notch between centres of particles");
  EXPECT_HAS(refusal(beam, {notch_at(2, 0.02)}), "a notch at z = 0.02 m that severs the specimen");
  const Notch lower = notch_at(0, 0.05, {0, 0, 0}, {0, 0.03, 0.02}),
              upper = notch_at(0, 0.05, {0, 0, 0.02}, {0, 0.03, 0.04});
  EXPECT_HAS(refusal(beam, {lower, upper}), "severs the specimen, expected a notch that leaves a ligament");
  // a corner of the bounding box of a disc is outside the disc
  const Domain disc = domain_of("disc", {0.1, 0.03});
  EXPECT_HAS(refusal(disc, {notch_at(0, 0.01, {0, 0, 0}, {0, 0.03, 0.01})}), "limits outside the specimen");
  EXPECT_EQ(refusal(disc, {notch_at(0, 0.05, {0, 0, 0}, {0, 0.03, 0.04})}), "nothing was thrown");
  EXPECT_HAS(refusal(disc, {notch_at(0, 0.1 * (1 - 0.8) / 2, {0, 0, 0.02}, {0, 0.03, 0.08})}), "severs");
}

// Two notches in different planes that together cut a block out of the specimen. They cross by more than a spacing of
// the spheres (3.9 mm), because cells of the block reach beyond both planes at their common edge.
TEST(Notches, ThatCutOffABlockAreRefused) {
  const Specimen s = random_spheres(beam, 2000, 8);
  const Notch side = notch_at(0, 0.03, {0, 0, 0}, {0, 0.03, 0.026}),
              top = notch_at(2, 0.02, {0, 0, 0}, {0.036, 0.03, 0});
  const Tessellation t = tessellate(s);
  build_network(s, t, with({side}));
  build_network(s, t, with({top}));
  EXPECT_HAS(test::message_of([&] { build_network(s, t, with({side, top})); }), "severs the specimen into parts of");
}

}  // namespace
}  // namespace macadam
