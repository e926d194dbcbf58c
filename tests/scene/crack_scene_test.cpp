// SPDX-License-Identifier: GPL-3.0-or-later
// crack_scene_test.cpp  Tests how scenes give pairs of materials a crack: values, defaults, and messages about wrong
// values.
#include <gtest/gtest.h>

#include <string>

#include "host/simulation/forecast.hpp"
#include "macadam/macadam.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {
namespace {

/// Returns a scene whose pair has the lines `law` and the key `crack` with these values.
std::string with_crack(const std::string& values, const std::string& pair = "M-M",
                       const std::string& law = "law = \"elastic\"\nE = 1e10\nalpha = 0.1\n") {
  std::string out =
      "[specimen]\nbox = [0.01, 0.01, 0.01]\nmastic = { radius = [0.001, 0.001], porosity = 0.05 }\n"
      "[materials.mastic]\ndensity = 2000\n[[contacts]]\npair = \"" +
      pair + "\"\n" + law + "crack = { " + values + " }\n";
  for (const char* other : {"M-M", "M-W"})  // the pairs of the specimen
    if (pair != other) out += std::string("[[contacts]]\npair = \"") + other + "\"\nlaw = \"elastic\"\nE = 1e10\n";
  return out + "[loading]\nkind = \"cyclic\"\nfrequencies = [1.0]\n[solver]\nmethod = \"explicit\"\n";
}
Scene scene_of(const std::string& text) { return read_scene("scene.toml", text); }
const Law& law_of(const Scene& scene, PairType pair) { return scene.laws[static_cast<std::size_t>(pair)].value(); }
const laws::Crack& crack_of(const Scene& scene) {
  return std::get<laws::Cracked<laws::Elastic>>(law_of(scene, PairType::mm)).crack;
}
std::string refusal(const std::string& values) {
  return message_of([&] { scene_of(with_crack(values)); });
}

TEST(CrackScene, LeftOutValuesFollowFromTheOthers) {
  const Scene scene = scene_of(with_crack("tensile_strength = \"2 MPa\", fracture_energy = 200"));
  const laws::Crack& crack = crack_of(scene);
  EXPECT_EQ(crack.tensile_strength, 2e6);
  EXPECT_EQ(crack.shear_strength, 4e6);
  EXPECT_EQ(crack.fracture_energy, 200);
  EXPECT_EQ(crack.shear_fracture_energy, 200);
  EXPECT_EQ(crack.friction, 0);
  EXPECT_EQ(crack.residual_friction, 0);
  EXPECT_EQ(crack.softening, laws::Softening::linear);
  EXPECT_STREQ(facts_of(scene.laws)[static_cast<std::size_t>(PairType::mm)]->name, "elastic with crack");
}

TEST(CrackScene, EveryValueIsRead) {
  const laws::Crack crack = crack_of(scene_of(
      with_crack("tensile_strength = 1e6, fracture_energy = \"0.1 kJ/m2\", shear_strength = \"1.5 MPa\", "
                 "shear_fracture_energy = \"0.3 N/mm\", softening = \"bilinear\", kink = [0.7, 0.25], friction = 0.5, "
                 "residual_friction = 0.4")));
  EXPECT_EQ(crack.fracture_energy, 100);
  EXPECT_EQ(crack.shear_strength, 1.5e6);
  EXPECT_EQ(crack.shear_fracture_energy, 300);
  EXPECT_EQ(crack.softening, laws::Softening::bilinear);
  EXPECT_EQ(crack.kink_opening, 0.7);
  EXPECT_EQ(crack.kink_stress, 0.25);
  EXPECT_EQ(crack.friction, 0.5);
  EXPECT_EQ(crack.residual_friction, 0.4);
  EXPECT_EQ(crack_of(scene_of(with_crack("tensile_strength = 1e6, softening = \"brittle\""))).fracture_energy, 0);
  EXPECT_EQ(
      crack_of(scene_of(with_crack("tensile_strength = 1e6, fracture_energy = 9, friction = 0.3"))).residual_friction,
      0.3);
}

// A crack changes neither the chain nor its shift with temperature, and `delta` does not change the crack.
TEST(CrackScene, AKelvinChainKeepsItsValues) {
  const Scene scene = scene_of(with_crack("tensile_strength = 1e6, fracture_energy = 50", "M-A",
                                          "law = \"generalised_kelvin\"\nE_m = 1e10\nC_m = 1e9\nE = [1e9]\nC = "
                                          "[1e8]\nalpha = 0.1\ndelta = 2.0\n"));
  const auto& law = std::get<laws::Cracked<laws::GeneralisedKelvin>>(law_of(scene, PairType::ma));
  EXPECT_EQ(law.E_m, 2e10);
  EXPECT_EQ(law.E.at(0), 2e9);
  EXPECT_EQ(law.alpha, 0.1);
  EXPECT_EQ(law.crack.tensile_strength, 1e6);
  EXPECT_EQ(law.units(), 3);
}

TEST(CrackScene, WrongValuesAreRefused) {
  const std::string energy = ", fracture_energy = 50", strength = "tensile_strength = 1e6";
  EXPECT_HAS(refusal("fracture_energy = 50"), "tensile_strength");
  EXPECT_HAS(refusal("tensile_strength = 2" + energy), "1000 Pa or more; a strength in another unit is text");
  EXPECT_HAS(refusal("tensile_strength = 0" + energy), "found 0, expected 1000 Pa or more");
  EXPECT_HAS(refusal("tensile_strength = \"-2 MPa\"" + energy), "a positive number");
  EXPECT_HAS(refusal("tensile_strength = nan" + energy), "a finite number");
  EXPECT_HAS(refusal("tensile_strength = \"2 mm\"" + energy), "Pa, kPa, MPa, GPa");
  EXPECT_HAS(refusal(strength), "softening = \"brittle\", which needs no fracture energy");
  EXPECT_HAS(refusal(strength + ", fracture_energy = 0.2"), "1 J/m2 or more");
  EXPECT_HAS(refusal(strength + ", fracture_energy = \"0 J/m2\""), "a positive number");
  EXPECT_HAS(refusal(strength + ", fracture_energy = nan"), "a finite number");
  EXPECT_HAS(refusal(strength + ", fracture_energy = inf"), "a finite number");
  EXPECT_HAS(refusal(strength + ", fracture_energy = \"50 J\""), "J/m2");
  EXPECT_HAS(refusal(strength + energy + ", softening = \"brittle\""), "no fracture energy, or another softening");
  EXPECT_HAS(refusal(strength + energy + ", softening = \"cubic\""), "linear");
  EXPECT_HAS(refusal(strength + energy + ", friction = -0.1"), "from 0 to 5, not an angle");
  EXPECT_HAS(refusal(strength + energy + ", friction = 30"), "from 0 to 5, not an angle");
  EXPECT_HAS(refusal(strength + energy + ", friction = 0.3, residual_friction = 0.4"), "at most friction = 0.3");
  EXPECT_HAS(refusal(strength + energy + ", kink = [0.8, 0.3]"), "only with softening = \"bilinear\"");
  const std::string bilinear = strength + energy + ", softening = \"bilinear\", kink = ";
  EXPECT_HAS(refusal(bilinear + "[0.8]"), "two numbers");
  EXPECT_HAS(refusal(bilinear + "[0.8, 1.5]"), "from which the curve falls to 0");
  EXPECT_HAS(refusal(bilinear + "[1.9, 0.9]"), "from which the curve falls to 0");
  EXPECT_HAS(refusal(strength + energy + ", frictoin = 0.3"), "friction");
}

TEST(CrackScene, OnlyPairsOfParticlesWithTwoLawsCrack) {
  const std::string values = "tensile_strength = 1e6, fracture_energy = 50";
  const auto message = [&](const std::string& pair, const std::string& law) {
    return message_of([&] { scene_of(with_crack(values, pair, law)); });
  };
  const std::string elastic = "law = \"elastic\"\nE = 1e10\nalpha = 0.1\n";
  for (const char* pair : {"M-W", "A-W"})
    EXPECT_HAS(message(pair, elastic), "only for pairs of two particles, because contacts with a wall do not crack");
  for (const char* pair : {"M-A", "A-A", "inner"}) EXPECT_EQ(message(pair, elastic), "nothing was thrown");
  EXPECT_HAS(message("M-M", "law = \"brittle_bond\"\nE = 1e10\ntensile_strength = 1e6\n"), "crack");
}

TEST(CrackScene, ExampleOfTensionHasCracksBetweenParticles) {
  const Scene scene = read_scene(MACADAM_EXAMPLES "/tension/scene.toml");
  const FactsTable facts = facts_of(scene.laws);
  for (const PairType pair : {PairType::mm, PairType::ma, PairType::aa})
    EXPECT_TRUE(facts[static_cast<std::size_t>(pair)]->cracks) << to_string(pair);
  for (const PairType pair : {PairType::mw, PairType::aw})
    EXPECT_FALSE(facts[static_cast<std::size_t>(pair)]->cracks) << to_string(pair);
  EXPECT_STREQ(kind_of(scene.experiment), "monotonic");
  EXPECT_FALSE(scene.solver.damping_given) << "the balance of energies can be checked only without damping";
}

// Between two temperatures of a table the value is linear. A crack with tables needs a temperature within all of them.
TEST(CrackScene, TablesOverTemperatureAreEvaluatedAtTheSceneTemperature) {
  const std::string tables =
      "tensile_strength = { temperatures = [-20, 0, 20], values = [\"3 MPa\", \"2 MPa\", 5e5] }, "
      "fracture_energy = { temperatures = [-10, 20], values = [100, \"0.4 kJ/m2\"] }";
  const auto at = [&](const std::string& temperature, const std::string& values) {
    std::string text = with_crack(values);
    const std::string materials = "[materials.mastic]";
    if (!temperature.empty()) text.insert(text.find(materials), "[materials]\ntemperature = " + temperature + "\n");
    return text;
  };
  const laws::Crack crack = crack_of(scene_of(at("5", tables)));
  EXPECT_DOUBLE_EQ(crack.tensile_strength, 2e6 - 0.25 * 1.5e6);
  EXPECT_DOUBLE_EQ(crack.fracture_energy, 250);
  EXPECT_DOUBLE_EQ(crack.shear_strength, 2 * crack.tensile_strength);
  EXPECT_EQ(crack_of(scene_of(at("20", tables))).tensile_strength, 5e5);
  EXPECT_EQ(crack_of(scene_of(at("-10", tables))).fracture_energy, 100);

  const auto message = [&](const std::string& temperature, const std::string& values) {
    return message_of([&] { scene_of(at(temperature, values)); });
  };
  EXPECT_HAS(message("", tables), "temperature in [materials], at which the table is evaluated");
  EXPECT_HAS(message("-15", tables), "a temperature from -10 to 20, or a longer table");
  EXPECT_HAS(message("21", tables), "a temperature from -20 to 20, or a longer table");
  const std::string energy = ", fracture_energy = 50";
  EXPECT_HAS(message("5", "tensile_strength = { temperatures = [0, 10], values = [1e6] }" + energy),
             "1 numbers for 2 temperatures");
  EXPECT_HAS(message("5", "tensile_strength = { temperatures = [10, 0], values = [1e6, 2e6] }" + energy), "rising");
  EXPECT_HAS(message("5", "tensile_strength = { temperatures = [0, 10], values = [1e6, 2.0] }" + energy),
             "1000 Pa or more");
  EXPECT_HAS(message("5", "tensile_strength = { temperatures = [0, 10], values = [1e6, nan] }" + energy), "finite");
  EXPECT_HAS(message("5", "tensile_strength = { temperature = [0, 10], values = [1e6, 2e6] }" + energy),
             "temperatures");
  // a temperature that changes neither a law nor a strength is still an error
  EXPECT_HAS(message("5", "tensile_strength = 1e6" + energy), "which changes no law of the scene");
}

// The error names the pair, the contact that needs the most energy, this energy, and the reason.
TEST(CrackScene, TooLittleFractureEnergyIsRefused) {
  HandMade made = cubic_lattice_network(1, 1, 3, 2e-3, 1e-5);
  const auto message = [&](const std::string& values, const std::string& alpha) {
    const std::string law = "law = \"elastic\"\nE = 1e10\nalpha = " + alpha + "\n";
    Scene scene = scene_of(with_crack(values, "M-M", law));
    scene.laws[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{1e10, 0};
    return message_of([&] { require_fracture_energies(scene, made.network); });
  };
  // G_f > f_t²·d/(2E)·β_c·β_w/α = 0.4 J/m²·40
  const std::string sixteen = message("tensile_strength = \"2 MPa\", fracture_energy = 15.9", "0.1");
  EXPECT_HAS(sixteen, "fracture_energy in crack of pair M-M");
  EXPECT_HAS(sixteen, "found 15.9 J/m2, expected more than 16 J/m2, which contact ");
  EXPECT_HAS(sixteen, "shear decides: beta_c*beta_w/alpha = 2*2/0.1 = 40");
  EXPECT_EQ(message("tensile_strength = \"2 MPa\", fracture_energy = 16.1", "0.1"), "nothing was thrown");
  EXPECT_HAS(message("tensile_strength = \"2 MPa\", fracture_energy = \"0.39 J/m2\"", "5.0"), "tension decides");
  EXPECT_EQ(message("tensile_strength = \"2 MPa\", fracture_energy = \"0.41 J/m2\"", "5.0"), "nothing was thrown");
  EXPECT_HAS(message("tensile_strength = \"2 MPa\", fracture_energy = 31, softening = \"exponential\"", "0.1"),
             "more than 32 J/m2");
  EXPECT_EQ(message("tensile_strength = \"2 MPa\", softening = \"brittle\"", "0.1"), "nothing was thrown");
  made.network.contacts[1].length *= 2;
  EXPECT_HAS(message("tensile_strength = \"2 MPa\", fracture_energy = 31", "0.1"), "more than 32 J/m2");
  // Rock in series as soft as the law: half the modulus, and a shear ratio of α·(1 + 1)/(1 + α). The energy is
  // f_t²·d/E·β_c·β_w/0.6667 = 3.2 J/m²·4/0.6667 in the contact with twice the length
  made.network.contacts[1].series = 1e-10;
  EXPECT_HAS(message("tensile_strength = \"2 MPa\", fracture_energy = 9.5", "0.5"), "more than 9.6 J/m2");
  EXPECT_EQ(message("tensile_strength = \"2 MPa\", fracture_energy = 9.7", "0.5"), "nothing was thrown");
}

// A scene with cracks and without a method is followed by increments, which have no inertia; the key is not ignored.
TEST(CrackScene, IncrementsRefuseInertia) {
  const auto message = [](const std::string& solver) {
    std::string text = with_crack("tensile_strength = 1e6, fracture_energy = 100");
    text = text.substr(0, text.find("[loading]")) +
           "[loading]\nkind = \"monotonic\"\nrate = 1.0\nstrain = 1e-3\n[solver]\n" + solver;
    return message_of([&] { forecast(scene_of(text)); });
  };
  EXPECT_EQ(message("threads = 1\n"), "nothing was thrown");
  EXPECT_EQ(message("inertia = false\n"), "nothing was thrown");
  EXPECT_HAS(message("inertia = true\n"), "inertia with method \"quasi_static\": found true, expected false");
}

}  // namespace
}  // namespace macadam::test
