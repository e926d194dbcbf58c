// SPDX-License-Identifier: GPL-3.0-or-later
// itk_slices.cpp  MetaImage, NRRD and TIFF files, and folders of TIFF files, by ITK's readers.
#include <fmt/format.h>

#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkTIFFImageIO.h>

#include <iostream>

#include "host/ct/image_slices.hpp"
#include "host/ct/slice_names.hpp"
#include "host/ct/itk_io.hpp"
#include "host/ct/meta_header.hpp"
#include "host/ct/nrrd_header.hpp"
#include "host/ct/tiff_directories.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {

namespace fs = std::filesystem;

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
                     ".mha, .mhd (raw voxels with a header), .nrrd, .nhdr, .tif, a folder of .tif, .h5 or .hdf5");
  }
  io->SetFileName(path.string());
  return io;
}

namespace {

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

/// Without the warnings that ITK has for tags of a TIFF which it keeps no copy of, such as colour profiles.
void read_information(itk::ImageIOBase& io) {
  const bool warns = itk::Object::GetGlobalWarningDisplay();
  itk::Object::SetGlobalWarningDisplay(warns && !is_tiff(io.GetFileName()));
  try {
    io.ReadImageInformation();
  } catch (...) {
    itk::Object::SetGlobalWarningDisplay(warns);
    throw;
  }
  itk::Object::SetGlobalWarningDisplay(warns);
}

/// Does `read`. \throws InputError where it throws, or says anything.
template <class Read>
void attempt(const std::string& file, const char* what, const std::string& expected, Read&& read) {
  std::string fault;
  {
    const Overheard overheard;
    try {
      read();
    } catch (const itk::ExceptionObject& error) { fault = error.GetDescription(); } catch (const std::bad_alloc&) {
      fault = "it asks for more memory than there is";
    }
    if (!overheard.text().empty()) fault = overheard.text();
  }
  if (!fault.empty()) throw InputError(file, 0, what, "one that ITK cannot read (" + fault + ")", expected);
}

/// Looks at a file before ITK does. Returns the one that holds its voxels. \throws InputError for what ITK cannot bear.
fs::path check_file(const itk::ImageIOBase& io) {
  const std::string file = io.GetFileName();
  if (!fs::is_regular_file(file)) throw InputError(file, 0, "image", "no such file", "a file that can be read");
  if (dynamic_cast<const itk::MetaImageIO*>(&io)) return check_meta_header(file);
  if (dynamic_cast<const itk::NrrdImageIO*>(&io)) return check_nrrd_header(file);
  check_tiff_directories(file);
  return file;
}

/// The header of one file. \throws InputError.
ImageHeader header_of(itk::ImageIOBase& io) {
  const std::string file = io.GetFileName();
  std::size_t bytes = 0;  // of a voxel
  attempt(file, "image", "a whole image file", [&] {
    read_information(io);
    bytes = io.GetComponentSize();  // which throws where the type is not known
  });
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
  header.bits = static_cast<int>(8 * bytes);
  const auto type = io.GetComponentType();
  header.floating = type == itk::IOComponentEnum::FLOAT || type == itk::IOComponentEnum::DOUBLE;
  return header;
}

VoxelType type_of(const itk::ImageIOBase& io) {
  using Type = itk::IOComponentEnum;
  switch (io.GetComponentType()) {
    case Type::UCHAR:
      return VoxelType::u8;
    case Type::CHAR:
      return VoxelType::i8;
    case Type::USHORT:
      return VoxelType::u16;
    case Type::SHORT:
      return VoxelType::i16;
    case Type::UINT:
      return VoxelType::u32;
    case Type::INT:
      return VoxelType::i32;
    case Type::ULONG:
      return VoxelType::u64;
    case Type::LONG:
      return VoxelType::i64;
    case Type::FLOAT:
      return VoxelType::f32;
    case Type::DOUBLE:
      return VoxelType::f64;
    default:
      throw InputError(io.GetFileName(), 0, "type of the voxels", "one that is not known",
                       "8, 16 or 32 bits, or float");
  }
}

/// Slices [first, first + count) of one file.
void read_region(itk::ImageIOBase& io, std::int64_t first, std::int64_t count, char* to) {
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) region.SetSize(axis, io.GetDimensions(axis));
  if (io.GetNumberOfDimensions() > 2) region.SetIndex(2, first), region.SetSize(2, static_cast<std::size_t>(count));
  io.SetIORegion(region);
  attempt(io.GetFileName(), "voxels",
          fmt::format("{} x {} x {} of them", io.GetDimensions(0), io.GetDimensions(1), count), [&] { io.Read(to); });
}

class FileSlices : public ImageSlices {
 public:
  explicit FileSlices(const fs::path& path) : io_(io_of(path)) {
    file_ = path.string();
    voxels_ = check_file(*io_);
    header_ = header_of(*io_);
    type_ = type_of(*io_);
  }
  bool apart() const override { return io_->CanStreamRead(); }

 private:
  void read_bytes(std::int64_t first, std::int64_t count, char* to) override {
    if (apart()) return read_region(*io_, first, count, to);
    const auto slice = static_cast<std::size_t>(header_.size[0] * header_.size[1] * bytes_of(type_));
    const std::size_t size = slice * static_cast<std::size_t>(header_.size[2]);
    if (count == header_.size[2]) return read_region(*io_, 0, count, to);
    if (whole_.empty()) {
      whole_.resize(size);
      read_region(*io_, 0, header_.size[2], whole_.data());
    }
    std::copy_n(whole_.data() + slice * static_cast<std::size_t>(first), slice * static_cast<std::size_t>(count), to);
  }
  itk::ImageIOBase::Pointer io_;
  std::vector<char> whole_;
};

class FolderSlices : public ImageSlices {
 public:
  explicit FolderSlices(const fs::path& path) : slices_(slices_in(path)) {
    file_ = path.string();
    const itk::ImageIOBase::Pointer first = io_of(slices_.front());
    check_file(*first);
    header_ = header_of(*first);
    type_ = type_of(*first);
    for (const fs::path& slice : slices_) {
      const itk::ImageIOBase::Pointer io = io_of(slice);
      check_file(*io);
      const ImageHeader own = header_of(*io);
      if (own.size != header_.size || own.size[2] != 1 || type_of(*io) != type_) {
        throw InputError(slice.string(), 0, "slice",
                         fmt::format("{} x {} x {} voxels of {} bits", own.size[0], own.size[1], own.size[2], own.bits),
                         fmt::format("{} x {} x 1 of {} bits, as in {}", header_.size[0], header_.size[1], header_.bits,
                                     slices_.front().filename().string()));
      }
    }
    header_.size[2] = static_cast<std::int64_t>(slices_.size());
  }
  bool apart() const override { return true; }

 private:
  void read_bytes(std::int64_t first, std::int64_t count, char* to) override {
    for (std::int64_t k = first; k < first + count; ++k) {
      const itk::ImageIOBase::Pointer io = io_of(slices_[static_cast<std::size_t>(k)]);
      read_information(*io);
      read_region(*io, 0, 1, to);
      to += header_.size[0] * header_.size[1] * bytes_of(type_);
    }
  }
  std::vector<fs::path> slices_;
};

}  // namespace

std::unique_ptr<ImageSlices> open_itk(const fs::path& path) {
  if (fs::is_directory(path)) return std::make_unique<FolderSlices>(path);
  return std::make_unique<FileSlices>(path);
}

}  // namespace macadam::ct
