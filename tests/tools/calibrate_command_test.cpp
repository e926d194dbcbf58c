// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate_command_test.cpp  Runs `macadam calibrate` as a user does, and checks the calibrated scene, the files and
// the messages.
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using nlohmann::json;

class CalibrateCommand : public Program {
 protected:
  static constexpr const char* header = "frequency_hz,e_star_pa,phase_deg\n";

  void target(const std::string& text) const { write(folder_ / "lab.csv", text); }
  Outcome calibrate(const std::string& options, const std::string& out = "found") const {
    return macadam(fmt::format("calibrate {} --target {} --out {} --no-pictures {}", path("scene.toml"),
                               path("lab.csv"), path(out), options));
  }
  json found() const { return json::parse(read(folder_ / "found" / "calibration.json")); }
  std::string refused(const std::string& options, int code = 2) const {
    const Outcome outcome = calibrate(options);
    EXPECT_EQ(outcome.code, code) << outcome.err << outcome.out;
    EXPECT_FALSE(fs::exists(folder_ / "found")) << outcome.err;
    return outcome.err;
  }
  static constexpr const char* harmonic = "method = \"harmonic\"\nbackend = \"cpu\"\n";
};

/// Running the calibrated scene gives the predicted moduli, although the scene lies in another folder than the
/// specimen's file.
TEST_F(CalibrateCommand, TheCalibratedSceneReadsAndGivesWhatWasPredicted) {
  for (const char* solver :
       {harmonic, "method = \"harmonic\"\nbackend = \"cpu\"\ninertia = true\ndensity_scaling = 2e5\n"}) {
    write_scene(solver);
    target(std::string(header) + "20,1.4e10,6\n5,1.2e10,15\n");
    const Outcome outcome =
        calibrate("--free M-A.delta,M-M.delta,A-A.E --prior A-A.E=1e11:0.1 --bounds M-A.delta=0.5:9");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_HAS(outcome.out, "files in ");
    const json c = found();
    ASSERT_EQ(c["parameters"].size(), 3u);
    EXPECT_EQ(c["parameters"][1]["name"], "M-M.delta");
    EXPECT_EQ(c["correlation"].size(), 3u);
    EXPECT_EQ(lines_of(read(folder_ / "found" / "predicted.csv")).size(), 3u);
    const Scene before = read_scene(folder_ / "scene.toml"), scene = read_scene(folder_ / "found" / "scene.toml");
    EXPECT_EQ(scene.deltas[static_cast<std::size_t>(PairType::ma)], c["parameters"][0]["value"]) << "to the bit";
    EXPECT_EQ(scene.laws[static_cast<std::size_t>(PairType::mw)]->index(),
              before.laws[static_cast<std::size_t>(PairType::mw)]->index());
    ASSERT_EQ(macadam(fmt::format("run {} --out {}", path("found/scene.toml"), path("run"))).code, 0);
    const json result = summary("run")["results"][0], predicted = c["residuals"][0];
    EXPECT_NEAR(result["e_star_pa"].get<double>() / predicted["predicted_e_star_pa"].get<double>(), 1, 1e-8);
    EXPECT_NEAR(result["phase_deg"].get<double>(), predicted["predicted_phase_deg"].get<double>(), 1e-6);
    fs::remove_all(folder_ / "found");
    fs::remove_all(folder_ / "run");
  }
}

/// Only the values of free parameters and the path of the specimen change in the scene's text. Comments, units, inline
/// tables and line ends stay.
TEST_F(CalibrateCommand, OnlyTheValuesOfTheTextChange) {
  const std::string text =
      "# \u00b5 before everything\r\n[specimen]\r\nfile = \"t8.csv\"  # \u00b5m\r\nbox = [0.008, 0.008, 0.011]\r\n"
      "[materials]\naggregate = {density = 2630}\nmastic = {density = 2110}\n[loading]\nkind = \"cyclic\"\n"
      "frequencies = [20.0]\n[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n";
  const std::string contacts =
      "contacts = [ {pair = \"M-M\", law = \"elastic\", E = \"5 GPa\", alpha = 0.1},  # \u00e4\n"
      " {pair = \"M-A\", law = \"generalised_kelvin\", E_m = \"35 GPa\", E = [ 1.2e9, '5 GPa' ], C = [2e10, 1e10], "
      "delta=2},\n"
      " {pair = \"A-A\", law = \"elastic\", E = 1e11}, {pair = \"inner\", law = \"elastic\", E = 1e11},\n"
      " {pair = \"A-W\", law = \"elastic\", E = 1e11}, {pair = \"M-W\", law = \"elastic\", E = 1e11} ]\n";
  write(folder_ / "scene.toml", contacts + text);
  target(std::string(header) + "20,1.1e10,3\n5,1e10,4\n");
  const Outcome outcome =
      calibrate("--free M-M.delta,M-A.E_2,M-A.delta --misfit modulus-and-phase --prior M-A.E_2=5e9:0.1");
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const std::string made = read(folder_ / "found" / "scene.toml");
  const json c = found();
  const auto value = [&](int i) {
    return fmt::format("{}", c["parameters"][static_cast<std::size_t>(i)]["value"].get<double>());
  };
  std::string expected = contacts + text;
  const auto swap = [&](const std::string& a, const std::string& b) {
    expected.replace(expected.find(a), a.size(), b);
  };
  swap("{pair = \"M-M\"", "{delta = " + value(0) + ", pair = \"M-M\"");
  swap("'5 GPa'", fmt::format("{}", c["parameters"][1]["value"].get<double>()));
  swap("delta=2", "delta=" + value(2));
  swap("\"t8.csv\"", "\"../t8.csv\"");
  EXPECT_EQ(made, expected);
}

/// Finds the modulus that bench/results/aggregate-cube.csv lists for this cube. The listed modulus was found by the
/// secant method from two solves of the cube.
TEST_F(CalibrateCommand, TheCubeOfAggregateGivesItsInnerModulus) {
  const std::string cube = MACADAM_EXAMPLES "/aggregate_cube";
  const Outcome outcome = macadam(fmt::format(
      "calibrate '{0}/scene.toml' --target '{0}/rock.csv' --free inner.E --out {1} --backend cpu --no-pictures", cube,
      path("found")));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NEAR(found()["parameters"][0]["value"].get<double>() / 105.45e9, 1, 1e-4);
}

/// A specimen that is generated from seeds is calibrated with several seeds. The calibrated scene keeps the first seed.
TEST_F(CalibrateCommand, GeneratedSpecimensTakeSeeds) {
  write(folder_ / "scene.toml",
        "[specimen]\nbox = [0.008, 0.008, 0.011]\n[specimen.mastic]\nradius = [0.75e-3, 1e-3]\nporosity = 0.05\n"
        "[loading]\nkind = \"cyclic\"\nfrequencies = [20.0]\n[solver]\nmethod = \"harmonic\"\n" +
            std::string(am1_contacts));
  target(std::string(header) + "20,6e9,9\n");
  const Outcome outcome = calibrate("--free M-M.delta --seed 5 --seeds 2 --backend cpu");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(found()["seeds"], json({5, 6}));
  EXPECT_EQ(read_scene(folder_ / "found" / "scene.toml").specimen.seed, 5u);
  fs::remove_all(folder_ / "found");
  EXPECT_HAS(refused("--free M-M.delta --seeds 0"), "--seeds");
}

/// The scene's own loading does not matter, because the targets have their own frequencies.
TEST_F(CalibrateCommand, ScenesOfOtherTestsAreCalibratedToo) {
  target(std::string(header) + "20,1.4e10,6\n5,1.2e10,15\n");
  const std::string free = "--free M-A.delta";
  write_scene(harmonic);
  ASSERT_EQ(calibrate(free).code, 0);
  const double expected = found()["parameters"][0]["value"];
  for (const char* loading :
       {"kind = \"sweep\"\nfrequencies = [0.1, 10.0]\n", "kind = \"relaxation\"\ntimes = [0.1, 10.0]\n"}) {
    fs::remove_all(folder_ / "found");
    write_scene_of(loading, "backend = \"cpu\"\n");
    const Outcome outcome = calibrate(free);
    ASSERT_EQ(outcome.code, 0) << loading << outcome.err;
    EXPECT_EQ(found()["parameters"][0]["value"], expected) << loading;
    EXPECT_HAS(read(folder_ / "found" / "scene.toml"), std::string(loading).substr(0, 12));
  }
}

/// With `--misfit modulus` the targets need no phase, with `--misfit phase` no modulus. If values that do not count are
/// given, they change nothing.
TEST_F(CalibrateCommand, WhatTheMisfitDoesNotCountNeedNotBeMeasured) {
  write_scene(harmonic);
  target("frequency_hz,e_star_mpa\n20,11000\n5,9500\n");
  EXPECT_HAS(refused("--free M-A.delta"), "with phase_deg");
  ASSERT_EQ(calibrate("--free M-A.delta --misfit modulus").code, 0);
  const json moduli = found();
  const double delta = moduli["parameters"][0]["value"];
  EXPECT_TRUE(moduli["errors"]["phase_rms_deg"].is_null());
  EXPECT_FALSE(moduli["residuals"][0].contains("phase_deg"));
  EXPECT_HAS(read(folder_ / "found" / "predicted.csv"), "20,,11000000000,,");
  // Phases in the file do not count, so the result is the same.
  target("frequency_hz,e_star_pa,phase_deg\n20,1.1e10,1\n5,9.5e9,2\n");
  fs::remove_all(folder_ / "found");
  ASSERT_EQ(calibrate("--free M-A.delta --misfit modulus").code, 0);
  EXPECT_NEAR(found()["parameters"][0]["value"].get<double>() / delta, 1,
              1e-14);  // 11000·1e6 is rounded, 1.1e10 is not
  target("frequency_hz,phase_deg\n20,7\n5,13\n");
  fs::remove_all(folder_ / "found");
  const Outcome phases = calibrate("--free M-M.C_m --misfit phase");
  ASSERT_EQ(phases.code, 0) << phases.err;
  EXPECT_TRUE(found()["errors"]["e_star_rms"].is_null());
}

/// Either the picture is drawn, or the output names the command that draws it.
TEST_F(CalibrateCommand, PicturesAreDrawnOrItIsSaidHow) {
  write_scene(harmonic);
  target(std::string(header) + "20,1.1e10,7\n");
  const Outcome outcome = macadam(fmt::format("calibrate {} --target {} --out {} --free M-A.delta", path("scene.toml"),
                                              path("lab.csv"), path("found")));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const bool drawn = contains(outcome.out, "pictures: calibration.png\n");
  EXPECT_EQ(fs::exists(folder_ / "found" / "calibration.png"), drawn) << outcome.out;
  EXPECT_HAS(outcome.out, drawn ? "pictures" : "draw-calibration");
}

TEST_F(CalibrateCommand, WrongTargetsEndWithAMessageAndLeaveNothing) {
  write_scene(harmonic);
  const std::string free = "--free M-A.delta";
  target(std::string(header) + "20,-1e9,7\n");
  EXPECT_HAS(refused(free), "lab.csv:2: column e_star_pa: found \"-1e9\"");
  target(std::string(header) + "20,nan,7\n");
  EXPECT_HAS(refused(free), "lab.csv:2: column e_star_pa: found \"nan\"");
  target(std::string(header) + "20,1e12,7\n");
  EXPECT_HAS(refused(free, 1), "lab.csv: the targets are not reached");
  target("frequency_hz,e_star_pa,phase_deg,temperature_c\n20,1e10,7,10\n20,5e9,15,20\n");
  EXPECT_HAS(refused(free), "between which no law of the scene changes");
  target(std::string(header) + "20,1.1e10,7\n");
  EXPECT_HAS(refused("--free M-A.dleta"), "M-A.delta (the nearest");
  EXPECT_HAS(refused("--free M-A.delta --bounds M-M.delta=1:2"), "NAME is one of the parameters in --free");
  EXPECT_HAS(refused("--free M-A.delta --bounds M-A.delta=1"), "NAME=LOW:HIGH");
  EXPECT_HAS(refused("--free M-A.delta --prior M-A.delta=x:1"), "NAME=VALUE:DEVIATION");
  EXPECT_HAS(refused("--free M-A.delta,M-M.delta,A-A.E"), "2 numbers, priors included, for 3");
  EXPECT_HAS(refused(""), "--free");
  const Outcome own = macadam(
      fmt::format("calibrate {} --target {} --out {} {}", path("scene.toml"), path("lab.csv"), path("."), free));
  EXPECT_EQ(own.code, 2);
  EXPECT_HAS(own.err, "whose scene.toml would be replaced");
}

}  // namespace
}  // namespace macadam::test
