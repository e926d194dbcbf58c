// SPDX-License-Identifier: GPL-3.0-or-later
// torsion.cpp  Implements kind "torsion": solves the steady states of a cylinder whose top platen turns, and writes
// torsion.csv.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/methods.hpp"
#include "host/experiments/experiment.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::HarmonicFrequency;
using experiments::SweepResult;
using experiments::Torsion;

namespace {

void write_torsion(const std::filesystem::path& out, const SweepResult& found) {
  std::string text =
      "# cylinder whose top platen turns; torque per turn of this platen\n"
      "temperature_c,frequency_hz,g_star_pa,phase_deg,storage_pa,loss_pa,torque_n_m_per_rad,residual,error\n";
  for (const HarmonicFrequency& f : found.points) {
    const auto modulus = [](const Stiffness& s) {
      return std::polar(s.e_star_pa, s.phase_deg * std::numbers::pi / 180);
    };
    const std::complex<double> g = modulus(f.stiffness);
    text +=
        fmt::format("{},{},{},{},{},{},{},{:.2e},{:.2e}\n", f.temperature_c ? fmt::format("{}", *f.temperature_c) : "",
                    f.frequency_hz, f.stiffness.e_star_pa, f.stiffness.phase_deg, g.real(), g.imag(),
                    std::abs(f.torque_per_turn.value()), f.residual, std::abs(modulus(f.bottom) / g - 1.0));
  }
  write_whole(out / "torsion.csv", text);
}

}  // namespace

template <>
std::vector<std::string> ExperimentOf<Torsion>::files(const Torsion&, const Scene&) {
  return {"torsion.csv"};
}

template <>
std::unique_ptr<PlannedExperiment> ExperimentOf<Torsion>::plan(
    const Torsion&, const Scene& scene, const Preparation& prepared, const Watcher& watcher,
    std::optional<Resumed>,  // NOLINT(performance-unnecessary-value-param): same signature as stepped experiments
    RunResult& result) {
  // a specimen that the caller has made may have another domain than the scene
  if (!prepared.specimen.box.torsion_constant())
    throw InputError(scene.file.string(), 0, "domain of the specimen with kind \"torsion\"",
                     std::string("a ") + prepared.specimen.box.name(), "the cylinder of the scene");
  return plan_sweep(scene, prepared, watcher, result, write_torsion);
}

}  // namespace macadam
