// SPDX-License-Identifier: GPL-3.0-or-later
// volumetric_scene_test.cpp  Tests scenes with rule "volumetric": keys, laws of pairs, refused combinations with their
// reasons, and the result of a run.
#include <cmath>
#include <fstream>

#include "host/scene/new_scene.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"
#include "tests/scene/scene_file.hpp"

namespace macadam::test {
namespace {

const std::string aggregate =
    "[materials.aggregate]\ndensity = 2630\nlaw = \"elastic\"\nE = \"60 GPa\"\npoisson_ratio = 0.28\n";
const std::string mastic =
    "[materials.mastic]\ndensity = 2110\nlaw = \"elastic\"\nE = \"4 GPa\"\npoisson_ratio = 0.35\n";
const std::string specimen =
    "[specimen]\nbox = [0.008, 0.008, 0.011]\nseed = 3\n[specimen.mastic]\nradius = [0.00075, 0.001]\nporosity = "
    "0.05\n";
const std::string rock = "[[specimen.aggregate]]\nsieve = [0.003, 0.004]\nvolume_fraction = 0.2\n";
const std::string rule = "[network]\nrule = \"volumetric\"\n";
const std::string cyclic = "[loading]\nkind = \"cyclic\"\nfrequencies = [2, 20]\n";
const std::string harmonic = "[solver]\nmethod = \"harmonic\"\n";
const std::string good = specimen + rock + aggregate + mastic + rule + cyclic;

struct VolumetricSceneFile : SceneFile {
  /// Returns the message with which a scene is refused before any work; empty if it is accepted.
  std::string refusal(const std::string& text) const {
    try {
      require_combination(read(text));
    } catch (const InputError& error) { return error.what(); }
    return {};
  }
  void refused(const std::string& text, const std::vector<std::string>& parts) const {
    const std::string what = refusal(text);
    for (const std::string& part : parts) EXPECT_NE(what.find(part), std::string::npos) << "message: " << what;
  }
};

TEST_F(VolumetricSceneFile, KeysAndLaws) {
  const Scene scene = read(good + harmonic);
  EXPECT_EQ(scene.network.rule, ContactRule::volumetric);
  EXPECT_EQ(scene.materials.aggregate_poisson_ratio, 0.28);
  EXPECT_EQ(scene.solver.backend, Backend::cpu) << "only the CPU computes this rule";
  EXPECT_EQ(std::get<laws::Elastic>(*scene.laws[static_cast<std::size_t>(PairType::ma)]).E, 4e9);
  EXPECT_EQ(refusal(good + harmonic), "");
  std::string without = aggregate;
  without.erase(without.find("poisson_ratio"));
  refused(specimen + rock + without + mastic + rule + cyclic + harmonic,
          {"[materials.aggregate] poisson_ratio", "nothing", "\"volumetric\""});
}

TEST_F(VolumetricSceneFile, PathsWithoutTheRuleAreRefused) {
  const std::string expected = "rule \"series\"";
  refused(good + "[solver]\nmethod = \"explicit\"\n",
          {"\"volumetric\" with method \"explicit\"", "\"harmonic\"", expected});
  const std::string body = specimen + rock + aggregate + mastic + rule;
  for (const std::string loading :
       {"kind = \"relaxation\"\ntimes = [0.1, 1]\n", "kind = \"creep\"\ntimes = [0.1, 1]\nstress = 1e5\n"}) {
    EXPECT_EQ(refusal(body + "[loading]\n" + loading + harmonic), "");
    refused(body + "[loading]\n" + loading + "[solver]\nmethod = \"quasi_static\"\n",
            {"\"volumetric\" with method \"quasi_static\"", "\"harmonic\"", expected});
  }
  refused(good + harmonic + "backend = \"cuda\"\n", {"backend", "\"volumetric\"", "\"cpu\""});
  EXPECT_EQ(refusal(good + harmonic + "[output]\nsensitivities = true\n"), "");
  refused(good + harmonic + "[[contacts]]\npair = \"M-A\"\nlaw = \"elastic\"\nE = 1e9\n",
          {"[[contacts]] law", "volumetric"});
}

TEST_F(VolumetricSceneFile, NewScenesAreRead) {
  for (const char* test : {"cyclic", "sweep", "relaxation", "creep", "monotonic", "history"}) {
    const std::string text = scene::new_scene(scene::NewKind::spheres, test, ContactRule::volumetric);
    EXPECT_EQ(refusal(text), "") << test;
    EXPECT_EQ(read(text).network.rule, ContactRule::volumetric);
  }
}

// A specimen of mastic has the constants of the mastic. The solver's usual tolerance gives nine digits of E and five of
// the Poisson's ratio.
TEST_F(VolumetricSceneFile, RunOfMastic) {
  const Scene scene = read(specimen + mastic + rule + cyclic + harmonic);
  const RunResult result = run(scene, folder_ / "out");
  const auto& found = result.harmonic().frequencies.front();
  EXPECT_NEAR(found.stiffness.e_star_pa, 4e9, 4);
  ASSERT_TRUE(found.poisson_ratio);
  EXPECT_NEAR(found.poisson_ratio->real(), 0.35, 1e-5);
}

// A specimen of mastic relaxes as the chain of the mastic, here a spring in series with a dashpot: E·exp(−t·E/C). The
// relaxation of one material needs no fit, so that the error is that of E* of the solutions.
TEST_F(VolumetricSceneFile, RelaxationOfMastic) {
  const std::string chain =
      "[materials.mastic]\ndensity = 2110\nlaw = \"generalised_kelvin\"\nE_m = \"4 GPa\"\nC_m = 2e9\nE = []\nC = []\n"
      "poisson_ratio = 0.35\n";
  const std::string loading = "[loading]\nkind = \"relaxation\"\ntimes = [0.1, 1]\npoints_per_decade = 2\n";
  const Scene scene = read(specimen + chain + rule + loading + harmonic);
  EXPECT_EQ(refusal(specimen + chain + rule + loading + harmonic), "");
  const RunResult result = run(scene, folder_ / "out");
  const auto& found = std::get<experiments::SpectrumResponse>(result.found);
  ASSERT_FALSE(found.points.empty());
  for (const auto& p : found.points) EXPECT_NEAR(p.ratio / (4e9 * std::exp(-2 * p.time_s)), 1, 1e-7) << p.time_s;
}

}  // namespace
}  // namespace macadam::test
