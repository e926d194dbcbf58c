// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint.cpp  The only file that knows HDF5, through its own C++ interface.
#include "host/results/checkpoint.hpp"

#include <H5Cpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::size_t user_block = 512;  ///< HDF5's smallest

/// HDF5 prints its errors unless told not to.
class Quiet {
 public:
  Quiet() {
    H5::Exception::getAutoPrint(print_, &data_);
    H5::Exception::dontPrint();
  }
  Quiet(const Quiet&) = delete;
  ~Quiet() { H5::Exception::setAutoPrint(print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

const H5::PredType& type_of(float) { return H5::PredType::NATIVE_FLOAT; }
const H5::PredType& type_of(double) { return H5::PredType::NATIVE_DOUBLE; }
const H5::PredType& type_of(std::int64_t) { return H5::PredType::NATIVE_INT64; }

template <class T>
StateArray::Values values_of(const H5::DataSet& set, hsize_t count) {
  std::vector<T> values(count);
  if (count > 0) set.read(values.data(), type_of(T()));
  return values;
}

H5::StrType text_type(std::size_t length) { return {H5::PredType::C_S1, length + 1}; }

void write_hdf5(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  H5::FileCreatPropList properties;
  properties.setUserblock(user_block);
  H5::H5File out(file.string(), H5F_ACC_TRUNC, properties);
  const H5::Group texts = out.createGroup("texts"), arrays = out.createGroup("arrays");
  for (const auto& [name, text] : checkpoint.texts) {
    const H5::StrType type = text_type(text.size());
    texts.createDataSet(name, type, H5::DataSpace()).write(text.c_str(), type);
  }
  for (const StateArray& array : checkpoint.arrays) {
    std::visit(
        [&](const auto& values) {
          const hsize_t count = values.size();
          const auto& type = type_of(typename std::decay_t<decltype(values)>::value_type());
          const H5::DataSet set = arrays.createDataSet(array.name, type, H5::DataSpace(1, &count));
          if (count > 0) set.write(values.data(), type);
          const H5::StrType unit = text_type(array.unit.size());
          set.createAttribute("unit", unit, H5::DataSpace()).write(unit, array.unit);
        },
        array.values);
  }
  out.close();
}

Checkpoint read_hdf5(const std::filesystem::path& file) {
  const H5::H5File in(file.string(), H5F_ACC_RDONLY);
  const H5::Group texts = in.openGroup("texts"), arrays = in.openGroup("arrays");
  Checkpoint out;
  for (hsize_t i = 0; i < texts.getNumObjs(); ++i) {
    const std::string name = texts.getObjnameByIdx(i);
    const H5::DataSet set = texts.openDataSet(name);
    set.read(out.texts[name], set.getStrType());
  }
  for (hsize_t i = 0; i < arrays.getNumObjs(); ++i) {
    StateArray array;
    array.name = arrays.getObjnameByIdx(i);
    const H5::DataSet set = arrays.openDataSet(array.name);
    const H5::Attribute unit = set.openAttribute("unit");
    unit.read(unit.getStrType(), array.unit);
    const auto count = static_cast<hsize_t>(set.getSpace().getSimpleExtentNpoints());
    const bool whole = set.getTypeClass() == H5T_INTEGER, single = set.getDataType().getSize() == sizeof(float);
    array.values = whole    ? values_of<std::int64_t>(set, count)
                   : single ? values_of<float>(set, count)
                            : values_of<double>(set, count);
    out.arrays.push_back(std::move(array));
  }
  return out;
}

/// The user block of a file of so many bytes: HDF5 itself may fail on a damaged file, so that none is given to it.
std::string header_of(std::uintmax_t bytes, uLong checksum) {
  return fmt::format("Macadam checkpoint of {} bytes, CRC-32 of those from {} on {:08x}\n", bytes, user_block,
                     checksum);
}

/// The header that the file ought to have.
std::string header_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(user_block);
  uLong checksum = crc32(0, nullptr, 0);
  std::vector<char> block(1 << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    checksum = crc32(checksum, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(in.gcount()));
  }
  return header_of(std::filesystem::file_size(file), checksum);
}

/// Waits until what was written is on the disk; a folder's entries likewise.
void sync(const std::filesystem::path& path, const std::string& header) {
  const bool folder = header.empty();
  const int file = ::open(path.c_str(), folder ? O_RDONLY | O_DIRECTORY : O_WRONLY);
  bool good = file >= 0;
  if (!folder) good = good && ::pwrite(file, header.data(), header.size(), 0) == static_cast<ssize_t>(header.size());
  good = good && ::fsync(file) == 0;
  if (file >= 0) good = ::close(file) == 0 && good;
  if (!good && !folder) throw RunError(path.string() + ": cannot be written (disk full, or no permission)");
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  auto part = file;
  part += ".part";
  try {
    const Quiet quiet;
    write_hdf5(part, checkpoint);
  } catch (const H5::Exception& error) {
    throw RunError(part.string() + ": cannot be written (disk full, or no permission): " + error.getDetailMsg());
  }
  sync(part, header_of(part));
  std::error_code error;
  std::filesystem::rename(part, file, error);
  if (error) throw RunError(file.string() + ": cannot be replaced: " + error.message());
  sync(file.parent_path().empty() ? "." : file.parent_path(), "");
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError(file.string(), 0, "checkpoint", found, expected);
  };
  if (!std::filesystem::is_regular_file(file)) refuse("no such file", "one (a run that is done leaves none)");
  std::ifstream in(file, std::ios::binary);
  std::string header(user_block, '\0');
  in.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(std::min(header.find('\n'), header.size() - 1) + 1);
  unsigned long long bytes = 0;
  if (std::sscanf(header.c_str(), "Macadam checkpoint of %llu bytes", &bytes) != 1) {
    refuse("another kind of file", "a checkpoint of Macadam");
  }
  if (const auto size = std::filesystem::file_size(file); size != bytes) {
    refuse(fmt::format("{} bytes", size), fmt::format("{}: it is cut off or damaged", bytes));
  }
  if (header != header_of(file)) refuse("another checksum than it names", "the same: it is damaged");
  try {
    const Quiet quiet;
    return read_hdf5(file);
  } catch (const H5::Exception& error) {
    throw InputError(file.string(), 0, "checkpoint", "what HDF5 cannot read (" + error.getDetailMsg() + ")",
                     "texts and arrays");
  }
}

}  // namespace macadam
