// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct.hpp  Images of computed tomography. Of use where the library was built with ITK (MACADAM_CT).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "macadam/numeric.hpp"
#include "macadam/recipe.hpp"
#include "macadam/shape.hpp"

namespace macadam {

/// Voxels on a regular grid. Voxel (i, j, k) has its centre at origin + spacing∘(i, j, k); x runs fastest, z is the
/// number of the slice.
template <class T>
struct Image {
  std::array<std::int64_t, 3> size{};  ///< voxels along x, y, z
  Vec3d spacing{1, 1, 1};              ///< edges of a voxel [m]
  Vec3d origin{};                      ///< centre of the first voxel [m]
  std::vector<T> voxels;

  Image() = default;
  Image(std::array<std::int64_t, 3> size, Vec3d spacing, Vec3d origin = {}, T value = {})
      : size(size),
        spacing(spacing),
        origin(origin),
        voxels(static_cast<std::size_t>(size[0] * size[1] * size[2]), value) {}
  /// An image of the same grid.
  template <class U>
  static Image like(const Image<U>& other, T value = {}) {
    return Image(other.size, other.spacing, other.origin, value);
  }

  std::size_t count() const { return voxels.size(); }
  std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(i + size[0] * (j + size[1] * k));
  }
  T& at(std::int64_t i, std::int64_t j, std::int64_t k) { return voxels[index(i, j, k)]; }
  const T& at(std::int64_t i, std::int64_t j, std::int64_t k) const { return voxels[index(i, j, k)]; }
  Vec3d centre(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return {origin.x + spacing.x * static_cast<double>(i), origin.y + spacing.y * static_cast<double>(j),
            origin.z + spacing.z * static_cast<double>(k)};
  }
  double voxel_volume() const { return spacing.x * spacing.y * spacing.z; }  ///< [m³]
};

/// What an image file says of its voxels.
struct ImageHeader {
  std::array<std::int64_t, 3> size{};  ///< voxels along x, y, z
  Vec3d spacing{}, origin{};           ///< [m]; a spacing of 0: the file has none
  int bits = 0;                        ///< of a voxel
  bool floating = false;
  std::vector<std::string> notes;  ///< for the user: grey values that are inverted, axes that are turned or mirrored
};

/// Reads the header of a MetaImage (.mha, .mhd), NRRD (.nrrd, .nhdr), TIFF (.tif, .tiff; pages are slices) or HDF5 file
/// (.h5, .hdf5), or of a folder of TIFF files, which are slices in the order of their names, numbers in them by value.
/// Lengths in files are millimetres where the file names no unit. Of an HDF5 file `dataset` names the dataset of three
/// dimensions, z, y and x, which need not be named where there is one only. \throws InputError naming the file.
ImageHeader read_image_header(const std::filesystem::path& path, const std::string& dataset = {});

/// Reads such an image; T is uint8, uint16, uint32 or float. A voxel that T cannot hold, and one that is not finite, is
/// an error: \throws InputError naming the file and the first such voxel.
template <class T>
Image<T> read_image(const std::filesystem::path& path, const std::string& dataset = {});

/// Writes .mha (compressed where `compressed`), .nrrd or .tif. \throws RunError where that fails, InputError for
/// another ending.
template <class T>
void write_image(const std::filesystem::path& path, const Image<T>& image, bool compressed = true);

/// What a voxel of phases.mha is.
enum class VoxelPhase : std::uint8_t { air_void, mastic, aggregate, outside = 255 };

/// Grey values of the phases of a scan.
struct GreyLevels {
  double air = 0, mastic = 0, aggregate = 0;  ///< their means; air is below mastic, and this below aggregate
  double deviation = 0;                       ///< standard deviation of each, in the scan as it is segmented
  bool has_air = false;                       ///< without it, `air` has no meaning
  double contrast() const { return aggregate - mastic; }
};

enum class ScanRegion : std::uint8_t { found, whole, cylinder, prism };  ///< what of a scan is the specimen
/// The specimen by coordinates of the scan: an upright box, or the upright cylinder around the middle of its sides
/// whose diameter is its width along x.
struct GivenRegion {
  Vec3d low, high;  ///< corners of the box [m]
  bool cylinder = false;
};

enum class Denoising : std::uint8_t { diffusion, median, none };  ///< diffusion keeps edges
enum class SegmentRecipe : std::uint8_t { own, paper };           ///< paper: as [1], section 3.2.1

/// Two fragments of the watershed that touch. The inscribed radius is that of the largest sphere inside.
struct GrainCut {
  std::uint32_t a = 0, b = 0;  ///< numbers of the fragments, a < b
  Vec3d place{};               ///< middle of the face between them [m]
  double neck = 0;             ///< inscribed radius at the face over the smaller one of the fragments
  double solidity = 0;         ///< volume over that of the convex hull, of both together over that of each for itself
  double valley = 0;           ///< grey value on the face, 0: mastic, 1: aggregate
  double margin = 0;           ///< above 0: a cut between two grains; below: within one; near 0: doubtful
  bool cut = false;            ///< what was decided
};

/// How a scan is segmented.
struct SegmentOptions {
  ScanRegion region = ScanRegion::found;
  std::optional<GivenRegion> given;                    ///< goes before `region`
  bool slices = true, rings = true, hardening = true;  ///< which corrections
  Denoising denoising = Denoising::diffusion;
  SegmentRecipe recipe = SegmentRecipe::own;
  std::optional<double> air_voids, aggregate;  ///< volume shares of the specimen, where the laboratory knows them
  double smallest = 4e-3;                      ///< diameter of the smallest grain that matters [m]
  std::vector<SievePassing> gradation;  ///< the laboratory's, where it is known: rising sieves, the last passes all
  std::optional<std::vector<GrainCut>> cuts;  ///< decisions on the same scan, maybe changed by a person
  bool surfaces = true;
  int facets = 500;  ///< of a surface; up to 800 where the error asks for it
  std::function<void(const std::string& stage, double share)> progress;
};

/// A grain of a scan.
struct ScannedGrain {
  std::uint32_t id = 0;  ///< its number in the labels
  Surface surface;       ///< in the scan's coordinates
  ShapeMeasure measure;
  double sieve = 0;          ///< side of the smallest square mesh that lets it pass [m]
  bool border = false;       ///< cut by the end of the specimen or of the image
  double confidence = 0;     ///< 0 to 1: that its outline and its cuts are right
  double surface_error = 0;  ///< largest distance of the isosurface from the simplified one [m]
};

/// What was taken out of a scan, in shares of the contrast between mastic and aggregate.
struct ScanCorrections {
  double slices = 0;     ///< root mean square over the slices
  double rings = 0;      ///< the same over the rings
  double hardening = 0;  ///< from the brightest to the darkest radius
};

/// What became of a scan.
struct Segmentation {
  ScanCorrections corrections;
  GreyLevels levels;
  Image<std::uint8_t> phases;      ///< VoxelPhase
  Image<std::uint8_t> confidence;  ///< that the phase is right, 0 to 255
  Image<std::uint32_t> labels;     ///< 0: no grain
  Image<float> grey;               ///< corrected
  std::vector<ScannedGrain> grains;
  std::vector<GrainCut> cuts;
  double air_voids = 0, mastic = 0, aggregate = 0;  ///< volume shares of the specimen, partly filled voxels in part
  /// Part of the aggregate's volume that is in no grain: pieces smaller than half of SegmentOptions::smallest, mostly.
  double in_no_grain = 0;
  double confidence_mean = 0;  ///< of the voxels of the specimen, 0 to 1
  std::int64_t block = 1;      ///< edge of a voxel of these images in voxels of the scan; above 1: see segment_file()
  std::size_t refined = 0;     ///< grains whose surfaces are finer than these images
  std::vector<std::string> warnings;  ///< what a person should look at
};

/// Phases and grains of a scan whose spacing is known. \throws InputError where the scan cannot be segmented: empty,
/// without contrast, with a phase missing.
Segmentation segment_scan(Image<float> scan, const SegmentOptions& options);

/// A scan in a file, of any format of read_image().
struct ScanFile {
  std::filesystem::path path;
  std::string dataset;  ///< of HDF5
  Vec3d spacing{};      ///< edges of a voxel [m]; they take precedence over those in the file. 0: those in the file
};

/// The same of a file, with `memory` bytes to take. A scan that fits is segment_scan()'s. Of a larger one, phases and
/// grains are decided on means of blocks of voxels, a twentieth of the smallest grain wide, and the surfaces of grains
/// for which these are coarse are drawn from the file, which is read twice, some slices at a time; the images are
/// those of the blocks. \throws InputError also where that does not fit either.
Segmentation segment_file(const ScanFile& file, const SegmentOptions& options, double memory);

/// Memory that there is to take: what the machine has free, or this process may have [bytes].
double memory_available();

/// Side of the smallest square opening that lets a surface pass, turned as it may be [m].
double square_sieve(const Surface& surface);

}  // namespace macadam
