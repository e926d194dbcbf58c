// SPDX-License-Identifier: GPL-3.0-or-later
/// \file modulus_files.hpp  Writes the results of `macadam ct modulus`: modulus.csv, voxels.csv and summary.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "host/tools/ct/continuum/scan_modulus.hpp"

namespace macadam::continuum {

/// The folder of the results, locked during the life of this object. At any time its files contain all results so far.
class ModulusFiles {
 public:
  /// Makes the folder, and files without results. `scene`: file of the scene. The arguments must outlive this object.
  /// \throws InputError if another command is writing into the folder, RunError if writing fails.
  ModulusFiles(const std::filesystem::path& folder, const ModulusPlan& plan, const ScanPhases& phases,
               const std::string& scene);
  /// Appends one row to voxels.csv. \throws RunError.
  void add(const ModulusSolution& solution);
  /// Replaces modulus.csv and summary.json. `status`: running, interrupted, done or failed: …. \throws RunError.
  void write(const std::vector<PointModulus>& results, const std::string& status);

 private:
  std::filesystem::path folder_;
  const ModulusPlan& plan_;
  const ScanPhases& phases_;
  std::string scene_;
  ResultFolder held_;
  LineWriter voxels_;
};

}  // namespace macadam::continuum
