// SPDX-License-Identifier: GPL-3.0-or-later
// table.cpp  The cyclic test as the command shows it.
#include <fmt/format.h>

#include "host/experiments/cyclic/frequency_summary.hpp"
#include "host/experiments/experiment.hpp"

namespace macadam {

using experiments::Frequency;
using experiments::HarmonicCyclic;
using experiments::HarmonicFrequency;
using experiments::SteppedCyclic;
using experiments::SteppedFrequency;

namespace {

template <class F>
bool warm(const std::vector<F>& frequencies) {
  return !frequencies.empty() && frequencies.front().temperature_c;
}

std::string heads(bool warm) {
  return fmt::format("\n{}{:>8} {:>11} {:>9}", warm ? "   T (C) " : "", "f (Hz)", "|E*| (GPa)", "phi (deg)");
}

std::string begun(const Frequency& f, bool warm) {
  return (warm ? fmt::format("{:>8g} ", f.temperature_c.value_or(0)) : "") +
         fmt::format("{:>8g} {:>11.5f} {:>9.4f}", f.frequency_hz, f.stiffness.e_star_pa / 1e9, f.stiffness.phase_deg);
}

}  // namespace

std::string frequency_table(const std::vector<HarmonicFrequency>& frequencies) {
  std::string out = heads(warm(frequencies)) +
                    fmt::format(" {:>9} {:>10} {:>11} {:>9}\n", "residual", "iterations", "held force", "time (s)");
  for (const HarmonicFrequency& f : frequencies) {
    out += begun(f, warm(frequencies)) +
           fmt::format(" {:>9.1e} {:>10} {:>11.1e} {:>9.1f}\n", f.residual, f.iterations, f.held_force, f.seconds);
  }
  return out;
}

template <>
std::string ResultOf<HarmonicCyclic>::table(const HarmonicCyclic& found) {
  return frequency_table(found.frequencies);
}

template <>
std::string ResultOf<SteppedCyclic>::table(const SteppedCyclic& found) {
  const bool known = !found.frequencies.empty() && found.frequencies.front().achieved;
  std::string out = heads(warm(found.frequencies)) +
                    fmt::format(" {:>11} {:>9} {:>9} {:>10} {:>9}\n", known ? "err |E*|" : "d|E*| cycle",
                                known ? "err (rad)" : "d phi", "scaling", "steps", "time (s)");
  for (const SteppedFrequency& f : found.frequencies) {
    const double e_star = f.achieved ? f.achieved->e_star : f.cyclic.change_e_star;
    const double phase = f.achieved ? f.achieved->phase_rad : f.cyclic.change_phase_deg;
    out += begun(f, warm(found.frequencies)) + fmt::format(" {:>11.1e} {:>9.1e} {:>9.5g} {:>10} {:>9.1f}\n", e_star,
                                                           phase, f.density_scaling, f.steps, f.seconds);
  }
  if (known) out += "err: against the harmonic solution at true mass, |E*| relative, phi in radians\n";
  return out;
}

}  // namespace macadam
