// SPDX-License-Identifier: GPL-3.0-or-later
/// \file newton.hpp  Finds the equilibrium at the end of an increment by Newton's method.
#pragma once

#include "host/quasi_static/engine.hpp"

namespace macadam::quasi_static {

/// The motion of the walls in an increment, and the sums at its end. The engine has the motion of the particles.
struct Trial {
  Vector motion;  ///< the guess of the motion; after accept() the motion of the increment [6·particles]
  Walls wall{};   ///< displacement in the increment [m]
  TrialSums sums;
};

class Newton {
 public:
  Newton(std::unique_ptr<Engine> engine, const QuasiStaticOptions& options)
      : options_(options), engine_(std::move(engine)) {}

  /// Finds the equilibrium, from the motions of particles and walls in `trial`. `scale`: the largest TrialSums::scale
  /// so far.
  IncrementReport solve(const WallIncrement& increment, double scale, Trial& trial);

  Engine& engine() { return *engine_; }
  const Engine& engine() const { return *engine_; }
  /// Whether a correction with a symmetric tangent was slow, so that later corrections use the whole tangent. It is
  /// part of the state of a test.
  /// @{
  bool friction_matters() const { return friction_matters_; }
  void set_friction_matters(bool matters) { friction_matters_ = matters; }
  /// @}

 private:
  /// Prepares the solver with the present tangent and solves for the correction and, if the motion of the top wall is
  /// unknown, for the motion that a unit displacement of the wall causes. `whole_tangent`: whether the antisymmetric
  /// part of the tangent is used in any case.
  bool correct(double tolerance, bool wall_unknown, bool whole_tangent, IncrementReport& report);
  /// Evaluates all contacts at the trial.
  void evaluate(const WallIncrement& increment, Trial& trial);
  /// Returns how accurately the linear system is solved if the residual has this size: two more corrections shall
  /// reach the residual that is asked for.
  double tolerance_of(double residual) const;
  /// Returns the amount by which the condition for the wall is missed, divided by its scale.
  double missed(const WallIncrement& increment, const TrialSums& sums) const;
  /// Returns the correction of the wall's displacement that fulfils the condition.
  double wall_correction(const WallIncrement& increment, const TrialSums& sums);

  QuasiStaticOptions options_;
  std::unique_ptr<Engine> engine_;
  bool friction_matters_ = false;  ///< whether a symmetric tangent has converged slowly
  /// Smallest TrialSums::scale in this increment. It keeps passes from chasing rounding errors in a specimen that
  /// expands without stress.
  double least_scale_ = 0;
};

}  // namespace macadam::quasi_static
