// SPDX-License-Identifier: GPL-3.0-or-later
/// \file spectrum.hpp  Relaxation and creep of a specimen at any time, without a step in time.
///
/// A network of springs and dashpots without inertia relaxes as a sum of exponentials, E(t) = E_∞ + Σ g_i·e^(−t/τ_i)
/// with positive g_i. Its solutions at some real s > 0 (the Laplace variable) span a space of motions in which these
/// g_i and τ_i are those of one small symmetric eigenvalue problem; creep follows from the same numbers. More solutions
/// are taken until E(t) is known.
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

/// Relaxation modulus as a sum of Maxwell units, times ascending.
struct PronySeries {
  struct Unit {
    double modulus;  ///< g [Pa], positive
    double time;     ///< τ [s]
  };
  double long_term = 0;  ///< E_∞ [Pa]: 0 for what flows
  std::vector<Unit> units;

  double instantaneous() const;    ///< E(0) [Pa]
  double modulus(double t) const;  ///< E(t) [Pa]: stress after a step of strain, over it; 0 before
  /// Stress over strain where the strain grows evenly from t = 0 to `duration`, and is held; 0: a step.
  double after_ramp(double t, double duration) const;
  std::complex<double> stiffness(std::complex<double> s) const;  ///< E*(s) [Pa], for motions as e^(s·t)
  std::complex<double> stiffness(double) const = delete;         // iω, not ω
};

/// Creep compliance as a chain of Kelvin units in series with a spring and a dashpot, times ascending.
struct CreepSeries {
  struct Unit {
    double compliance;  ///< J [1/Pa], positive
    double time;        ///< retardation time [s]
  };
  double instantaneous = 0;  ///< J_0 [1/Pa]
  double fluidity = 0;       ///< 1/η [1/(Pa·s)]: 0 for what does not flow
  std::vector<Unit> units;

  double compliance(double t) const;  ///< J(t) [1/Pa]: strain after a step of stress, over it; 0 before
  /// Strain over stress where the stress grows evenly from t = 0 to `duration`, and is held; 0: a step.
  double after_ramp(double t, double duration) const;
};

/// The relaxation of a contact law: the poles and residues of its stiffness. \throws InputError for a law that is no
/// chain with positive constants.
PronySeries prony_series(const Law& law);

/// The same solid's or fluid's creep, from the zeros that lie between the poles. \throws InputError for a series
/// without any modulus.
CreepSeries creep_series(const PronySeries& relaxation);

/// A few units of a series, as many as keep its E(t) between two times, and E(0), to a relative tolerance.
PronySeries few_units(const PronySeries& series, double shortest, double longest, double tolerance);

/// The largest relative difference of E(t) from `exact`, at 0 and between two times.
double difference(const PronySeries& series, const PronySeries& exact, double shortest, double longest);

/// Where and how exactly a spectrum shall be known.
struct SpectrumOptions {
  double shortest = 1e-3, longest = 1e4;  ///< times [s]
  double tolerance = 1e-6;                ///< of E(t), relative, by both measures of Spectrum
  Backend backend = Backend::cpu;         ///< of the solutions
  LinearMethod linear = LinearMethod::automatic;
  DeviceList devices = {};
  std::function<bool()> stop = {};                             ///< true ends with InterruptedError
  std::function<void(int solutions, double error)> told = {};  ///< after every round
};

/// From `first` to `last`, both among them, evenly in the logarithm: `per_decade` of them a decade, or a little more.
std::vector<double> log_range(double first, double last, int per_decade);

/// What a specimen's relaxation is, and how well it is known.
struct Spectrum {
  PronySeries relaxation;
  CreepSeries creep;
  /// Estimate of the largest relative error of E(t) between `shortest` and `longest`, from what the last two rounds of
  /// solutions changed, and what their residuals may leave.
  double error = 0;
  /// Largest relative difference of E*(iω) from solutions that have no part in the series, at frequencies of the range.
  double checked = 0;
  int solutions = 0;  ///< of the whole network
};

/// The uniaxial relaxation of a specimen without inertia (sides as the network has them). \throws InputError for a law
/// without a series, or times that make no sense; RunError as Harmonic does, or where the tolerance is not reached;
/// InterruptedError.
Spectrum spectrum_of(const Specimen& specimen, const ContactNetwork& network,
                     const std::array<std::optional<Law>, pair_types>& laws, const SpectrumOptions& options = {});

}  // namespace macadam
