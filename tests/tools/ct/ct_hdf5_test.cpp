// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scans in HDF5 files: choice of the dataset, its axes and voxel sizes, and files that are not HDF5 or hold less
// data than they state.
#include <H5Cpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "macadam/ct.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

class CtHdf5 : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    H5::Exception::dontPrint();
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::path(testing::TempDir()) /
                     ("ct_hdf5_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));

  std::string fault(const fs::path& file, const std::string& dataset = {}) {
    try {
      read_image<std::uint16_t>(file, dataset);
    } catch (const InputError& error) { return error.what(); }
    return "read without error";
  }

  /// Writes a dataset of dimensions z, y, x to a file; `how` sets the storage (chunks, compression).
  template <class T>
  H5::DataSet write(H5::H5File& file, const std::string& name, std::vector<hsize_t> size, const std::vector<T>& voxels,
                    const H5::PredType& type, const H5::DSetCreatPropList& how = H5::DSetCreatPropList::DEFAULT) {
    const H5::DataSet set =
        file.createDataSet(name, type, H5::DataSpace(static_cast<int>(size.size()), size.data()), how);
    if (!voxels.empty()) set.write(voxels.data(), type);
    return set;
  }
  H5::H5File make(const std::string& name) { return {(folder_ / name).string(), H5F_ACC_TRUNC}; }
};

std::vector<std::uint16_t> ramp(std::size_t count) {
  std::vector<std::uint16_t> voxels(count);
  for (std::size_t i = 0; i < count; ++i) voxels[i] = static_cast<std::uint16_t>(7 * i % 65521);
  return voxels;
}

TEST_F(CtHdf5, TheLastAxisIsXAndRunsFastest) {
  const std::vector<std::uint16_t> voxels = ramp(3 * 4 * 5);
  {
    H5::H5File file = make("scan.h5");
    const H5::DataSet set = write(file, "exchange", {3, 4, 5}, voxels, H5::PredType::NATIVE_UINT16);
    const hsize_t three = 3;
    const double edges[3] = {30, 20, 10};  // voxel sizes along z, y, x
    set.createAttribute("element_size_um", H5::PredType::IEEE_F64LE, H5::DataSpace(1, &three))
        .write(H5::PredType::NATIVE_DOUBLE, edges);
    // this dataset is not a volume, so it is not a candidate
    write(file, "angles", {7}, std::vector<float>(7), H5::PredType::NATIVE_FLOAT);
  }
  const auto image = read_image<std::uint16_t>(folder_ / "scan.h5");
  EXPECT_EQ(image.size, (std::array<std::int64_t, 3>{5, 4, 3}));
  EXPECT_EQ(image.voxels, voxels);
  EXPECT_EQ(image.at(1, 0, 0), voxels[1]);
  EXPECT_EQ(image.at(0, 0, 1), voxels[20]);
  EXPECT_NEAR(image.spacing.x, 10e-6, 1e-15);
  EXPECT_NEAR(image.spacing.z, 30e-6, 1e-15);
}

TEST_F(CtHdf5, EveryTypeAndChunksThatArePackedAreRead) {
  const std::vector<std::uint16_t> voxels = ramp(40 * 30 * 20);
  H5::DSetCreatPropList packed;
  const hsize_t chunk[3] = {7, 11, 13};
  packed.setChunk(3, chunk);
  packed.setDeflate(4);
  {
    H5::H5File file = make("scan.hdf5");
    file.createGroup("entry").createGroup("data");
    write(file, "entry/data/grey", {40, 30, 20}, voxels, H5::PredType::STD_U16BE, packed);
    write(file, "small", {2, 2, 2}, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8.5}, H5::PredType::NATIVE_DOUBLE);
    write(file, "low", {1, 1, 2}, std::vector<std::int8_t>{3, -1}, H5::PredType::NATIVE_INT8);
    write(file, "nan", {1, 1, 2}, std::vector<float>{3, NAN}, H5::PredType::NATIVE_FLOAT);
  }
  const fs::path scan = folder_ / "scan.hdf5";
  // The type is big-endian but the bytes were written little-endian, so the two bytes of every voxel are swapped.
  const auto image = read_image<float>(scan, "entry/data/grey");
  ASSERT_EQ(image.count(), voxels.size());
  for (const std::size_t i : {0ul, 1ul, 12345ul, voxels.size() - 1})
    EXPECT_EQ(image.voxels[i], static_cast<float>(static_cast<std::uint16_t>(voxels[i] << 8 | voxels[i] >> 8)));
  EXPECT_EQ(read_image<float>(scan, "small").voxels.back(), 8.5f);
  EXPECT_EQ(read_image<float>(scan, "low").voxels.back(), -1);
  EXPECT_NE(fault(scan).find("entry/data/grey"), std::string::npos) << "which of them was meant";
  EXPECT_NE(fault(scan).find("--dataset"), std::string::npos);
  EXPECT_NE(fault(scan, "gray").find("one of"), std::string::npos);
  EXPECT_NE(fault(scan, "small").find("voxel 7"), std::string::npos);
  EXPECT_NE(fault(scan, "low").find("voxel 1"), std::string::npos);
  EXPECT_NE(fault(scan, "nan").find("voxel 1"), std::string::npos);
}

/// A dataset may state more voxels than the file holds; this is refused.
TEST_F(CtHdf5, CountsThatTheFileDoesNotHoldAreRefused) {
  H5::DSetCreatPropList chunks;
  const hsize_t chunk[3] = {16, 16, 16};
  chunks.setChunk(3, chunk);
  chunks.setDeflate(4);
  {
    H5::H5File file = make("forged.h5");
    write(file, "far", {1 << 20, 1 << 20, 1 << 20}, std::vector<std::uint16_t>{}, H5::PredType::NATIVE_UINT16, chunks);
    write(file, "unwritten", {9, 9, 9}, std::vector<std::uint16_t>{}, H5::PredType::NATIVE_UINT16);
    write(file, "flat", {9, 9}, ramp(81), H5::PredType::NATIVE_UINT16);
    write(file, "empty", {0, 9, 9}, std::vector<std::uint16_t>{}, H5::PredType::NATIVE_UINT16);
  }
  EXPECT_NE(fault(folder_ / "forged.h5", "far").find("1048576 x 1048576 x 1048576"), std::string::npos);
  EXPECT_NE(fault(folder_ / "forged.h5", "unwritten").find("bytes of the dataset"), std::string::npos);
  EXPECT_NE(fault(folder_ / "forged.h5", "flat").find("three"), std::string::npos);
  EXPECT_NE(fault(folder_ / "forged.h5", "empty").find("voxels"), std::string::npos);
}

TEST_F(CtHdf5, WhatIsNoSuchFileIsRefused) {
  EXPECT_NE(fault(folder_ / "none.h5").find("no such file"), std::string::npos);
  std::ofstream(folder_ / "text.h5") << "not an image";
  EXPECT_NE(fault(folder_ / "text.h5").find("text.h5"), std::string::npos);
  {
    H5::H5File file = make("half.h5");
    write(file, "scan", {30, 30, 30}, ramp(27000), H5::PredType::NATIVE_UINT16);
    H5::H5File other = make("bare.h5");
    write(other, "flat", {9, 9}, ramp(81), H5::PredType::NATIVE_UINT16);
  }
  fs::resize_file(folder_ / "half.h5", 20000);
  EXPECT_NE(fault(folder_ / "half.h5").find("half.h5"), std::string::npos);
  EXPECT_NE(fault(folder_ / "bare.h5").find("three dimensions"), std::string::npos);
  write_image(folder_ / "scan.mha", Image<std::uint16_t>({2, 2, 2}, {1e-4, 1e-4, 1e-4}));
  EXPECT_NE(fault(folder_ / "scan.mha", "grey").find("not HDF5"), std::string::npos);
}

/// A header that states more voxels than the file can hold is refused before memory is allocated.
TEST_F(CtHdf5, HeadersThatCountWhatNoFileHoldsAreRefusedBeforeMemoryIsAskedFor) {
  const std::string header =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nElementSpacing = 1 1 1\nDimSize = 60000 60000 2000\n"
      "ElementType = MET_USHORT\nElementDataFile = ";
  std::ofstream(folder_ / "forged.mha") << header << "LOCAL\nabcd";
  EXPECT_NE(fault(folder_ / "forged.mha").find("60000 x 60000 x 2000"), std::string::npos);
  std::ofstream(folder_ / "beside.mhd") << header << "beside.raw\n";
  std::ofstream(folder_ / "beside.raw") << "abcd";
  EXPECT_NE(fault(folder_ / "beside.mhd").find("60000 x 60000 x 2000"), std::string::npos);
}

}  // namespace
}  // namespace macadam
