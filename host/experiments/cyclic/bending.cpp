// SPDX-License-Identifier: GPL-3.0-or-later
// bending.cpp  Implements kind "bending": solves the steady states of a beam between rollers, and writes bending.csv.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/methods.hpp"
#include "host/experiments/experiment.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::Bending;
using experiments::HarmonicFrequency;
using experiments::SweepResult;

namespace {

void write_bending(const std::filesystem::path& out, const SweepResult& found) {
  std::string text =
      "# beam between rollers; deformations per force\n"
      "temperature_c,frequency_hz,e_star_pa,phase_deg,midspan_m_per_n,midspan_phase_deg,rollers_m_per_n,"
      "rollers_phase_deg,residual\n";
  for (const HarmonicFrequency& f : found.points) {
    text += fmt::format("{},{},{},{}", f.temperature_c ? fmt::format("{}", *f.temperature_c) : "", f.frequency_hz,
                        f.stiffness.e_star_pa, f.stiffness.phase_deg);
    for (const std::complex<double>& z : {f.beam->midspan, f.beam->rollers})
      text += fmt::format(",{},{}", std::abs(z), std::arg(z) * 180 / std::numbers::pi);
    text += fmt::format(",{:.2e}\n", f.residual);
  }
  write_whole(out / "bending.csv", text);
}

}  // namespace

template <>
std::vector<std::string> ExperimentOf<Bending>::files(const Bending&, const Scene&) {
  return {"bending.csv"};
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Bending>::plan(
    const Bending&, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed>,  // NOLINT(performance-unnecessary-value-param): same signature as stepped experiments
    RunResult& result) {
  // a specimen that the caller has made may have another domain than the scene
  if (!prepared.specimen.box.rollers())
    throw InputError(scene.file.string(), 0, "domain of the specimen with kind \"bending\"",
                     std::string("a ") + prepared.specimen.box.name() + " without rollers", "the beam of the scene");
  return plan_sweep(scene, prepared, watcher, result, write_bending);
}

}  // namespace macadam
