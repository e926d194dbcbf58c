// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phantom.hpp  Makes phantoms, which are synthetic scans of generated specimens, for which the truth is known.
/// Works only if the library was built with ITK (MACADAM_CT).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "macadam/ct.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// Outline of the scanned body: the box of the specimen, or the largest upright cylinder inside it.
enum class CoreShape : std::uint8_t { prism, cylinder };

/// Options of a phantom. A fraction is relative to `grey_aggregate` − `grey_air`, unless another reference is given.
struct PhantomSpec {
  double voxel = 0;  ///< edge [m]
  std::uint64_t seed = 1;
  CoreShape shape = CoreShape::prism;
  double sawn = 0;    ///< thickness that is sawn off each of the six sides of the box before the scan [m]
  double air = 1e-3;  ///< smallest thickness of air around the specimen [m]
  int samples = 3;    ///< sample columns along each edge of a voxel, for the contents of partly filled voxels
  double grey_air = 6000, grey_mastic = 30000, grey_aggregate = 42000;
  double blur = 0.7;     ///< standard deviation of a Gaussian [voxels]
  double noise = 0.05;   ///< standard deviation, fraction
  double cupping = 0.1;  ///< loss of grey value on the axis, fraction of the value
  double rings = 0.01;   ///< standard deviation of the rings' offsets, fraction
  double drift = 0.02;   ///< change of brightness between slices, fraction of the value
};

/// A grain of a phantom.
struct PhantomGrain {
  std::uint32_t id = 0;   ///< its number in the label image, from 1
  std::int32_t body = 0;  ///< Specimen::body of its spheres
  /// The whole surface, at its position; a single sphere is approximated by 642 points and has the same volume.
  Surface surface;
  double sphere_radius = 0;  ///< radius if the grain is a single sphere [m]; otherwise 0
  std::string shape;         ///< name of its template, or "sphere"
  /// Centroid of the part within the specimen [m]; `volume` and `border` also describe this part.
  Vec3d centre{};
  double volume = 0;    ///< [m³]
  bool border = false;  ///< whether the scanned body ends in the grain; the members below describe the whole grain
  double area = 0;      ///< [m²]
  double d_long = 0, d_intermediate = 0, d_short = 0;  ///< [m]
  double sieve = 0;                                    ///< side of the smallest square mesh that the grain passes [m]
  Vec3d axis_long{};                                   ///< unit vector; zero for a sphere
};

/// Two grains that are near each other; a < b.
struct GrainGap {
  std::uint32_t a = 0, b = 0;
  double gap = 0;  ///< distance between their surfaces [m]
};

/// A scan and its truth. Coordinates are the specimen's, with one corner of its box at the origin.
struct Phantom {
  Image<std::uint16_t> scan;
  Image<std::uint32_t> labels;  ///< 0: no grain
  Image<std::uint8_t> phases;   ///< VoxelPhase
  std::vector<PhantomGrain> grains;
  std::vector<GrainGap> gaps;                   ///< pairs of grains up to three voxels apart
  Specimen specimen;                            ///< specimen of the prism after sawing
  double voids = 0, mastic = 0, aggregate = 0;  ///< volume fractions of the scanned body
};

/// Generates the scene's specimen and computes a synthetic scan of it. The same scene and spec give the same bits for
/// any number of threads. \throws InputError for impossible values, and if the scene reads a specimen with several
/// spheres per aggregate from a file, because the surfaces of these aggregates are not known.
Phantom make_phantom(const Scene& scene, const PhantomSpec& spec,
                     const std::function<void(const std::string& stage, double share)>& progress = {});

/// Writes scan.mha, phantom.json, and the folder truth/ with labels.mha, phases.mha, grains.csv, contacts.csv,
/// specimen.csv, library/*.off and border/*.off. \throws RunError naming the file.
void write_phantom(const std::filesystem::path& out, const Phantom& phantom, const Scene& scene,
                   const PhantomSpec& spec);

}  // namespace macadam
