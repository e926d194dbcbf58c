// SPDX-License-Identifier: GPL-3.0-or-later
/// \file generate_test.cpp  Tests the specimen generator: composition, placement, relaxation and reproducibility.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>

#include "host/specimen/generate.hpp"
#include "host/specimen/mastic.hpp"
#include "host/specimen/placement.hpp"
#include "host/spheres/relaxation.hpp"
#include "host/spheres/specimen_check.hpp"
#include "tests/support/processor_time.hpp"
#include "tests/support/long_tests.hpp"
#include "macadam/error.hpp"
#include "macadam/specimen.hpp"

namespace macadam {
namespace {

double volume(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

/// Returns a small mix in a box of 13 mm with two size classes and about 440 mastic spheres.
SpecimenSpec small_mix() {
  SpecimenSpec spec;
  spec.box = {{0.013, 0.013, 0.013}};
  spec.aggregate = {{0.002, 0.00475, 0.2, {}}, {0.00475, 0.0095, 0.2, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  return spec;
}

bool same_bits(const Specimen& a, const Specimen& b) {
  const auto equal = [](const Vec3d& p, const Vec3d& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  return a.radius == b.radius && a.phase == b.phase && a.body == b.body &&
         std::equal(a.centre.begin(), a.centre.end(), b.centre.begin(), b.centre.end(), equal);
}

/// Expects that aggregates are inside the box, do not overlap, are sorted by size, and each have a number of their own.
void expect_sound_aggregates(const Specimen& s) {
  const std::size_t n = std::count(s.phase.begin(), s.phase.end(), Phase::aggregate);
  // Positions are doubles: each coordinate is rounded by half a unit in the last place of the box's edge.
  const double rounding =
      4 * std::numeric_limits<double>::epsilon() * std::max({s.box.size.x, s.box.size.y, s.box.size.z});
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_EQ(s.phase[i], Phase::aggregate);
    EXPECT_EQ(s.body[i], static_cast<std::int32_t>(i));
    EXPECT_TRUE(i == 0 || s.radius[i] <= s.radius[i - 1]) << i;
    const Vec3d c = s.centre[i], l = s.box.size;
    EXPECT_GE(std::min({c.x, c.y, c.z, l.x - c.x, l.y - c.y, l.z - c.z}), s.radius[i] - rounding) << i;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(norm(c - s.centre[j]), s.radius[i] + s.radius[j] - rounding) << i << " and " << j;
  }
}

std::string message_for(const SpecimenSpec& spec) {
  try {
    generate_specimen(spec);
  } catch (const Error& error) { return error.what(); }
  return "(accepted)";
}

void expect_refused(const SpecimenSpec& spec, const std::string& words) {
  try {
    generate_specimen(spec);
    ADD_FAILURE() << "accepted; expected: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Generate, SameSeedSameBitsOtherSeedOtherSpecimen) {
  SpecimenSpec spec = small_mix();
  const Specimen first = generate_specimen(spec).specimen;
  EXPECT_TRUE(same_bits(first, generate_specimen(spec).specimen));
  spec.seed = 2;
  EXPECT_FALSE(same_bits(first, generate_specimen(spec).specimen));
}

TEST(Generate, SameBitsForAnyNumberOfThreads) {
  const int threads = omp_get_max_threads();
  for (bool fix : {true, false}) {
    SpecimenSpec spec = small_mix();
    spec.box = {{0.016, 0.016, 0.016}};
    spec.aggregate = {{0.00475, 0.0095, 0.1, {}}};
    spec.fix_aggregates = fix;
    omp_set_num_threads(1);
    const Specimen one = generate_specimen(spec).specimen;
    ASSERT_GT(one.size(), 1000u);  // smaller specimens use one thread
    for (int t : {2, 3, 16}) {
      omp_set_num_threads(t);
      EXPECT_TRUE(same_bits(one, generate_specimen(spec).specimen)) << t << " threads, fix_aggregates " << fix;
    }
  }
  omp_set_num_threads(threads);
}

/// The generator computes a tessellation to check that every sphere has a cell. The generator returns the cells, so
/// that the caller need not compute them again. The returned cells must equal a new tessellation.
TEST(Generate, HandsOnTheCellsOfTheSpecimenAsItIs) {
  const auto same = [](const Facet& a, const Facet& b) {
    return a.a == b.a && a.b == b.b && a.area == b.area && norm(a.centroid - b.centroid) == 0;
  };
  for (const bool fix : {true, false}) {
    SpecimenSpec spec = small_mix();
    spec.fix_aggregates = fix;
    const GeneratedWithCells generated = generate_with_cells(spec, {});
    const Tessellation again = tessellate(generated.made.specimen);
    ASSERT_TRUE(generated.tessellation);
    EXPECT_TRUE(std::ranges::equal(generated.tessellation->facets, again.facets, same));
    EXPECT_EQ(generated.tessellation->cell_volume, again.cell_volume);
    EXPECT_GT(generated.seconds_tessellation, 0);
  }
  SpecimenSpec with_voids = small_mix();
  with_voids.voids = VoidSpec{0.0006, 0.0012, 0.02, {}};
  EXPECT_FALSE(generate_with_cells(with_voids, {}).tessellation);
}

TEST(Generate, AggregatesAreInsideAndClearOfEachOther) {
  const GeneratedSpecimen g = generate_specimen(small_mix());
  expect_sound_aggregates(g.specimen);
  EXPECT_EQ(g.residual_overlap, 0);
}

TEST(Generate, AggregatesKeepTheSpacing) {
  SpecimenSpec spec = small_mix();
  spec.spacing = 4e-4;
  const Specimen s = generate_specimen(spec).specimen;
  expect_sound_aggregates(s);
  for (std::size_t i = 0; s.phase[i] == Phase::aggregate; ++i)
    for (std::size_t j = 0; j < i; ++j)  // tolerance 1e-15 m: rounding of positions in a box of centimetres
      EXPECT_GE(norm(s.centre[i] - s.centre[j]), s.radius[i] + s.radius[j] + spec.spacing - 1e-15) << i << " and " << j;
}

TEST(Generate, CompositionIsWhatWasAsked) {
  const GeneratedSpecimen g = generate_specimen(small_mix());
  ASSERT_EQ(g.composition.size(), 3u);
  EXPECT_EQ(g.composition[0].name, "2-4.75 mm");
  EXPECT_EQ(g.composition[1].name, "4.75-9.5 mm");
  EXPECT_EQ(g.composition[2].name, "mastic");
  const double solid = 0.95, asked[] = {0.2 * solid, 0.2 * solid, 0.6 * solid};
  double sums[3] = {};
  std::int64_t counts[3] = {};
  for (std::size_t i = 0; i < g.specimen.size(); ++i) {
    const double r = g.specimen.radius[i];
    const int k = g.specimen.phase[i] == Phase::mastic ? 2 : r > 0.00475 / 2 ? 1 : 0;
    sums[k] += volume(r) / g.specimen.box.volume();
    ++counts[k];
    EXPECT_GE(r, k == 2 ? 0.00075 : 0.001);
    EXPECT_LE(r, k == 2 ? 0.001 : 0.00475);
  }
  for (int k = 0; k < 3; ++k) {
    // The bisection for the sizes ends at 1e-13 of the volume of the class, and the sums of some hundred terms round to
    // less than that.
    EXPECT_NEAR(sums[k], asked[k], 1e-12) << k;
    EXPECT_NEAR(g.composition[k].fraction, sums[k], 1e-12) << k;
    EXPECT_NEAR(g.composition[k].fraction_asked, asked[k], 1e-12) << k;
    EXPECT_EQ(g.composition[k].count, counts[k]) << k;
  }
}

TEST(Generate, CountsGiveTheMeanVolumeOfTheSizeLaw) {
  // The count must give the volume of spheres with the mean cube of their diameters. For diameters between a and b the
  // mean cube is (b³−a³)/(3 ln(b/a)) if they are log-uniform, (b⁴−a⁴)/(4(b−a)) if they are uniform, and 2a²b²/(a+b) if
  // every diameter has the same volume (density ∝ d⁻³).
  const double a = 0.001, b = 0.003, mastic_min = 0.0005, mastic_max = 0.001;
  const std::pair<SizeLaw, double> laws[] = {{SizeLaw::log_uniform, (b * b * b - a * a * a) / (3 * std::log(b / a))},
                                             {SizeLaw::uniform, (std::pow(b, 4) - std::pow(a, 4)) / (4 * (b - a))},
                                             {SizeLaw::volume_uniform, 2 * a * a * b * b / (a + b)}};
  for (const auto& [law, mean_cube] : laws) {
    SpecimenSpec spec;
    spec.box = {{0.012, 0.012, 0.012}};
    spec.size_law = law;
    spec.aggregate = {{a, b, {}, 60}};
    spec.mastic = MasticSpec{mastic_min, mastic_max, {}, 300};
    const GeneratedSpecimen g = generate_specimen(spec);
    EXPECT_EQ(g.composition[0].count, 60);
    EXPECT_EQ(g.composition[1].count, 300);
    EXPECT_NEAR(g.composition[0].fraction, 60 * std::numbers::pi / 6 * mean_cube / spec.box.volume(), 1e-12);
    const double mean_radius_cube =
        (std::pow(mastic_max, 4) - std::pow(mastic_min, 4)) / (4 * (mastic_max - mastic_min));
    EXPECT_NEAR(g.composition[1].fraction, 300 * 4 * std::numbers::pi / 3 * mean_radius_cube / spec.box.volume(),
                1e-12);
    // Sizes are stratified samples, so the number of spheres below any size differs from the size law by at most one.
    // Adjusting the sizes to the exact volume changes this number by less than one more.
    const double middle = law == SizeLaw::log_uniform ? std::sqrt(a * b)
                          : law == SizeLaw::uniform   ? (a + b) / 2
                                                      : std::sqrt(2 / (1 / (a * a) + 1 / (b * b)));
    const auto below = std::count_if(g.specimen.radius.begin(), g.specimen.radius.begin() + 60,
                                     [&](double r) { return 2 * r < middle; });
    EXPECT_NEAR(static_cast<double>(below), 30, 2) << static_cast<int>(law);
  }
}

/// Three spheres of the largest size have the volume of 3.49 mean spheres, and three spheres of the smallest size have
/// the volume of 2.54 mean spheres. Both round to three, which the number of spheres must be.
TEST(ClassRequest, ThreeOfOneSizeAreThree) {
  for (const double largest : {0.001, 0.0047, 0.0125, 1.0}) {
    ClassRequest request{"", {SizeLaw::uniform, 0.9 * largest, largest}, 1, {}, {}};
    for (const double size : {0.9 * largest, largest}) {
      for (const double rounding : {-1e-15, 0.0, 1e-15}) {
        request.volume = 3 * volume(size / 2) * (1 + rounding);
        EXPECT_EQ(request.number(10 * request.volume), 3) << size << " of " << largest << ", " << rounding;
      }
    }
  }
}

/// If mastic is given by count, its volume follows from the count and the total solid volume.
TEST(Generate, MasticByCountSolvesForTheSolidVolume) {
  SpecimenSpec spec = small_mix();
  spec.aggregate = {{0.002, 0.004, 0.25, {}}, {0.004, 0.006, {}, 3}};
  spec.mastic = MasticSpec{0.00075, 0.001, {}, 500};
  const GeneratedSpecimen g = generate_specimen(spec);
  const double solid = g.composition[0].fraction + g.composition[1].fraction + g.composition[2].fraction;
  EXPECT_NEAR(g.composition[0].fraction / solid, 0.25, 1e-12);
}

TEST(Generate, MasticIsSpreadEvenly) {
  const Specimen s = generate_specimen(small_mix()).specimen;
  EXPECT_TRUE(particles_without_cell(s).empty());
  // If the 440 spheres were at random positions, a dozen pairs would be closer than 0.2 of the sum of their radii.
  // Evenly spread spheres at porosity 0.05 keep a distance of about 0.9 of this sum. Spheres that are squeezed between
  // a wall and an aggregate keep somewhat less.
  double closest = 1;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      closest = std::min(closest, norm(s.centre[i] - s.centre[j]) / (s.radius[i] + s.radius[j]));
  EXPECT_GT(closest, 0.6);
  EXPECT_LT(closest, 1);
}

/// If aggregates may move during relaxation, the largest overlap between them is reported, and it is small.
TEST(Generate, FreeAggregatesReportTheirOverlap) {
  SpecimenSpec spec = small_mix();
  const Specimen held = generate_specimen(spec).specimen;
  spec.fix_aggregates = false;
  const GeneratedSpecimen g = generate_specimen(spec);
  double largest = 0, farthest = 0;
  for (std::size_t i = 0; g.specimen.phase[i] == Phase::aggregate; ++i) {
    farthest = std::max(farthest, norm(g.specimen.centre[i] - held.centre[i]));
    for (std::size_t j = 0; j < i; ++j)
      largest = std::max(
          largest, g.specimen.radius[i] + g.specimen.radius[j] - norm(g.specimen.centre[i] - g.specimen.centre[j]));
  }
  EXPECT_EQ(g.residual_overlap, largest);
  // Mastic spheres of 1.75 mm overlap by about a tenth of their diameter. Pairs of aggregates are 20 times stiffer and
  // overlap less, even if they carry the load of several contacts.
  EXPECT_LT(largest, 0.000175);
  EXPECT_GT(farthest, 1e-5);  // the aggregates did move
}

TEST(Generate, MasticOnlyAggregatesOnlySingleParticle) {
  SpecimenSpec spec = small_mix();
  spec.aggregate.clear();
  spec.box = {{0.01, 0.01, 0.01}};
  GeneratedSpecimen g = generate_specimen(spec);
  ASSERT_EQ(g.composition.size(), 1u);
  EXPECT_NEAR(g.composition[0].fraction, 0.95, 1e-12);

  spec = small_mix();
  spec.mastic.reset();
  g = generate_specimen(spec);
  EXPECT_EQ(g.composition.size(), 2u);
  EXPECT_NEAR(g.composition[0].fraction, 0.2, 1e-12);  // without mastic the fraction refers to the box
  expect_sound_aggregates(g.specimen);

  spec.aggregate = {{0.004, 0.006, {}, 1}};
  EXPECT_EQ(generate_specimen(spec).specimen.size(), 1u);
  spec.aggregate.clear();
  spec.mastic = MasticSpec{0.001, 0.001, {}, 1};
  EXPECT_EQ(generate_specimen(spec).specimen.size(), 1u);
}

TEST(Generate, AClassWithoutRoomSaysHowMuchHadRoom) {
  SpecimenSpec spec = small_mix();
  spec.box = {{0.016, 0.016, 0.016}};
  // spheres of nearly one size must fill 56 % of the box, which is more than random sequential placement reaches
  spec.aggregate = {{0.0047, 0.005, {}, 40}};
  spec.mastic.reset();
  spec.attempts = 30'000;
  EXPECT_THROW(generate_specimen(spec), RunError);
  const std::string message = message_for(spec);
  for (const char* words : {"of 40 of class 4.7-5 mm", "30000 attempts", "of 40 placed", "% of the class's volume",
                            "larger box", "another seed"})
    EXPECT_NE(message.find(words), std::string::npos) << message;
  int placed = 0;
  double percent = 0;
  const std::size_t figures = message.find("attempts: ");
  ASSERT_NE(figures, std::string::npos);
  ASSERT_EQ(std::sscanf(message.c_str() + figures, "attempts: %d of 40 placed, %lf %%", &placed, &percent), 2);
  EXPECT_GT(percent, 100.0 * placed / 40 - 0.1);  // the largest spheres are placed first
  EXPECT_LT(percent, 100.0 * placed / 40 * std::pow(5 / 4.7, 3));
}

/// A large aggregate fills most of the box. The test counts the attempts at a small sphere that do not overlap it
/// (`taken` is called only for these). The centre of the small sphere may be anywhere in 9.8³ mm³, of which 448 mm³ are
/// clear of the aggregate. So each of the first 20,000 attempts is clear with probability 0.476. Later attempts are
/// made only in cells of 0.2 mm that are not fully taken. Each such cell is at least 4.9 mm minus its diagonal from the
/// middle, so these cells have at most 604 mm³. An attempt in them is clear with probability 0.74.
TEST(Placement, LaterTriesAreWhereThereMayBeRoom) {
  Specimen specimen;
  specimen.box.size = {0.01, 0.01, 0.01};
  std::atomic<int> clear = 0;
  const auto taken = [&](const Vec3d&) { return ++clear, true; };
  Placement placement(specimen, 2e-4, 40'000, RandomStream(1, 1), {}, taken);
  placement.add_aggregate({0.005, 0.005, 0.005}, 0.0048, 0);
  EXPECT_THROW(placement.place_aggregates({{{}, {1e-4}, {}}}, 0, [](double) {}), RunError);
  EXPECT_GT(clear, 20'000 * (0.476 + 0.742) - 400);  // tolerance of four standard deviations
  EXPECT_LE(clear, 20'000 * (0.476 + 1) + 400);
}

/// A sphere half-way between two equal aggregates that overlap has no force on it and no cell. The generator must give
/// it another position.
TEST(Mastic, WithoutACellGetsAnotherPlace) {
  Specimen s;
  s.box.size = {1, 1, 1};
  constexpr double radius = 0.2;
  Placement placement(s, radius, 1000, RandomStream(1, 1), {});
  placement.add_aggregate({0.375, 0.5, 0.5}, radius, 0);
  placement.add_aggregate({0.625, 0.5, 0.5}, radius, 1);
  s.centre.push_back({0.5, 0.5, 0.5}), s.radius.push_back(0.05);
  s.phase.push_back(Phase::mastic), s.body.push_back(-1);
  ASSERT_EQ(particles_without_cell(s), std::vector<std::int32_t>{2});
  const auto silent = [](double) {};
  relax(s, true, silent);
  ASSERT_EQ(norm(s.centre[2] - Vec3d{0.5, 0.5, 0.5}), 0);
  settle_mastic(s, placement, true, {}, {}, {});
  EXPECT_TRUE(particles_without_cell(s).empty());
  for (std::size_t i : {0, 1}) EXPECT_GE(norm(s.centre[2] - s.centre[i]), radius);
}

/// If the recipe comes from a scene, messages name the file and the line of the class.
TEST(Generate, WhatCannotBeMetIsNamedWithItsLine) {
  SpecimenSpec spec = small_mix();
  spec.source = "mix.toml", spec.line = 3;
  spec.aggregate[0].line = 7, spec.aggregate[1].line = 11, spec.mastic->line = 20;
  EXPECT_EQ(generate_specimen(spec).specimen.source, "specimen generated from mix.toml");
  const auto expect = [](const SpecimenSpec& bad, const std::string& begin) {
    EXPECT_EQ(message_for(bad).rfind(begin, 0), 0u) << message_for(bad);
  };
  SpecimenSpec bad = spec;
  bad.aggregate[1] = {0.0094, 0.0095, 0.11, {}, 11};
  expect(bad, "mix.toml:11: 9.4-9.5 mm: volume: found ");
  bad = spec;
  bad.aggregate[0].volume_fraction = 2;
  expect(bad, "mix.toml:7: aggregate class 2-4.75 mm: volume_fraction: found 2");
  bad = spec;
  bad.mastic->radius_min = 1;
  expect(bad, "mix.toml:20: mastic: sizes: found ");
  bad = spec;
  bad.attempts = 0;
  expect(bad, "mix.toml:3: attempts: found 0");
  bad = spec;
  bad.attempts = 1;
  bad.aggregate[1].volume_fraction = 0.6;
  expect(bad, "mix.toml:11: no space for aggregate ");
  bad = spec;
  bad.aggregate.clear();
  bad.mastic.reset();
  expect(bad, "mix.toml:3: particles: found 0");
}

TEST(Relax, AggregatesAloneMoveApart) {
  Specimen s{{{1, 1, 1}}, {{0.4, 0.5, 0.5}, {0.6, 0.5, 0.5}}, {0.2, 0.2}, {Phase::aggregate, Phase::aggregate}, {0, 1}};
  relax(s, false, [](double) {});
  // The overlap is 0.2 at the start. The relaxation stops when the energy stalls; then at most a thousandth of a radius
  // is left of the overlap.
  EXPECT_LT(largest_aggregate_overlap(s), 2e-4);
  EXPECT_NEAR(s.centre[0].x + s.centre[1].x, 1, 1e-12) << "both give way alike";
  EXPECT_LT(s.centre[1].x - s.centre[0].x, 0.5) << "and stop soon after";
}

/// An exception in an OpenMP thread is passed on to the caller and does not terminate the process.
TEST(Relax, WhatAWallThrowsIsThrown) {
  Specimen s{{{1, 1, 1}}, {}, {}, {}, {}};
  for (int i = 0; i < 1500; ++i) {
    s.centre.push_back({(i % 12 + 0.5) / 12, (i / 12 % 12 + 0.5) / 12, (i / 144 + 0.5) / 12});
    s.radius.push_back(0.05);
    s.phase.push_back(Phase::mastic);
    s.body.push_back(-1);
  }
  const Enclosure wall{[](const Vec3d& c, double) -> WallDepth {
    if (c.z > 0.5) throw std::bad_alloc();
    return {1, {}};
  }};
  EXPECT_THROW(relax(
                   s, false, [](double) {}, wall),
               std::bad_alloc);
}

TEST(Generate, AClassMayHaveNoVolume) {
  SpecimenSpec spec = small_mix();
  spec.aggregate[0].volume_fraction = 0;
  const auto made = generate_specimen(spec);
  EXPECT_EQ(made.composition.at(0).count, 0);
  EXPECT_GT(made.composition.at(1).count, 0);
}

TEST(Generate, ImpossibleRecipesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto spoilt = [](const std::function<void(SpecimenSpec&)>& spoil) {
    SpecimenSpec spec = small_mix();
    spoil(spec);
    return spec;
  };
  using S = SpecimenSpec;
  expect_refused(spoilt([](S& s) { s.spacing = -1e-4; }), "spacing");
  expect_refused(spoilt([nan](S& s) { s.spacing = nan; }), "spacing");
  expect_refused(spoilt([](S& s) { s.box.size.y = 0; }), "box: edge: found 0");
  expect_refused(spoilt([&](S& s) { s.box.size.y = nan; }), "box: edge: found nan");
  expect_refused(spoilt([](S& s) { s.attempts = 0; }), "attempts: found 0");
  expect_refused(spoilt([](S& s) { s.file = "x.csv"; }), "x.csv");
  expect_refused(spoilt([](S& s) { s.aggregate[0].count = 3; }), "both volume_fraction and count");
  expect_refused(spoilt([](S& s) { s.aggregate[0].volume_fraction.reset(); }), "neither volume_fraction nor count");
  expect_refused(spoilt([](S& s) { s.aggregate[0].sieve_min = 0.005; }), "0 < smallest <= largest");
  expect_refused(spoilt([&](S& s) { s.aggregate[0].sieve_max = nan; }), "0 < smallest <= largest");
  expect_refused(spoilt([](S& s) { s.aggregate[0].volume_fraction = 1.2; }), "volume_fraction: found 1.2");
  expect_refused(spoilt([](S& s) { s.aggregate[0].volume_fraction = 0.85; }),
                 "found 99.75 % of the box, expected at most the solid volume that the porosity leaves, 95 %");
  expect_refused(spoilt([](S& s) { s.aggregate[0] = {0.002, 0.00475, {}, -1}; }), "2-4.75 mm: count: found -1");
  expect_refused(spoilt([](S& s) { s.aggregate[0] = {0.002, 0.00475, {}, most_particles + 1}; }), "count: found");
  expect_refused(spoilt([](S& s) { s.mastic->count = 4; }), "both porosity and count");
  expect_refused(spoilt([](S& s) { s.mastic->porosity.reset(); }), "neither porosity nor count");
  expect_refused(spoilt([](S& s) { s.mastic->porosity = 1; }), "porosity: found 1");
  expect_refused(spoilt([](S& s) { s.mastic->radius_min = -1; }), "0 < smallest <= largest");
  expect_refused(spoilt([](S& s) { s.mastic = MasticSpec{1e-9, 1e-9, 0.05, {}}; }), "number of spheres");
  expect_refused(spoilt([](S& s) { s.aggregate[1] = {0.0132, 0.0134, {}, 1}; }), "smallest edge of the box, 13 mm");
  expect_refused(spoilt([](S& s) { s.aggregate[1].sieve_min = 0.0094; }), "or 19.79 % (1 spheres); wider sieves");
  expect_refused(spoilt([](S& s) { s.aggregate.clear(), s.mastic.reset(); }), "particles: found 0");
}

TEST(GenerateLarge, PaperSpecimen) {
  if (!test::long_tests) GTEST_SKIP() << "35,760 particles";
  SpecimenSpec spec;
  spec.box = {{0.05, 0.05, 0.08}};
  spec.aggregate = {
      {0.0125, 0.019, {}, 12}, {0.0095, 0.0125, {}, 27}, {0.00475, 0.0095, {}, 184}, {0.002, 0.00475, {}, 1373}};
  spec.mastic = MasticSpec{0.00075, 0.001, {}, 34164};
  GeneratedSpecimen g;
  EXPECT_LT(test::units_of_work([&] { g = generate_specimen(spec); }),
            1200);  // 60 s on two cores, if a unit takes 0.1 s
  EXPECT_EQ(g.specimen.size(), 35760u);
  double total = 0;
  for (const CompositionRow& row : g.composition) {
    EXPECT_EQ(row.count, row.count_asked) << row.name;
    // rounding of a sum of 34,164 terms, all of one sign
    EXPECT_NEAR(row.fraction, row.fraction_asked, 1e-10) << row.name;
    total += row.fraction;
  }
  // the sum of the fractions that follow from the mean volumes: 0.1227 + 0.0941 + 0.1738 + 0.1374 + 0.4891
  EXPECT_NEAR(total, 1.017, 0.001);
  expect_sound_aggregates(g.specimen);
  EXPECT_TRUE(particles_without_cell(g.specimen).empty());
}

}  // namespace
}  // namespace macadam
