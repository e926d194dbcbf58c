// SPDX-License-Identifier: GPL-3.0-or-later
// standard_results.cpp  Computes the results of discs and half discs, and writes them as text and as JSON.
#include "host/experiments/transient/standard_results.hpp"

#include <fmt/format.h>

#include <variant>

#include "host/experiments/transient/disc_strength.hpp"
#include "host/experiments/transient/half_disc_strength.hpp"

namespace macadam {

using experiments::DiscStrength;
using experiments::HalfDiscStrength;
using experiments::SteppedResponse;

namespace {

using Json = nlohmann::ordered_json;

/// Returns where the work ends if the load has not fallen to the end of the standards.
std::string words_about_end(const experiments::LoadResults& load) {
  constexpr double fallen = 0.11;  // with the part at which the work of small specimens ends
  return load.last_part < fallen
             ? ""
             : fmt::format(" until the test ends, at {:.0f} % of the largest load", 100 * load.last_part);
}

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::string words_of(const DiscStrength& disc, bool passed) {
  std::string out = fmt::format("largest load {:.5g} kN when the strips have approached by {:.4g} mm\n",
                                disc.load_n / 1e3, disc.displacement_m * 1e3);
  if (!passed) return out + "the strength was not reached\n";
  out = fmt::format("indirect tensile strength {:.5g} MPa (EN 12697-23)\n{}fracture energy {:.4g} J/m2{}\n",
                    disc.strength_pa / 1e6, out, disc.fracture_energy_j_m2, words_about_end(disc));
  return out + (disc.ct_index ? fmt::format("CT index {:.4g} (ASTM D8225): |m75| {:.4g} kN/mm, l75 {:.4g} mm\n",
                                            *disc.ct_index, *disc.slope_n_m / 1e6, *disc.l75_m * 1e3)
                              : "no CT index, because the load did not fall from 85 to 65 % of its largest value in "
                                "several increments\n");
}

std::string words_of(const HalfDiscStrength& half_disc, bool passed) {
  std::string out = fmt::format("largest load {:.5g} kN when the upper roller has moved by {:.4g} mm\n",
                                half_disc.load_n / 1e3, half_disc.displacement_m * 1e3);
  if (!passed) return out + "the strength was not reached\n";
  if (half_disc.strength_pa)
    out = fmt::format("bending strength {:.5g} MPa (EN 12697-44)\n", *half_disc.strength_pa / 1e6) + out;
  if (half_disc.toughness_pa_sqrt_m)
    out += fmt::format("fracture toughness {:.4g} MPa m^0.5 (AASHTO TP 105)\n", *half_disc.toughness_pa_sqrt_m / 1e6);
  out += fmt::format("fracture energy {:.4g} J/m2{} (AASHTO T 393)\n", half_disc.fracture_energy_j_m2,
                     words_about_end(half_disc));
  return out + (half_disc.flexibility_index ? fmt::format("flexibility index {:.4g} (AASHTO T 393): |m| {:.4g} kN/mm\n",
                                                          *half_disc.flexibility_index, *half_disc.slope_n_m / 1e6)
                                            : "no flexibility index, because the load did not fall to half of its "
                                              "largest value in several increments\n");
}

void add(const DiscStrength& disc, bool passed, Json& out) {
  out["indirect_tensile_strength_pa"] = passed ? Json(disc.strength_pa) : Json();
  out["fracture_energy_j_m2"] = passed ? Json(disc.fracture_energy_j_m2) : Json();
  out["m75_n_m"] = number(disc.slope_n_m);
  out["l75_m"] = number(disc.l75_m);
  out["ct_index"] = number(disc.ct_index);
}

void add(const HalfDiscStrength& half_disc, bool passed, Json& out) {
  out["notch_m"] = half_disc.notch_m;
  out["bending_strength_pa"] = passed ? number(half_disc.strength_pa) : Json();
  out["fracture_toughness_pa_sqrt_m"] = passed ? number(half_disc.toughness_pa_sqrt_m) : Json();
  out["fracture_energy_j_m2"] = passed ? Json(half_disc.fracture_energy_j_m2) : Json();
  out["post_peak_slope_n_m"] = number(half_disc.slope_n_m);
  out["flexibility_index"] = number(half_disc.flexibility_index);
}

}  // namespace

void compute_standard_results(const Scene& scene, const Domain& domain, std::span<const StressSample> samples,
                              SteppedResponse& found) {
  if (std::holds_alternative<experiments::IndirectTensileStrength>(scene.experiment))
    found.disc = disc_strength(samples, peak_of(found), domain);
  if (std::holds_alternative<experiments::SemicircularBending>(scene.experiment)) {
    const auto notch = half_disc_notch(domain, scene.network.notches);
    if (notch) found.half_disc = half_disc_strength(samples, peak_of(found), domain, *notch);
  }
}

bool has_standard_results(const SteppedResponse& found) { return found.disc || found.half_disc; }

std::string standard_results_words(const SteppedResponse& found, bool passed) {
  return found.disc ? words_of(*found.disc, passed) : words_of(*found.half_disc, passed);
}

void add_standard_results(const SteppedResponse& found, bool passed, Json& out) {
  const experiments::LoadResults& load =
      found.disc ? static_cast<const experiments::LoadResults&>(*found.disc) : *found.half_disc;
  out["peak_load_n"] = load.load_n;
  out["displacement_at_peak_m"] = load.displacement_m;
  out["last_load_part"] = load.last_part;
  if (found.disc)
    add(*found.disc, passed, out);
  else
    add(*found.half_disc, passed, out);
}

}  // namespace macadam
