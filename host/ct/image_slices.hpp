// SPDX-License-Identifier: GPL-3.0-or-later
/// \file image_slices.hpp  The voxels of an image file, a few slices at a time.
#pragma once

#include <memory>
#include <vector>

#include "macadam/ct.hpp"

namespace macadam::ct {

/// What a voxel is in a file.
enum class VoxelType : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

/// Bytes of a voxel.
int bytes_of(VoxelType type);

/// An image file that is open.
class ImageSlices {
 public:
  virtual ~ImageSlices() = default;
  const ImageHeader& header() const { return header_; }
  /// The file that holds the voxels; empty: that which was opened, or those of a folder.
  const std::filesystem::path& voxel_file() const { return voxels_; }
  /// Whether some slices can be read without the others. Where not, all are held once one was read.
  virtual bool apart() const = 0;
  /// Slices [first, first + count) as T. \throws InputError naming the first voxel that T cannot hold or that is not
  /// finite.
  template <class T>
  void read(std::int64_t first, std::int64_t count, T* to);

 protected:
  /// The same as bytes of the file's type.
  virtual void read_bytes(std::int64_t first, std::int64_t count, char* to) = 0;
  /// Inverts all grey values that are read, whole numbers, and notes it in the header.
  void invert_grey();
  std::string file_;  ///< for messages
  std::filesystem::path voxels_;
  ImageHeader header_;
  VoxelType type_{};

 private:
  bool inverts_ = false;
  std::vector<char> bytes_;
};

/// Opens a file, or a folder of TIFF files; `dataset` is asked of HDF5 only. \throws InputError where it is none, or
/// has more voxels than its bytes can hold.
std::unique_ptr<ImageSlices> open_image(const std::filesystem::path& path, const std::string& dataset);

/// The ending in small letters.
std::string lower_ending(const std::filesystem::path& path);

bool is_tiff(const std::filesystem::path& path);

/// The two kinds of them. \throws InputError.
std::unique_ptr<ImageSlices> open_itk(const std::filesystem::path& path);
std::unique_ptr<ImageSlices> open_hdf5(const std::filesystem::path& path, const std::string& dataset);

}  // namespace macadam::ct
