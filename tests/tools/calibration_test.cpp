// SPDX-License-Identifier: GPL-3.0-or-later
// calibration_test.cpp  Calibration recovers known parameters from the moduli that they give, states their uncertainty,
// and refuses nonsensical targets.
#include "macadam/calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/aggregate_cube.hpp"
#include "host/tools/calibration/misfit.hpp"
#include "host/tools/calibration/prepared_specimens.hpp"
#include "host/tools/calibration/statistics.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Returns the scene of the small specimen t8 (175 particles) with the contact laws of binder AM1. Two of these laws
/// depend on temperature.
Scene t8_scene(bool inertia = false) {
  Scene scene;
  scene.file = "t8";
  scene.specimen.file = MACADAM_TEST_DATA "/t8.csv";
  scene.specimen.box.size = {0.008, 0.008, 0.011};
  scene.materials.aggregate = 2630, scene.materials.mastic = 2110;
  scene.laws = am1_laws();
  scene.cyclic().frequencies = {2, 20};
  scene.solver.method = SolverMethod::harmonic;
  scene.solver.backend = Backend::cpu;
  scene.solver.inertia = inertia;
  // scaled so that inertia contributes a tenth of |E*| at 20 Hz
  if (inertia) scene.solver.density_scaling = std::vector<double>{2e5};
  return scene;
}

const laws::GeneralisedKelvin& chain(const Scene& scene, PairType pair) {
  return std::get<laws::GeneralisedKelvin>(*scene.laws[static_cast<std::size_t>(pair)]);
}

/// Returns the moduli that the specimen of a scene has, as if they had been measured.
ModulusData measured(const Scene& scene, const std::vector<double>& frequencies,
                     const std::vector<double>& temperatures = {}) {
  const Preparation prepared = prepare(scene);
  const Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
  ModulusData out;
  out.source = "lab.csv";
  out.temperatures = !temperatures.empty();
  for (const double t : out.temperatures ? temperatures : std::vector<double>{0}) {
    const LawTable laws = out.temperatures ? laws_at(scene, t) : scene.laws;
    Harmonic harmonic(prepared.specimen, prepared.network, laws, inertia, {}, 6);
    for (const double f : frequencies) {
      const double scaling = scene.solver.inertia ? scene.solver.density_scaling->front() : 0;
      const Stiffness found = harmonic.solve(f, scaling).top;
      out.points.push_back({f, found.e_star_pa, found.phase_deg, t, 0, 0});
    }
  }
  return out;
}

CalibrationOptions freeing(const std::vector<std::string>& names) {
  CalibrationOptions out;
  for (const std::string& name : names) out.free.push_back({name, {}, {}, {}, 0});
  return out;
}

/// Multiplies the moduli and viscosities of the law of a pair type by `delta`.
void scale(Scene& scene, PairType pair, double delta) {
  auto& law = std::get<laws::GeneralisedKelvin>(*scene.laws[static_cast<std::size_t>(pair)]);
  law.E_m *= delta, law.C_m *= delta;
  for (double& e : law.E) e *= delta;
  for (double& c : law.C) c *= delta;
}

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) { return error.what(); }
  return "no error";
}
#define EXPECT_SAYS(what, part) EXPECT_NE(message_of(what).find(part), std::string::npos) << message_of(what)

/// Runs the tests with and without inertia, on each backend.
class Truth : public testing::TestWithParam<std::tuple<bool, Backend>> {
 protected:
  static Scene t8() {
    Scene out = t8_scene(std::get<0>(GetParam()));
    out.solver.backend = std::get<1>(GetParam());
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(Calibration, Truth, testing::Combine(testing::Bool(), testing::ValuesIn(tested_backends())),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) ? "with" : "without") + "_inertia_" +
                                  to_string(std::get<1>(info.param));
                         });

/// Calibration recovers four parameters to 1e-6 from exact data, for both misfits, with at most a dozen solves of the
/// model.
TEST_P(Truth, IsRecovered) {
  Scene truth = t8();
  scale(truth, PairType::ma, 1.68);
  scale(truth, PairType::mm, 0.7);
  auto& mm = std::get<laws::GeneralisedKelvin>(*truth.laws[static_cast<std::size_t>(PairType::mm)]);
  mm.alpha *= 1.5, mm.E[1] *= 2;
  const ModulusData data = measured(truth, {0.5, 2, 8, 20});
  for (const Misfit misfit : {Misfit::modulus_and_phase, Misfit::parts}) {
    CalibrationOptions options = freeing({"M-A.delta", "M-M.delta", "M-M.alpha", "M-M.E_2"});
    options.misfit = misfit;
    const Calibration c = calibrate(t8(), data, options);
    const double expected[] = {1.68, 0.7, 0.15, chain(t8_scene(), PairType::mm).E[1] * 2};
    for (std::size_t i = 0; i < c.parameters.size(); ++i)
      EXPECT_NEAR(c.parameters[i].value / expected[i], 1, 1e-6) << c.parameters[i].name;
    EXPECT_LT(c.errors.e_star_largest, 1e-7);
    EXPECT_LT(c.solutions, 12);
  }
}

/// Recovers the modulus of the contacts inside clusters (aggregates that consist of several spheres). In this specimen
/// of 80 spheres every aggregate is a pair of spheres.
TEST_P(Truth, OfClustersIsRecovered) {
  const fs::path file = fs::path(testing::TempDir()) / fmt::format("clusters_{}_{}_{}.csv", std::get<0>(GetParam()),
                                                                   to_string(std::get<1>(GetParam())), getpid());
  const Specimen specimen = random_specimen(1);
  write_specimen_csv(file, specimen);
  Scene start = t8();
  start.specimen.file = file;
  start.specimen.box = specimen.box;
  Scene truth = start;
  scale(truth, PairType::ma, 3.15);
  std::get<laws::Elastic>(*truth.laws[static_cast<std::size_t>(PairType::inner)]).E *= 0.6;
  const Calibration c = calibrate(start, measured(truth, {0.5, 2, 8, 20}), freeing({"M-A.delta", "inner.E"}));
  fs::remove(file);
  EXPECT_NEAR(c.parameters[0].value, 3.15, 3.15e-6);
  EXPECT_NEAR(c.parameters[1].value / 1.125e11, 0.6, 0.6e-6);
}

/// Calibration recovers two factors on moduli with fewer than seven solves of the model.
TEST_P(Truth, OfTwoFactorsTakesFewTrials) {
  Scene truth = t8();
  scale(truth, PairType::ma, 1.68);
  scale(truth, PairType::mm, 0.7);
  const Calibration c = calibrate(t8(), measured(truth, {0.5, 2, 8, 20}), freeing({"M-A.delta", "M-M.delta"}));
  EXPECT_NEAR(c.parameters[0].value, 1.68, 1.68e-6);
  EXPECT_NEAR(c.parameters[1].value, 0.7, 0.7e-6);
  EXPECT_LT(c.solutions, 7);
}

/// The scatter of fits to noisy data must match the deviation that calibration states. One case has one factor and the
/// noise of a laboratory. The other has two factors that are hard to tell apart, with noise so small that log |E*| is
/// linear in the logarithms of the factors.
TEST(Calibration, DeviationsAreThoseOfNoise) {
  const ModulusData data = measured(t8_scene(), {0.5, 2, 8, 20});
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const int trials = long_tests ? 100 : 10;
  for (const auto& [free, modulus, phase] :
       {std::tuple{freeing({"M-M.delta"}), 0.03, 1.0}, {freeing({"M-A.delta", "M-M.delta"}), 5e-4, 0.03}}) {
    double sum = 0;
    int within = 0;
    for (int trial = 0; trial < trials; ++trial) {
      ModulusData noisy = data;
      noisy.deviations = true;
      for (ModulusPoint& p : noisy.points) {
        p.e_star_std = modulus * p.e_star_pa, p.phase_std = phase;
        p.e_star_pa *= 1 + modulus * normal(random), p.phase_deg += phase * normal(random);
      }
      const Calibration c = calibrate(t8_scene(), noisy, free);
      const double off = (c.parameters[0].value - 1) / c.parameters[0].deviation;
      sum += off * off;
      within += std::abs(off) < 1.96;
    }
    // The mean square is a χ² variable of `trials` degrees of freedom, divided by `trials`. The number of fits within
    // 1.96 deviations is binomial. Both may be off by four standard deviations.
    EXPECT_NEAR(sum / trials, 1, 4 * std::sqrt(2.0 / trials)) << free.free.size();
    EXPECT_NEAR(within, 0.95 * trials, 4 * std::sqrt(0.95 * 0.05 * trials)) << free.free.size();
  }
}

/// The model has one parameter with the value 3, and one or two measurements that are proportional to it. If the data
/// state no standard deviations, calibration takes the scale of the errors from the misfit, here 50. It can do so only
/// if there are more measurements than parameters.
TEST(Calibration, DeviationsFollowTheMisfitWhereNoneAreStated) {
  const auto deviation = [](bool stated, std::size_t measurements) {
    Calibration c;
    c.parameters.resize(1);
    c.parameters[0].value = 3;
    c.misfit = 50;
    c.deviations = stated;
    calibration::add_statistics(c, std::vector<double>(measurements, 1.0), {});
    return c.parameters[0].deviation;
  };
  EXPECT_NEAR(deviation(true, 2), 3 / std::numbers::sqrt2, 1e-14);
  EXPECT_NEAR(deviation(false, 2), 3 / std::numbers::sqrt2 * std::sqrt(50), 1e-13);
  EXPECT_NEAR(deviation(false, 1), 3, 1e-14);
}

/// |E*| = 10 GPa with cos φ = 0.8 and sin φ = 0.6 gives E' = 8 GPa and E'' = 6 GPa. Deviations of 0.05 of |E*| and 0.1
/// rad contribute 0.04 and 0.06 of |E*| to E', and 0.03 and 0.08 to E''.
TEST(Calibration, ResidualsOfThePartsAreInTheirStandardDeviations) {
  ModulusData data;
  data.points = {{1, 1e10, std::atan2(0.6, 0.8) / degree, 0, 0, 0}};
  CalibrationOptions options;
  options.misfit = Misfit::parts;
  options.e_star_deviation = 0.05, options.phase_deviation = 0.1 / degree;
  calibration::Predicted predicted;
  predicted.modulus = {8.3e9, 5.8e9};
  predicted.by = {{3e9, 1e9}, {-2e9, 5e8}};
  std::vector<double> residuals, jacobian;
  calibration::add_residuals(data, options, {predicted}, residuals, jacobian);
  const double storage = 1e10 * std::sqrt(0.04 * 0.04 + 0.06 * 0.06),
               loss = 1e10 * std::sqrt(0.03 * 0.03 + 0.08 * 0.08);
  ASSERT_EQ(residuals.size(), 2u);
  // The residuals are differences of moduli, a few hundredths of these moduli. The moduli are accurate to about 1e-16.
  EXPECT_NEAR(residuals[0] / (3e8 / storage), 1, 1e-13);
  EXPECT_NEAR(residuals[1] / (-2e8 / loss), 1, 1e-13);
  const double expected[] = {3e9 / storage, -2e9 / storage, 1e9 / loss, 5e8 / loss};
  ASSERT_EQ(jacobian.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(jacobian[k] / expected[k], 1, 1e-14) << k;
}

/// Recovers two parameters from data at two temperatures. Temperatures without a temperature-dependent law, or outside
/// of a shift table, are refused.
TEST(Calibration, SeveralTemperaturesAndTheirShift) {
  Scene start = t8_scene();
  for (const PairType pair : {PairType::mm, PairType::ma})
    start.shifts[static_cast<std::size_t>(pair)] = laws::Arrhenius{200e3, 15};
  Scene truth = start;
  scale(truth, PairType::ma, 2);
  std::get<laws::GeneralisedKelvin>(*truth.laws[static_cast<std::size_t>(PairType::mm)]).C[0] *= 3;
  const ModulusData data = measured(truth, {1, 10}, {5, 25});
  const Calibration c = calibrate(start, data, freeing({"M-A.delta", "M-M.C_1"}));
  EXPECT_NEAR(c.parameters[0].value, 2, 2e-6);
  EXPECT_NEAR(c.parameters[1].value / (3 * chain(start, PairType::mm).C[0]), 1, 1e-6);
  ASSERT_EQ(c.points.size(), 4u);
  EXPECT_EQ(c.points[2].temperature_c, 25);

  const CalibrationOptions free = freeing({"M-A.delta"});
  EXPECT_SAYS([&] { calibrate(t8_scene(), data, free); }, "between which no law of the scene changes");
  start.shifts[0] = start.shifts[1] = laws::ShiftTable{{0, 10}, {0, -1}};
  EXPECT_SAYS([&] { calibrate(start, data, free); }, "25 degrees C, where the shift of");
}

/// Readings that differ by tenths of a kelvin are one isotherm, unless the laws follow each reading.
TEST(Calibration, ReadingsThatDifferByTenthsAreOneIsotherm) {
  Scene scene = t8_scene();
  ModulusData data;
  data.temperatures = true;
  for (const double t : {19.9, 20.2, 20.3}) data.points.push_back({1, 1e9, 10, t, 0, 0});
  const auto temperatures = [&] {
    std::vector<double> out;
    for (const std::optional<double>& t : calibration::temperatures_of(scene, data)) out.push_back(t.value_or(0));
    return out;
  };
  EXPECT_EQ(temperatures(), (std::vector<double>{20.13, 20.13, 20.13})) << "the mean, rounded to 0.01 K";
  scene.shifts[0] = scene.shifts[1] = laws::ShiftTable{{0, 20}, {0, -1}};
  EXPECT_EQ(temperatures(), (std::vector<double>{20, 20, 20})) << "the isotherm of the table, which ends there";
  scene.shifts[0] = scene.shifts[1] = laws::Arrhenius{200e3, 15};
  EXPECT_EQ(temperatures(), (std::vector<double>{19.9, 20.2, 20.3}));
}

/// A scene without a file is refused before the calibration, and no file is written.
TEST(Calibration, ASceneWithoutAFileIsRefusedBeforeFilesAreWritten) {
  const fs::path out = fs::path(testing::TempDir()) / fmt::format("no_scene_file_{}", getpid());
  fs::create_directories(out);
  EXPECT_SAYS([&] { calibrate_into(out, t8_scene(), {}, {}); }, "found a scene that was not read from a file");
  EXPECT_TRUE(fs::is_empty(out));
  fs::remove_all(out);
}

/// The moduli depend only on the product of A-W.E and A-W.delta, so calibration reports that the two cannot be told
/// apart. If one of them has a prior, both are determined.
TEST(Calibration, WhatCannotBeToldApartIsNamed) {
  const ModulusData data = measured(t8_scene(), {0.1, 2, 20});
  CalibrationOptions known = freeing({"A-W.E", "A-W.delta", "M-M.delta"});
  // contacts with walls contribute little to |E*|, so accurate measurements are needed
  known.e_star_deviation = 1e-3, known.phase_deviation = 0.05;
  const Calibration c = calibrate(t8_scene(), data, known);
  ASSERT_EQ(c.combinations.size(), 1u);
  EXPECT_TRUE(std::isinf(c.combinations[0].deviation));
  EXPECT_NEAR(c.combinations[0].exponents[0], -c.combinations[0].exponents[1], 1e-6);
  EXPECT_NEAR(c.combinations[0].exponents[2], 0, 1e-6);
  EXPECT_TRUE(std::isinf(c.parameters[0].deviation) && std::isinf(c.parameters[1].deviation));
  EXPECT_TRUE(std::isnan(c.correlation[1]) && std::isnan(c.correlation[2])) << "of what is not known";
  EXPECT_TRUE(std::isfinite(c.parameters[2].deviation));
  EXPECT_NE(c.warnings.at(0).find("A-W.E"), std::string::npos) << c.warnings[0];

  known.free[1].prior = 1, known.free[1].prior_deviation = 0.1;
  const Calibration with_prior = calibrate(t8_scene(), data, known);
  EXPECT_NEAR(with_prior.parameters[1].value, 1, 1e-6);
  EXPECT_NEAR(with_prior.parameters[1].deviation, 0.1, 1e-3) << "the prior alone";
  EXPECT_EQ(with_prior.combinations.size(), 1u) << "of the measurements alone";
}

/// A poorly determined parameter is reported with the factor of its 95 % interval. For a normally distributed logarithm
/// this is exp(1.96 standard deviations).
TEST(Calibration, WhatIsHardlyDeterminedIsNamedWithItsFactor) {
  CalibrationOptions rough = freeing({"M-A.delta"});
  rough.e_star_deviation = 0.5, rough.phase_deviation = 20;
  const Calibration c = calibrate(t8_scene(), measured(t8_scene(), {2, 20}), rough);
  ASSERT_EQ(c.combinations.size(), 1u);
  ASSERT_EQ(c.warnings.size(), 1u);
  double factor = 0;
  const std::size_t figure = c.warnings[0].find("a factor of ");
  ASSERT_NE(figure, std::string::npos) << c.warnings[0];
  ASSERT_EQ(std::sscanf(c.warnings[0].c_str() + figure, "a factor of %lf", &factor), 1);
  EXPECT_NEAR(factor / std::exp(1.96 * c.combinations[0].deviation), 1, 0.05) << "two digits are written";
}

/// Uses as many data as a laboratory measures: five temperatures and six frequencies. Fewer than seven solves of the
/// model keep the time short.
TEST(Calibration, ManyMeasurementsTakeFewSolutions) {
  Scene start = t8_scene();
  for (const PairType pair : {PairType::mm, PairType::ma})
    start.shifts[static_cast<std::size_t>(pair)] = laws::Arrhenius{200e3, 15};
  Scene truth = start;
  scale(truth, PairType::ma, 2), scale(truth, PairType::mm, 0.7);
  const ModulusData data = measured(truth, {0.1, 0.5, 1, 5, 10, 25}, {-10, 4, 15, 25, 37});
  const Calibration c = calibrate(start, data, freeing({"M-A.delta", "M-M.delta", "M-M.C_1", "M-M.E_2"}));
  EXPECT_NEAR(c.parameters[0].value, 2, 2e-6);
  EXPECT_NEAR(c.parameters[1].value, 0.7, 0.7e-6);
  EXPECT_LT(c.solutions, 7);
}

/// A parameter at its bound counts as given. The second parameter then gets the same value and standard deviation as in
/// a calibration in which the first parameter is fixed.
TEST(Calibration, AParameterAtItsBoundIsAsIfGiven) {
  Scene truth = t8_scene();
  scale(truth, PairType::ma, 3), scale(truth, PairType::mm, 0.9);
  const ModulusData data = measured(truth, {0.5, 2, 8, 20});
  CalibrationOptions both = freeing({"M-A.delta", "M-M.delta"});
  both.free[0].low = 0.5, both.free[0].high = 1.5;
  const Calibration bounded = calibrate(t8_scene(), data, both);
  EXPECT_TRUE(bounded.parameters[0].at_bound);
  EXPECT_TRUE(std::isinf(bounded.parameters[0].deviation));
  Scene held = t8_scene();
  scale(held, PairType::ma, 1.5);
  const Calibration alone = calibrate(held, data, freeing({"M-M.delta"}));
  EXPECT_NEAR(bounded.parameters[1].value / alone.parameters[0].value, 1, 1e-4);
  EXPECT_NEAR(bounded.parameters[1].deviation / alone.parameters[0].deviation, 1, 1e-2);
}

/// With two seeds there are two specimens. Calibration compares the mean of their moduli with the target, and reports
/// the scatter between them.
TEST(Calibration, SeedsAreAveraged) {
  Scene scene = t8_scene();
  scene.specimen = {};
  scene.specimen.box.size = {0.008, 0.008, 0.011};
  scene.specimen.mastic = MasticSpec{0.75e-3, 1e-3, 0.05, {}};
  scene.specimen.seed = 3;
  std::complex<double> mean;
  for (const std::uint64_t seed : {3, 4}) {
    Scene one = scene;
    one.specimen.seed = seed;
    const ModulusPoint p = measured(one, {5}).points.front();
    mean += 0.5 * std::polar(p.e_star_pa, degree * p.phase_deg);
  }
  ModulusData data;
  data.points = {{5, 2 * std::abs(mean), std::arg(mean) / degree, 0, 0, 0}};
  CalibrationOptions options = freeing({"M-M.delta"});
  scene.laws[static_cast<std::size_t>(PairType::mw)] = scene.laws[static_cast<std::size_t>(PairType::mm)];
  options.seeds = 2;
  const Calibration both = calibrate(scene, data, options);
  EXPECT_EQ(both.seeds, (std::vector<std::uint64_t>{3, 4}));
  EXPECT_GT(both.points[0].e_star_scatter, 1e-4);
  const double missed = both.points[0].e_star_pa / data.points[0].e_star_pa - 1;
  EXPECT_LT(std::abs(missed), 0.03) << "walls do not follow M-M";
  ModulusData again = data;  // data that the fit itself predicted; calibration must recover them
  again.points[0].e_star_pa = both.points[0].e_star_pa, again.points[0].phase_deg = both.points[0].phase_deg;
  EXPECT_NEAR(calibrate(scene, again, options).parameters[0].value / both.parameters[0].value, 1, 1e-6);

  std::vector<ModulusPoint> found;
  scale(scene, PairType::mm, both.parameters[0].value);
  for (const std::uint64_t seed : {3, 4}) {
    scene.specimen.seed = seed;
    found.push_back(measured(scene, {5}).points.front());
  }
  // The standard deviation of two numbers is their difference over √2.
  EXPECT_NEAR(both.points[0].e_star_scatter,
              std::abs(std::log(found[0].e_star_pa / found[1].e_star_pa)) / std::numbers::sqrt2, 1e-7);
  EXPECT_NEAR(both.points[0].phase_scatter_deg, std::abs(found[0].phase_deg - found[1].phase_deg) / std::numbers::sqrt2,
              1e-5);
}

/// Finds the inner contact modulus with which a cube of aggregate is as stiff as the rock
/// (bench/results/aggregate-cube.csv).
TEST(Calibration, TheCubeOfAggregateIsAsStiffAsItsRock) {
  const fs::path file = fs::path(testing::TempDir()) / fmt::format("cube_{}.csv", getpid());
  write_specimen_csv(file, aggregate_cube(coarse_spheres, CubeFilling::shape, scene_porosity, 1));
  Scene scene;
  scene.specimen.file = file;
  scene.specimen.box.size = {cube_edge, cube_edge, cube_edge};
  scene.materials.aggregate = 2630;
  scene.laws[static_cast<std::size_t>(PairType::inner)] = laws::Elastic{aggregate_modulus, inner_alpha};
  scene.laws[static_cast<std::size_t>(PairType::aw)] = laws::Elastic{paper_wall_modulus, 0};
  scene.cyclic().frequencies = {1};
  scene.solver.method = SolverMethod::harmonic;
  scene.solver.backend = Backend::cpu;
  ModulusData rock;
  rock.points = {{1, aggregate_modulus, 0, 0, 0, 0}};
  const Calibration c = calibrate(scene, rock, freeing({"inner.E"}));
  fs::remove(file);
  EXPECT_NEAR(c.parameters[0].value / 105.45e9, 1, 1e-4) << "by the secant of two solutions, five digits";
  EXPECT_NEAR(c.points[0].e_star_pa / aggregate_modulus, 1, 1e-8);
}

TEST(Calibration, TargetsWithoutSenseAreRefused) {
  const ModulusData good = measured(t8_scene(), {2, 20});
  const CalibrationOptions free = freeing({"M-A.delta"});
  const auto with = [&](auto&& change) {
    ModulusData data = good;
    change(data);
    return message_of([&] { calibrate(t8_scene(), data, free); });
  };
  for (const double wrong : {-1e9, 0.0, std::nan(""), HUGE_VAL})
    EXPECT_NE(with([&](ModulusData& d) { d.points[1].e_star_pa = wrong; }).find("measurement 2"), std::string::npos);
  EXPECT_NE(with([](ModulusData& d) { d.points[0].phase_deg = std::nan(""); }).find("measurement 1"),
            std::string::npos);
  EXPECT_NE(with([](ModulusData& d) { d.points.clear(); }).find("measurements: found none"), std::string::npos);
  // If only M-A contacts may change, the specimen can neither be stiffer than all other contacts together, nor as soft
  // as a fluid.
  for (const double factor : {1e3, 1e-3}) {
    const std::string said = with([&](ModulusData& d) {
      for (ModulusPoint& p : d.points) p.e_star_pa *= factor;
    });
    EXPECT_NE(said.find("the targets are not reached"), std::string::npos) << said;
  }
  const std::string flows = with([](ModulusData& d) {
    for (ModulusPoint& p : d.points) p.phase_deg = 89;
  });
  EXPECT_NE(flows.find("the targets are not reached"), std::string::npos) << flows;
  ModulusData stiff = good;
  for (ModulusPoint& p : stiff.points) p.e_star_pa *= 1e3;
  CalibrationOptions nearest = free;
  nearest.nearest = true;
  EXPECT_NE(calibrate(t8_scene(), stiff, nearest).warnings.at(0).find("not reached"), std::string::npos);
}

TEST(Calibration, ParametersAreChecked) {
  const ModulusData data = measured(t8_scene(), {2});
  const auto said = [&](CalibrationOptions options) {
    return message_of([&] { calibrate(t8_scene(), data, options); });
  };
  const auto bounded = [](double low, double high) {
    CalibrationOptions options = freeing({"M-A.delta"});
    options.free[0].low = low, options.free[0].high = high;
    return options;
  };
  CalibrationOptions prior = freeing({"M-A.delta"}), seeds = prior;
  prior.free[0].prior = -1;
  seeds.seeds = 2;
  for (const auto& [options, part] : {std::pair{freeing({}), "found none"},
                                      {freeing({"M-A.dleta"}), "M-A.delta (the nearest"},
                                      {freeing({"M-M.E_4"}), "M-M.E_3"},
                                      {freeing({"M-W.alpha"}), "nearest"},
                                      {freeing({"M-A.delta", "M-A.delta"}), "twice"},
                                      {freeing({"M-A.delta", "M-M.delta", "M-A.alpha"}), "2 numbers"},
                                      {bounded(-1, 2), "positive numbers"},
                                      {bounded(3, 2), "the lower one first"},
                                      {prior, "prior of M-A.delta"},
                                      {seeds, "only generated specimens"}}) {
    EXPECT_NE(said(options).find(part), std::string::npos) << part << " | " << said(options);
  }
  EXPECT_EQ(calibrate(t8_scene(), data, bounded(0.5, 2)).warnings.size(), 0u);
}

TEST(Calibration, TargetsInAnotherUnitAreSuspected) {
  for (const double factor : {1e6, 1e-6}) {
    ModulusData data = measured(t8_scene(), {2, 20});
    for (ModulusPoint& p : data.points) p.e_star_pa *= factor;
    EXPECT_SAYS([&] { calibrate(t8_scene(), data, freeing({"M-A.delta"})); }, "is the measured modulus in Pa?");
  }
}

}  // namespace
}  // namespace macadam::test
