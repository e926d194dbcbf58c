// SPDX-License-Identifier: GPL-3.0-or-later
/// \file segment_files.hpp  What a segmentation leaves in its folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// `id,x,y,z,volume_m3,…`, SI units; the axes of D^L, D^I and D^S as a turn of x, y and z.
std::string grains_csv(const std::vector<ScannedGrain>& grains);

std::string cuts_csv(const std::vector<GrainCut>& cuts);
/// \throws InputError naming file and line.
std::vector<GrainCut> read_cuts(const std::filesystem::path& file);

/// Everything that `macadam ct segment` leaves in its folder. \throws InputError where another command writes into it,
/// RunError.
void write_segmentation(const std::filesystem::path& folder, const Segmentation& out, const SegmentOptions& options);

}  // namespace macadam::ct
