// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_recipe_test.cpp  Tests that `[specimen.recipe]` is read correctly and that keys which can be computed
/// from it may be left out. If a key contradicts the recipe, the error message gives its line and the calculation.
#include <fmt/format.h>
#include <unistd.h>

#include <map>

#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

/// A valid scene with a recipe; line k of the file is entry k − 1.
const std::vector<std::string> good = {
    "[specimen]",                                       // 1
    "box = [0.03, 0.03, 0.03]",                         // 2
    "[specimen.recipe]",                                // 3
    "gradation = [[\"10 mm\", \"100 %\"],",             // 4
    "[\"5 mm\", \"60 %\"],",                            // 5
    "[\"2 mm\", \"30 %\"],",                            // 6
    "[\"0.063 mm\", \"10 %\"]]",                        // 7
    "cut = \"2 mm\"",                                   // 8
    "binder = \"5 %\"",                                 // 9
    "binder_of = \"aggregate\"",                        // 10
    "aggregate_density = [\"2.5 g/cm3\", 2800, 2600]",  // 11
    "filler_density = 2700",                            // 12
    "binder_density = 1000",                            // 13
    "absorbed_binder = \"1 %\"",                        // 14
    "air_voids = \"4 %\"",                              // 15
    "envelope = [[\"5 mm\", \"50 %\", \"70 %\"]]",      // 16
    "[specimen.mastic]",                                // 17
    "radius = [\"0.75 mm\", \"1.00 mm\"]",              // 18
    "",                                                 // 19
    "[loading]",                                        // 20
    "kind = \"cyclic\"",                                // 21
    "frequencies = [10.0]",                             // 22
};
using Edits = std::map<int, std::string>;

class SceneRecipe : public testing::Test {
 protected:
  SceneRecipe() : folder_(fs::path(testing::TempDir()) / fmt::format("macadam_recipe_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~SceneRecipe() override { fs::remove_all(folder_); }

  /// Reads the scene `good` with the given edits; `materials` is appended to its lines.
  Scene scene(const Edits& edits = {}, const std::string& materials = "") const {
    std::vector<std::string> lines = good;
    for (const auto& [line, text] : edits) lines.at(static_cast<std::size_t>(line - 1)) = text;
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    std::string contacts = am1_contacts;
    contacts = contacts.substr(contacts.find("[[contacts]]"));
    write(folder_ / "scene.toml", text + materials + "\n" + contacts);
    return read_scene(folder_ / "scene.toml");
  }
  std::string refused(const Edits& edits, const std::string& materials = "") const {
    return message_of([&] { scene(edits, materials); });
  }
  fs::path folder_;
};

/// The expected numbers are derived in recipe_test.cpp, test DensitiesASizeAndAbsorbedBinderByHand.
TEST_F(SceneRecipe, GivesClassesPorosityAndDensities) {
  const Scene s = scene();
  ASSERT_TRUE(s.recipe);
  EXPECT_EQ(s.recipe->gradation[1].size, 0.005);
  EXPECT_EQ(s.recipe->gradation[1].passing, 0.6);
  EXPECT_EQ(s.recipe->gradation[1].line, 5);
  EXPECT_EQ(s.recipe->aggregate_density, (std::vector<double>{2500, 2800, 2600}));
  EXPECT_EQ(s.recipe->envelope[0].most, 0.7);
  ASSERT_EQ(s.specimen.aggregate.size(), 2u);
  EXPECT_EQ(s.specimen.aggregate[1].sieve_min, 0.002);
  EXPECT_EQ(s.specimen.aggregate[1].sieve_max, 0.005);
  EXPECT_EQ(s.specimen.aggregate[1].line, 6);
  EXPECT_NEAR(*s.specimen.aggregate[0].volume_fraction + *s.specimen.aggregate[1].volume_fraction, 0.6090129 / 0.96,
              1e-7);
  EXPECT_EQ(s.specimen.mastic->porosity, 0.04);
  EXPECT_NEAR(s.materials.aggregate, 2646.524, 1e-3);
  EXPECT_NEAR(s.materials.mastic, 2227.850, 1e-3);
  EXPECT_EQ(scene({{8, ""}, {11, "aggregate_density = 2600"}}).recipe->cut, 0.002);
  EXPECT_FALSE(scene({{3, ""},
                      {4, ""},
                      {5, ""},
                      {6, ""},
                      {7, ""},
                      {8, ""},
                      {9, ""},
                      {10, ""},
                      {11, ""},
                      {12, ""},
                      {13, ""},
                      {14, ""},
                      {15, ""},
                      {16, ""},
                      {19, "porosity = 0.05"}},
                     "[materials.mastic]\ndensity = 2110")
                   .recipe);
}

TEST_F(SceneRecipe, DensitiesOfMaterialsAgreeOrAreRefused) {
  const std::string aggregate = "[materials.aggregate]\ndensity = 2650\n", mastic = "[materials.mastic]\ndensity = ";
  // The given density is rounded, so it differs from the recipe's density by less than half a unit of its third digit.
  const Scene s = scene({}, aggregate + mastic + "\"2.23 g/cm3\"\n");
  EXPECT_NEAR(s.materials.aggregate, 2646.524, 1e-3);  // the recipe's densities are used
  EXPECT_NEAR(s.materials.mastic, 2227.850, 1e-3);
  const std::string message = refused({}, aggregate + mastic + "2110\n");
  EXPECT_HAS(message, "scene.toml:26: [materials.mastic] density: found 2110 kg/m3, expected 2227.85 kg/m3");
  EXPECT_HAS(message, "1 kg of the mix has 0.326667 kg of mastic in 146.629 cm3");  // 0.343/1.05 and 1.539601e-4/1.05
  EXPECT_HAS(refused({}, "[materials.aggregate]\ndensity = 2500\n"), "found 2500 kg/m3, expected 2646.52 kg/m3");
}

struct Fault {
  const char* name;
  Edits edits;
  int line;
  const char *found, *expected;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class RecipeFault : public SceneRecipe, public testing::WithParamInterface<Fault> {};

TEST_P(RecipeFault, IsRefusedAtItsLineWithTheSum) {
  const Fault& fault = GetParam();
  const std::string message = refused(fault.edits);
  EXPECT_HAS(message, fmt::format("scene.toml:{}: ", fault.line));
  EXPECT_HAS(message, fault.found);
  EXPECT_HAS(message, fault.expected);
  EXPECT_HAS(message, "found ");
  EXPECT_HAS(message, ", expected ");
}

INSTANTIATE_TEST_SUITE_P(
    Faults, RecipeFault,
    testing::ValuesIn(std::vector<Fault>{
        {"NotMonotonic",
         {{6, "[\"2 mm\", \"61 %\"],"}},
         6,
         "61 % passing 2 mm after 60 % passing 5 mm",
         "at most 60 %"},
        {"BeyondHundred", {{5, "[\"5 mm\", \"160 %\"],"}}, 5, "\"160 %\"", "from \"0 %\" to \"100 %\""},
        {"PercentWithoutItsSign", {{5, "[\"5 mm\", 60],"}}, 5, "found 60", "from \"0 %\" to \"100 %\""},
        {"Negative", {{7, "[\"0.063 mm\", \"-1 %\"]]"}}, 7, "\"-1 %\"", "from \"0 %\" to \"100 %\""},
        {"NoUpperSize", {{4, "gradation = [[\"10 mm\", \"95 %\"],"}}, 4, "95 % passing 10 mm", "100 % pass"},
        {"FineToCoarse", {{5, "[\"12 mm\", \"60 %\"],"}}, 5, "12 mm after 10 mm", "from coarse to fine"},
        {"OneSieve", {{5, "]"}, {6, ""}, {7, ""}}, 4, "1 sieves", "two or more"},
        {"RowOfThree", {{5, "[\"5 mm\", \"60 %\", 2650],"}}, 5, "3 entries", "[sieve, passing]"},
        {"NoRows", {{4, "gradation = [10, 5]"}, {5, ""}, {6, ""}, {7, ""}}, 4, "found 10", "[sieve, passing]"},
        {"CutOutside", {{8, "cut = \"12 mm\""}}, 8, "12 mm, outside of the curve", "10, 5, 2, 0.063 mm"},
        {"CutBetween", {{8, "cut = \"3 mm\""}}, 8, "3 mm, between its sieves", "10, 5, 2, 0.063 mm"},
        {"BinderBeyondTheMix",
         {{9, "binder = \"120 %\""}, {10, "binder_of = \"mix\""}},
         9,
         "120 % of the mix, which leaves -20 % of aggregate",
         "below 100 %"},
        {"NoBinder", {{9, "binder = 0"}}, 9, "0 %", "above 0"},
        {"NoAggregateLeft", {{9, "binder = 1e300"}}, 9, "1e+302 %", "at most 300 %"},
        {"MostlyBinder", {{9, "binder = 0.9"}, {10, "binder_of = \"mix\""}}, 9, "90 %", "at most 75 % of the mix"},
        {"BinderOfNothing", {{10, ""}}, 3, "binder_of: found nothing", "required"},
        {"BinderOfSomethingElse", {{10, "binder_of = \"box\""}}, 10, "\"box\"", "\"mix\", \"aggregate\""},
        {"GramsWithoutUnit", {{13, "binder_density = 1.03"}}, 13, "1.03 kg/m3", "200 to 10000 kg/m3"},
        {"TooFewDensities", {{11, "aggregate_density = [2600, 2600]"}}, 11, "2 densities", "1 density, or 3 densities"},
        {"MoreAbsorbedThanBinder",
         {{14, "absorbed_binder = \"6 %\""}},
         14,
         "an effective binder of 4.7619 % - 5.71429 % = -0.952381 %",
         "at most 5 % of the aggregate's mass"},
        {"AbsorbedTwice", {{12, "maximum_density = 2500"}}, 14, "absorbed_binder and maximum_density", "one of them"},
        // If no binder is absorbed, the maximum density is 1.05/(3.811030e-4 + 5e-5) = 2435.613 kg/m³.
        {"NegativeAbsorption",
         {{14, "maximum_density = 2400"}},
         14,
         "2400 kg/m3, from which an absorbed binder of -0.6397",
         "at least 2435.61 kg/m3, which is the value without absorption: 1 kg / (0.952381 kg / 2623.96 kg/m3 + "
         "0.047619 kg / 1000 kg/m3)"},
        // If all binder is absorbed, the maximum density is 1.05/3.811030e-4 = 2755.16 kg/m³.
        {"NegativeEffectiveBinder", {{14, "maximum_density = 2800"}}, 14, "absorbed binder and -", "at most 2755.16"},
        {"VoidsTwice", {{16, "bulk_density = 2400"}}, 16, "air_voids and bulk_density", "exactly one"},
        {"NoVoids", {{15, ""}}, 3, "neither air_voids nor bulk_density", "exactly one"},
        {"AllVoids", {{15, "air_voids = \"100 %\""}}, 15, "100 %", "below 100 %"},
        // The air voids would be 1 − 2600/2493.45 = −4.27312 %.
        {"NegativeVoids", {{15, "bulk_density = 2600"}}, 15, "1 - 2600 / 2493.45 = -4.27312 %", "at most the maximum"},
        {"EnvelopeUpsideDown",
         {{16, "envelope = [[\"5 mm\", \"70 %\", \"50 %\"]]"}},
         16,
         "70 % to 50 % passing 5 mm",
         "the lower limit before the upper limit"},
        {"EnvelopeTwice",
         {{16, "envelope = [[\"5 mm\", 0.5, 0.7],"}, {17, "[\"5 mm\", 0.5, 0.7]]\n[specimen.mastic]"}},
         17,
         "5 mm twice",
         "once"},
        {"UnknownKey", {{16, "voids = 0.04"}}, 16, "unknown key", "air_voids"},
        {"ClassesBeside",
         {{19, "[[specimen.aggregate]]\nsieve = [0.002, 0.005]\ncount = 3"}},
         19,
         "with [specimen.recipe]",
         "one of the two"},
        {"PorosityBeside", {{19, "porosity = 0.05"}}, 19, "with [specimen.recipe]", "the recipe give the porosity"},
        {"CountBeside", {{19, "count = 5"}}, 19, "with [specimen.recipe]", "no such key"},
        {"NoMastic", {{17, ""}, {18, ""}}, 3, "without [specimen.mastic]", "with its radius"},
        {"LargerThanTheBox",
         {{2, "box = [0.03, 0.01, 0.03]"}},
         5,
         "aggregate of 5 to 10 mm",
         "edge of the box, 10 mm"}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(SceneRecipe, NoneBesideAFile) {
  write(folder_ / "some.csv", "id,x,y,z,radius,phase,body\n");
  EXPECT_HAS(refused({{2, "box = [0.03, 0.03, 0.03]\nfile = \"some.csv\""}}), "together with the key file");
}

// The box has 27000 mm³. The finest class, 2 to 5 mm, takes the material of the class 5 to 10 mm if that class has less
// than the 65.4 mm³ of a sphere of 5 mm.
TEST_F(SceneRecipe, AClassWithLessThanOneGrainIsMerged) {
  EXPECT_TRUE(scene().specimen.merged.empty());
  const Scene whole = scene({{5, "[\"5 mm\", \"99.9 %\"],"}, {16, ""}});
  ASSERT_EQ(whole.specimen.aggregate.size(), 2u);
  EXPECT_EQ(whole.specimen.aggregate[0].volume_fraction, 0.0);
  ASSERT_EQ(whole.specimen.merged.size(), 1u);
  EXPECT_NE(whole.specimen.merged[0].find("5-10 mm"), std::string::npos) << whole.specimen.merged[0];
  EXPECT_NE(whole.specimen.merged[0].find("2-5 mm"), std::string::npos) << whole.specimen.merged[0];
  const MixVolumes v = volumes_of(*whole.recipe);
  EXPECT_DOUBLE_EQ(*whole.specimen.aggregate[1].volume_fraction,
                   v.classes[1].volume / (1 - v.air_voids) + v.classes[0].volume / (1 - v.air_voids));
}

}  // namespace
}  // namespace macadam::test
