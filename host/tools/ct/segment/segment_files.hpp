// SPDX-License-Identifier: GPL-3.0-or-later
/// \file segment_files.hpp  Writes the results of a segmentation into its folder, and reads back the table of cuts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Returns the table `id,x,y,z,volume_m3,…` in SI units. The axes of D^L, D^I and D^S are given as a rotation of x, y
/// and z (unit quaternion).
std::string grains_csv(const std::vector<ScannedGrain>& grains);

/// Returns the table of cuts: one row per face between two fragments.
std::string cuts_csv(const std::vector<GrainCut>& cuts);
}  // namespace macadam::ct
