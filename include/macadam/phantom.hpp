// SPDX-License-Identifier: GPL-3.0-or-later
/// \file phantom.hpp  Synthetic scans of generated specimens, of which everything is known. Of use where the library
/// was built with ITK (MACADAM_CT).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "macadam/ct.hpp"
#include "macadam/scene.hpp"

namespace macadam {

/// The outline of what is scanned: the box of the specimen, or the upright cylinder that fits it.
enum class CoreShape : std::uint8_t { prism, cylinder };

/// How a phantom is made. Shares are of `grey_aggregate` − `grey_air`.
struct PhantomSpec {
  double voxel = 0;  ///< edge [m]
  std::uint64_t seed = 1;
  CoreShape shape = CoreShape::prism;
  double sawn = 0;    ///< what is taken off each of the six sides of the box before it is scanned [m]
  double air = 1e-3;  ///< around the specimen, at least [m]
  int samples = 3;    ///< columns along each edge of a voxel, by which partly filled voxels are measured
  double grey_air = 6000, grey_mastic = 30000, grey_aggregate = 42000;
  double blur = 0.7;     ///< standard deviation of a Gaussian [voxels]
  double noise = 0.05;   ///< standard deviation, share
  double cupping = 0.1;  ///< loss of grey value on the axis, share of the value
  double rings = 0.01;   ///< standard deviation of the rings' offsets, share
  double drift = 0.02;   ///< of the slices' brightness, share of the value
};

/// A grain of a phantom.
struct PhantomGrain {
  std::uint32_t id = 0;      ///< its number in the labels, from 1
  std::int32_t body = 0;     ///< Specimen::body of its spheres
  Surface surface;           ///< whole, in its place; of a single sphere 642 points of the same volume
  double sphere_radius = 0;  ///< of a single sphere [m], else 0
  std::string shape;         ///< name of its template, or `"sphere"`
  Vec3d centre{};            ///< centroid of what is in the specimen [m], likewise the next two
  double volume = 0;         ///< [m³]
  bool border = false;       ///< cut by the saw: what follows is of the whole grain
  double area = 0;           ///< [m²]
  double d_long = 0, d_intermediate = 0, d_short = 0;  ///< [m]
  double sieve = 0;                                    ///< side of the smallest square mesh that lets it pass [m]
  Vec3d axis_long{};                                   ///< unit vector; 0 of a sphere
};

/// Two grains that are near each other, a < b.
struct GrainGap {
  std::uint32_t a = 0, b = 0;
  double gap = 0;  ///< between their surfaces [m]
};

/// A scan with its truth. Coordinates are those of the specimen, one corner of its box at the origin.
struct Phantom {
  Image<std::uint16_t> scan;
  Image<std::uint32_t> labels;  ///< 0: no grain
  Image<std::uint8_t> phases;   ///< VoxelPhase
  std::vector<PhantomGrain> grains;
  std::vector<GrainGap> gaps;                   ///< up to three voxels
  Specimen specimen;                            ///< of the prism, sawn
  double voids = 0, mastic = 0, aggregate = 0;  ///< volumes over that of what is scanned
};

/// Generates the scene's specimen and scans it. The same scene and spec give the same bits for any number of threads.
/// \throws InputError where the scene takes a specimen of several spheres an aggregate from a file, whose surfaces are
/// not known, and for impossible values.
Phantom make_phantom(const Scene& scene, const PhantomSpec& spec,
                     const std::function<void(const std::string& stage, double share)>& progress = {});

/// Writes scan.mha, phantom.json, and truth/ with labels.mha, phases.mha, grains.csv, contacts.csv, specimen.csv and
/// library/*.off and border/*.off. \throws RunError naming the file.
void write_phantom(const std::filesystem::path& out, const Phantom& phantom, const Scene& scene,
                   const PhantomSpec& spec);

}  // namespace macadam
