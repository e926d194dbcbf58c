// SPDX-License-Identifier: GPL-3.0-or-later
// json.cpp  Writes and reads Google Benchmark's format: a context, and one entry per repetition of each row.
#include "host/tools/bench/json.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <numeric>
#include <thread>

#include "macadam/error.hpp"

namespace macadam::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// Returns the seconds of a unit of time of Google Benchmark.
double factor_of(const std::string& unit) {
  return unit == "ns" ? 1e-9 : unit == "us" ? 1e-6 : unit == "ms" ? 1e-3 : 1;
}

/// Returns the mean and the sample standard deviation (with divisor n − 1), which is 0 for a single value.
std::pair<double, double> mean_and_deviation(const std::vector<double>& list) {
  const double n = static_cast<double>(list.size()), mean = std::accumulate(list.begin(), list.end(), 0.0) / n;
  double squares = 0;
  for (const double x : list) squares += (x - mean) * (x - mean);
  return {mean, list.size() > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

}  // namespace

Json context_of(const MachineSpeed& machine, Backend backend) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  Json out;
  out["date"] = fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(std::time(nullptr)));
  out["host_name"] = host;
  out["executable"] = "macadam bench";
  out["num_cpus"] = std::thread::hardware_concurrency();
  out["mhz_per_cpu"] = 0;  // not determined, because the frequency changes during the run
  out["cpu_scaling_enabled"] = false;
  out["caches"] = Json::array();
  out["load_avg"] = Json::array();
  double load = 0;
  if (getloadavg(&load, 1) == 1) out["load_avg"].push_back(load);
  out["library_build_type"] = MACADAM_BUILD_TYPE;
  out["macadam_version"] = version();
  out["macadam_commit"] = MACADAM_COMMIT;
  out["processor"] = processor();
  out["backend"] = to_string(backend);
  out["copy_bytes_per_s"] = machine.copy;
  for (const DeviceSpeed& d : machine.devices) {
    out["devices"].push_back({{"name", d.name},
                              {"multiprocessors", d.multiprocessors},
                              {"driver_cuda", d.driver},
                              {"runtime_cuda", d.runtime},
                              {"clock_hz", d.clock},
                              {"cache_bytes", d.cache_bytes},
                              {"copy_bytes_per_s", d.copy},
                              {"cache_bytes_per_s", d.cache},
                              {"shared_bytes_per_s", d.shared}});
  }
  return out;
}

Json json_of(const Json& context, const std::vector<BenchRow>& rows) {
  Json out;
  out["context"] = context;
  out["benchmarks"] = Json::array();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const BenchRow& row = rows[k];
    const auto entry = [&](const std::string& name, double seconds) {
      Json e = {{"name", name},
                {"family_index", k},
                {"per_family_instance_index", 0},
                {"run_name", row.name},
                {"run_type", "iteration"},
                {"repetitions", row.seconds.size()},
                {"threads", row.threads},
                {"iterations", row.iterations},
                {"real_time", 1e6 * seconds},
                {"cpu_time", 1e6 * seconds},
                {"time_unit", "us"},
                {"label", row.label}};
      for (const auto& [counter, value] : row.counters) e[counter] = value;
      return e;
    };
    for (std::size_t r = 0; r < row.seconds.size(); ++r) {
      out["benchmarks"].push_back(entry(row.name, row.seconds[r]));
      out["benchmarks"].back()["repetition_index"] = r;
    }
    if (row.seconds.size() < 2) continue;
    const auto [mean, deviation] = mean_and_deviation(row.seconds);
    const auto aggregate = [&](const char* what, const char* unit, double seconds) {
      Json e = entry(row.name + "_" + what, seconds);
      e["run_type"] = "aggregate";
      e["aggregate_name"] = what;
      e["aggregate_unit"] = unit;
      out["benchmarks"].push_back(std::move(e));
    };
    aggregate("mean", "time", mean);
    aggregate("median", "time", median(row.seconds));
    aggregate("stddev", "time", deviation);
    aggregate("cv", "percentage", 1e-6 * deviation / mean);  // a ratio: 1e-6 cancels the conversion to microseconds
  }
  return out;
}

std::vector<BenchRow> read_rows(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& found) {
    throw InputError(file.string() + ": found " + found + ", expected a file of macadam bench --json");
  };
  std::ifstream in(file);
  if (!in) refuse("no file that can be read");
  const nlohmann::json all = nlohmann::json::parse(in, nullptr, false);
  if (!all.is_object() || !all.contains("benchmarks") || !all["benchmarks"].is_array()) refuse("no list of benchmarks");
  std::vector<BenchRow> out;
  for (const auto& entry : all["benchmarks"]) {
    if (!entry.is_object() || entry.value("run_type", "iteration") != "iteration") continue;
    if (!entry.contains("name") || !entry["name"].is_string() || !entry.contains("real_time") ||
        !entry["real_time"].is_number() || !(entry["real_time"].get<double>() > 0))
      refuse("an entry without a name or a time");
    const std::string name = entry["name"];
    if (out.empty() || out.back().name != name)
      out.push_back({.name = name, .label = "", .seconds = {}, .counters = {}});
    out.back().seconds.push_back(factor_of(entry.value("time_unit", "ns")) * entry["real_time"].get<double>());
  }
  return out;
}

std::vector<Comparison> compare(const std::vector<BenchRow>& before, const std::vector<BenchRow>& now) {
  constexpr double least = 1.02;
  std::vector<Comparison> out;
  for (const BenchRow& row : now) {
    const auto old = std::find_if(before.begin(), before.end(), [&](const BenchRow& b) { return b.name == row.name; });
    if (old == before.end()) continue;
    const auto beyond = [&](const BenchRow& slow, const BenchRow& fast) {
      return median(slow.seconds) > least * median(fast.seconds) &&
             *std::min_element(slow.seconds.begin(), slow.seconds.end()) >
                 *std::max_element(fast.seconds.begin(), fast.seconds.end());
    };
    out.push_back({row.name, median(old->seconds), median(row.seconds), beyond(row, *old), beyond(*old, row)});
  }
  return out;
}

}  // namespace macadam::bench
