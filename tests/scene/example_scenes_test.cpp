// SPDX-License-Identifier: GPL-3.0-or-later
// example_scenes_test.cpp  The scenes in examples/ have the values in the tables of [1] and a law for every contact.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "macadam/scene.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

class ExampleScene : public ::testing::TestWithParam<const char*> {
 protected:
  Scene scene() const { return read_scene(fs::path(MACADAM_EXAMPLES) / GetParam() / "scene.toml"); }
};

TEST_P(ExampleScene, HasTheSolverAndLoadingOfThePaper) {
  const Scene scene = this->scene();
  EXPECT_EQ(scene.cyclic().frequencies, (std::vector<double>{2, 5, 10, 20}));
  EXPECT_EQ(scene.cyclic().strain_amplitude, 1e-4);
  EXPECT_EQ(scene.solver.tolerance, 1e-3);
  EXPECT_FALSE(scene.solver.density_scaling);
  if (!scene.recipe) { EXPECT_EQ(scene.materials.mastic, 2110); }
  EXPECT_EQ(scene.specimen.mastic->radius_min, 0.75e-3);
  EXPECT_EQ(scene.specimen.mastic->radius_max, 1e-3);
}

/// Every contact that the specimen can have has a law.
TEST_P(ExampleScene, HasEveryLaw) {
  const Scene scene = this->scene();
  Specimen specimen;
  specimen.phase = {Phase::mastic};
  ContactNetwork network;
  for (PairType pair : {PairType::mm, PairType::mw}) network.count[int(pair)] = 10;
  if (!scene.specimen.aggregate.empty()) {
    specimen.phase.push_back(Phase::aggregate);
    for (PairType pair : {PairType::ma, PairType::aa, PairType::aw}) network.count[int(pair)] = 10;
  }
  if (scene.specimen.shapes) network.count[int(PairType::inner)] = 10;
  EXPECT_NO_THROW(require_laws(scene, specimen, network));
  // Pairs that cannot occur have no law.
  EXPECT_EQ(scene.laws[int(PairType::inner)].has_value(), scene.specimen.shapes.has_value());
  EXPECT_EQ(scene.laws[int(PairType::aa)].has_value(), !scene.specimen.aggregate.empty());
}

/// Checks the moduli of elastic contacts. Contacts between aggregates have the modulus of Table 4 of [1]. Contacts
/// within an aggregate have the modulus that gives a cube of fine or coarse spheres the rock's 60 GPa. Contacts at a
/// wall have the modulus of the stiffest spring of the material that touches the wall.
TEST_P(ExampleScene, HasThePapersElasticLaws) {
  const Scene scene = this->scene();
  std::vector<std::pair<PairType, laws::Elastic>> expected;
  const bool am2 = std::string(GetParam()) == "ac14_ss_am2";
  expected.emplace_back(PairType::mw, laws::Elastic{am2 ? 8.909e9 : 3.511e10, 0});
  if (!scene.specimen.aggregate.empty()) {
    expected.emplace_back(PairType::aa, laws::Elastic{1.151e11, 0.05});
    expected.emplace_back(PairType::aw, laws::Elastic{1.151e11, 0});
  }
  if (scene.specimen.shapes) {
    const FillSpec& fill = scene.specimen.shapes->fill;
    const bool fine = fill.radius_min == 0.75e-3;
    EXPECT_EQ(fill.radius_min, fine ? 0.75e-3 : 1e-3);
    EXPECT_EQ(fill.radius_max, fine ? 1e-3 : 2e-3);
    EXPECT_EQ(std::string(GetParam()).ends_with("fine"), fine);
    expected.emplace_back(PairType::inner, laws::Elastic{fine ? 1.125e11 : 1.116e11, 0.05});
  }
  for (const auto& [pair, law] : expected) {
    ASSERT_TRUE(scene.laws[int(pair)]) << to_string(pair);
    EXPECT_EQ(std::get<laws::Elastic>(*scene.laws[int(pair)]).E, law.E) << to_string(pair);
    EXPECT_EQ(std::get<laws::Elastic>(*scene.laws[int(pair)]).alpha, law.alpha) << to_string(pair);
  }
  for (const PairType pair : {PairType::mm, PairType::ma}) {
    if (!scene.laws[int(pair)]) continue;
    EXPECT_EQ(std::get<laws::GeneralisedKelvin>(*scene.laws[int(pair)]).alpha, 0.1) << to_string(pair);
  }
}

INSTANTIATE_TEST_SUITE_P(Scene, ExampleScene,
                         ::testing::Values("demo", "ac14_ss_am1", "ac14_ss_am2", "ac14_ms_poly_coarse",
                                           "ac14_ms_poly_fine", "ac14_ms_ico_coarse", "ac14_ms_ico_fine",
                                           "ac14_ms_design", "mastic", "ac14_recipe", "ac20_recipe"));

/// The M–A row of Table 4 of [1] is δ times the M–M row. Both rows are rounded to four digits, so their ratio is
/// accurate to twice 5e-4. The test finds mistyped digits in the examples.
TEST(ExampleScenes, TheMasticAggregateLawIsDeltaTimesTheMasticLaw) {
  for (const auto& [folder, delta] : {std::pair{"ac14_ss_am1", 3.15},
                                      {"ac14_ss_am2", 6.75},
                                      {"ac14_ms_poly_coarse", 3.15},
                                      {"ac14_ms_poly_fine", 3.15},
                                      {"ac14_ms_ico_coarse", 3.15},
                                      {"ac14_ms_ico_fine", 3.15},
                                      {"ac14_ms_design", 3.15},
                                      {"ac14_recipe", 3.15},
                                      {"ac20_recipe", 3.15},
                                      {"demo", 3.15}}) {
    const Scene scene = read_scene(fs::path(MACADAM_EXAMPLES) / folder / "scene.toml");
    const auto& mm = std::get<laws::GeneralisedKelvin>(*scene.laws[int(PairType::mm)]);
    const auto& ma = std::get<laws::GeneralisedKelvin>(*scene.laws[int(PairType::ma)]);
    const double tolerance = 1e-3;
    EXPECT_NEAR(ma.E_m / mm.E_m / delta, 1, tolerance) << folder;
    EXPECT_NEAR(ma.C_m / mm.C_m / delta, 1, tolerance) << folder;
    ASSERT_EQ(ma.units(), 3) << folder;
    for (std::size_t l = 0; l < 3; ++l) {
      EXPECT_NEAR(ma.E[l] / mm.E[l] / delta, 1, tolerance) << folder;
      EXPECT_NEAR(ma.C[l] / mm.C[l] / delta, 1, tolerance) << folder;
    }
  }
}

TEST(ExampleScenes, AC14HasTheCountsOfTable3AndTheModuliOfTable4) {
  const Scene scene = read_scene(fs::path(MACADAM_EXAMPLES) / "ac14_ss_am2" / "scene.toml");
  std::vector<std::int64_t> counts;
  for (const auto& c : scene.specimen.aggregate) counts.push_back(*c.count);
  EXPECT_EQ(counts, (std::vector<std::int64_t>{12, 27, 184, 1373}));
  EXPECT_EQ(scene.specimen.mastic->count, 34164);
  EXPECT_EQ(scene.specimen.box.size.z, 0.08);
  const auto& mm = std::get<laws::GeneralisedKelvin>(*scene.laws[int(PairType::mm)]);
  EXPECT_EQ(mm.E_m, 8.909e9);
  EXPECT_EQ(mm.C, (std::vector<double>{2.854e8, 5.865e8, 5.354e9}));
  EXPECT_EQ(std::get<laws::Elastic>(*scene.laws[int(PairType::mw)]).E, 8.909e9);
  EXPECT_EQ(std::get<laws::Elastic>(*scene.laws[int(PairType::aa)]).alpha, 0.05);
}

/// The AC 14 of [1] by mass has 16.3, 12.5, 23.4 and 15.3 % of the aggregate above 2 mm. With the densities and 5.2 %
/// of binder this is nearly its design formulation by volume, 14.0, 11.0, 20.7 and 13.6 % of the solids. The difference
/// of half a percentage point comes from rounding in [1] and from the binder's density, which [1] does not give.
TEST(ExampleScenes, AC14ByMassIsTheDesignFormulation) {
  const Scene scene = read_scene(fs::path(MACADAM_EXAMPLES) / "ac14_recipe" / "scene.toml");
  const Scene design = read_scene(fs::path(MACADAM_EXAMPLES) / "ac14_ms_design" / "scene.toml");
  ASSERT_EQ(scene.specimen.aggregate.size(), design.specimen.aggregate.size());
  const double retained[] = {0.163, 0.125, 0.234, 0.153};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& curve = scene.recipe->gradation;
    EXPECT_NEAR(curve[k].passing - curve[k + 1].passing, retained[k], 1e-12);
    EXPECT_EQ(scene.specimen.aggregate[k].sieve_min, design.specimen.aggregate[k].sieve_min);
    EXPECT_EQ(scene.specimen.aggregate[k].sieve_max, design.specimen.aggregate[k].sieve_max);
    EXPECT_NEAR(*scene.specimen.aggregate[k].volume_fraction, *design.specimen.aggregate[k].volume_fraction, 0.005);
  }
  EXPECT_EQ(scene.materials.aggregate, design.materials.aggregate);
}

/// Checks that the gradation follows the formula that the scene names, to the digits given.
TEST(ExampleScenes, AC20IsAFullerCurve) {
  const Scene scene = read_scene(fs::path(MACADAM_EXAMPLES) / "ac20_recipe" / "scene.toml");
  for (const SievePassing& s : scene.recipe->gradation)
    EXPECT_NEAR(s.passing, std::pow(s.size / 0.020, 0.45), 0.0005) << s.size;
}

}  // namespace
}  // namespace macadam
