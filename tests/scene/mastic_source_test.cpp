// SPDX-License-Identifier: GPL-3.0-or-later
// mastic_source_test.cpp  Tests `from` in [materials.mastic]: the law that follows from another scene's specimen, the
// stored result, other files with a law, and refused files. Also tests the ranges of laws.
#include <cmath>
#include <numbers>

#include "macadam/laws/values.hpp"
#include "macadam/simulation.hpp"
#include "tests/scene/scene_file.hpp"

namespace macadam::test {
namespace {

const std::string specimen =
    "[specimen]\nbox = [0.008, 0.008, 0.011]\nseed = 3\n[specimen.mastic]\nradius = [0.00075, 0.001]\nporosity = "
    "0.05\n";
const std::string chain =
    "law = \"generalised_kelvin\"\nE_m = 6e9\nC_m = 1.3e9\nE = [2e8]\nC = [5e9]\npoisson_ratio = 0.35\nshift = "
    "\"wlf\"\n"
    "C1 = 14\nC2 = 120\nreference_temperature = 10\n";
const std::string density = "[materials.mastic]\ndensity = 2110\n";
const std::string series = "[network]\nrule = \"series\"\n";
const std::string cyclic = "[loading]\nkind = \"cyclic\"\nfrequencies = [2, 20]\n[solver]\nmethod = \"harmonic\"\n";
const std::string from_mortar = specimen + density + "from = \"mortar.toml\"\n" + series;

struct MasticFrom : SceneFile {
  void other(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  void mortar(const std::string& more = "") const {
    other("mortar.toml", specimen + density + chain + more + series + cyclic);
  }
  void refused(const std::string& text, const std::vector<std::string>& parts) const {
    const std::string what = message(text);
    for (const std::string& part : parts) EXPECT_NE(what.find(part), std::string::npos) << part << " in " << what;
  }
  static const laws::GeneralisedKelvin& mm(const Scene& scene) {
    return std::get<laws::GeneralisedKelvin>(scene.laws[0].value());
  }
  static std::complex<double> modulus(const laws::GeneralisedKelvin& law, double hz) {
    return law.stiffness(std::complex<double>(0, 2 * std::numbers::pi * hz));
  }
};

/// The law of chain.
laws::GeneralisedKelvin own() {
  laws::GeneralisedKelvin law;
  law.E_m = 6e9, law.C_m = 1.3e9, law.E = {2e8}, law.C = {5e9};
  return law;
}

// A specimen of mastic alone has the modulus of its mastic, so the computed law must be the law of the other scene.
TEST_F(MasticFrom, ASpecimenOfMasticGivesTheLawOfItsMastic) {
  mortar();
  Scene scene = read(from_mortar + cyclic);
  EXPECT_EQ(scene.materials.mastic_poisson_ratio, 0.35);
  ASSERT_TRUE(scene.mastic_source);
  EXPECT_EQ(compute_mastic_law(scene), std::vector<std::string>{});
  ASSERT_TRUE(scene.mastic_source->computed);
  const auto computed = *scene.mastic_source->computed;
  EXPECT_FALSE(computed.kept_before);
  // 2 to 20 Hz, half a decade more on both sides, then whole decades
  EXPECT_EQ(computed.lowest_hz, 0.1);
  EXPECT_EQ(computed.highest_hz, 100);
  EXPECT_EQ(scene.ranges[0].lowest_hz, 0.1);
  EXPECT_LE(computed.largest_difference, 0.02);  // a direct fit follows if the model's chain differs by more
  for (const double hz : {0.1, 2.0, 20.0, 100.0})
    EXPECT_LT(std::abs(modulus(mm(scene), hz) / modulus(own(), hz) - 1.0), 0.02) << hz;
  EXPECT_EQ(std::get<laws::Wlf>(scene.shifts[0]), (laws::Wlf{14, 120, 10}));
  EXPECT_EQ(law_range_warnings(scene), std::vector<std::string>{});

  Scene again = read(from_mortar + cyclic);
  compute_mastic_law(again);
  EXPECT_TRUE(again.mastic_source->computed->kept_before);
  EXPECT_EQ(mm(again).E, mm(scene).E) << "to the bit";
  EXPECT_EQ(mm(again).C_m, mm(scene).C_m);

  mortar("# another content\n");
  Scene changed = read(from_mortar + cyclic);
  compute_mastic_law(changed);
  EXPECT_FALSE(changed.mastic_source->computed->kept_before);
}

TEST_F(MasticFrom, TheShiftOfTheSpecimenAppliesAtTheSceneTemperature) {
  mortar();
  Scene scene = read("[materials]\ntemperature = 20\n" + from_mortar + cyclic);
  compute_mastic_law(scene);
  const double a_T = std::pow(10.0, -14.0 * 10 / 130);
  EXPECT_LT(std::abs(modulus(mm(scene), 2) / modulus(own(), 2 * a_T) - 1.0), 0.02);
  EXPECT_LE(scene.mastic_source->computed->lowest_hz, 2 * a_T / std::sqrt(10.0));
}

// While the temperature falls from 20 to 0 degrees C, log10 a_T rises from -1.08 to 1.27. The points of the test are a
// decade of time, with half a decade more on both sides. The crack of the pair stays with the computed law.
TEST_F(MasticFrom, TheRangeCoversATemperatureThatChanges) {
  mortar();
  Scene scene = read(from_mortar +
                     "[[contacts]]\npair = \"M-M\"\ncrack = { tensile_strength = 1e6, fracture_energy = 500 }\n"
                     "[loading]\nkind = \"monotonic\"\nrate = 1e-3\nstrain = 1e-3\npoints = 10\n"
                     "temperature = [[0, 20], [1, 0]]\n");
  compute_mastic_law(scene);
  const auto& computed = *scene.mastic_source->computed;
  EXPECT_GE(std::log10(computed.highest_hz / computed.lowest_hz), 1 + 1.08 + 1.27 + 1);
  EXPECT_EQ(std::get<laws::Cracked<laws::GeneralisedKelvin>>(scene.laws[0].value()).crack.fracture_energy, 500);
}

TEST_F(MasticFrom, ARunReportsTheLaw) {
  mortar();
  const RunResult result = run(read(from_mortar + cyclic), folder_ / "out");
  bool said = false;
  for (const std::string& words : result.decisions) said = said || words.starts_with("mastic: the specimen of");
  EXPECT_TRUE(said);
  const double expected = std::abs(modulus(own(), 2));
  EXPECT_NEAR(result.harmonic().frequencies[0].stiffness.e_star_pa, expected, 0.02 * expected);
  std::ifstream summary(folder_ / "out/summary.json");
  const std::string text{std::istreambuf_iterator<char>(summary), {}};
  EXPECT_NE(text.find("largest_difference"), std::string::npos);
}

TEST_F(MasticFrom, AnElasticSpecimenGivesAnElasticLaw) {
  other("mortar.toml", specimen + density + "law = \"elastic\"\nE = 2e9\npoisson_ratio = 0.3\n" + series + cyclic);
  Scene scene = read(from_mortar + cyclic);
  compute_mastic_law(scene);
  // the tolerance of the solution without steps
  EXPECT_NEAR(std::get<laws::Elastic>(scene.laws[0].value()).E, 2e9, 1e-6 * 2e9);
}

TEST_F(MasticFrom, FilesOfFitsAndRelaxationsAreLaws) {
  other("law.toml",
        "[[contacts]]\npair = \"M-M\"\nlaw = \"generalised_kelvin\"\nE_m = 6e9\nE = [2e8]\nC = [5e9]\n"
        "alpha = 0.1\nvalid_frequencies = [0.1, 25]\nvalid_temperatures = [0, 20]\n");
  Scene scene = read(specimen + density + "from = \"law.toml\"\npoisson_ratio = 0.3\n" + series + cyclic);
  EXPECT_FALSE(scene.mastic_source);
  EXPECT_EQ(mm(scene).E_m, 6e9);
  EXPECT_EQ(mm(scene).alpha, 1);
  EXPECT_EQ(scene.ranges[0], (laws::LawRange{0.1, 25, 0, 20}));

  other("kelvin.csv",
        "# Valid from 0.01 to 100 s, where …\nunit,time_s,compliance_1_pa,E_pa,C_pa_s\n"
        "maxwell,,1e-10,1e10,inf\nkelvin_1,2,1e-9,1e9,2e9\n");
  scene = read(specimen + density + "from = \"kelvin.csv\"\npoisson_ratio = 0.3\n" + series + cyclic);
  EXPECT_EQ(mm(scene).E_m, 1e10);
  EXPECT_TRUE(std::isinf(mm(scene).C_m));
  EXPECT_EQ(mm(scene).E, std::vector<double>{1e9});
  EXPECT_DOUBLE_EQ(scene.ranges[0].lowest_hz, 1 / (2 * std::numbers::pi * 100));
  EXPECT_EQ(law_range_warnings(scene).size(), 1u);  // 20 Hz is above 1/(2·pi·0.01 s) = 15.9 Hz
}

TEST_F(MasticFrom, WrongSourcesAreRefused) {
  refused(from_mortar + cyclic, {"scene.toml:", "[materials.mastic] from", "no file", "mortar.toml"});
  other("mortar.toml", from_mortar + cyclic);
  refused(from_mortar + cyclic, {"scene.toml:", "mortar.toml -> "});
  other("mortar.toml", specimen + density + "from = \"scene.toml\"\n" + series + cyclic);
  refused(from_mortar + cyclic, {"scene.toml -> ", "mortar.toml -> ", "lead back"});
  other("mortar.toml", specimen + density + "lw = 3\n" + series + cyclic);
  refused(from_mortar + cyclic, {"scene.toml:", "mortar.toml:", "lw"});
  mortar();
  refused(specimen + density + "from = \"mortar.toml\"\nlaw = \"elastic\"\nE = 1e9\n" + series + cyclic,
          {"from", "together with law"});
  refused(specimen + density + "from = \"mortar.toml\"\n" + cyclic, {"from", "rule = \"centres\""});
  other("two.toml",
        "[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = 1e9\n[[contacts]]\npair = \"M-A\"\nlaw = "
        "\"elastic\"\nE = 1e9\n");
  refused(specimen + density + "from = \"two.toml\"\n" + series + cyclic, {"two.toml with 2 laws"});
}

TEST_F(MasticFrom, RunsOutsideOfTheRangeWarnOncePerLaw) {
  const std::string ranged =
      specimen + density + chain + "valid_frequencies = [0.1, 25]\nvalid_temperatures = [0, 15]\n";
  EXPECT_EQ(law_range_warnings(read(ranged + series + cyclic)), std::vector<std::string>{});
  const auto warnings = law_range_warnings(read("[materials]\ntemperature = 20\n" + ranged + series + cyclic));
  // M-M and M-W share one law. At 20 degrees C a_T is 10^(-14*10/130) = 0.0838, so 2 Hz is 0.1676 Hz: within the range
  ASSERT_EQ(warnings.size(), 1u);
  for (const char* part : {"M-M, M-W", "from 0 to 15 degrees C", "at 20 degrees C"})
    EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
  const auto times =
      law_range_warnings(read(ranged + series + "[loading]\nkind = \"relaxation\"\ntimes = [0.001, 1]\n"));
  ASSERT_EQ(times.size(), 1u);  // 1/(2·pi·0.001 s) = 159.2 Hz
  EXPECT_NE(times[0].find("from 0.1592 to 159.2 Hz"), std::string::npos) << times[0];
  refused(specimen + density + chain + "valid_frequencies = [1]\n" + series + cyclic,
          {"valid_frequencies", "two numbers"});
}

}  // namespace
}  // namespace macadam::test
