// SPDX-License-Identifier: GPL-3.0-or-later
// Reads image files with headers for which ITK hangs, aborts or reads wrong data without an error. The program refuses
// such headers, and reads headers that are unusual but valid.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "host/tools/ct/images/image_slices.hpp"
#include "macadam/ct.hpp"
#include "macadam/error.hpp"
#include "tests/tools/ct/ct_folder.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

class CtHeaders : public CtFolder {
 protected:
  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::string voxels(const std::string& name) {
    const auto image = read_image<std::uint8_t>(folder_ / name);
    return {image.voxels.begin(), image.voxels.end()};
  }
  /// Returns the notes for the user, concatenated.
  std::string notes(const std::string& name) {
    std::string all;
    for (const std::string& note : read_image_header(folder_ / name).notes) all += note;
    return all;
  }
  /// Writes the file and expects that reading it is refused with these words.
  void refused(const std::string& name, const std::string& bytes, const std::string& words) {
    write(name, bytes);
    std::string said = "nothing was said";
    try {
      voxels(name);
    } catch (const InputError& error) { said = error.what(); }
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
};

std::string mha(const std::string& line, const std::string& data = "LOCAL") {
  return "ObjectType = Image\n" + line + "\nDimSize = 2 1\nElementType = MET_UCHAR\nElementDataFile = " + data + "\nab";
}

/// Refuses MetaImage headers that ITK misreads, each with its line and key.
TEST_F(CtHeaders, OfAMetaImage) {
  for (const char* dimensions : {"3e9", "3 3", "+3", "1", "4", "", "2147483648"})
    refused("a.mha", mha("NDims = " + std::string(dimensions)),
            ":2: NDims: found \"" + std::string(dimensions) + "\", expected two or three");
  refused("a.mha", mha("NDims: 3e9 = 3"), ":2: NDims: found \"3e9 = 3\"");
  refused("a.mha", mha("Comment = a\rNDims = 3e9"), "found \"Comment = a?NDims = 3e9\", expected text without zero");
  refused("a.mha", mha(std::string("a\0 = b", 6)), ":2: header of a MetaImage: found \"a? = b\"");
  refused("a.mha", mha("a line"), ":2: header of a MetaImage: found \"a line\", expected KEY = VALUE");
  refused("a.mha", mha(std::string(255, 'k') + " = 3"),
          ":2: header of a MetaImage: found a key of 255 bytes, expected at most 254 bytes");
  refused("a.mha", mha("a = " + std::string(65536, 'a')),
          ":2: header of a MetaImage: found a line of 65535 bytes or more");
  const std::string text(255, 'c');
  for (const std::string key : {"Comment", "ObjectType", "ObjectSubType", "Name", "AcquisitionDate"})
    refused("a.mha", mha(key + " = " + text),
            ":2: header of a MetaImage: found " + key + " of 255 bytes, expected at most 254 bytes");
  refused("a.mha", mha("Comment =\n\na = " + text), ":4: header of a MetaImage: found a line of 259 bytes behind");
  refused("a.mha", mha("BinaryData = False"), ":2: BinaryData: found \"False\", expected True");
  for (const std::string& files :
       std::vector<std::string>{"", ".", "none.raw", "LIST", "slice%03d.raw 1 2 1", std::string(300, 'n')})
    refused("a.mha", mha("NDims = 2", files), ":5: ElementDataFile: found \"" + files.substr(0, 60));
  refused("a.mha", "ObjectType = Image\n", "found no line ElementDataFile");
  refused("a.mha", "ObjectType = Image\nNDims = 2\nDimSize = 1 1\nElementType = MET_OTHER\nElementDataFile = LOCAL\na",
          "a.mha");
  for (const std::string size : {"1e18", "-1", ""})
    refused("a.mha", mha("CompressedDataSize = " + size),
            ":2: CompressedDataSize: found \"" + size + "\", expected a whole");
  refused("a.mha", mha("NDims = 2\nCompressedData = True\nCompressedDataSize = 4294967296"),
          "CompressedDataSize: found 4294967296, expected at most the 147 bytes of a.mha");
}

/// Reads MetaImage headers that are unusual but valid.
TEST_F(CtHeaders, OfAMetaImageThatAreUnusualAndGood) {
  const std::string more = "Other = " + std::string(400, 'o') + "\r\nComment = " + std::string(254, 'c') +
                           "\r\n0008|0090 =\r\nLong = " + std::string(300, 'l') + "\r\nName = \xc3\xa4\x1b";
  write("lines.mha", "ObjectType = Image\r\n\r\nNDims: 2 \r\nBinaryData = True\r\n" + more +
                         "\r\nDimSize = 2 1\r\nElementType: MET_UCHAR\r\nElementDataFile = LOCAL\nab");
  EXPECT_EQ(voxels("lines.mha"), "ab");
  write("beside.raw", "cd");
  write("beside.mhd", mha("NDims = 2", "beside.raw"));
  EXPECT_EQ(voxels("beside.mhd"), "cd");
  write(
      "large.mhd",
      "ObjectType = Image\nNDims = 3\nDimSize = 900 900 900\nElementType = MET_UCHAR\nElementDataFile = beside.raw\n");
  refused(
      "large.mhd",
      "ObjectType = Image\nNDims = 3\nDimSize = 900 900 900\nElementType = MET_UCHAR\nElementDataFile = beside.raw\n",
      "900 x 900 x 900 of 8 bits, expected no more voxels than the 2 bytes of the file can hold");
}

std::string nrrd(const std::string& sizes, const std::string& more = "") {
  return "NRRD0004\r\ntype: uchar\r\ndimension: 3\r\nencoding: raw\r\n" + sizes + "\r\n" + more + "\r\nabcdef";
}

/// Refuses NRRD headers that ITK misreads, each with its line.
TEST_F(CtHeaders, OfAnNrrd) {
  for (const std::string sizes : {"1 4294967324 1", "3 2 0", "3 2 1.0", "3 x 1"})  // ITK reads the first size as 28
    refused("a.nrrd", nrrd("sizes: " + sizes), ":5: sizes: found \"" + sizes + "\", expected whole numbers");
  refused("a.nrrd", nrrd("content: x\rsizes: 1 4294967324 1"), ":5: header of an NRRD file: found \"content: x?sizes");
  refused("a.nrrd", nrrd(std::string("\0content: x", 11)), ":5: header of an NRRD file: found \"?content");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const std::string data : {"%n%d 1 1 1", "x%03d.raw 1 3 1", "LIST", "-", "pipe", "/dev/zero", "none.raw"})
    for (const std::string field : {"data file", "datafile", "Data File"})
      refused("a.nhdr", nrrd("sizes: 3 2 1", field + ": " + data + "\r\n"),
              ":6: " + field + ": found \"" + data + "\", expected one existing file");
  refused("a.nrrd", nrrd("sizes: 3 2 1", "byte skip: -1\r\nencoding: gzip\r\n"), "byte skip: found a negative value");
}

/// Reads NRRD headers that are unusual but valid.
TEST_F(CtHeaders, OfAnNrrdThatAreUnusualAndGood) {
  write("a.nrrd", nrrd("sizes: 3 2 1", "# sizes: x\r\nsizes:=many\r\ndata file:=LIST\r\nbyte skip: -1\r\n"));
  EXPECT_EQ(voxels("a.nrrd"), "abcdef");
  write("core 50% of MINERALIST.raw", "ghijkl");
  write("a.nhdr", nrrd("sizes: 3 2 1", "data file: core 50% of MINERALIST.raw\r\n"));
  EXPECT_EQ(voxels("a.nhdr"), "ghijkl");
}

// The length in metres of 250 in each unit; an empty text is a file without a unit.
constexpr std::pair<const char*, double> lengths[] = {{"um", 250e-6},
                                                      {"microns", 250e-6},
                                                      {"Micrometers", 250e-6},
                                                      {"micrometre", 250e-6},
                                                      {"\u00b5m", 250e-6},
                                                      {"\xb5m", 250e-6},
                                                      {"mm", 0.25},
                                                      {"millimetres", 0.25},
                                                      {"cm", 2.5},
                                                      {"", 0.25}};

TEST_F(CtHeaders, LengthsOfAnNrrdAreInItsUnits) {
  const std::string space =
      "space: left-posterior-superior\r\nspace directions: (250,0,0) (0,250,0) (0,0,250)\r\nspace origin: "
      "(10,20,30)\r\n";
  for (const auto& [unit, length] : lengths) {
    const std::string list = std::string(" \"") + unit + "\" \"" + unit + "\" \"" + unit + "\"\r\n";
    write("space.nrrd", nrrd("sizes: 3 2 1", space + "space units:" + list));
    write("plain.nrrd", nrrd("sizes: 3 2 1", "spacings: 250 250 250\r\nunits:" + list));
    const ImageHeader header = read_image_header(folder_ / "space.nrrd");
    EXPECT_NEAR(header.spacing.x / length, 1, 1e-12) << unit;
    EXPECT_NEAR(header.spacing.z / length, 1, 1e-12) << unit;
    EXPECT_NEAR(header.origin.y / length, 20.0 / 250, 1e-12) << unit;
    EXPECT_NEAR(read_image_header(folder_ / "plain.nrrd").spacing.y / length, 1, 1e-12) << unit;
    EXPECT_EQ(notes("space.nrrd"), "");
  }
  for (const std::string list : {"\"furlong\" \"furlong\" \"furlong\"", "\"mm\" \"mm\" \"um\""}) {
    write("other.nrrd", nrrd("sizes: 3 2 1", space + "space units: " + list + "\r\n"));
    EXPECT_EQ(read_image_header(folder_ / "other.nrrd").spacing.x, 0) << list;
    EXPECT_NE(notes("other.nrrd").find("which is not a known unit, so these lengths are not used"), std::string::npos)
        << list;
  }
}

TEST_F(CtHeaders, LengthsOfAMetaImageAreInItsUnits) {
  const auto with = [](const std::string& more) {
    return "ObjectType = Image\nNDims = 3\n" + more +
           "ElementSpacing = 250 250 250\nDimSize = 2 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nab";
  };
  for (const auto& [unit, length] : {std::pair{"um", 250e-6}, {"mm", 0.25}, {"cm", 2.5}, {"?", 0.25}}) {
    write("a.mha", with("DistanceUnits = " + std::string(unit) + "\n"));
    EXPECT_NEAR(read_image_header(folder_ / "a.mha").spacing.x / length, 1, 1e-12) << unit;
  }
  write("a.mha", with(""));
  EXPECT_NEAR(read_image_header(folder_ / "a.mha").spacing.x, 0.25, 1e-12);
}

TEST_F(CtHeaders, AxesThatAreTurnedOrMirroredAreNoted) {
  const auto with = [](const std::string& matrix) {
    return "ObjectType = Image\nNDims = 3\nTransformMatrix = " + matrix +
           "\nDimSize = 2 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nab";
  };
  write("a.mha", with("1 0 0 0 1 0 0 0 1"));
  EXPECT_EQ(notes("a.mha"), "");
  write("a.mha", with("-1 0 0 0 1 0 0 0 1"));
  EXPECT_NE(notes("a.mha").find("direction matrix (-1 0 0, 0 1 0, 0 0 1) is not applied"), std::string::npos)
      << notes("a.mha");
  EXPECT_NE(notes("a.mha").find("mirror images of those that were scanned"), std::string::npos) << notes("a.mha");
  EXPECT_EQ(voxels("a.mha"), "ab");
  write("a.mha", with("-1 0 0 0 -1 0 0 0 1"));
  EXPECT_NE(notes("a.mha").find("rotated relative to those that were scanned"), std::string::npos) << notes("a.mha");
  const std::string directions = "space directions: (0,1,0) (1,0,0) (0,0,1)\r\n";
  write("a.nrrd", nrrd("sizes: 3 2 1", "space: left-posterior-superior\r\n" + directions));
  EXPECT_NE(notes("a.nrrd").find("(0 1 0, 1 0 0, 0 0 1) is not applied"), std::string::npos) << notes("a.nrrd");
  EXPECT_NE(notes("a.nrrd").find("mirror images"), std::string::npos) << notes("a.nrrd");
}

/// An entry of a TIFF directory: type, number of values, and the value or its position.
using Entry = std::array<std::uint32_t, 3>;
using Page = std::map<std::uint32_t, std::optional<Entry>>;  // entries by tag; std::nullopt removes the entry

/// Returns a little-endian TIFF whose pages have 3 × 2 voxels with the bytes abcdef. Each page is changed by the
/// entries of `pages`.
std::string tiff(const std::vector<Page>& pages, std::uint32_t last = 0) {
  std::string out;
  const auto add = [&](std::uint32_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) out += static_cast<char>(value >> 8 * k & 0xff);
  };
  out = std::string("II*\0", 4);
  add(32, 4);
  out += "abcdefabcdefabcdefabcdef";
  for (std::size_t n = 0; n < pages.size(); ++n) {
    Page all{{256, Entry{3, 1, 3}}, {257, Entry{3, 1, 2}}, {258, Entry{3, 1, 8}}, {259, Entry{3, 1, 1}},
             {262, Entry{3, 1, 1}}, {273, Entry{4, 1, 8}}, {277, Entry{3, 1, 1}}, {278, Entry{3, 1, 2}},
             {279, Entry{4, 1, 6}}, {339, Entry{3, 1, 1}}};
    for (const auto& [tag, entry] : pages[n]) all[tag] = entry;
    std::erase_if(all, [](const auto& one) { return !one.second; });
    add(static_cast<std::uint32_t>(all.size()), 2);
    for (const auto& [tag, entry] : all) {
      add(tag, 2), add((*entry)[0], 2), add((*entry)[1], 4);
      add((*entry)[2], 4);
    }
    const bool ends = n + 1 == pages.size();
    add(ends ? last : static_cast<std::uint32_t>(out.size() + 4), 4);
  }
  return out;
}

/// Refuses TIFF directories that ITK misreads, each with its tag.
TEST_F(CtHeaders, OfATiff) {
  const auto refused_page = [&](const Page& page, const std::string& words) { refused("a.tif", tiff({page}), words); };
  refused_page({{277, Entry{3, 1, 3}}}, "tag 277 of the TIFF file: found 3 values per voxel, expected one grey");
  refused_page({{258, Entry{3, 3, 8}}, {277, Entry{3, 1, 3}}},
               "tag 258 of the TIFF file: found bits for 3 values per voxel");
  refused_page({{258, {}}}, "tag 258 of the TIFF file: found no bits of a voxel, expected 8 or 16");
  for (const auto& [bits, format] :
       {std::pair{1u, 1u}, {12u, 1u}, {32u, 1u}, {32u, 2u}, {64u, 1u}, {64u, 3u}, {16u, 3u}})
    refused_page({{258, Entry{3, 1, bits}}, {339, Entry{3, 1, format}}},
                 "found " + std::to_string(bits) + " bits per voxel, of format " + std::to_string(format));
  refused_page({{339, {}}, {258, Entry{3, 1, 32}}}, "found 32 bits per voxel, of format 1");
  refused_page({{257, Entry{5, 1, 8}}},
               "tag 257 of the TIFF file: found 1 values of type 5, expected one whole number");
  refused_page({{336, Entry{3, 2, 5}}}, "tag 336 of the TIFF file: found a range of dots");
  refused_page({{280, Entry{3, 0x7fffffff, 8}}}, "found 2147483647 values of 2 bytes, expected as many as");
  refused_page({{64021, Entry{2, 1, 'x'}}}, "tag 64021 of the TIFF file: found a text without an end");
  refused_page({{262, Entry{3, 1, 2}}}, "tag 262 of the TIFF file: found PhotometricInterpretation 2, expected grey");
  refused_page({{262, Entry{3, 1, 0}}, {258, Entry{3, 1, 32}}, {339, Entry{3, 1, 3}}},
               "tag 262 of the TIFF file: found PhotometricInterpretation 0 (white is 0) of floats");
  for (const std::uint32_t tag : {322u, 323u, 324u, 325u})
    refused_page({{tag, Entry{3, 1, 16}}},
                 "tag " + std::to_string(tag) + " of the TIFF file: found tiles, expected rows of voxels");
  refused_page({{306, Entry{3, 1, 16}}}, "tag 306 of the TIFF file: found type 3, expected a text, type 2");
  refused("a.tif", tiff({{}}, 32), "found a second reference to the directory at byte 32");
  refused("a.tif", tiff({{}}, 0x7fffffff), "one at byte 2147483647");
}

TEST_F(CtHeaders, OfATiffWhoseTextEndsTheFile) {
  const auto with_text_at = [](std::uint32_t at) { return tiff({Page{{64021, Entry{2, 6, at}}}}); };
  const auto end = static_cast<std::uint32_t>(with_text_at(0).size());
  const std::string whole = with_text_at(end) + std::string("words\0", 6);
  write("a.tif", whole);
  EXPECT_EQ(voxels("a.tif"), "abcdef");
  refused("a.tif", whole.substr(0, whole.size() - 1), "tag 64021 of the TIFF file: found a text without an end");
}

TEST_F(CtHeaders, GreyValuesOfATiffWhoseWhiteIsZeroAreInverted) {
  const Page inverted{{262, Entry{3, 1, 0}}};
  write("a.tif", tiff({inverted, inverted}));
  EXPECT_EQ(voxels("a.tif"), "\x9e\x9d\x9c\x9b\x9a\x99\x9e\x9d\x9c\x9b\x9a\x99");  // 255 minus the bytes a, b, …
  EXPECT_NE(notes("a.tif").find("0 is white (PhotometricInterpretation 0), so the grey values were inverted"),
            std::string::npos);
  write("16.tif", tiff({{{262, Entry{3, 1, 0}}, {258, Entry{3, 1, 16}}, {279, Entry{4, 1, 12}}}}));
  const auto image = read_image<std::uint16_t>(folder_ / "16.tif");
  EXPECT_EQ(image.voxels.front(), 65535 - ('a' + 256 * 'b'));
  EXPECT_EQ(image.voxels.back(), 65535 - ('e' + 256 * 'f'));
  write("right.tif", tiff({{}}));
  EXPECT_EQ(notes("right.tif"), "");
  fs::create_directories(folder_ / "slices");
  for (const char* name : {"slices/s0.tif", "slices/s1.tif"}) write(name, tiff({inverted}));
  EXPECT_EQ(voxels("slices").substr(0, 6), "\x9e\x9d\x9c\x9b\x9a\x99");
  EXPECT_NE(notes("slices").find("inverted"), std::string::npos);
  refused("slices/s1.tif", tiff({{}}), "nothing was said");
  try {
    voxels("slices");
    FAIL() << "a folder of both kinds was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("s1.tif: PhotometricInterpretation (tag 262): found 1 (black is 0)"),
              std::string::npos)
        << error.what();
  }
}

/// Returns a TIFF of one directory with ImageJ's description, followed by the bytes `behind`.
std::string imagej(const std::string& lines, const Page& more, const std::string& behind) {
  const std::string text = "ImageJ=1.54f\n" + lines + '\0';
  Page page = more;
  page[270] = Entry{2, static_cast<std::uint32_t>(text.size()), 0};
  const auto end = static_cast<std::uint32_t>(tiff({page}).size());
  (*page[270])[2] = end;
  if (!page.contains(273)) page[273] = Entry{4, 1, end + static_cast<std::uint32_t>(text.size())};
  return tiff({page}) + text + behind;
}

/// ImageJ writes a stack with one directory and states the number of slices in the description; all slices are read.
TEST_F(CtHeaders, AStackOfImageJWithOneDirectoryHasAllItsSlices) {
  const std::string bytes = "0123456789abcdefgh";
  write("a.tif", imagej("images=3\nslices=3\n", {}, bytes));
  EXPECT_EQ(voxels("a.tif"), bytes);
  const std::unique_ptr<ct::ImageSlices> slices = ct::open_image(folder_ / "a.tif", {});
  EXPECT_TRUE(slices->apart());
  std::string some(6, ' ');
  slices->read(2, 1, reinterpret_cast<std::uint8_t*>(some.data()));
  EXPECT_EQ(some, "cdefgh");
  write("b.tif", imagej("images=3\n", {{262, Entry{3, 1, 0}}}, bytes));
  EXPECT_EQ(voxels("b.tif").front(), static_cast<char>(255 - '0'));
  EXPECT_NE(notes("b.tif").find("inverted"), std::string::npos);
  const std::string found = "slices: found 1 slice, although the description of the file says 3, expected ";
  refused("c.tif", imagej("images=3\n", {}, bytes.substr(1)), found + "a file of");
  refused("c.tif", imagej("images=3\n", {{259, Entry{3, 1, 5}}}, bytes), found + "a directory for each slice");
  refused("c.tif", imagej("images=3\n", {{273, Entry{4, 2, 8}}}, bytes), found + "a directory for each slice");
  refused("c.tif", imagej("images=6\nchannels=2\n", {}, bytes + bytes), "found channels=2, expected one grey value");
  refused("c.tif", imagej("images=6\nframes=2\n", {}, bytes + bytes), "found frames=2, expected one grey value");
  refused("c.tif", imagej("images=9223372036854775807\n", {}, bytes),
          "the description of the file says 9223372036854775807");
  write("d.tif", imagej("images=1\n", {}, bytes));
  EXPECT_EQ(voxels("d.tif"), "012345");
  write("e.tif", tiff({{}, {}}));
  EXPECT_EQ(voxels("e.tif").size(), 12u);
}

TEST_F(CtHeaders, OfATiffWithPages) {
  write("a.tif", tiff({{}, {}}));
  EXPECT_EQ(voxels("a.tif"), "abcdefabcdef");
  // Photo editors add a colour profile and the camera's data; both are ignored.
  write("saved.tif", tiff({{{34675, Entry{7, 12, 8}}, {34665, Entry{4, 1, 8}}}}));
  EXPECT_EQ(voxels("saved.tif"), "abcdef");
  write("undefined.tif", tiff({{{339, Entry{3, 1, 4}}}}));
  EXPECT_EQ(voxels("undefined.tif"), "abcdef");
  const auto kind = [](std::uint32_t of) { return Page{{254, Entry{4, 1, of}}}; };
  write("pages.tif", tiff({kind(2), kind(2), kind(2)}));
  EXPECT_EQ(voxels("pages.tif"), "abcdefabcdefabcdef");
  refused("a.tif", tiff({kind(0), {}, {}}),
          "tag 254 of the TIFF file: found none in page 2, expected 0, as in the first");
  refused("a.tif", tiff({{}, kind(1), {}}), "tag 254 of the TIFF file: found 1 in page 2, expected none");
  refused("a.tif", tiff({kind(5), kind(5)}), "tag 254 of the TIFF file: found a reduced image or a mask in page 2");
  refused("a.tif", tiff({{}, {{256, Entry{3, 1, 2}}}}), "tag 256 of the TIFF file: found 2 in page 2, expected 3");
  refused("a.tif", tiff({{}, {}, {{257, Entry{3, 1, 1}}}}), "tag 257 of the TIFF file: found 1 in page 3, expected 2");
  refused("a.tif", tiff({{{258, Entry{3, 1, 16}}}, {}}), "tag 258 of the TIFF file: found 8 in page 2, expected 16");
  refused("a.tif", tiff({{}, {{339, Entry{3, 1, 2}}}}), "tag 339 of the TIFF file: found 2 in page 2, expected 1");
  refused("a.tif", tiff({{}, {{262, Entry{3, 1, 0}}}}), "tag 262 of the TIFF file: found 0 in page 2, expected 1");
}

}  // namespace
}  // namespace macadam
