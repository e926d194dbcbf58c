// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stability.hpp  Stability under stress: cases that state what must come out, measure it and judge themselves.
///
/// A case is a function from an effort to rows. The program stability_bench runs them all and writes the table;
/// tests/stability_test.cpp runs the same functions with little effort.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "macadam/harmonic.hpp"
#include "tests/test_scenes.hpp"

namespace macadam::stability {

/// How long a case may take: seconds in all (`test`), below a minute (`quick`), a quarter of an hour (`full`).
enum class Effort { test, quick, full };

/// The entry of three that belongs to an effort.
template <class T>
T by_effort(Effort effort, T test, T quick, T full) {
  return effort == Effort::test ? test : effort == Effort::quick ? quick : full;
}

/// Who computes, and how precisely.
struct Setting {
  Backend backend = Backend::cpu;
  Precision precision = Precision::double_;
  /// e.g. `"cpu, double"`
  std::string name() const;
  /// Unit roundoff of what contacts see: 2⁻⁵³, or 2⁻²⁴ where geometry is in single precision.
  double rounding() const { return precision == Precision::double_ ? 0x1p-53 : 0x1p-24; }
};

/// cpu in every precision, then cuda where a device answers.
std::vector<Setting> settings();

/// One line of the table. It passes where low ≤ measured ≤ high (never for NaN).
struct Row {
  std::string what;          ///< which variant of the case
  std::string setting;       ///< Setting::name(), or what computed it
  std::string quantity;      ///< what is measured, with its unit
  double low = 0, high = 0;  ///< what is expected
  std::string reason;        ///< why
  double measured = 0;
  bool detail = false;  ///< in the CSV only, not on the page that scripts/documents makes of it
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

Rows step_sweep(Effort);         ///< 0.5 … 1.1 of 2/ω_max
Rows step_bound(Effort);         ///< critical_step() against 2/ω_max on 20 specimens
Rows stiffness_ratios(Effort);   ///< 1 … 1e6 between the phases
Rows size_ratios(Effort);        ///< 1:1 … 1:50
Rows slivers(Effort);            ///< facets down to 1e-8 of the mean
Rows relaxation_times(Effort);   ///< 1e-6 … 1e6 steps
Rows long_free(Effort);          ///< 1e8 steps of two particles, 1e7 of a hundred: energy and momenta
Rows long_driven(Effort);        ///< likewise: E*
Rows strain_amplitudes(Effort);  ///< 1e-6 … 1e-2, both geometries
Rows recovery(Effort);           ///< load, hold, reversal, release
Rows rigid_turn(Effort);         ///< a full turn

// ---- scenes and measures that cases share (scenes.cpp)

/// Elastic contacts everywhere, 30 GPa and α = 0.3: nothing takes energy.
test::Laws elastic_laws();

/// A chain that settles within a few hundred steps of `dt` and still dissipates: a steady state is soon reached.
laws::GeneralisedKelvin quick_law(double dt);

/// About `particles` spheres by the generator: some aggregates in mastic.
Specimen generated_specimen(std::uint64_t seed, int particles);

/// The same contacts with four points each that have the six area moments of `Contact::moments`, so that the reference,
/// which sums over points, sees the network's own quadrature: with the covariance C = L·Lᵀ of the facet, points at the
/// centroid ± √2·L's columns and a quarter of the area each have Σ A_J·x·xᵀ = A·C.
ContactNetwork with_points_of_moments(const ContactNetwork& network);

/// 2/ω_max by the reference's dense spectrum, moments of the network's own quadrature.
double true_limit(const test::TestScene& scene);

/// The harmonic solution of a scene, one at a time: cases run side by side, the solver's libraries may share state.
HarmonicResult harmonic_solution(const test::TestScene& scene, double frequency, double density_scaling = 0,
                                 double residual = 1e-11);

/// Random half-step velocities and spins up to `speed` (of centres, and of points on the surface).
void shake(Stepper& stepper, const test::TestScene& scene, double speed);

/// ½·m·v² + ½·I·ω² at the half step [J].
double kinetic_energy(const test::TestScene& scene, const ParticleState& state);

/// Stepper of a setting.
std::unique_ptr<Stepper> make(const Setting& setting, const test::TestScene& scene, StepperOptions options);

/// Largest kinetic energy over what leapfrog allows, from a shaken start with nothing stretched. Leapfrog keeps
/// H = ½·v(k−½)·M·v(k+½) + ½·q·K·q ≥ (1 − (Δt/limit)²)·kinetic, and at the start H is the kinetic energy: at most 1.
double energy_over_bound(const Setting& setting, const test::TestScene& scene, const StepperOptions& options,
                         double limit, std::int64_t steps, double speed = 1e-3);

/// Steps `cycles` cycles of a loaded stepper and returns 100 samples of the last, and the first of the next.
/// \throws RunError where it diverges.
std::vector<ResponseSample> last_cycle(Stepper& stepper, const Specimen& specimen, const drives::Cyclic& loading,
                                       std::int64_t cycles);

/// E* of the fundamental of one cycle, by its Fourier sum: harmonics do not leak into it, a drift does.
Stiffness fundamental(const std::vector<ResponseSample>& samples);

/// |E₁·e^{iφ₁} − E₂·e^{iφ₂}| / |E₂|
double stiffness_difference(const Stiffness& found, const Stiffness& expected);

}  // namespace macadam::stability
