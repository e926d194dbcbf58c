// SPDX-License-Identifier: GPL-3.0-or-later
// indirect_tension.cpp  Implements kind "indirect_tension": solves the steady states of a disc between two strips, and
// writes indirect_tension.csv.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/methods.hpp"
#include "host/experiments/experiment.hpp"
#include "host/files/result_files.hpp"

namespace macadam {

using experiments::HarmonicFrequency;
using experiments::IndirectTension;
using experiments::SweepResult;

namespace {

void write_table(const std::filesystem::path& out, const SweepResult& found) {
  std::string text =
      "# disc between two strips; deformations per force\n"
      "temperature_c,frequency_hz,e_star_pa,phase_deg,poisson_ratio,poisson_phase_deg,horizontal_m_per_n,"
      "horizontal_phase_deg,vertical_m_per_n,vertical_phase_deg,strips_m_per_n,strips_phase_deg,residual\n";
  for (const HarmonicFrequency& f : found.points) {
    text += fmt::format("{},{},{},{}", f.temperature_c ? fmt::format("{}", *f.temperature_c) : "", f.frequency_hz,
                        f.stiffness.e_star_pa, f.stiffness.phase_deg);
    for (const std::complex<double>& z : {*f.poisson_ratio, f.disc->horizontal, f.disc->vertical, f.disc->strips})
      text += fmt::format(",{},{}", std::abs(z), std::arg(z) * 180 / std::numbers::pi);
    text += fmt::format(",{:.2e}\n", f.residual);
  }
  write_whole(out / "indirect_tension.csv", text);
}

}  // namespace

template <>
std::vector<std::string> ExperimentOf<IndirectTension>::files(const IndirectTension&, const Scene&) {
  return {"indirect_tension.csv"};
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<IndirectTension>::plan(
    const IndirectTension&, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed>,  // NOLINT(performance-unnecessary-value-param): same signature as stepped experiments
    RunResult& result) {
  return plan_sweep(scene, prepared, watcher, result, write_table);
}

}  // namespace macadam
