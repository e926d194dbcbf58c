// SPDX-License-Identifier: GPL-3.0-or-later
// surface_reading_test.cpp  Reads surface files as other programs write them, with seams, polygons and various
// spellings. Volume and area must be right.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "host/shapes/files/cut_polygon.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

using Polygons = std::vector<std::vector<int>>;

std::string with_line_ends(std::string text, const std::string& end) {
  std::string out;
  for (const char c : text) c == '\n' ? void(out += end) : out.push_back(c);
  return out;
}

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string replaced_all(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

/// Returns ASCII STL. `corner` returns the coordinates of a point; it is called for each corner of each facet.
template <class Corner>
std::string ascii_stl(const Surface& s, Corner&& corner) {
  std::string text = "solid box of stone\n";
  for (const auto& f : s.facets) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const auto p : f) {
      const Vec3d x = corner(s.points[p]);
      text += fmt::format("vertex {} {} {}\n", x.x, x.y, x.z);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box of stone\n";
}

std::string obj(const std::vector<Vec3d>& points, const Polygons& polygons) {
  std::string text;
  for (const Vec3d& p : points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& polygon : polygons) {
    text += "f";
    for (const int p : polygon) text += fmt::format(" {}", p + 1);
    text += "\n";
  }
  return text;
}

std::string off(const std::vector<Vec3d>& points, const Polygons& polygons) {
  std::string text = fmt::format("OFF\n{} {} 0\n", points.size(), polygons.size());
  for (const Vec3d& p : points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& polygon : polygons) text += fmt::format("{} {}\n", polygon.size(), fmt::join(polygon, " "));
  return text;
}

std::string ply(const std::vector<Vec3d>& points, const Polygons& polygons, bool text) {
  std::string bytes = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face "
      "{}\n"
      "property list uchar int vertex_indices\nend_header\n",
      text ? "ascii" : "binary_little_endian", points.size(), polygons.size());
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const Vec3d& p : points)
    text ? void(bytes += fmt::format("{} {} {}\n", p.x, p.y, p.z)) : (add(p.x), add(p.y), add(p.z));
  for (const auto& polygon : polygons) {
    if (text) bytes += fmt::format("{} {}\n", polygon.size(), fmt::join(polygon, " "));
    if (text) continue;
    add(static_cast<std::uint8_t>(polygon.size()));
    for (const std::int32_t p : polygon) add(p);
  }
  return bytes;
}

/// Returns a ring of `sides` segments with a rectangular cross-section.
Surface ring(int sides, double inner, double outer, double height) {
  Surface s{"ring", {}, {}};
  for (int i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / sides;
    for (const auto& [r, z] : {std::pair{inner, 0.0}, {outer, 0.0}, {outer, height}, {inner, height}})
      s.points.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  for (int i = 0; i < sides; ++i) {
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * i + k, b = 4 * i + (k + 1) % 4, c = 4 * ((i + 1) % sides) + (k + 1) % 4,
                d = 4 * ((i + 1) % sides) + k;
      s.facets.push_back({a, d, c});
      s.facets.push_back({a, c, b});
    }
  }
  return s;
}

class SurfaceReading : public testing::Test {
 protected:
  SurfaceReading() { fs::create_directories(folder_); }
  ~SurfaceReading() override { fs::remove_all(folder_); }

  Surface surface(const std::string& name, const std::string& bytes) const {
    write(folder_ / name, bytes);
    return read_surface(folder_ / name);
  }
  std::string message(const std::string& name, const std::string& bytes) const {
    write(folder_ / name, bytes);
    return message_of([&] { read_surface(folder_ / name); });
  }
  /// Expects a closed surface of this volume and area. Rounding of the sums is below 1e-14; `tolerance` is for the
  /// rounding in the file.
  static void expect_closed(const Surface& s, double volume, double area, const std::string& what,
                            double tolerance = 1e-13) {
    ASSERT_TRUE(check_surface(s).good()) << what << ": " << check_surface(s).text();
    const ShapeMeasure m = measure_shape(s);
    EXPECT_NEAR(m.volume, volume, tolerance * volume) << what;
    EXPECT_NEAR(m.area, area, tolerance * area) << what;
  }

  fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("macadam_reading_{}", getpid());
};

/// Programs write a zero coordinate as 0, 1e-17 or 6e-8, differently in each facet. Such corners must be joined.
TEST_F(SurfaceReading, CornersThatDifferByRoundingAreJoined) {
  const Surface s = ring(24, 6, 8, 3);
  const double volume = 12 * std::sin(std::numbers::pi / 12) * (64 - 36) * 3;
  const double area = 2 * volume / 3 + 48 * std::sin(std::numbers::pi / 24) * 14 * 3;
  ASSERT_NEAR(volume, 260.890, 5e-4);
  ASSERT_NEAR(area, 437.067, 5e-4);
  for (const double noise : {1e-17, 6e-8}) {
    int next = 0;
    const auto rounded = [&](double x) { return std::abs(x) > 1e-9 ? x : noise * ((++next * 7) % 5 - 2); };
    const Surface r = surface("ring.stl", ascii_stl(s, [&](const Vec3d& p) {
                                return Vec3d{rounded(p.x), rounded(p.y), rounded(p.z)};
                              }));
    EXPECT_EQ(r.points.size(), s.points.size());
    EXPECT_EQ(r.facets.size(), s.facets.size());
    expect_closed(r, volume, area, fmt::format("noise {}", noise), 1e-7);  // points are moved by at most 1e-7 of a side
    EXPECT_TRUE(r.reading.starts_with("merged ") &&
                r.reading.ends_with(" points on open edges, each with another one less than 7.6e-06 m away"))
        << r.reading;
  }
}

/// Corners that differ by one unit in the last place of a float are joined, in any position.
TEST_F(SurfaceReading, CornersThatDifferByOneFloatAreJoinedWherever) {
  RandomStream random(3, 1);
  const Surface s = stone(3);
  const auto next = [&](double x) {
    const auto f = static_cast<float>(x);
    return random.uniform() < 0.5 ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
  };
  const Surface r = surface("stone.stl", ascii_stl(s, [&](const Vec3d& p) {
                              return Vec3d{next(p.x), next(p.y), next(p.z)};
                            }));
  EXPECT_EQ(r.points.size(), s.points.size());
  expect_closed(r, measure_shape(s).volume, measure_shape(s).area, "stone", 1e-6);
}

/// Fine details are kept: a closed surface bit by bit, and a hole whose corners are twice the joining width apart.
TEST_F(SurfaceReading, FineSurfacesStayAsTheyAre) {
  const Surface thin = prism({{0, 0}, {1, 0}, {1, 1e-9}, {0.5, 1e-9}, {0, 1e-9}}, 1);
  Surface fine = icosphere(2);
  fine.facets.pop_back();
  const auto [a, b, c] = fine.facets.back();
  const Vec3d edge = fine.points[c] - fine.points[b];
  fine.points.push_back(fine.points[b] + (2e-6 / norm(edge)) * edge);  // the joining width is 9.5e-7
  fine.facets.back() = {a, b, static_cast<std::int32_t>(fine.points.size() - 1)};
  for (const Surface& s : {thin, fine}) {
    write_surface(folder_ / "fine.off", s);
    const Surface r = read_surface(folder_ / "fine.off");
    EXPECT_EQ(r.facets, s.facets);
    EXPECT_EQ(r.reading, "");
    ASSERT_EQ(r.points.size(), s.points.size());
    for (std::size_t p = 0; p < s.points.size(); ++p) EXPECT_EQ(norm(r.points[p] - s.points[p]), 0) << p;
  }
}

/// Points that are 0.6 joining widths apart are not joined as a chain: no point moves by more than the width.
TEST_F(SurfaceReading, JoiningDoesNotChain) {
  const double step = 0.6 * 4 * std::numeric_limits<float>::epsilon();
  Surface fan{"fan", {{0, 1, 0}}, {}};
  for (int k = 0; k <= 10; ++k) fan.points.push_back({0.25 + k * step, 0, 0});
  for (int k = 1; k <= 10; ++k) fan.facets.push_back({0, k, k + 1});
  write_surface(folder_ / "fan.off", fan);
  const Surface r = read_surface(folder_ / "fan.off");
  ASSERT_EQ(r.points.size(), 7u);  // six of the eleven points in a row are left, and the apex
  for (int k = 0; k <= 5; ++k) EXPECT_EQ(r.points[1 + k].x, fan.points[1 + 2 * k].x);
  EXPECT_EQ(r.facets.size(), 5u);
  EXPECT_TRUE(r.reading.starts_with("merged 5 points on open edges")) << r.reading;
  EXPECT_TRUE(r.reading.ends_with("; 5 facets then have no area")) << r.reading;
}

TEST_F(SurfaceReading, SpellingsOfAsciiStlAreRead) {
  const Surface box = box_surface(2, 3, 4);
  const std::string text = ascii_stl(box, [](const Vec3d& p) { return p; });
  const std::string words = replaced_all(replaced_all(text, "endfacet", "end facet"), "endloop", "end loop");
  for (const auto& [name, bytes] : {std::pair{"upper case", upper_case(text)},
                                    {"end solid", replaced_all(text, "endsolid", "end solid")},
                                    {"End Solid", replaced_all(words, "endsolid", "End Solid")},
                                    {"carriage returns", with_line_ends(text, "\r")},
                                    {"both", with_line_ends(text, "\r\n")},
                                    {"one too many", with_line_ends(text, "\r\r\n")},
                                    {"byte order mark", "\xef\xbb\xbf" + text}}) {
    const Surface s = surface("box.stl", bytes);
    expect_closed(s, 24, 52, name);
    EXPECT_EQ(s.reading, "") << name;
  }
  const std::string broken = replaced_all(text, "vertex 2 0 4\n", "vertex 2 0 x\n");
  const auto line =
      1 + std::count(broken.begin(), broken.begin() + std::ssize(broken.substr(0, broken.find(" x\n"))), '\n');
  EXPECT_HAS(message("box.stl", with_line_ends(broken, "\r")), fmt::format(":{}: facet ", line));
}

TEST_F(SurfaceReading, BytesAfterABinaryStlAreLeftOutAndSaid) {
  write_surface(folder_ / "box.stl", box_surface(2, 3, 4));
  const std::string bytes = read(folder_ / "box.stl");
  expect_closed(surface("one.stl", bytes + '\n'), 24, 52, "one byte");
  EXPECT_EQ(surface("one.stl", bytes + '\n').reading, "left out 1 byte after the last facet");
  EXPECT_EQ(surface("many.stl", bytes + std::string(49, 'x')).reading, "left out 49 bytes after the last facet");
  // 50 bytes could be a facet that the header does not count.
  EXPECT_HAS(message("more.stl", bytes + std::string(50, 'x')),
             "surface: found 734 bytes, expected 684 bytes, because the header of a binary file counts 12 facets");
  EXPECT_HAS(message("less.stl", bytes.substr(0, 683)),
             "surface: found 683 bytes, expected 684 bytes, because the header of a binary file counts 12 facets");
}

TEST_F(SurfaceReading, LinesMayEndInCarriageReturns) {
  const Surface box = box_surface(2, 3, 4);
  for (const char* ending : {"off", "obj"}) {
    write_surface(folder_ / (std::string("box.") + ending), box);
    const std::string bytes = read(folder_ / (std::string("box.") + ending));
    expect_closed(surface(std::string("box.") + ending, "# stone\r" + with_line_ends(bytes, "\r")), 24, 52, ending);
  }
  Polygons facets;
  for (const auto& f : box.facets) facets.push_back({f[0], f[1], f[2]});
  for (const bool text : {true, false}) {
    std::vector<Vec3d> points = box.points;
    double first = 0;
    std::memcpy(&first, "\n\0\0\0\0\0\0\0", 8);  // the double whose first byte is a line feed, 5e-323
    if (!text) points[0].x = first;
    std::string bytes = ply(points, facets, text);
    const std::size_t end = bytes.find("end_header\n") + 11;
    bytes = with_line_ends(bytes.substr(0, end), "\r") +
            (text ? with_line_ends(bytes.substr(end), "\r") : bytes.substr(end));
    expect_closed(surface("box.ply", bytes), 24, 52, text ? "text" : "binary");
  }
}

TEST_F(SurfaceReading, LinesOfObjGoOnAfterABackslash) {
  std::string text = obj(tetrahedron(std::sqrt(8.0)).points, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  const double volume = 8.0 / 3, area = 8 * std::sqrt(3.0);
  text = replaced_all(text, "f 1 4 2", "f 1 \\\n4\\\r\n  2");
  text = replaced_all(text, "v 1 -1 -1", "vn 1 \\\n0 0\nv 1 \\\n\\\n-1 -1");
  expect_closed(surface("a.obj", text), volume, area, "lines that go on");
  EXPECT_HAS(message("b.obj", replaced_all(text, "  2", "  7")),
             ":12: facet 1: found point 7, expected a number from 1 to 4");
  EXPECT_HAS(message("c.obj", text + std::string(100000, '\\')), "keyword");
  std::string blank;
  for (int k = 0; k < 100000; ++k) blank += "\\\n";
  expect_closed(surface("d.obj", text + "g " + blank), volume, area, "many such lines");
}

const Polygons cube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

TEST_F(SurfaceReading, QuadrilateralsAreCutByEveryReader) {
  const std::vector<Vec3d> points = box_surface(2, 2, 2).points;
  for (const auto& [name, bytes] : {std::pair{"cube.obj", obj(points, cube)},
                                    {"cube.off", off(points, cube)},
                                    {"cube.ply", ply(points, cube, true)},
                                    {"cube.ply", ply(points, cube, false)}}) {
    const Surface s = surface(name, bytes);
    EXPECT_EQ(s.facets.size(), 12u);
    EXPECT_EQ(s.reading, "cut 6 polygons into triangles");
    expect_closed(s, 8, 24, name);
  }
}

/// Returns the faces of a prism: two polygons and n quadrilaterals.
Polygons prism_faces(int n) {
  Polygons faces(2);
  for (int i = 0; i < n; ++i) {
    faces[0].insert(faces[0].begin(), i);
    faces[1].push_back(n + i);
    faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  return faces;
}

TEST_F(SurfaceReading, PolygonsAreCutWithinTheirOutlineInAnyPose) {
  RandomStream random(5, 1);
  for (int k = 0; k < 20; ++k) {
    const Pose pose = random_pose(random, 1, {10, 20, -30});
    // The polygon is an L with a corner in the middle of an edge.
    std::vector<Vec3d> points;
    for (const double z : {0.0, 2.0}) {
      for (const auto& [x, y] : {std::pair{0., 0.}, {1.5, 0.}, {3., 0.}, {3., 1.}, {1., 1.}, {1., 3.}, {0., 3.}})
        points.push_back(pose({x, y, z}));
    }
    // Files have all digits; coordinates of about 40 are rounded by 7e-15.
    expect_closed(surface("l.obj", obj(points, prism_faces(7))), 10, 34, "L", 1e-12);
  }
}

/// The outline of a face with a hole runs to the hole and back along the same edge.
TEST_F(SurfaceReading, PolygonsWithHolesAreCut) {
  const Surface s = tunnel(6, 4, 3, 1);
  const Polygons faces{{0, 3, 2, 1, 0, 4, 5, 6, 7, 4},
                       {8, 9, 10, 11, 8, 12, 15, 14, 13, 12},
                       {1, 9, 8, 0},
                       {2, 10, 9, 1},
                       {3, 11, 10, 2},
                       {0, 8, 11, 3},
                       {4, 12, 13, 5},
                       {5, 13, 14, 6},
                       {6, 14, 15, 7},
                       {7, 15, 12, 4}};
  Surface r = surface("tunnel.obj", obj(s.points, faces));
  EXPECT_EQ(r.reading, "cut 10 polygons into triangles");
  const SurfaceVerdict verdict = check_surface(r);
  if (verdict.inside_out) {
    for (auto& f : r.facets) std::swap(f[1], f[2]);
  }
  expect_closed(r, 66, 2 * (11 + 18 + 24) + 24, "tunnel");
}

TEST_F(SurfaceReading, PolygonsThatAreNotFlatOrCrossThemselvesAreSaid) {
  std::vector<Vec3d> points = box_surface(2, 2, 2).points;
  points[6] = {2, 2, 2.2};
  const Surface bent = surface("bent.off", off(points, cube));
  EXPECT_TRUE(check_surface(bent).good());
  EXPECT_EQ(bent.reading,
            "cut 6 polygons into triangles, 1 of them not flat (corners up to 3.5 % of the radius from the "
            "plane)");
  // a five-pointed star drawn in one line, as the ends of a prism
  points.clear();
  for (const double z : {0.0, 1.0}) {
    for (int k = 0; k < 5; ++k)
      points.push_back({std::cos(0.8 * std::numbers::pi * k), std::sin(0.8 * std::numbers::pi * k), z});
  }
  const Surface star = surface("star.off", off(points, prism_faces(5)));
  EXPECT_EQ(star.reading, "cut 7 polygons into triangles, 2 of them with an outline that crosses or touches itself");
  EXPECT_TRUE(check_surface(star).open.empty());
  EXPECT_FALSE(check_surface(star).self_intersecting.empty());
}

/// Corners are random points of a small grid, so that many coincide, are collinear, or make the outline cross itself.
/// The boundary of the triangles must be the polygon's outline, so that a closed surface stays closed.
TEST_F(SurfaceReading, TrianglesHaveTheOutlineOfTheirPolygon) {
  RandomStream random(11, 1);
  int within = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const std::size_t n = 4 + random.index(9);
    const bool flat = random.index(2) == 0;
    std::vector<Vec3d> points;
    std::vector<std::int64_t> corners;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = 1.0 * random.index(4), y = 1.0 * random.index(4);
      points.push_back({x, y, flat ? x + 2 * y : 1.0 * random.index(3)});
      corners.push_back(static_cast<std::int64_t>(random.index(5) == 0 ? random.index(n) : k));
    }
    std::vector<std::array<std::int32_t, 3>> triangles;
    within += !cut_polygon(points, corners, triangles).crossed;
    using Place = std::array<double, 3>;
    std::map<std::pair<Place, Place>, int> edges;
    const auto add = [&](std::int64_t from, std::int64_t to, int times) {
      const Place a{points[from].x, points[from].y, points[from].z}, b{points[to].x, points[to].y, points[to].z};
      if (a != b) edges[std::minmax(a, b)] += a < b ? times : -times;
    };
    for (const auto& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3], 1);
    }
    for (std::size_t k = 0; k < n; ++k) add(corners[k], corners[(k + 1) % n], -1);
    for (const auto& [edge, times] : edges) ASSERT_EQ(times, 0) << "trial " << trial;
  }
  EXPECT_GT(within, 1000);
}

TEST_F(SurfaceReading, RepeatedCornersOfPolygonsAreLeftOut) {
  const Surface s = surface(
      "a.obj", obj(tetrahedron(std::sqrt(8.0)).points, {{0, 1, 1, 2}, {0, 0, 3, 1, 0}, {0, 2, 3, 3}, {1, 3, 2}}));
  expect_closed(s, 8.0 / 3, 8 * std::sqrt(3.0), "repeated corners");
  EXPECT_EQ(check_surface(surface("b.obj", obj(s.points, {{0, 1, 2}, {3, 3, 3, 3}}))).degenerate.size(), 1u);
}

/// A number of corners that the file cannot hold is refused.
TEST_F(SurfaceReading, ForgedNumbersOfCornersAreRefused) {
  const std::vector<Vec3d> points = box_surface(2, 2, 2).points;
  for (const bool text : {true, false}) {
    std::string bytes = replaced_all(ply(points, {}, text), "element face 0", "element face 1");
    bytes = replaced_all(bytes, "list uchar int", "list uint int");
    bytes += text ? "4294967295 0 1 2" : std::string("\xff\xff\xff\xff\0\0\0\0", 8);
    EXPECT_HAS(message("forged.ply", bytes), "facet 0: found 4294967295 points, expected at most ");
  }
  EXPECT_HAS(message("forged.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9223372036854775807 0 1 2\n"),
             ":6: facet 0: found 9223372036854775807 points, expected at most ");
}

}  // namespace
}  // namespace macadam::test
