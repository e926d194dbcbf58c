// SPDX-License-Identifier: GPL-3.0-or-later
/// \file harmonic.hpp  Declares the solver of the frequency domain. It computes the steady state of a linear scene,
/// (K*(s) + s²·M)·u = f for motions e^(s·t): docs/model.md, section 15.
///
/// It uses the same contact network, area moments and wall contacts as the time stepping, with the initial geometry. So
/// it is both the accuracy reference of every explicit run and the fast way to |E*| and φ.
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
#include "macadam/wall_motion.hpp"

namespace macadam {

/// Largest number of particles for which the direct solver is chosen automatically. Its memory grows about as n^(4/3)
/// with the number n of particles: 2 GB for 35,760 particles.
inline constexpr std::size_t largest_direct = 100'000;

/// Options of the solver.
struct HarmonicOptions {
  /// Largest accepted relative residual ‖f − K·u‖ / ‖f‖. The part of the residual that is explained by the rounding of
  /// u is not counted.
  double tolerance = 1e-11;
  LinearMethod linear = LinearMethod::automatic;
  /// Backend of the iterative solver, cpu or cuda (automatic: as select_backend()). Everything else runs on the CPU.
  Backend backend = Backend::cpu;
  DeviceList devices = {};          ///< for cuda; the first one becomes the current device of the calling thread
  std::function<bool()> stop = {};  ///< called between iterations; true ends a solution with InterruptedError
  /// Typical real part of s [1/s]; the preconditioner is made for this s and the typical frequency.
  double typical_growth = 0;
};

/// One problem to solve: motions proportional to e^(s·t) with s = growth + 2πi·frequency. `density_scaling` (inertia)
/// and viscous damping have the same meaning as in a stepped run; see Harmonic::solve().
struct HarmonicLoad {
  double frequency_hz = 0, density_scaling = 0, viscous_damping = 0;
  double growth = 0;  ///< real part of s [1/s]: 0 for the steady state; positive for Laplace transforms

  /// Initial solution: HarmonicResult::motion of a similar problem, or nullptr.
  const std::vector<std::complex<double>>* near = nullptr;

  WallMotion top = {};  ///< motion of the top wall; all other walls are at rest

  std::complex<double> s() const { return {growth, 2 * std::numbers::pi * frequency_hz}; }
};

/// Result of one problem. If the top wall turns, the modulus is the shear modulus G*, and the reactions are torques.
struct HarmonicResult {
  double frequency_hz = 0, growth = 0;  ///< as in the problem (HarmonicLoad)
  WallMotion wall = {};                 ///< as in the problem (HarmonicLoad::top)
  Stiffness top;                        ///< from the reaction of the top wall, computed from the energy of the motion
  Stiffness bottom;                     ///< from the reaction of the bottom wall; equal to `top` without inertia
  ModulusParts parts;                   ///< parts of E*; their sum is the complex modulus of `top`
  double residual = 0;                  ///< relative residual, computed from the solution after the iteration
  int iterations = 0;
  LinearMethod linear = LinearMethod::iterative;  ///< the method that found the solution
  /// The reason if the direct solver was used although the options do not request it.
  std::string why_factors;
  /// Force of the springs that hold free rigid motions, divided by the reaction of the wall. In a correct solution it
  /// is only a rounding error.
  double held_force = 0;
  double seconds = 0;
  /// Complex displacement and rotation of each particle (ux uy uz θx θy θz) per unit motion of the top wall.
  std::vector<std::complex<double>> motion;
  /// With the rule "volumetric": pressure of each cell over 2μ, per unit motion of the top wall [1/m]; otherwise empty.
  /// Pressures are positive in tension.
  std::vector<std::complex<double>> pressures;
};

/// Solves one scene at any number of frequencies; the preconditioner is made once. Specimen and network must outlive
/// this object.
class Harmonic {
 public:
  /// `typical_frequency`: a frequency in the middle of the range to be solved [Hz]. The preconditioner is made for this
  /// frequency.
  ///
  /// \throws InputError naming the particles of a cluster that does not touch both walls, or a pair without a law;
  /// RunError if the stiffness is singular (a mechanism), or if a device does not exist or has too little memory.
  Harmonic(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws, const Inertia& inertia,
           const HarmonicOptions& options, double typical_frequency);
  ~Harmonic();

  /// Returns the steady state at one frequency. `density_scaling` 0 means without inertia. Otherwise the equations
  /// contain density_scaling·(s² + s·β)·M, with the viscous damping β [1/s], as in a stepped run with this density
  /// scaling and damping.
  ///
  /// \throws RunError if the residual does not reach the tolerance; InterruptedError.
  HarmonicResult solve(double frequency_hz, double density_scaling = 0, double viscous_damping = 0);

  /// Solves several problems, four at a time, so that each iteration reads the network once for four problems.
  /// `seconds` of each result is its part of the total time. \throws RunError naming the frequency.
  std::vector<HarmonicResult> solve(const std::vector<HarmonicLoad>& loads);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Returns the complex Poisson's ratio of a specimen with free sides: minus the mean of the two lateral strains over
/// the axial strain. A lateral strain is the change of the mean distance of two opposite sides over their distance; the
/// mean is over the area of the cells' facets at the sides. With the rule "volumetric" a free facet also moves by its
/// opening. Returns nothing if no cell touches one of the four sides.
std::optional<std::complex<double>> poisson_ratio(const Specimen& specimen, const Tessellation& cells,
                                                  const HarmonicResult& state);

/// Returns the state from which a run by time steps is periodic at once, under a cyclic loading without a ramp.
/// `motion`: HarmonicResult::motion, solved with the inertia and damping of the run. The states of a chain follow from
/// f = k*(ω)·x and x_l = f/(k_l + iω·η_l).
StartState steady_start(const ContactNetwork& network, const LawTable& laws,
                        const std::vector<std::complex<double>>& motion, const drives::Cyclic& loading);

}  // namespace macadam
