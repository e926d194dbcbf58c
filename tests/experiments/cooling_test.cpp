// SPDX-License-Identifier: GPL-3.0-or-later
// cooling_test.cpp  Tests kind "cooling", a specimen that cools between two platens: its stress without and with
// relaxation, its fracture, and messages about scenes that do not fit.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "host/simulation/refused_combinations.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

constexpr double stiffness = 1e9, per_kelvin = 2e-5;  // [Pa] [1/K]

struct Cooling : TestFolder {
  /// Returns the text of a scene of a column of two spheres, one per cube of 10 mm. Each contact has the law, and the
  /// contact of the two spheres has the keys `crack` too.
  std::string column(const std::string& loading, const std::string& law = "law = \"elastic\"\nE = 1e9\nalpha = 0.3\n",
                     const std::string& crack = "", const std::string& expansion = "expansion = 2e-5\n") const {
    write(folder_ / "column.csv",
          "id,x,y,z,radius,phase,body\n0,0.005,0.005,0.005,0.005,mastic,-1\n1,0.005,0.005,0.015,0.005,mastic,-1\n");
    return "[specimen]\nfile = \"column.csv\"\nbox = [0.01, 0.01, 0.02]\n[materials.mastic]\ndensity = 2000.0\n" +
           expansion + "[[contacts]]\npair = \"M-M\"\n" + law + crack + "[[contacts]]\npair = \"M-W\"\n" + law +
           "[loading]\nkind = \"cooling\"\n" + loading;
  }
  static std::string crack(const std::string& energy) {
    return "crack = { tensile_strength = \"0.2 MPa\", shear_strength = \"0.2 MPa\", fracture_energy = \"" + energy +
           "\" }\n";
  }
  Scene scene(const std::string& all) const {
    write(folder_ / "cooling.toml", all);
    return read_scene(folder_ / "cooling.toml");
  }
  std::string refusal(const std::string& all) const {
    return message_of([&] { scene(all); });
  }
  /// Runs a scene and returns its result. Its files are in the folder `name`.
  SteppedResponse result(const std::string& all, const std::string& name = "out") const {
    return std::get<SteppedResponse>(run(scene(all), out(name)).found);
  }
  nlohmann::json summary() const { return nlohmann::json::parse(read(out("out") / "summary.json"))["results"][0]; }
};

// A specimen of one coefficient of expansion has no stress if it is free. A held one has the stress of a tension test
// by the strain that the cooling would cause, also with irregular cells. Forces of both tests are out of balance by
// 1e-10, and stresses of soft contacts beside stiff ones by a hundred times more.
TEST_F(Cooling, HasTheStressOfATensionTest) {
  std::string laws;
  for (const auto& [pair, E, alpha] :
       {std::tuple{"M-M", 1e10, 0.2}, std::tuple{"M-A", 3e10, 0.1}, std::tuple{"A-A", 1e11, 0.05}})
    laws += fmt::format("[[contacts]]\npair = \"{}\"\nlaw = \"elastic\"\nE = {}\nalpha = {}\n", pair, E, alpha);
  for (const char* pair : {"M-W", "A-W"})  // smooth platens, along which the specimen contracts freely
    laws += fmt::format("[[contacts]]\npair = \"{}\"\nlaw = \"elastic\"\nE = 3e10\nalpha = 0.0\n", pair);
  const std::string specimen =
      "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n"
      "[materials]\nmastic = { density = 2110, expansion = 2e-5 }\naggregate = { density = 2630, expansion = 2e-5 }\n" +
      laws;
  const auto pulled = result(specimen +
                                 "[loading]\nkind = \"monotonic\"\nrate = 1e-4\nstrain = 1e-3\npoints = 2\n"
                                 "[solver]\nmethod = \"quasi_static\"\n",
                             "pulled");
  const double modulus = pulled.points.back().ratio;
  EXPECT_GT(modulus, 1e9);
  const auto cooled = result(specimen + "[loading]\nkind = \"cooling\"\nto = -20\npoints = 10\n");
  ASSERT_EQ(cooled.points.size(), 10u);
  for (const SteppedPoint& p : cooled.points) {
    const double fallen = 4 * p.time_s / 1440;  // 10 K/h: 4 K in 1440 s
    EXPECT_NEAR(p.temperature_c, 20 - fallen, 1e-3) << "times are whole numbers of a unit, a millionth of the test";
    EXPECT_NEAR(p.stress_pa, modulus * per_kelvin * (20 - p.temperature_c), 1e-8 * modulus * per_kelvin * 40);
    EXPECT_EQ(p.strain, 0);
  }
  ASSERT_TRUE(cooled.cooling);
  EXPECT_FALSE(cooled.cooling->broke);
  EXPECT_DOUBLE_EQ(cooled.cooling->largest_stress_pa, cooled.points.back().stress_pa);
  EXPECT_NEAR(cooled.cooling->temperature_c, -20, 1e-9);
  const nlohmann::json row = summary();
  EXPECT_EQ(row["broke"], false);
  EXPECT_TRUE(row["fracture_stress_pa"].is_null());
  EXPECT_TRUE(row["fracture_temperature_c"].is_null());
  EXPECT_EQ(row["largest_stress_pa"], cooled.cooling->largest_stress_pa);
  EXPECT_HAS(read(out("out") / "cooling.csv"), "time_s,strain,stress_pa,error,bottom_pa");
  EXPECT_HAS(read(out("out") / "cooling.csv"), ",temperature_c\n");
}

// stress(t) = ∫ E(ξ(t) − ξ(s))·α·rate ds with the relaxation modulus E of the law and the reduced time ξ, by the
// midpoint rule. The error of the rule is of the order of (3600 s/4000)²/(24·τ²) with relaxation times τ above 100 s,
// or 3e-6.
TEST_F(Cooling, IsTheConvolutionOfRelaxationAndThermalStrain) {
  const auto found =
      result(column("to = -10\nrate = \"30 K/h\"\npoints = 10\n[solver]\ntolerance = 1e-4\n",
                    "law = \"generalised_kelvin\"\nE_m = 1e9\nC_m = 1e12\nE = [4e8]\nC = [2e11]\nalpha = 0.0\nshift = "
                    "\"table\"\ntemperatures = [-10.0, 20.0]\nlog10_a_T = [4.0, 0.0]\n"));
  const PronySeries series = laws::GeneralisedKelvin{1e9, 1e12, {4e8}, {2e11}, 0}.prony();
  constexpr int intervals = 4000;
  constexpr double ds = 3600.0 / intervals, decades = 4 * 2.302585092994046 / 3600;
  const auto reduced = [](double t) { return (1 - std::exp(-decades * t)) / decades; };
  const double all = stiffness * per_kelvin * 30;
  ASSERT_EQ(found.points.size(), 10u);
  for (std::size_t row = 0; row < found.points.size(); ++row) {
    const double t = 3600.0 * static_cast<double>(row + 1) / 10;
    double stress = 0;
    for (int k = 0; (k + 0.5) * ds < t; ++k)
      stress += series.modulus(reduced(t) - reduced((k + 0.5) * ds)) * per_kelvin * 30 / 3600 * ds;
    EXPECT_NEAR(found.points[row].stress_pa, stress, 1e-3 * all) << t;  // ten errors of an increment
    // relaxation matters: a specimen without it would have this stress
    EXPECT_LT(stress, 0.95 * all * t / 3600) << t;
  }
}

// The stress grows by 20 kPa per kelvin, so it reaches the strength of 0.2 MPa at 10 °C. The facet then softens over
// 20 µm, five times the 4 µm by which the column shortens at this stress, so the stress falls by 20/(5 − 1) = 5 kPa per
// kelvin, and the column is in two pieces at −30 °C.
TEST_F(Cooling, FindsTheFractureOfAColumnThatSoftens) {
  const auto found =
      result(column("to = -60\npoints = 80\n", "law = \"elastic\"\nE = 1e9\nalpha = 0.3\n", crack("2 J/m2")));
  ASSERT_TRUE(found.cooling);
  EXPECT_TRUE(found.cooling->broke);
  // a row is at 10 °C; forces are out of balance by 1e-10
  EXPECT_NEAR(found.cooling->largest_stress_pa, 2e5, 1e-8 * 2e5);
  EXPECT_NEAR(found.cooling->temperature_c, 10, 1e-9);
  ASSERT_GE(found.points.size(), 50u);
  EXPECT_NEAR(found.points[29].stress_pa, 2e5 - 20 * 5e3, 1e-6 * 2e5) << "at -10 degrees C";
  ASSERT_TRUE(found.rupture);
  EXPECT_LE(found.points.size(), 51u) << "the test ends when the column is in two pieces";
  EXPECT_NEAR(found.points.back().stress_pa, 0, 1e-6 * 2e5);
}

// The run is interrupted after the largest stress, at about the 30th of 51 rows.
TEST_F(Cooling, ContinuesWithItsLargestStress) {
  const Scene asked =
      scene(column("to = -60\npoints = 80\n", "law = \"elastic\"\nE = 1e9\nalpha = 0.3\n", crack("2 J/m2")));
  run(asked, out("one"));
  int interrupted = 0;
  for (const int stop : {30, 0}) interrupted += run_until(asked, "out", stop, interrupted > 0);
  EXPECT_EQ(interrupted, 1);
  EXPECT_EQ(read(out("out") / "cooling.csv"), read(out("one") / "cooling.csv"));
  EXPECT_NEAR(summary()["fracture_stress_pa"].get<double>(), 2e5, 1e-8 * 2e5);
  EXPECT_NEAR(summary()["fracture_temperature_c"].get<double>(), 10, 1e-9);
}

// A test that ends soon after the largest stress has measured the strength, although the column is still one piece.
TEST_F(Cooling, FindsTheFractureIfTheStressHasFallen) {
  const std::string law = "law = \"elastic\"\nE = 1e9\nalpha = 0.3\n";
  const auto before = result(column("to = 12\npoints = 16\n", law, crack("2 J/m2")));
  EXPECT_FALSE(before.cooling.value().broke);
  const auto after = result(column("to = -12\npoints = 16\n", law, crack("2 J/m2")), "after");
  EXPECT_TRUE(after.cooling.value().broke);
  EXPECT_FALSE(after.rupture);
  EXPECT_NEAR(after.cooling->largest_stress_pa, 2e5, 1e-8 * 2e5);
}

// The facet softens over 2.5 µm, less than the 4 µm by which the column shortens. So no equilibrium exists beyond the
// strength, and the last increment is at most a hundredth of the longest one, which lasts 360 s, or 3 K.
TEST_F(Cooling, FindsASuddenBreak) {
  const auto found = result(column("to = -10\nrate = \"30 K/h\"\npoints = 10\n",
                                   "law = \"elastic\"\nE = 1e9\nalpha = 1.0\n", crack("0.25 J/m2")));
  ASSERT_TRUE(found.increments && found.increments->sudden_break);
  ASSERT_TRUE(found.cooling && found.cooling->broke);
  EXPECT_NEAR(found.cooling->temperature_c, 10, 0.1);
  EXPECT_NEAR(found.cooling->largest_stress_pa, 2e5, 2e3);
  const nlohmann::json row = summary();
  EXPECT_EQ(row["kind"], "cooling");
  EXPECT_EQ(row["broke"], true);
  EXPECT_EQ(row["fracture_stress_pa"], found.cooling->largest_stress_pa);
  EXPECT_EQ(row["fracture_temperature_c"], found.cooling->temperature_c);
  EXPECT_HAS(results_table(run(scene(column("to = -10\nrate = \"30 K/h\"\npoints = 10\n",
                                            "law = \"elastic\"\nE = 1e9\nalpha = 1.0\n", crack("0.25 J/m2"))),
                               out("again"))),
             "fracture temperature");
}

TEST_F(Cooling, BeginsAndEndsAsInTheStandard) {
  const auto spec = std::get<experiments::Cooling>(scene(column("")).experiment);
  EXPECT_EQ(spec.from, 20);
  EXPECT_EQ(spec.to, -30);
  EXPECT_DOUBLE_EQ(spec.times.back(), 5 * 3600);
  EXPECT_EQ(scene(column("")).solver.method, SolverMethod::quasi_static);
  const auto given = std::get<experiments::Cooling>(scene(column("rate = \"10 degC/h\"\n")).experiment);
  EXPECT_DOUBLE_EQ(given.rate, spec.rate);
}

TEST_F(Cooling, RefusesLoadingsThatDoNotFit) {
  EXPECT_HAS(refusal(column("to = 25\n")), "expected a temperature below from");
  EXPECT_HAS(refusal(column("from = -30\n")), "expected a temperature below from");
  for (const char* rate : {"0", "-0.001", "10", "\"-10 K/h\"", "\"1 K\""})
    EXPECT_HAS(refusal(column(fmt::format("rate = {}\n", rate))), "K/s");
  EXPECT_HAS(refusal(column("from = 293.15\nto = 250\n")), "degrees C");
  EXPECT_HAS(refusal(column("points = 1\n")), "from 10 to 100000");
  EXPECT_HAS(refusal(column("temperature = [[0, 20], [10, 0]]\n")), "an unknown key");
}

TEST_F(Cooling, RefusesMaterialsThatDoNotFit) {
  const std::string relaxing = "law = \"generalised_kelvin\"\nE_m = 1e9\nC_m = 1e12\nE = []\nC = []\nalpha = 0.0\n";
  const std::string elastic = "law = \"elastic\"\nE = 1e9\n";
  EXPECT_HAS(refusal(column("", elastic, "", "")), "materials that do not expand");
  EXPECT_HAS(refusal(column("", elastic, "", "expansion = 0\n")), "materials that do not expand");
  EXPECT_HAS(refusal(column("", relaxing)), "a law of M-M that relaxes and has no shift");
  const std::string table = "shift = \"table\"\ntemperatures = [-10.0, 20.0]\nlog10_a_T = [4.0, 0.0]\n";
  EXPECT_NO_THROW(scene(column("to = -10\n", relaxing + table)));
  EXPECT_HAS(refusal(column("to = -11\n", relaxing + table)), "[loading] to: found -11 degrees C");
  EXPECT_HAS(refusal(column("from = 21\nto = -10\n", relaxing + table)), "[loading] from: found 21 degrees C");
  EXPECT_HAS(refusal("[materials]\ntemperature = 10\n" + column("to = -10\n", relaxing + table)),
             "no temperature in [materials]");
  EXPECT_HAS(refusal(column("[network]\nlateral_walls = true\n")), "the sides of the specimen are free");
}

TEST_F(Cooling, RefusesOtherMethods) {
  EXPECT_HAS(refusal(column("[solver]\nmethod = \"harmonic\"\n")), "\"cooling\" with method \"harmonic\"");
  EXPECT_HAS(refusal(column("[solver]\nmethod = \"explicit\"\n")), "too many time steps");
  EXPECT_HAS(refusal(column("[solver]\ndensity_scaling = 100\n")), "without keys for time steps");
  Scene changed = scene(column(""));
  changed.solver.method = SolverMethod::explicit_;
  EXPECT_HAS(message_of([&] { require_combination(changed); }), "\"cooling\" with method \"explicit\"");
  changed.solver.method = SolverMethod::quasi_static;
  EXPECT_NO_THROW(require_combination(changed));
  // spheres of at least 1.5 mm, and waves of √(1e9 Pa/2000 kg/m³) = 707 m/s: 18000 s are 8.5e9 times 2.1 µs
  const std::string generated =
      "[specimen]\nbox = [0.01, 0.01, 0.01]\n[specimen.mastic]\nradius = [0.00075, 0.001]\nporosity = 0.05\n"
      "[materials.mastic]\ndensity = 2000.0\nexpansion = 2e-5\n[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = "
      "1e9\n"
      "[[contacts]]\npair = \"M-W\"\nlaw = \"elastic\"\nE = 1e9\n[loading]\nkind = \"cooling\"\n";
  EXPECT_HAS(refusal(generated + "[solver]\nmethod = \"explicit\"\n"), "about 8e+09 time steps");
}

}  // namespace
}  // namespace macadam::test
