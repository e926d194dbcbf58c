// SPDX-License-Identifier: GPL-3.0-or-later
/// \file spectrum.hpp  Computes relaxation and creep of a specimen at any time, without time steps.
///
/// A network of springs and dashpots without inertia relaxes as a sum of exponentials, E(t) = E_∞ + Σ g_i·e^(−t/τ_i)
/// with positive g_i. The solutions of the network at some real s > 0 (the Laplace variable) span a space of motions.
/// In this space g_i and τ_i follow from one small symmetric eigenvalue problem, and creep follows from the same
/// numbers. Solutions at further s are added until E(t) is accurate enough.
#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/error.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/laws/prony_series.hpp"
#include "macadam/linear_method.hpp"

namespace macadam {

/// Creep compliance as a chain of Kelvin units in series with a spring and a dashpot, in order of rising times.
struct CreepSeries {
  struct Unit {
    double compliance;  ///< J [1/Pa], positive
    double time;        ///< retardation time [s]
  };
  double instantaneous = 0;  ///< J_0 [1/Pa]
  double fluidity = 0;       ///< 1/η [1/(Pa·s)]; 0 for a solid
  std::vector<Unit> units;

  double compliance(double t) const;  ///< J(t) [1/Pa]: strain after a step of stress, over the stress; 0 for t < 0
  /// Returns strain over stress if the stress grows linearly from t = 0 to `duration` and is then held; duration 0: a
  /// step.
  double after_ramp(double t, double duration) const;
};

/// Returns the relaxation of a contact law, as its function prony() gives it (laws/law.hpp), sorted by time.
/// \throws InputError naming the law if it has no such function, or if the series is not a sum of positive units that
/// has the law's instantaneous stiffness.
PronySeries prony_series(const Law& law);

/// Returns the creep of the material with this relaxation. The retardation times follow from the zeros of E*(s), which
/// lie between the poles of E*(s). \throws InputError for a series whose moduli are all zero.
CreepSeries creep_series(const PronySeries& relaxation);

/// Returns the error for a law without the function prony(). The error names the missing function and the methods with
/// which the law can be used.
InputError without_prony(const char* law, bool linear);

/// Returns a law of Macadam's list that responds exactly as a series: `elastic` if the series has no units, otherwise
/// the chain `generalised_kelvin` of its creep. `alpha`: shear stiffness over normal stiffness. `name`: a name for
/// messages. \throws InputError for a series that is not a sum of positive units, or that needs more units than a chain
/// may have.
Law equivalent_law(const PronySeries& relaxation, double alpha, const char* name);

/// Returns laws of Macadam's list that respond exactly as these laws, which may belong to a list of the user's own
/// program. Such laws can then be used wherever a LawTable is required: in spectrum_of(), in Harmonic, and in a Scene.
/// \throws InputError naming the law if it is neither in Macadam's list nor has a function prony(); also under the
/// conditions of equivalent_law().
template <class... L>
LawTable equivalent_laws(const std::array<std::optional<std::variant<L...>>, pair_types>& laws) {
  LawTable out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair]) continue;
    out[pair] = std::visit(
        []<class Own>(const Own& own) -> Law {
          if constexpr (std::is_constructible_v<Law, std::in_place_type_t<Own>, Own>)
            return own;
          else if constexpr (has_prony<Own>)
            return equivalent_law(own.prony(), own.alpha, Own::name);
          else
            throw without_prony(Own::name, linear_law<Own>);
        },
        *laws[pair]);
  }
  return out;
}

/// Returns a series with only a few of the units of `series`, with new moduli. The returned series reproduces E(0), and
/// E(t) from `shortest` to `longest` [s], within a relative tolerance.
PronySeries few_units(const PronySeries& series, double shortest, double longest, double tolerance);

/// Returns the largest relative difference of E(t) of `series` from E(t) of `exact`, at t = 0 and from `shortest` to
/// `longest` [s]. If E(t) is smaller than the fraction `least` of E(0), differences are divided by this fraction of
/// E(0) and not by E(t).
double difference(const PronySeries& series, const PronySeries& exact, double shortest, double longest,
                  double least = 1e-9);

/// Range of times and accuracy of a spectrum.
struct SpectrumOptions {
  double shortest = 1e-3, longest = 1e4;  ///< range of times [s]
  double tolerance = 1e-6;                ///< relative tolerance of E(t), for both error measures of Spectrum
  Backend backend = Backend::cpu;         ///< the backend that computes the solutions
  LinearMethod linear = LinearMethod::automatic;
  DeviceList devices = {};
  std::function<bool()> stop = {};  ///< true ends the computation with InterruptedError
  std::function<void(int solutions, double error)> on_progress = {};  ///< called after every round of solutions
};

/// Returns numbers from `first` to `last`, both included, evenly spaced in the logarithm, with `per_decade` or slightly
/// more per decade.
std::vector<double> log_range(double first, double last, int per_decade);

/// The relaxation of a specimen, and its accuracy.
struct Spectrum {
  PronySeries relaxation;
  CreepSeries creep;
  /// Estimate of the largest relative error of E(t) between `shortest` and `longest`. It is computed from the changes
  /// of E(t) in the last two rounds of solutions, from the effect of the solutions' residuals and, if contacts have
  /// rock in series, from the error of the classes to which they belong (host/harmonic/rock_classes.hpp). With the rule
  /// "volumetric" the estimate contains the largest difference of the fit from the solutions instead of the error of
  /// classes, and values of E(t) below 1e-6·E(0) count as 1e-6·E(0) (host/spectrum/volumetric_spectrum.cpp).
  double error = 0;
  /// Largest relative difference of E*(iω) of the series from solutions that were not used to make the series, at
  /// frequencies within the range.
  double checked = 0;
  int solutions = 0;  ///< number of solutions of the whole network
};

/// Returns the uniaxial relaxation of a specimen without inertia (lateral walls as in the network). \throws InputError
/// for a law without a series, for impossible times, for a tolerance below 1e-7 if contacts have rock in series, or for
/// a network with the rule "volumetric" whose laws do not follow from one law of the mastic and an elastic rock;
/// RunError as Harmonic, or if the tolerance is not reached; InterruptedError.
Spectrum spectrum_of(const Specimen& specimen, const ContactNetwork& network,
                     const std::array<std::optional<Law>, pair_types>& laws, const SpectrumOptions& options = {});

}  // namespace macadam
