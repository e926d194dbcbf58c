// SPDX-License-Identifier: GPL-3.0-or-later
// hdf5_slices.cpp  Reads a three-dimensional dataset of an HDF5 file.
#include <fmt/format.h>

#include "host/tools/ct/images/image_slices.hpp"
#include "host/files/quiet_hdf5.hpp"
#include "macadam/error.hpp"

namespace macadam::ct {
namespace {

namespace fs = std::filesystem;

/// Returns HDF5's type for a voxel type.
const H5::PredType& native(VoxelType type) {
  using H5::PredType;
  static const PredType* const types[] = {&PredType::NATIVE_UINT8,  &PredType::NATIVE_INT8,   &PredType::NATIVE_UINT16,
                                          &PredType::NATIVE_INT16,  &PredType::NATIVE_UINT32, &PredType::NATIVE_INT32,
                                          &PredType::NATIVE_UINT64, &PredType::NATIVE_INT64,  &PredType::NATIVE_FLOAT,
                                          &PredType::NATIVE_DOUBLE};
  return *types[static_cast<std::size_t>(type)];
}

/// Returns the voxel type of a dataset. \throws InputError if its values are not numbers.
VoxelType type_of(const H5::DataSet& set, const std::string& file) {
  const std::size_t bytes = set.getDataType().getSize();
  if (set.getTypeClass() == H5T_FLOAT) return bytes > 4 ? VoxelType::f64 : VoxelType::f32;
  if (set.getTypeClass() != H5T_INTEGER || bytes > 8)
    throw InputError(file, 0, "type of the voxels", "a type that is not a number",
                     "integers of 8, 16 or 32 bits, or floats");
  const bool sign = set.getIntType().getSign() != H5T_SGN_NONE;
  const int power = bytes == 1 ? 0 : bytes == 2 ? 1 : bytes <= 4 ? 2 : 3;
  return static_cast<VoxelType>(2 * power + sign);
}

/// Returns the names of the three-dimensional datasets.
std::vector<std::string> volumes_in(const H5::H5File& file) {
  std::vector<std::string> names, volumes;
  const auto visit = [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(to)->push_back(name);
    return 0;
  };
  if (H5Ovisit(file.getId(), H5_INDEX_NAME, H5_ITER_INC, visit, &names) < 0)
    throw H5::FileIException("H5Ovisit", "objects that cannot be read");
  for (const std::string& name : names)
    if (file.openDataSet(name).getSpace().getSimpleExtentNdims() == 3) volumes.push_back(name);
  return volumes;
}

/// Returns the name of the dataset to read: `asked`, or the only three-dimensional dataset if none was asked for.
/// \throws InputError.
std::string name_of(const H5::H5File& file, const std::string& asked, const std::string& path) {
  if (!asked.empty() && file.nameExists(asked) && file.childObjType(asked) == H5O_TYPE_DATASET) return asked;
  const std::vector<std::string> volumes = volumes_in(file);
  if (asked.empty() && volumes.size() == 1) return volumes.front();
  std::string names;
  for (std::size_t n = 0; n < volumes.size() && n < 20; ++n) names += (n == 0 ? "" : ", ") + volumes[n];
  if (volumes.empty()) throw InputError(path, 0, "datasets of three dimensions", "none", "at least one");
  if (asked.empty())
    throw InputError(path, 0, "datasets of three dimensions", names, "only one, or the name of one in --dataset");
  throw InputError(path, 0, "dataset", "none of the name \"" + asked + "\"", "one of " + names);
}

/// Returns the edges of a voxel [m] from the attribute that ImageJ and ilastik write, in micrometres along z, y, x.
/// Returns 0 if the attribute is missing or invalid.
Vec3d spacing_of(const H5::DataSet& set) {
  constexpr const char* name = "element_size_um";
  constexpr double um = 1e-6;
  if (!set.attrExists(name)) return {};
  const H5::Attribute attribute = set.openAttribute(name);
  if (attribute.getSpace().getSimpleExtentNpoints() != 3) return {};
  double edges[3] = {};
  attribute.read(H5::PredType::NATIVE_DOUBLE, edges);
  for (const double edge : edges)
    if (!(edge > 0 && edge < 1e6)) return {};
  return {um * edges[2], um * edges[1], um * edges[0]};
}

/// Checks that the file stores all voxels that the header counts. HDF5 fills in missing voxels, so without this check a
/// forged count could have any size. \throws InputError if voxels are missing or stored in other files.
void check_storage(const H5::DataSet& set, const ImageHeader& header, const std::string& file) {
  const H5::DSetCreatPropList how = set.getCreatePlist();
  double bytes = header.bits / 8.0;
  for (const std::int64_t n : header.size) bytes *= static_cast<double>(n);
  const auto there = static_cast<double>(set.getStorageSize());
  // 4000 is above the largest compression ratio of any filter
  const double packed = how.getNfilters() > 0 ? 1 / 4000.0 : 1;
  if (how.getLayout() != H5D_VIRTUAL && there < packed * bytes) {
    throw InputError(file, 0, "bytes of the dataset", fmt::format("{:.0f}", there),
                     fmt::format("at least {:.0f} for {} x {} x {} voxels of {} bits{}", std::ceil(packed * bytes),
                                 header.size[0], header.size[1], header.size[2], header.bits,
                                 packed < 1 ? " at the highest compression, 1 to 4000" : ""));
  }
  if (how.getLayout() == H5D_VIRTUAL || how.getExternalCount() > 0)
    throw InputError(file, 0, "dataset", "one whose voxels are in other files", "voxels in this file");
}

/// A dataset of an open HDF5 file.
class Hdf5Slices : public ImageSlices {
 public:
  Hdf5Slices(const fs::path& path, const std::string& dataset) {
    file_ = path.string();
    if (!fs::exists(path)) throw InputError(file_, 0, "image", "no such file", "a file that can be read");
    attempt([&] {
      in_ = H5::H5File(file_, H5F_ACC_RDONLY);
      const std::string name = name_of(in_, dataset, file_);
      set_ = in_.openDataSet(name);
      hsize_t size[3] = {};
      const H5::DataSpace space = set_.getSpace();
      if (space.getSimpleExtentNdims() != 3)
        throw InputError(file_, 0, "dimensions of the dataset " + name, std::to_string(space.getSimpleExtentNdims()),
                         "three: z, y and x");
      space.getSimpleExtentDims(size);
      for (std::size_t a = 0; a < 3; ++a)
        header_.size[a] = static_cast<std::int64_t>(std::min<hsize_t>(size[2 - a], hsize_t{1} << 32));
      type_ = type_of(set_, file_);
      header_.bits = 8 * bytes_of(type_);
      header_.floating = type_ >= VoxelType::f32;
      header_.spacing = spacing_of(set_);
      check_storage(set_, header_, file_);
      keep_chunks(name);
    });
  }
  bool apart() const override { return true; }

 private:
  /// Runs `work` and turns errors of HDF5 into InputError, because they are faults of the file.
  template <class Work>
  void attempt(Work&& work) {
    const QuietHdf5 quiet;
    try {
      work();
    } catch (const H5::Exception& error) {
      throw InputError(file_, 0, "image", "one that HDF5 cannot read (" + error.getDetailMsg() + ")",
                       "a complete HDF5 file");
    }
  }

  /// Gives HDF5 a cache for one layer of chunks. HDF5 decompresses a chunk as a whole; with the cache each chunk is
  /// decompressed once for all its slices.
  void keep_chunks(const std::string& name) {
    const H5::DSetCreatPropList how = set_.getCreatePlist();
    if (how.getLayout() != H5D_CHUNKED) return;
    hsize_t chunk[3] = {};
    if (how.getChunk(3, chunk) != 3) return;
    double bytes = set_.getDataType().getSize(), chunks = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      bytes *= static_cast<double>(chunk[a]);
      if (a > 0) chunks *= std::ceil(static_cast<double>(header_.size[2 - a]) / static_cast<double>(chunk[a]));
    }
    constexpr double most = 1e9;
    if (bytes > most)
      throw InputError(file_, 0, "bytes of a chunk", fmt::format("{:.0f}", bytes), fmt::format("at most {:.0f}", most));
    H5::DSetAccPropList access;
    access.setChunkCache(static_cast<std::size_t>(std::min(10 * chunks, 1e6)) + 521,
                         static_cast<std::size_t>(std::min(bytes * (chunks + 1), most)), 1);
    set_.close();
    set_ = in_.openDataSet(name, access);
  }

  void read_bytes(std::int64_t first, std::int64_t count, char* to) override {
    attempt([&] {
      const auto n = [](std::int64_t value) { return static_cast<hsize_t>(value); };
      const hsize_t size[3] = {n(count), n(header_.size[1]), n(header_.size[0])}, from[3] = {n(first), 0, 0};
      const H5::DataSpace memory(3, size), space = set_.getSpace();
      space.selectHyperslab(H5S_SELECT_SET, size, from);
      set_.read(to, native(type_), memory, space);
    });
  }

  H5::H5File in_;
  H5::DataSet set_;
};

}  // namespace

std::unique_ptr<ImageSlices> open_hdf5(const fs::path& path, const std::string& dataset) {
  return std::make_unique<Hdf5Slices>(path, dataset);
}

}  // namespace macadam::ct
