// SPDX-License-Identifier: GPL-3.0-or-later
/// \file harmonic.hpp  The steady state of a linear scene, (K*(s) + s²·M)·u = f for motions as e^(s·t): docs/model.md,
/// section 15.
///
/// Same contact network, same area moments, same wall contacts as the time stepping (geometry of the start), so that it
/// is both the accuracy reference of every explicit run and the fast way to |E*| and φ.
#pragma once

#include <array>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/linear_method.hpp"
#include "macadam/results.hpp"
#include "macadam/sensitivity.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// Particles whose stiffness is factored unasked: memory grows as about n^(4/3), 2 GB for 35,760.
inline constexpr std::size_t largest_direct = 100'000;

/// What the harmonic solver is told once.
struct HarmonicOptions {
  /// Largest relative residual ‖f − K·u‖ / ‖f‖, beyond what rounding of u alone leaves of K·u.
  double tolerance = 1e-11;
  LinearMethod linear = LinearMethod::automatic;
  /// Where the iteration without factors runs, cpu or cuda (automatic: as select_backend() has it); all else is on the
  /// CPU.
  Backend backend = Backend::cpu;
  DeviceList devices = {};          ///< cuda: the first of them is made the calling thread's, and solves
  std::function<bool()> stop = {};  ///< asked between iterations: true ends a solution with InterruptedError
  double typical_growth = 0;  ///< of the loads [1/s], beside the typical frequency: the preconditioner is made for both
};

/// Motions as e^(s·t), s = growth + 2πi·frequency, with the inertia and viscous damping of a run; see
/// Harmonic::solve().
struct HarmonicLoad {
  double frequency_hz = 0, density_scaling = 0, viscous_damping = 0;
  double growth = 0;  ///< real part of s [1/s]: 0 for the steady state; Laplace transforms take others

  /// Where to begin, of a similar load, or nullptr: HarmonicResult::motion.
  const std::vector<std::complex<double>>* near = nullptr;

  std::complex<double> s() const { return {growth, 2 * std::numbers::pi * frequency_hz}; }
};

/// One frequency's steady state.
struct HarmonicResult {
  double frequency_hz = 0, growth = 0;  ///< of the load
  Stiffness top;                        ///< from the reaction of the top wall, as the energy of the motion gives it
  Stiffness bottom;                     ///< from the reaction of the bottom wall; equal without inertia
  ModulusParts parts;                   ///< of which top is the sum
  double residual = 0;                  ///< relative, computed anew from the solution
  int iterations = 0;
  LinearMethod linear = LinearMethod::iterative;  ///< that found the solution
  std::string why_factors;                        ///< why factors were taken, where they were not asked for
  double held_force = 0;  ///< force that holds free rigid motions / reaction; rounding, where nothing is wrong
  double seconds = 0;
  /// Complex displacement and rotation of each particle (ux uy uz θx θy θz) per unit displacement of the top wall.
  std::vector<std::complex<double>> motion;
};

/// Solves one scene at any number of frequencies; the preconditioner is made once. Specimen and network must outlive
/// it.
class Harmonic {
 public:
  /// `typical_frequency`: one in the middle of those to be solved [Hz]; the preconditioner is made for it.
  /// \throws InputError naming the particles of a cluster that does not touch both walls, or a pair without a law;
  /// RunError when the stiffness is singular (a mechanism), a device is not there or has too little memory.
  Harmonic(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws, const Inertia& inertia,
           const HarmonicOptions& options, double typical_frequency);
  ~Harmonic();

  /// The steady state at one frequency. With a `density_scaling` of 0 it has no inertia. Otherwise it has the term
  /// density_scaling·(s² + s·β)·M, β the viscous damping [1/s], as a stepped run of that scaling and damping has.
  /// \throws RunError when the residual does not come down to the tolerance; InterruptedError.
  HarmonicResult solve(double frequency_hz, double density_scaling = 0, double viscous_damping = 0);

  /// Several at once, which share what is read of the network, four at a time.
  /// `seconds` is each one's part of the whole. \throws RunError naming the frequency.
  std::vector<HarmonicResult> solve(const std::vector<HarmonicLoad>& loads);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The state from which an explicit run is periodic at once: that of `motion` (HarmonicResult::motion, solved with the
/// inertia and damping of the run) under the loading, whose ramp is not there. A chain is f = k*(ω)·x, x_l = f/(k_l +
/// iω·η_l).
StartState steady_start(const ContactNetwork& network, const LawTable& laws,
                        const std::vector<std::complex<double>>& motion, const drives::Cyclic& loading);

}  // namespace macadam
