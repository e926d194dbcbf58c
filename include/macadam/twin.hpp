// SPDX-License-Identifier: GPL-3.0-or-later
/// \file twin.hpp  The specimen in a scan, as a specimen that can be solved. Of use where the library was built with
/// ITK (MACADAM_CT).
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

/// What is made of a scan.
struct TwinSpec {
  std::optional<std::array<Vec3d, 2>> box = {};  ///< lower and upper corner in the scan's coordinates [m]; none: what
                                                 ///< is not outside of the specimen
  std::optional<double> porosity = {};           ///< of the mastic, MasticSpec::porosity; none: the scene's
  double least_void = 0;  ///< radius of the sphere below which a void is left out [m]; 0: a sphere of two voxels
  std::uint64_t seed = 1;
};

/// A specimen made of a scan.
struct Twin {
  Specimen specimen;
  Vec3d corner{};                                            ///< of the box, in the scan's coordinates [m]
  std::int64_t grains = 0;                                   ///< in the box, at least in part
  std::int64_t clusters = 0;                                 ///< of several spheres
  std::int64_t lost = 0;                                     ///< grains of which too little is in the box for a sphere
  std::int64_t enclosed_mastic = 0, enclosed_aggregate = 0;  ///< particles not joined to both walls, and taken out
  double aggregate = 0, voids = 0;  ///< volumes of the labels and of the void voxels, over the box
  double voids_left_out = 0;        ///< volume of what was too small, over the box
  double mastic = 0;                ///< Σ volumes of the mastic's spheres over the box
};

/// Makes a specimen of a folder with labels.mha, phases.mha, library/grain_*.off and border/grain_*.off, as `ct
/// segment` and the truth of `ct phantom` have them. Grains are filled with spheres as the scene's [specimen.shapes]
/// asks, or are single spheres of their volumes; voids are spheres where the scan has them; mastic of the scene's radii
/// is packed around them. \throws InputError for a folder that is none, or a box that is not within the specimen.
Twin make_twin(const std::filesystem::path& folder, const Scene& scene, const TwinSpec& spec,
               const std::function<void(const std::string& stage, double share)>& progress = {});

/// Writes scene.toml, which is the scene with this specimen in place of its own, specimen.csv and twin.json.
/// \throws RunError naming the file.
void write_twin(const std::filesystem::path& out, const Twin& twin, const Scene& scene);

}  // namespace macadam
