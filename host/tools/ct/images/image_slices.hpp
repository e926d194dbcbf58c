// SPDX-License-Identifier: GPL-3.0-or-later
/// \file image_slices.hpp  Reads the voxels of an image file a few slices at a time. One class per file format
/// implements it.
#pragma once

#include <memory>
#include <vector>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// Type of a voxel in a file.
enum class VoxelType : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

/// Returns the bytes per voxel.
int bytes_of(VoxelType type);

/// An open image file.
class ImageSlices {
 public:
  virtual ~ImageSlices() = default;
  const ImageHeader& header() const { return header_; }
  /// The file that holds the voxels. Empty if it is the opened file itself, or if a folder was opened.
  const std::filesystem::path& voxel_file() const { return voxels_; }
  /// Whether some slices can be read without the others. If not, all voxels stay in memory after the first read.
  virtual bool apart() const = 0;
  /// Reads slices [first, first + count) and converts them to T. \throws InputError naming the first voxel whose value
  /// is not finite or does not fit into T.
  template <class T>
  void read(std::int64_t first, std::int64_t count, T* to);

 protected:
  /// Reads slices [first, first + count) as bytes of the file's voxel type, in the machine's byte order.
  virtual void read_bytes(std::int64_t first, std::int64_t count, char* to) = 0;
  /// Makes read() invert all grey values, which must be whole numbers, and adds a message to the header.
  void invert_grey();
  std::string file_;  ///< path for error messages
  std::filesystem::path voxels_;
  ImageHeader header_;
  VoxelType type_{};

 private:
  bool inverts_ = false;
  std::vector<char> bytes_;
};

/// Opens a file, or a folder of TIFF files. `dataset` names a dataset of an HDF5 file and must be empty for other
/// formats. \throws InputError if it is not a readable image, or has more voxels than its bytes can hold.
std::unique_ptr<ImageSlices> open_image(const std::filesystem::path& path, const std::string& dataset);

/// Returns the ending of the file name in lower case, with its dot.
std::string lower_ending(const std::filesystem::path& path);

bool is_tiff(const std::filesystem::path& path);

/// Open a file with ITK (MetaImage, NRRD, TIFF, folder of TIFFs) or with HDF5. \throws InputError.
std::unique_ptr<ImageSlices> open_itk(const std::filesystem::path& path);
std::unique_ptr<ImageSlices> open_hdf5(const std::filesystem::path& path, const std::string& dataset);

}  // namespace macadam::ct
