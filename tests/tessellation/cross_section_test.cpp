// SPDX-License-Identifier: GPL-3.0-or-later
// cross_section_test.cpp  Tests that the cells of a cross section fill the section of the box without gap or overlap,
// wherever the plane lies.
#include "macadam/cross_section.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/support/test_files.hpp"
#include "tests/support/test_spheres.hpp"

namespace macadam::test {
namespace {

/// Returns n spheres at random positions, with radii between 0.01 and 0.01·ratio.
Specimen random_box(int n, double ratio, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> u(0, 1);
  Specimen s;
  s.box.size = {1, 0.7, 1.3};
  for (int i = 0; i < n; ++i) add(s, {u(engine), 0.7 * u(engine), 1.3 * u(engine)}, 0.01 * std::pow(ratio, u(engine)));
  return s;
}

double Vec3d::*component(char axis) { return axis == 'x' ? &Vec3d::x : axis == 'y' ? &Vec3d::y : &Vec3d::z; }

Vec3d unit(char axis) {
  Vec3d n{};
  n.*component(axis) = 1;
  return n;
}

/// Expects that every polygon lies in the plane, is convex and counter-clockwise, and has the stated area, and that the
/// areas add up to the box's section.
void expect_partition(const Specimen& s, const CrossSection& section, double tolerance) {
  SCOPED_TRACE(fmt::format("{} = {}", section.plane.axis, section.plane.position));
  const Vec3d n = unit(section.plane.axis), box = s.box.size;
  double sum = 0;
  std::int32_t last = -1;
  for (const SectionCell& c : section.cells) {
    EXPECT_GT(c.particle, last);
    last = c.particle;
    const auto p = section.polygon(c);
    ASSERT_GE(p.size(), 3U);
    Vec3d twice{};
    for (std::size_t k = 0; k < p.size(); ++k) {
      EXPECT_EQ(p[k].*component(section.plane.axis), section.plane.position);
      const Vec3d &a = p[k], &b = p[(k + 1) % p.size()], &d = p[(k + 2) % p.size()];
      EXPECT_GE(dot(cross(b - a, d - b), n), -1e-15 * norm(box) * norm(d - a)) << "cell " << c.particle;
      twice += cross(a - p[0], b - p[0]);
    }
    EXPECT_NEAR(0.5 * dot(twice, n), c.area, 1e-14 * norm(box) * norm(box));
    sum += c.area;
  }
  const double area = box.x * box.y * box.z / (box.*component(section.plane.axis));
  EXPECT_NEAR(sum / area, 1, tolerance);
}

// Tolerance of areas. The error of an area is a few ε times the length of the edges of the cells. If there are n cells
// along a side of the box, all edges together are about n sides long.
constexpr double rounding = 1e-13;

TEST(CrossSection, OneParticleShowsTheWholeRectangle) {
  Specimen s;
  s.box.size = {1, 2, 3};
  add(s, {0.3, 0.4, 0.5}, 0.1);
  const Tessellation t = tessellate(s);
  for (const SectionPlane plane : {SectionPlane{'x', 0.25}, {'y', 0.0}, {'y', 2.0}, {'z', 3.0}}) {
    const CrossSection section = cut(s, t, plane);
    ASSERT_EQ(section.cells.size(), 1U);
    EXPECT_EQ(section.polygon(section.cells[0]).size(), 4U);
    expect_partition(s, section, 1e-15);
  }
}

/// Two spheres part at the plane of equal power distance. In a section across this plane, their polygons have the areas
/// that follow from its position.
TEST(CrossSection, TwoParticlesPartAtTheWeightedPlane) {
  Specimen s;
  s.box.size = {1, 1, 1};
  add(s, {0.25, 0.5, 0.5}, 0.375);
  add(s, {0.75, 0.5, 0.5}, 0.125);
  const double x = 0.625;  // 0.25 + (d² + R_a² − R_b²)/(2d), which is exact in binary
  const Tessellation t = tessellate(s);
  const CrossSection across = cut(s, t, {'z', 0.3});
  ASSERT_EQ(across.cells.size(), 2U);
  EXPECT_NEAR(across.cells[0].area, x, 1e-15);
  EXPECT_NEAR(across.cells[1].area, 1 - x, 1e-15);
  // A plane in the facet itself shows the cell above it. A plane close to the facet shows the cell in which the plane
  // lies.
  for (const auto& [position, owner] : std::map<double, int>{{x - 1e-6, 0}, {x, 1}, {x + 1e-6, 1}, {0, 0}, {1, 1}}) {
    const CrossSection along = cut(s, t, {'x', position});
    ASSERT_EQ(along.cells.size(), 1U) << position;
    EXPECT_EQ(along.cells[0].particle, owner) << position;
    EXPECT_EQ(along.cells[0].area, 1) << position;
  }
}

// On lattices, planes pass through facets, edges and corners. There more cells than usual meet, and rounding decides
// which cell owns a point. The parameter of the test shifts the centres at random.
class LatticeSection : public testing::TestWithParam<double> {
 protected:
  static constexpr double a = 7e-3;  // not exactly representable in binary

  /// Returns a lattice with the given basis (in periods). Every centre is shifted at random by up to the parameter, as
  /// a fraction of a period.
  static Specimen lattice(const std::array<int, 3>& cells, const std::vector<Vec3d>& basis) {
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<double> u(-GetParam() * a, GetParam() * a);
    Specimen s;
    s.box.size = {cells[0] * a, cells[1] * a, cells[2] * a};
    for (int i = 0; i < cells[0]; ++i)
      for (int j = 0; j < cells[1]; ++j)
        for (int k = 0; k < cells[2]; ++k)
          for (const Vec3d& b : basis)
            add(s, {(i + b.x) * a + u(engine), (j + b.y) * a + u(engine), (k + b.z) * a + u(engine)}, 0.4 * a);
    return s;
  }

  static void expect_every_eighth(const Specimen& s, const Tessellation& t) {
    // The lattice's centres are shifted by up to δ = GetParam(). Where two neighbouring facets are almost parallel to
    // the plane, the polygons of their cells may therefore overlap or leave a gap, in a strip about δ wide.
    const double tolerance = rounding + 10 * GetParam();
    for (const char axis : {'x', 'y', 'z'}) {
      const double length = s.box.size.*component(axis);
      const int parts = static_cast<int>(std::lround(8 * length / a));
      for (int k = 0; k <= parts; ++k)
        expect_partition(s, cut(s, t, {axis, k == parts ? length : k * a / 8}), tolerance);
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Shift, LatticeSection, testing::Values(0.0, 1e-15, 1e-13, 1e-11),
                         [](const auto& info) { return fmt::format("n{}", info.index); });

TEST_P(LatticeSection, SimpleCubic) {
  const std::array<int, 3> n{4, 5, 6};
  const Specimen s = lattice(n, {{0.5, 0.5, 0.5}});
  const Tessellation t = tessellate(s);
  expect_every_eighth(s, t);
  for (int k = 0; k <= n[2]; ++k) {  // planes through the facets show one layer of whole squares
    const CrossSection section = cut(s, t, {'z', k == n[2] ? s.box.size.z : k * a});
    EXPECT_EQ(section.cells.size(), static_cast<std::size_t>(n[0] * n[1])) << k;
    for (const SectionCell& c : section.cells) {
      EXPECT_EQ(c.particle % n[2], std::min(k, n[2] - 1));
      EXPECT_NEAR(c.area / (a * a), 1, 1e-12 + 10 * GetParam());
    }
  }
}

TEST_P(LatticeSection, BodyCentredCubic) {
  const Specimen s = lattice({3, 4, 3}, {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}});
  expect_every_eighth(s, tessellate(s));
}

TEST_P(LatticeSection, FaceCentredCubic) {
  const Specimen s =
      lattice({3, 3, 4}, {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}});
  expect_every_eighth(s, tessellate(s));
}

TEST_P(LatticeSection, LargeSlabsOverSmallCells) {
  // Facets between one large cell and many small cells lie in the plane, or are tilted against it by rounding.
  Specimen s = lattice({5, 5, 2}, {{0.5, 0.5, 0.5}});
  s.box.size.z = 10 * a;
  add(s, {2.5 * a, 2.5 * a, 6 * a}, 0.4 * a);
  expect_every_eighth(s, tessellate(s));
}

class RandomSection : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(RadiusRatio, RandomSection, testing::Values(1.0, 5.0, 50.0));

/// Chooses random points of the plane. For each point, finds the particle of smallest power distance by comparing all
/// particles. The polygon that contains the point must belong to this particle.
TEST_P(RandomSection, EveryPointBelongsToThePolygonOfTheNearestInPower) {
  const Specimen s = random_box(400, GetParam(), 5);
  const Tessellation t = tessellate(s);
  std::mt19937_64 engine(9);
  std::uniform_real_distribution<double> u(0, 1);
  for (const char axis : {'x', 'y', 'z'}) {
    const SectionPlane plane{axis, u(engine) * (s.box.size.*component(axis))};
    const CrossSection section = cut(s, t, plane);
    expect_partition(s, section, rounding);
    std::map<std::int32_t, const SectionCell*> cell;
    for (const SectionCell& c : section.cells) cell[c.particle] = &c;
    for (int k = 0; k < 500; ++k) {
      Vec3d x{u(engine) * s.box.size.x, u(engine) * s.box.size.y, u(engine) * s.box.size.z};
      x.*component(axis) = plane.position;
      std::int32_t owner = 0;
      double least = INFINITY;
      for (std::int32_t i = 0; i < static_cast<std::int32_t>(s.size()); ++i) {
        const Vec3d v = x - s.centre[i];
        const double power = dot(v, v) - s.radius[i] * s.radius[i];
        if (power < least) least = power, owner = i;
      }
      ASSERT_TRUE(cell.contains(owner)) << owner;
      const auto p = section.polygon(*cell[owner]);
      for (std::size_t e = 0; e < p.size(); ++e)
        EXPECT_GE(dot(cross(p[(e + 1) % p.size()] - p[e], x - p[e]), unit(axis)), -1e-13) << owner;
    }
  }
}

/// Cuts the tessellation at planes through its vertices, and at the walls, where the polygons must equal the facets of
/// the walls.
TEST_P(RandomSection, ThroughVerticesAndOnWalls) {
  const Specimen s = random_box(200, GetParam(), 6);
  const Tessellation t = tessellate(s);
  for (const char axis : {'x', 'y', 'z'}) {
    for (std::size_t v = 0; v < t.vertices.size(); v += 101)
      expect_partition(s, cut(s, t, {axis, t.vertices[v].*component(axis)}), rounding);
    for (int side = 0; side < 2; ++side) {
      std::map<std::int32_t, double> wall;
      for (const Facet& f : t.facets)
        if (f.b == -1 - (2 * (axis - 'x') + side)) wall[f.a] = f.area;
      const CrossSection section = cut(s, t, {axis, side * (s.box.size.*component(axis))});
      expect_partition(s, section, rounding);
      ASSERT_EQ(section.cells.size(), wall.size());
      for (const SectionCell& c : section.cells) EXPECT_NEAR(c.area, wall.at(c.particle), rounding);
    }
  }
}

TEST(CrossSection, PlanesAreReadAndRefused) {
  const Box box{{0.05, 0.05, 0.08}};
  EXPECT_EQ(read_section_plane("x=0.025", box).position, 0.025);
  EXPECT_EQ(read_section_plane("x=0", box).position, 0);
  const SectionPlane high = read_section_plane("z=80 mm", box);
  EXPECT_EQ(high.axis, 'z');
  EXPECT_EQ(high.position, 0.08);
  EXPECT_EQ(section_file_name({'x', 0.025}), "section_x_0.025.csv");
  for (const char* text : {"", "x", "x=", "=1", "x0.025", "x=left", "x=nan", "x=inf", "x=0.01 kg", "x=0.01,", "w=0.01",
                           "X=0.01", "x=-1e-9", "x=0.0500001", "y=25", "x==0.01"})
    EXPECT_THROW(read_section_plane(text, box), InputError) << text;
  EXPECT_HAS(message_of([&] { read_section_plane("y=25", box); }), "y = 25 m");
  EXPECT_HAS(message_of([&] { read_section_plane("y=25", box); }), "0 to 0.05 m");
  EXPECT_HAS(message_of([&] { read_section_plane("x=left", box); }), "x=left");
  Specimen s;
  s.box = box;
  add(s, {0.01, 0.01, 0.01}, 0.001);
  const Tessellation t = tessellate(s);
  EXPECT_THROW(cut(s, t, {'x', 0.06}), InputError);
  EXPECT_THROW(cut(s, t, {'x', NAN}), InputError);
  EXPECT_THROW(cut(s, t, {'w', 0.01}), InputError);
}

TEST(CrossSection, FileHasARowForEachVertex) {
  Specimen s = random_box(50, 2, 7);
  s.phase[3] = Phase::aggregate;
  s.body[3] = 12;
  const CrossSection section = cut(s, tessellate(s), {'z', s.centre[3].z});
  const fs::path file = fs::path(testing::TempDir()) / "cross_section_test.csv";
  write_cross_section_csv(file, s, section);
  const std::string text = read(file);
  fs::remove(file);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<long>(section.vertices.size()) + 1);
  EXPECT_EQ(text.substr(0, text.find('\n')), "particle,phase,body,x,y,z");
  const SectionCell& c =
      *std::find_if(section.cells.begin(), section.cells.end(), [](auto& k) { return k.particle == 3; });
  const Vec3d v = section.polygon(c)[0];
  EXPECT_HAS(text, fmt::format("\n3,aggregate,12,{},{},{}\n", v.x, v.y, v.z));
}

}  // namespace
}  // namespace macadam::test
