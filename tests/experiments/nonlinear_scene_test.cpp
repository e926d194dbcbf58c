// SPDX-License-Identifier: GPL-3.0-or-later
// nonlinear_scene_test.cpp  Tests scenes with a law that is not linear: they can be stepped, and every use of the
// frequency domain refuses them with the name of the law.
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

/// Returns the laws of AM1 with brittle bonds in place of the mastic's law.
std::string bonds(const std::string& strength) {
  std::string text = am1_contacts;
  const auto begin = text.find("law = \"generalised_kelvin\""), end = text.find("alpha = 0.10");
  return text.replace(begin, end - begin,
                      "law = \"brittle_bond\"\nE = \"11.15 GPa\"\ntensile_strength = \"" + strength + "\"\n");
}

class NonlinearScene : public Program {
 protected:
  void scene(const std::string& loading, const std::string& solver = "", const std::string& strength = "1 MPa",
             const std::string& more = "") const {
    write(folder_ / "scene.toml", "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[loading]\n" + loading +
                                      "[solver]\nbackend = \"cpu\"\n" + solver + more + bonds(strength));
  }
  std::string refusal() const {
    const Outcome outcome = run_quick("out");
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "out" / "summary.json"));
    return outcome.err;
  }
};

constexpr const char* cyclic = "kind = \"cyclic\"\nfrequencies = [20.0]\ncycles = 1\n";

TEST_F(NonlinearScene, TheFrequencyDomainNamesPairLawAndWayOut) {
  const auto expect_refused = [&](const std::string& text) {
    EXPECT_HAS(text, "M-M");
    EXPECT_HAS(text, "brittle_bond, which has no complex stiffness because it is not linear");
    EXPECT_HAS(text, "method = \"explicit\"");
  };
  for (const char* linear : {"auto", "iterative", "direct"}) {
    scene(cyclic, fmt::format("method = \"harmonic\"\nlinear = \"{}\"\n", linear));
    expect_refused(refusal());
  }
  for (const char* loading : {"kind = \"sweep\"\nfrequencies = [1, 10]\n", "kind = \"relaxation\"\ntimes = [0.1, 1]\n",
                              "kind = \"creep\"\nstress = 1e5\ntimes = [0.1, 1]\n",
                              "kind = \"monotonic\"\nrate = 1e-3\ntimes = [0.1, 1]\n"}) {
    scene(loading);
    expect_refused(refusal());
  }
  write(folder_ / "lab.csv", "frequency_hz,e_star_pa,phase_deg\n20,1.4e10,6\n");
  for (const char* method : {"harmonic", "explicit"}) {
    scene(cyclic, fmt::format("method = \"{}\"\n", method));
    const Outcome outcome = macadam(fmt::format("calibrate {} --target {} --out {} --no-pictures --free M-A.delta",
                                                path("scene.toml"), path("lab.csv"), path("found")));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    expect_refused(outcome.err);
  }
}

TEST_F(NonlinearScene, WhatRestsOnLinearityIsRefused) {
  scene(cyclic, "tolerance = 1e-3\n");
  EXPECT_HAS(refusal(), "tolerance in [solver]: found 0.001 with law brittle_bond of M-M, expected no tolerance");
  scene(cyclic, "form = \"condensed\"\n");
  EXPECT_HAS(refusal(), "form in [solver]: found \"condensed\" with law brittle_bond of M-M, expected \"points\"");
  scene(cyclic, "", "1 MPa", "[network]\nquadrature = \"exact\"\n");
  EXPECT_HAS(refusal(), "quadrature in [network]: found \"exact\" with law brittle_bond of M-M, expected \"lumped\"");
}

// With a law that is not linear the run uses the contact form `points` and starts from rest, even if the scene does not
// ask for this. A warning explains the meaning of |E*|. Bonds that do not break give the same result as an elastic law.
TEST_F(NonlinearScene, IsSteppedAndSaysWhatTheResultIs) {
  const auto solved = [&](const std::string& strength, const std::string& out, const std::string& loading) {
    scene(cyclic + loading, quick, strength);
    const Outcome outcome = run_quick(out);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return summary(out);
  };
  const auto e_star = [](const nlohmann::json& s) { return s.at("results").at(0).at("e_star_pa").get<double>(); };
  const auto strong = solved("1 GPa", "strong", "start = \"steady\"\n"), weak = solved("0.2 MPa", "weak", "");
  for (const auto& one : {strong, weak}) {
    EXPECT_HAS(one.at("warnings").dump(), "law brittle_bond of M-M has no complex stiffness");
    EXPECT_HAS(one.at("solver").at("description").dump(), "points");
    EXPECT_EQ(one.at("results").at(0).at("start"), "rest");
  }
  EXPECT_LT(e_star(weak), 0.9 * e_star(strong));
  EXPECT_EQ(strong.at("warnings").size(), 1u) << strong.at("warnings");
  ASSERT_EQ(weak.at("warnings").size(), 2u) << weak.at("warnings");
  EXPECT_HAS(weak.at("warnings").at(1).get<std::string>(), "contact points that can break are broken: M-M ");
  std::string text = read(folder_ / "scene.toml");
  const auto begin = text.find("law = \"brittle_bond\""), end = text.find("alpha = 0.10");
  text.replace(begin, end - begin, "law = \"elastic\"\nE = \"11.15 GPa\"\n");
  write(folder_ / "scene.toml", text);
  const Outcome elastic = run_quick("elastic", "--backend cpu");
  ASSERT_EQ(elastic.code, 0) << elastic.err;
  // the elastic scene uses condensed contacts with rotating frames; the difference is of the order of the strain
  // squared
  EXPECT_NEAR(e_star(strong) / e_star(summary("elastic")), 1, 1e-6);
}

TEST_F(NonlinearScene, KeysOfTheBond) {
  const auto message = [&](const std::string& from, const std::string& to) {
    scene(cyclic);
    std::string text = read(folder_ / "scene.toml");
    text.replace(text.find(from), from.size(), to);
    write(folder_ / "scene.toml", text);
    return message_of([&] { read_scene(folder_ / "scene.toml"); });
  };
  const std::string key = "tensile_strength = \"1 MPa\"\n";
  EXPECT_HAS(message(key, ""), "tensile_strength: found nothing");
  EXPECT_HAS(message(key, "tensile_strength = 0\n"), "tensile_strength: found 0");
  EXPECT_HAS(message(key, "tensile_strength = \"1 m\"\n"), "tensile_strength: found \"1 m\"");
  EXPECT_HAS(message(key, key + "shear_strength = -1\n"), "shear_strength: found -1");
  EXPECT_HAS(message(key, key + "shift = \"wlf\"\n"), "shift");
  EXPECT_EQ(message(key, key + "delta = 2\nshear_strength = \"2 MPa\"\n"), "nothing was thrown");
  const Scene scene = read_scene(folder_ / "scene.toml");
  const auto& law = std::get<laws::BrittleBond>(*scene.laws[static_cast<std::size_t>(PairType::mm)]);
  EXPECT_EQ(law.E, 2 * 11.15e9);
  EXPECT_EQ(law.tensile_strength, 1e6) << "delta is a factor on moduli, not on strengths";
  EXPECT_EQ(law.shear_strength, 2e6);
}

}  // namespace
}  // namespace macadam::test
