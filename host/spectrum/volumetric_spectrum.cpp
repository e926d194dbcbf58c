// SPDX-License-Identifier: GPL-3.0-or-later
// volumetric_spectrum.cpp  Computes E* at several frequencies, and fits E* as a function of the modulus of the mastic.
//
// With the rule "volumetric" the parts of a contact's displacement that belong to its two cells depend on s, so that
// the stiffness matrix is not a sum of constant matrices times laws, and the reduced model cannot be used. But all
// stiffnesses follow from one complex modulus k of the mastic and a constant modulus of the rock. So E* depends on s
// only through k. A composite of two phases has (Bergman 1978; Milton 2002, chapter 18)
//   E*(k) = a + Σ w·k·p/(k + p),   a ≥ 0, w ≥ 0, 0 < p ≤ ∞:
// bars of mastic, each in series with a spring p. The weights follow from a linear least-squares problem with unknowns
// that are not negative. The relaxation of a bar is known exactly for every law of the mastic, so that the relaxation
// times of the specimen need no fit. A specimen of one material is one bar with p = ∞.
//
// The rule "volumetric" divides a displacement by the shear moduli alone and then adds the energy of the change of
// volume. This is not exactly a composite of springs, so that the fit has an error that does not vanish. It is a part
// of the reported error. With Poisson's ratios of the mastic from 0.35 to 0.49 it was 2e-7 to 2e-5 of E*.
#include "host/spectrum/volumetric_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "host/base/non_negative_least_squares.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/spectrum/law_in_series.hpp"
#include "host/spectrum/solution_range.hpp"
#include "macadam/error.hpp"
#include "macadam/harmonic.hpp"

namespace macadam {
namespace {

using namespace solution_range;
using Complex = std::complex<double>;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Number of springs p per decade that a fit may use. They reach from `softest` times the smallest |k| of the samples
/// to `stiffest` times the largest |k|.
constexpr int springs_per_decade = 40;
constexpr double softest = 1e-2, stiffest = 1e4;
/// The fit ends when every difference from E*, relative to |E*|, is below this number.
constexpr double no_difference = 1e-12;
/// Values of E(t) below this fraction of E(0) count as this fraction. If the mastic flows, E(t) of long times is so
/// small that the error of the fit hides it.
constexpr double least_modulus = 1e-6;
/// Number of rounds. The error falls more slowly than with a reduced model, so that there is one round more.
constexpr int fit_rounds = most_rounds + 1;
/// Relaxation times that differ by less than this fraction are one time.
constexpr double same_time = 1e-12;

/// Returns k·p/(k + p).
Complex modulus_of_bar(double p, Complex k) { return std::isinf(p) ? k : k / (1.0 + k / p); }

/// Returns the law of the mastic. \throws InputError if the laws do not follow from one law of the mastic and an
/// elastic rock.
Law law_of_mastic(const ContactNetwork& network, const LawTable& laws) {
  const auto equal = [](const PronySeries& a, const PronySeries& b) {
    return a.long_term == b.long_term &&
           std::equal(a.units.begin(), a.units.end(), b.units.begin(), b.units.end(),
                      [](const auto& x, const auto& y) { return x.modulus == y.modulus && x.time == y.time; });
  };
  std::optional<std::size_t> mastic;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const auto type = static_cast<PairType>(pair);
    const bool has_cells = type == PairType::mm || type == PairType::inner;
    if (!laws[pair] || (network.count[pair] == 0 && !has_cells)) continue;
    const PronySeries own = prony_series(*laws[pair]);
    if (!is_of_mastic(type) && !own.units.empty())
      throw InputError("spectrum", 0, std::string("law of ") + to_string(type) + " with the rule \"volumetric\"",
                       "a law that relaxes", "an elastic law, because with this rule the rock must be elastic");
    if (!is_of_mastic(type)) continue;
    if (!mastic) mastic = pair;
    if (!equal(own, prony_series(*laws[*mastic])))
      throw InputError("spectrum", 0, std::string("law of ") + to_string(type) + " with the rule \"volumetric\"",
                       std::string("another law than that of ") + to_string(static_cast<PairType>(*mastic)),
                       "the law of the mastic in all pairs with mastic");
  }
  return mastic ? *laws[*mastic] : Law(laws::Elastic{1, 1});
}

/// The search for the spectrum of one specimen.
class BarFinder {
 public:
  BarFinder(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
            const SpectrumOptions& options)
      : specimen_(specimen),
        network_(network),
        laws_(laws),
        mastic_(law_of_mastic(network, laws)),
        options_(options),
        weights_(make_inertia(specimen, 1, 1)) {}

  Spectrum find() {
    const double fastest = fastest_time(laws_);
    sample({.growth = at_once / std::min(options_.shortest, fastest)});
    if (std::isinf(fastest)) {
      out_.relaxation = {samples_.front().specimen.real(), {}};  // no law relaxes
      out_.error = of_residuals * options_.tolerance;
      return finished();
    }
    const double low = std::log(1 / (slower * options_.longest)), high = std::log(faster / options_.shortest);
    std::vector<double> places;  // ln ω
    for (int i = 0; i < first_places; ++i) {
      places.push_back(high + (low - high) * i / (first_places - 1));
      sample(load_at(places.back()));
    }
    std::sort(places.begin(), places.end());
    double before = 0;
    for (int round = 0; round < fit_rounds; ++round) {
      if (round > 0) halve(places);
      bars_ = fit_bars(samples_, of_residuals * options_.tolerance);
      const double misfit = largest_difference(samples_);
      if (misfit > options_.tolerance)
        throw RunError(fmt::format(
            "spectrum: with the rule \"volumetric\" the best sum of exponentials differs from E* of this specimen "
            "by {:.1e}, expected at most the tolerance {:.1e}; choose a larger tolerance",
            misfit, options_.tolerance));
      const PronySeries next = bars_.relaxation(mastic_);
      const double now =
          round == 0 ? 1 : difference(out_.relaxation, next, options_.shortest, options_.longest, least_modulus);
      out_.relaxation = next;
      // `now` is the error of the round before. The estimate assumes that the error shrinks by the same factor as in
      // that round, and in the first round whose factor is not known, that it does not shrink.
      const double factor = round < 2 ? 1 : std::min(1.0, now / before);
      out_.error = now * factor + of_residuals * options_.tolerance + misfit;
      before = now;
      if (options_.on_progress) options_.on_progress(out_.solutions, out_.error);
      if (out_.error <= options_.tolerance && checked()) return finished();
    }
    throw RunError(
        fmt::format("spectrum: the relative error of E(t) is still {:.1e} after {} solutions, expected at most {:.1e}",
                    std::max(out_.error, out_.checked), out_.solutions, options_.tolerance));
  }

 private:
  static HarmonicLoad load_at(double log_omega) {
    return {.frequency_hz = std::exp(log_omega) / (2 * std::numbers::pi)};
  }

  /// Adds a place in the middle between every two neighbours, and solves there.
  void halve(std::vector<double>& places) {
    std::vector<double> between;
    for (std::size_t i = 1; i < places.size(); ++i) between.push_back(0.5 * (places[i - 1] + places[i]));
    for (auto place = between.rbegin(); place != between.rend(); ++place) sample(load_at(*place));
    places.insert(places.end(), between.begin(), between.end());
    std::sort(places.begin(), places.end());
  }

  void sample(const HarmonicLoad& load) { samples_.push_back(solve(load)); }

  /// Solves the network for a load, starting from the motion of the solution before.
  MasticSample solve(HarmonicLoad load) {
    Harmonic harmonic(specimen_, network_, laws_, weights_,
                      {.tolerance = residual_share * std::sqrt(options_.tolerance),
                       .linear = options_.linear,
                       .backend = options_.backend,
                       .devices = options_.devices,
                       .stop = options_.stop,
                       .typical_growth = load.growth},
                      load.frequency_hz);
    if (!near_.empty()) load.near = &near_;
    HarmonicResult found = std::move(harmonic.solve(std::vector{load}).front());
    near_ = std::move(found.motion);
    ++out_.solutions;
    const Complex k =
        with_stiffness<Complex>(PairType::mm, mastic_, [&](const auto& law) { return law.stiffness(load.s()); });
    return {k, found.parts.modulus()};
  }

  /// Returns the largest difference of the bars from samples, relative to |E*|.
  double largest_difference(const std::vector<MasticSample>& samples) const {
    double out = 0;
    for (const MasticSample& s : samples) out = std::max(out, std::abs(bars_.modulus(s.mastic) / s.specimen - 1.0));
    return out;
  }

  /// Compares the series with solutions that were not used to make it, at frequencies within the range. Returns whether
  /// the largest difference is within the tolerance.
  bool checked() {
    out_.checked = solution_range::largest_difference(out_.relaxation, options_,
                                                      [&](const HarmonicLoad& load) { return solve(load).specimen; });
    return out_.checked <= options_.tolerance;
  }

  Spectrum finished() {
    out_.creep = creep_series(out_.relaxation);
    return std::move(out_);
  }

  const Specimen& specimen_;
  const ContactNetwork& network_;
  const LawTable& laws_;
  const Law mastic_;
  const SpectrumOptions& options_;
  Inertia weights_;  ///< masses for density 1, used only to separate free motions from others; no load has inertia
  std::vector<MasticSample> samples_;
  std::vector<Complex> near_;  ///< motion of the latest solution
  BarsOfMastic bars_;
  Spectrum out_;
};

}  // namespace

Complex BarsOfMastic::modulus(Complex mastic) const {
  Complex out = constant;
  for (const Bar& bar : bars) out += bar.weight * modulus_of_bar(bar.stiffness, mastic);
  return out;
}

PronySeries BarsOfMastic::relaxation(const Law& mastic) const {
  PronySeries all{constant, {}};
  for (const Bar& bar : bars) {
    const PronySeries own = times(bar.weight, relaxation_in_series(mastic, 1 / bar.stiffness));
    all.long_term += own.long_term;
    all.units.insert(all.units.end(), own.units.begin(), own.units.end());
  }
  std::sort(all.units.begin(), all.units.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  PronySeries out{all.long_term, {}};
  for (const auto& u : all.units) {
    if (!out.units.empty() && u.time <= out.units.back().time * (1 + same_time))
      out.units.back().modulus += u.modulus;
    else
      out.units.push_back(u);
  }
  return out;
}

BarsOfMastic fit_bars(std::span<const MasticSample> samples, double enough) {
  if (samples.empty()) throw InputError("fit of bars of mastic", 0, "samples", "none", "at least one");
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return std::abs(a.mastic) < std::abs(b.mastic);
  });
  std::vector<double> springs =
      log_range(softest * std::abs(least->mastic), stiffest * std::abs(most->mastic), springs_per_decade);
  springs.push_back(infinite);
  // unknowns: the weight of each bar and the constant; rows: real and imaginary part of E*/|E*|
  const auto rows = 2 * std::ssize(samples), bars = std::ssize(springs);
  Eigen::MatrixXd columns(rows, bars + 1);
  Eigen::VectorXd right(rows);
  for (Eigen::Index i = 0; i < std::ssize(samples); ++i) {
    const auto& [mastic, specimen] = samples[static_cast<std::size_t>(i)];
    const double size = std::abs(specimen);
    const auto set = [&](Eigen::Index column, Complex value) {
      columns(2 * i, column) = value.real() / size, columns(2 * i + 1, column) = value.imag() / size;
    };
    for (Eigen::Index j = 0; j < bars; ++j) set(j, modulus_of_bar(springs[static_cast<std::size_t>(j)], mastic));
    set(bars, 1);
    right[2 * i] = specimen.real() / size, right[2 * i + 1] = specimen.imag() / size;
  }
  const auto fit = [&](Eigen::Index unknowns) -> Eigen::VectorXd {
    return fitting::non_negative_least_squares(columns.leftCols(unknowns), right, no_difference);
  };
  Eigen::VectorXd x = fit(bars);
  // A constant means that rock connects both walls. It is rare, and a constant that only fits rounding errors would
  // turn a fluid into a solid.
  if ((columns.leftCols(bars) * x - right).cwiseAbs().maxCoeff() > enough) x = fit(bars + 1);
  BarsOfMastic out;
  if (x.size() > bars) out.constant = x[bars];
  for (Eigen::Index j = 0; j < bars; ++j)
    if (x[j] > 0) out.bars.push_back({springs[static_cast<std::size_t>(j)], x[j]});
  return out;
}

Spectrum volumetric_spectrum(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                             const SpectrumOptions& options) {
  return BarFinder(specimen, network, laws, options).find();
}

}  // namespace macadam
