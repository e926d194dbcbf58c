// SPDX-License-Identifier: GPL-3.0-or-later
// imagej_stack.cpp  Reads the slices that follow the only directory of a TIFF file.
#include "host/tools/ct/images/imagej_stack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

/// Slices that follow one another from a given offset in a file.
class ImagejStack : public ImageSlices {
 public:
  ImagejStack(const std::filesystem::path& file, const TiffPages& pages)
      : in_(file, std::ios::binary), begin_(*pages.raw), swaps_(pages.big_endian != is_big_endian) {
    file_ = file.string();
    type_ = pages.type;
    header_.size = {pages.width, pages.height, pages.described};
    header_.bits = 8 * bytes_of(type_);
    header_.floating = type_ == VoxelType::f32;
    if (pages.white_is_zero) invert_grey();
  }
  bool apart() const override { return true; }

 private:
  static constexpr bool is_big_endian = std::endian::native == std::endian::big;

  void read_bytes(std::int64_t first, std::int64_t count, char* to) override {
    const std::int64_t slice = header_.size[0] * header_.size[1] * bytes_of(type_), bytes = count * slice;
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(begin_) + first * slice);
    in_.read(to, bytes);
    if (in_.gcount() != bytes)
      throw InputError(file_, 0, "voxels", fmt::format("{} bytes from slice {} on", in_.gcount(), first),
                       fmt::format("{} bytes", bytes));
    if (!swaps_) return;
    const int voxel = bytes_of(type_);
    for (char* at = to; at < to + bytes; at += voxel) std::reverse(at, at + voxel);
  }

  std::ifstream in_;
  std::uint64_t begin_;  // offset of the first slice [bytes]
  // whether the byte order of the file differs from the byte order of the machine
  bool swaps_;
};

}  // namespace

std::unique_ptr<ImageSlices> open_imagej_stack(const std::filesystem::path& file, const TiffPages& pages) {
  if (pages.described <= pages.pages) return nullptr;
  const auto refuse = [&](const std::string& expected) {
    throw InputError(file.string(), 0, "slices",
                     fmt::format("{} slice{}, although the description of the file says {}", pages.pages,
                                 pages.pages == 1 ? "" : "s", pages.described),
                     expected);
  };
  if (pages.pages != 1 || !pages.raw)
    refuse("a directory for each slice, or one directory and after it all slices, contiguous and not compressed");
  const double size = static_cast<double>(std::filesystem::file_size(file));
  const double slice = static_cast<double>(pages.width) * static_cast<double>(pages.height) * bytes_of(pages.type);
  const double needed = static_cast<double>(*pages.raw) + slice * static_cast<double>(pages.described);
  if (!(needed <= size)) refuse(fmt::format("a file of at least {:.0f} bytes, but the file has {:.0f}", needed, size));
  return std::make_unique<ImagejStack>(file, pages);
}

}  // namespace macadam::ct
