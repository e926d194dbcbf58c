// SPDX-License-Identifier: GPL-3.0-or-later
// image_io.cpp  Image files, by ITK's readers and writers of MetaImage, NRRD and TIFF.
#include <fmt/format.h>

#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkTIFFImageIO.h>

#include <iostream>

#include "host/ct/slice_names.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;
constexpr double mm = 1e-3;  // what lengths in image files are in

std::string lower_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool is_tiff(const fs::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".tif" || ending == ".tiff";
}

itk::ImageIOBase::Pointer io_of(const fs::path& path) {
  const std::string ending = lower_ending(path);
  itk::ImageIOBase::Pointer io;
  if (ending == ".mha" || ending == ".mhd") io = itk::MetaImageIO::New().GetPointer();
  if (ending == ".nrrd" || ending == ".nhdr") io = itk::NrrdImageIO::New().GetPointer();
  if (is_tiff(path)) io = itk::TIFFImageIO::New().GetPointer();
  if (!io) {
    throw InputError(path.string(), 0, "format of the image", "\"" + ending + "\"",
                     ".mha, .mhd (raw voxels with a header), .nrrd, .nhdr, .tif, or a folder of .tif");
  }
  io->SetFileName(path.string());
  return io;
}

/// Less by letters, and by value where both have digits: slice_2 comes before slice_10.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& s, std::size_t& at) {
      while (at < s.size() && s[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < s.size() && digit(s[at])) ++at;
      return s.substr(begin, at - begin);
    };
    const std::string x = number(a, i), y = number(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

std::vector<fs::path> slices_in(const fs::path& folder) {
  std::vector<fs::path> slices;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_tiff(entry.path())) slices.push_back(entry.path());
  }
  if (slices.empty()) throw InputError(folder.string(), 0, "slices", "no .tif file", "a folder of .tif files");
  std::sort(slices.begin(), slices.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  ct::check_slice_numbers(slices);
  return slices;
}

bool floating(const itk::ImageIOBase& io) {
  const auto type = io.GetComponentType();
  return type == itk::IOComponentEnum::FLOAT || type == itk::IOComponentEnum::DOUBLE;
}

/// MetaIO says on the standard streams what is wrong, and goes on: while one of these lives, they lead into a text.
class Overheard {
 public:
  Overheard() : out_(std::cout.rdbuf(text_.rdbuf())), error_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~Overheard() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }
  Overheard(const Overheard&) = delete;
  Overheard& operator=(const Overheard&) = delete;
  /// In one line.
  std::string text() const {
    std::string all = text_.str();
    while (!all.empty() && all.back() == '\n') all.pop_back();
    std::replace(all.begin(), all.end(), '\n', ' ');
    return all;
  }

 private:
  std::ostringstream text_;
  std::streambuf *out_, *error_;
};

/// Does `read`. \throws InputError where it throws, or says anything.
template <class Read>
void attempt(const std::string& file, const char* what, const std::string& expected, Read&& read) {
  std::string fault;
  {
    const Overheard overheard;
    try {
      read();
    } catch (const itk::ExceptionObject& error) { fault = error.GetDescription(); }
    if (!overheard.text().empty()) fault = overheard.text();
  }
  if (!fault.empty()) throw InputError(file, 0, what, "one that ITK cannot read (" + fault + ")", expected);
}

/// The header of one file. \throws InputError.
ImageHeader header_of(itk::ImageIOBase& io) {
  const std::string file = io.GetFileName();
  if (!fs::exists(file)) throw InputError(file, 0, "image", "no such file", "a file that can be read");
  attempt(file, "image", "a whole image file", [&] { io.ReadImageInformation(); });
  if (io.GetNumberOfComponents() != 1 || io.GetNumberOfDimensions() < 2 || io.GetNumberOfDimensions() > 3) {
    throw InputError(
        file, 0, "image",
        fmt::format("{} values a voxel in {} dimensions", io.GetNumberOfComponents(), io.GetNumberOfDimensions()),
        "one grey value a voxel, in two or three dimensions");
  }
  ImageHeader header;
  bool known = false;  // a spacing of 1 on all axes is what formats say that know nothing
  double spacing[3] = {1, 1, 1}, origin[3] = {};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const bool there = axis < io.GetNumberOfDimensions();
    header.size[axis] = there ? static_cast<std::int64_t>(io.GetDimensions(axis)) : 1;
    if (!there) continue;
    spacing[axis] = io.GetSpacing(axis);
    origin[axis] = io.GetOrigin(axis);
    known = known || spacing[axis] != 1;
  }
  known = known && !is_tiff(file);  // its resolution is meant for paper, and knows two axes
  if (known) header.spacing = {mm * spacing[0], mm * spacing[1], mm * spacing[2]};
  header.origin = {mm * origin[0], mm * origin[1], mm * origin[2]};
  header.bits = static_cast<int>(8 * io.GetComponentSize());
  header.floating = floating(io);
  return header;
}

/// Voxels of one file, as T.
template <class From, class T>
void convert(const std::string& file, const From* from, std::size_t count, T* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const From value = from[i];
    bool fits = true;
    if constexpr (std::is_floating_point_v<From>) fits = std::isfinite(value);
    if constexpr (std::is_integral_v<T>) {
      fits = fits && static_cast<long double>(value) >= 0 &&
             static_cast<long double>(value) <= static_cast<long double>(std::numeric_limits<T>::max()) &&
             static_cast<From>(static_cast<T>(value)) == value;
    }
    if (!fits) {
      throw InputError(file, 0, fmt::format("voxel {} (the first is 0, x runs fastest)", i), fmt::format("{}", value),
                       std::is_integral_v<T> ? fmt::format("a whole number from 0 to {}", std::numeric_limits<T>::max())
                                             : "a finite number");
    }
    to[i] = static_cast<T>(value);
  }
}

template <class T>
void read_voxels(itk::ImageIOBase& io, std::size_t count, T* to) {
  const std::string file = io.GetFileName();
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) region.SetSize(axis, io.GetDimensions(axis));
  io.SetIORegion(region);
  std::vector<char> raw(count * io.GetComponentSize());
  attempt(file, "voxels", fmt::format("{} of them", count), [&] { io.Read(raw.data()); });
  const auto as = [&](auto kind) { convert(file, reinterpret_cast<const decltype(kind)*>(raw.data()), count, to); };
  using Type = itk::IOComponentEnum;
  switch (io.GetComponentType()) {
    case Type::UCHAR:
      return as(static_cast<unsigned char>(0));
    case Type::CHAR:
      return as(static_cast<signed char>(0));
    case Type::USHORT:
      return as(static_cast<unsigned short>(0));
    case Type::SHORT:
      return as(static_cast<short>(0));
    case Type::UINT:
      return as(0u);
    case Type::INT:
      return as(0);
    case Type::ULONG:
      return as(0ul);
    case Type::LONG:
      return as(0l);
    case Type::FLOAT:
      return as(0.0f);
    case Type::DOUBLE:
      return as(0.0);
    default:
      throw InputError(file, 0, "type of the voxels", "one that is not known", "8, 16 or 32 bits, or float");
  }
}

template <class T>
constexpr itk::IOComponentEnum component() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return itk::IOComponentEnum::UCHAR;
  if constexpr (std::is_same_v<T, std::uint16_t>) return itk::IOComponentEnum::USHORT;
  if constexpr (std::is_same_v<T, std::uint32_t>) return itk::IOComponentEnum::UINT;
  return itk::IOComponentEnum::FLOAT;
}

}  // namespace

ImageHeader read_image_header(const std::filesystem::path& path) {
  if (!fs::is_directory(path)) return header_of(*io_of(path));
  const std::vector<fs::path> slices = slices_in(path);
  ImageHeader header = header_of(*io_of(slices.front()));
  for (const fs::path& slice : slices) {
    const ImageHeader own = header_of(*io_of(slice));
    if (own.size != header.size || own.size[2] != 1 || own.bits != header.bits || own.floating != header.floating) {
      throw InputError(slice.string(), 0, "slice",
                       fmt::format("{} x {} x {} voxels of {} bits", own.size[0], own.size[1], own.size[2], own.bits),
                       fmt::format("{} x {} x 1 of {} bits, as in {}", header.size[0], header.size[1], header.bits,
                                   slices.front().filename().string()));
    }
  }
  header.size[2] = static_cast<std::int64_t>(slices.size());
  return header;
}

template <class T>
Image<T> read_image(const std::filesystem::path& path) {
  const ImageHeader header = read_image_header(path);
  Image<T> image(header.size, header.spacing, header.origin);
  if (!fs::is_directory(path)) {
    const itk::ImageIOBase::Pointer io = io_of(path);
    io->ReadImageInformation();
    read_voxels(*io, image.count(), image.voxels.data());
    return image;
  }
  const std::size_t slice = image.count() / static_cast<std::size_t>(image.size[2]);
  T* to = image.voxels.data();
  for (const fs::path& file : slices_in(path)) {
    const itk::ImageIOBase::Pointer io = io_of(file);
    io->ReadImageInformation();
    read_voxels(*io, slice, to);
    to += slice;
  }
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
  io->SetCompressionLevel(1);  // labels shrink to a hundredth at any
  try {
    io->Write(image.voxels.data());
  } catch (const itk::ExceptionObject& error) {
    throw RunError(path.string() + ": cannot be written: " + error.GetDescription());
  }
}

#define MACADAM_IMAGE_OF(T)                                   \
  template Image<T> read_image(const std::filesystem::path&); \
  template void write_image(const std::filesystem::path&, const Image<T>&, bool);
MACADAM_IMAGE_OF(std::uint8_t)
MACADAM_IMAGE_OF(std::uint16_t)
MACADAM_IMAGE_OF(std::uint32_t)
MACADAM_IMAGE_OF(float)
#undef MACADAM_IMAGE_OF

}  // namespace macadam
