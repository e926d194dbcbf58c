// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepped.hpp  Whether a test is stepped in time, and what is known of one that was.
#pragma once

#include <cstdint>
#include <optional>

#include "macadam/backend.hpp"
#include "macadam/experiments/cracks.hpp"

namespace macadam::experiments {

/// Of a test: it cannot be, it is where the scene asks for it, it is where the scene says nothing.
enum class Stepping : std::uint8_t { never, if_asked, usual };

/// How a test was stepped.
struct Stepped {
  double seconds_planning = 0;  ///< wall time before the first stepper, harmonic solutions included; resumed runs: that
                                ///< of the run that was interrupted
  ContactForm form = ContactForm::condensed;  ///< that ran, likewise the next two
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  std::int64_t bytes = 0;               ///< Stepper::bytes()
  std::int32_t critical_particle = -1;  ///< the particle that sets the critical step; −1: the platen
  double critical_dt_s = 0;             ///< the critical step at true mass
  std::optional<Cracks> cracks = {};    ///< empty where no law of the scene can break
};

}  // namespace macadam::experiments
