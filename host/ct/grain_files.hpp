// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_files.hpp  The surfaces of a scan's grains, a file each.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace macadam::ct {

/// Folders of those that are whole, and of those that the end of the specimen cuts.
inline constexpr const char *whole_grains = "library", *cut_grains = "border";

/// File of the grain with a number in labels.mha, its surface in metres in the scan's coordinates.
inline std::string surface_file(std::uint32_t id) { return fmt::format("grain_{:04}.off", id); }

}  // namespace macadam::ct
