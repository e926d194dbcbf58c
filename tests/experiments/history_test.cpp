// SPDX-License-Identifier: GPL-3.0-or-later
// history_test.cpp  Tests kind "history": a column under every drive against the closed form of its law, with and
// without time steps; tables in files; interrupted runs; and scenes that are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/experiments/transient/history_response.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using drives::AnySpec;
using experiments::StrainHistory;

constexpr double pi = std::numbers::pi;
/// Constants of the law: E(t) = E_inf + E_1·e^(−t/time).
constexpr double E_inf = 2e9, E_1 = 2e9, time_1 = 1e-3;
/// Duration of the tests of a column [s].
constexpr double end = 4e-3;

/// A drive in a scene, and the strain that it must give.
struct Case {
  const char* name;
  std::string keys;
  std::function<double(double)> strain;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"haversine", "drive = \"haversine\"\nstrain = -2e-5\npulse = \"1 ms\"\nrest = \"0.5 ms\"\npulses = 2\n",
       [](double t) {
         const double u = std::fmod(t, 1.5e-3);
         return t < 3e-3 && u < 1e-3 ? -2e-5 * std::pow(std::sin(pi * u / 1e-3), 2) : 0;
       }},
      {"pulses", "drive = \"haversine\"\nstrain = 1e-5\npulse = 8e-4\n",
       [](double t) { return 1e-5 * std::pow(std::sin(pi * t / 8e-4), 2); }},
      {"table", "drive = \"table\"\ntimes = [1e-3, 1.5e-3, 3e-3]\nstrains = [1e-5, 1e-5, -2e-5]\n",
       [](double t) {
         if (t < 1e-3) return 1e-2 * t;
         if (t < 1.5e-3) return 1e-5;
         return t < 3e-3 ? 1e-5 - 2e-2 * (t - 1.5e-3) : -2e-5;
       }},
      {"ramp", "drive = \"ramp\"\nstrain = 1e-5\nramp = \"1 ms\"\nhold = \"1 ms\"\n",
       [](double t) { return 1e-5 * std::clamp(std::min(t / 1e-3, 3 - t / 1e-3), 0.0, 1.0); }},
      {"smooth ramp", "drive = \"ramp\"\nstrain = 1e-5\nramp = \"1 ms\"\nsmooth = true\n",
       [](double t) { return 1e-5 * std::pow(std::sin(pi / 2 * std::min(1.0, t / 1e-3)), 2); }},
      {"constant rate", "drive = \"constant_rate\"\nrate = \"-1e-2 1/s\"\n", [](double t) { return -1e-2 * t; }},
      {"cyclic", "drive = \"cyclic\"\nstrain = 1e-5\nfrequency = \"1 kHz\"\nramp = \"2 ms\"\n", [](double t) {
         const double grown = t < 2e-3 ? std::pow(std::sin(pi / 2 * t / 2e-3), 2) : 1;
         return -1e-5 * grown * std::sin(2 * pi * 1e3 * t);
       }}};
  return all;
}

/// Returns the stress of the law at time t, as a sum over small steps of the strain. With n steps the relative error is
/// of order (t/n/time_1)²/24 < 1e-8 where the strain is straight. A step that contains a kink of the strain contributes
/// about 1/n of the stress, with a relative error below (t/n)/time_1; this is below 1e-8 of the stress, because the
/// kinks are near multiples of t/n.
double law_stress(const std::function<double(double)>& strain, double t) {
  constexpr int n = 40000;
  double memory = 0, before = strain(0);
  for (int i = 1; i <= n; ++i) {
    const double now = strain(t * i / n);
    memory += (now - before) * std::exp(-(t - t * (i - 0.5) / n) / time_1);
    before = now;
  }
  return E_inf * strain(t) + E_1 * memory;
}

double largest_stress(const Case& c) {
  double out = 0;
  for (int i = 1; i <= 40; ++i) out = std::max(out, std::abs(law_stress(c.strain, end * i / 40)));
  return out;
}

class History : public TestFolder {
 protected:
  /// Writes the scene of a column of four cubes. All contacts have the same law, so the column responds as one contact.
  fs::path column(const std::string& loading, const std::string& solver) const {
    write(folder_ / "column.csv",
          "id,x,y,z,radius,phase,body\n0,0.0005,0.0005,0.0005,0.0005,mastic,-1\n"
          "1,0.0005,0.0005,0.0015,0.0005,mastic,-1\n2,0.0005,0.0005,0.0025,0.0005,mastic,-1\n"
          "3,0.0005,0.0005,0.0035,0.0005,mastic,-1\n");
    std::string text =
        "[specimen]\nfile = \"column.csv\"\nbox = [0.001, 0.001, 0.004]\n[materials.aggregate]\n"
        "density = 2630.0\n[materials.mastic]\ndensity = 2110.0\n";
    const double sum = E_inf + E_1;  // the same law as a spring in series with one Kelvin unit
    for (const char* pair : {"M-M", "M-W"}) {
      text += fmt::format(
          "[[contacts]]\npair = \"{}\"\nlaw = \"generalised_kelvin\"\nE_m = {}\nE = [{}]\nC = [{}]\nalpha = 0.2\n",
          pair, sum, sum * E_inf / E_1, sum * sum * time_1 / E_1);
    }
    write(folder_ / "scene.toml",
          text + "[loading]\nkind = \"history\"\n" + loading + "[solver]\nbackend = \"cpu\"\n" + solver);
    return folder_ / "scene.toml";
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(read(out("out") / "summary.json")).at("results").at(0);
  }
  std::string refusal(const std::string& loading) const {
    return message_of([&] { read_scene(column(loading, "")); });
  }
};

const std::string in_time = fmt::format("duration = {}\nsamples = 40\n", end);

/// The strain rates, the drive of a stepper and the closed form in this file describe the same strain.
TEST_F(History, EveryDescriptionIsOneStrain) {
  for (const Case& c : cases()) {
    const auto spec = std::get<StrainHistory>(read_scene(column(c.keys + in_time, "")).experiment);
    std::visit(
        [&](const auto& drive) {
          const double dt = drive.step(1.7e-6, end), unit = 4e-3;
          EXPECT_LE(dt, 1.7e-6 * (1 + 1e-12)) << c.name;
          EXPECT_GT(dt, 1.4e-6) << c.name;  // at most a tenth shorter, and a step of rounding
          const auto moved = drive.drive(unit, dt, end);
          EXPECT_NEAR(moved->dt() / dt, 1, 1e-12);
          EXPECT_EQ(moved->value(0), 0) << c.name;
          const HistoryResponse response(drive.pieces(end));
          const auto range = drive.range(end);
          for (std::int64_t k = 0; static_cast<double>(k) * dt <= end; k += 7) {
            const double t = static_cast<double>(k) * dt, expected = c.strain(t);
            // strains are sums of a few terms; times are exact to 1e-15 of 4 ms
            EXPECT_NEAR(response.strain(t), expected, 1e-12 * 1e-5) << c.name << " at " << t;
            EXPECT_NEAR(moved->value(k) / unit, expected, 1e-12 * 1e-5) << c.name << " at " << t;
            EXPECT_LE(range.lowest, expected + 1e-18) << c.name;
            EXPECT_GE(range.highest, expected - 1e-18) << c.name;
          }
        },
        spec.drive);
  }
}

TEST_F(History, TheStressIsTheConvolution) {
  const PronySeries series{E_inf, {{E_1, time_1}}};
  for (const Case& c : cases()) {
    const auto spec = std::get<StrainHistory>(read_scene(column(c.keys + in_time, "")).experiment);
    HistoryResponse response(std::visit([](const auto& drive) { return drive.pieces(end); }, spec.drive));
    const double scale = largest_stress(c);
    for (const double t : {3.1e-4, 1e-3, 1.7e-3, 2.9e-3, end})
      EXPECT_NEAR(response.stress(series, t), law_stress(c.strain, t), 1e-6 * scale) << c.name << " at " << t;
    // another series, then the first one again
    EXPECT_NEAR(response.stress({3 * E_inf, {{3 * E_1, time_1}}}, end), 3 * law_stress(c.strain, end), 3e-6 * scale);
    EXPECT_NEAR(response.stress(series, end), law_stress(c.strain, end), 1e-6 * scale);
  }
}

// A unit that is a million times slower than the test is a spring; a spring's stress is E·strain at every time.
TEST_F(History, SlowUnitsAreSpringsAndFastUnitsDashpots) {
  const drives::HaversineSpec spec{1e-5, 1e-3, 5e-4, {}};
  HistoryResponse response(spec.pieces(end));
  for (const double t : {2e-4, 8e-4, 1.9e-3, 3.3e-3}) {
    EXPECT_NEAR(response.stress({0, {{2e9, 1e9}}}, t), 2e9 * response.strain(t), 1e-8 * 2e4) << t;
    EXPECT_NEAR(response.stress({0, {{2e9, 1e-9}}}, t), 0, 1e-5 * 2e4) << t;  // time·π/pulse = 3e-6 of the spring
  }
}

/// Without time steps the only error is the error of the spectrum, 1e-5. With time steps, waves are damped to 2e-5, and
/// damping and inertia delay the column by about 3 µs (the load changes within 1 ms); the delay affects the first
/// samples most.
TEST_F(History, AColumnIsTheClosedFormOfItsLaw) {
  for (const std::string method : {"harmonic", "explicit"}) {
    const bool stepped = method == "explicit";
    for (const Case& c : cases()) {
      const Scene asked = read_scene(column(c.keys + in_time, "method = \"" + method + "\"\n"));
      const RunResult result = run(asked, out("out"));
      const double scale = largest_stress(c);
      const auto compare = [&](const auto& points) {
        ASSERT_EQ(points.size(), 40u) << c.name;
        double peak = 0;
        for (const auto& p : points) {
          EXPECT_NEAR(p.strain, c.strain(p.time_s), 1e-9 * 2e-5) << c.name << " at " << p.time_s;
          EXPECT_NEAR(p.stress_pa, law_stress(c.strain, p.time_s), (stepped ? 2e-2 : 1e-5) * scale)
              << method << ", " << c.name << " at " << p.time_s;
          if (std::abs(p.stress_pa) > std::abs(peak)) peak = p.stress_pa;
        }
        EXPECT_EQ(summary().at("peak_stress_pa").get<double>(), peak) << c.name;
        EXPECT_EQ(summary().at("final_stress_pa").get<double>(), points.back().stress_pa) << c.name;
        EXPECT_EQ(summary().at("kind"), "history");
      };
      if (stepped)
        compare(std::get<experiments::SteppedResponse>(result.found).points);
      else
        compare(std::get<experiments::SpectrumResponse>(result.found).points);
      EXPECT_HAS(read(out("out") / "history.csv"),
                 stepped ? "\ntime_s,strain,stress_pa,error,bottom_pa,kinetic_j,poisson_ratio\n"
                         : "\ntime_s,strain,stress_pa,error\n");
      EXPECT_HAS(results_table(result), "stress (MPa)");
      fs::remove_all(out("out"));
    }
  }
}

/// The column `error` is the true error of a row, divided by the largest stress until then.
TEST_F(History, TheErrorOfAStepIsTheDifference) {
  const Case& c = cases().front();
  const RunResult result = run(read_scene(column(c.keys + in_time, "method = \"explicit\"\n")), out("out"));
  double largest = 0;
  for (const auto& p : std::get<experiments::SteppedResponse>(result.found).points) {
    largest = std::max(largest, std::abs(p.stress_pa));
    // the spectrum has an error of at most 1e-5, which is added
    EXPECT_NEAR(p.error, std::abs(p.stress_pa - law_stress(c.strain, p.time_s)) / largest, 3e-5) << p.time_s;
  }
}

TEST_F(History, ATableInAFileIsTheTableInTheScene) {
  const Case& c = cases()[2];
  const auto rows = [&](const std::string& loading) {
    run(read_scene(column(loading + in_time, "")), out("out"));
    return read(out("out") / "history.csv");
  };
  const std::string expected = rows(c.keys), from_file = "drive = \"table\"\nfile = \"strains.csv\"\n";
  write(folder_ / "strains.csv",
        "# measured\ntime_s,force_n,strain\n0,5,0\n1e-3,7,1e-5\n1.5e-3,7,1e-5\n3e-3,0,-2e-5\n");
  EXPECT_TRUE(rows(from_file) == expected);
  write(folder_ / "strains.csv", "\xEF\xBB\xBFstrain, time_s\r\n1e-5, 1e-3\r\n1e-5, 1.5e-3\r\n-2e-5, 3e-3");
  EXPECT_TRUE(rows(from_file) == expected);
}

TEST_F(History, ARunInPiecesGivesTheBitsOfOne) {
  const std::string from_file = "drive = \"table\"\nfile = \"strains.csv\"\n" + in_time;
  const std::string rows = "time_s,strain\n1e-3,1e-5\n3e-3,-2e-5\n";
  write(folder_ / "strains.csv", rows);
  const Scene asked = read_scene(column(from_file, "method = \"explicit\"\n"));
  run(asked, out("one"));
  int interrupted = 0;
  for (const int stop : {1, 5, 11, 0}) interrupted += run_until(asked, "pieces", stop, interrupted > 0);
  EXPECT_EQ(interrupted, 3);
  EXPECT_TRUE(read(out("pieces") / "history.csv") == read(out("one") / "history.csv"));
  EXPECT_FALSE(fs::exists(out("pieces") / "checkpoint.h5"));

  ASSERT_TRUE(run_until(asked, "other", 5));
  write(folder_ / "strains.csv", "time_s,strain\n1e-3,1e-5\n3e-3,-3e-5\n");
  const Scene changed = read_scene(folder_ / "scene.toml");
  EXPECT_HAS(message_of([&] { run(changed, out("other"), {}, true); }), "file in [loading]: found a load with the ");
}

TEST_F(History, WrongScenesAreRefused) {
  const std::string time = "duration = 1\n", pulse = time + "drive = \"haversine\"\n",
                    table = time + "drive = \"table\"\n";
  EXPECT_HAS(refusal(time), "[loading] drive: found nothing");
  EXPECT_HAS(refusal(time + "drive = \"saw\"\n"), "found \"saw\", expected one of \"haversine\", \"table\", \"ramp\"");
  EXPECT_HAS(refusal("drive = \"haversine\"\n"), "[loading] duration: found nothing");
  EXPECT_HAS(refusal(pulse + "strain = 1e-4\n"), "[loading] pulse: found nothing, expected this key, which drive");
  EXPECT_HAS(refusal(pulse + "strain = 0\npulse = 0.1\n"), "[loading] strain: found 0, expected a strain above -1");
  EXPECT_HAS(refusal(pulse + "strain = 1e-4\npulse = 0.1\nrate = 1\n"),
             "[loading] rate: found this key with drive = \"haversine\", expected only the keys of this drive: strain, "
             "pulse, rest, pulses");
  write(folder_ / "a.csv", "time_s,strain\n1,1e-4\n");
  EXPECT_HAS(refusal(pulse + "strain = 1e-4\npulse = 0.1\nfile = \"a.csv\"\n"), "[loading] file: found this key with");
  EXPECT_HAS(refusal(pulse + "strain = 1e-4\npulse = 1e-7\nrest = 1e-7\n"), "found more than 500000 pulses");
  EXPECT_HAS(refusal(pulse + "strain = 1e-4\npulse = 0.1\nsamples = 0\n"), "[loading] samples: found 0");
  EXPECT_HAS(refusal(time + "drive = \"ramp\"\nstrain = 1e-4\nramp = 0\n"), "[loading] ramp: found 0");
  EXPECT_HAS(refusal(time + "drive = \"constant_rate\"\nrate = -2\n"), "found a strain of -2 within the test");
  EXPECT_HAS(refusal(table), "[loading] times: found nothing, expected this key, or the key file");
  EXPECT_HAS(refusal(table + "times = [1, 2]\nstrains = [1e-4]\n"), "found 2 times and 1 strains");
  EXPECT_HAS(refusal(table + "times = [2, 1]\nstrains = [1e-4, 0]\n"), "found time 1 s and strain 0 in row 2");
  EXPECT_HAS(refusal(table + "times = [0, 1]\nstrains = [1e-4, 0]\n"), "expected a strain of 0 at time 0");
  EXPECT_HAS(refusal(table + "times = [0]\nstrains = [0]\n"), "expected a time after 0");
  EXPECT_HAS(refusal(table + "file = \"none.csv\"\n"), "[loading] file: found no file ");
}

TEST_F(History, WrongTablesAreRefusedByTheirLine) {
  const auto refused = [&](const std::string& text) {
    write(folder_ / "strains.csv", text);
    return refusal("duration = 1\ndrive = \"table\"\nfile = \"strains.csv\"\n");
  };
  EXPECT_HAS(refused("time,strain\n1,1e-4\n"),
             "strains.csv:1: columns: found time,strain, expected columns time_s and");
  EXPECT_HAS(refused("# only a comment\n"), "strains.csv: rows: found none");
  EXPECT_HAS(refused("time_s,strain\n"), "strains.csv: rows: found none");
  EXPECT_HAS(refused("time_s,strain\n1,1e-4\n2,x\n"), "strains.csv:3: strain: found x, expected a strain above -1");
  EXPECT_HAS(refused("time_s,strain\n1,1e-4\n2\n"), "strains.csv:3: strain: found 1 cells, expected at least 2");
  EXPECT_HAS(refused("time_s,strain\n-1,1e-4\n"), "strains.csv:2: time_s: found -1, expected a number that is not");
  EXPECT_HAS(refused("time_s,strain\n1,nan\n"), "strains.csv:2: strain: found nan");
  EXPECT_HAS(refused("time_s,strain\n1,1e-4\n1,2e-4\n"), "strains.csv:3: time_s: found 1 after 1, expected times that");
  EXPECT_HAS(refused("time_s,strain\n0,1e-4\n1,2e-4\n"), "strains.csv:2: strain: found 0.0001, expected 0 at time 0");
  EXPECT_HAS(refused("time_s,strain\n0,0\n"), "[loading] file: found 1 times and 1 strains, expected a time after 0");
}

}  // namespace
}  // namespace macadam::test
