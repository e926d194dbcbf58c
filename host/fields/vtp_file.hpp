// SPDX-License-Identifier: GPL-3.0-or-later
/// \file vtp_file.hpp  VTK's XML of type PolyData, a file a frame, and the list of frames.
#pragma once

#include "macadam/fields.hpp"

namespace macadam {

/// begin_fields() and write_fields() of format vtp; `stem` without ending.
/// @{
std::unique_ptr<FieldSeries> begin_vtp(const std::filesystem::path& stem, FieldMesh mesh, std::optional<double> until);
void write_vtp(const std::filesystem::path& file, const FieldMesh& mesh);
/// @}

}  // namespace macadam
