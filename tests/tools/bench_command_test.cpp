// SPDX-License-Identifier: GPL-3.0-or-later
// bench_command_test.cpp  Tests macadam bench: the rows have the right meaning, and the JSON has the format of Google
// Benchmark.
#include <algorithm>
#include <cmath>
#include <set>

#include "host/tools/bench/json.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using nlohmann::json;

class BenchCommand : public Program {
 protected:
  Outcome bench(const std::string& options) const {
    return macadam("bench --backend cpu --threads 1 --repetitions 3 --seconds 0.002 " + options);
  }
  json read_json(const std::string& name) const { return json::parse(read(folder_ / name)); }
};

TEST_F(BenchCommand, WritesWhatItTimedAsGoogleBenchmarkDoes) {
  write_scene();
  const Outcome outcome =
      bench(fmt::format("{} lattice:500 --loads 1 --json {}", path("scene.toml"), path("now.json")));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json all = read_json("now.json");
  for (const char* key : {"date", "host_name", "num_cpus", "library_build_type", "macadam_commit", "processor"})
    EXPECT_TRUE(all["context"].contains(key)) << key;
  EXPECT_GT(all["context"]["copy_bytes_per_s"], 1e8);
  std::map<std::string, int> repetitions;
  for (const json& entry : all["benchmarks"]) {
    EXPECT_GT(entry["real_time"].get<double>(), 0);
    EXPECT_EQ(entry["time_unit"], "us");
    if (entry["run_type"] == "aggregate") continue;
    EXPECT_EQ(entry["name"], entry["run_name"]);
    ++repetitions[entry["name"]];
  }
  ASSERT_EQ(repetitions.size(), 2u * (3 * 2 + 1));  // scenes × (precisions × geometries + a harmonic row)
  for (const auto& [name, number] : repetitions) {
    EXPECT_EQ(number, 3) << name;
    EXPECT_HAS(outcome.out, name);
  }
  std::vector<double> shares;  // time of the two parts of a step divided by the time of the whole step
  for (const json& entry : all["benchmarks"]) {
    if (!std::string(entry["name"]).starts_with("step/") || entry["run_type"] == "aggregate") continue;
    const double step = entry["real_time"].get<double>(), contacts = entry["contacts"];
    EXPECT_GT(contacts, entry["particles"].get<double>());
    EXPECT_GT(entry["bytes_per_contact"].get<double>(), 100);
    const double parts = entry["part_us bodies"].get<double>() + entry["part_us contacts"].get<double>();
    EXPECT_GT(parts, 0) << entry;
    shares.push_back(parts / step);
  }
  // Other work on the machine disturbs a repetition of 2 ms, so a single ratio is not reliable. The test uses the
  // median of all ratios.
  ASSERT_EQ(shares.size(), 2u * 3 * 2 * 3);  // scenes × precisions × geometries × repetitions
  std::ranges::nth_element(shares, shares.begin() + shares.size() / 2);
  EXPECT_GT(shares[shares.size() / 2], 0.2);
  EXPECT_LT(shares[shares.size() / 2], 5);
}

/// The row of the preparation lists the times of its four parts, which add up to the time of the row.
TEST_F(BenchCommand, TimesWhatComesBeforeAStep) {
  const Outcome outcome =
      bench("lattice:500 --only preparation --precision double --geometry fixed --json " + path("now.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json all = read_json("now.json");
  const json& entry = all["benchmarks"].front();
  EXPECT_EQ(entry["name"], "preparation/lattice:500/cpu/condensed/double/fixed/threads:1");
  EXPECT_GT(entry["contacts"], entry["particles"].get<double>());
  double parts = 0;
  for (const char* part : {"tessellation", "network", "critical step", "stepper"}) {
    EXPECT_GT(entry[std::string("part_us ") + part].get<double>(), 0) << part;
    parts += entry[std::string("part_us ") + part].get<double>();
  }
  const json& last = all["benchmarks"][2];  // the third repetition, to which the parts belong
  EXPECT_NEAR(parts, last["real_time"].get<double>(), 1e-6 * parts);
}

/// Compared with recorded times that are a thousandth as long, the command reports slower rows and exits with 1.
/// Compared with longer times it succeeds. A damaged record is refused.
TEST_F(BenchCommand, SaysWhatBecameSlowerBeyondNoise) {
  ASSERT_EQ(bench("lattice:500 --only step --precision double --json " + path("now.json")).code, 0);
  json before = read_json("now.json");
  const auto against = [&](double factor) {
    for (json& entry : before["benchmarks"]) entry["real_time"] = factor * entry["real_time"].get<double>();
    write(folder_ / "before.json", before.dump());
    return bench("lattice:500 --only step --precision double --against " + path("before.json"));
  };
  const Outcome slower = against(1e-3);
  EXPECT_EQ(slower.code, 1);
  EXPECT_HAS(slower.out, "  slower");
  EXPECT_HAS(slower.err, "slower than");
  const Outcome faster = against(1e6);
  EXPECT_EQ(faster.code, 0) << faster.err;
  EXPECT_HAS(faster.out, "  faster");
  write(folder_ / "before.json", "{\"benchmarks\": [{\"name\": \"x\"}]}");
  const Outcome wrong = bench("lattice:500 --against " + path("before.json"));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_HAS(wrong.err, "found an entry without a name or a time");
  EXPECT_EQ(bench("lattice:500 --against " + path("nowhere.json")).code, 2);
}

/// The name of a row holds the scene and the number of Kelvin units.
TEST_F(BenchCommand, ARowHasTheNameOfItsSceneAndOfTheUnits) {
  const Outcome outcome =
      bench("lattice:5e2 --only step --precision double --geometry fixed --units 0,2 --json " + path("now.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::set<std::string> names;
  const json all = read_json("now.json");
  for (const json& entry : all["benchmarks"]) names.insert(entry["run_name"]);
  EXPECT_TRUE(names.contains("step/lattice:5e2/cpu/condensed/double/fixed/units:0/threads:1")) << json(names);
  EXPECT_TRUE(names.contains("step/lattice:5e2/cpu/condensed/double/fixed/units:2/threads:1")) << json(names);
}

TEST_F(BenchCommand, RefusesWhatItCannotTime) {
  for (const char* options : {"lattice:5", "lattice:many", "lattice:", "lattice:1e12", "--precision half", "--loads 9",
                              "--only both", "--device 0"}) {
    const Outcome outcome = bench(options);
    EXPECT_EQ(outcome.code, 2) << options << outcome.out;
    EXPECT_HAS(outcome.err, "found") << options;
  }
}

/// A row is slower or faster only if its repetitions do not overlap with the recorded ones and the medians differ by
/// more than about a hundredth.
TEST(BenchComparison, TakesNoiseForNoise) {
  const auto row = [](std::vector<double> seconds) {
    return std::vector<bench::BenchRow>{{.name = "a", .label = "", .seconds = std::move(seconds), .counters = {}}};
  };
  const auto verdict = [&](std::vector<double> before, std::vector<double> now) {
    const auto found = bench::compare(row(std::move(before)), row(std::move(now))).at(0);
    return found.slower ? 1 : found.faster ? -1 : 0;
  };
  EXPECT_EQ(verdict({1, 1.1, 1.2}, {1.05, 1.15, 1.3}), 0);        // the ranges overlap
  EXPECT_EQ(verdict({1, 1.01, 1.005}, {1.011, 1.015, 1.02}), 0);  // the medians differ by a hundredth
  EXPECT_EQ(verdict({1, 1.1, 1.2}, {1.3, 1.4, 1.5}), 1);
  EXPECT_EQ(verdict({1.3, 1.4, 1.5}, {1, 1.1, 1.2}), -1);
  EXPECT_EQ(bench::median({3, 1, 2}), 2);
  EXPECT_EQ(bench::median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(bench::compare(row({1}), {{.name = "b", .label = "", .seconds = {1}, .counters = {}}}).empty());
}

// The face-centred lattice of the benchmark is a normal contact network: an inner particle has twelve contacts, walls
// are at two ends, and the rows list every contact.
TEST(BenchLattice, IsANetwork) {
  const bench::BenchCase lattice = bench::lattice(4000, true);
  const std::size_t n = lattice.specimen.size();
  EXPECT_NEAR(static_cast<double>(n), 4000, 200);
  std::size_t most = 0, at_walls = 0;
  for (std::size_t i = 0; i < n; ++i) most = std::max(most, lattice.network.row(i).size());
  for (const Contact& c : lattice.network.contacts) {
    if (c.b >= 0) continue;
    ++at_walls;
    // A second moment is less than the area times the square of the distance from the centre to the wall (at least 0.32
    // mm).
    for (const double moment : {c.moments.ss, c.moments.tt}) EXPECT_LT(moment, c.area * c.arm_a * c.arm_a);
  }
  EXPECT_EQ(most, 12u);
  EXPECT_GT(at_walls, 2 * std::pow(static_cast<double>(n) / 4, 2.0 / 3));
  for (const auto& law : bench::elastic(lattice.laws)) {
    if (law) { EXPECT_TRUE(std::holds_alternative<laws::Elastic>(*law)); }
  }
  const LawTable units = bench::with_units(lattice.laws, 5);
  EXPECT_EQ(std::get<laws::GeneralisedKelvin>(*units[static_cast<std::size_t>(PairType::mm)]).E.size(), 5u);
}

}  // namespace
}  // namespace macadam::test
