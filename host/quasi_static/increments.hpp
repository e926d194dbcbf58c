// SPDX-License-Identifier: GPL-3.0-or-later
/// \file increments.hpp  Chooses the lengths of increments from their errors, and the quantity that controls them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "macadam/drives/drive.hpp"
#include "macadam/error.hpp"
#include "macadam/quasi_static.hpp"
#include "macadam/temperature.hpp"

namespace macadam::quasi_static {

/// The course of a test: the load on the top wall, and how accurately to follow it.
struct CourseOptions {
  std::shared_ptr<const Drive> drive;  ///< of the top wall along z; its dt() is the unit of time
  bool by_force = false;               ///< whether the drive is a force [N], not a displacement [m]
  /// Whether the displacement only grows. Only then can a test be controlled by the opening of cracks.
  bool grows = false;
  double height = 1, area = 1;      ///< of the specimen [m], [m²], for strains and stresses
  double tolerance = 1e-3;          ///< error of the stress (under a force: of the strain), relative to the largest
  std::vector<std::int64_t> stops;  ///< steps at which increments end, rising: samples, and kinks of the drive
  std::vector<std::int64_t> kinks;  ///< those stops at which the rate of the drive jumps
  std::int64_t first = 1;           ///< length of the first increment, and of the first one after a kink [steps]
  std::int64_t longest = 0;         ///< length of the longest increment [steps]; 0: no limit
  TemperatureHistory temperature;   ///< of the specimen; empty: constant. The laws are given at their references
  std::array<laws::Shift, pair_types> shifts{};  ///< of the laws; used only with a temperature history
  QuasiStaticOptions solver;
  std::function<bool()> stop = {};  ///< asked during sudden drops, which can take minutes; true ends them, see Stopped
};

/// What happened in a test.
struct CourseReport {
  std::int64_t increments = 0, rejected = 0, passes = 0, iterations = 0;
  /// Largest estimated error of the stress (under a force: of the strain) so far, relative to the largest one. An error
  /// at a time is the sum of the errors of all increments before, with their signs.
  double error = 0;
  std::int64_t loose = 0;  ///< largest number of particles without stiffness
  double residual = 0;     ///< largest IncrementReport::residual of an accepted increment
  /// The state before the first increment that was controlled by the opening of cracks, because no equilibrium was
  /// found at a larger displacement of the wall.
  struct Unstable {
    double time_s = 0, strain = 0, stress_pa = 0;
  };
  std::optional<Unstable> unstable = {};
  std::int64_t by_opening = 0;  ///< number of increments that were controlled by the opening of cracks
  /// The state before the first sudden drop of the stress that counts in `drops`: no equilibrium was found nearby, so
  /// the specimen moved against a drag, with the wall at rest, until it was in equilibrium again.
  std::optional<Unstable> first_drop = {};
  std::int64_t drops = 0;  ///< number of sudden drops by more than 1 % of the largest stress
};

/// No equilibrium was found, although increments became very short, or at the end of a sudden drop. Holds the last
/// equilibrium.
class NoEquilibrium : public RunError {
 public:
  NoEquilibrium(const std::string& message, const CourseReport::Unstable& last) : RunError(message), last(last) {}
  CourseReport::Unstable last;
};

/// CourseOptions::stop was true in a sudden drop. The state is again that before the drop.
struct Stopped {};

class Increments {
 public:
  Increments(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws, CourseOptions options);

  /// Starts from a state of motion, as QuasiStatic::start().
  void start(const StartState& state);
  /// Takes one increment, which ends at the next stop or earlier. \throws NoEquilibrium, Stopped
  void advance();
  std::int64_t step() const { return step_; }
  const QuasiStatic& network() const { return network_; }
  const CourseReport& report() const { return report_; }

  std::vector<StateArray> state() const;
  void set_state(const std::vector<StateArray>& arrays);

 private:
  /// A quantity whose error is controlled, at one of the last ends of increments.
  struct Past {
    double step, value;
  };
  std::int64_t next_stop() const;
  /// Number of steps of the next increment.
  std::int64_t length_to(std::int64_t stop) const;
  double drive_at(std::int64_t step) const { return options_.drive->value(step - lag_); }
  /// Returns an increment of `steps` steps from the present one, with its duration and the change of temperature.
  WallIncrement increment_of(std::int64_t steps) const;
  double observed_value() const;  ///< of the solution: stress or, under a force, strain
  /// Estimated error of the solution at `step`, divided by the largest observed value so far; negative:
  /// not known.
  double error_at(double step, double value) const;
  /// Returns the value at `step` on the parabola, or line, through the last values (Lagrange). There are at least two.
  double extrapolated(double step) const;
  /// Returns the error that an increment until `step` adds to the value, by the trapezoidal rule, with its sign.
  double error_of_rule(double step, double value) const;
  /// `by_time`: whether the increment has an error of the trapezoidal rule that can be estimated.
  void accept(std::int64_t steps, const IncrementReport& found, bool by_time);
  void advance_by_opening(std::int64_t stop);
  /// Counts an accepted increment.
  void count(const IncrementReport& found);
  /// Takes an increment of `steps` steps, after which no equilibrium is near, and moves the specimen against a drag
  /// until it is in equilibrium again.
  void drop(std::int64_t steps);
  /// Moves the specimen against a drag as drop() does. Returns whether an equilibrium was found.
  bool follow_drop(std::int64_t steps);
  /// Solves an increment and counts its passes.
  IncrementReport solve(const WallIncrement& next);
  [[noreturn]] void fail(const IncrementReport& found) const;

  CourseOptions options_;
  /// Whether the stress drops suddenly if no equilibrium is found. Otherwise the test is controlled by the opening of
  /// cracks, which needs a direct solver.
  bool may_drop_;
  QuasiStatic network_;
  CourseReport report_;
  std::int64_t step_ = 0;
  double length_;           ///< proposed length of the next increment [steps]
  std::vector<Past> past_;  ///< since the last kink, at most three
  double largest_ = 0;      ///< largest value so far
  /// Sum of the errors of the increments with their signs, and the largest magnitude of this sum so far.
  double error_sum_ = 0, largest_error_ = 0;
  /// Length of usual increments [steps], and their openings of cracks [m]: the largest of the last ones.
  double usual_ = 0, usual_opening_ = 0;
  // Control by opening
  bool by_opening_ = false;
  double opening_ = 0;              ///< increase of the openings in the next increment [m]
  std::int64_t opening_steps_ = 0;  ///< steps that an increment then lasts
  double furthest_ = 0;             ///< displacement of the wall at which control by opening began [m]
  std::int64_t lag_ = 0;            ///< steps by which the drive is late since then
};

}  // namespace macadam::quasi_static
