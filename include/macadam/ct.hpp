// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct.hpp  Reads and writes images of computed tomography, and segments them into phases and grains. Works only
/// if the library was built with ITK (MACADAM_CT).
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

/// Voxels on a regular grid. Voxel (i, j, k) has its centre at origin + spacing∘(i, j, k). In memory x runs fastest; z
/// is the number of the slice.
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
  /// Returns an image on the same grid as another one.
  template <class U>
  static Image like(const Image<U>& other, T value = {}) {
    return Image(other.size, other.spacing, other.origin, value);
  }

  std::size_t count() const { return voxels.size(); }
  /// Returns the index of a voxel in `voxels`.
  std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(i + size[0] * (j + size[1] * k));
  }
  T& at(std::int64_t i, std::int64_t j, std::int64_t k) { return voxels[index(i, j, k)]; }
  const T& at(std::int64_t i, std::int64_t j, std::int64_t k) const { return voxels[index(i, j, k)]; }
  /// Returns the position of a voxel's centre [m].
  Vec3d centre(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return {origin.x + spacing.x * static_cast<double>(i), origin.y + spacing.y * static_cast<double>(j),
            origin.z + spacing.z * static_cast<double>(k)};
  }
  double voxel_volume() const { return spacing.x * spacing.y * spacing.z; }  ///< [m³]
};

/// The header of an image file.
struct ImageHeader {
  std::array<std::int64_t, 3> size{};  ///< voxels along x, y, z
  Vec3d spacing{}, origin{};           ///< [m]; spacing 0: the file gives none
  int bits = 0;                        ///< bits per voxel
  bool floating = false;
  std::vector<std::string> notes;  ///< for the user: inverted grey values, rotated or mirrored axes
};

/// Reads the header of a MetaImage (.mha, .mhd), NRRD (.nrrd, .nhdr), TIFF (.tif, .tiff; pages are slices) or HDF5 file
/// (.h5, .hdf5), or of a folder of TIFF files. The files of a folder are slices in the order of their names, in which
/// numbers are compared by value. Lengths without a unit in the file are millimetres. `dataset`: for HDF5, the dataset
/// with three dimensions z, y and x; not needed if there is only one.
///
/// \throws InputError naming the file.
ImageHeader read_image_header(const std::filesystem::path& path, const std::string& dataset = {});

/// Reads an image in one of the formats of read_image_header(). T is uint8, uint16, uint32 or float.
///
/// \throws InputError naming the file and the first voxel that T cannot hold or that is not finite.
template <class T>
Image<T> read_image(const std::filesystem::path& path, const std::string& dataset = {});

/// Writes .mha (compressed if `compressed`), .nrrd or .tif.
///
/// \throws RunError if writing fails; InputError for another file ending.
template <class T>
void write_image(const std::filesystem::path& path, const Image<T>& image, bool compressed = true);

/// The phase of a voxel, as in phases.mha.
enum class VoxelPhase : std::uint8_t { air_void, mastic, aggregate, outside = 255 };

/// Grey values of the phases of a scan.
struct GreyLevels {
  double air = 0, mastic = 0, aggregate = 0;  ///< mean values, with air < mastic < aggregate
  double deviation = 0;                       ///< standard deviation within each phase, in the scan that is segmented
  bool has_air = false;                       ///< whether there is air; if not, `air` has no meaning
  double contrast() const { return aggregate - mastic; }
};

enum class ScanRegion : std::uint8_t { found, whole, cylinder, prism };  ///< which part of a scan is the specimen
/// The specimen in coordinates of the scan: an upright box, or the upright cylinder around the axis of that box, whose
/// diameter is the box's width along x.
struct GivenRegion {
  Vec3d low, high;  ///< corners of the box [m]
  bool cylinder = false;
};

enum class Denoising : std::uint8_t { diffusion, median, none };  ///< diffusion preserves edges
enum class SegmentRecipe : std::uint8_t { own, paper };           ///< paper: the method of [1], section 3.2.1

/// Two fragments of the watershed that touch. An inscribed radius is the radius of the largest sphere inside.
struct GrainCut {
  std::uint32_t a = 0, b = 0;  ///< numbers of the fragments, a < b
  Vec3d place{};               ///< middle of the face between them [m]
  double neck = 0;             ///< inscribed radius at the face, over the smaller inscribed radius of the two fragments
  double solidity = 0;  ///< Solidity is volume over volume of the convex hull. This is the solidity of both fragments
                        ///< together, divided by their solidity apart (sum of volumes over sum of hull volumes).
  double valley = 0;    ///< grey value on the face; 0: mastic, 1: aggregate
  /// Measure for the decision: positive if the face is a boundary between two grains, negative if it lies within one
  /// grain, near 0 if this is doubtful.
  double margin = 0;
  bool cut = false;  ///< the decision: whether the fragments belong to two grains
};

/// Options for segmenting a scan.
struct SegmentOptions {
  ScanRegion region = ScanRegion::found;
  std::optional<GivenRegion> given;                    ///< takes precedence over `region`
  bool slices = true, rings = true, hardening = true;  ///< which corrections are made
  Denoising denoising = Denoising::diffusion;
  SegmentRecipe recipe = SegmentRecipe::own;
  std::optional<double> air_voids, aggregate;  ///< volume fractions of the specimen, if known from the laboratory
  double smallest = 4e-3;                      ///< diameter of the smallest grain that matters [m]
  /// Gradation from the laboratory, if known: sieves in rising order; everything passes the last one.
  std::vector<SievePassing> gradation;
  /// Decisions of an earlier run on the same scan, possibly edited by a person.
  std::optional<std::vector<GrainCut>> cuts;
  bool surfaces = true;
  int facets = 500;  ///< number of facets of a surface; up to 800 if the error requires it
  std::function<void(const std::string& stage, double share)> progress;
};

/// A grain found in a scan.
struct ScannedGrain {
  std::uint32_t id = 0;  ///< its number in the label image
  Surface surface;       ///< in the coordinates of the scan
  ShapeMeasure measure;
  double sieve = 0;          ///< side of the smallest square mesh that the grain passes [m]
  bool border = false;       ///< whether the end of the specimen or of the image cuts it
  double confidence = 0;     ///< 0 to 1: how certain the outline of the grain and its cuts from other grains are
  double surface_error = 0;  ///< largest distance of the isosurface from the simplified one [m]
};

/// Sizes of the artefacts that were removed from a scan, divided by the contrast between mastic and aggregate.
struct ScanCorrections {
  double slices = 0;     ///< root mean square over the slices
  double rings = 0;      ///< root mean square over the rings
  double hardening = 0;  ///< difference between the brightest and the darkest radius
};

/// Result of a segmentation.
struct Segmentation {
  ScanCorrections corrections;
  GreyLevels levels;
  Image<std::uint8_t> phases;      ///< VoxelPhase
  Image<std::uint8_t> confidence;  ///< confidence in the phase, 0 to 255
  Image<std::uint32_t> labels;     ///< 0: no grain
  Image<float> grey;               ///< the corrected scan
  std::vector<ScannedGrain> grains;
  std::vector<GrainCut> cuts;
  /// Volume fractions of the specimen; partly filled voxels count in part.
  double air_voids = 0, mastic = 0, aggregate = 0;
  /// Fraction of the aggregate's volume that belongs to no grain. Most of this volume is in pieces smaller than half of
  /// SegmentOptions::smallest.
  double in_no_grain = 0;
  double confidence_mean = 0;  ///< mean over the voxels of the specimen, 0 to 1
  /// Edge of a voxel of these images, as a multiple of the voxel edge of the scan. It is greater than 1 if
  /// segment_file() averaged the scan over blocks of voxels.
  std::int64_t block = 1;
  std::size_t refined = 0;            ///< number of grains whose surfaces are finer than these images
  std::vector<std::string> warnings;  ///< points that a person should check
};

/// Segments a scan with known spacing into phases and grains. \throws InputError if the scan cannot be segmented: it is
/// empty, has no contrast, or a phase is missing.
Segmentation segment_scan(Image<float> scan, const SegmentOptions& options);

/// A scan in a file of any format of read_image().
struct ScanFile {
  std::filesystem::path path;
  std::string dataset;  ///< HDF5 only
  Vec3d spacing{};      ///< edges of a voxel [m]; they replace the edges in the file. 0: use the edges in the file
};

/// Segments a scan in a file, using at most `memory` bytes. A scan that fits into this memory is passed to
/// segment_scan(). A larger scan is averaged over blocks of voxels, whose edge is a twentieth of the smallest grain's
/// diameter. Phases and grains are decided on these averages, and the resulting images have one voxel per block.
/// Surfaces of grains for which the blocks are too coarse are computed from the file, which is read twice, some slices
/// at a time. \throws InputError also if the averaged scan does not fit.
Segmentation segment_file(const ScanFile& file, const SegmentOptions& options, double memory);

/// Returns the memory that this process can still allocate [bytes]: the free memory of the machine or, if that is
/// smaller, the unused part of the limits of the process and of its container.
double memory_available();

/// Returns the side of the smallest square opening that a surface passes in its best orientation [m].
double square_sieve(const Surface& surface);

/// Functions that read the inputs of `macadam ct segment` and write its results.
namespace ct {

/// Reads a gradation with the header `sieve_m,passing` (fractions) or `sieve_mm,passing_percent`; the sieves may be in
/// any order. \throws InputError that names file and line.
std::vector<SievePassing> read_gradation(const std::filesystem::path& file);

/// Reads a cuts.csv that write_segmentation() wrote and a person may have edited. \throws InputError that names file
/// and line.
std::vector<GrainCut> read_cuts(const std::filesystem::path& file);

/// Sets the region from a text: found, whole, cylinder, prism, cylinder:x,y,diameter[,z0,z1] or
/// prism:x0,y0,z0,x1,y1,z1. \throws InputError.
void read_region(const std::string& text, SegmentOptions& options);

/// Returns the bytes of memory that may be used, from a text such as "3 GB" or "800 MB". For an empty text returns four
/// fifths of the free memory, which leaves some to the system and other programs. \throws InputError.
double memory_of(const std::string& text);

/// Writes all results of `macadam ct segment` into its folder. \throws InputError if another command is writing into
/// it, RunError if writing fails.
void write_segmentation(const std::filesystem::path& folder, const Segmentation& out, const SegmentOptions& options);

}  // namespace ct

}  // namespace macadam
