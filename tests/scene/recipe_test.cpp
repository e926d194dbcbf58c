// SPDX-License-Identifier: GPL-3.0-or-later
/// \file recipe_test.cpp  Tests mix designs by mass: hand calculations after EN 12697-5 and EN 12697-8, invariants of
/// any design, and refused numbers.
#include "macadam/recipe.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <random>

#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

/// Returns the AC 14 mix of [1]. The gradation adds up the masses between the sieves of [1]; all sizes have one density
/// of rock; the density of the binder is an assumption.
MixDesign ac14() {
  MixDesign d;
  d.gradation = {{0.019, 1},     {0.0125, 0.837},   {0.0095, 0.712},   {0.00475, 0.478},
                 {0.002, 0.325}, {0.000425, 0.169}, {0.000180, 0.094}, {0.000075, 0.053}};
  d.binder = 0.052;
  d.aggregate_density = {2630};
  d.binder_density = 1030;
  d.air_voids = 0.05;
  return d;
}

/// Returns a design with round numbers: a density per size, absorbed binder, and binder relative to the mass of
/// aggregate.
MixDesign limestone() {
  MixDesign d;
  d.gradation = {{0.010, 1}, {0.005, 0.6}, {0.002, 0.3}, {0.000063, 0.1}};
  d.binder = 0.05;
  d.binder_of = BinderOf::aggregate;
  d.aggregate_density = {2500, 2800, 2600};
  d.filler_density = 2700;
  d.binder_density = 1000;
  d.absorbed_binder = 0.01;
  d.air_voids = 0.04;
  return d;
}

/// Compares with a hand calculation of seven digits.
void expect_hand(double value, double by_hand) { EXPECT_NEAR(value / by_hand, 1, 1e-6) << value << " for " << by_hand; }

/// Hand calculation for 1 kg of mix. 0.948 kg of aggregate have 0.948/2630 = 3.604563e-4 m³, 0.052 kg of binder have
/// 0.052/1030 = 5.048544e-5 m³. EN 12697-5: the maximum density is 1/(3.604563e-4 + 5.048544e-5) = 1/4.109417e-4 =
/// 2433.435 kg/m³. EN 12697-6, -8: V_m = 5 % is a bulk density of 0.95 · 2433.435 = 2311.763 kg/m³; VMA = V_m +
/// B·ρ_b/ρ_B = 5 % + 5.2 % · 2311.763/1030 = 5 % + 11.67104 % = 16.67104 %; VFB = 11.67104/16.67104 = 70.00787 %.
TEST(Recipe, AC14ByHand) {
  const MixVolumes v = volumes_of(ac14());
  expect_hand(v.maximum_density, 2433.435);
  expect_hand(v.bulk_density, 2311.763);
  expect_hand(v.vma, 0.1667104);
  expect_hand(v.vfb, 0.7000787);
  EXPECT_EQ(v.air_voids, 0.05);
  EXPECT_EQ(v.effective_binder, 0.052);
  // The volumes are 16.3, 12.5, 23.4 and 15.3 % of 0.948 kg, divided by 2630 kg/m³, times 2311.763 kg of mix per m³ of
  // the box.
  ASSERT_EQ(v.classes.size(), 4u);
  const double mass[] = {0.154524, 0.1185, 0.221832, 0.145044};
  const double volume[] = {0.1358262, 0.1041612, 0.1949898, 0.1274933};
  for (std::size_t k = 0; k < 4; ++k) {
    expect_hand(v.classes[k].mass, mass[k]);
    expect_hand(v.classes[k].volume, volume[k]);
  }
  EXPECT_EQ(v.classes[0].sieve_max, 0.019);
  EXPECT_EQ(v.classes[3].sieve_min, 0.002);
  // mastic: 1 − 0.6399 = 0.3601 kg in 4.109417e-4 − 0.6399/2630 = 1.676337e-4 m³
  expect_hand(v.aggregate_density, 2630);
  expect_hand(v.mastic_mass, 0.3601);
  expect_hand(v.mastic_density, 2148.136);
  expect_hand(v.mastic_volume, 0.3875295);    // 1.676337e-4 m³ · 2311.763
  expect_hand(v.mastic_fine_mass, 0.257856);  // (0.325 − 0.053) · 0.948
  expect_hand(v.mastic_filler_mass, 0.050244);
  expect_hand(v.mastic_binder_mass, 0.052);
}

/// Hand calculation for 1 kg of aggregate and 0.05 kg of binder. Volumes including pores: 0.4/2500 = 1.6e-4, 0.3/2800 =
/// 1.071429e-4, 0.2/2600 = 7.692308e-5, 0.1/2700 = 3.703704e-5, in all 3.811030e-4 m³. 0.01 kg of the binder is in the
/// pores, 0.04 kg takes 4e-5 m³. The maximum density is 1.05/4.211030e-4 = 2493.452, the bulk density 0.96 · 2493.452 =
/// 2393.714 kg/m³. VMA = 1 − 2393.714 · 3.811030e-4/1.05 = 1 − 0.8688109 = 0.1311891, VFB = (0.1311891 −
/// 0.04)/0.1311891 = 0.6950966.
TEST(Recipe, DensitiesASizeAndAbsorbedBinderByHand) {
  const MixVolumes v = volumes_of(limestone());
  expect_hand(v.maximum_density, 2493.452);
  expect_hand(v.bulk_density, 2393.714);
  expect_hand(v.vma, 0.1311891);
  expect_hand(v.vfb, 0.6950966);
  expect_hand(v.binder, 0.04761905);            // 0.05/1.05
  expect_hand(v.effective_binder, 0.03809524);  // 0.04/1.05
  // particles: 0.7 kg, and 0.007 kg of binder in their pores, in 2.671429e-4 m³
  expect_hand(v.aggregate_density, 2646.524);
  expect_hand(v.aggregate_volume, 0.6090129);  // 2.671429e-4 · 2393.714/1.05
  expect_hand(v.classes[1].density, 2800);
  // mastic: 0.3 kg and 0.043 kg of binder in 7.692308e-5 + 3.703704e-5 + 4e-5 = 1.539601e-4 m³
  expect_hand(v.mastic_density, 2227.850);
  expect_hand(v.mastic_volume, 0.3509871);
  expect_hand(v.mastic_binder_mass, 0.04095238);  // 0.043/1.05
}

/// A laboratory measures densities: here the densities of the test above, rounded to 1 kg/m³. Half a unit of 2493 is
/// 2e-4; this changes the volume of the mix, 4.2e-4 m³, by 8.4e-8 m³, and the absorbed binder by 8.4e-5 kg per kg of
/// aggregate.
TEST(Recipe, MeasuredDensitiesGiveAbsorbedBinderAndVoids) {
  MixDesign d = limestone();
  d.absorbed_binder = {}, d.air_voids = {};
  d.maximum_density = 2493, d.bulk_density = 2394;
  const MixVolumes v = volumes_of(d);
  EXPECT_NEAR(v.absorbed_binder, 0.01, 8.5e-5);
  expect_hand(v.maximum_density, 2493);
  expect_hand(v.bulk_density, 2394);
  expect_hand(v.air_voids, 0.03971119);  // 1 − 2394/2493
}

/// If nothing is absorbed, rounding may make a measured maximum density slightly too low: 2433 for 2433.435. The reader
/// must not take this for a contradiction.
TEST(Recipe, RoundingOfAMeasuredDensityIsNoContradiction) {
  MixDesign d = ac14();
  d.maximum_density = 2433;
  EXPECT_EQ(volumes_of(d).absorbed_binder, 0);
  d = ac14();
  d.air_voids = {}, d.bulk_density = 2433.9;
  EXPECT_EQ(volumes_of(d).air_voids, 0);
}

MixDesign random_design(std::mt19937& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  MixDesign d;
  const int sieves = 2 + static_cast<int>(random() % 8);
  double size = uniform(0.008, 0.03), passing = 1;
  for (int k = 0; k < sieves; ++k) {
    d.gradation.push_back({size, passing});
    size *= uniform(0.3, 0.9);
    if (random() % 4) passing *= uniform(0.3, 1);  // otherwise no aggregate is between the two sieves
    if (k > 0) d.aggregate_density.push_back(uniform(2000, 4000));
  }
  if (random() % 2) d.aggregate_density.resize(1);
  d.cut = d.gradation[random() % d.gradation.size()].size;
  d.binder = uniform(0.02, 0.2);
  d.binder_of = random() % 2 ? BinderOf::mix : BinderOf::aggregate;
  if (random() % 2) d.filler_density = uniform(2000, 4000);
  d.binder_density = uniform(900, 1200);
  // less than the smallest binder content, which is 0.02/1.02 per kg of aggregate
  if (random() % 2) d.absorbed_binder = uniform(0, 0.019);
  d.air_voids = uniform(0, 0.3);
  return d;
}

/// Masses add up to the whole, volumes fill the box, and the measured densities lead back to the design. Tolerance:
/// sums of at most 20 terms of order one in double precision, 1e-13; the absorbed binder computed back from 1/ρ_mv
/// loses at most three digits.
TEST(Recipe, MassInIsMassOut) {
  std::mt19937 random(7);
  for (int n = 0; n < 500; ++n) {
    const MixDesign d = random_design(random);
    const MixVolumes v = volumes_of(d);
    const double tolerance = 1e-13;
    ASSERT_NEAR(v.aggregate_mass + v.mastic_mass, 1, tolerance);
    ASSERT_NEAR(v.aggregate_volume + v.mastic_volume + v.air_voids, 1, tolerance);
    ASSERT_NEAR((v.aggregate_volume * v.aggregate_density + v.mastic_volume * v.mastic_density) / v.bulk_density, 1,
                tolerance);
    double mass = v.mastic_fine_mass + v.mastic_filler_mass, volume = 0;
    for (const MixClass& c : v.classes) mass += c.mass, volume += c.volume;
    ASSERT_NEAR(mass, 1 - v.binder, tolerance);  // mass of the dry aggregate
    ASSERT_NEAR(volume, v.aggregate_volume, tolerance);
    // EN 12697-8: the voids in the mineral aggregate are the air voids and the volume of the effective binder
    const double effective = v.effective_binder * v.bulk_density / d.binder_density;
    ASSERT_NEAR(v.vma, v.air_voids + effective, tolerance);
    ASSERT_NEAR(v.vfb * v.vma, effective, tolerance);

    MixDesign measured = d;
    measured.absorbed_binder = {}, measured.air_voids = {};
    measured.maximum_density = v.maximum_density, measured.bulk_density = v.bulk_density;
    const MixVolumes back = volumes_of(measured);
    ASSERT_NEAR(back.absorbed_binder, v.absorbed_binder, 1e-10);
    ASSERT_NEAR(back.air_voids, v.air_voids, tolerance);
  }
}

/// One more sieve on the straight line between two other sieves changes none of the results: densities, cut and mass
/// stay.
TEST(Recipe, ASieveMoreChangesNothing) {
  const MixVolumes one = volumes_of(ac14());
  MixDesign d = ac14();
  d.gradation.insert(d.gradation.begin() + 3, {0.0063, 0.55});
  const MixVolumes more = volumes_of(d);
  ASSERT_EQ(more.classes.size(), one.classes.size() + 1);
  EXPECT_NEAR(more.classes[2].volume + more.classes[3].volume, one.classes[2].volume, 1e-15);
  EXPECT_NEAR(more.mastic_density / one.mastic_density, 1, 1e-14);
}

/// The specimen takes its aggregate classes from the recipe, as fractions of its solid volume, and its porosity from
/// the air voids of the recipe.
TEST(Recipe, IsFollowedByASpecimen) {
  SpecimenSpec spec;
  EXPECT_HAS(message_of([&] { follow(ac14(), spec); }), "[specimen.mastic] with its radii");
  spec.mastic = MasticSpec{0.75e-3, 1e-3, {}, {}};
  follow(ac14(), spec);
  EXPECT_EQ(spec.mastic->porosity, 0.05);
  ASSERT_EQ(spec.aggregate.size(), 4u);
  expect_hand(*spec.aggregate[0].volume_fraction, 0.1358262 / 0.95);
  EXPECT_HAS(message_of([&] { follow(ac14(), spec); }), "no classes, because they follow from the recipe");
  spec.aggregate.clear();
  EXPECT_HAS(message_of([&] { follow(ac14(), spec); }), "a porosity or count of the mastic together with the recipe");
}

/// If half of the first class is missing, 1 kg of aggregate lacks 0.0815 kg.
TEST(Recipe, ReachedCurveByHand) {
  const MixDesign d = ac14();
  const MixVolumes v = volumes_of(d);
  std::vector<CompositionRow> reached;
  for (const MixClass& c : v.classes) reached.push_back({"", 0, 0, c.volume, c.volume});
  reached.push_back({"mastic", 0, 0, v.mastic_volume, v.mastic_volume});
  for (const GradationRow& row : gradation_of(d, reached)) EXPECT_NEAR(row.reached, row.asked, 1e-14);
  reached[0].fraction /= 2;
  const auto rows = gradation_of(d, reached);
  const double by_hand[] = {1, 0.9112684, 0.7751769, 0.5204137, 0.3538378, 0.1839956, 0.1023408, 0.05770278};
  ASSERT_EQ(rows.size(), std::size(by_hand));  // 0.837/0.9185, 0.712/0.9185, …
  for (std::size_t k = 0; k < rows.size(); ++k) expect_hand(rows[k].reached, by_hand[k]);
  reached.pop_back();
  EXPECT_HAS(message_of([&] { gradation_of(d, reached); }), "the 4 classes of the recipe and the mastic");
}

/// A program can make a design whose envelopes the scene reader would refuse. The recipe functions must refuse them
/// too.
TEST(Recipe, EnvelopesThatAreNoneAreRefused) {
  const auto refusal = [](double size, double least, double most) {
    MixDesign d = ac14();
    d.envelope = {{size, least, most}};
    return message_of([&] { volumes_of(d); });
  };
  EXPECT_HAS(refusal(0.005, 0.5, 1.2), "50 % to 120 % passing 5 mm");
  EXPECT_HAS(refusal(0.005, -0.1, 0.7), "-10 % to 70 % passing 5 mm");
  EXPECT_HAS(refusal(-0.005, 0.5, 0.7), "a size above 0");
  EXPECT_HAS(refusal(INFINITY, 0.5, 0.7), "a size above 0");
}

TEST(Recipe, TellsWhereItLeavesTheEnvelope) {
  MixDesign d = ac14();
  d.envelope = {{0.019, 0.9, 1}, {0.0125, 0.7, 0.8}, {0.002, 0.325, 0.4}, {0.000075, 0.06, 0.08}, {0.001, 0, 0.1}};
  const auto outside = outside_of_envelope(d);  // 1 mm is not a sieve of the curve
  ASSERT_EQ(outside.size(), 2u);
  EXPECT_EQ(outside[0].size, 0.0125);
  EXPECT_EQ(outside[1].size, 0.000075);
}

}  // namespace
}  // namespace macadam::test
