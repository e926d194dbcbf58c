// SPDX-License-Identifier: GPL-3.0-or-later
// series_scene_test.cpp  Tests scenes with rule "series": the keys, the laws of the pairs that follow from the laws of
// the phases, the refused scenes, and the modulus of a specimen that is all mastic.
#include <cmath>
#include <numbers>

#include "host/scene/new_scene.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/laws/values.hpp"
#include "macadam/simulation.hpp"
#include "tests/scene/scene_file.hpp"

namespace macadam::test {
namespace {

const std::string specimen =
    "[specimen]\nbox = [0.02, 0.02, 0.03]\n[[specimen.aggregate]]\nsieve = [0.00475, 0.0095]\nvolume_fraction = 0.25\n"
    "[specimen.mastic]\nradius = [0.00075, 0.001]\nporosity = 0.05\n";
const std::string aggregate =
    "[materials.aggregate]\ndensity = 2630\nlaw = \"elastic\"\nE = \"60 GPa\"\npoisson_ratio = 0.28\n";
const std::string mastic =
    "[materials.mastic]\ndensity = 2110\nlaw = \"generalised_kelvin\"\nE_m = 6e9\nC_m = 1.3e9\nE = [2e8]\nC = [5e9]\n"
    "poisson_ratio = 0.35\n";
const std::string shift = "shift = \"wlf\"\nC1 = 14\nC2 = 120\nreference_temperature = 10\n";
const std::string series = "[network]\nrule = \"series\"\n";
const std::string cyclic = "[loading]\nkind = \"cyclic\"\nfrequencies = [2, 20]\n";
const std::string good = specimen + aggregate + mastic + series + cyclic;

const Law& law_of(const Scene& scene, PairType pair) { return scene.laws[static_cast<std::size_t>(pair)].value(); }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

struct SeriesScene : SceneFile {
  /// Expects a message that contains all of these parts.
  void refused(const std::string& text, const std::vector<std::string>& parts) const {
    const std::string what = message(text);
    for (const std::string& part : parts) EXPECT_NE(what.find(part), std::string::npos) << "message: " << what;
  }
};

TEST_F(SeriesScene, PairsFollowFromThePhases) {
  const Scene scene = read(good);
  EXPECT_EQ(scene.network.rule, ContactRule::series);
  EXPECT_EQ(scene.materials.rock_modulus, 60e9);
  EXPECT_EQ(scene.materials.aggregate_poisson_ratio, 0.28);
  EXPECT_EQ(scene.materials.mastic_poisson_ratio, 0.35);
  EXPECT_EQ(scene.deltas, all_one);
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::mw, PairType::aa}) {
    const auto& law = std::get<laws::GeneralisedKelvin>(law_of(scene, pair));
    EXPECT_EQ(law.E_m, 6e9);
    EXPECT_EQ(law.C_m, 1.3e9);
    EXPECT_EQ(law.E, std::vector<double>{2e8});
    EXPECT_EQ(law.C, std::vector<double>{5e9});
    // μ over λ + 2μ for a Poisson's ratio of 0.35 is 0.3/1.3
    EXPECT_DOUBLE_EQ(law.alpha, pair == PairType::aa ? 0.3 / 1.3 : pair == PairType::mw ? 0.0 : 1.0) << to_string(pair);
  }
  for (const PairType pair : {PairType::inner, PairType::aw}) {
    const auto& law = std::get<laws::Elastic>(law_of(scene, pair));
    EXPECT_EQ(law.E, 60e9);
    EXPECT_EQ(law.alpha, pair == PairType::aw ? 0 : 1);
  }
}

TEST_F(SeriesScene, CellsOfVoidsHaveTheVolumesOfTheVoids) {
  const std::string voids = "[specimen.voids]\nradius = [0.0005, 0.001]\nfraction = 0.04\n";
  const auto scene_with = [&](const std::string& key) {
    return read(specimen + voids + aggregate + mastic + series + key + cyclic);
  };
  const Scene equal = scene_with(""), plain = scene_with("void_cells = \"spheres\"\n");
  EXPECT_EQ(equal.network.cells_of_voids(), VoidCells::volume);
  EXPECT_EQ(plain.network.cells_of_voids(), VoidCells::spheres);
  EXPECT_EQ(NetworkSpec{}.cells_of_voids(), VoidCells::spheres);  // rule "centres"
  const RockReport rock = prepare(equal).rock.value();
  EXPECT_NEAR(rock.void_cells / rock.void_nominal, 1, 1e-3);  // the tolerance of tessellate_with_void_volumes()
  const RockReport larger = prepare(plain).rock.value();
  EXPECT_EQ(larger.void_nominal, rock.void_nominal);
  EXPECT_GT(larger.void_cells, 1.05 * larger.void_nominal);
  refused(specimen + voids + aggregate + mastic + series + "void_cells = \"radius\"\n" + cyclic,
          {"void_cells", "\"radius\"", "\"volume\""});
}

TEST_F(SeriesScene, MasticMayBeElasticAndRockMayBeAbsent) {
  const Scene scene = read(
      "[specimen]\nbox = [0.01, 0.01, 0.01]\n[specimen.mastic]\nradius = [5e-4, 1e-3]\nporosity = "
      "0.1\n[materials.mastic]\ndensity = 2000\nlaw = \"elastic\"\nE = 1e9\npoisson_ratio = 0.4\n" +
      series + cyclic);
  EXPECT_EQ(std::get<laws::Elastic>(law_of(scene, PairType::mm)).E, 1e9);
  EXPECT_EQ(std::get<laws::Elastic>(law_of(scene, PairType::mw)).alpha, 0);
  EXPECT_FALSE(scene.laws[static_cast<std::size_t>(PairType::ma)]);
  EXPECT_FALSE(scene.laws[static_cast<std::size_t>(PairType::inner)]);
}

TEST_F(SeriesScene, ShiftsOfTheMasticApplyToAllItsPairs) {
  const Scene scene = read(specimen + "[materials]\ntemperature = 0\n" + aggregate + mastic + shift + series + cyclic);
  const double a = std::pow(10.0, -14.0 * (0 - 10) / (120 + 0 - 10));
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::aa, PairType::mw})
    EXPECT_NEAR(std::get<laws::GeneralisedKelvin>(law_of(scene, pair)).C_m, 1.3e9 * a, 1e-3 * a) << to_string(pair);
  EXPECT_TRUE(common_log10_shift(scene, 20).has_value());
  refused(specimen + "[materials]\ntemperature = 0\n" + aggregate + mastic + series + cyclic, {"[materials.mastic]"});
}

TEST_F(SeriesScene, PairsKeepLimitsOfFacets) {
  const Scene scene =
      read(good + "[[contacts]]\npair = \"M-A\"\ngap_max = 0.5\n[[contacts]]\npair = \"inner\"\narea_min = 0.01\n");
  EXPECT_EQ(scene.network.of_pair[static_cast<std::size_t>(PairType::ma)].gap_max, 0.5);
  EXPECT_EQ(scene.network.of_pair[static_cast<std::size_t>(PairType::inner)].area_min, 0.01);
  refused(good + "[[contacts]]\npair = \"M-A\"\nlaw = \"elastic\"\nE = 1e9\n",
          {"[[contacts]] law", "only pair, crack, gap_max"});
  refused(good + "[[contacts]]\npair = \"M-A\"\nalpha = 0.1\n", {"[[contacts]] alpha"});
  refused(good + "[[contacts]]\npair = \"M-A\"\ngap_mx = 0.1\n", {"an unknown key", "gap_max"});
  refused(good + "[[contacts]]\npair = \"M-W\"\ngap_max = 0.1\n", {"a pair with a wall"});
  refused(good + "[[contacts]]\npair = \"M-A\"\n[[contacts]]\npair = \"M-A\"\n", {"again"});
}

TEST_F(SeriesScene, WrongKeysAreRefused) {
  refused(replaced(good, "\"series\"", "\"serial\""),
          {"[network] rule", "\"serial\"", "\"centres\"", "\"volumetric\""});
  refused(replaced(good, "rule", "rul"), {"an unknown key", "rule"});
  refused(replaced(good, "poisson_ratio = 0.35", "poison_ratio = 0.35"), {"an unknown key", "poisson_ratio"});
  refused(replaced(good, "poisson_ratio = 0.35\n", ""), {"[materials.mastic] poisson_ratio", "nothing"});
  refused(replaced(good, "poisson_ratio = 0.35", "poisson_ratio = 0.5"), {"below 0.5"});
  refused(replaced(good, "E = \"60 GPa\"\n", ""), {"[materials.aggregate] E", "nothing"});
  refused(replaced(good, "law = \"elastic\"\n", ""), {"[materials.aggregate] E", "without law"});
  refused(replaced(good, "law = \"elastic\"", "law = \"generalised_kelvin\""),
          {"[materials.aggregate] law", "\"elastic\""});
  refused(replaced(good, "\"generalised_kelvin\"", "\"brittle_bond\""), {"[materials.mastic] law", "\"elastic\""});
  refused(replaced(good, "C = [5e9]\n", ""), {"[materials.mastic] C"});
  refused(replaced(good, "E_m = 6e9", "E_m = 6"), {"1000 Pa or more"});
}

TEST_F(SeriesScene, BothPhasesNeedALaw) {
  refused(specimen + "[materials.aggregate]\ndensity = 2630\n" + mastic + series + cyclic,
          {"no law of the aggregate", "[materials.aggregate] with law"});
  refused(specimen + aggregate + "[materials.mastic]\ndensity = 2110\n" + series + cyclic,
          {"no law of the mastic", "[materials.mastic] with law"});
}

TEST_F(SeriesScene, RuleCentresHasNoLawsOfPhases) {
  for (const std::string& rule : {std::string(), std::string("[network]\nrule = \"centres\"\n")}) {
    refused(specimen + aggregate + mastic + rule + cyclic,
            {"[materials.aggregate] law", "rule = \"centres\"", "each pair"});
    refused(specimen + "[materials.aggregate]\ndensity = 2630\n" + mastic + rule + cyclic, {"[materials.mastic] law"});
  }
}

TEST_F(SeriesScene, AllTestsAndSensitivitiesAreAvailable) {
  const std::string relaxation = "[loading]\nkind = \"relaxation\"\ntimes = [0.1, 1]\n",
                    creep = "[loading]\nkind = \"creep\"\ntimes = [0.1, 1]\nstress = 1e5\n";
  for (const std::string& loading : {relaxation, creep}) {
    const std::string text = specimen + aggregate + mastic + series + loading;
    EXPECT_EQ(message(text), "");
    EXPECT_EQ(message(text + "[solver]\nmethod = \"explicit\"\n"), "");
  }
  const std::string harmonic = "[solver]\nmethod = \"harmonic\"\n";
  EXPECT_EQ(message(good + harmonic), "");
  EXPECT_EQ(message(good + harmonic + "[output]\nsensitivities = true\n"), "");
}

TEST_F(SeriesScene, NewScenesAreRead) {
  for (const scene::NewKind kind : {scene::NewKind::recipe, scene::NewKind::spheres, scene::NewKind::shapes}) {
    for (const char* test : {"cyclic", "sweep", "relaxation", "creep", "monotonic"}) {
      const Scene scene = read(scene::new_scene(kind, test, ContactRule::series));
      EXPECT_EQ(scene.network.rule, ContactRule::series);
      EXPECT_EQ(scene.materials.rock_modulus, 60e9);
      EXPECT_TRUE(scene.laws[static_cast<std::size_t>(PairType::inner)]);
    }
  }
}

// With a ratio 1 of shear to normal stiffness, a uniform strain is in equilibrium cell by cell, so a specimen that is
// all mastic has exactly the modulus of the mastic.
TEST_F(SeriesScene, SpecimenOfMasticHasItsModulus) {
  const Scene scene = read(
      "[specimen]\nbox = [0.008, 0.008, 0.011]\nseed = 3\n[specimen.mastic]\nradius = [0.00075, "
      "0.001]\nporosity = 0.05\n" +
      mastic + series + cyclic);
  const Preparation prepared = prepare(scene);
  ASSERT_TRUE(prepared.rock);
  EXPECT_EQ(prepared.rock->rock_cells, 0);
  EXPECT_EQ(prepared.rock->rock_nominal, 0);
  EXPECT_EQ(prepared.rock->mastic_centres_in_rock, 0);
  for (const Contact& c : prepared.network.contacts) {
    EXPECT_EQ(c.length, c.distance);
    EXPECT_EQ(c.series, 0);
  }
  HarmonicOptions options;
  options.linear = LinearMethod::direct;
  options.tolerance = 1e-13;
  Harmonic harmonic(prepared.specimen, prepared.network, scene.laws, make_inertia(prepared.specimen, 2630, 2110),
                    options, 6);
  for (const double frequency : {2.0, 20.0}) {
    const std::complex<double> expected = std::get<laws::GeneralisedKelvin>(law_of(scene, PairType::mm))
                                              .stiffness(std::complex<double>(0, 2 * std::numbers::pi * frequency));
    const HarmonicResult found = harmonic.solve(frequency);
    EXPECT_NEAR(found.top.e_star_pa, std::abs(expected), 1e-12 * std::abs(expected));
    EXPECT_NEAR(found.top.phase_deg, std::arg(expected) * 180 / std::numbers::pi, 1e-10);
  }
}

// Single spheres: the lengths of M-A contacts follow from the radii; contacts.csv and summary.json show the rule.
TEST_F(SeriesScene, PreparedSpecimen) {
  const Scene scene = read(good + "[output]\ncontacts = true\n");
  const Preparation prepared = prepare_into(folder_ / "out", scene);
  std::size_t compared = 0;
  for (const Contact& c : prepared.network.contacts) {
    if (c.pair != PairType::ma) continue;
    const bool first = prepared.specimen.phase[static_cast<std::size_t>(c.a)] == Phase::aggregate;
    const double radius = prepared.specimen.radius[static_cast<std::size_t>(first ? c.a : c.b)];
    const double most = std::clamp(c.distance - radius, 0.05 * c.distance, 0.95 * c.distance);
    EXPECT_LE(c.length, most * (1 + 1e-12));  // less if another aggregate lies on the line
    compared += std::abs(c.length / most - 1) < 1e-12 ? 1u : 0u;
    EXPECT_NEAR(c.series * c.length * 60e9, c.distance - c.length, 1e-12 * c.distance);
  }
  EXPECT_GT(compared, 100u);
  ASSERT_TRUE(prepared.rock && prepared.rock->rock_nominal);
  EXPECT_NEAR(*prepared.rock->rock_nominal, 0.25 * 0.95, 0.02);
  std::ifstream contacts(folder_ / "out/contacts.csv");
  std::string header;
  std::getline(contacts, header);
  EXPECT_EQ(header, "a,b,pair,area,distance,nx,ny,nz,points,length,series");
  std::ifstream summary(folder_ / "out/summary.json");
  const std::string text{std::istreambuf_iterator<char>(summary), {}};
  for (const char* key : {"\"rule\"", "rock_fraction_cells", "rock_fraction_nominal", "mastic_centres_in_rock"})
    EXPECT_NE(text.find(key), std::string::npos) << key;
}

// A crack is in series with mastic and rock; only increments compute it.
TEST_F(SeriesScene, MayCrack) {
  const std::string strength = "[loading]\nkind = \"monotonic\"\nrate = 1\nstrain = 0.002\n";
  const std::string crack =
      "[[contacts]]\npair = \"M-A\"\ncrack = { tensile_strength = \"1 MPa\", fracture_energy = 300 }\n";
  const std::string text = replaced(good, cyclic, strength) + crack;
  const Scene scene = read(text);
  const auto& law = std::get<laws::Cracked<laws::GeneralisedKelvin>>(law_of(scene, PairType::ma));
  EXPECT_EQ(law.crack.fracture_energy, 300);
  EXPECT_EQ(law.E_m, 6e9);
  EXPECT_TRUE(std::holds_alternative<laws::GeneralisedKelvin>(law_of(scene, PairType::mm)));
  EXPECT_EQ(scene.solver.method, SolverMethod::quasi_static);
  refused(replaced(text, "rule = \"series\"", "rule = \"volumetric\""), {"crack", "volumetric", "pressures"});
  refused(replaced(text, "M-A", "M-W"), {"crack", "M-W", "wall"});
  // the rule of the network is checked against the method when a scene is run
  const Scene stepped = read(text + "[solver]\nmethod = \"explicit\"\n");
  try {
    require_combination(stepped);
    FAIL() << "nothing refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cracks in series with rock"), std::string::npos) << error.what();
  }
}

// The specimen t8 with rock in series cracks; its energies balance to the error of the solutions.
TEST_F(SeriesScene, Cracks) {
  const std::string crack = "crack = { tensile_strength = \"1 MPa\", fracture_energy = 100, friction = 0.5 }\n";
  const Scene scene = read(
      "[specimen]\nfile = \"" MACADAM_TEST_DATA "/t8.csv\"\nbox = [0.008, 0.008, 0.011]\n" + aggregate + mastic +
      series + "[loading]\nkind = \"monotonic\"\nrate = 1\nstrain = 5e-4\npoints = 5\n[[contacts]]\npair = \"M-M\"\n" +
      crack + "[[contacts]]\npair = \"M-A\"\n" + crack);
  const auto found = std::get<experiments::SteppedResponse>(macadam::run(scene, folder_ / "out").found);
  ASSERT_TRUE(found.increments && found.cracks);
  EXPECT_LT(found.increments->imbalance, 1e-8);
  ASSERT_TRUE(found.cracks->sums);
  EXPECT_GT(found.cracks->sums->cracked, 10);
}

}  // namespace
}  // namespace macadam::test
