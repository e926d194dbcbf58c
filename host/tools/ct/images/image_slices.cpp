// SPDX-License-Identifier: GPL-3.0-or-later
// image_slices.cpp  Chooses the reader for a file, checks that the file can hold the voxels its header counts, and
// converts voxels to the requested type.
#include "host/tools/ct/images/image_slices.hpp"

#include <fmt/format.h>

#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

namespace fs = std::filesystem;

/// Converts `count` voxels to type T. `before` is the number of voxels of the file before the first one, for messages.
/// \throws InputError for a voxel that T cannot hold or that is not finite.
template <class From, class T>
void convert(const std::string& file, const From* from, std::size_t count, std::size_t before, T* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const From value = from[i];
    bool fits = true;
    if constexpr (std::is_floating_point_v<From>) fits = std::isfinite(value);
    if constexpr (std::is_integral_v<T>) {
      fits = fits && static_cast<long double>(value) >= 0 &&
             static_cast<long double>(value) <= static_cast<long double>(std::numeric_limits<T>::max()) &&
             static_cast<From>(static_cast<T>(value)) == value;
    } else if constexpr (std::is_same_v<From, double>) {
      fits = fits && std::isfinite(static_cast<T>(value));
    }
    if (!fits) {
      throw InputError(file, 0, fmt::format("voxel {} (the first is 0, x runs fastest)", before + i),
                       fmt::format("{}", value),
                       std::is_integral_v<T> ? fmt::format("a whole number from 0 to {}", std::numeric_limits<T>::max())
                                             : "a finite number");
    }
    to[i] = static_cast<T>(value);
  }
}

/// \throws InputError if the header counts more voxels than the file of the voxels can hold.
void check_counts(const ImageHeader& header, const fs::path& path, const fs::path& voxels) {
  double bytes = header.bits / 8.0;
  for (const std::int64_t n : header.size) bytes *= n > 0 ? static_cast<double>(n) : 0;
  const std::string found =
      fmt::format("{} x {} x {} of {} bits", header.size[0], header.size[1], header.size[2], header.bits);
  if (!(bytes > 0 && bytes < 0x1p46))
    throw InputError(path.string(), 0, "voxels", found, "at least one voxel, and less than 2^46 bytes (64 TiB)");
  // largest compression ratios: 1032 for deflate, 2730 for LZW; 4000 is above both
  const double there =
      fs::is_directory(voxels) ? std::numeric_limits<double>::infinity() : static_cast<double>(fs::file_size(voxels));
  if (bytes > 4000 * there)
    throw InputError(path.string(), 0, "voxels", found,
                     fmt::format("no more voxels than the {:.0f} bytes of the file can hold", there));
}

}  // namespace

std::string lower_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool is_tiff(const fs::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".tif" || ending == ".tiff";
}

int bytes_of(VoxelType type) {
  constexpr int bytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

void ImageSlices::invert_grey() {
  inverts_ = true;
  header_.notes.push_back(
      "the file says that 0 is white (PhotometricInterpretation 0), so the grey values were inverted and air is dark");
}

template <class T>
void ImageSlices::read(std::int64_t first, std::int64_t count, T* to) {
  const auto slice = static_cast<std::size_t>(header_.size[0] * header_.size[1]);
  const std::size_t voxels = slice * static_cast<std::size_t>(count);
  bytes_.resize(voxels * static_cast<std::size_t>(bytes_of(type_)));
  read_bytes(first, count, bytes_.data());
  if (inverts_)  // complement of all bits: 255 - v of an unsigned byte, -1 - v of a signed number
    for (char& byte : bytes_) byte = static_cast<char>(~byte);
  const auto as = [&](auto kind) {
    convert(file_, reinterpret_cast<const decltype(kind)*>(bytes_.data()), voxels,
            slice * static_cast<std::size_t>(first), to);
  };
  switch (type_) {
    case VoxelType::u8:
      return as(std::uint8_t{});
    case VoxelType::i8:
      return as(std::int8_t{});
    case VoxelType::u16:
      return as(std::uint16_t{});
    case VoxelType::i16:
      return as(std::int16_t{});
    case VoxelType::u32:
      return as(std::uint32_t{});
    case VoxelType::i32:
      return as(std::int32_t{});
    case VoxelType::u64:
      return as(std::uint64_t{});
    case VoxelType::i64:
      return as(std::int64_t{});
    case VoxelType::f32:
      return as(0.0f);
    case VoxelType::f64:
      return as(0.0);
  }
}

template void ImageSlices::read(std::int64_t, std::int64_t, std::uint8_t*);
template void ImageSlices::read(std::int64_t, std::int64_t, std::uint16_t*);
template void ImageSlices::read(std::int64_t, std::int64_t, std::uint32_t*);
template void ImageSlices::read(std::int64_t, std::int64_t, float*);

std::unique_ptr<ImageSlices> open_image(const fs::path& path, const std::string& dataset) {
  const std::string ending = lower_ending(path);
  const bool hdf5 = ending == ".h5" || ending == ".hdf5" || ending == ".hdf" || ending == ".nxs";
  if (!dataset.empty() && !hdf5)
    throw InputError(path.string(), 0, "dataset", "\"" + dataset + "\"",
                     "no name of a dataset, because the file is not HDF5");
  std::unique_ptr<ImageSlices> image = hdf5 ? open_hdf5(path, dataset) : open_itk(path);
  check_counts(image->header(), path, image->voxel_file().empty() ? path : image->voxel_file());
  return image;
}

}  // namespace macadam::ct
