// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stability.hpp  Declares the cases that test the stability of the time stepping under extreme conditions. Each
/// case states the expected result, measures it and gives a verdict.
///
/// A case is a function that takes an effort and returns rows. The program stability_bench runs all cases and writes
/// the table; tests/step/stability_test.cpp runs the same functions with little effort.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "macadam/harmonic.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::stability {

/// How long the cases may take together: seconds (`test`), less than a minute (`quick`), a quarter of an hour (`full`).
enum class Effort { test, quick, full };

/// Returns the one of three values that belongs to an effort.
template <class T>
T by_effort(Effort effort, T test, T quick, T full) {
  return effort == Effort::test ? test : effort == Effort::quick ? quick : full;
}

/// Backend and precision of a run.
struct Setting {
  Backend backend = Backend::cpu;
  Precision precision = Precision::double_;
  /// Returns for example `"cpu, double"`.
  std::string name() const;
  /// Unit roundoff of the contact geometry: 2⁻⁵³, or 2⁻²⁴ where it is in single precision.
  double rounding() const { return precision == Precision::double_ ? 0x1p-53 : 0x1p-24; }
};

/// Returns cpu in every precision, then cuda in every precision if a device is available.
std::vector<Setting> settings();

/// One line of the table. It passes if low ≤ measured ≤ high (never for NaN).
struct Row {
  std::string what;          ///< variant of the case
  std::string setting;       ///< Setting::name(), or the name of another solver
  std::string quantity;      ///< name of the measured quantity, with its unit
  double low = 0, high = 0;  ///< expected range
  std::string reason;        ///< reason for the expected range
  double measured = 0;
  bool detail = false;  ///< only in the CSV, not on the page that scripts/documents makes from it
  bool pass() const { return low <= measured && measured <= high; }
};
using Rows = std::vector<Row>;

/// A named case.
struct Case {
  std::string name;   ///< as in `--cases NAME`
  std::string title;  ///< heading in the table
  std::function<Rows(Effort)> run;
};

/// All cases, in the order of the table.
const std::vector<Case>& cases();

Rows step_sweep(Effort);         ///< time steps of 0.5 … 1.1 of 2/ω_max
Rows step_bound(Effort);         ///< critical_step() compared with 2/ω_max on 20 specimens
Rows stiffness_ratios(Effort);   ///< stiffness ratios of 1 … 1e6 between the phases
Rows size_ratios(Effort);        ///< radius ratios of 1:1 … 1:50
Rows slivers(Effort);            ///< facets down to 1e-8 of the mean area
Rows relaxation_times(Effort);   ///< relaxation times of 1e-6 … 1e6 steps
Rows long_free(Effort);          ///< 1e8 steps of two particles, 1e7 of a hundred: energy and momenta
Rows long_driven(Effort);        ///< the same numbers of steps under load: E*
Rows strain_amplitudes(Effort);  ///< strains of 1e-6 … 1e-2, with both geometries
Rows recovery(Effort);           ///< displacement after load, hold, reversal and release
Rows rigid_turn(Effort);         ///< a full turn of a free specimen
Rows cracks(Effort);             ///< cracks: chatter, reversal, least fracture energy, stiffness ratios up to 1e6

// ---- scenes and measurements that several cases use (scenes.cpp)

/// Returns elastic contacts of 30 GPa and α = 0.3 everywhere, which dissipate no energy.
test::Laws elastic_laws();

/// Returns a law that reaches a steady state within a few hundred steps of `dt` and still dissipates energy.
laws::GeneralisedKelvin quick_law(double dt);

/// Returns about `particles` generated spheres: some aggregates in mastic.
Specimen generated_specimen(std::uint64_t seed, int particles);

/// Returns the contacts of a network with four points each, which have the six area moments of `Contact::moments`. The
/// reference implementation sums over points, so with these contacts it uses the quadrature of the network. The points
/// are at the centroid ± √2 times the columns of L, where C = L·Lᵀ is the covariance of the facet, with a quarter of
/// the area each; then Σ A_J·x·xᵀ = A·C.
ContactNetwork with_points_of_moments(const ContactNetwork& network);

/// Returns 2/ω_max from the dense eigenvalues of the reference implementation, with the moments of the network's
/// quadrature.
double true_limit(const test::TestScene& scene);

/// Returns the frequency-domain solution of a scene. Only one is computed at a time, because cases run in parallel and
/// the solver's libraries may share state.
HarmonicResult harmonic_solution(const test::TestScene& scene, double frequency, double density_scaling = 0,
                                 double residual = 1e-11);

/// Sets random half-step velocities and spins up to `speed` (of the centres, and of points on the surface).
void shake(Stepper& stepper, const test::TestScene& scene, double speed);

/// Returns ½·m·v² + ½·I·ω² at the half step [J].
double kinetic_energy(const test::TestScene& scene, const ParticleState& state);

/// Makes a stepper (the object that performs the time steps) with the backend and precision of a setting.
std::unique_ptr<Stepper> make(const Setting& setting, const test::TestScene& scene, StepperOptions options);

/// Returns the largest kinetic energy of a run, divided by the bound for leapfrog. The run starts from random
/// velocities without deformation. Leapfrog keeps H = ½·v(k−½)·M·v(k+½) + ½·q·K·q ≥ (1 − (Δt/limit)²)·kinetic energy,
/// and initially H is the kinetic energy, so the result must be at most 1.
double energy_over_bound(const Setting& setting, const test::TestScene& scene, const StepperOptions& options,
                         double limit, std::int64_t steps, double speed = 1e-3);

/// Steps a loaded stepper through `cycles` cycles. Returns 100 samples of the last cycle, and the first sample of the
/// next. \throws RunError if the run diverges.
std::vector<ResponseSample> last_cycle(Stepper& stepper, const Specimen& specimen, const drives::Cyclic& loading,
                                       std::int64_t cycles);

/// Returns E* of the fundamental frequency of one cycle, as a Fourier sum. Higher harmonics do not affect it; a drift
/// does.
Stiffness fundamental(const std::vector<ResponseSample>& samples);

/// Returns |E₁·e^{iφ₁} − E₂·e^{iφ₂}| / |E₂|.
double stiffness_difference(const Stiffness& found, const Stiffness& expected);

}  // namespace macadam::stability
