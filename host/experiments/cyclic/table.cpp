// SPDX-License-Identifier: GPL-3.0-or-later
// table.cpp  Makes the table with the results of a cyclic test that the command prints.
#include <fmt/format.h>

#include "host/experiments/cyclic/frequency_summary.hpp"
#include "host/experiments/experiment.hpp"
#include "host/run/cracks.hpp"

namespace macadam {

using experiments::Frequency;
using experiments::HarmonicCyclic;
using experiments::HarmonicFrequency;
using experiments::modulus_symbol;
using experiments::SteppedCyclic;
using experiments::SteppedFrequency;

namespace {

/// Returns whether the frequencies have temperatures.
template <class F>
bool warm(const std::vector<F>& frequencies) {
  return !frequencies.empty() && frequencies.front().temperature_c;
}

/// Returns the symbol of the modulus.
template <class F>
const char* symbol(const std::vector<F>& frequencies) {
  return frequencies.empty() ? modulus_symbol({}) : modulus_symbol(frequencies.front());
}

template <class F>
std::string heads(const std::vector<F>& frequencies) {
  const bool held = !frequencies.empty() && frequencies.front().confined;
  return fmt::format("\n{}{}{:>8} {:>11} {:>9}", held ? "|M*|: confined modulus (the sides are held)\n" : "",
                     warm(frequencies) ? "   T (C) " : "", "f (Hz)", fmt::format("{} (GPa)", symbol(frequencies)),
                     "phi (deg)");
}

std::string begun(const Frequency& f, bool warm) {
  return (warm ? fmt::format("{:>8g} ", f.temperature_c.value_or(0)) : "") +
         fmt::format("{:>8g} {:>11.5f} {:>9.4f}", f.frequency_hz, f.stiffness.e_star_pa / 1e9, f.stiffness.phase_deg);
}

}  // namespace

std::string frequency_table(const std::vector<HarmonicFrequency>& frequencies) {
  std::string out = heads(frequencies) +
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
  const bool by_increments = !found.frequencies.empty() && found.frequencies.front().increments;
  const char* modulus = symbol(found.frequencies);
  std::string out =
      heads(found.frequencies) + fmt::format(" {:>11} {:>9} {:>9} {:>10} {:>9}\n",
                                             known ? fmt::format("err {}", modulus) : fmt::format("d{} cycle", modulus),
                                             known ? "err (rad)" : "d phi", by_increments ? "" : "scaling",
                                             by_increments ? "increments" : "steps", "time (s)");
  for (const SteppedFrequency& f : found.frequencies) {
    const double e_star = f.achieved ? f.achieved->e_star : f.cyclic.change_e_star;
    const double phase = f.achieved ? f.achieved->phase_rad : f.cyclic.change_phase_deg;
    out +=
        begun(f, warm(found.frequencies)) + fmt::format(" {:>11.1e} {:>9.1e} {:>9} {:>10} {:>9.1f}\n", e_star, phase,
                                                        f.increments ? "" : fmt::format("{:.5g}", f.density_scaling),
                                                        f.increments ? f.increments->increments : f.steps, f.seconds);
  }
  for (const SteppedFrequency& f : found.frequencies) {
    if (!f.cracks) continue;
    const std::string words = (f.rupture ? rupture_words(*f.rupture) + " " : "") + cracks_words(*f.cracks);
    out += fmt::format("{} Hz: {}\n", f.frequency_hz, words);
  }
  if (known)
    out += fmt::format("err: difference from the harmonic solution {}; relative for {}, in radians for phi\n",
                       by_increments ? "without inertia" : "without density scaling", modulus);
  return out;
}

}  // namespace macadam
