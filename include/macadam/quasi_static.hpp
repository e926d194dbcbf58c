// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quasi_static.hpp  Declares the quasi-static method: a network in equilibrium is advanced by increments of
/// time, without inertia, by Newton's method (docs/quasi-static.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/experiments/cracks.hpp"
#include "macadam/experiments/energies.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// Options of a quasi-static solution.
struct QuasiStaticOptions {
  /// Largest force that is out of balance, relative to the forces of the contacts (root mean square over particles).
  double residual = 1e-10;
  /// Largest number of passes of Newton's method per increment.
  int passes = 25;
  /// Systems with at most this number of unknowns are solved by factors of their matrix, larger ones by iterations.
  std::size_t direct_below = 6000;
  /// Returns whether the systems of a specimen with this number of particles are solved by factors.
  bool solves_directly(std::size_t particles) const { return 6 * particles <= direct_below; }
  /// The processor that computes: the CPU, or one CUDA device.
  Backend backend = Backend::cpu;
  /// The CUDA device; empty: the first one.
  DeviceList devices = {};
  /// Opening of each contact per kelvin in a specimen that expands freely, as free_openings() returns it [m/K]; empty:
  /// temperature causes no expansion.
  std::vector<double> expansion = {};
};

/// The motion of the walls in an increment. The displacement of the top wall along z is `wall` unless `load` or
/// `opening` is given.
struct WallIncrement {
  double dt = 0;                         ///< [s]
  std::array<Vec3d, wall_count> wall{};  ///< displacement of each wall in the increment, by wall_index() [m]
  std::optional<double> load;            ///< external force on the top wall along z at the end [N]
  /// Mean increase of the openings of those crack points that grew in the last increment, weighted by their areas [m].
  std::optional<double> opening;
  double warming = 0;  ///< increase of the temperature [K]
  /// Resistance of each point with a crack law to its opening and slip in the increment, divided by the stiffness that
  /// the point would have without a crack. With a large drag there is always a solution. It is not an equilibrium: see
  /// QuasiStatic::drag().
  double drag = 0;
  /// Duration of the increment for the law of each pair type, at the temperature for which the laws are given [s]:
  /// reduced_time(). Empty: `dt` for all laws.
  std::optional<std::array<double, pair_types>> reduced_dt = {};
};

/// The course of Newton's method in an increment.
struct IncrementReport {
  bool converged = false;
  int passes = 0;               ///< linear systems solved
  int iterations = 0;           ///< of the iterative linear solver, in all passes
  double residual = 0;          ///< QuasiStaticOptions::residual reached
  int negative_pivots = 0;      ///< of the symmetric part of the tangent; direct solver only
  bool lost_stability = false;  ///< whether the tangent has a direction of negative stiffness
  std::int64_t loose = 0;       ///< number of particles without stiffness
};

/// Energies since the undeformed state. The kinetic energy is always zero.
struct QuasiStaticEnergies : experiments::Energies {
  /// Work of the stresses on the openings and slips of cracks, by the trapezoidal rule [J]. It differs from
  /// crack_j + friction_j by the error of the increments.
  double crack_work_j = 0;

  /// Returns what is missing in the balance of work, relative to the sum of the energies. It is the error of the
  /// solutions of the increments.
  double imbalance() const;
  /// Returns the difference of the two sums of the energy of cracks, relative to the sum of the energies. It is an
  /// error of the increments' lengths.
  double increment_error() const;
};

/// A specimen in quasi-static equilibrium. Contacts keep their initial geometry.
class QuasiStatic {
 public:
  /// Starts from the undeformed state. Specimen and network must outlive this object. \throws InputError for a law that
  /// is neither linear nor a linear law with a crack (brittle_bond), naming the pair and the law, for the backend
  /// reference, and for several devices; RunError for a device that cannot run, or has too little memory.
  QuasiStatic(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
              const QuasiStaticOptions& options = {});
  ~QuasiStatic();
  QuasiStatic(QuasiStatic&&) noexcept;

  /// Replaces the undeformed state by a state of motion, for example steady_start() (harmonic.hpp). Walls are at rest
  /// in their initial places. Velocities have no effect. The energy that springs then hold is not known, so the
  /// energies have no balance after this call. \throws InputError if a law has a crack, or for a state of another
  /// network.
  void start(const StartState& state);

  /// Solves an increment from the accepted state, and keeps the solution until accept() or the next solve().
  IncrementReport solve(const WallIncrement& increment);
  /// Makes the last solution the accepted state. It must have converged.
  void accept();
  /// Forgets the last solution.
  void reject();

  /// Return measurements of the solution, or of the accepted state if there is no solution since then. Forces are those
  /// of the particles on the walls [N], by wall_index().
  /// @{
  const std::array<Vec3d, wall_count>& wall_force() const;
  const std::array<Vec3d, wall_count>& wall_displacement() const;
  /// Returns the part of the crack points that grow, by area; 0 if no law has a crack.
  double growing_area() const;
  /// @}
  /// Mean increase of the openings of the crack points that grew in the last accepted increment, weighted by their
  /// areas [m]; 0 if none grew.
  double last_opening() const;
  /// Size of the drag at the end of the last accepted increment: twice the energy that springs with the stiffnesses of
  /// the points would store under its stresses [J]; 0 in equilibrium.
  double drag() const;

  double time() const;                          ///< of the accepted state [s]
  const QuasiStaticEnergies& energies() const;  ///< of the accepted state
  /// Displacements and rotations of the accepted state, with zero velocities.
  ParticleState particles() const;
  /// Forces and deformation of the contacts in the accepted state; chains in the format of Stepper::contacts().
  ContactState contacts() const;
  /// Cracks, and breaks, of all points in the accepted state, network order.
  std::vector<laws::PointCrack> point_cracks() const;
  std::vector<Break> point_breaks() const;
  /// Returns the cracks of the accepted state in short if a device has the states; point_cracks() would copy all of
  /// them. Empty on the CPU.
  std::optional<experiments::CrackSurvey> survey_cracks() const;

  /// Everything that accept() changes, as for Stepper::state(). \throws RunError after an increment with a drag.
  std::vector<StateArray> state() const;
  /// Restores a state. If that is not possible, changes nothing. \throws RunError naming the array that does not fit.
  void set_state(const std::vector<StateArray>& arrays);

  std::string description() const;  ///< for example "quasi-static, cpu, double, direct solver"
  std::int64_t bytes() const;       ///< of states and matrices

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace macadam
