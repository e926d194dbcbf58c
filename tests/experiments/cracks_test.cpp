// SPDX-License-Identifier: GPL-3.0-or-later
// cracks_test.cpp  Tests how broken contact points are reported in tables, summary.json, cracks.csv and fields, and
// runs that end when the specimen breaks in two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/files/checkpoint_file.hpp"
#include "host/simulation/forecast.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

/// Strength and modulus of the bonds [Pa]; contacts with walls have the same modulus.
constexpr double strength = 1e5, modulus = 1e9;

/// Returns the lines of a CSV file that follow the line `head`, each as a list of its fields.
std::vector<std::vector<std::string>> rows_of(const std::string& text, const std::string& head) {
  std::vector<std::vector<std::string>> out;
  std::istringstream in(text);
  bool found = false;
  for (std::string line; std::getline(in, line);) {
    if (found) {
      std::istringstream fields(line);
      out.emplace_back();
      for (std::string field; std::getline(fields, field, ',');) out.back().push_back(field);
    }
    found = found || line == head;
  }
  EXPECT_TRUE(found) << head;
  return out;
}

class CracksOfATest : public TestFolder {
 protected:
  /// Returns a scene of a column of spheres, one per cube of 10 mm. Every facet is a square with 5 contact points.
  Scene column(int spheres, const std::string& loading, const std::string& more = "") const {
    std::string particles = "id,x,y,z,radius,phase,body\n";
    for (int i = 0; i < spheres; ++i)
      particles += fmt::format("{},0.005,0.005,{},0.005,mastic,-1\n", i, 0.005 + 0.01 * i);
    write(folder_ / "column.csv", particles);
    write(
        folder_ / "column.toml",
        fmt::format("[specimen]\nfile = \"column.csv\"\nbox = [0.01, 0.01, {}]\n[materials.mastic]\ndensity = 2000.0\n"
                    "[[contacts]]\npair = \"M-M\"\nlaw = \"brittle_bond\"\nE = 1e9\ntensile_strength = 1e5\n"
                    "alpha = 0.1\n[[contacts]]\npair = \"M-W\"\nlaw = \"elastic\"\nE = 1e9\n[loading]\n{}"
                    "[solver]\nmethod = \"explicit\"\nbackend = \"cpu\"\n{}",
                    0.01 * spheres, loading, more));
    return read_scene(folder_ / "column.toml");
  }
  /// Returns the loading of a tensile test at a constant rate that ends when the specimen breaks.
  static std::string pulled(int points) {
    return fmt::format("kind = \"monotonic\"\nrate = 0.1\nstrain = 2e-3\npoints = {}\n", points);
  }
  Scene bonded(const std::string& more = "", int points = 40) const { return bonded_scene(pulled(points), more); }
  /// Returns a scene of the specimen t8 with brittle bonds between all particles; it breaks gradually.
  Scene bonded_scene(const std::string& loading, const std::string& more) const {
    std::string text =
        "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[materials.aggregate]\n"
        "density = 2630.0\n[materials.mastic]\ndensity = 2110.0\n";
    for (const char* pair : {"M-M", "M-A", "A-A"}) {
      text += fmt::format(
          "[[contacts]]\npair = \"{}\"\nlaw = \"brittle_bond\"\nE = 1e10\nalpha = 0.1\ntensile_strength = 3e6\n"
          "shear_strength = 8e5\n",
          pair);
    }
    for (const char* pair : {"A-W", "M-W"})
      text += fmt::format("[[contacts]]\npair = \"{}\"\nlaw = \"elastic\"\nE = 1e10\nalpha = 0.1\n", pair);
    write(folder_ / "bonds.toml", text + "[loading]\n" + loading +
                                      "[solver]\nmethod = \"explicit\"\nbackend = \"cpu\"\ndensity_scaling = 1e4\n" +
                                      more);
    return read_scene(folder_ / "bonds.toml");
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(read(out(name) / "summary.json"));
  }
};

constexpr const char* crack_head = "contact,a,b,pair,x,y,z,nx,ny,nz,area_m2,mode,time_s";
constexpr const char* monotonic_head =
    "time_s,strain,stress_pa,secant_pa,error,bottom_pa,kinetic_j,broken_points,poisson_ratio";

// All bonds of the column have the same stress, so one contact breaks first, with all five points at once. The test
// then ends, and every output must report this break.
TEST_F(CracksOfATest, AColumnBreaksAtTheStrengthOfItsBonds) {
  const Scene asked = column(4, "kind = \"monotonic\"\nrate = 0.002\nstrain = 1.5e-4\npoints = 200\n",
                             "[output]\nfields = [\"contacts\"]\nevery = 60\nformat = \"vtp\"\n");
  const RunResult result = run(asked, out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.rupture);
  ASSERT_LT(found.points.size(), 200u) << "the test ends where the column is in two";
  // Damping adds 0.1 to 0.3 % of the strength to the stress at the top wall. The peak of the stress is determined
  // between two points, which are 0.75 % apart.
  ASSERT_TRUE(found.peak);
  EXPECT_NEAR(found.peak->stress_pa / strength, 1, 3e-3);
  EXPECT_NEAR(found.peak->strain / (strength / modulus), 1, 3e-3);
  EXPECT_EQ(found.rupture->time_s, found.points.back().time_s);
  EXPECT_EQ(found.rupture->strain_before, found.points.at(found.points.size() - 2).strain);
  ASSERT_TRUE(found.cracks);
  EXPECT_EQ(found.cracks->points(), 5);
  EXPECT_EQ(found.cracks->breakable(), 15);

  const nlohmann::json all = summary("out"), test = all.at("results").at(0), bonds = all.at("cracks").at("M-M");
  EXPECT_EQ(all.at("status"), "done");
  // The only warning concerns the inertia in the first rows, because the load begins at once. The rupture is a result,
  // not a warning.
  ASSERT_EQ(all.at("warnings").size(), 1u) << all.at("warnings");
  EXPECT_HAS(all.at("warnings").at(0).get<std::string>(), "the error is above 1 %");
  EXPECT_EQ(test.at("strength_pa"), found.peak->stress_pa);
  EXPECT_EQ(test.at("strain_at_peak"), found.peak->strain);
  EXPECT_EQ(test.at("points").back().at("broken_points"), 5);
  EXPECT_EQ(test.at("points").front().at("broken_points"), 0);
  EXPECT_HAS(test.at("rupture").at("words").get<std::string>(),
             "no intact contact path joins the bottom and the top wall");
  EXPECT_EQ(all.at("cracks").size(), 1u) << "contacts with walls cannot break here";
  EXPECT_EQ(bonds.at("points"), 5);
  EXPECT_EQ(bonds.at("tension"), 5);
  EXPECT_EQ(bonds.at("shear"), 0);
  EXPECT_NEAR(bonds.at("area_m2").get<double>(), 1e-4, 1e-16);
  EXPECT_EQ(bonds.at("first_s"), found.rupture->time_s);

  EXPECT_EQ(results_table(result).rfind("strength 0.1", 0), 0u) << results_table(result);
  EXPECT_HAS(results_table(result), "The specimen broke between t = ");
  EXPECT_HAS(results_table(result), "5 of 15 contact points that can break are broken");
  EXPECT_HAS(results_table(result), "M-M 5 (5 in tension, 0 in shear)");

  const auto table = rows_of(read(out("out") / "monotonic.csv"), monotonic_head);
  ASSERT_EQ(table.size(), found.points.size());
  constexpr std::size_t broken = 7;  // column
  EXPECT_EQ(table.back().at(broken), "5");
  EXPECT_EQ(table.at(table.size() - 2).at(broken), "0");
  const auto events = rows_of(read(out("out") / "cracks.csv"), crack_head);
  ASSERT_EQ(events.size(), 5u);
  for (const auto& event : events) {
    EXPECT_EQ(event.at(0), events.front().at(0)) << "one contact";
    EXPECT_EQ(std::stoi(event.at(2)) - std::stoi(event.at(1)), 1);
    EXPECT_EQ(event.at(3), "M-M");
    EXPECT_NEAR(std::stod(event.at(6)), 0.01 * std::stod(event.at(2)), 1e-9) << "half-way between the centres";
    EXPECT_EQ(event.at(9), "1");
    EXPECT_EQ(event.at(11), "tension");
    EXPECT_EQ(std::stod(event.at(12)), found.rupture->time_s);
  }
  // frames at samples 0, 60 and 120, and the last one
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(out("out") / "fields")) {
    if (entry.path().extension() != ".vtp") continue;
    ++frames;
    EXPECT_HAS(read(entry.path()), "Name=\"broken\"");
  }
  EXPECT_EQ(frames, 4);
}

// In the second half of a cycle the wall pulls with an amplitude of 1.5 times the strain at which the bonds break. It
// reaches this strain at sin(2πft) = −2/3, which is at 0.6161 of the first cycle. The abrupt start causes waves, which
// change the strain of the bonds by up to 2πfAH/c = 8 % of the amplitude A at the higher frequency (H: height, c: wave
// speed).
TEST_F(CracksOfATest, ACyclicTestThatBreaksTheSpecimenEndsTheFrequency) {
  const RunResult result =
      run(column(4, "kind = \"cyclic\"\nfrequencies = [100.0, 200.0]\nstrain_amplitude = 1.5e-4\n"), out("out"));
  ASSERT_EQ(result.stepped().frequencies.size(), 2u) << "each frequency begins with an intact specimen";
  const nlohmann::json all = summary("out");
  const auto events = rows_of(read(out("out") / "cracks.csv"), std::string("frequency_hz,") + crack_head);
  ASSERT_EQ(events.size(), 10u);
  // the first warning says that the law has no complex stiffness
  ASSERT_EQ(all.at("warnings").size(), 3u) << all.at("warnings");
  for (std::size_t i = 0; i < 2; ++i) {
    const experiments::SteppedFrequency& f = result.stepped().frequencies[i];
    ASSERT_TRUE(f.rupture);
    ASSERT_TRUE(f.cracks);
    EXPECT_EQ(f.cracks->points(), 5);
    EXPECT_EQ(f.cracks->breakable(), 15);
    const double looks = 0.02;  // time between two counts of broken points [cycles]
    const double wave = 0.04;   // time in which the strain changes by more than the waves change it [cycles]
    EXPECT_NEAR(f.rupture->time_s * f.frequency_hz, 0.6161 + 0.5 * looks, wave + 0.5 * looks);
    EXPECT_NEAR((f.rupture->time_s - f.rupture->time_before_s) * f.frequency_hz, looks, 1e-9);
    EXPECT_NEAR(f.steps * f.dt_s, f.rupture->time_s, 1e-3 * f.dt_s);
    EXPECT_TRUE(std::isnan(f.stiffness.e_star_pa));

    const nlohmann::json& test = all.at("results").at(i);
    EXPECT_TRUE(test.at("e_star_pa").is_null());
    EXPECT_TRUE(test.at("phase_deg").is_null());
    EXPECT_EQ(test.at("cracks").at("M-M").at("tension"), 5);
    EXPECT_EQ(test.at("cracks").at("M-M").at("first_s"), f.rupture->time_s);
    EXPECT_HAS(test.at("rupture").at("words").get<std::string>(),
               "no intact contact path joins the bottom and the top wall");
    const std::string warning = all.at("warnings").at(i + 1);
    EXPECT_EQ(warning.rfind(fmt::format("{} Hz: The specimen broke between t = ", f.frequency_hz), 0), 0u) << warning;
    EXPECT_HAS(warning, "|E*| and phi could not be measured");
    EXPECT_HAS(results_table(result), fmt::format("{} Hz: The specimen broke between t = ", f.frequency_hz));
    for (std::size_t k = 5 * i; k < 5 * i + 5; ++k) {
      EXPECT_EQ(std::stod(events[k].at(0)), f.frequency_hz);
      EXPECT_EQ(std::stod(events[k].at(13)), f.rupture->time_s);
    }
  }
}

/// A cyclic test below the strength breaks nothing and measures the modulus of the bonds. The inertia of the column
/// changes this modulus by less than (2πfH/c)² = 0.13 % (H: height, c: wave speed).
TEST_F(CracksOfATest, ACyclicTestBelowTheStrengthBreaksNoBond) {
  const RunResult result =
      run(column(4, "kind = \"cyclic\"\nfrequencies = [100.0]\nstrain_amplitude = 5e-5\n"), out("out"));
  const experiments::SteppedFrequency& f = result.stepped().frequencies.at(0);
  EXPECT_FALSE(f.rupture);
  EXPECT_EQ(f.cracks.value().points(), 0);
  EXPECT_NEAR(f.stiffness.e_star_pa / modulus, 1, 5e-3);
  EXPECT_TRUE(rows_of(read(out("out") / "cracks.csv"), std::string("frequency_hz,") + crack_head).empty());
  EXPECT_EQ(summary("out").at("results").at(0).at("cracks").at("M-M").at("points"), 0);
  EXPECT_HAS(results_table(result), "0 of 15 contact points that can break are broken");
}

/// Interruptions change neither the files nor the counts of a cyclic test that breaks some bonds.
TEST_F(CracksOfATest, ACyclicTestInPiecesBreaksTheSamePoints) {
  const Scene asked = bonded_scene(
      "kind = \"cyclic\"\nfrequencies = [10.0, 40.0]\nstrain_amplitude = 2.5e-4\ncycles = 2\n"
      "samples_per_cycle = 100\n",
      "");
  const RunResult whole = run(asked, out("whole"));
  for (const experiments::SteppedFrequency& f : whole.stepped().frequencies) {
    EXPECT_GT(f.cracks.value().points(), 0) << f.frequency_hz;
    EXPECT_FALSE(f.rupture) << f.frequency_hz;
    EXPECT_GT(f.stiffness.e_star_pa, 0);
  }
  int interrupted = 0;
  for (const int stop : {2, 9, 20, 15, 0}) interrupted += run_until(asked, "pieces", stop, interrupted > 0);
  EXPECT_EQ(interrupted, 4);
  EXPECT_EQ(read(out("pieces") / "response.csv"), read(out("whole") / "response.csv"));
  EXPECT_EQ(read(out("pieces") / "cracks.csv"), read(out("whole") / "cracks.csv"));
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(summary("pieces").at("results").at(i).at("cracks"), summary("whole").at("results").at(i).at("cracks"));
  }
}

/// Compression does not break bonds, so the result has neither rupture nor strength.
TEST_F(CracksOfATest, CompressionBreaksNoBondAndReachesNoStrength) {
  const RunResult result =
      run(column(4, "kind = \"monotonic\"\nrate = -0.01\nstrain = -2e-4\npoints = 20\n"), out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  EXPECT_EQ(found.points.size(), 20u);
  EXPECT_FALSE(found.rupture);
  EXPECT_EQ(found.cracks->points(), 0);
  const nlohmann::json test = summary("out").at("results").at(0);
  EXPECT_TRUE(test.at("strength_pa").is_null());
  EXPECT_TRUE(test.at("strain_at_peak").is_null());
  EXPECT_TRUE(summary("out").at("cracks").at("M-M").at("first_s").is_null());
  EXPECT_EQ(results_table(result).rfind("largest stress -0.2", 0), 0u) << results_table(result);
  EXPECT_HAS(results_table(result), "the strength was not reached");
  EXPECT_TRUE(rows_of(read(out("out") / "cracks.csv"), crack_head).empty());
}

/// A creep stress of 1.5 times the strength breaks the specimen before the first point; the summary reports the break.
TEST_F(CracksOfATest, ACreepAboveTheStrengthSaysThatTheSpecimenBroke) {
  const RunResult result =
      run(column(2, "kind = \"creep\"\nstress = 1.5e5\ntimes = [\"1 ms\", \"20 ms\"]\npoints = 20\n"), out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.rupture);
  EXPECT_EQ(found.points.size(), 1u) << "it breaks before the first point";
  EXPECT_EQ(found.rupture->time_before_s, 0);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_HAS(result.warnings.front(), "The specimen broke between t = 0 s and 0.001");
  EXPECT_HAS(results_table(result), "5 of 5 contact points that can break are broken");
  EXPECT_EQ(result.warnings.front().find("density_scaling"), std::string::npos);
  EXPECT_EQ(summary("out").at("results").at(0).at("points").size(), 1u);
  EXPECT_HAS(read(out("out") / "creep.csv"), ",error,top_pa,bottom_pa,kinetic_j,broken_points,poisson_ratio\n");
}

/// A later run without brittle bonds in the same folder removes cracks.csv.
TEST_F(CracksOfATest, ALaterSceneWithoutBondsLeavesNoCracks) {
  run(column(2, "kind = \"monotonic\"\nrate = 0.01\nstrain = 2e-4\npoints = 10\n"), out("out"));
  EXPECT_TRUE(fs::exists(out("out") / "cracks.csv"));
  const Scene elastic = read_scene(write_t8("kind = \"monotonic\"\nrate = 0.01\nstrain = 2e-5\npoints = 2\n",
                                            "method = \"explicit\"\nbackend = \"cpu\"\n"));
  run(elastic, out("out"));
  EXPECT_FALSE(fs::exists(out("out") / "cracks.csv"));
  EXPECT_FALSE(summary("out").contains("cracks"));
  EXPECT_FALSE(summary("out").at("results").at(0).contains("strength_pa"));
  EXPECT_EQ(read(out("out") / "monotonic.csv").find("broken_points"), std::string::npos);
}

// In a specimen that breaks gradually, all backends count the same numbers of broken points. Their stresses differ by a
// fraction of about 1e-13. So a point could break at another sample only if its stress came that close to the strength.
TEST_F(CracksOfATest, EveryBackendCountsTheSame) {
  Scene asked = bonded();
  const auto found = [&](Backend backend) {
    asked.solver.backend = backend;
    return std::get<SteppedResponse>(run(asked, out(to_string(backend))).found);
  };
  const SteppedResponse expected = found(Backend::cpu);
  EXPECT_GT(expected.cracks->points(), 20);
  std::int64_t tension = 0, shear = 0;
  for (const auto& pair : expected.cracks->by_pair) tension += pair.tension, shear += pair.shear;
  EXPECT_GT(tension, 0);
  EXPECT_GT(shear, 0);
  EXPECT_EQ(tension + shear, expected.cracks->points());
  std::vector<Backend> others = tested_backends();
  std::replace(others.begin(), others.end(), Backend::cpu, Backend::reference);
  for (const Backend backend : others) {
    const SteppedResponse other = found(backend);
    ASSERT_EQ(other.points.size(), expected.points.size()) << to_string(backend);
    for (std::size_t i = 0; i < other.points.size(); ++i)
      EXPECT_EQ(other.points[i].broken_points, expected.points[i].broken_points) << to_string(backend) << " " << i;
    EXPECT_EQ(read(out(to_string(backend)) / "cracks.csv"), read(out("cpu") / "cracks.csv"));
    EXPECT_EQ(summary(to_string(backend)).at("cracks"), summary("cpu").at("cracks"));
  }
}

/// The bytes of the files depend neither on the number of threads nor on interruptions.
TEST_F(CracksOfATest, AnyNumberOfThreadsAndAnyPiecesGiveTheSameBytes) {
  const Scene asked = bonded("threads = 1\n", 200);
  run(asked, out("one"));
  EXPECT_TRUE(summary("one").at("results").at(0).contains("rupture"));
  const auto expect_same = [&](const std::string& name) {
    EXPECT_EQ(read(out(name) / "monotonic.csv"), read(out("one") / "monotonic.csv"));
    EXPECT_EQ(read(out(name) / "cracks.csv"), read(out("one") / "cracks.csv"));
    EXPECT_EQ(summary(name).at("cracks"), summary("one").at("cracks"));
  };
  int interrupted = 0;
  for (const int stop : {2, 9, 20, 15, 0}) interrupted += run_until(asked, "pieces", stop, interrupted > 0);
  EXPECT_EQ(interrupted, 4);
  expect_same("pieces");
  run(bonded("threads = 2\n", 200), out("two"));
  expect_same("two");
}

/// The forecast computes the size of cracks.csv from the number of contacts that can break.
TEST_F(CracksOfATest, TheForecastOfTheListFollowsFromTheContacts) {
  const Scene asked = bonded();
  const auto bytes = [](const Scene& scene) {
    const Forecast found = forecast(scene);
    const auto at = std::ranges::find(found.files, "cracks.csv") - found.files.begin();
    return found.file_bytes.at(static_cast<std::size_t>(at));
  };
  run(asked, out("out"));
  EXPECT_NEAR(std::log(bytes(asked) / static_cast<double>(fs::file_size(out("out") / "cracks.csv"))), 0, std::log(2));
  // the column has 4 spheres, t8 has 175 particles
  const Scene small = column(4, "kind = \"monotonic\"\nrate = 0.002\nstrain = 1.5e-4\npoints = 200\n");
  EXPECT_LT(bytes(small), 0.05 * bytes(asked));
}

/// Break events in a checkpoint that refer to wrong points, times or kinds are refused.
TEST_F(CracksOfATest, DamagedEventsInACheckpointAreRefused) {
  const Scene asked = bonded("", 200);
  ASSERT_TRUE(run_until(asked, "out", 20));
  const Checkpoint whole = read_checkpoint(out("out") / "checkpoint.h5");
  for (const std::vector<double>& event : {std::vector{-1.0, 0.0, 1.0, 0.0},
                                           {0.0, std::nan(""), 1.0, 0.0},
                                           {0.0, 1e9, 1.0, 0.0},
                                           {1e9, 0.0, 1.0, 0.0},
                                           {0.0, 0.0, 3.0, 0.0},
                                           {0.0, 0.0}}) {
    Checkpoint damaged = whole;
    for (StateArray& array : damaged.arrays) {
      if (array.name == "cracks") array.values = event;
    }
    write_checkpoint(out("out") / "checkpoint.h5", damaged);
    EXPECT_THROW(run(asked, out("out"), {}, true), InputError);
    EXPECT_HAS(message_of([&] { run(asked, out("out"), {}, true); }), "checkpoint");
  }
}

}  // namespace
}  // namespace macadam::test
