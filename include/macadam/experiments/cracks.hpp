// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cracks.hpp  Describes the contact points that broke during a stepped test.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "macadam/laws/facts.hpp"

namespace macadam::experiments {

/// A contact point that was intact at one sample and broken at the next.
struct CrackEvent {
  std::uint32_t contact = 0, point = 0;  ///< indices in `contacts` and in the point arrays of ContactNetwork
  Break how = Break::none;
  double time_s = 0;                 ///< time of the first sample at which the point is broken
  double opening_m = 0, slip_m = 0;  ///< of the point's crack at that time; 0 if its law has no crack
};

/// Broken points of one pair type.
struct PairCracks {
  std::int64_t points = 0, tension = 0, shear = 0;  ///< broken points, and how they broke
  double area_m2 = 0;                               ///< area of the broken points [m²]
  std::int64_t breakable = 0;                       ///< points whose law can break, intact or broken
  std::optional<double> first_s;                    ///< time of the first event [s]
  std::int64_t cracked = 0;                         ///< points that have begun to crack, broken points included
  double cracked_area_m2 = 0;                       ///< area of these points [m²]
};

/// Damage of all contact points at one time, in scenes whose laws have a crack (docs/cracks.md).
struct CrackSums {
  std::int64_t cracked = 0;      ///< number of points that have begun to crack, separated points included
  double crack_energy_j = 0;     ///< energy that damage has dissipated, and energy that open cracks store [J]
  double friction_energy_j = 0;  ///< work of friction [J]
  std::array<double, pair_types> cracked_area_m2{};  ///< area of the cracked points, by PairType [m²]
};

/// The cracks of all contact points at one time, as a device counts them. The states of the points stay on the device.
struct CrackSurvey {
  std::vector<CrackEvent> broken;                  ///< all broken points, by number; without a time
  std::array<std::int64_t, pair_types> cracked{};  ///< number of points that have begun to crack, by PairType
  CrackSums sums;
};

/// Broken points of a test.
struct Cracks {
  std::vector<CrackEvent> events;              ///< by time, then by contact and point
  std::array<PairCracks, pair_types> by_pair;  ///< by PairType
  std::optional<CrackSums> sums = {};          ///< at the last sample; empty if no law of the scene has a crack

  /// Returns the number of broken points.
  std::int64_t points() const { return static_cast<std::int64_t>(events.size()); }
  /// Returns the number of points whose law can break.
  std::int64_t breakable() const {
    std::int64_t out = 0;
    for (const PairCracks& pair : by_pair) out += pair.breakable;
    return out;
  }
};

/// The rupture that ended a test before its last point: no path of intact contacts connected the bottom and top walls
/// any more.
struct Rupture {
  double time_s = 0, strain = 0;                ///< at the first sample after the rupture
  double time_before_s = 0, strain_before = 0;  ///< at the last sample before the rupture
};

}  // namespace macadam::experiments
