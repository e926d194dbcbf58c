// SPDX-License-Identifier: GPL-3.0-or-later
// temperature_test.cpp  Tests that the temperature in a scene shifts the laws on the time axis. If all laws shift
// equally, the response of the specimen shifts by the same factor.
#include <cmath>

#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using nlohmann::json;

constexpr const char* wlf = "shift = \"wlf\"\nC1 = 14.0\nC2 = 120.0\nreference_temperature = 10.0\n";
double wlf_log_a(double t) { return -14.0 * (t - 10) / (120 + t - 10); }

class Temperature : public Program {
 protected:
  /// Writes a scene of the 175 particles of t8 at 1 and 10 Hz; `shift` is inserted in both viscoelastic laws.
  fs::path scene(const std::string& shift, const std::string& materials, const std::string& loading,
                 const std::string& frequencies = "1, 10", const std::string& method = "harmonic") const {
    std::string contacts = am1_contacts;
    for (std::size_t at = 0; (at = contacts.find("alpha = 0.10\n", at)) != std::string::npos; at += shift.size() + 1)
      contacts.insert(at, shift);
    const fs::path file = folder_ / "scene.toml";
    write(file, "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[materials]\n" + materials + contacts +
                    "[loading]\nkind = \"cyclic\"\nfrequencies = [" + frequencies + "]\n" + loading +
                    "[solver]\nmethod = \"" + method + "\"\n" +
                    (method == "explicit" ? "density_scaling = 1e5\n" : "[output]\nsensitivities = true\n"));
    return file;
  }

  json results(const std::string& out) const {
    const Outcome outcome = run_quick(out);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return summary(out)["results"];
  }
};

TEST_F(Temperature, MultipliesTheViscositiesOfALaw) {
  const auto law = [&](const std::string& materials) {
    const Scene read = read_scene(scene(wlf, materials, ""));
    return std::get<laws::GeneralisedKelvin>(*read.laws[static_cast<std::size_t>(PairType::ma)]);
  };
  const laws::GeneralisedKelvin cold = law("temperature = 0.0\n"), reference = law("temperature = \"10 degC\"\n");
  EXPECT_EQ(reference.C_m, 7.921e9);
  EXPECT_EQ(law("").C_m, 7.921e9) << "without a temperature laws are at their own";
  const double a = std::pow(10.0, wlf_log_a(0));
  EXPECT_GT(a, 10);
  EXPECT_NEAR(cold.C_m / 7.921e9, a, 1e-12 * a);
  EXPECT_NEAR(cold.C[2] / 3.510e9, a, 1e-12 * a);
  EXPECT_EQ(cold.E_m, reference.E_m);
  EXPECT_EQ(cold.E, reference.E);
}

TEST_F(Temperature, IsothermsOfASpecimenLieOnOneCurve) {
  scene(wlf, "", "temperatures = [0, 10, 25]\n");
  const json isotherms = results("isotherms");
  ASSERT_EQ(isotherms.size(), 6u);
  for (std::size_t i = 0; i < isotherms.size(); ++i) {
    const double t = std::vector<double>{0, 10, 25}[i / 2], f = i % 2 == 0 ? 1 : 10;
    EXPECT_EQ(isotherms[i]["temperature_c"], t);
    EXPECT_EQ(isotherms[i]["frequency_hz"], f);
    EXPECT_NEAR(isotherms[i]["log10_a_T"].get<double>(), wlf_log_a(t), 1e-12);
    const double reduced = isotherms[i]["reduced_frequency_hz"];
    EXPECT_NEAR(reduced, f * std::pow(10.0, wlf_log_a(t)), 1e-9 * reduced);
    scene("", "", "", fmt::format("{}", reduced));
    const json master = results("master")[0];
    // Both moduli come from solutions with residuals of at most 1e-11; the error of the modulus is smaller.
    EXPECT_NEAR(isotherms[i]["e_star_pa"].get<double>(), master["e_star_pa"], 1e-9 * master["e_star_pa"].get<double>());
    EXPECT_NEAR(isotherms[i]["phase_deg"].get<double>(), master["phase_deg"], 1e-7);
    EXPECT_FALSE(master.contains("temperature_c"));
  }
  EXPECT_GT(isotherms[0]["e_star_pa"], 1.3 * isotherms[4]["e_star_pa"].get<double>());
}

TEST_F(Temperature, IsTheSameOfTheSceneAndOfTheLoading) {
  scene(wlf, "", "temperatures = [25]\n");
  json loading = results("loading");
  scene(wlf, "temperature = 25\n", "");
  json materials = results("materials");
  for (json* r : {&loading, &materials})
    for (json& one : *r) one.erase("solve_s");
  ASSERT_FALSE(loading[0]["sensitivities"].empty());
  // The viscosities differ only by the rounding of the shift factor a_T.
  const auto near = [](const json& a, const json& b, double scale) {
    EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-8 * scale);
  };
  const double modulus = loading[0]["e_star_pa"];
  near(loading[0]["e_star_pa"], materials[0]["e_star_pa"], modulus);
  for (std::size_t i = 0; i < loading[0]["sensitivities"].size(); ++i)
    near(loading[0]["sensitivities"][i]["d_e_star_pa"], materials[0]["sensitivities"][i]["d_e_star_pa"], modulus);
}

TEST_F(Temperature, AppliesToAStepInTime) {
  scene(wlf, "temperature = 25\n", "cycles = 1\nstart = \"steady\"\n", "20", "explicit");
  const json stepped = results("stepped")[0];
  EXPECT_EQ(stepped["temperature_c"], 25);
  scene(wlf, "temperature = 25\n", "", "20");
  const json solved = results("solved")[0];
  // A density scaling of 1e5 changes |E*| by 1.2 % at 20 Hz (1e6 by 12 %); ten degrees less change it much more.
  EXPECT_NEAR(stepped["e_star_pa"].get<double>() / solved["e_star_pa"].get<double>(), 1, 0.02);
  scene(wlf, "temperature = 10\n", "", "20");
  EXPECT_GT(results("cold")[0]["e_star_pa"].get<double>() / solved["e_star_pa"].get<double>(), 1.2);
}

TEST_F(Temperature, DifferentShiftsHaveNoCommonCurve) {
  scene(wlf, "", "temperatures = [20]\n");
  std::string text = read(folder_ / "scene.toml");
  text.replace(text.find("C1 = 14.0"), 9, "C1 = 13.0");  // changes the first law only
  write(folder_ / "scene.toml", text);
  EXPECT_FALSE(results("two")[0].contains("reduced_frequency_hz"));
}

TEST_F(Temperature, WhatMeansNothingIsRefused) {
  const auto said = [&](const std::string& shift, const std::string& materials, const std::string& loading) {
    const fs::path file = scene(shift, materials, loading);
    return message_of([&] { read_scene(file); });
  };
  EXPECT_HAS(said("", "temperature = 20\n", ""), "temperature: found 20 degrees C, which changes no law");
  EXPECT_HAS(said("", "", "temperatures = [20]\n"), "which changes no law");
  EXPECT_HAS(said(wlf, "temperature = 20\n", "temperatures = [20]\n"), "one of the two");
  EXPECT_HAS(said(wlf, "temperature = -110\n", ""), "where the shift of M-M has no value");
  EXPECT_HAS(said(wlf, "temperature = -109.9\n", ""), "where the shift of M-M has no value");  // a_T overflows
  EXPECT_HAS(said(wlf, "temperature = -110\n", ""), "expected a temperature above -110 (reference_temperature - C2)");
  EXPECT_HAS(said(wlf, "temperature = -300\n", ""), "a temperature above -273.15");
  EXPECT_HAS(said(wlf, "temperature = 293.15\n", ""), "not in kelvins");
  EXPECT_HAS(said(wlf, "temperature = nan\n", ""), "temperature");
  EXPECT_HAS(said(wlf, "", "temperatures = []\n"), "found none, expected at least one");
  EXPECT_HAS(said(wlf, "", "temperatures = [20, 20.0]\n"), "20 degrees C twice");
  const std::string table = "shift = \"table\"\ntemperatures = [0, 10, 20]\nlog10_a_T = [1.5, 0, -1]\n";
  EXPECT_EQ(said(table, "temperature = 15\n", ""), "nothing was thrown");
  EXPECT_HAS(said(table, "temperature = 21\n", ""),
             "where the shift of M-M has no value, expected a temperature from 0 to 20, the range of the");
  EXPECT_HAS(said("shift = \"table\"\ntemperatures = [0, 0]\nlog10_a_T = [1, 0]\n", "", ""), "ascending temperatures");
  EXPECT_HAS(said("shift = \"table\"\ntemperatures = [0, 1]\nlog10_a_T = [1]\n", "", ""), "1 numbers for 2");
  EXPECT_HAS(said("shift = \"wlf\"\nC1 = 14\nreference_temperature = 1\n", "", ""), "C2: found nothing");
  EXPECT_HAS(said("C1 = 14\n", "", ""), "expected the key shift as well");
  EXPECT_HAS(said(std::string(wlf) + "activation_energy = 1e5\n", "", ""),
             "only the keys of shift = \"wlf\": C1, C2, reference_temperature");
  EXPECT_HAS(said("shift = \"WLF\"\n", "", ""), "one of \"wlf\"");

  scene(wlf, "", "temperatures = [20]\n", "20", "explicit");
  const Outcome stepped = run_quick("stepped");
  EXPECT_EQ(stepped.code, 2);
  EXPECT_HAS(stepped.err, "temperatures in [loading]: found 1 temperature(s) with method \"explicit\"");
}

}  // namespace
}  // namespace macadam::test
