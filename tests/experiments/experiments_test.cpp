// SPDX-License-Identifier: GPL-3.0-or-later
// experiments_test.cpp  Runs relaxation, creep, constant rates and sweeps as a user does. Compares the results with
// numerical Laplace inversions of solutions of the whole network and with the harmonic solver, and checks the files.
#include <cmath>
#include <map>
#include <numbers>

#include "macadam/harmonic.hpp"
#include "tests/support/program.hpp"
#include "tests/support/talbot.hpp"
#include "tests/experiments/test_tables.hpp"

namespace macadam::test {
namespace {

using Complex = std::complex<double>;

class Experiments : public Program {
 protected:
  /// Runs an experiment on the 175 particles of t8 and returns the text of the result file `file`.
  std::string run_t8(const std::string& loading, const std::string& file, const std::string& solver = "") const {
    const fs::path scene = write_scene_of(loading, solver);
    const Outcome outcome = run_quick("out");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, file)) << outcome.out;
    return text("out/" + file);
  }
  std::string text(const std::string& name) const { return read(folder_ / name); }

  /// Returns the error message with which the program refuses a scene.
  std::string refusal(const std::string& loading, const std::string& solver = "",
                      const std::string& options = "--backend cpu") const {
    write_scene_of(loading, solver);
    const Outcome outcome = run_quick("refused", options);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "refused" / "summary.json"));
    return outcome.err;
  }
};

/// Returns the rows of a table by the names of its columns; an empty field is NaN.
std::vector<std::map<std::string, double>> rows_of(const std::string& text) {
  std::vector<std::map<std::string, double>> out;
  for (const auto& row : table_of(text)) {
    out.emplace_back();
    for (const auto& [name, field] : row) {
      char* end = nullptr;
      const double value = std::strtod(field.c_str(), &end);
      out.back()[name] = end == field.c_str() ? std::nan("") : value;
    }
  }
  return out;
}

/// Computes E*(s) of the 175 particles of t8 with the harmonic solver. Every s takes a solution of the whole network.
class FullSolutions {
 public:
  explicit FullSolutions(const fs::path& scene) : scene_(read_scene(scene)), prepared_(prepare(scene_)) {}
  Complex operator()(Complex s) const {
    Harmonic harmonic(prepared_.specimen, prepared_.network, scene_.laws, make_inertia(prepared_.specimen, 2630, 2110),
                      {}, std::abs(s) / (2 * std::numbers::pi));
    return harmonic.solve({{.frequency_hz = s.imag() / (2 * std::numbers::pi), .growth = s.real()}})
        .front()
        .parts.modulus();
  }

 private:
  Scene scene_;
  Preparation prepared_;
};

/// With rule "series" and elastic phases, relaxation and a constant rate without time steps have the modulus of the
/// cyclic test. The tolerance is that of the classes of contacts with nearly equal rock in series, whose error is a
/// part of the reported one.
TEST_F(Experiments, RuleSeriesNeedsNoTimeSteps) {
  const auto run_series = [&](const std::string& loading) {
    write(folder_ / "scene.toml",
          "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[materials.aggregate]\ndensity = 2630\n"
          "law = \"elastic\"\nE = 6e10\n[materials.mastic]\ndensity = 2110\nlaw = \"elastic\"\nE = 6e9\n"
          "poisson_ratio = 0.35\n[network]\nrule = \"series\"\n[loading]\n" +
              loading + "[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n");
    const Outcome outcome = run_quick("out");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  run_series("kind = \"cyclic\"\nfrequencies = [1.0]\n");
  const double modulus = summary("out").at("results").at(0).at("e_star_pa");
  EXPECT_GT(modulus, 6e9);
  run_series("kind = \"relaxation\"\nstrain = 1e-4\ntimes = [1e-3, 1]\n");
  for (const auto& row : rows_of(text("out/relaxation.csv"))) EXPECT_NEAR(row.at("modulus_pa") / modulus, 1, 1e-6);
  run_series("kind = \"monotonic\"\nrate = 1e-3\nstrain = 1e-4\npoints = 2\n");
  for (const auto& row : rows_of(text("out/monotonic.csv")))
    EXPECT_NEAR(row.at("stress_pa") / (row.at("strain") * modulus), 1, 1e-6);
}

TEST_F(Experiments, RelaxationIsTheInversionOfFullSolutions) {
  const auto rows =
      rows_of(run_t8("kind = \"relaxation\"\nstrain = 2e-4\ntimes = [1e-3, 1e-2, 0.1, 1, 10]\n", "relaxation.csv"));
  const FullSolutions modulus(folder_ / "scene.toml");
  ASSERT_EQ(rows.size(), 5u);
  for (const auto& row : rows) {
    EXPECT_LE(row.at("error"), 1e-5);  // the default tolerance
    const double expected = talbot([&](Complex s) { return modulus(s) / s; }, row.at("time_s"), 18);
    // the inversion with 18 nodes is accurate to 1e-8
    EXPECT_NEAR(row.at("modulus_pa") / expected, 1, row.at("error") + 1e-7) << row.at("time_s");
    EXPECT_EQ(row.at("strain"), 2e-4);
    EXPECT_NEAR(row.at("stress_pa") / (2e-4 * row.at("modulus_pa")), 1, 1e-14);
  }
  const auto result = summary("out").at("results").at(0);
  EXPECT_EQ(result.at("kind"), "relaxation");
  EXPECT_EQ(result.at("sides"), "free");
  EXPECT_EQ(result.at("modulus"), "uniaxial");
  EXPECT_EQ(result.at("points").size(), 5u);
  EXPECT_EQ(summary("out").at("solver").at("method"), "harmonic");
}

/// The strain of creep is the inverse Laplace transform of 1/(s·E*(s)). For recovery the strains of load and release
/// are added.
TEST_F(Experiments, CreepGrowsAndRecovers) {
  const std::string loading =
      "kind = \"creep\"\nstress = \"-0.1 MPa\"\nrelease = \"1 s\"\ntimes = [1e-3, 0.9, 1.01, 10]\n";
  const auto rows = rows_of(run_t8(loading, "creep.csv"));
  const FullSolutions modulus(folder_ / "scene.toml");
  const auto compliance = [&](double t) { return talbot([&](Complex s) { return 1.0 / (s * modulus(s)); }, t, 18); };
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& row : rows) {
    const double t = row.at("time_s"), held = compliance(t);
    const double strain = -1e5 * (held - (t > 1 ? compliance(t - 1) : 0));
    EXPECT_NEAR(row.at("compliance_1_pa") / held, 1, row.at("error") + 1e-7) << t;
    EXPECT_NEAR(row.at("strain"), strain, 1e5 * held * (row.at("error") + 1e-7)) << t;
    EXPECT_EQ(row.at("stress_pa"), t < 1 ? -1e5 : 0);
  }
}

// If the stress is released in a step at 1 s, it is zero at exactly this time. With a ramp it still has its full value
// then, and decreases afterwards.
TEST_F(Experiments, RampsTakeTheirTime) {
  const std::string slow = "kind = \"creep\"\nstress = 1e5\nramp = 0.5\nrelease = 1\ntimes = [0.25, 0.5, 1, 1.25, 2]\n";
  const auto rows = rows_of(run_t8(slow, "creep.csv"));
  const double expected[] = {0.5e5, 1e5, 1e5, 0.5e5, 0};
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_NEAR(rows[i].at("stress_pa"), expected[i], 1e-10);
  const FullSolutions modulus(folder_ / "scene.toml");
  // strain per stress; the stress of a ramp has the transform 1/(s²·ramp), less the same function delayed by the ramp
  const auto ramp = [&](double t) {
    const auto grows = [&](double since) {
      return since <= 0 ? 0 : talbot([&](Complex s) { return 1.0 / (0.5 * s * s * modulus(s)); }, since, 18);
    };
    return grows(t) - grows(t - 0.5);
  };
  for (const auto& row : rows) {
    const double t = row.at("time_s");
    const double strain = 1e5 * (ramp(t) - ramp(t - 1));
    EXPECT_NEAR(row.at("strain"), strain, 1e5 * row.at("compliance_1_pa") * (row.at("error") + 1e-7)) << t;
  }
}

/// The stress under a constant rate is the inverse Laplace transform of E*(s)/s².
TEST_F(Experiments, ConstantRatesIntegrateTheRelaxation) {
  const auto rows =
      rows_of(run_t8("kind = \"monotonic\"\nrate = \"-1e-5 1/s\"\ntimes = [1e-3, 0.1, 10]\n", "monotonic.csv"));
  const FullSolutions modulus(folder_ / "scene.toml");
  ASSERT_EQ(rows.size(), 3u);
  for (const auto& row : rows) {
    const double t = row.at("time_s");
    const double stress = -1e-5 * talbot([&](Complex s) { return modulus(s) / (s * s); }, t, 18);
    EXPECT_NEAR(row.at("stress_pa") / stress, 1, row.at("error") + 1e-7) << t;
    EXPECT_EQ(row.at("strain"), -1e-5 * t);
    EXPECT_NEAR(row.at("secant_pa") * row.at("strain") / row.at("stress_pa"), 1, 1e-14);
  }
  EXPECT_EQ(summary("out").at("results").at(0).at("kind"), "monotonic");
}

TEST_F(Experiments, SweepsAreTheHarmonicTestAndItsMasterCurve) {
  const auto rows =
      rows_of(run_t8("kind = \"sweep\"\nfrequencies = [0.1, \"10 Hz\"]\npoints_per_decade = 2\n", "sweep.csv"));
  ASSERT_EQ(rows.size(), 5u);
  write_scene_of("kind = \"cyclic\"\nfrequencies = [0.1, 1, 10]\n", "method = \"harmonic\"\n");
  ASSERT_EQ(run_quick("cyclic").code, 0);
  const auto cyclic = summary("cyclic").at("results");
  const auto swept = summary("out").at("results");
  ASSERT_EQ(swept.size(), 5u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = rows[2 * i];
    EXPECT_NEAR(row.at("frequency_hz") / cyclic[i].at("frequency_hz").get<double>(), 1, 1e-14);
    const double e_star = cyclic[i].at("e_star_pa"), phase = cyclic[i].at("phase_deg");
    EXPECT_NEAR(row.at("e_star_pa") / e_star, 1, 1e-9);  // the solver's residual is 1e-11
    EXPECT_NEAR(row.at("phase_deg"), phase, 1e-7);
    EXPECT_NEAR(row.at("storage_pa"), e_star * std::cos(phase * std::numbers::pi / 180), 1e-9 * e_star);
    EXPECT_NEAR(row.at("loss_pa"), e_star * std::sin(phase * std::numbers::pi / 180), 1e-9 * e_star);
    EXPECT_LT(row.at("error"), 1e-6);
    EXPECT_EQ(swept[2 * i].at("modulus"), "uniaxial");
    EXPECT_EQ(swept[2 * i].at("loss_pa"), row.at("loss_pa"));
  }
}

// The tables for other programs reproduce E(t) and J(t).
TEST_F(Experiments, TablesForOtherProgramsHoldTheSameMaterial) {
  const auto rows = rows_of(run_t8(
      "kind = \"relaxation\"\ntimes = [1e-3, 10]\npoints_per_decade = 4\npoisson_ratio = 0.3\n", "relaxation.csv"));
  ASSERT_EQ(rows.size(), 17u);
  const auto result = summary("out").at("results").at(0);
  const double asked = 1e-5, table = result.at("table_error");
  EXPECT_LE(table, 1.01 * asked);

  const auto prony = rows_of(text("out/prony.csv"));
  EXPECT_LT(prony.size(), 30u);
  double shares = 0;
  for (const auto& unit : prony) shares += unit.at("share");
  EXPECT_NEAR(shares, 1, 1e-12);
  const auto kelvin = rows_of(text("out/kelvin.csv"));

  // Fractions and relaxation times in the tables for Abaqus and for Ansys, in their order.
  std::vector<double> abaqus, ansys;
  double instantaneous = 0;
  const auto abaqus_lines = lines_of(text("out/prony_abaqus.inp"));
  for (std::size_t i = 0; i < abaqus_lines.size(); ++i) {
    double shear = 0, bulk = 0, time = 0;
    if (std::sscanf(abaqus_lines[i].c_str(), "%lf, %lf, %lf", &shear, &bulk, &time) == 3) {
      EXPECT_EQ(shear, bulk);
      abaqus.insert(abaqus.end(), {shear, time});
    }
    if (abaqus_lines[i] == "*ELASTIC, MODULI=INSTANTANEOUS") {
      double ratio = 0;
      EXPECT_EQ(std::sscanf(abaqus_lines.at(i + 1).c_str(), "%lf, %lf", &instantaneous, &ratio), 2);
      EXPECT_EQ(ratio, 0.3);
    }
  }
  bool shear = false;
  for (const std::string& line : lines_of(text("out/prony_ansys.txt"))) {
    if (line.starts_with("TB,PRONY")) {
      shear = line.ends_with("SHEAR");
      EXPECT_TRUE(contains(line, fmt::format("TB,PRONY,1,1,{},", prony.size() - 1))) << line;
    }
    if (!shear || !line.starts_with("TBDATA,")) continue;
    std::istringstream in(line.substr(7));
    std::string field;
    std::getline(in, field, ',');
    EXPECT_EQ(std::stoul(field), ansys.size() + 1);  // numbering continues from the line before
    while (std::getline(in, field, ',')) ansys.push_back(std::stod(field));
  }
  EXPECT_EQ(abaqus, ansys);
  ASSERT_EQ(abaqus.size(), 2 * (prony.size() - 1));
  double sum = 0;
  for (std::size_t i = 0; i < abaqus.size(); i += 2) sum += abaqus[i];
  EXPECT_LT(sum, 1);  // the finite-element programs refuse fractions that add up to 1

  for (const auto& row : rows) {
    const double t = row.at("time_s"), expected = row.at("modulus_pa");
    double series = 0, elements = 1, creep = 0;
    for (const auto& unit : prony) series += unit.at("modulus_pa") * std::exp(-t / unit.at("time_s"));
    for (std::size_t i = 0; i < abaqus.size(); i += 2) elements -= abaqus[i] * -std::expm1(-t / abaqus[i + 1]);
    EXPECT_NEAR(series / expected, 1, 1.01 * asked) << t;
    // The table has ten digits, and its fractions add up to 1 − 1e-8.
    EXPECT_NEAR(instantaneous * elements, expected, 1.01 * asked * expected + 2e-8 * instantaneous) << t;
    for (const auto& unit : kelvin) {
      const bool maxwell = std::isnan(unit.at("time_s"));
      creep +=
          maxwell ? 1 / unit.at("E_pa") + t / unit.at("C_pa_s") : -std::expm1(-t / unit.at("time_s")) / unit.at("E_pa");
      if (!maxwell) { EXPECT_NEAR(unit.at("C_pa_s") / unit.at("E_pa") / unit.at("time_s"), 1, 1e-14); }
    }
    EXPECT_GT(creep * expected, 0.1);  // J·E is at most 1, and close to 1 for slow relaxation
    EXPECT_LE(creep * expected, 1 + 1e-9);
  }
}

/// If lateral walls hold the specimen, the result is a confined modulus, and the outputs say so.
TEST_F(Experiments, HeldSidesAreSaid) {
  const fs::path scene = write_scene_of("kind = \"relaxation\"\ntimes = [0.01, 1]\n");
  std::ofstream(scene, std::ios::app) << "[network]\nlateral_walls = true\n";
  const Outcome outcome = run_quick("out");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "confined modulus")) << outcome.out;
  const auto result = summary("out").at("results").at(0);
  EXPECT_EQ(result.at("modulus"), "confined");
  EXPECT_EQ(result.at("sides"), "held");
  EXPECT_EQ(summary("out").at("warnings").size(), 2u);
  EXPECT_TRUE(contains(text("out/prony.csv"), "confined modulus"));
  // a finite-element program would take a confined modulus for a uniaxial one
  EXPECT_FALSE(fs::exists(folder_ / "out/prony_abaqus.inp"));
  EXPECT_FALSE(fs::exists(folder_ / "out/prony_ansys.txt"));

  for (const char* solver : {"method = \"harmonic\"\n", quick}) {
    std::ofstream(write_scene(solver), std::ios::app) << "[network]\nlateral_walls = true\n";
    const std::string said = run_quick("cyclic").out;
    EXPECT_HAS(said, "warning: the sides are held, so the moduli are confined moduli");
    EXPECT_HAS(said, "|M*|: confined modulus (the sides are held)");
    EXPECT_HAS(said, "|M*| (GPa)");
    EXPECT_FALSE(contains(said.substr(0, said.find("warning:")), "|E*|")) << said;
    EXPECT_EQ(summary("cyclic").at("results").at(0).at("modulus"), "confined");
  }
}

// stepped_load_test checks the numbers of stepped tests. Here the command is run, and its files and messages are
// checked.
TEST_F(Experiments, AreSteppedWhereTheSceneAsksForIt) {
  const std::string steps = "method = \"explicit\"\ndensity_scaling = 25\n";
  for (const auto& [kind, load, columns, shown] :
       {std::tuple{"relaxation", "strain = -1e-4\n", "strain,stress_pa,modulus_pa,error,bottom_pa",
                   "stress/strain (MPa)"},
        {"creep", "stress = -1e5\n", "stress_pa,strain,compliance_1_pa,error,top_pa,bottom_pa",
         "strain/stress (1/GPa)"},
        {"monotonic", "rate = -0.01\n", "strain,stress_pa,secant_pa,error,bottom_pa", "secant (MPa)"}}) {
    const std::string file = fmt::format("{}.csv", kind);
    const auto rows = rows_of(run_t8(fmt::format("kind = \"{}\"\n{}times = [2e-3, 4e-3]\n", kind, load), file, steps));
    EXPECT_TRUE(contains(text("out/" + file), fmt::format("\ntime_s,{},kinetic_j,poisson_ratio\n", columns)));
    ASSERT_EQ(rows.size(), 2u);
    for (const auto& row : rows) {
      EXPECT_LT(row.at("stress_pa"), 0);
      EXPECT_LT(row.at("strain"), 0);
      EXPECT_LT(row.at("error"), 5e-3);
    }
    const Outcome again = run_quick("again");
    EXPECT_TRUE(contains(again.out, shown)) << again.out;
    EXPECT_TRUE(contains(again.out, "viscous damping of ")) << again.out;
    EXPECT_TRUE(contains(again.out, "kinetic energy: ")) << again.out;
    EXPECT_TRUE(read(folder_ / "again" / file) == text("out/" + file));
  }
}

TEST_F(Experiments, DampingHasNoPartWhereMotionHasNoInertia) {
  const auto result_of = [&](const std::string& solver) {
    run_t8("kind = \"cyclic\"\nfrequencies = [20]\n", "summary.json", "method = \"harmonic\"\n" + solver);
    return summary("out").at("results").at(0).at("e_star_pa").dump();
  };
  const std::string viscous = "damping = \"3000 1/s\"\ndamping_kind = \"viscous\"\n", alone = result_of("");
  EXPECT_EQ(result_of(viscous), alone);
  EXPECT_HAS(run_quick("again").out, "viscous damping is not used");
  EXPECT_NE(result_of("inertia = true\n" + viscous), result_of("inertia = true\n"));
}

TEST_F(Experiments, ResultsOfAnotherTestDoNotStay) {
  run_t8("kind = \"relaxation\"\ntimes = [0.1, 1]\n", "relaxation.csv");
  run_t8("kind = \"sweep\"\nfrequencies = [1]\n", "sweep.csv");
  for (const char* name : {"relaxation.csv", "prony.csv", "kelvin.csv", "prony_abaqus.inp", "prony_ansys.txt"})
    EXPECT_FALSE(fs::exists(folder_ / "out" / name)) << name;
}

TEST_F(Experiments, WhatMakesNoSenseIsRefused) {
  const std::string relaxation = "kind = \"relaxation\"\ntimes = [1, 2]\n";
  EXPECT_HAS(refusal("kind = \"relaxtion\"\ntimes = [1]\n"), "relaxation");
  EXPECT_HAS(refusal("kind = \"relaxation\"\n"), "times");
  EXPECT_HAS(refusal("kind = \"relaxation\"\ntimes = [1, -2]\n"), "positive");
  EXPECT_HAS(refusal("kind = \"relaxation\"\ntimes = []\n"), "at least one");
  EXPECT_HAS(refusal("kind = \"relaxation\"\ntimes = [1, 1]\n"), "1 s twice");
  EXPECT_HAS(refusal("kind = \"relaxation\"\ntimes = [1, 2, 3]\npoints_per_decade = 2\n"), "two ends of a range");
  EXPECT_HAS(refusal(relaxation + "strain = 0\n"), "not 0");
  EXPECT_HAS(refusal(relaxation + "poisson_ratio = 0.5\n"), "below 0.5");
  EXPECT_HAS(refusal(relaxation + "frequencies = [1]\n"), "frequencies");
  EXPECT_HAS(refusal("kind = \"creep\"\ntimes = [1]\n"), "stress");
  EXPECT_HAS(refusal("kind = \"creep\"\nstress = 1\nramp = 2\nrelease = 1\ntimes = [1]\n"), "end of the ramp");
  EXPECT_HAS(refusal("kind = \"creep\"\nstress = 1\nrelease = 2\ntimes = [1, 2]\n"),
             "less than the last of the times, 2 s");
  EXPECT_HAS(refusal("kind = \"monotonic\"\nrate = 0\ntimes = [1]\n"), "not 0");
  EXPECT_HAS(refusal("kind = \"monotonic\"\nrate = 1\nstrain = 11\n"), "above -1 and at most 10");
  EXPECT_HAS(refusal("kind = \"monotonic\"\nrate = -1\nstrain = -1\n"), "above -1 and at most 10");
  EXPECT_HAS(refusal("kind = \"monotonic\"\nrate = -1\ntimes = [0.1, 2]\n"), "found a strain of -2 at the last");
  EXPECT_HAS(
      refusal("kind = \"cyclic\"\nfrequencies = [20]\n", "method = \"explicit\"\n[output]\nsensitivities = true\n"),
      "sensitivities in [output]: found true with method");
  EXPECT_HAS(refusal("kind = \"sweep\"\nfrequencies = [1]\ncycles = 3\n"), "cycles");
  EXPECT_HAS(refusal(relaxation, "inertia = true\n"), "inertia");
  const std::string sweep = "kind = \"sweep\"\nfrequencies = [1]\n";
  EXPECT_HAS(refusal(sweep, "method = \"explicit\"\n"), "not stepped in time");
  EXPECT_HAS(refusal(sweep, "", "--backend cpu --method explicit"), "not stepped in time");
  EXPECT_HAS(refusal(relaxation, "tolerance = 1e-4\n", "--backend cpu --method explicit"), "tolerance");
  EXPECT_HAS(refusal(relaxation, "", "--backend cpu --resume"), "keeps no checkpoints");
}

}  // namespace
}  // namespace macadam::test
