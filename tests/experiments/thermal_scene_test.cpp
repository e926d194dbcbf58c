// SPDX-License-Identifier: GPL-3.0-or-later
// thermal_scene_test.cpp  Tests scenes whose temperature changes during the test: results of restrained and free
// specimens, and messages about values that do not fit.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "host/simulation/refused_combinations.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

constexpr double modulus = 1e9, expansion = 2e-5;  // [Pa] [1/K]
const std::string cooling = "temperature = [[0, 20], [\"1 h\", \"-10 degC\"], [7200, -10]]\n";
const std::string restrained =
    "kind = \"history\"\ndrive = \"table\"\ntimes = [7200]\nstrains = [0]\nduration = 7200\nsamples = 8\n";
const std::string elastic = "law = \"elastic\"\nE = 1e9\n";
const std::string shifting =
    "law = \"generalised_kelvin\"\nE_m = 1e9\nC_m = 1e12\nE = []\nC = []\nalpha = 0.0\nshift = \"table\"\n"
    "temperatures = [-10.0, 20.0]\nlog10_a_T = [4.0, 0.0]\n";

class ThermalScene : public TestFolder {
 protected:
  /// Returns the text of a scene of a column of four spheres, one per cube of 10 mm.
  std::string text(const std::string& loading, const std::string& more = "", const std::string& law = elastic,
                   const std::string& materials = "expansion = 2e-5\n") const {
    std::string particles = "id,x,y,z,radius,phase,body\n";
    for (int i = 0; i < 4; ++i) particles += fmt::format("{},0.005,0.005,{},0.005,mastic,-1\n", i, 0.005 + 0.01 * i);
    write(folder_ / "column.csv", particles);
    return "[specimen]\nfile = \"column.csv\"\nbox = [0.01, 0.01, 0.04]\n[materials.mastic]\ndensity = 2000.0\n" +
           materials + "[[contacts]]\npair = \"M-M\"\n" + law + "[[contacts]]\npair = \"M-W\"\n" + law + "[loading]\n" +
           loading + more;
  }
  Scene scene(const std::string& all) const {
    write(folder_ / "cooling.toml", all);
    return read_scene(folder_ / "cooling.toml");
  }
  /// Returns the text of a scene of a column of two spheres that a crack can cross.
  std::string breaking(const std::string& loading) const {
    std::string all = text(loading);
    write(folder_ / "column.csv",
          "id,x,y,z,radius,phase,body\n0,0.005,0.005,0.005,0.005,mastic,-1\n1,0.005,0.005,0.015,0.005,mastic,-1\n");
    all.replace(all.find("0.04"), 4, "0.02");
    all.insert(all.find("[[contacts]]\npair = \"M-W\"\n"),
               "alpha = 1.0\ncrack = { tensile_strength = \"0.2 MPa\", shear_strength = \"0.2 MPa\", fracture_energy = "
               "\"0.25 J/m2\" }\n");
    return all;
  }
  std::string refusal(const std::string& all) const {
    return message_of([&] { scene(all); });
  }
  std::vector<SteppedPoint> points(const std::string& all) const {
    return std::get<SteppedResponse>(run(scene(all), out("out")).found).points;
  }
};

// The column has the modulus of its contacts. Forces are out of balance by 1e-10.
TEST_F(ThermalScene, ARestrainedColumnHasThermalStress) {
  const auto found = points(text(restrained + cooling));
  ASSERT_EQ(found.size(), 8u);
  for (const SteppedPoint& p : found) {
    const double temperature = std::max(-10.0, 20 - 30 * p.time_s / 3600);
    EXPECT_NEAR(p.temperature_c, temperature, 1e-9) << p.time_s;
    EXPECT_NEAR(p.stress_pa, -modulus * expansion * (temperature - 20), 1e-9 * modulus * expansion * 30) << p.time_s;
    EXPECT_EQ(p.strain, 0);
  }
  EXPECT_HAS(read(out("out") / "history.csv"), ",temperature_c\n");
  EXPECT_HAS(read(out("out") / "summary.json"), "\"temperature_c\"");
}

TEST_F(ThermalScene, AFreeColumnHasThermalStrain) {
  const auto found = points(text("kind = \"creep\"\nstress = 0\nramp = 1\ntimes = [1800, 3600, 7200]\n" + cooling));
  ASSERT_EQ(found.size(), 3u);
  const double strain = -30 * expansion;
  EXPECT_NEAR(found[0].strain, 0.5 * strain, 1e-9 * -strain);
  EXPECT_NEAR(found[1].strain, strain, 1e-9 * -strain);
  EXPECT_NEAR(found[2].strain, strain, 1e-9 * -strain);
  for (const SteppedPoint& p : found) EXPECT_NEAR(p.top_pa, 0, 1e-9 * modulus * -strain);
}

// A dashpot in series with a spring: stress' = -E·expansion·T' - stress/(tau·a_T) with tau = 1000 s. The strain rate in
// reduced time is not constant, so the expected stress is integrated in short steps.
TEST_F(ThermalScene, AShiftSlowsRelaxationDownDuringTheTest) {
  const auto found = points(text(restrained + cooling, "[solver]\ntolerance = 1e-4\n", shifting));
  constexpr int steps = 1'000'000;
  constexpr double dt = 7200.0 / steps, tau = 1000;
  double stress = 0, peak = 0;
  std::size_t row = 0;
  for (int k = 0; k < steps; ++k) {
    const double middle = (k + 0.5) * dt, rate = middle < 3600 ? modulus * expansion * 30 / 3600 : 0;
    const double a_T = std::pow(10.0, 4 * std::min(1.0, middle / 3600));
    const double decay = dt / (2 * tau * a_T);
    stress = ((1 - decay) * stress + dt * rate) / (1 + decay);
    peak = std::max(peak, stress);
    if ((k + 1) % (steps / 8) != 0) continue;
    EXPECT_NEAR(found.at(row).stress_pa, stress, 1e-3 * peak) << found.at(row).time_s;  // ten errors of an increment
    ++row;
  }
  EXPECT_EQ(row, found.size());
}

// One facet of 0.2 MPa softens over 2.5e-6 m, less than the 4e-6 m by which the column of 20 mm shortens at this
// stress. So no equilibrium exists beyond the strength, which is reached after 10 K of cooling.
TEST_F(ThermalScene, AHeldColumnBreaksSuddenly) {
  const RunResult result = run(scene(breaking(restrained + cooling)), out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.increments && found.increments->sudden_break);
  // the last increment is at most a hundredth of the longest one, which lasts 900 s, or 7.5 K
  EXPECT_NEAR(found.increments->temperature_at_break_c, 10, 0.1);
  EXPECT_NEAR(found.increments->sudden_break->stress_pa, 2e5, 2e3);
  EXPECT_EQ(found.points.size(), 1u);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_HAS(result.warnings.back(), "breaks suddenly");
  EXPECT_HAS(read(out("out") / "summary.json"), "\"sudden_break\"");
  EXPECT_HAS(read(out("out") / "history.csv"), "thermal_work_j");
}

/// A load that grows to 1.5 times the strength in 100 s breaks the column at the strength, which is reported as a
/// stress.
TEST_F(ThermalScene, ALoadedColumnBreaksSuddenly) {
  const RunResult result =
      run(scene(breaking("kind = \"creep\"\nstress = 3e5\nramp = 100\ntimes = [200]\n" + cooling)), out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.increments && found.increments->sudden_break);
  EXPECT_NEAR(found.increments->sudden_break->stress_pa, 2e5, 2e3);
  EXPECT_TRUE(found.points.empty()) << "it breaks before the first row";
  EXPECT_HAS(read(out("out") / "damage.csv"), "contact,");
}

TEST_F(ThermalScene, ChoosesIncrementsAndRefusesOtherMethods) {
  EXPECT_EQ(scene(text(restrained + cooling)).solver.method, SolverMethod::quasi_static);
  EXPECT_HAS(refusal(text(restrained + cooling, "[solver]\nmethod = \"harmonic\"\n")), "quasi_static");
  EXPECT_HAS(refusal(text(restrained + cooling, "[solver]\nmethod = \"explicit\"\n")), "quasi_static");
  const Scene on_device =
      scene(text(restrained + cooling, "[solver]\nbackend = \"cuda\"\nmethod = \"quasi_static\"\n"));
  EXPECT_HAS(message_of([&] { require_combination(on_device); }), "no GPU computes thermal expansion");
  const Scene automatic = scene(text(restrained + cooling, "[solver]\nbackend = \"auto\"\n"));
  EXPECT_EQ(requested_backend(automatic), Backend::cpu);
}

TEST_F(ThermalScene, RefusesTemperaturesThatDoNotFit) {
  const auto with = [&](const std::string& list) { return refusal(text(restrained + "temperature = " + list + "\n")); };
  EXPECT_HAS(with("[[1, 20], [2, 10]]"), "as the first time");
  EXPECT_HAS(with("[[0, 20], [2, 10], [2, 5]]"), "times that ascend");
  EXPECT_HAS(with("[[0, 20]]"), "at least two pairs");
  EXPECT_HAS(with("[[0, 20, 3], [2, 10]]"), "a pair [time, temperature]");
  EXPECT_HAS(with("[[0, 293.15], [2, 300]]"), "degrees C");
  EXPECT_HAS(refusal(text(restrained + cooling, "", elastic, "")), "changes nothing");
  EXPECT_HAS(refusal(text(restrained + "temperature = [[0, 20], [10, -20]]\n", "", shifting)), "no value");
  EXPECT_HAS(refusal("[materials]\ntemperature = 10\n" + text(restrained + cooling, "", shifting)),
             "only one of the two");
  EXPECT_HAS(refusal(text("kind = \"creep\"\nstress = 0\ntimes = [1, 2]\n")), "a stress that is not 0");
  EXPECT_HAS(refusal(text(restrained + cooling, "", elastic, "expansion = 20\n")), "1e-3");
}

}  // namespace
}  // namespace macadam::test
