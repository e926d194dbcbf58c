// SPDX-License-Identifier: GPL-3.0-or-later
/// \file newton.hpp  Finds the equilibrium at the end of an increment by Newton's method.
#pragma once

#include "host/quasi_static/engine.hpp"

namespace macadam::quasi_static {

/// The motion of the walls in an increment, and the sums at its end. The engine has the motion of the particles.
struct Trial {
  Walls wall{};  ///< displacement in the increment [m]
  TrialSums sums;
};

class Newton {
 public:
  Newton(std::unique_ptr<Engine> engine, const QuasiStaticOptions& options)
      : options_(options), engine_(std::move(engine)) {}

  /// Finds the equilibrium, from the motion of the last increment times `factor`, and from the motion of the walls in
  /// `trial`. `scale`: the largest TrialSums::scale so far.
  IncrementReport solve(const WallIncrement& increment, double factor, double scale, Trial& trial);

  Engine& engine() { return *engine_; }
  const Engine& engine() const { return *engine_; }

 private:
  /// Prepares the solver with the present tangent and solves for the correction and, if the motion of the top wall is
  /// unknown, for the motion that a unit displacement of the wall causes.
  bool correct(double tolerance, bool wall_unknown, IncrementReport& report);
  /// Returns the amount by which the condition for the wall is missed, divided by its scale.
  double missed(const WallIncrement& increment, const TrialSums& sums) const;
  /// Returns the correction of the wall's displacement that fulfils the condition.
  double wall_correction(const WallIncrement& increment, const TrialSums& sums);

  QuasiStaticOptions options_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace macadam::quasi_static
