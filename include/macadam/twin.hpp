// SPDX-License-Identifier: GPL-3.0-or-later
/// \file twin.hpp  Makes a twin: a model specimen with particles and contacts, made from a segmented scan of a real
/// specimen. Works only if the library was built with ITK (MACADAM_CT).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/scene.hpp"

namespace macadam {

/// Options of a twin.
struct TwinSpec {
  /// Lower and upper corner in the scan's coordinates [m]; empty: the extent of the specimen's voxels.
  std::optional<std::array<Vec3d, 2>> box = {};
  std::optional<double> porosity = {};  ///< porosity of the mastic, as MasticSpec::porosity; empty: as in the scene
  /// Smallest radius of the sphere that represents a void [m]. Smaller voids are left out. 0 means two voxel edges.
  double least_void = 0;
  std::uint64_t seed = 1;
};

/// The specimen made from a scan.
struct Twin {
  Specimen specimen;
  Vec3d corner{};             ///< corner of the box, in the scan's coordinates [m]
  std::int64_t grains = 0;    ///< number of grains that lie in the box, at least in part
  std::int64_t clusters = 0;  ///< number of grains that are clusters of several spheres
  std::int64_t lost = 0;      ///< number of grains that were left out because too little of their volume is in the box
  /// Particles that were removed because they are not connected to both walls.
  std::int64_t enclosed_mastic = 0, enclosed_aggregate = 0;
  /// Volumes of the labelled grains and of the void voxels, divided by the volume of the box.
  double aggregate = 0, voids = 0;
  /// Volume of the voids that were left out because they are too small, divided by the volume of the box.
  double voids_left_out = 0;
  double mastic = 0;  ///< Σ volumes of the mastic spheres, divided by the volume of the box
};

/// Makes a specimen from a folder with labels.mha, phases.mha, library/grain_*.off and border/grain_*.off, as written
/// by `ct segment` and, in truth/, by `ct phantom`. Grains are filled with spheres as the scene's [specimen.shapes]
/// says, or are single spheres of the same volumes. Voids of the scan are filled with void spheres. Mastic with the
/// scene's radii is packed around grains and voids. \throws InputError for a folder without these files, or a box that
/// is not within the specimen.
Twin make_twin(const std::filesystem::path& folder, const Scene& scene, const TwinSpec& spec,
               const std::function<void(const std::string& stage, double share)>& progress = {});

/// Writes scene.toml (the scene with the twin in place of its own specimen), specimen.csv and twin.json.
///
/// \throws RunError naming the file.
void write_twin(const std::filesystem::path& out, const Twin& twin, const Scene& scene);

}  // namespace macadam
