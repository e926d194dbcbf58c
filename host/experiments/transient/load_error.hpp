// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_error.hpp  Computes the error of a stepped test of a load. The error is the difference from the response
/// without time steps, if this response is known; otherwise it is estimated.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/experiments/transient/load_plan.hpp"

namespace macadam {

/// The relaxation of the specimen. From it the response to any load is computed without time steps.
struct UnsteppedAnswer {
  PronySeries relaxation;  ///< relaxation of the whole specimen
  double error = 0;        ///< estimated relative error of E(t) and J(t)
};

/// Computes the relaxation for the times of the rows of the result. If that fails, returns nothing and appends the
/// reason to the decisions of the plan. \throws InterruptedError
std::optional<UnsteppedAnswer> solve_unstepped(const TransientExperiment& test, const Scene& scene,
                                               const Preparation& prepared, const Watcher& watcher, Backend backend,
                                               LoadPlan& plan);

/// Relative errors of the rows in the result of one stepped test: errors of the stress or, if the load is a stress, of
/// the strain.
class LoadErrors {
 public:
  /// `heavy_density`: mean density, including the density scaling [kg/m³]. The plan must outlive this object.
  LoadErrors(const TransientExperiment& test, const Scene& scene, const Preparation& prepared, double heavy_density,
             const LoadPlan& plan, const std::optional<UnsteppedAnswer>& unstepped);

  /// Returns the error of a row. `before`: the earlier rows.
  double of(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;

  /// Returns a text that says by how much the ramp of the run changes E(t) or J(t) from their values after a sudden
  /// load; empty if the change is not known or zero.
  std::string ramp_words() const;

  /// Returns a text that explains the column `error` in the table of results.
  std::string meaning() const;

  /// Returns a warning that names the row with the largest error, its cause and what reduces it; empty if no error is
  /// above 1 %.
  std::string warning(const std::vector<experiments::SteppedPoint>& rows) const;

 private:
  /// The error from the ramp of the run, if the scene asks for an instantaneous load, and the remaining error.
  struct Parts {
    double ramp = 0, remainder = 0;
  };
  bool is_known(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;
  Parts measured(const experiments::SteppedPoint& row) const;
  Parts estimated(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;
  double estimated_of_history(const experiments::SteppedPoint& row,
                              const std::vector<experiments::SteppedPoint>& before) const;
  double walls(const experiments::SteppedPoint& row) const;
  double modulus(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;
  double rate(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before,
              double modulus, double window) const;
  double value(const experiments::ResponsePoint& p) const { return test_.by_stress ? p.strain : p.stress_pa; }
  double asked_ramp() const { return test_.when.ramp; }
  bool is_released(double time) const { return asked_.release && time > *asked_.release; }
  std::string advice(const Parts& parts) const;

  const TransientExperiment test_;
  const LoadPlan& plan_;
  std::optional<Spectrum> spectrum_;
  LoadTimes asked_, run_;  ///< times in the scene, and times in the run, where the release is rounded to a whole step
  bool updated_ = true, damping_given_ = false;
  /// Whether the particles start with the velocities of the strain rate. The start then causes no waves, and the stress
  /// falls after its peak, so that errors are relative to the largest stress so far.
  bool in_motion_ = false;
  bool remembers_ = false;     ///< whether a law relaxes; if none does, only the present load has an effect
  double affine_modulus_ = 0;  ///< upper bound of the instantaneous modulus [Pa]
  /// ω² of the slowest wave divided by the modulus: π²/(ρ·H²); a quarter of this value if the load is a stress.
  double wave_ = 0;
};

}  // namespace macadam
