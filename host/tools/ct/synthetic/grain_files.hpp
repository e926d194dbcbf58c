// SPDX-License-Identifier: GPL-3.0-or-later
/// \file grain_files.hpp  Defines the names of the files with the surfaces of a scan's grains, one file per grain.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace macadam::ct {

/// Folder of the complete grains, and folder of the grains that the end of the specimen or of the scan cuts.
inline constexpr const char *whole_grains = "library", *cut_grains = "border";

/// Returns the file name of the grain with number `id` in labels.mha. The file holds its surface in metres, in the
/// scan's coordinates.
inline std::string surface_file(std::uint32_t id) { return fmt::format("grain_{:04}.off", id); }

}  // namespace macadam::ct
