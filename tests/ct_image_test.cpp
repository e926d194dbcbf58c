// SPDX-License-Identifier: GPL-3.0-or-later
// Image files of computed tomography: what is written is read back, and what is wrong with a file is said.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/ct/image_slices.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

class CtImage : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::path(testing::TempDir()) /
                     ("ct_image_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));

  /// What reading a file says of it.
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
  // lengths pass through decimal text of millimetres
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
    write_image(folder_ / "slices" / ("s" + std::to_string(k) + ".tif"), slice);  // s10 after s9
  }
  expect_same(read_image<std::uint16_t>(folder_ / "slices"), image, false);
  write_image(folder_ / "slices" / "s5.tif", Image<std::uint16_t>({6, 4, 1}, image.spacing));
  EXPECT_NE(fault<std::uint16_t>(folder_ / "slices").find("s5.tif"), std::string::npos);
}

TEST_F(CtImage, WhatIsBehindANumberDoesNotMatterToTheOrderOfSlices) {
  const auto image = ramp<std::uint16_t>({6, 5, 3});
  const std::array<const char*, 3> names{"9 of the core.tif", "10 of the core.tif", "11 end.tif"};
  for (std::size_t k = 0; k < 3; ++k) {
    Image<std::uint16_t> slice({6, 5, 1}, image.spacing);
    std::copy_n(image.voxels.begin() + 30 * static_cast<std::ptrdiff_t>(k), 30, slice.voxels.begin());
    write_image(folder_ / names[k], slice);
  }
  expect_same(read_image<std::uint16_t>(folder_), image, false);
}

TEST_F(CtImage, AStackWithoutOneOfItsSlicesIsRefused) {
  const Image<std::uint16_t> slice({6, 5, 1}, {1e-4, 1e-4, 1e-4});
  for (const int k : {8, 10, 12, 14}) write_image(folder_ / ("core2_" + std::to_string(k) + ".tif"), slice);
  EXPECT_EQ(read_image<std::uint16_t>(folder_).size[2], 4) << "every second one, all of them";
  fs::remove(folder_ / "core2_12.tif");
  EXPECT_NE(fault<std::uint16_t>(folder_).find("core2_14.tif after core2_10.tif"), std::string::npos);
  write_image(folder_ / "core2_010.tif", slice);  // the same number twice: they are not numbered evenly
  EXPECT_EQ(read_image<std::uint16_t>(folder_).size[2], 4);
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

// In a process of its own: what a limit of the address space leaves is what the process has not taken of it.
TEST_F(CtImage, MemoryIsWhatALimitLeaves) {
  const pid_t child = fork();
  if (child == 0) {
    constexpr double gigabyte = 1e9;
    double pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t limit =
        static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + rlim_t{1'000'000'000};
    const rlimit lower{limit, limit};
    const bool set = setrlimit(RLIMIT_AS, &lower) == 0;
    const double left = memory_available();
    _exit(set && left > 0.9 * gigabyte && left < 1.01 * gigabyte ? 0 : 1);
  }
  int status = 1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST_F(CtImage, HeadersOnWhichItkWouldNotEndAreRefused) {
  const auto refused = [&](const char* file, std::string bytes, const char* word) {
    write(file, bytes);
    EXPECT_NE(fault<std::uint8_t>(folder_ / file).find(word), std::string::npos) << fault<std::uint8_t>(folder_ / file);
  };
  refused("dimensions.mha", "ObjectType = Image\nNDims = 2147483648\nDimSize = 4 3 2\n",
          ":2: NDims: found \"2147483648\"");
  const auto with_line = [](std::string line) { return "ObjectType = Image\n" + line + "\nDimSize = 4 3 2\n"; };
  for (const char* dimensions : {"3e9", "3 3", "+3", "1", "4", ""})
    refused("dimensions.mha", with_line("NDims = " + std::string(dimensions)),
            (":2: NDims: found \"" + std::string(dimensions) + "\", expected two or three").c_str());
  refused("colon.mha", with_line("NDims: 3e9 = 3"), ":2: NDims: found \"3e9 = 3\"");
  refused("control.mha", with_line("Comment = a\rNDims = 3e9"),
          "found \"Comment = a?NDims = 3e9\", expected text without");
  refused("zero.mha", with_line(std::string("a\0 = b", 6)), ":2: header of a MetaImage: found \"a? = b\"");
  write("lines.mha", "ObjectType = Image\r\n\r\nNDims: 2 \r\nOther = " + std::string(400, 'o') +
                         "\r\nComment = " + std::string(254, 'c') +
                         "\r\nDimSize = 2 1\r\nElementType: MET_UCHAR\r\nElementDataFile = LOCAL\nab");
  EXPECT_EQ(read_image<std::uint8_t>(folder_ / "lines.mha").voxels, (std::vector<std::uint8_t>{'a', 'b'}));
  refused("no_sign.mha", with_line("a line"), ":2: header of a MetaImage: found \"a line\", expected KEY = VALUE");
  refused("key.mha", "ObjectType = Image\n" + std::string(255, 'k') + " = 3\n",
          ":2: header of a MetaImage: found a key of 255 bytes, expected 254 at the most");
  const std::string text(255, 'c');
  for (const char* key : {"Comment", "ObjectType", "ObjectSubType", "Name"})
    refused("value.mha", with_line(key + (" = " + text)), ":2: header of a MetaImage: found a value of 255 bytes");
  refused("next.mha", with_line("Comment =\n\na = " + text), ":4: header of a MetaImage: found a line of 259 bytes");
  for (const char* files : {"", ".", "none.raw", "LIST", "slice%03d.raw 1 2 1"})
    refused("files.mha", with_line("ElementDataFile = " + std::string(files)),
            (":2: ElementDataFile: found \"" + std::string(files) + "\", expected LOCAL or one file").c_str());
  refused("type.mha",
          "ObjectType = Image\nNDims = 2\nDimSize = 1 1\nElementType = MET_OTHER\nElementDataFile = LOCAL\na",
          "type.mha");
  const auto nrrd = [](const std::string& sizes, const std::string& more = "") {
    return "NRRD0004\r\ntype: uchar\r\ndimension: 3\r\nencoding: raw\r\n" + sizes + "\r\n" + more + "\r\nabcdef";
  };
  write("good.nrrd", nrrd("sizes: 3 2 1"));
  EXPECT_EQ(read_image<std::uint8_t>(folder_ / "good.nrrd").voxels.back(), 'f');
  for (const char* sizes : {"1 4294967324 1", "3 2 0", "3 2 1.0", "3 x 1"})  // the first is 28 to ITK
    refused("sizes.nrrd", nrrd("sizes: " + std::string(sizes)),
            (":5: sizes: found \" " + std::string(sizes) + "\", expected whole numbers").c_str());
  refused("pattern.nrrd", nrrd("Sizes: 3 2 1", "data file: %n%d 1 1 1\r\n"),
          ":6: datafile: found \" %n%d 1 1 1\", expected one");
  refused("list.nrrd", nrrd("sizes: 3 2 1", "datafile: LIST\r\n"), ":6: datafile: found \" LIST\", expected one file");
  write_image(folder_ / "whole.tif", Image<std::uint8_t>({4, 3, 1}, {1e-4, 1e-4, 1e-4}));
  std::ifstream in(folder_ / "whole.tif", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto number = [&](std::size_t at, int bytes) {  // little-endian
    std::size_t out = 0;
    for (int k = bytes; k-- > 0;) out = out << 8 | static_cast<unsigned char>(whole[at + static_cast<std::size_t>(k)]);
    return out;
  };
  ASSERT_EQ(whole.substr(0, 2), "II");
  const std::size_t directory = number(4, 4), next = directory + 2 + 12 * number(directory, 2);
  std::string bytes = whole;
  refused("again.tif", bytes.replace(next, 4, whole.substr(4, 4)), "again, expected a chain that ends");
  bytes = whole;
  refused("tag.tif", bytes.replace(directory + 6, 4, "\xff\xff\xff\x7f"), "2147483647 values");
  const auto entry_of = [&](std::size_t tag) {
    std::size_t at = directory + 2;
    while (at < next && number(at, 2) != tag) at += 12;
    return at;
  };
  bytes = whole;
  refused("values.tif", bytes.replace(entry_of(277) + 8, 2, std::string("\3\0", 2)),
          "found 3 values a voxel, expected one");
  bytes = whole;
  refused("bits.tif", bytes.replace(entry_of(258) + 8, 2, std::string("\1\0", 2)),
          "found 1 bits a voxel, expected 8, 16");
  bytes = whole;
  refused("no_bits.tif", bytes.replace(entry_of(258), 2, std::string("\x32\1", 2)),
          "306 of the TIFF file: found type 3");
  bytes = whole;
  refused("other.tif", bytes.replace(entry_of(258), 2, std::string("\0\x60", 2)),
          "without the bits of a voxel (tag 258)");
  bytes = whole;
  refused("outside.tif", bytes.replace(4, 4, "\xff\xff\xff\x7f"), "one at byte 2147483647");
  bytes = whole;
  refused("text.tif", bytes.replace(directory + 2, 12, std::string("\x15\xfa\2\0\1\0\0\0x\0\0\0", 12)),
          "tag 64021 of the TIFF file: found a text without an end");
  bytes = whole;
  refused("date.tif", bytes.replace(directory + 2, 12, std::string("\x32\1\3\0\1\0\0\0\x10\0\0\0", 12)),
          "tag 306 of the TIFF file: found type 3, expected a text, type 2");
}

}  // namespace
}  // namespace macadam
