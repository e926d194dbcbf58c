// SPDX-License-Identifier: GPL-3.0-or-later
// summary.cpp  Reports the cyclic test in summary.json.
#include <cmath>
#include <numbers>

#include "host/experiments/cyclic/frequency_summary.hpp"
#include "host/experiments/experiment.hpp"
#include "host/run/cracks.hpp"
#include "host/run/step_settings.hpp"

namespace macadam {

using experiments::Frequency;
using experiments::HarmonicCyclic;
using experiments::HarmonicFrequency;
using experiments::SteppedCyclic;
using experiments::SteppedFrequency;

namespace {

using Json = nlohmann::ordered_json;

Json error_json(const ErrorEstimate& error) { return {{"e_star", error.e_star}, {"phase_rad", error.phase_rad}}; }

/// Adds the derivatives of |E*| and φ with respect to the logarithm of each parameter of the laws, and the fraction of
/// E* that each pair type carries.
void add_sensitivities(const HarmonicFrequency& f, const LawTable& laws, ContactRule rule, Json& out) {
  out["sensitivities"] = Json::array();
  const std::complex<double> at(0, 2 * std::numbers::pi * f.frequency_hz);
  const bool of_phases = has_laws_of_phases(rule);
  for (const Sensitivity& s : of_phases ? phase_sensitivities(f.parts, laws, at) : sensitivities(f.parts, laws, at)) {
    out["sensitivities"].push_back(
        {{"parameter", s.parameter}, {"d_e_star_pa", s.d_e_star_pa}, {"d_phase_deg", s.d_phase_deg}});
  }
  const auto parts = shares(f.parts);
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (parts[pair] != 0) out["shares"][to_string(static_cast<PairType>(pair))] = parts[pair];
  }
}

/// Returns the entries of one frequency in `results` that do not depend on the method.
Json begun(const Frequency& f, const char* method, double residual, const Scene& scene) {
  Json out = {{"frequency_hz", f.frequency_hz},
              {f.shear ? "g_star_pa" : "e_star_pa", f.stiffness.e_star_pa},
              {"phase_deg", f.stiffness.phase_deg},
              {"modulus", f.shear      ? "torsion"
                          : f.confined ? "confined"
                                       : "uniaxial"},
              {"method", method},
              {"residual", residual},
              {"density_scaling", f.density_scaling},
              {"solve_s", f.seconds}};
  if (f.temperature_c) {
    out["temperature_c"] = *f.temperature_c;
    if (const auto shift = common_log10_shift(scene, *f.temperature_c)) {
      out["log10_a_T"] = *shift;
      out["reduced_frequency_hz"] = f.frequency_hz * std::pow(10.0, *shift);
    }
  }
  return out;
}

void add_poisson_ratio(const Frequency& f, Json& out) {
  if (!f.poisson_ratio) return;
  out["poisson_ratio"] = std::abs(*f.poisson_ratio);
  out["poisson_phase_deg"] = std::arg(*f.poisson_ratio) * 180 / std::numbers::pi;
}

Json stepped_json(const SteppedFrequency& f, const Scene& scene) {
  Json out = begun(f, f.increments ? "quasi_static" : "explicit", f.residual(), scene);
  if (f.increments) out.erase("density_scaling");
  add_poisson_ratio(f, out);
  out["e_star_peaks_pa"] = f.cyclic.peaks.e_star_pa;
  out["phase_peaks_deg"] = f.cyclic.peaks.phase_deg;
  out["change_e_star"] = f.cyclic.change_e_star;
  out["change_phase_deg"] = f.cyclic.change_phase_deg;
  if (f.increments) {
    out["increments"] = f.increments->increments;
    out["repeated_increments"] = f.increments->rejected;
    out["linear_systems"] = f.increments->systems;
    out["largest_residual"] = f.increments->residual;
    out["loose_particles"] = f.increments->loose;
  } else {
    out["dt_s"] = f.dt_s;
    out["steps"] = f.steps;
  }
  out["cycles"] = f.cycles;
  out["start"] = to_string(f.start);
  if (f.predicted) out["predicted_error"] = error_json(*f.predicted);
  if (f.achieved) out["difference_from_harmonic"] = error_json(*f.achieved);
  if (f.cracks) out["cracks"] = cracks_json(*f.cracks);
  if (f.rupture) out["rupture"] = rupture_json(*f.rupture);
  for (const Stiffness& cycle : f.cycle_stiffness)
    out["by_cycle"].push_back({{"e_star_pa", cycle.e_star_pa}, {"phase_deg", cycle.phase_deg}});
  if (scene.solver.tolerance) out["tolerance_kept"] = f.kept ? Json(*f.kept) : Json();
  return out;
}

}  // namespace

Json frequency_json(const HarmonicFrequency& f, const Scene& scene) {
  Json out = begun(f, "harmonic", f.residual, scene);
  if (f.disc) out["modulus"] = "indirect_tension";
  if (f.beam) out["modulus"] = "bending";
  out[f.shear ? "g_star_bottom_pa" : "e_star_bottom_pa"] = f.bottom.e_star_pa;
  out["phase_bottom_deg"] = f.bottom.phase_deg;
  add_poisson_ratio(f, out);
  out["iterations"] = f.iterations;
  out["linear"] = to_string(f.linear);
  if (scene.output.sensitivities) {
    add_sensitivities(f, f.temperature_c ? laws_at(scene, *f.temperature_c) : scene.laws, scene.network.rule, out);
  }
  out["held_force"] = f.held_force;
  return out;
}

template <>
void ResultOf<HarmonicCyclic>::summarise(const HarmonicCyclic& found, const Scene& scene, const RunResult&, Json& out) {
  for (const HarmonicFrequency& f : found.frequencies) out["results"].push_back(frequency_json(f, scene));
}

template <>
double ResultOf<HarmonicCyclic>::seconds(const HarmonicCyclic& found) {
  return seconds_of(found.frequencies);
}

template <>
void ResultOf<SteppedCyclic>::summarise(const SteppedCyclic& found, const Scene& scene, const RunResult& run,
                                        Json& out) {
  std::int64_t steps = 0;
  for (const SteppedFrequency& f : found.frequencies) {
    out["results"].push_back(stepped_json(f, scene));
    steps += f.steps;
  }
  Json& solver = out["solver"];
  if (scene.solver.method == SolverMethod::quasi_static)
    add_increment_settings(found, run, solver);
  else
    add_settings(found, scene, run, steps,
                 found.frequencies.empty() ? std::nullopt : std::optional(found.frequencies.back().dt_s), solver);
  solver["strain_amplitude"] = scene.cyclic().strain_amplitude;
  solver["tolerance"] = scene.solver.tolerance ? Json(*scene.solver.tolerance) : Json();
}

template <>
double ResultOf<SteppedCyclic>::seconds(const SteppedCyclic& found) {
  return found.seconds_planning + seconds_of(found.frequencies);
}

}  // namespace macadam
