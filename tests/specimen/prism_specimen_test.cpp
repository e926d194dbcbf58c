// SPDX-License-Identifier: GPL-3.0-or-later
// prism_specimen_test.cpp  Tests generated specimens whose domain is a cylinder, a disc, a half disc, a beam or a
// trapezoid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "host/specimen/census.hpp"
#include "host/specimen/generate.hpp"
#include "macadam/specimen.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {
namespace {

const Domain disc = domain_of("disc", {0.02, 0.012}), half_disc = domain_of("half_disc", {0.03, 0.012}),
             beam = domain_of("beam", {0.03, 0.012, 0.013}),
             trapezoid = domain_of("trapezoid", {0.02, 0.012, 0.012, 0.025});

SpecimenSpec small_mix(const Domain& domain, std::uint64_t seed) {
  SpecimenSpec spec;
  spec.box = domain;
  spec.seed = seed;
  spec.aggregate = {{0.002, 0.00475, 0.2, {}}, {0.00475, 0.0065, 0.15, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  return spec;
}

// All aggregates lie inside, all centres do, and the cells fill the domain.
TEST(GeneratedPrisms, SpheresLieInside) {
  for (const Domain& domain : {disc, half_disc, beam, trapezoid, cylinder_domain(0.015, 0.014)}) {
    SCOPED_TRACE(domain.name());
    const SpecimenSpec spec = small_mix(domain, 2);
    const GeneratedWithCells made = generate_with_cells(spec, {});
    const Specimen& s = made.made.specimen;
    EXPECT_STREQ(s.box.name(), domain.name());
    // Positions are doubles, rounded by half a unit in the last place of the dimensions.
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * norm(domain.size);
    double solid = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      EXPECT_TRUE(domain.contains(s.centre[i])) << i;
      if (s.phase[i] == Phase::aggregate) { EXPECT_LE(domain.signed_distance(s.centre[i]), rounding - s.radius[i]); }
      solid += 4 * std::numbers::pi / 3 * std::pow(s.radius[i], 3);
    }
    // with 5 % porosity, the spheres fill 95 % of the volume, to within one sphere of mastic
    EXPECT_NEAR(solid / domain.volume(), 0.95, 4 * std::numbers::pi / 3 * 1e-9 / domain.volume());
    double volume = 0;
    for (const double v : made.tessellation.value().cell_volume) volume += v;
    EXPECT_NEAR(volume / domain.volume(), 1, 1e-12);  // rounding of some thousand terms
    const TessellationInvariants found = measure_invariants(s, *made.tessellation);
    EXPECT_LT(found.walls, 1e-12);
    // the census predicts the numbers of the generator
    const Census census = count_specimen(spec);
    EXPECT_EQ(census.particles(), static_cast<std::int64_t>(s.size()));
  }
}

/// Returns the number of mastic spheres per volume in the outermost layer of a domain, over the mean number per volume.
/// The volume of the layer is measured with random points.
double relative_density_at_surface(const Domain& domain) {
  constexpr double layer = 1.75e-3;  // [m]; two mean radii
  SpecimenSpec spec = small_mix(domain, 5);
  spec.aggregate.clear();
  const Specimen s = generate_specimen(spec).specimen;
  const auto is_outer = [&](const Vec3d& p) { return -domain.signed_distance(p) < layer; };
  const auto outer = static_cast<double>(std::ranges::count_if(s.centre, is_outer));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int inside = 0, near = 0;
  while (inside < 100'000) {
    const Vec3d p{domain.size.x * unit(random), domain.size.y * unit(random), domain.size.z * unit(random)};
    if (!domain.contains(p)) continue;
    ++inside, near += is_outer(p);
  }
  return outer / static_cast<double>(s.size()) / (static_cast<double>(near) / inside);
}

// Relaxed mastic is as dense at a curved or inclined surface as at the walls of a box. 0.1: some 700 spheres lie in a
// layer. If spheres were independent, this number would have a standard deviation of 4 %, and the ratio of two such
// numbers 5 %.
TEST(GeneratedPrisms, MasticIsAsDenseAtTheSurfaceAsInABox) {
  const double in_box = relative_density_at_surface({{0.016, 0.012, 0.02}});
  for (const Domain& domain : {disc, half_disc, trapezoid})
    EXPECT_NEAR(relative_density_at_surface(domain) / in_box, 1, 0.1) << domain.name();
}

TEST(GeneratedPrisms, ShapesLieInside) {
  for (const Domain& domain : {domain_of("disc", {0.026, 0.02}), domain_of("half_disc", {0.04, 0.018}),
                               domain_of("trapezoid", {0.026, 0.02, 0.018, 0.03}), cylinder_domain(0.024, 0.022)}) {
    for (const PlacementMethod placement : {PlacementMethod::insertion, PlacementMethod::packing}) {
      SpecimenSpec spec = small_mix(domain, 3);
      spec.aggregate = {{4.75e-3, 8e-3, std::nullopt, 6}, {2e-3, 4.75e-3, std::nullopt, 30}};
      spec.shapes.emplace();
      spec.shapes->library = ShapeSpec::Library::icosahedron;
      spec.shapes->placement = placement;
      spec.shapes->fill.radius_min = 0.75e-3;
      spec.shapes->fill.radius_max = 1e-3;
      spec.shapes->fill.porosity = 0;
      const GeneratedSpecimen made = generate_specimen(spec);
      std::size_t checked = 0;
      for (const Aggregate& a : made.aggregates) {
        if (a.surface < 0) continue;
        checked += made.surfaces[static_cast<std::size_t>(a.surface)].points.size();
        for (const Vec3d& p : made.surfaces[static_cast<std::size_t>(a.surface)].points)
          EXPECT_LT(domain.signed_distance(a.pose(p)), 1e-9) << domain.name();  // packing accepts such overlaps
      }
      EXPECT_GT(checked, 0U) << domain.name();
    }
  }
}

}  // namespace
}  // namespace macadam
