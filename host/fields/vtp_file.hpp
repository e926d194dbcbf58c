// SPDX-License-Identifier: GPL-3.0-or-later
/// \file vtp_file.hpp  Writes field files in VTK's XML format, type PolyData: one file per frame, and a list of the
/// frames.
#pragma once

#include "macadam/fields.hpp"

namespace macadam {

/// Do what begin_fields() and write_fields() do, for the format vtp. `stem` is the path without an ending.
/// @{
std::unique_ptr<FieldSeries> begin_vtp(const std::filesystem::path& stem, FieldMesh mesh, std::optional<double> until);
void write_vtp(const std::filesystem::path& file, const FieldMesh& mesh);
/// @}

}  // namespace macadam
