// SPDX-License-Identifier: GPL-3.0-or-later
// surface_ply_test.cpp  Reads PLY files: every number type, as text and in both byte orders, and headers that announce
// data that are missing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

constexpr const char* formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

struct TypeCase {
  const char* name;
  int bytes;  ///< bytes of an integer, negative if it is signed; 0 for float, 1000 for double
};
constexpr TypeCase types[] = {{"char", -1},  {"int8", -1},   {"uchar", 1},     {"uint8", 1},
                              {"short", -2}, {"int16", -2},  {"ushort", 2},    {"uint16", 2},
                              {"int", -4},   {"int32", -4},  {"uint", 4},      {"uint32", 4},
                              {"float", 0},  {"float32", 0}, {"double", 1000}, {"float64", 1000}};

TypeCase type_of(const std::string& name) {
  return *std::find_if(std::begin(types), std::end(types), [&](const TypeCase& t) { return t.name == name; });
}

/// Builds a PLY file from numbers of any type; as text it has one line per item.
class PlyText {
 public:
  explicit PlyText(std::string format) : format_(std::move(format)) {
    bytes_ = "ply\nformat " + format_ + " 1.0\ncomment made by hand\nobj_info none\n";
  }
  PlyText& line(const std::string& header) { return bytes_ += header + "\n", *this; }
  PlyText& number(const std::string& type, double value) {
    if (format_ == "ascii") return bytes_ += fmt::format("{} ", value), *this;
    switch (type_of(type).bytes) {
      case -1:
        return raw(static_cast<std::int8_t>(value));
      case 1:
        return raw(static_cast<std::uint8_t>(value));
      case -2:
        return raw(static_cast<std::int16_t>(value));
      case 2:
        return raw(static_cast<std::uint16_t>(value));
      case -4:
        return raw(static_cast<std::int32_t>(value));
      case 4:
        return raw(static_cast<std::uint32_t>(value));
      case 0:
        return raw(static_cast<float>(value));
      default:
        return raw(value);
    }
  }
  PlyText& end_item() { return bytes_ += format_ == "ascii" ? "\n" : "", *this; }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  PlyText& raw(T value) {
    std::array<char, sizeof(T)> b;
    std::memcpy(b.data(), &value, sizeof value);
    if ((format_ == "binary_big_endian") == (std::endian::native == std::endian::little))
      std::reverse(b.begin(), b.end());
    bytes_.append(b.data(), b.size());
    return *this;
  }
  std::string format_, bytes_;
};

/// Returns a tetrahedron whose coordinates fit into every type, with the given types and optionally other legal
/// elements.
std::string tetrahedron_ply(const std::string& format, const std::string& x, const std::string& z,
                            const std::string& count, const std::string& index, bool extras) {
  PlyText ply(format);
  if (extras) ply.line("element camera 1").line("property list uchar float view").line("property int16 zoom");
  ply.line("element vertex 4").line("property " + x + " x");
  if (extras) ply.line("property float confidence");
  ply.line("property " + x + " y").line("property " + z + " z");
  if (extras) ply.line("element empty 99999999999999").line("element edge 1").line("property int vertex1");
  ply.line("element face 4");
  if (extras) ply.line("property uchar red").line("property list ushort double texcoord");
  ply.line("property list " + count + " " + index + " vertex_index").line("end_header");
  if (extras) ply.number("uchar", 2).number("float", 1.5).number("float", 2.5).number("int16", -7).end_item();
  for (const auto& p : {std::array{100, 100, 100}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}}) {
    ply.number(x, p[0]);
    if (extras) ply.number("float", 0.25);
    ply.number(x, p[1]).number(z, p[2]).end_item();
  }
  if (extras) ply.number("int", 3).end_item();
  for (const auto& f : {std::array{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}) {
    if (extras) ply.number("uchar", 255).number("ushort", 1).number("double", 0.5);
    ply.number(count, 3);
    for (const int p : f) ply.number(index, p);
    ply.end_item();
  }
  return ply.bytes();
}

class SurfacePly : public testing::Test {
 protected:
  SurfacePly() { fs::create_directories(file_.parent_path()); }
  ~SurfacePly() override { fs::remove_all(file_.parent_path()); }

  std::string message_for(const std::string& bytes) const {
    write(file_, bytes);
    return message_of([&] { read_surface(file_); });
  }
  void expect_tetrahedron(const std::string& bytes, const std::string& what) const {
    EXPECT_EQ(message_for(bytes), "nothing was thrown") << what;
    const Surface s = read_surface(file_);
    ASSERT_EQ(s.points.size(), 4u) << what;
    EXPECT_EQ(s.points[1].x, 100) << what;
    EXPECT_EQ(s.points[2].y, 100) << what;
    EXPECT_EQ(s.points[3].z, 100) << what;
    EXPECT_TRUE(check_surface(s).good()) << what;
  }

  fs::path file_ = fs::path(testing::TempDir()) / fmt::format("macadam_ply_{}", getpid()) / "stone.ply";
};

TEST_F(SurfacePly, EveryTypeOfNumberIsRead) {
  for (const std::string format : formats) {
    for (const TypeCase& t : types) {
      for (const bool extras : {false, true}) {
        const bool whole = t.bytes != 0 && t.bytes != 1000;
        expect_tetrahedron(tetrahedron_ply(format, t.name, "float", "uchar", "int", extras), format + " x " + t.name);
        expect_tetrahedron(
            tetrahedron_ply(format, "double", t.name, whole ? t.name : "uchar", whole ? t.name : "int", extras),
            format + " list " + t.name);
      }
    }
  }
}

TEST_F(SurfacePly, NegativeAndLargeNumbersKeepTheirValues) {
  for (const std::string format : formats) {
    std::string bytes = tetrahedron_ply(format, "int", "short", "uchar", "uint", false);
    PlyText old(format), by(format);
    for (const double x : {0, 0}) old.number("int", x);
    old.number("short", 100), by.number("int", -2147483648.0).number("int", 2147483647).number("short", -32768);
    const auto strip = [](const std::string& text) { return text.substr(text.find("none\n") + 5); };
    bytes.replace(bytes.rfind(strip(old.bytes())), strip(old.bytes()).size(), strip(by.bytes()));
    write(file_, bytes);
    const Surface s = read_surface(file_);
    EXPECT_EQ(s.points.at(3).x, -2147483648.0) << format;
    EXPECT_EQ(s.points.at(3).y, 2147483647) << format;
    EXPECT_EQ(s.points.at(3).z, -32768) << format;
  }
}

/// Headers that are wrong or announce missing data are refused with their line, before memory is allocated.
TEST_F(SurfacePly, BrokenHeadersAreNamedByLine) {
  struct Case {
    std::string what, by, word;
  };
  const Case cases[] = {
      {"property int x", "property list uchar int x", ":6: property x: found a list"},
      {"property int y", "property int w", ":5: element vertex: found no property y"},
      {"property int y", "property int x", ":7: property: found \"x\" again"},
      {"property int x", "property int64 x", ":6: type: found \"int64\""},
      {"property int x", "property int", ":6: property: found no name"},
      {"property int x", "property", ":6: type: found \"\""},
      {"property int x", "prop int x", ":6: header: found \"prop\""},
      {"element vertex 4", "element vertex", ":5: element \"vertex\": found the end of the line"},
      {"element vertex 4", "element vertex -4", ":5: element \"vertex\": found \"-4\""},
      {"element vertex 4", "element vertex 4.5", ":5: element \"vertex\": found \"4.5\""},
      {"element vertex 4", "element vertex 1000000000", ":5: element vertex: found 1000000000 items"},
      {"element vertex 4", "element vertex 9223372036854775807", ":5: element vertex: found 9223372036854775807 items"},
      {"element vertex 4", "element vertex 99999999999999999999", ":5: element \"vertex\": found \"9999"},
      {"element face 4", "element face 1000000000", ":9: element face: found 1000000000 items"},
      {"element face 4", "element face 5", "the end of the file"},
      {"element face 4", "element face 3", "the end of the file after the last element"},
      {"element face 4", "element other 1000000000", ":9: element other: found 1000000000 items"},
      {"element face 4", "element vertices 4", ":9: element vertices: found a second element of this name"},
      {"element face", "element faces_", "no facet"},
      {"list uchar int vertex_index", "list uchar int vertex", ":9: element face: found no property vertex_indices"},
      {"list uchar int vertex_index", "int vertex_index", ":10: property vertex_index: found no list"},
      {"list uchar int vertex_index", "list uchar float vertex_index",
       ":10: property vertex_index: found a list of float"},
      {"list uchar int vertex_index", "list float int vertex_index", ":10: length of a list: found \"float\""},
      {"list uchar int", "list uchar string", ":10: type: found \"string\""},
      {"element vertex", "elephant vertex", ":5: header: found \"elephant\""},
      {"comment made", "property int made", ":3: header: found a property before any element"},
      {"end_header", "comment", ": found "},
      {"ply", "plx", ":1: header: found no `ply`"}};
  for (const std::string format : formats) {
    const std::string good = tetrahedron_ply(format, "int", "int", "uchar", "int", false);
    for (const Case& c : cases) {
      std::string bytes = good;
      bytes.replace(bytes.find(c.what), c.what.size(), c.by);
      const std::string message = message_for(bytes);
      EXPECT_EQ(message.rfind(file_.string() + ":", 0), 0u) << message;
      EXPECT_NE(message.find(c.word), std::string::npos) << format << ", " << c.by << ": " << message;
    }
    std::string bytes = good;
    EXPECT_HAS(message_for(bytes.replace(bytes.find("format"), 7 + format.size(), "format morse")),
               ":2: format: found");
    EXPECT_HAS(message_for(good + "7"), "after the last element");
    EXPECT_EQ(message_for(good + "\n"), "nothing was thrown");
  }
}

// The last number of a text needs no space after it, so three numbers may take five bytes. A file with one point is
// refused because it has no facet, not because it is too short.
TEST_F(SurfacePly, ATextMayEndWithItsLastNumber) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_HAS(message_for(header + "0 1 2"), "facet");
  EXPECT_HAS(message_for(header + "0 1 "), "fewer items, because only 4 bytes follow the header");
}

TEST_F(SurfacePly, NumbersBeyondTheirTypesAreRefused) {
  const std::string good = tetrahedron_ply("ascii", "uchar", "float", "char", "int", false);
  for (const auto& [what, by, word] : {std::tuple{"100 0 0", "100 256 0", ":13: point 1: found \"256\""},
                                       {"100 0 0", "100 -1 0", ":13: point 1: found \"-1\""},
                                       {"100 0 0", "100 0.5 0", ":13: point 1: found \"0.5\""},
                                       {"100 0 0", "100 nan 0", ":13: point 1: found \"nan\""},
                                       {"100 0 0", "100 0 1e39", ":13: point 1: found coordinate inf"},
                                       {"3 0 1 2", "-3 0 1 2", ":16: facet 0: found -3 entries"},
                                       {"3 0 1 2", "2 0 1", ":16: facet 0: found 2 points"},
                                       {"3 0 1 2", "127 0 1 2", ":16: facet 0: found 127 points"}}) {
    std::string bytes = good;
    EXPECT_HAS(message_for(bytes.replace(bytes.find(what), std::strlen(what), by)), word);
  }
  for (const std::string format : {"binary_little_endian", "binary_big_endian"}) {
    const std::string list = "property list uint double weights\nproperty list uchar int vertex_index";
    std::string bytes = tetrahedron_ply(format, "int", "int", "uchar", "int", false);
    bytes.replace(bytes.find("property list uchar int vertex_index"), 36, list);
    bytes.insert(bytes.size() - 4 * 13, "\xff\xff\xff\xff");  // announces 4,294,967,295 numbers in the first list
    EXPECT_HAS(message_for(bytes), "facet 0: found the end of the file");
  }
}

/// A file in any format with all optional elements is refused wherever it is truncated.
TEST_F(SurfacePly, CutAnywhereTheyNeverPass) {
  for (const std::string format : formats) {
    const std::string good = tetrahedron_ply(format, "short", "double", "uchar", "ushort", true);
    for (std::size_t length = 0; length + 2 < good.size(); ++length) {
      const std::string message = message_for(good.substr(0, length));
      ASSERT_NE(message, "nothing was thrown") << format << " cut to " << length << " of " << good.size();
    }
  }
}

TEST_F(SurfacePly, NamesWithControlCharactersLeaveTheMessageInOneLine) {
  std::string bytes = tetrahedron_ply("ascii", "int", "int", "uchar", "int", false);
  bytes.insert(bytes.find("element"), "element a\x01 1000000\nproperty int c\n");
  EXPECT_HAS(message_for(bytes), "element a?: found 1000000 items");
}

}  // namespace
}  // namespace macadam::test
