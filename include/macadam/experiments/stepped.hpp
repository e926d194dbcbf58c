// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepped.hpp  Defines whether an experiment can be stepped in time, and the report of a stepped run.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/backend.hpp"

namespace macadam::experiments {

/// Whether an experiment is stepped in time. `never`: it cannot be stepped. `if_asked`: it is stepped only if the scene
/// asks for this. `usual`: it is stepped unless the scene asks for another method.
enum class Stepping : std::uint8_t { never, if_asked, usual };

/// Report on how an experiment was stepped.
struct Stepped {
  /// Wall time before the first stepper was made, harmonic solutions included. A resumed run has the value of the
  /// interrupted run.
  double seconds_planning = 0;
  ContactForm form = ContactForm::condensed;  ///< contact form, geometry and precision of the run
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  std::int64_t bytes = 0;               ///< Stepper::bytes()
  std::int32_t critical_particle = -1;  ///< the particle that determines the critical time step; −1: the platen
  double critical_dt_s = 0;             ///< the critical time step at true mass
};

}  // namespace macadam::experiments
