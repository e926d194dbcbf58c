// SPDX-License-Identifier: GPL-3.0-or-later
// standard_results.cpp  Computes the results of discs, half discs and beams, and writes them as text and as JSON.
#include "host/experiments/transient/standard_results.hpp"

#include <fmt/format.h>

#include <variant>

#include "host/experiments/transient/beam_strength.hpp"
#include "host/experiments/transient/bottom_notch.hpp"
#include "host/experiments/transient/disc_strength.hpp"
#include "host/experiments/transient/half_disc_strength.hpp"

namespace macadam {

using experiments::BeamStrength;
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

/// Calls f with the results. There must be results.
template <class F>
auto with_results(const SteppedResponse& found, const F& f) {
  if (found.disc) return f(*found.disc);
  return found.half_disc ? f(*found.half_disc) : f(*found.beam);
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

/// Names of the standards of a bending test to failure.
struct Standards {
  const char *strength, *toughness, *fracture_energy;
};

/// Returns the results that half discs and beams have in common.
template <class Bent>
std::string words_of_bending(const Bent& bent, bool passed, const Standards& standards) {
  std::string out = fmt::format("largest load {:.5g} kN when the upper roller has moved by {:.4g} mm\n",
                                bent.load_n / 1e3, bent.displacement_m * 1e3);
  if (!passed) return out + "the strength was not reached\n";
  if (bent.strength_pa)
    out = fmt::format("bending strength {:.5g} MPa ({})\n", *bent.strength_pa / 1e6, standards.strength) + out;
  if (bent.toughness_pa_sqrt_m)
    out +=
        fmt::format("fracture toughness {:.4g} MPa m^0.5 ({})\n", *bent.toughness_pa_sqrt_m / 1e6, standards.toughness);
  return out + fmt::format("fracture energy {:.4g} J/m2{} ({})\n", bent.fracture_energy_j_m2, words_about_end(bent),
                           standards.fracture_energy);
}

std::string words_of(const BeamStrength& beam, bool passed) {
  return words_of_bending(beam, passed, {"theory of beams", "ASTM E399", "RILEM TC 50-FMC"});
}

std::string words_of(const HalfDiscStrength& half_disc, bool passed) {
  const std::string out = words_of_bending(half_disc, passed, {"EN 12697-44", "AASHTO TP 105", "AASHTO T 393"});
  if (!passed) return out;
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

template <class Bent>
void add_bending(const Bent& bent, bool passed, Json& out) {
  out["notch_m"] = bent.notch_m;
  out["bending_strength_pa"] = passed ? number(bent.strength_pa) : Json();
  out["fracture_toughness_pa_sqrt_m"] = passed ? number(bent.toughness_pa_sqrt_m) : Json();
  out["fracture_energy_j_m2"] = passed ? Json(bent.fracture_energy_j_m2) : Json();
}

void add(const BeamStrength& beam, bool passed, Json& out) { add_bending(beam, passed, out); }

void add(const HalfDiscStrength& half_disc, bool passed, Json& out) {
  add_bending(half_disc, passed, out);
  out["post_peak_slope_n_m"] = number(half_disc.slope_n_m);
  out["flexibility_index"] = number(half_disc.flexibility_index);
}

}  // namespace

void compute_standard_results(const Scene& scene, const Domain& domain, std::span<const StressSample> samples,
                              SteppedResponse& found) {
  if (std::holds_alternative<experiments::IndirectTensileStrength>(scene.experiment))
    found.disc = disc_strength(samples, peak_of(found), domain);
  const auto notch = bottom_notch(domain, scene.network.notches);
  if (notch && std::holds_alternative<experiments::SemicircularBending>(scene.experiment))
    found.half_disc = half_disc_strength(samples, peak_of(found), domain, *notch);
  if (notch && std::holds_alternative<experiments::ThreePointBending>(scene.experiment))
    found.beam = beam_strength(samples, peak_of(found), domain, *notch);
}

bool has_standard_results(const SteppedResponse& found) { return found.disc || found.half_disc || found.beam; }

std::string standard_results_words(const SteppedResponse& found, bool passed) {
  return with_results(found, [passed](const auto& results) { return words_of(results, passed); });
}

void add_standard_results(const SteppedResponse& found, bool passed, Json& out) {
  with_results(found, [&](const auto& results) {
    out["peak_load_n"] = results.load_n;
    out["displacement_at_peak_m"] = results.displacement_m;
    out["last_load_part"] = results.last_part;
    add(results, passed, out);
  });
}

}  // namespace macadam
