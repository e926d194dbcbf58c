// SPDX-License-Identifier: GPL-3.0-or-later
/// \file voxel_phases.hpp  Defines the values that stand for the phases in images of bytes.
#pragma once

#include <cstdint>

#include "macadam/ct.hpp"

namespace macadam::ct {

inline constexpr auto air = static_cast<std::uint8_t>(VoxelPhase::air_void),
                      mastic = static_cast<std::uint8_t>(VoxelPhase::mastic),
                      aggregate = static_cast<std::uint8_t>(VoxelPhase::aggregate),
                      outside = static_cast<std::uint8_t>(VoxelPhase::outside);

}  // namespace macadam::ct
