// SPDX-License-Identifier: GPL-3.0-or-later
// Tests image files of computed tomography: written images are read back unchanged, and faulty files are refused with a
// reason.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/tools/ct/images/image_slices.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"
#include "tests/tools/ct/ct_folder.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

class CtImage : public CtFolder {
 protected:
  /// Returns the error message of reading a file.
  template <class T>
  std::string fault(const fs::path& file) {
    try {
      read_image<T>(file);
    } catch (const InputError& error) { return error.what(); }
    return "read without error";
  }
  void write(const std::string& name, const std::string& bytes) { std::ofstream(folder_ / name) << bytes; }
};

template <class T>
Image<T> ramp(std::array<std::int64_t, 3> size) {
  Image<T> image(size, {1e-4, 2e-4, 3e-4}, {1e-3, 0, -2e-3});
  for (std::size_t i = 0; i < image.count(); ++i) image.voxels[i] = static_cast<T>((7 * i) % 251);
  return image;
}

template <class T>
void expect_same(const Image<T>& read, const Image<T>& written, bool spacing) {
  EXPECT_EQ(read.size, written.size);
  EXPECT_EQ(read.voxels, written.voxels);
  if (!spacing) return;
  // lengths are stored as decimal text in millimetres
  EXPECT_NEAR(read.spacing.x, written.spacing.x, 1e-12);
  EXPECT_NEAR(read.spacing.y, written.spacing.y, 1e-12);
  EXPECT_NEAR(read.spacing.z, written.spacing.z, 1e-12);
  EXPECT_NEAR(read.origin.x, written.origin.x, 1e-12);
  EXPECT_NEAR(read.origin.z, written.origin.z, 1e-12);
}

template <class T>
void round_trip(const fs::path& folder) {
  const Image<T> image = ramp<T>({5, 4, 3});
  for (const std::string name : {"image.mha", "image.mhd", "image.nrrd"}) {
    write_image(folder / name, image);
    expect_same(read_image<T>(folder / name), image, true);
  }
}

TEST_F(CtImage, FilesOfEveryTypeAreReadAsTheyWereWritten) {
  round_trip<std::uint8_t>(folder_);
  round_trip<std::uint16_t>(folder_);
  round_trip<std::uint32_t>(folder_);
  round_trip<float>(folder_);
}

/// Single slices of a compressed file equal the slices of the whole image.
TEST_F(CtImage, SomeSlicesOfAPackedFileAreThoseOfTheWhole) {
  const auto image = ramp<std::uint16_t>({6, 5, 9});
  for (const std::string name : {"packed.mha", "packed.nrrd"}) {
    write_image(folder_ / name, image, true);
    const std::unique_ptr<ct::ImageSlices> file = ct::open_image(folder_ / name, {});
    EXPECT_FALSE(file->apart()) << name;
    for (const auto& [first, count] : {std::pair{3, 4}, {0, 1}, {7, 2}}) {
      std::vector<std::uint16_t> slices(static_cast<std::size_t>(30 * count));
      file->read(first, count, slices.data());
      EXPECT_TRUE(std::equal(slices.begin(), slices.end(), image.voxels.begin() + 30 * first)) << name << " " << first;
    }
  }
}

TEST_F(CtImage, PagesOfATiffAndFilesOfAFolderAreSlicesInTheOrderOfTheirNumbers) {
  const auto image = ramp<std::uint16_t>({6, 5, 12});
  write_image(folder_ / "pages.tif", image);
  expect_same(read_image<std::uint16_t>(folder_ / "pages.tif"), image, false);
  EXPECT_EQ(read_image_header(folder_ / "pages.tif").spacing.x, 0) << "a TIFF says nothing of voxels";
  fs::create_directories(folder_ / "slices");
  for (std::int64_t k = 0; k < 12; ++k) {
    Image<std::uint16_t> slice({6, 5, 1}, image.spacing);
    std::copy_n(image.voxels.begin() + 30 * k, 30, slice.voxels.begin());
    write_image(folder_ / "slices" / ("s" + std::to_string(k) + ".tif"), slice);  // s10 must come after s9
  }
  expect_same(read_image<std::uint16_t>(folder_ / "slices"), image, false);
  write_image(folder_ / "slices" / "s5.tif", Image<std::uint16_t>({6, 4, 1}, image.spacing));
  EXPECT_NE(fault<std::uint16_t>(folder_ / "slices").find("s5.tif"), std::string::npos);
}

/// The numbers in the file names determine the order of slices: 9 comes before 10, although the text sorts the other
/// way.
TEST_F(CtImage, WhatIsBehindANumberDoesNotMatterToTheOrderOfSlices) {
  const auto image = ramp<std::uint16_t>({6, 5, 3});
  const std::array<const char*, 3> names{"9 of the core.tif", "10 of the core.tif", "11 of the core.tif"};
  for (std::size_t k = 0; k < 3; ++k) {
    Image<std::uint16_t> slice({6, 5, 1}, image.spacing);
    std::copy_n(image.voxels.begin() + 30 * static_cast<std::ptrdiff_t>(k), 30, slice.voxels.begin());
    write_image(folder_ / names[k], slice);
  }
  expect_same(read_image<std::uint16_t>(folder_), image, false);
}

/// A gap in the numbers of the slices is refused; a regular spacing, such as every second number, is accepted.
TEST_F(CtImage, AStackWithoutOneOfItsSlicesIsRefused) {
  const Image<std::uint16_t> slice({6, 5, 1}, {1e-4, 1e-4, 1e-4});
  for (const int k : {8, 10, 12, 14}) write_image(folder_ / ("core2_" + std::to_string(k) + ".tif"), slice);
  EXPECT_EQ(read_image<std::uint16_t>(folder_).size[2], 4) << "every second one, all of them";
  fs::remove(folder_ / "core2_12.tif");
  EXPECT_NE(fault<std::uint16_t>(folder_).find("core2_14.tif after core2_10.tif"), std::string::npos);
  write_image(folder_ / "core2_010.tif", slice);
  EXPECT_NE(fault<std::uint16_t>(folder_).find(
                "core2_010.tif and core2_10.tif, which have the same number, expected one file for each number"),
            std::string::npos)
      << fault<std::uint16_t>(folder_);
}

/// Another image among the slices is refused.
TEST_F(CtImage, AStrayImageBesideTheSlicesIsRefused) {
  const Image<std::uint16_t> slice({6, 5, 1}, {1e-4, 1e-4, 1e-4});
  for (int k = 0; k < 12; ++k) write_image(folder_ / ("slice_" + std::to_string(k) + ".tif"), slice);
  EXPECT_EQ(read_image<std::uint16_t>(folder_).size[2], 12);
  for (const std::string stray : {"preview.tif", "preview_12.tif", "a.tif", "Slice_12.tif", "slice_x_12.tif"}) {
    write_image(folder_ / stray, slice);
    EXPECT_NE(fault<std::uint16_t>(folder_).find("slices: found " + stray + " beside 12 files such as slice_"),
              std::string::npos)
        << fault<std::uint16_t>(folder_);
    fs::remove(folder_ / stray);
  }
  // the names of these strays differ from the slices only after the number; one stray has the next number of the
  // sequence
  for (const std::string stray : {"slice_7_preview.tif", "slice_12_preview.tif", "slice_12b.tif"}) {
    write_image(folder_ / stray, slice);
    EXPECT_NE(fault<std::uint16_t>(folder_).find("slices: found " + stray + " beside 12 files such as slice_"),
              std::string::npos)
        << fault<std::uint16_t>(folder_);
    fs::remove(folder_ / stray);
  }
  write_image(folder_ / "slice_12.tif", slice);
  EXPECT_EQ(read_image<std::uint16_t>(folder_).size[2], 13);
}

/// If names contain several numbers, the one that differs between them counts the slices.
TEST_F(CtImage, TheOnlyNumberInWhichNamesDifferCountsTheSlices) {
  const Image<std::uint16_t> slice({6, 5, 1}, {1e-4, 1e-4, 1e-4});
  for (int k = 8; k < 12; ++k) write_image(folder_ / (std::to_string(k) + "_25um.tif"), slice);
  EXPECT_EQ(read_image<std::uint16_t>(folder_).size[2], 4);
  fs::remove(folder_ / "10_25um.tif");
  EXPECT_NE(fault<std::uint16_t>(folder_).find("11_25um.tif after 9_25um.tif"), std::string::npos)
      << fault<std::uint16_t>(folder_);
}

TEST_F(CtImage, WhatIsWrongWithAFileIsSaid) {
  EXPECT_NE(fault<float>(folder_ / "none.mha").find("no such file"), std::string::npos);
  EXPECT_NE(fault<float>(folder_ / "image.jpg").find(".nrrd"), std::string::npos);
  EXPECT_NE(fault<float>(folder_).find("no .tif file"), std::string::npos);
  write("text.mha", "not an image");
  EXPECT_NE(fault<float>(folder_ / "text.mha").find("text.mha"), std::string::npos);
  write("text.tif", "not an image");
  EXPECT_NE(fault<float>(folder_ / "text.tif").find("text.tif"), std::string::npos);
  write_image(folder_ / "whole.mha", ramp<std::uint16_t>({50, 40, 30}), false);
  fs::resize_file(folder_ / "whole.mha", 60000);
  EXPECT_NE(fault<float>(folder_ / "whole.mha").find("whole.mha"), std::string::npos) << "half of the file is missing";
  auto image = ramp<float>({5, 4, 3});
  image.voxels[17] = NAN;
  write_image(folder_ / "nan.mha", image);
  EXPECT_NE(fault<float>(folder_ / "nan.mha").find("voxel 17"), std::string::npos);
  image.voxels[17] = 300;
  write_image(folder_ / "large.mha", image);
  EXPECT_NE(fault<std::uint8_t>(folder_ / "large.mha").find("from 0 to 255"), std::string::npos);
}

// Runs in a child process, because a limit of the address space also counts the memory that the process already has.
TEST_F(CtImage, MemoryIsWhatALimitLeaves) {
  const pid_t child = fork();
  if (child == 0) {
    double pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t limit = static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + rlim_t{100'000'000};
    const rlimit lower{limit, limit};
    const bool set = setrlimit(RLIMIT_AS, &lower) == 0;
    const double left = memory_available();
    _exit(set && left > 9e7 && left < 1.01e8 ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace macadam
