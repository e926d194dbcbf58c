// SPDX-License-Identifier: GPL-3.0-or-later
/// \file spectrum.hpp  Computes relaxation and creep of a specimen at any time, without time steps.
///
/// A network of springs and dashpots without inertia relaxes as a sum of exponentials, E(t) = E_∞ + Σ g_i·e^(−t/τ_i)
/// with positive g_i. The solutions of the network at some real s > 0 (the Laplace variable) span a space of motions.
/// In this space g_i and τ_i follow from one small symmetric eigenvalue problem, and creep follows from the same
/// numbers. Solutions at further s are added until E(t) is accurate enough.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/linear_method.hpp"

namespace macadam {

/// Relaxation modulus as a sum of Maxwell units, in order of rising times.
struct PronySeries {
  struct Unit {
    double modulus;  ///< g [Pa], positive
    double time;     ///< τ [s]
  };
  double long_term = 0;  ///< E_∞ [Pa]; 0 for a fluid
  std::vector<Unit> units;

  double instantaneous() const;    ///< E(0) [Pa]
  double modulus(double t) const;  ///< E(t) [Pa]: stress after a step of strain, over the strain; 0 for t < 0
  /// Returns stress over strain if the strain grows linearly from t = 0 to `duration` and is then held; duration 0: a
  /// step.
  double after_ramp(double t, double duration) const;
  std::complex<double> stiffness(std::complex<double> s) const;  ///< E*(s) [Pa], for motions e^(s·t)
  std::complex<double> stiffness(double) const = delete;         // deleted, so that ω cannot be passed instead of iω
};

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

/// Returns the relaxation of a contact law, from the poles and residues of its complex stiffness. \throws InputError
/// for a law that is not a chain with positive constants.
PronySeries prony_series(const Law& law);

/// Returns the creep of the material with this relaxation. The retardation times follow from the zeros of E*(s), which
/// lie between the poles of E*(s). \throws InputError for a series whose moduli are all zero.
CreepSeries creep_series(const PronySeries& relaxation);

/// Returns a series with only a few of the units of `series`, with new moduli. The returned series reproduces E(0), and
/// E(t) from `shortest` to `longest` [s], within a relative tolerance.
PronySeries few_units(const PronySeries& series, double shortest, double longest, double tolerance);

/// Returns the largest relative difference of E(t) of `series` from E(t) of `exact`, at t = 0 and from `shortest` to
/// `longest` [s].
double difference(const PronySeries& series, const PronySeries& exact, double shortest, double longest);

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
  /// rock in series, from the error of the classes to which they belong (host/harmonic/rock_classes.hpp).
  double error = 0;
  /// Largest relative difference of E*(iω) of the series from solutions that were not used to make the series, at
  /// frequencies within the range.
  double checked = 0;
  int solutions = 0;  ///< number of solutions of the whole network
};

/// Returns the uniaxial relaxation of a specimen without inertia (lateral walls as in the network). \throws InputError
/// for a law without a series, for impossible times, or for a tolerance below 1e-7 if contacts have rock in series;
/// RunError as Harmonic, or if the tolerance is not reached; InterruptedError.
Spectrum spectrum_of(const Specimen& specimen, const ContactNetwork& network,
                     const std::array<std::optional<Law>, pair_types>& laws, const SpectrumOptions& options = {});

}  // namespace macadam
