// SPDX-License-Identifier: GPL-3.0-or-later
// judgement.cpp  Checks that a result is within limits that hold for every specimen of springs and dashpots.
#include "host/experiments/cyclic/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/run/error_model.hpp"
#include "macadam/error.hpp"

namespace macadam {

using experiments::Frequency;
using experiments::HarmonicFrequency;
using experiments::SteppedFrequency;

namespace {

/// Springs and dashpots give a phase angle of 0 to 90 degrees. This margin [degrees] is added at both ends, because
/// start-up waves can change the phase angle a little.
constexpr double phase_margin_deg = 1;
/// Largest accepted residual (rms) of the sine that is fitted to the stress, divided by the amplitude of the stress. If
/// the residual is half of the amplitude, the stress is plainly not a sine. The residual does not measure the accuracy
/// of |E*|.
constexpr double largest_residual = 0.5;
/// Factor on the modulus bound. The bound holds without inertia; start-up waves can exceed it a little.
constexpr double bound_margin = 1.05;
/// Largest accepted relative difference between the forces on the two walls, which are equal without inertia. In
/// correct solutions they differ by 1e-9 or less.
constexpr double wall_difference = 1e-6;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Returns the properties of a result that no specimen of springs and dashpots can have.
std::vector<std::string> faults_of(const Frequency& f, double stiffest) {
  std::vector<std::string> faults;
  const double phase = f.stiffness.phase_deg;
  if (phase < -phase_margin_deg || phase > 90 + phase_margin_deg) {
    faults.push_back(fmt::format("the phase angle is {:.4g} degrees, but springs and dashpots give 0 to 90", phase));
  }
  if (f.stiffness.e_star_pa > bound_margin * stiffest) {
    faults.push_back(fmt::format("{} is {:.4g} Pa, but even the modulus of the stiffest contact is only {:.4g} Pa",
                                 modulus_symbol(f), f.stiffness.e_star_pa, stiffest));
  }
  return faults;
}

void require_modulus(const Frequency& f) {
  const Stiffness& found = f.stiffness;
  if (!std::isfinite(found.phase_deg) || !(found.e_star_pa > 0 && std::isfinite(found.e_star_pa))) {
    throw RunError(fmt::format(
        "{} Hz: {} = {} Pa, phi = {} degrees: expected finite numbers and {} above 0 (the strain may be too "
        "small for the precision)",
        f.frequency_hz, modulus_symbol(f), found.e_star_pa, found.phase_deg, modulus_symbol(f)));
  }
}

void warn(const Frequency& f, const std::string& text, std::vector<std::string>& warnings) {
  warnings.push_back(fmt::format("{} Hz: {}", f.frequency_hz, text));
}

}  // namespace

double stiffest_contact(const Scene& scene, const ContactNetwork& network, double frequency_hz) {
  // With the rules of phases a specimen may be as stiff as its rock, for example by the resistance of cells to a change
  // of volume.
  const double of_contacts = stiffness_range(scene, network, 2 * std::numbers::pi * frequency_hz, true).second;
  return std::max(network.rock_modulus, of_contacts);
}

void judge(HarmonicFrequency& f, double stiffest, std::vector<std::string>& warnings) {
  require_modulus(f);
  f.fault = fmt::format("{}", fmt::join(faults_of(f, stiffest), " and "));
  if (!f.fault.empty()) warn(f, f.fault + ": inertia dominates the result", warnings);
  if (f.density_scaling != 0) return;
  const ErrorEstimate walls = difference(f.bottom, f.stiffness);
  if (largest(walls) > wall_difference) {
    warn(f,
         fmt::format("the reactions of bottom and top wall differ by {:.1e} of {} and {:.1e} rad, and the error of the "
                     "solution may be as large (the stiffnesses of contacts may differ too much)",
                     walls.e_star, modulus_symbol(f), walls.phase_rad),
         warnings);
  }
}

void judge(SteppedFrequency& f, std::optional<double> stiffest, std::optional<double> tolerance,
           std::vector<std::string>& warnings) {
  require_modulus(f);
  if (!stiffest) return;
  std::vector<std::string> faults = faults_of(f, *stiffest);
  if (f.residual() > largest_residual) {
    faults.push_back(
        fmt::format("the stress is not a sine (the residual of the fit is {:.2g} of the amplitude)", f.residual()));
  }
  f.fault = fmt::format("{}", fmt::join(faults, " and "));
  if (!f.fault.empty()) {
    warn(f, f.fault + ": inertia, waves from the start or too few cycles dominate the result", warnings);
  }
  if (!tolerance) return;
  if (!f.kept) {
    const bool compared = std::isfinite(f.cyclic.change_e_star);
    const double change =
        compared ? std::max(std::abs(f.cyclic.change_e_star), std::abs(radians(f.cyclic.change_phase_deg))) : 0;
    if (!f.fault.empty() || change > *tolerance) f.kept = false;
    warn(f,
         fmt::format("there is no harmonic solution to compare with, so the tolerance could not be verified{}: {}, and "
                     "the residual of the fit is {:.1e} of the amplitude",
                     f.kept ? " and was certainly not met" : "",
                     compared ? fmt::format("the last two cycles differ by {:.1e}", change) : "only one cycle was run",
                     f.residual()),
         warnings);
  } else if (!*f.kept) {
    const std::string found =
        f.achieved ? fmt::format(": the difference from the harmonic solution is {:.1e}", largest(*f.achieved)) : "";
    warn(f, fmt::format("the tolerance of {:g} was not met{}", *tolerance, found), warnings);
  }
}

void require_sense(const Scene& scene, const experiments::SteppedCyclic& result) {
  if (!scene.solver.tolerance) return;
  for (const SteppedFrequency& f : result.frequencies) {
    if (f.fault.empty()) continue;
    throw RunError(fmt::format("{} Hz: the result cannot meet the tolerance of {:g}: {}", f.frequency_hz,
                               *scene.solver.tolerance, f.fault));
  }
}

}  // namespace macadam
