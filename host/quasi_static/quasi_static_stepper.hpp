// SPDX-License-Identifier: GPL-3.0-or-later
/// \file quasi_static_stepper.hpp  Runs a test by quasi-static increments behind the interface of a stepper, so that
/// tests, result files, fields and checkpoints are the same for both methods.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "host/quasi_static/increments.hpp"

namespace macadam {

/// A stepper whose time step is only the unit of time: an increment lasts a whole number of steps, which the stepper
/// chooses. It is at the step that a caller asked for at each of QuasiStaticCourse::stops; between them it may be
/// ahead.
class QuasiStaticStepper : public Stepper {
 public:
  /// Specimen and network must outlive this object. `boundary`: only the top wall may move, along z. \throws InputError
  /// as QuasiStatic does, and for other boundaries.
  QuasiStaticStepper(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                     const Boundary& boundary, quasi_static::CourseOptions options);

  /// Starts from a state of motion, as QuasiStatic::start().
  void start(const StartState& state) { increments_.start(state); }
  void advance(std::int64_t steps) override;
  Observation observe() const override;
  ParticleState particles() const override { return increments_.network().particles(); }
  ContactState contacts(const ContactNetwork&) const override { return increments_.network().contacts(); }
  std::vector<Break> point_breaks(const ContactNetwork&) const override { return increments_.network().point_breaks(); }
  std::vector<laws::PointCrack> point_cracks(const ContactNetwork&) const override {
    return increments_.network().point_cracks();
  }
  void set_velocities(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin) override;
  std::vector<StateArray> state() const override;
  void set_state(const std::vector<StateArray>& arrays) override;
  std::int64_t first_divergent() const override { return -1; }
  std::string description() const override { return increments_.network().description(); }
  std::int64_t bytes() const override { return increments_.network().bytes(); }

  /// Calls f after each increment, with the observation at its end.
  void after_each(std::function<void(const Observation&)> f) { after_each_ = std::move(f); }
  const quasi_static::CourseReport& report() const { return increments_.report(); }
  /// As QuasiStatic::survey_cracks().
  std::optional<experiments::CrackSurvey> survey_cracks() const { return increments_.network().survey_cracks(); }
  const QuasiStaticEnergies& energies() const { return increments_.network().energies(); }

 private:
  Observation observed(std::int64_t step) const;

  double dt_;
  quasi_static::Increments increments_;
  std::int64_t asked_ = 0;  ///< step that the caller has asked for; at most the step of the increments
  std::function<void(const Observation&)> after_each_;
};

}  // namespace macadam
