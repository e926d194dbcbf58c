// SPDX-License-Identifier: GPL-3.0-or-later
/// \file wrong_scenes_test.cpp  Every wrong scene is refused with its line, the value found and the value expected.
#include "tests/scene/scene_file.hpp"

namespace macadam {
namespace {

using test::Edits, test::SceneFile, test::text_of;

/// A scene with one fault.
struct Wrong {
  const char* name;
  Edits edits;
  int line;              ///< line in the message; 0 if it names only the file
  std::string found;     ///< follows ": found " in the message
  std::string expected;  ///< follows ", expected " in the message
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

class WrongScene : public SceneFile, public ::testing::WithParamInterface<Wrong> {};

TEST_P(WrongScene, IsRefusedAtItsLine) {
  const Wrong& wrong = GetParam();
  const std::string what = message(text_of(wrong.edits));
  ASSERT_FALSE(what.empty()) << "accepted";
  const std::string where = file().string() + (wrong.line ? ":" + std::to_string(wrong.line) : "") + ": ";
  EXPECT_EQ(what.substr(0, where.size()), where) << what;
  const auto found = what.find(": found "), expected = what.rfind(", expected ");
  ASSERT_NE(found, std::string::npos) << what;
  ASSERT_NE(expected, std::string::npos) << what;
  EXPECT_NE(what.substr(found, expected - found).find(wrong.found), std::string::npos) << what;
  EXPECT_NE(what.substr(expected).find(wrong.expected), std::string::npos) << what;
}

// clang-format off
const std::vector<Wrong> wrong_scenes = {
    // Keys and sections
    {"UnknownKey", {{33, "cycels = 5"}}, 33, "unknown key", "expected cycles "},
    {"UnknownKeyInUpperCase", {{3, "SEED = 7"}}, 3, "unknown key", "expected seed "},
    {"UnknownSection", {{35, "[solvr]"}}, 35, "unknown section", "expected solver "},
    {"UnknownSubsection", {{7, "[specimen.mastik]"}}, 7, "unknown key", "expected mastic "},
    {"UnknownPhase", {{12, "[materials.bitumen]"}}, 12, "unknown key", "aggregate, mastic"},
    {"KeyOfAnotherLaw", {{26, "E_m = 1e9"}}, 26, "unknown key", "expected one of pair, law"},
    {"KeyBeforeAnySection", {{1, "seed = 1\n[specimen]"}}, 1, "unknown section", "expected "},
    {"NoBox", {{2, ""}}, 1, "nothing", "required"},
    {"NoLoading", {{29, ""}, {30, ""}, {31, ""}, {32, ""}, {33, ""}, {34, ""}}, 0, "nothing", "section, which is req"},
    {"NoFrequencies", {{31, ""}}, 29, "nothing", "required"},
    {"NoKind", {{30, ""}}, 29, "nothing", "required"},
    {"NoLaw", {{24, ""}}, 22, "nothing", "\"elastic\" or \"generalised_kelvin\""},
    {"NoPair", {{15, ""}}, 14, "nothing", "required"},
    {"NoModulus", {{25, ""}}, 22, "nothing", "required"},
    {"NoSieve", {{5, ""}}, 4, "nothing", "required"},
    {"NoDensityKey", {{13, ""}}, 12, "nothing", "required"},
    {"NoDensityOfTheMastic", {{12, ""}, {13, ""}}, 10, "mastic that [specimen] generates", "[materials.mastic]"},
    {"SyntaxError", {{32, "strain_amplitude = "}}, 32, "Error while parsing", "valid TOML"},
    {"KeyTwice", {{34, "cycles = 6"}}, 34, "cycles", "valid TOML"},
    {"NotUtf8", {{3, "seed = 1 # \xff"}}, 3, "", "valid TOML"},
    // Types
    {"SectionIsANumber", {{41, ""}, {42, ""}, {1, "output = 5\n[specimen]"}}, 1, "5", "a section [output]"},
    {"ContactsInSingleBrackets", {{14, "[contacts]"}, {22, ""}, {23, ""}, {24, ""}, {25, ""}, {26, ""}, {43, ""}, {44, ""}, {45, ""}, {46, ""}, {47, ""}, {48, ""}, {49, ""}, {50, ""}},
     14, "a table", "[[contacts]]"},
    {"MasticInDoubleBrackets", {{7, "[[specimen.mastic]]"}}, 7, "an array of length 1", "[specimen.mastic]"},
    {"TextForANumber", {{32, "strain_amplitude = \"small\""}}, 32, "\"small\"", "without unit"},
    {"TrueForANumber", {{11, "density = true"}}, 11, "true", "kg/m3"},
    {"DateForANumber", {{11, "density = 2024-01-01"}}, 11, "date", "kg/m3"},
    {"NumberForTrue", {{42, "contacts = 1"}}, 42, "1", "true or false"},
    {"NumberForText", {{24, "law = 3"}}, 24, "3", "\"elastic\""},
    {"FractionForAnInteger", {{33, "cycles = 5.5"}}, 33, "5.5", "an integer from 1"},
    {"TextForAnInteger", {{3, "seed = \"one\""}}, 3, "\"one\"", "an integer of at least 0"},
    {"OneFrequencyWithoutArray", {{31, "frequencies = 2.0"}}, 31, "2", "an array"},
    {"EntryOnItsOwnLine", {{31, "frequencies = [\n  2,\n  -5]"}}, 33, "-5", "positive"},
    {"BoxWithTwoEdges", {{2, "box = [0.02, 0.02]"}}, 2, "2 entries", "three"},
    {"SieveWithOneSize", {{5, "sieve = [0.002]"}}, 5, "1 entries", "two, [min, max]"},
    {"EmptyFileName", {{3, "file = \"\""}}, 3, "\"\"", "not empty"},
    // Units
    {"LengthInPascal", {{2, "box = [0.02, \"20 GPa\", 0.03]"}}, 2, "\"20 GPa\"", "m, cm, mm"},
    {"ModulusInMetres", {{25, "E = \"1 mm\""}}, 25, "\"1 mm\"", "Pa, kPa, MPa, GPa"},
    {"ModulusInViscosity", {{17, "E_m = \"11 GPa s\""}}, 17, "\"11 GPa s\"", "Pa, kPa, MPa, GPa"},
    {"ViscosityInPascal", {{20, "C = [\"1 GPa\", 5e9]"}}, 20, "\"1 GPa\"", "Pa s"},
    {"TextWithoutUnit", {{25, "E = \"1e9\""}}, 25, "\"1e9\"", "GPa"},
    {"UnknownUnit", {{11, "density = \"164 lb/ft3\""}}, 11, "lb/ft3", "kg/m3, g/cm3"},
    {"DecimalComma", {{8, "radius = [\"0,75 mm\", \"1 mm\"]"}}, 8, "\"0,75 mm\"", "mm"},
    {"RatioWithALength", {{9, "porosity = \"5 mm\""}}, 9, "\"5 mm\"", "%"},
    {"FrequencyInSeconds", {{31, "frequencies = [\"2 s\"]"}}, 31, "\"2 s\"", "Hz, mHz, kHz"},
    {"TextTooLarge", {{25, "E = \"1e305 GPa\""}}, 25, "1e305", "GPa"},
    {"InfiniteText", {{2, "box = [0.02, 0.02, \"inf mm\"]"}}, 2, "inf", "mm"},
    // Ranges
    {"NotANumber", {{32, "strain_amplitude = nan"}}, 32, "nan", "finite"},
    {"InfiniteModulus", {{17, "E_m = inf"}}, 17, "inf", "finite"},
    {"MinusInfiniteDashpot", {{18, "C_m = -inf"}}, 18, "-inf", "finite"},
    {"DensityZero", {{11, "density = 0"}}, 11, "0", "10 to 30000 kg/m3"},
    {"DensityWithoutItsUnit", {{11, "density = 2.63"}}, 11, "2.63", "in another unit is text with the unit"},
    {"ModulusWithoutItsUnit", {{25, "E = 115.1"}}, 25, "115.1", "in another unit is text with the unit"},
    {"NegativeModulus", {{25, "E = -1e9"}}, 25, "-1", "1000 Pa or more"},
    {"NegativeAlpha", {{21, "alpha = -0.1"}}, 21, "-0.1", "not negative"},
    {"DeltaZero", {{26, "delta = 0.0"}}, 26, "0", "positive"},
    {"DeltaOverflow", {{26, "delta = 1e300"}}, 26, "1e+300", "range of double precision"},
    {"FlatBox", {{2, "box = [0.02, 0.02, 0]"}}, 2, "0", "positive"},
    {"VolumeUnderflow", {{2, "box = [1e-150, 1e-150, 1e-150]"}}, 2, "a volume of 0 m3", "range of double precision"},
    {"VolumeOverflow", {{2, "box = [1e150, 1e150, 1e150]"}}, 2, "a volume of inf m3", "range of double precision"},
    {"SieveUpsideDown", {{5, "sieve = [0.0095, 0.00475]"}}, 5, "[0.0095, 0.00475]", "min not above max"},
    {"SieveOfZero", {{5, "sieve = [0, 0.00475]"}}, 5, "0", "positive"},
    {"AggregateLargerThanTheBox", {{5, "sieve = [\"5 mm\", \"20 mm\"]"}}, 5, "0.02 m", "smallest edge"},
    {"MasticLargerThanTheBox", {{8, "radius = [\"5 mm\", \"10 mm\"]"}}, 8, "0.02 m", "smallest edge"},
    {"PorosityOfOne", {{9, "porosity = 1"}}, 9, "1", "between -1 and 1"},
    {"VolumeFractionZero", {{6, "volume_fraction = 0"}}, 6, "0", "above 0"},
    {"VolumeFractionAboveOne", {{6, "volume_fraction = 25"}}, 6, "25", "at most 1"},
    {"CountZero", {{6, "count = 0"}}, 6, "0", "an integer from 1"},
    {"NegativeSeed", {{3, "seed = -1"}}, 3, "-1", "at least 0"},
    {"StrainOfNothing", {{32, "strain_amplitude = 5e-324"}}, 32, "found 5e-324", "from 1e-20"},
    {"StrainOfOne", {{32, "strain_amplitude = \"100 %\""}}, 32, "100 %", "below 1"},
    {"NoCycles", {{33, "cycles = 0"}}, 33, "0", "an integer from 1"},
    {"FewSamples", {{34, "samples_per_cycle = 7"}}, 34, "7", "an integer from 8"},
    {"NegativeGapTooLarge", {{28, "gap_max = -2"}}, 28, "-2", "above -2"},
    {"NegativeArea", {{28, "area_min = -0.1"}}, 28, "-0.1", "not negative"},
    {"NegativeGapOfAPairTooLarge", {{21, "gap_max = -2"}}, 21, "-2", "above -2"},
    {"NegativeAreaOfAPair", {{21, "area_min = -0.1"}}, 21, "-0.1", "not negative"},
    {"GapOfAWall", {{26, "gap_max = 0"}}, 26, "a wall", "every facet on a wall is a contact"},
    {"AreaOfAWall", {{26, "area_min = 0"}}, 26, "a wall", "every facet on a wall is a contact"},
    {"SafetyAboveOne", {{38, "safety = 1.2"}}, 38, "1.2", "at most 1"},
    {"SafetyZero", {{38, "safety = 0"}}, 38, "0", "above 0"},
    {"ScalingZero", {{37, "density_scaling = 0"}}, 37, "0", "positive"},
    {"NegativeThreads", {{38, "threads = -1"}}, 38, "-1", "an integer from 0"},
    {"NegativeDevice", {{38, "device = -1"}}, 38, "-1", "an integer from 0"},
    {"DeviceOfTheProcessor", {{38, "backend = \"cpu\"\ndevice = 1"}}, 39, "1", "\"cuda\" or \"auto\""},
    {"LocalDampingOfOne", {{40, "damping = 1.0"}}, 40, "1", "below 1"},
    // Choices
    {"UnknownPair", {{15, "pair = \"M-B\""}}, 15, "\"M-B\"", "\"M-M\", \"M-A\", \"A-A\", \"inner\""},
    {"UnknownLaw", {{24, "law = \"burgers\""}}, 24, "\"burgers\"", "\"elastic\", \"generalised_kelvin\""},
    {"UnknownKind", {{30, "kind = \"impact\""}}, 30, "\"impact\"", "\"cyclic\""},
    {"UnknownMethod", {{36, "method = \"implicit\""}}, 36, "\"implicit\"", "\"harmonic\""},
    {"UnknownPrecision", {{36, "precision = \"float\""}}, 36, "\"float\"", "\"mixed\""},
    {"UnknownBackend", {{36, "backend = \"gpu\""}}, 36, "\"gpu\"", "\"cuda\""},
    {"UnknownSizeLaw", {{3, "size_law = \"normal\""}}, 3, "\"normal\"", "\"log_uniform\""},
    // Conditions between keys
    {"PairTwice", {{23, "pair = \"M-M\""}}, 23, "\"M-M\" again", "once"},
    {"KelvinUnitsUnequal", {{20, "C = [8.95e9]"}}, 20, "1 viscosities for the 2 moduli", "the same number"},
    {"KelvinWithoutDashpots", {{20, ""}}, 14, "0 viscosities for the 2 moduli", "the same number"},
    {"TooManyKelvinUnits",
     {{19, "E = [1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]"}, {20, "C = [1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]"}},
     19, "17 Kelvin units", "at most 16"},
    {"FractionAndCount", {{6, "volume_fraction = 0.2\ncount = 3"}}, 7, "volume_fraction and count", "exactly one"},
    {"NeitherFractionNorCount", {{6, ""}}, 4, "neither volume_fraction nor count", "exactly one"},
    {"PorosityAndCount", {{9, "count = 3\nporosity = 0.05"}}, 9, "porosity and count", "exactly one"},
    {"NeitherPorosityNorCount", {{9, ""}}, 7, "neither porosity nor count", "exactly one"},
    {"FractionsFillTheSolid",
     {{6, "volume_fraction = 0.6\n[[specimen.aggregate]]\nsieve = [0.002, 0.004]\nvolume_fraction = 0.4"}},
     4, "sum 1", "below 1"},
    {"FractionWithoutMastic", {{7, ""}, {8, ""}, {9, ""}}, 4, "volume_fraction without [specimen.mastic]", "count"},
    {"AggregatesLargerThanTheBox", {{6, "count = 1000"}}, 4, "a total volume of aggregates of at least", "less than the volume of the box"},
    {"AggregatesLeaveNoMastic", {{6, "count = 200"}, {9, "porosity = 0.9"}},
     4, "a total volume of aggregates of at least", "solid volume"},
    {"SpheresOfDust", {{8, "radius = [1e-9, 1e-9]"}}, 7, "particles", "at most 100000000"},
    {"MasticFillsTheBoxTwice", {{9, "count = 90000"}}, 7, "spheres with a total volume of at least", "twice the volume of the box"},
    {"NothingToGenerate", {{4, ""}, {5, ""}, {6, ""}, {7, ""}, {8, ""}, {9, ""}}, 1, "neither this key nor a section of particles", "a specimen file"},
    {"FrequencyTwice", {{31, "frequencies = [5, 2, \"5000 mHz\"]"}}, 31, "5 Hz twice", "once"},
    {"FrequenciesEmpty", {{31, "frequencies = []"}, {37, ""}}, 31, "none", "at least one"},
    {"ScalingForTooFew", {{37, "density_scaling = [100]"}}, 37, "1 entries", "an array of length 2"},
    {"RampAsLongAsTheRun", {{34, "ramp_cycles = 4.5"}}, 34, "4.5", "at most 3, because the last 2 of 5 cycles are fitted"},
    {"NoLawForAPairThatIsGenerated", {{48, "pair = \"inner\""}}, 14, "no law for M-W", "pair = \"M-W\""},
    {"NoLawOfMasticToAggregate", {{44, "pair = \"inner\""}}, 14, "no law for M-A", "pair = \"M-A\""},
    {"ExactQuadratureOfTheReference", {{28, "quadrature = \"exact\""}, {39, "backend = \"reference\""}},
     28, "\"reference\"", "\"lumped\""},
    {"FitLongerThanTheRun", {{34, "fit_cycles = 6"}}, 34, "6", "at most the number of cycles, 5"},
    {"ExactQuadratureOfPoints", {{28, "quadrature = \"exact\""}, {39, "form = \"points\""}},
     28, "form = \"points\"", "\"lumped\""},
    {"InertiaOfAnExplicitRun", {{36, "inertia = true"}}, 36, "explicit", "harmonic"},
    {"StepLongerThanACycle", {{38, "time_step = 0.05"}}, 38, "0.05 s", "at most 0.025 s"},
    {"DampingWithoutKind", {{40, "damping_kind = \"none\"\ndamping = 0.3"}}, 41, "0.3", "\"none\""},
    {"KindWithoutDamping", {{40, "damping_kind = \"viscous\""}}, 35, "nothing", "viscous"},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Scene, WrongScene, ::testing::ValuesIn(wrong_scenes),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_F(SceneFile, AFileBesideARecipeIsRefused) {
  std::ofstream(folder_ / "particles.csv") << "id\n";
  const std::string what = message(text_of({{3, "file = \"particles.csv\""}}));
  EXPECT_NE(what.find(":4: [specimen] aggregate: found this key of the generator together with the key file"),
            std::string::npos)
      << what;
}

// The box has 12 cm³. 44 spheres of 8 mm have 11.80 cm³ and are accepted; 45 spheres have 12.06 cm³ and are refused.
TEST_F(SceneFile, VoidsByCountLeaveRoomInTheBox) {
  const auto with_voids = [](int count) {
    return text_of(
        {{9, "porosity = 0.05\n[specimen.voids]\nradius = [0.004, 0.005]\ncount = " + std::to_string(count)}});
  };
  EXPECT_EQ(message(with_voids(44)), "");
  EXPECT_NE(message(with_voids(45)).find("voids as large as the box"), std::string::npos) << message(with_voids(45));
}

TEST_F(SceneFile, CountedAggregatesNeedNoMastic) {
  EXPECT_EQ(message(text_of({{6, "count = 3"}, {7, ""}, {8, ""}, {9, ""}})), "");
}

// In the box of 12 cm³, 40 aggregates of 8 mm leave space for 4e7 spheres of 0.04 mm. One aggregate leaves space for
// 3.5e8 spheres, which is too many.
TEST_F(SceneFile, MasticHasTheRoomThatCountedAggregatesLeave) {
  const auto with_aggregates = [](int count) {
    return text_of({{5, "sieve = [0.008, 0.008]"},
                    {6, "count = " + std::to_string(count)},
                    {8, "radius = [2e-5, 2e-5]"},
                    {9, "porosity = 0"}});
  };
  EXPECT_EQ(message(with_aggregates(40)), "");
  EXPECT_NE(message(with_aggregates(1)).find("at most 100000000 particles"), std::string::npos)
      << message(with_aggregates(1));
}

TEST_F(SceneFile, AMissingFileAndADirectoryAreRefused) {
  EXPECT_THROW(read_scene(folder_ / "absent.toml"), InputError);
  EXPECT_THROW(read_scene(folder_), InputError);
  EXPECT_THROW(read(""), InputError);
}

TEST_F(SceneFile, FilesThatNobodyWroteByHandAreRefused) {
  EXPECT_NE(message(std::string(2'000'000, '\n')).find("found 2000000 bytes"), std::string::npos);
  EXPECT_NE(message("\n" + std::string(2001, '#')).find(":2: scene: found 2001 characters"), std::string::npos);
  // The deepest nesting that a line can hold: nested tables are destroyed recursively and must not exhaust the stack.
  std::string deep = "[output.a";
  while (deep.size() < 1990) deep += ".a";
  EXPECT_NE(message(deep + "]\n").find("[specimen]: found nothing"), std::string::npos);
}

TEST_F(SceneFile, ControlCharactersLeaveTheMessageInOneLine) {
  const std::string what = message("a = n\n\x02");
  EXPECT_TRUE(what.find("TOML syntax") != std::string::npos && what.find_first_of("\n\x02") == std::string::npos)
      << what;
}

TEST_F(SceneFile, AnUnreadableHeaderNamesItsLine) {  // an assertion in the TOML parser must not end the program
  const std::string what = message("\n[=]\n");
  EXPECT_EQ(what.substr(0, (file().string() + ":2: TOML syntax: ").size()), file().string() + ":2: TOML syntax: ");
}

TEST_F(SceneFile, CutOrCorruptedScenesAreReadOrRefusedButNeverCrash) {
  const std::string text = text_of();
  constexpr std::size_t stride = 3;  // the text is cut or corrupted at every third position
  for (std::size_t length = 0; length < text.size(); length += stride) message(text.substr(0, length));
  const std::string bytes = std::string("\0[]=\"'\n#.-9e\xff{", 14);
  for (std::size_t at = 0; at < text.size(); at += stride) {
    std::string broken = text;
    broken[at] = bytes[at % bytes.size()];
    message(broken);  // every exception other than InputError fails the test
  }
}

}  // namespace
}  // namespace macadam
