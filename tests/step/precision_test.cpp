// SPDX-License-Identifier: GPL-3.0-or-later
// precision_test.cpp  Tests that the estimated rounding error is above every measured error, and that the program
// reports when a run lies outside the range of the measurements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "host/run/error_model.hpp"
#include "host/experiments/cyclic/plan.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

/// Returns a table of bench/results/.
std::vector<Row> committed(const std::string& name) {
  std::ifstream in(MACADAM_EXAMPLES "/../bench/results/" + name);
  EXPECT_TRUE(in) << name;
  std::vector<std::string> head;
  std::vector<Row> out;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#")) continue;
    const auto values = cells(line);
    if (head.empty()) {
      head = values;
      continue;
    }
    Row& row = out.emplace_back();
    for (std::size_t i = 0; i < std::min(head.size(), values.size()); ++i) row[head[i]] = values[i];
  }
  return out;
}

double number(const Row& row, const std::string& key) { return std::stod(row.at(key)); }

/// A comparison of a result with double precision. `off` is the larger of the relative difference of |E*| and the
/// difference of φ [rad].
struct Comparison {
  std::string precision, scene;
  RoundingScale scale;
  double off;
};

/// Returns the comparisons of the precision study.
std::vector<Comparison> study() {
  std::vector<Comparison> out;
  for (const Row& r : committed("precision.csv")) {
    const auto steps = static_cast<std::int64_t>(number(r, "steps"));
    out.push_back({r.at("precision"),
                   r.at("scene"),
                   {steps, number(r, "layers"), number(r, "contrast"), number(r, "inertia")},
                   std::max(std::abs(number(r, "e_star")), std::abs(number(r, "phase_rad")))});
  }
  return out;
}

/// Returns the comparisons of two studies in accuracy.csv: `drift`, and `tolerance` (runs with a given tolerance). A
/// run of the drift study is compared with the run in double precision that has the same settings. If there is no such
/// run, and in the study `tolerance`, the run is compared with the harmonic solution of the same specimen with the same
/// inertia. The error estimate of each run needs the number of particle layers, which is taken from the precision
/// study, and the inertia term, which is set to 0; this makes the estimate smaller and so the test stricter.
std::vector<Comparison> drift() {
  std::map<std::string, double> layers;
  for (const Comparison& c : study()) layers[c.scene] = c.scale.layers;
  layers["seed 102"] = layers.at("seed 101");  // has the same box and sizes
  const auto key = [](const Row& r) {
    std::string out;
    for (const char* k : {"scene", "mix", "frequency_hz", "density_scaling", "cycles", "geometry"})
      out += r.at(k) + ",";
    return out;
  };
  std::map<std::string, Row> exact;
  const auto rows = committed("accuracy.csv");
  for (const Row& r : rows) {
    if (r.at("study") == "drift" && r.at("precision") == "double") exact[key(r)] = r;
  }
  std::vector<Comparison> out;
  for (const Row& r : rows) {
    const bool drifts = r.at("study") == "drift";
    if ((!drifts && r.at("study") != "tolerance") || r.at("precision") == "double") continue;
    double e_star = number(r, "own_error_e_star"), phase = number(r, "own_error_phase_deg");
    if (const auto at = exact.find(key(r)); drifts && at != exact.end()) {
      e_star = number(r, "e_star_pa") / number(at->second, "e_star_pa") - 1;
      phase = number(r, "phase_deg") - number(at->second, "phase_deg");
    }
    out.push_back({r.at("precision"),
                   r.at("scene"),
                   {static_cast<std::int64_t>(number(r, "steps")), layers.at(r.at("scene")), 1, 0},
                   std::max(std::abs(e_star), std::abs(phase) * std::numbers::pi / 180)});
  }
  return out;
}

std::vector<Comparison> all() {
  std::vector<Comparison> out = study();
  for (const Comparison& c : drift()) out.push_back(c);
  // Adds the run of the full specimen at true mass on a GPU, with about 40 layers of particles. It is compared with the
  // harmonic solution.
  for (const Row& r : committed("whole-tests-h200-2026-11-21.csv")) {
    if (r.at("scene") != "true mass") continue;
    out.push_back({r.at("precision"),
                   "full",
                   {static_cast<std::int64_t>(number(r, "steps")), 40, 1, 0},
                   std::max(std::abs(number(r, "error_e_star")), std::abs(number(r, "error_phase_rad")))});
  }
  return out;
}

TEST(Rounding, IsEstimatedAboveEveryMeasurement) {
  std::map<std::string, int> found;
  for (const Comparison& c : all()) {
    ++found[c.precision];
    const double estimate = c.precision == "single" ? single_precision_error(c.scale) : mixed_precision_error(c.scale);
    EXPECT_LT(c.off, estimate) << c.precision << ", " << c.scene << ", " << c.scale.steps << " steps";
  }
  EXPECT_GT(found["single"], 50);
  EXPECT_GT(found["mixed"], 50);
  EXPECT_EQ(found.size(), 2u);
}

// The program prints the ranges in which rounding was measured. They must be the ranges in the files, rounded.
TEST(Rounding, TheMeasuredRangeIsThatOfTheFiles) {
  for (const auto& [precision, told] : {std::pair{"single", single_measured}, {"mixed", mixed_measured}}) {
    SCOPED_TRACE(precision);
    double largest = 0;
    RoundingScale up_to;
    for (const Comparison& c : all()) {
      if (c.precision != precision) continue;
      largest = std::max(largest, c.off);
      up_to.steps = std::max(up_to.steps, c.scale.steps);
      up_to.layers = std::max(up_to.layers, c.scale.layers);
      up_to.contrast = std::max(up_to.contrast, c.scale.contrast);
      up_to.inertia = std::max(up_to.inertia, c.scale.inertia);
    }
    EXPECT_GE(told.largest, largest);
    EXPECT_LE(told.largest, 1.1 * largest);
    EXPECT_LE(told.up_to.steps, up_to.steps);
    EXPECT_LE(told.up_to.layers, up_to.layers);
    EXPECT_LE(told.up_to.contrast, up_to.contrast);
    EXPECT_LE(told.up_to.inertia, up_to.inertia);
  }
}

TEST(Rounding, WhatLiesBeyondTheMeasurementsIsNamed) {
  const RoundingScale within = single_measured.up_to;
  EXPECT_EQ(beyond(within, single_measured), "");
  RoundingScale scale = within;
  scale.steps *= 2;
  EXPECT_NE(beyond(scale, single_measured).find("steps"), std::string::npos);
  scale = within, scale.layers *= 2;
  EXPECT_NE(beyond(scale, single_measured).find("layers"), std::string::npos);
  scale = within, scale.contrast *= 2;
  EXPECT_NE(beyond(scale, single_measured).find("stiffnesses"), std::string::npos);
  scale = within, scale.inertia *= 2;
  EXPECT_NE(beyond(scale, single_measured).find("inertia"), std::string::npos);
  scale = within, scale.contrast = NAN;  // unknown contrast
  EXPECT_NE(beyond(scale, single_measured), "");
}

class PlannedPrecision : public testing::Test {
 protected:
  /// Returns the scene of the specimen t8 at 20 Hz with this tolerance.
  static Scene asked(double tolerance) {
    Scene scene;
    scene.specimen.file = MACADAM_TEST_DATA "/t8.csv";
    scene.specimen.box.size = {0.008, 0.008, 0.011};
    scene.materials = {2630, 2110};
    scene.laws = am1_laws();
    scene.cyclic().frequencies = {20};
    scene.solver.tolerance = tolerance;
    scene.solver.backend = Backend::cpu;
    return scene;
  }
  static Plan plan(const Scene& scene) {
    const Preparation prepared = prepare(scene);
    PhaseSeconds phases;
    return make_plan(scene, prepared,
                     make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic), {},
                     Backend::cpu, phases);
  }
  static std::string said(const Plan& plan) {
    std::string out;
    for (const auto& d : plan.decisions) out += d + "\n";
    return out;
  }
};

TEST_F(PlannedPrecision, IsSingleWhereThatWasMeasured) {
  const Plan made = plan(asked(1e-3));
  EXPECT_EQ(made.precision, Precision::single);
  EXPECT_NE(said(made).find("the estimated error from rounding is "), std::string::npos) << said(made);
  EXPECT_NE(said(made).find("not bounds"), std::string::npos) << said(made);
  EXPECT_EQ(said(made).find("was never measured"), std::string::npos) << said(made);
}

// The walls are far stiffer than in any measurement, so neither single nor mixed precision is chosen at any
// tolerance, and the program reports this.
TEST_F(PlannedPrecision, IsDoubleBeyondTheMeasuredStiffnesses) {
  Scene scene = asked(0.1);
  for (const PairType pair : {PairType::aw, PairType::mw}) {
    std::get<laws::Elastic>(*scene.laws[static_cast<std::size_t>(pair)]).E *= 1e8;
  }
  scene.solver.density_scaling = std::vector<double>{1e8};
  const Plan made = plan(scene);
  EXPECT_EQ(made.precision, Precision::double_);
  EXPECT_NE(said(made).find("single precision is not used, because its error was never measured for stiffnesses"),
            std::string::npos)
      << said(made);
  EXPECT_NE(said(made).find("mixed precision is not used, because its error was never measured for stiffnesses"),
            std::string::npos);
}

// The run has more steps than were measured in single precision, and fewer than were measured in mixed precision.
TEST_F(PlannedPrecision, IsMixedBeyondTheStepsOfSingle) {
  Scene scene = asked(0.1);
  scene.cyclic().frequencies = {1};
  scene.solver.density_scaling = std::vector<double>{1};
  const Plan made = plan(scene);
  const auto steps = made.frequencies.at(0).loading.steps_per_period;
  ASSERT_GT(steps, single_measured.up_to.steps);
  ASSERT_LT(steps, mixed_measured.up_to.steps);
  EXPECT_EQ(made.precision, Precision::mixed);
  EXPECT_NE(said(made).find("single precision is not used, because its error was never measured for "),
            std::string::npos)
      << said(made);
}

TEST_F(PlannedPrecision, TheContrastIsThatOfTheFrequency) {
  Scene scene = asked(1e-3);
  for (auto& law : scene.laws) law = laws::Elastic{1e10, 0};
  const double omega = 2 * std::numbers::pi * 20;  // a spring and a dashpot that are equally stiff at this frequency
  scene.laws[static_cast<std::size_t>(PairType::mm)] = laws::GeneralisedKelvin{1e10, 1e10 / omega, {}, {}, 0};
  EXPECT_NEAR(rounding_scale(scene, prepare(scene), 20, 1000, 1).contrast, std::numbers::sqrt2, 1e-12);
}

}  // namespace
}  // namespace macadam::test
