// SPDX-License-Identifier: GPL-3.0-or-later
// surface_files_test.cpp  Writes and reads every surface format, and reads files that are truncated, corrupt or
// nonsensical.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "macadam/error.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

const std::string tetrahedron_off =
    "OFF\n4 4 0\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";
const std::string tetrahedron_obj =
    "# a comment\nv 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1/1/1 4/1/1 2/1/1\nf -4 -2 -1\nf 2 4 3\n";
const std::string tetrahedron_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n"
    "3 1 3 2\n";

std::string ascii_stl(const Surface& s) {
  std::string text = "solid thing\n";
  for (const auto& f : s.facets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto p : f) { text += fmt::format("vertex {} {} {}\n", s.points[p].x, s.points[p].y, s.points[p].z); }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid thing\n";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  text.replace(text.find(what), what.size(), by);
  return text;
}

class SurfaceFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        fmt::format("macadam_surfaces_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path written(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  /// Returns the message of the InputError on reading the file, or "accepted". Every other exception fails the test.
  static std::string message_for(const fs::path& file, double scale = 1) {
    try {
      read_surface(file, scale);
      return "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(file.string() + ":", 0), 0u) << error.what();
      return error.what();
    }
  }

  /// Returns the surface in the four formats of our writer and in ASCII STL, as pairs of extension and bytes.
  std::vector<std::pair<std::string, std::string>> all_formats(const Surface& s) const {
    std::vector<std::pair<std::string, std::string>> files;
    for (const char* ending : {"stl", "off", "ply", "obj"}) {
      const fs::path file = folder_ / (std::string("whole.") + ending);
      write_surface(file, s);
      files.emplace_back(ending, read(file));
    }
    files.emplace_back("stl", ascii_stl(s));
    return files;
  }

  fs::path folder_;
};

TEST_F(SurfaceFiles, RoundTripToTheBitWhereTheFormatHasDoubles) {
  RandomStream random(1, 2);
  for (const Surface& s : {tetrahedron(), mapped(icosphere(2), random_pose(random, 1e-3, {1.0 / 3, 1, 1e-9}))}) {
    for (const char* ending : {".off", ".ply", ".obj"}) {
      const fs::path file = folder_ / (std::string("stone") + ending);
      write_surface(file, s);
      const Surface r = read_surface(file);
      EXPECT_EQ(r.name, "stone");
      EXPECT_EQ(r.facets, s.facets) << ending;
      ASSERT_EQ(r.points.size(), s.points.size());
      for (std::size_t i = 0; i < r.points.size(); ++i) {
        EXPECT_EQ(std::memcmp(&r.points[i], &s.points[i], sizeof(Vec3d)), 0) << ending << " point " << i;
      }
    }
  }
}

TEST_F(SurfaceFiles, StlKeepsFloats) {
  const Surface s = icosphere(2);
  for (const bool ascii : {false, true}) {
    const fs::path file = folder_ / "stone.stl";
    ascii ? void(written("stone.stl", ascii_stl(s))) : write_surface(file, s);
    const Surface r = read_surface(file);
    ASSERT_EQ(r.points.size(), s.points.size()) << "points are joined";
    ASSERT_EQ(r.facets.size(), s.facets.size());
    for (std::size_t f = 0; f < s.facets.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Vec3d apart = r.points[r.facets[f][k]] - s.points[s.facets[f][k]];
        EXPECT_LE(norm(apart), ascii ? 0 : 1e-7);  // half an ulp of a float below 1 is 3e-8, in three components
      }
    }
    EXPECT_TRUE(check_surface(r).good());
  }
  write_surface(folder_ / "stone.stl", s);
  std::string bytes = read(folder_ / "stone.stl");
  std::memcpy(bytes.data(), "solid by a careless program", 27);  // begins with "solid", but is binary
  EXPECT_EQ(read_surface(written("solid.stl", bytes)).facets.size(), s.facets.size());
}

TEST_F(SurfaceFiles, OfOthersAreRead) {
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.off", tetrahedron_off},
                                   {"a.OFF", tetrahedron_off},
                                   {"a.obj", tetrahedron_obj},
                                   {"a.ply", tetrahedron_ply},
                                   {"a.dots.Stl", ascii_stl(tetrahedron(std::sqrt(8.0)))}}) {
    const Surface s = read_surface(written(name, text), 1e-3);
    EXPECT_EQ(s.points.size(), 4u) << name;
    EXPECT_NEAR(measure_shape(s).volume, 8e-9 / 3, 1e-21) << name;
    EXPECT_EQ(s.name, fs::path(name).stem()) << name;
  }
}

TEST_F(SurfaceFiles, ScaleMultipliesAndDividesBack) {
  const Surface s = box_surface(1, 2, 3);
  write_surface(folder_ / "box.off", s, 1e-3);
  EXPECT_NEAR(measure_shape(read_surface(folder_ / "box.off")).volume, 6e9, 1e-3);
  EXPECT_NEAR(measure_shape(read_surface(folder_ / "box.off", 1e-3)).volume, 6, 1e-12);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(message_for(folder_ / "box.off", bad).find("scale (--scale), metres per unit of the file: found"),
              std::string::npos);
    EXPECT_THROW(write_surface(folder_ / "bad.off", s, bad), InputError);
  }
}

TEST_F(SurfaceFiles, ShortNumbersAreWrittenShort) {
  Surface s = tetrahedron();
  for (Vec3d& p : s.points) p = 1e-9 * Vec3d{std::round(p.x * 1e7), std::round(p.y * 1e7), std::round(p.z * 1e7)};
  s.points[0].x = 0.001234567;
  write_surface(folder_ / "s.off", s);
  EXPECT_NE(read(folder_ / "s.off").find("0.001234567 "), std::string::npos) << read(folder_ / "s.off");
}

TEST_F(SurfaceFiles, BrokenOnesAreInputErrorsWithTheCulprit) {
  struct Case {
    std::string name, bytes, word;
  };
  std::string nan_stl;
  {
    write_surface(folder_ / "t.stl", tetrahedron());
    nan_stl = read(folder_ / "t.stl");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(&nan_stl[84 + 50 * 2 + 12], &nan, 4);
  }
  std::string header_alone(84, ' ');  // header of a binary file whose count announces one facet
  header_alone[80] = 1, header_alone[81] = header_alone[82] = header_alone[83] = 0;
  std::vector<Case> cases{
      {"header.stl", header_alone,
       "surface: found 84 bytes, expected 134 bytes, because the header of a binary file counts 1 facet"},
      {"nan.stl", nan_stl, "facet 2: found coordinate nan"},
      {"nan.stl", replaced(ascii_stl(tetrahedron(std::sqrt(8.0))), "vertex 1", "vertex nan"),
       ":4: facet 0: found \"nan\""},
      {"two.stl", replaced(ascii_stl(tetrahedron()), "endloop\n", "endfacet\n"), ":8: facet 1: found \"endfacet\""},
      {"two.stl", replaced(ascii_stl(tetrahedron()), "vertex", "vertxe"), ":8: facet 0: found 2 points, expected 3"},
      {"order.stl", replaced(ascii_stl(tetrahedron()), "facet normal", "vertex 1 2 3"),
       ":2: facet 0: found \"vertex\""},
      {"nan.off", replaced(tetrahedron_off, "-1 1 -1", "-1 nan -1"), ":5: point 2: found \"nan\""},
      {"inf.off", replaced(tetrahedron_off, "-1 1 -1", "-1 1e999 -1"), ":5: point 2: found \"1e999\""},
      {"big.off", replaced(tetrahedron_off, "-1 1 -1", "-1 1e200 -1"), "point 2: found (-1, 1e+200, -1)"},
      {"nan.obj", replaced(tetrahedron_obj, "v -1 1 -1", "v -1 nan -1"), ":4: point 2: found \"nan\""},
      {"nan.ply", replaced(tetrahedron_ply, "\n-1 1 -1", "\n-1 nan -1"), ":12: point 2: found coordinate nan"},
      {"huge.off", replaced(tetrahedron_off, "3 0 3 1", "3 0 3 999999999"), ":8: facet 1: found point 999999999"},
      {"huge.off", replaced(tetrahedron_off, "3 0 3 1", "3 0 -3 1"), ":8: facet 1: found point -3"},
      {"huge.off", replaced(tetrahedron_off, "4 4 0", "400000000 4 0"), ":2: surface: found 400000000 points"},
      {"huge.off", replaced(tetrahedron_off, "4 4 0", "4 400000000 0"), "and 400000000 facets"},
      {"minus.off", replaced(tetrahedron_off, "4 4 0", "4 -4 0"), ":2: number of facets: found \"-4\""},
      {"wide.off", replaced(tetrahedron_off, "3 0 3 1", "2000000000 0 3 1"), "2000000000 points"},
      {"short.off", replaced(tetrahedron_off, "4 4 0", "5 4 0"), ":10: surface: found the end of the file"},
      {"long.off", replaced(tetrahedron_off, "4 4 0", "4 3 0"), ":10: surface: found \"3\""},
      {"four.off", replaced(tetrahedron_off, "OFF", "4OFF"), ":1: header: found \"4OFF\""},
      {"binary.off", replaced(tetrahedron_off, "OFF", "OFF BINARY"), ":1: number of points: found \"BINARY\""},
      {"colour.off", replaced(tetrahedron_off, "1 1 1\n", "1 1 1 x\n"), ":3: point 0: found \"x\""},
      {"huge.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 5 3"),
       ":9: facet 3: found point 5, expected a number from 1 to 4"},
      {"huge.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 2000000000 3"), ":9: facet 3: found point 2000000000"},
      {"huge.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 99999999999999999999 3"), ":9: facet 3: found \"9999"},
      {"zero.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 0 3"),
       ":9: facet 3: found point 0, expected a number from 1, or from -4 to -1"},
      {"minus.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 -5 3"),
       ":9: facet 3: found point -5, expected a number from 1, or from -4 to -1"},
      {"huge.ply", replaced(tetrahedron_ply, "3 1 3 2", "3 1 3 222222222"), ":17: facet 3: found point 222222222"},
      {"minus.ply", replaced(tetrahedron_ply, "3 1 3 2", "3 1 -3 2"), ":17: facet 3: found point -3"},
      {"line.off", replaced(tetrahedron_off, "3 0 3 1", "2 0 3"), ":8: facet 1: found 2 points, expected 3 or more"},
      {"short.off", replaced(tetrahedron_off, "3 0 3 1", "4 0 3 1"), ":8: facet 1: found 4 points, expected at most 3"},
      {"two.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 4"), ":9: facet 3: found 2 points"},
      {"word.obj", replaced(tetrahedron_obj, "f 2 4 3", "face 2 4 3"), ":9: keyword: found \"face\""},
      {"none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no facet"},
      {"none.obj", "v 0 0 0\n", "no facet"},
      {"none.stl", "solid nothing\nendsolid nothing\n", "no facet"}};
  const std::string garbage =
      "Lorem ipsum dolor sit amet, consectetur adipisici elit, sed eiusmod tempor incidunt ut "
      "labore et dolore magna aliqua. Ut enim ad minim veniam, quis nostrud exercitation.\n";
  for (const char* ending : {"stl", "off", "ply", "obj"}) {
    cases.push_back({std::string("empty.") + ending, "", "an empty file"});
    cases.push_back({std::string("blank.") + ending, " \n\n  ", ": found "});
    cases.push_back({std::string("text.") + ending, garbage, ": found "});
    cases.push_back({std::string("zeros.") + ending, std::string(500, '\0'), ": found "});
    cases.push_back({std::string("ones.") + ending, std::string(500, '\xff'), ": found "});
  }
  for (const Case& c : cases) {
    const std::string message = message_for(written(c.name, c.bytes));
    EXPECT_NE(message.find(c.word), std::string::npos) << c.name << ": " << message;
  }
}

/// A word must be a number as a whole: the reader neither splits it into two numbers nor ignores characters after the
/// number.
TEST_F(SurfaceFiles, WhatIsNoNumberIsNamedWithItsLine) {
  for (const std::string bad : {"1.5.5", "1,5", "0x1", "1.5f", "--1", "+-1", "1e", "1.5-2"}) {
    const std::string found = fmt::format(": found \"{}\"", bad);
    for (const auto& [name, text, line] :
         {std::tuple<std::string, std::string, int>{"a.off", replaced(tetrahedron_off, "-1 1 -1", "-1 " + bad + " -1"),
                                                    5},
          {"b.off", replaced(tetrahedron_off, "3 0 2 3", "3 0 " + bad + " 3"), 9},
          {"a.obj", replaced(tetrahedron_obj, "v -1 1 -1", "v -1 1 " + bad), 4},
          {"b.obj", replaced(tetrahedron_obj, "f 2 4 3", "f 2 " + bad + "/7 3"), 9},
          {"a.ply", replaced(tetrahedron_ply, "\n-1 1 -1", "\n-1 " + bad + " -1"), 12},
          {"b.ply", replaced(tetrahedron_ply, "\n3 1 3 2", "\n3 1 3 " + bad), 17},
          {"a.stl", replaced(ascii_stl(tetrahedron(std::sqrt(8.0))), "vertex 1", "vertex " + bad), 4}}) {
      const std::string message = message_for(written(name, text));
      EXPECT_NE(message.find(fmt::format("{}:{}: ", name, line)), std::string::npos) << bad << ": " << message;
      EXPECT_NE(message.find(found), std::string::npos) << bad << ": " << message;
    }
  }
}

TEST_F(SurfaceFiles, CommentsColoursAndBlankLinesArePassedOver) {
  const Surface s = tetrahedron(std::sqrt(8.0));
  const std::string stl = ascii_stl(s);
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.off",
                                            "# a stone\n\n" + replaced(tetrahedron_off, "1 1 1", "1 1 1 # first")},
        {"b.off", replaced(replaced(tetrahedron_off, "OFF", "CNOFF"), "1 1 1\n", "+1 1. 1e0 0 0 1 255 0 0 1\r\n\n")},
        {"c.off", replaced(replaced(tetrahedron_off, "OFF\n4 4 0", "OFF 4 4"), "3 0 1 2", "3 0 1 2 0.5 0.5 0.5")},
        {"a.obj",
         "mtllib x.mtl\no stone\n" + replaced(tetrahedron_obj, "f 1 2 3", "vn 0 0 1\ns off\nf 1//1 2//1 3//1")},
        {"a.stl", replaced(stl, "facet normal 0 0 0", "facet normal nan -nan(ind) 0")},
        {"b.stl", replaced(stl, "solid thing", "\n solid facet of a vertex")}}) {
    const fs::path file = written(name, text);
    EXPECT_EQ(message_for(file), "accepted");
    const Surface r = read_surface(file);
    EXPECT_EQ(r.points.size(), 4u) << name;
    EXPECT_TRUE(check_surface(r).good()) << name;
  }
}

TEST_F(SurfaceFiles, UnreadableOnesAreNamed) {
  EXPECT_NE(message_for(folder_ / "missing.off").find("No such file"), std::string::npos);
  fs::create_directories(folder_ / "folder.off");
  EXPECT_NE(message_for(folder_ / "folder.off").find("a directory"), std::string::npos);
  fs::create_symlink("/dev/zero", folder_ / "zero.off");
  EXPECT_NE(message_for(folder_ / "zero.off").find("a device or pipe"), std::string::npos);
  EXPECT_NE(message_for(written("stone.step", "x")).find("ending: found .step, expected one of .stl .off"),
            std::string::npos);
  EXPECT_NE(message_for(written("stone", "x")).find("ending: found none"), std::string::npos);
}

TEST_F(SurfaceFiles, UnwritableOnesAreRunErrors) {
  EXPECT_THROW(write_surface(folder_ / "no" / "folder.off", tetrahedron()), RunError);
  EXPECT_THROW(write_surface(folder_ / "stone.step", tetrahedron()), InputError);
}

/// A file that is truncated is refused, unless only white space is missing. Near the end of the file every byte is
/// tried as the end. OBJ files have no counts, and the last digits of a number may be missing unnoticed. In this case
/// the remaining surface must not count as good, unless it has all facets.
TEST_F(SurfaceFiles, CutAnywhereTheyNeverPass) {
  const Surface s = tetrahedron();
  for (const auto& [ending, bytes] : all_formats(s)) {
    for (std::size_t length = 0; length < bytes.size(); length += length + 60 < bytes.size() ? 7 : 1) {
      const fs::path file = written("cut." + ending, bytes.substr(0, length));
      Surface r;
      try {
        r = read_surface(file);
      } catch (const InputError& error) {
        ASSERT_EQ(std::string(error.what()).rfind(file.string() + ":", 0), 0u) << error.what();
        continue;
      }
      if (!check_surface(r).good()) continue;
      EXPECT_EQ(r.facets.size(), s.facets.size()) << ending << " cut to " << length << " of " << bytes.size();
    }
  }
}

/// Changing any byte may lead to an error or to another surface, but never to a crash.
TEST_F(SurfaceFiles, WithAnyByteChangedTheyNeverCrash) {
  RandomStream random(7, 5);
  for (const auto& [ending, bytes] : all_formats(tetrahedron())) {
    int refused = 0;
    for (int k = 0; k < 200; ++k) {
      std::string changed = bytes;
      changed[random.index(bytes.size())] = static_cast<char>(random.index(256));
      const fs::path file = written("changed." + ending, changed);
      try {
        check_surface(read_surface(file));
      } catch (const InputError&) { ++refused; }
    }
    EXPECT_GT(refused, 0) << ending;
  }
}

}  // namespace
}  // namespace macadam::test
