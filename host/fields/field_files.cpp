// SPDX-License-Identifier: GPL-3.0-or-later
// field_files.cpp  Chooses between the formats of field files, VTKHDF and VTK's XML.
#include <algorithm>
#include <iterator>

#include "host/fields/vtkhdf_file.hpp"
#include "host/fields/vtp_file.hpp"

namespace macadam {

std::unique_ptr<FieldSeries> begin_fields(const std::filesystem::path& stem, FieldFormat format, FieldMesh mesh,
                                          std::optional<double> until) {
  if (format == FieldFormat::vtp) return begin_vtp(stem, std::move(mesh), until);
  return begin_vtkhdf(stem.string() + ".vtkhdf", std::move(mesh), until);
}

void write_fields(const std::filesystem::path& stem, FieldFormat format, FieldMesh mesh,
                  std::vector<FieldArray> arrays) {
  std::move(arrays.begin(), arrays.end(), std::back_inserter(mesh.arrays));
  if (format == FieldFormat::vtp) return write_vtp(stem.string() + ".vtp", mesh);
  write_vtkhdf(stem.string() + ".vtkhdf", mesh);
}

}  // namespace macadam
