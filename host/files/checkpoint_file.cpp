// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoint_file.cpp  Reads and writes checkpoint files through the C++ interface of HDF5.
#include "host/files/checkpoint_file.hpp"

#include <H5Cpp.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <new>
#include <type_traits>

#include "host/files/hdf5_type.hpp"
#include "host/base/in_quotes.hpp"
#include "host/files/quiet_hdf5.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

constexpr std::size_t user_block = 512;  ///< size of HDF5's user block [bytes], the smallest that HDF5 allows
constexpr std::size_t growth = 1 << 24;  ///< bytes by which HDF5 enlarges one file in memory

template <class T>
StateArray::Values values_of(const H5::DataSet& set, hsize_t count) {
  std::vector<T> values(count);
  if (count > 0) set.read(values.data(), type_of(T()));
  return values;
}

H5::StrType text_type(std::size_t length) { return {H5::PredType::C_S1, length + 1}; }

/// Returns settings for HDF5's "core" driver, which keeps one file in memory. With this driver HDF5 never writes to a
/// disk. The driver is used because HDF5 does not survive a write error on a full disk.
H5::FileAccPropList in_memory() {
  H5::FileAccPropList access;
  access.setCore(growth, false);
  return access;
}

/// Returns the bytes of a checkpoint file, with an empty user block.
std::string file_of(const Checkpoint& checkpoint) {
  std::size_t bytes_of_state = 0;
  for (const StateArray& array : checkpoint.arrays) {
    bytes_of_state += std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, array.values);
  }
  // Checks that there is memory for the file, for enlarging the file, and for the copy that this function returns.
  require_memory_for_hdf5(3 * bytes_of_state + growth);
  H5::H5File out("in memory", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, in_memory());
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
  out.flush(H5F_SCOPE_GLOBAL);
  const ssize_t bytes = H5Fget_file_image(out.getId(), nullptr, 0);
  if (bytes <= 0) throw H5::FileIException("H5Fget_file_image", "no image");
  std::string all(user_block + static_cast<std::size_t>(bytes), '\0');
  if (H5Fget_file_image(out.getId(), &all[user_block], all.size() - user_block) != bytes) {
    throw H5::FileIException("H5Fget_file_image", "another image");
  }
  return all;
}

/// Counts the bytes that the datasets of an HDF5 image claim to hold. The sum of these bytes cannot be larger than the
/// image, so a damaged file is refused before memory is allocated for its data.
class Room {
 public:
  explicit Room(std::size_t bytes) : left_(static_cast<double>(bytes)) {}

  /// Subtracts the size of a dataset or an attribute from the number of bytes that the image may still hold. \throws
  /// H5::Exception if its type is not one of `kinds`, if its texts have variable length, if it has several dimensions,
  /// or if it is larger than this number of bytes.
  void take(const std::string& name, const H5::AbstractDs& values, std::initializer_list<H5T_class_t> kinds) {
    const H5::DataSpace space = values.getSpace();
    const bool known = std::find(kinds.begin(), kinds.end(), values.getTypeClass()) != kinds.end();
    if (!known || H5Tis_variable_str(values.getDataType().getId()) != 0) refuse(name, "is of another type");
    if (space.getSimpleExtentNdims() > 1) refuse(name, "has several dimensions");
    left_ -= static_cast<double>(space.getSimpleExtentNpoints()) * static_cast<double>(values.getDataType().getSize());
    if (!(left_ >= 0)) refuse(name, "is larger than the file");
  }

  [[noreturn]] static void refuse(const std::string& name, const std::string& what) {
    throw H5::DataSetIException("checkpoint", in_quotes(name) + " " + what);
  }

 private:
  double left_;  ///< number of bytes of the image that no dataset has claimed yet
};

/// Reads a single text and removes the zeros at its end.
template <class Values>
std::string text_in(const std::string& name, const Values& values, Room& room) {
  room.take(name, values, {H5T_STRING});
  if (values.getSpace().getSimpleExtentNpoints() != 1) Room::refuse(name, "is not a single text");
  std::string out;
  if constexpr (std::is_same_v<Values, H5::Attribute>)
    values.read(values.getStrType(), out);
  else
    values.read(out, values.getStrType());
  out.resize(std::min(out.size(), out.find('\0')));  // HDF5 1.14 does not remove the zeros at the end of a text
  return out;
}

/// Returns the names of the datasets in a group. Links are refused, because they may lead to other files or in circles.
std::vector<std::string> names_in(const H5::Group& group) {
  std::vector<std::string> out;
  for (hsize_t i = 0; i < group.getNumObjs(); ++i) {
    out.push_back(group.getObjnameByIdx(i));
    H5L_info_t link{};
    if (H5Lget_info(group.getId(), out.back().c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD ||
        group.childObjType(out.back()) != H5O_TYPE_DATASET)
      Room::refuse(out.back(), "is not a dataset");
  }
  return out;
}

/// Reads a checkpoint from the bytes of an HDF5 file.
Checkpoint read_image(std::string image) {
  H5::FileAccPropList access = in_memory();
  if (H5Pset_file_image(access.getId(), image.data(), image.size()) < 0) {
    throw H5::FileIException("H5Pset_file_image", "no image");
  }
  const H5::H5File in("in memory", H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access);
  Room room(image.size());
  image = {};  // HDF5 has made its own copy
  const H5::Group texts = in.openGroup("texts"), arrays = in.openGroup("arrays");
  Checkpoint out;
  for (const std::string& name : names_in(texts)) out.texts[name] = text_in(name, texts.openDataSet(name), room);
  for (const std::string& name : names_in(arrays)) {
    StateArray array;
    array.name = name;
    const H5::DataSet set = arrays.openDataSet(name);
    room.take(name, set, {H5T_INTEGER, H5T_FLOAT});
    if (set.getCreatePlist().getExternalCount() > 0) Room::refuse(name, "is in another file");
    array.unit = text_in(name, set.openAttribute("unit"), room);
    const auto count = static_cast<hsize_t>(set.getSpace().getSimpleExtentNpoints());
    const bool whole = set.getTypeClass() == H5T_INTEGER, single = set.getDataType().getSize() == sizeof(float);
    array.values = whole    ? values_of<std::int64_t>(set, count)
                   : single ? values_of<float>(set, count)
                            : values_of<double>(set, count);
    out.arrays.push_back(std::move(array));
  }
  return out;
}

}  // namespace

std::string user_block_of(std::string_view image) {
  const uLong checksum = crc32_z(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(image.data()), image.size());
  std::string block = fmt::format("Macadam checkpoint of {} bytes, CRC-32 of those from {} on {:08x}\n",
                                  user_block + image.size(), user_block, checksum);
  block.resize(user_block, '\0');
  return block;
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  std::string bytes;
  const QuietHdf5 quiet;
  const auto fail = [&](const std::string& what) {
    throw RunError(file.string() + ": HDF5 cannot make the checkpoint (out of memory?): " + what +
                   (quiet.failed() ? ": " + quiet.why() : ""));
  };
  try {
    bytes = file_of(checkpoint);
    if (quiet.failed()) fail("an array cannot be closed");
  } catch (const H5::Exception& error) { fail(error.getDetailMsg()); } catch (const std::bad_alloc&) {
    throw RunError(file.string() + ": not enough memory to make the checkpoint");
  }
  bytes.replace(0, user_block, user_block_of(std::string_view(bytes).substr(user_block)));
  write_whole(file, bytes, true);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError(file.string(), 0, "checkpoint", found, expected);
  };
  if (!std::filesystem::is_regular_file(file)) refuse("no such file", "a checkpoint (a finished run leaves none)");
  std::ifstream in(file, std::ios::binary);
  std::string header(user_block, '\0');
  in.read(header.data(), static_cast<std::streamsize>(header.size()));
  unsigned long long bytes = 0;
  if (std::sscanf(header.c_str(), "Macadam checkpoint of %llu bytes", &bytes) != 1) {
    refuse("another kind of file", "a checkpoint of Macadam");
  }
  if (const auto size = std::filesystem::file_size(file); size != bytes || size < user_block) {
    refuse(fmt::format("{} bytes", size), fmt::format("{} bytes: the file is cut off or damaged", bytes));
  }
  std::string image(bytes - user_block, '\0');
  in.read(image.data(), static_cast<std::streamsize>(image.size()));
  if (!in || header != user_block_of(image))
    refuse("a checksum that differs from the checksum in the header", "the same checksum: the file is damaged");
  try {
    const QuietHdf5 quiet;
    require_memory_for_hdf5(2 * image.size());
    return read_image(std::move(image));
  } catch (const H5::Exception& error) {
    throw InputError(file.string(), 0, "checkpoint", "data that HDF5 cannot read (" + error.getDetailMsg() + ")",
                     "a complete checkpoint");
  }
}

}  // namespace macadam
