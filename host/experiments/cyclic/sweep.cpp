// SPDX-License-Identifier: GPL-3.0-or-later
// sweep.cpp  Implements kind "sweep": solves the cyclic test's steady states over a range of frequencies and writes
// sweep.csv.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/frequency_summary.hpp"
#include "host/experiments/cyclic/methods.hpp"
#include "host/experiments/experiment.hpp"
#include "host/experiments/material_solution.hpp"
#include "host/files/result_files.hpp"
#include "host/scene/shift_keys.hpp"

namespace macadam {

using experiments::HarmonicFrequency;
using experiments::Sweep;
using experiments::SweepResult;

namespace {

void write_sweep(const std::filesystem::path& file, const Scene& scene, const SweepResult& found) {
  std::string text = fmt::format("# {}; error: relative difference of the two walls' reactions\n",
                                 modulus_words(scene.network.lateral_walls));
  text +=
      "temperature_c,frequency_hz,e_star_pa,phase_deg,storage_pa,loss_pa,log10_a_T,reduced_frequency_hz,residual,"
      "error\n";
  for (const HarmonicFrequency& f : found.points) {
    const double phase = f.stiffness.phase_deg * std::numbers::pi / 180, e_star = f.stiffness.e_star_pa;
    std::string temperature, shift, reduced;
    if (f.temperature_c) {
      temperature = fmt::format("{}", *f.temperature_c);
      if (const auto log10 = common_log10_shift(scene, *f.temperature_c)) {
        shift = fmt::format("{}", *log10);
        reduced = fmt::format("{}", f.frequency_hz * std::pow(10.0, *log10));
      }
    }
    const auto modulus = [](const Stiffness& s) {
      return std::polar(s.e_star_pa, s.phase_deg * std::numbers::pi / 180);
    };
    text += fmt::format("{},{},{},{},{},{},{},{},{:.2e},{:.2e}\n", temperature, f.frequency_hz, e_star,
                        f.stiffness.phase_deg, e_star * std::cos(phase), e_star * std::sin(phase), shift, reduced,
                        f.residual, std::abs(modulus(f.bottom) / modulus(f.stiffness) - 1.0));
  }
  write_whole(file, text);
}

/// Solves the steady states and writes a table of them whenever the summary is saved.
class PlannedSweep : public PlannedExperiment {
 public:
  PlannedSweep(TableOfSweep write, std::unique_ptr<PlannedExperiment> states)
      : write_(std::move(write)), states_(std::move(states)) {}

  void solve(const std::filesystem::path& out, const Saving& save, RunResult& result) override {
    states_->solve(
        out,
        [&](const std::string& status) {
          write_(out, std::get<SweepResult>(result.found));
          save(status);
        },
        result);
  }

 private:
  TableOfSweep write_;
  std::unique_ptr<PlannedExperiment> states_;
};

}  // namespace

std::unique_ptr<PlannedExperiment> plan_sweep(const Scene& scene, const Preparation& prepared, const Watcher& watcher,
                                              RunResult& result, TableOfSweep write) {
  result.found.emplace<SweepResult>();
  const auto points = [](RunResult & run) -> auto& { return std::get<SweepResult>(run.found).points; };
  return std::make_unique<PlannedSweep>(std::move(write), plan_harmonic(scene, prepared, watcher, result, points));
}

template <>
std::vector<std::string> ExperimentOf<Sweep>::files(const Sweep&, const Scene&) {
  return {"sweep.csv"};
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Sweep>::plan(
    const Sweep&, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed>,  // NOLINT(performance-unnecessary-value-param): same signature as stepped experiments
    RunResult& result) {
  return plan_sweep(scene, prepared, watcher, result,
                    [&scene](const std::filesystem::path& out, const SweepResult& found) {
                      write_sweep(out / "sweep.csv", scene, found);
                    });
}

template <>
void ResultOf<SweepResult>::summarise(const SweepResult& found, const Scene& scene, const RunResult&,
                                      nlohmann::ordered_json& out) {
  for (const HarmonicFrequency& f : found.points) {
    nlohmann::ordered_json point = frequency_json(f, scene);
    const auto e_star = std::polar(f.stiffness.e_star_pa, f.stiffness.phase_deg * std::numbers::pi / 180);
    point["storage_pa"] = e_star.real();
    point["loss_pa"] = e_star.imag();
    out["results"].push_back(std::move(point));
  }
}

template <>
double ResultOf<SweepResult>::seconds(const SweepResult& found) {
  return seconds_of(found.points);
}

template <>
std::string ResultOf<SweepResult>::table(const SweepResult& found) {
  return frequency_table(found.points);
}

}  // namespace macadam
