// SPDX-License-Identifier: GPL-3.0-or-later
// series_calibration_test.cpp  Calibration of scenes with the rule "series", whose free parameters are those of mastic
// and rock: known parameters are recovered from the moduli that they give.
#include <cmath>
#include <numbers>

#include "host/tools/calibration/parameters.hpp"
#include "host/tools/calibration/prepared_specimens.hpp"
#include "macadam/calibration.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"
#include "tests/scene/scene_file.hpp"

namespace macadam::test {
namespace {

struct SeriesCalibration : SceneFile {
  /// Returns the scene of the small specimen t8 (175 particles) with given moduli of mastic and rock [Pa].
  Scene scene(const std::string& mastic = "6e9", const std::string& rock = "6e10", const std::string& more = "") const {
    return read("[specimen]\nfile = \"" MACADAM_TEST_DATA "/t8.csv\"\nbox = [0.008, 0.008, 0.011]\n" +
                ("[materials.aggregate]\ndensity = 2630\nlaw = \"elastic\"\nE = " + rock) +
                "\n[materials.mastic]\ndensity = 2110\nlaw = \"generalised_kelvin\"\nE_m = " + mastic +
                "\nC_m = 1.3e9\nE = [2e8, 9e8]\nC = [5e9, 3e9]\npoisson_ratio = 0.35\n" + more +
                "[network]\nrule = \"series\"\n[loading]\nkind = \"cyclic\"\nfrequencies = [2, 20]\n"
                "[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n");
  }
  /// Returns the moduli that the specimen of a scene has, as if they had been measured.
  static ModulusData measured(const Scene& scene) {
    const Preparation prepared = prepare(scene);
    Harmonic harmonic(prepared.specimen, prepared.network, scene.laws, make_inertia(prepared.specimen, 2630, 2110), {},
                      6);
    ModulusData out;
    out.source = "lab.csv";
    for (const double f : {0.05, 0.5, 5.0, 50.0}) {
      const Stiffness found = harmonic.solve(f).top;
      out.points.push_back({f, found.e_star_pa, found.phase_deg, 0, 0, 0});
    }
    return out;
  }
  static CalibrationOptions freeing(const std::vector<std::string>& names) {
    CalibrationOptions out;
    for (const std::string& name : names) out.free.push_back({name, {}, {}, {}, 0});
    return out;
  }
};

TEST_F(SeriesCalibration, ParametersAreThoseOfThePhases) {
  std::vector<std::string> names;
  for (const calibration::Parameter& p : calibration::parameters_of(scene())) names.push_back(p.name);
  EXPECT_EQ(names, (std::vector<std::string>{"mastic.E_m", "mastic.C_m", "mastic.E_1", "mastic.E_2", "mastic.C_1",
                                             "mastic.C_2", "aggregate.E"}));
  try {
    calibrate(scene(), measured(scene()), freeing({"M-A.E_m"}));
    FAIL() << "accepted a parameter of a pair";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mastic.E_m"), std::string::npos) << error.what();
  }
}

// Exact data determine the parameters to the accuracy of the solutions: 1e-9 of E* and 1e-7 of its derivatives. The
// tolerance is that of calibrations with the rule "centres".
TEST_F(SeriesCalibration, KnownModuliAreRecovered) {
  const Scene truth = scene("8e9", "9e10"), start = scene();
  const Calibration c = calibrate(start, measured(truth), freeing({"mastic.E_m", "mastic.E_2", "aggregate.E"}));
  EXPECT_NEAR(c.parameters[0].value / 8e9, 1, 1e-6);
  EXPECT_NEAR(c.parameters[1].value / 9e8, 1, 1e-6);
  EXPECT_NEAR(c.parameters[2].value / 9e10, 1, 1e-6);
  EXPECT_LT(c.errors.e_star_largest, 1e-7);
  EXPECT_LT(c.solutions, 12);
  // the text of the scene with the new values gives these values
  const Scene written = read(calibrated_scene(start, c, folder_));
  require_calibrated(written, c);
  EXPECT_NEAR(written.materials.rock_modulus.value() / 9e10, 1, 1e-6);
}

// A temperature shifts the viscosities of the mastic, and the values are those at the reference temperature.
TEST_F(SeriesCalibration, ViscositiesAreThoseAtTheReferenceTemperature) {
  const std::string shift = "shift = \"arrhenius\"\nactivation_energy = 2e5\nreference_temperature = 20\n";
  const std::string warm = "[materials]\ntemperature = 30\n";
  Scene truth = scene("6e9", "6e10", shift + warm);
  EXPECT_LT(std::get<laws::GeneralisedKelvin>(*truth.laws[0]).C_m, 1e9) << "shifted";
  const ModulusData data = measured(truth);
  calibration::multiply(truth.laws, calibration::parameters_of(truth)[1], 3);  // the start has three times the C_m
  const Calibration c = calibrate(truth, data, freeing({"mastic.C_m"}));
  EXPECT_NEAR(c.parameters[0].start / 3.9e9, 1, 1e-12);
  EXPECT_NEAR(c.parameters[0].value / 1.3e9, 1, 1e-6);
}

// The rock is in series with the mastic of all pairs: its derivative has parts of these pairs and of the rock's own.
TEST_F(SeriesCalibration, DerivativesOfEstimatesAreDifferences) {
  const Scene start = scene();
  const ModulusData data = measured(start);
  const Watcher watcher;
  calibration::Specimens specimens(start, data, 1, watcher);
  std::vector<calibration::Parameter> free;
  for (const calibration::Parameter& p : calibration::parameters_of(start))
    if (p.name == "mastic.E_m" || p.name == "aggregate.E") free.push_back(p);
  ASSERT_EQ(free.size(), 2u);
  const auto solved = specimens.solve(start.laws, free);
  const auto estimated = specimens.estimate(start.laws, free);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    // the last solution corrects the estimates, so only rounding remains
    EXPECT_LT(std::abs(estimated[i].modulus / solved[i].modulus - 1.0), 1e-12);
    for (std::size_t k = 0; k < free.size(); ++k) {
      const double step = 1e-4;
      const auto at = [&](double factor) {
        LawTable laws = start.laws;
        calibration::multiply(laws, free[k], factor);
        return specimens.estimate(laws, free)[i].modulus;
      };
      const auto difference = (at(1 + step) - at(1 - step)) / (2 * step);
      // the classes change the derivatives by some 1e-5 of E*, the difference is accurate to 1e-8
      EXPECT_LT(std::abs(estimated[i].by[k] - difference), 1e-7 * std::abs(solved[i].modulus)) << free[k].name;
      EXPECT_LT(std::abs(solved[i].by[k] - difference), 1e-4 * std::abs(solved[i].modulus)) << free[k].name;
    }
  }
}

}  // namespace
}  // namespace macadam::test
