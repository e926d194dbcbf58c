// SPDX-License-Identifier: GPL-3.0-or-later
// itk_slices.cpp  Reads MetaImage, NRRD and TIFF files, and folders of TIFF files, with ITK's readers.
#include <fmt/format.h>

#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkTIFFImageIO.h>

#include <iostream>

#include "host/tools/ct/images/image_slices.hpp"
#include "host/tools/ct/images/imagej_stack.hpp"
#include "host/tools/ct/images/slice_names.hpp"
#include "host/tools/ct/images/itk_io.hpp"
#include "host/tools/ct/images/meta_header.hpp"
#include "host/tools/ct/images/nrrd_header.hpp"
#include "host/tools/ct/images/tiff_directories.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {

namespace fs = std::filesystem;

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

/// Redirects std::cout and std::cerr into a text during the lifetime of the object. The text is needed because MetaIO
/// only prints its errors and then continues.
class Overheard {
 public:
  Overheard() : out_(std::cout.rdbuf(text_.rdbuf())), error_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~Overheard() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }
  Overheard(const Overheard&) = delete;
  Overheard& operator=(const Overheard&) = delete;
  /// Returns the captured output in one line.
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

/// Reads the header. For TIFF it suppresses ITK's warnings about tags that ITK does not keep, such as colour profiles.
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

/// Runs `read`. \throws InputError if it throws or prints anything.
template <class Read>
void attempt(const std::string& file, const char* what, const std::string& expected, Read&& read) {
  std::string fault;
  {
    const Overheard overheard;
    try {
      read();
    } catch (const itk::ExceptionObject& error) { fault = error.GetDescription(); } catch (const std::bad_alloc&) {
      fault = "the file needs more memory than there is";
    }
    if (!overheard.text().empty()) fault = overheard.text();
  }
  if (!fault.empty()) throw InputError(file, 0, what, "one that ITK cannot read (" + fault + ")", expected);
}

/// Checks a file before ITK reads it. Returns the facts in its header that ITK does not report. \throws InputError for
/// a file that would crash or mislead ITK.
HeaderFacts check_file(const itk::ImageIOBase& io) {
  const std::string file = io.GetFileName();
  if (!fs::is_regular_file(file)) throw InputError(file, 0, "image", "no such file", "a file that can be read");
  if (dynamic_cast<const itk::MetaImageIO*>(&io)) return check_meta_header(file);
  if (dynamic_cast<const itk::NrrdImageIO*>(&io)) return check_nrrd_header(file);
  const TiffPages pages = check_tiff_directories(file);
  if (pages.described > pages.pages)
    throw InputError(file, 0, "slice",
                     fmt::format("1 slice, although the description of the file says {}", pages.described),
                     "one slice in each file of a folder");
  HeaderFacts facts;
  facts.voxels = file, facts.white_is_zero = pages.white_is_zero;
  return facts;
}

/// Adds a message if the axes of the voxels differ from the axes of the space in which a scanner or viewer placed the
/// image.
void note_directions(const itk::ImageIOBase& io, std::vector<std::string>& notes) {
  if (io.GetNumberOfDimensions() != 3) return;
  double d[3][3];  // columns are the axes of the voxels
  bool identity = true;
  for (unsigned column = 0; column < 3; ++column) {
    const std::vector<double> axis = io.GetDirection(column);
    for (unsigned row = 0; row < 3; ++row) {
      d[row][column] = row < axis.size() ? axis[row] : 0;
      identity = identity && std::abs(d[row][column] - (row == column ? 1 : 0)) < 1e-6;
    }
  }
  if (identity) return;
  const double determinant = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                             d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                             d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  notes.push_back(fmt::format(
      "the file's direction matrix ({:.4g} {:.4g} {:.4g}, {:.4g} {:.4g} {:.4g}, {:.4g} {:.4g} {:.4g}) is not applied: "
      "x, "
      "y and z of the results are the axes of the voxels, and grains and specimen are {} those that were scanned",
      d[0][0], d[0][1], d[0][2], d[1][0], d[1][1], d[1][2], d[2][0], d[2][1], d[2][2],
      determinant < 0 ? "mirror images of" : "rotated relative to"));
}

/// Returns the header of one file. \throws InputError.
ImageHeader header_of(itk::ImageIOBase& io, const HeaderFacts& facts) {
  const std::string file = io.GetFileName();
  std::size_t bytes = 0;  // bytes per voxel
  attempt(file, "image", "a complete image file", [&] {
    read_information(io);
    bytes = io.GetComponentSize();  // throws if the type is not known
  });
  if (io.GetNumberOfComponents() != 1 || io.GetNumberOfDimensions() < 2 || io.GetNumberOfDimensions() > 3) {
    throw InputError(
        file, 0, "image",
        fmt::format("{} values per voxel in {} dimensions", io.GetNumberOfComponents(), io.GetNumberOfDimensions()),
        "one grey value per voxel, in two or three dimensions");
  }
  ImageHeader header;
  bool known = false;  // formats without a spacing report 1 on all axes
  double spacing[3] = {1, 1, 1}, origin[3] = {};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const bool there = axis < io.GetNumberOfDimensions();
    header.size[axis] = there ? static_cast<std::int64_t>(io.GetDimensions(axis)) : 1;
    if (!there) continue;
    spacing[axis] = io.GetSpacing(axis);
    origin[axis] = io.GetOrigin(axis);
    known = known || spacing[axis] != 1;
  }
  known = known && !is_tiff(file);  // the resolution in a TIFF file is for printing, and for two axes only
  header.notes = facts.notes;
  note_directions(io, header.notes);
  const double unit = facts.unit.value_or(0);
  if (known) header.spacing = {unit * spacing[0], unit * spacing[1], unit * spacing[2]};
  header.origin = {unit * origin[0], unit * origin[1], unit * origin[2]};
  header.bits = static_cast<int>(8 * bytes);
  const auto type = io.GetComponentType();
  header.floating = type == itk::IOComponentEnum::FLOAT || type == itk::IOComponentEnum::DOUBLE;
  return header;
}

/// Returns the voxel type that ITK found. \throws InputError if it is not known.
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
      throw InputError(io.GetFileName(), 0, "type of the voxels", "an unknown type",
                       "integers of 8, 16 or 32 bits, or floats");
  }
}

/// Reads slices [first, first + count) of one file.
void read_region(itk::ImageIOBase& io, std::int64_t first, std::int64_t count, char* to) {
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) region.SetSize(axis, io.GetDimensions(axis));
  if (io.GetNumberOfDimensions() > 2) region.SetIndex(2, first), region.SetSize(2, static_cast<std::size_t>(count));
  io.SetIORegion(region);
  attempt(io.GetFileName(), "voxels",
          fmt::format("{} x {} x {} of them", io.GetDimensions(0), io.GetDimensions(1), count), [&] { io.Read(to); });
}

/// One MetaImage, NRRD or TIFF file.
class FileSlices : public ImageSlices {
 public:
  explicit FileSlices(const fs::path& path) : io_(io_of(path)) {
    file_ = path.string();
    const HeaderFacts facts = check_file(*io_);
    voxels_ = facts.voxels;
    header_ = header_of(*io_, facts);
    type_ = type_of(*io_);
    if (facts.white_is_zero) invert_grey();
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
  // all voxels, if the file can only be read as a whole
  std::vector<char> whole_;
};

/// A folder of TIFF files, one slice each. All files must have the size and type of the first one.
class FolderSlices : public ImageSlices {
 public:
  explicit FolderSlices(const fs::path& path) : slices_(slices_in(path)) {
    file_ = path.string();
    const itk::ImageIOBase::Pointer first = io_of(slices_.front());
    const HeaderFacts facts = check_file(*first);
    header_ = header_of(*first, facts);
    type_ = type_of(*first);
    if (facts.white_is_zero) invert_grey();
    for (const fs::path& slice : slices_) {
      const itk::ImageIOBase::Pointer io = io_of(slice);
      const HeaderFacts own_facts = check_file(*io);
      const ImageHeader own = header_of(*io, own_facts);
      if (own_facts.white_is_zero != facts.white_is_zero)
        throw InputError(slice.string(), 0, "PhotometricInterpretation (tag 262)",
                         own_facts.white_is_zero ? "0 (white is 0)" : "1 (black is 0)",
                         "the same as in " + slices_.front().filename().string());
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
  if (is_tiff(path) && fs::is_regular_file(path)) {
    if (std::unique_ptr<ImageSlices> stack = open_imagej_stack(path, check_tiff_directories(path))) return stack;
  }
  return std::make_unique<FileSlices>(path);
}

}  // namespace macadam::ct
