// SPDX-License-Identifier: GPL-3.0-or-later
// image_io.cpp  Reads and writes images that fit in memory.
#include <fmt/format.h>

#include "host/tools/ct/images/image_slices.hpp"
#include "host/tools/ct/images/itk_io.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"

namespace macadam {

using namespace ct;

namespace {

/// ITK's name of the voxel type T.
template <class T>
constexpr itk::IOComponentEnum component() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return itk::IOComponentEnum::UCHAR;
  if constexpr (std::is_same_v<T, std::uint16_t>) return itk::IOComponentEnum::USHORT;
  if constexpr (std::is_same_v<T, std::uint32_t>) return itk::IOComponentEnum::UINT;
  return itk::IOComponentEnum::FLOAT;
}

}  // namespace

ImageHeader read_image_header(const std::filesystem::path& path, const std::string& dataset) {
  return open_image(path, dataset)->header();
}

template <class T>
Image<T> read_image(const std::filesystem::path& path, const std::string& dataset) {
  const std::unique_ptr<ImageSlices> file = open_image(path, dataset);
  const ImageHeader& header = file->header();
  const auto [nx, ny, nz] = header.size;
  const double bytes = static_cast<double>(sizeof(T)) * static_cast<double>(nx * ny * nz);
  if (const double there = memory_available(); bytes > there) {
    throw InputError(path.string(), 0, "voxels",
                     fmt::format("{} x {} x {}, which need {:.3g} GB", nx, ny, nz, 1e-9 * bytes),
                     fmt::format("voxels that need at most the free memory, {:.3g} GB", 1e-9 * there));
  }
  Image<T> image(header.size, header.spacing, header.origin);
  const std::int64_t some = std::max<std::int64_t>(1, (std::int64_t{1} << 25) / (nx * ny));  // slices per read
  for (std::int64_t k = 0; k < nz; k += some) file->read(k, std::min(some, nz - k), &image.at(0, 0, k));
  return image;
}

template <class T>
void write_image(const std::filesystem::path& path, const Image<T>& image, bool compressed) {
  const itk::ImageIOBase::Pointer io = io_of(path);
  const double spacing[3] = {image.spacing.x, image.spacing.y, image.spacing.z};
  const double origin[3] = {image.origin.x, image.origin.y, image.origin.z};
  io->SetNumberOfDimensions(3);
  itk::ImageIORegion region(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(image.size[axis]);
    io->SetDimensions(axis, n);
    io->SetSpacing(axis, spacing[axis] / mm);
    io->SetOrigin(axis, origin[axis] / mm);
    std::vector<double> direction(3, 0.0);
    direction[axis] = 1;
    io->SetDirection(axis, direction);
    region.SetSize(axis, n);
  }
  io->SetIORegion(region);
  io->SetNumberOfComponents(1);
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetComponentType(component<T>());
  io->SetUseCompression(compressed);
  io->SetCompressionLevel(1);  // every level shrinks labels to about a hundredth
  try {
    io->Write(image.voxels.data());
  } catch (const itk::ExceptionObject& error) {
    throw RunError(path.string() + ": cannot be written: " + error.GetDescription());
  }
}

#define MACADAM_IMAGE_OF(T)                                                       \
  template Image<T> read_image(const std::filesystem::path&, const std::string&); \
  template void write_image(const std::filesystem::path&, const Image<T>&, bool);
MACADAM_IMAGE_OF(std::uint8_t)
MACADAM_IMAGE_OF(std::uint16_t)
MACADAM_IMAGE_OF(std::uint32_t)
MACADAM_IMAGE_OF(float)
#undef MACADAM_IMAGE_OF

}  // namespace macadam
