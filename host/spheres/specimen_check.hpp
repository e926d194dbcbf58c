// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_check.hpp  Checks specimens, independently of where they came from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "macadam/specimen.hpp"

namespace macadam {

/// Upper limit of the number of particles. Contact points have 32-bit numbers, and there are about forty contact points
/// per particle. At this limit about 4·10⁹ of the 4.3·10⁹ possible numbers are used.
inline constexpr std::int64_t most_particles = 100'000'000;

/// A fault of a specimen: the parts of an InputError that do not depend on the file and line.
struct SpecimenFault {
  std::int64_t particle = -1;  ///< index in the specimen; −1 if the fault is in the box or in an array as a whole
  std::string what, found, expected;
};

/// Returns the first fault of `specimen`, or nothing if it has none. Takes O(n log n) time.
std::optional<SpecimenFault> find_fault(const Specimen& specimen);

/// Formats a number for messages.
std::string shown(double value);

}  // namespace macadam
