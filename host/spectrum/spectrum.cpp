// SPDX-License-Identifier: GPL-3.0-or-later
// spectrum.cpp  Solves the network at several real s, and then at further s between them, until E(t) no longer changes.
#include "macadam/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/harmonic/law_stiffness.hpp"
#include "host/spectrum/reduced_spectrum.hpp"
#include "host/spectrum/solution_range.hpp"
#include "host/spectrum/volumetric_spectrum.hpp"
#include "macadam/error.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {
namespace {

using namespace solution_range;
using harmonic::ReducedModel;
using harmonic::Vector;
using Complex = std::complex<double>;

/// The largest error of classes of contacts with rock in series, as a fraction of the tolerance.
constexpr double of_classes = 0.3;
/// Smallest tolerance if contacts have rock in series. The classes are then at most some thousand per pair type.
constexpr double least_with_rock = 1e-7;

/// Returns the spacing of classes with an error of at most `of_classes` times the tolerance (rock_classes.hpp).
double class_spacing(double tolerance) { return 4 * std::atanh(std::sqrt(std::min(of_classes * tolerance, 0.01))); }

/// The search for the spectrum of one specimen.
class Finder {
 public:
  Finder(const Specimen& specimen, const ContactNetwork& network,
         const std::array<std::optional<Law>, pair_types>& laws, const SpectrumOptions& options)
      : specimen_(specimen),
        network_(network),
        laws_(laws),
        options_(options),
        model_(specimen, network, {}, {laws, class_spacing(options.tolerance)}),
        weights_(make_inertia(specimen, 1, 1)) {
    to_modulus_ = gauge_length(specimen) / section_area(specimen);
  }

  Spectrum find() {
    const double low = std::log(1 / (slower * options_.longest)), high = std::log(faster / options_.shortest);
    join({std::log(at_once / std::min(options_.shortest, fastest_time(laws_)))});
    std::vector<double> places;
    for (int i = 0; i < first_places; ++i) {
      places.push_back(high + (low - high) * i / (first_places - 1));
      // The solutions are computed from large to small s. Each solution is a good start for the next one, and systems
      // with small s are worse conditioned.
      join({places.back()});
    }
    std::sort(places.begin(), places.end());
    double before = 1;
    for (int round = 0; round < most_rounds; ++round) {
      if (round > 0) halve(places);
      const PronySeries next = harmonic::reduced_spectrum(model_, laws_, to_modulus_);
      const double now = round == 0 ? 1 : change(out_.relaxation, next);
      out_.relaxation = next;
      // If the number of places is doubled, the relative error is about squared. The estimate assumes less: that the
      // error shrinks by the same factor as in the round before.
      out_.error = now * std::min(1.0, now / before) + of_residuals * options_.tolerance + model_.rock().error();
      before = now;
      if (options_.on_progress) options_.on_progress(out_.solutions, out_.error);
      if (out_.error <= options_.tolerance && checked()) return finished();
    }
    throw RunError(
        fmt::format("spectrum: the relative error of E(t) is still {:.1e} after {} solutions, expected at most {:.1e}",
                    std::max(out_.error, out_.checked), out_.solutions, options_.tolerance));
  }

 private:
  /// Adds a place (a value of ln s) in the middle between every two neighbours, and solves there.
  void halve(std::vector<double>& places) {
    std::vector<double> between;
    for (std::size_t i = 1; i < places.size(); ++i) between.push_back(0.5 * (places[i - 1] + places[i]));
    join(between);
    places.insert(places.end(), between.begin(), between.end());
    std::sort(places.begin(), places.end());
  }

  /// Solves at s = exp(log_s) and adds the motions to the reduced model.
  void join(const std::vector<double>& log_s) {
    std::vector<Vector> motions;
    for (const double place : log_s) motions.push_back(solve({.growth = std::exp(place)}).motion);
    model_.add(motions);
  }

  /// Solves the whole network for a load, starting from the motion that the reduced model predicts.
  HarmonicResult solve(HarmonicLoad load) {
    Harmonic harmonic(specimen_, network_, laws_, weights_,
                      {.tolerance = residual_share * std::sqrt(options_.tolerance),
                       .linear = options_.linear,
                       .backend = options_.backend,
                       .devices = options_.devices,
                       .stop = options_.stop,
                       .typical_growth = std::abs(load.s())},
                      0);
    Vector near;
    if (model_.motions() > 0) {
      near = model_.motion(model_.solve(laws_, load));
      load.near = &near;
    }
    ++out_.solutions;
    return std::move(harmonic.solve(std::vector{load}).front());
  }

  /// Returns the largest relative difference of E(t) between two series.
  double change(const PronySeries& before, const PronySeries& now) const {
    return difference(before, now, options_.shortest, options_.longest);
  }

  /// Compares the series with solutions that were not used to make it, at frequencies within the range. Returns whether
  /// the largest difference is within the tolerance.
  bool checked() {
    out_.checked = solution_range::largest_difference(
        out_.relaxation, options_, [&](const HarmonicLoad& load) { return solve(load).parts.modulus(); });
    return out_.checked <= options_.tolerance;
  }

  Spectrum finished() {
    out_.creep = creep_series(out_.relaxation);
    return std::move(out_);
  }

  const Specimen& specimen_;
  const ContactNetwork& network_;
  const std::array<std::optional<Law>, pair_types>& laws_;
  const SpectrumOptions& options_;
  ReducedModel model_;
  Inertia weights_;  ///< masses for density 1, used only to separate free motions from others; no load has inertia
  double to_modulus_ = 0;
  Spectrum out_;
};

}  // namespace

Spectrum spectrum_of(const Specimen& specimen, const ContactNetwork& network,
                     const std::array<std::optional<Law>, pair_types>& laws, const SpectrumOptions& options) {
  if (!(options.shortest > 0 && options.longest > options.shortest && std::isfinite(options.longest))) {
    throw InputError("spectrum", 0, "times", fmt::format("{:g} to {:g} s", options.shortest, options.longest),
                     "two positive times, the shorter one first");
  }
  if (!(options.tolerance >= 1e-10)) {
    throw InputError("spectrum", 0, "tolerance", fmt::format("{:g}", options.tolerance),
                     "at least 1e-10, because the solutions are not more accurate");
  }
  const auto has_rock = [](const Contact& c) { return c.series > 0; };
  if (network.cells.empty() && options.tolerance < least_with_rock &&
      std::any_of(network.contacts.begin(), network.contacts.end(), has_rock)) {
    throw InputError(
        "spectrum", 0, "tolerance", fmt::format("{:g} for contacts with rock in series", options.tolerance),
        fmt::format("at least {:g}, because these contacts are divided between a limited number of classes",
                    least_with_rock));
  }
  require_stiffness(laws);
  for (const auto& law : laws)
    if (law) prony_series(*law);  // throws before any system is solved if a law has no series
  if (!network.cells.empty()) return volumetric_spectrum(specimen, network, laws, options);
  return Finder(specimen, network, laws, options).find();
}

}  // namespace macadam
