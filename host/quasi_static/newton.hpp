// SPDX-License-Identifier: GPL-3.0-or-later
/// \file newton.hpp  Finds the equilibrium at the end of an increment by Newton's method.
#pragma once

#include <memory>

#include "host/quasi_static/tangent_solver.hpp"

namespace macadam::quasi_static {

/// The motion of particles and walls in an increment, and the loads at its end.
struct Trial {
  Vector motion;                             ///< [6·particles]
  std::array<Vec3d, wall_count> wall{};      ///< displacement in the increment [m]
  std::vector<Six> relative;                 ///< of the contacts, without their expansion
  std::array<Vec3d, wall_count> reaction{};  ///< external forces that hold the walls [N]
  Vector residual;                           ///< loads that are out of balance [6·particles]
  double size = 0;                           ///< of the residual, see Newton::size_of
  /// Size of all loads of contacts, or of the loads that expansion would cause in particles held in place, if those are
  /// larger. The second number keeps passes from chasing rounding errors in a specimen that expands without stress.
  double scale = 0;
};

class Newton {
 public:
  Newton(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
         const QuasiStaticOptions& options);

  /// Finds the equilibrium from the guess in `trial` (motion and wall). `scale`: the largest Trial::scale so far.
  IncrementReport solve(const WallIncrement& increment, double scale, Trial& trial);

  ContactIncrements& contacts() { return contacts_; }
  const ContactIncrements& contacts() const { return contacts_; }
  const char* solver_name() const { return solver_->name(); }
  std::int64_t bytes() const { return contacts_.bytes() + matrix_.bytes(); }

 private:
  void evaluate(const WallIncrement& increment, Trial& trial);
  /// Returns the size of the loads that the expansion of an increment causes if no particle moves. The contacts must
  /// have been evaluated for this increment.
  double restrained_size(const WallIncrement& increment) const;
  void assemble(bool symmetric, IncrementReport& report);
  void find_wall_stiffness();
  /// Prepares the solver with the present tangent and solves for the correction and, if the motion of the top wall is
  /// unknown, for the motion that a unit displacement of the wall causes.
  /// `whole_tangent`: whether its antisymmetric part is used in any case.
  bool correct(const Trial& trial, double tolerance, bool wall_unknown, bool whole_tangent, IncrementReport& report,
               Vector& correction, Vector& by_wall);
  /// Returns how accurately the linear system is solved if the residual has this size: two more corrections shall
  /// reach the residual that is asked for.
  double tolerance_of(double residual) const;
  /// Returns the amount by which the condition for the wall is missed, divided by its scale.
  double missed(const WallIncrement& increment, const Trial& trial) const;
  /// Returns the correction of the wall's displacement that fulfils the condition.
  double wall_correction(const WallIncrement& increment, const Trial& trial, const Vector& correction,
                         const Vector& by_wall) const;
  /// Returns the change of ContactIncrements::opening() under a motion of the particles.
  double opening_change(const Vector& motion) const;
  double size_of(const Vector& loads) const;

  const ContactNetwork& network_;
  QuasiStaticOptions options_;
  std::size_t particles_;
  ContactIncrements contacts_;
  TangentMatrix matrix_;
  std::unique_ptr<TangentSolver> solver_;
  Vector intact_;                        ///< diagonal of the intact, instantaneous stiffness
  bool friction_matters_ = false;        ///< whether a symmetric tangent has converged slowly
  double least_scale_ = 0;               ///< of Trial::scale in this increment
  double wall_stiffness_ = 0;            ///< derivative of the top wall's reaction with respect to its displacement
  std::vector<std::uint32_t> at_walls_;  ///< the contacts at walls, in the network's order
};

}  // namespace macadam::quasi_static
