// SPDX-License-Identifier: GPL-3.0-or-later
/// \file load_error.hpp  Error of a stepped test of a load: against the answer without steps where there is one, else
/// an estimate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/experiments/loaded/load_plan.hpp"

namespace macadam {

/// The relaxation of the specimen, which gives the answer to any load without steps.
struct UnsteppedAnswer {
  PronySeries relaxation;  ///< of the whole specimen
  double error = 0;        ///< of E(t) and J(t), relative
};

/// Solves the relaxation for the times of the rows. Returns nothing if that fails, and appends the reason to the
/// decisions of the plan. \throws InterruptedError
std::optional<UnsteppedAnswer> solve_unstepped(const LoadTest& test, const Scene& scene, const Preparation& prepared,
                                               const Watcher& watcher, Backend backend, LoadPlan& plan);

/// Errors of the rows of one stepped test, relative: of the stress, or, where the load is a stress, of the strain.
class LoadErrors {
 public:
  /// `heavy_density`: mean density with the density scaling [kg/m³]. The plan must outlive it.
  LoadErrors(const LoadTest& test, const Scene& scene, const Preparation& prepared, double heavy_density,
             const LoadPlan& plan, const std::optional<UnsteppedAnswer>& unstepped);

  /// The error of a row, after the rows `before`.
  double of(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;

  /// Returns in words how far the ramp of the run takes E(t) or J(t) from those after a step; empty where that is not
  /// known or nothing.
  std::string ramp_words() const;

  /// Says in words what `error` of a table is.
  std::string meaning() const;

  /// Names the row with the largest error, its cause and what lessens it; empty where no error is above 1 %.
  std::string warning(const std::vector<experiments::SteppedPoint>& rows) const;

 private:
  /// The part that the ramp of the run makes where the scene asks for a load at once, and the remainder.
  struct Parts {
    double ramp = 0, remainder = 0;
  };
  bool is_known(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;
  Parts measured(const experiments::SteppedPoint& row) const;
  Parts estimated(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;
  double walls(const experiments::SteppedPoint& row) const;
  double modulus(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before) const;
  double rate(const experiments::SteppedPoint& row, const std::vector<experiments::SteppedPoint>& before,
              double modulus, double window) const;
  double value(const experiments::ResponsePoint& p) const { return test_.by_stress ? p.strain : p.stress_pa; }
  double asked_ramp() const { return test_.when.ramp; }
  bool is_released(double time) const { return asked_.release && time > *asked_.release; }
  std::string advice(const Parts& parts) const;

  const LoadTest test_;
  const LoadPlan& plan_;
  std::optional<Spectrum> spectrum_;
  LoadTimes asked_, run_;  ///< the release rounded to a whole step
  bool updated_ = true, damping_given_ = false;
  bool remembers_ = false;     ///< some law relaxes; if not, only what happens now has an effect
  double affine_modulus_ = 0;  ///< no modulus at once is above it [Pa]
  double wave_ = 0;            ///< π²/(ρ·H²), of a platen a quarter: ω² of the slowest wave over the modulus
};

}  // namespace macadam
