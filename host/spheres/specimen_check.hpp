// SPDX-License-Identifier: GPL-3.0-or-later
/// \file specimen_check.hpp  What is wrong with a specimen, before anyone knows which file or line to blame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "macadam/specimen.hpp"

namespace macadam {

/// No specimen has more: contact points are numbered in 32 bits and there are about forty a particle.
inline constexpr std::int64_t most_particles = 100'000'000;

/// One thing wrong with a specimen; the parts of an InputError that do not depend on where the specimen came from.
struct SpecimenFault {
  std::int64_t particle = -1;  ///< specimen order; −1 when the box or an array as a whole is at fault
  std::string what, found, expected;
};

/// The first fault of `specimen`, if it has one. O(n log n).
std::optional<SpecimenFault> find_fault(const Specimen& specimen);

/// A number as messages show it.
std::string shown(double value);

}  // namespace macadam
