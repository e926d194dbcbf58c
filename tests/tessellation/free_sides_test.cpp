// SPDX-License-Identifier: GPL-3.0-or-later
// free_sides_test.cpp  Tests how far free sides move, for motions whose lateral strain is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/network/free_sides.hpp"
#include "macadam/macadam.hpp"
#include "tests/support/test_spheres.hpp"

namespace macadam::test {
namespace {

using Motions = std::vector<std::array<double, 6>>;

/// Returns equal spheres at the centres of nx × ny × nz cubes that fill the box.
Specimen cubes(int nx, int ny, int nz, double side) {
  Specimen out;
  out.box.size = {nx * side, ny * side, nz * side};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i)
        add(out, {(i + 0.5) * side, (j + 0.5) * side, (k + 0.5) * side}, 0.5 * side, Phase::mastic, -1);
    }
  }
  return out;
}

Specimen core() {
  SpecimenSpec spec;
  spec.box = cylinder_domain(0.014, 0.013);
  spec.seed = 4;
  spec.aggregate = {{0.002, 0.00475, 0.35, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  return generate_specimen(spec).specimen;
}

/// Returns the motion of the particles at the sides: `displacement` of their centres, and the same rotation for all.
template <class F>
Motions moved(const Specimen& specimen, const FreeSides& sides, F&& displacement, const Vec3d& rotation = {}) {
  Motions out;
  for (const std::int32_t i : sides.particles()) {
    const Vec3d u = displacement(specimen.centre[static_cast<std::size_t>(i)]);
    out.push_back({u.x, u.y, u.z, rotation.x, rotation.y, rotation.z});
  }
  return out;
}

// Opposite sides of a lattice are moved by the spheres beside them, whose distance is (n - 1)/n of the edge.
TEST(FreeSides, OfALatticeMoveWithTheSpheresBesideThem) {
  constexpr int nx = 4, ny = 5, nz = 6;
  constexpr double side = 3e-3, along_x = 2e-4, along_y = -5e-5;
  const Specimen specimen = cubes(nx, ny, nz, side);
  const FreeSides sides(specimen, tessellate(specimen));
  ASSERT_TRUE(sides.known());
  EXPECT_EQ(sides.particles().size(), static_cast<std::size_t>((nx * ny - (nx - 2) * (ny - 2)) * nz));
  EXPECT_TRUE(std::ranges::is_sorted(sides.particles()));
  const auto stretched = [&](const Vec3d& x) { return Vec3d{along_x * x.x, along_y * x.y, 1e-3 * x.z}; };
  const double lateral = 0.5 * (along_x * (nx - 1) / nx + along_y * (ny - 1) / ny);
  // areas of facets are accurate to rounding errors
  EXPECT_NEAR(sides.contraction(moved(specimen, sides, stretched)) / (-lateral * specimen.box.size.z), 1, 1e-10);
}

// A rigid motion has no lateral strain: its outward displacement has no integral over the closed surface, and none over
// the sides, because the platens have normals along z. A rotation about an axis in the plane of the platens moves the
// sides along z and, at different heights, by opposite amounts; only the rotation about z is tested on cylinders.
TEST(FreeSides, OfARigidSpecimenDoNotContract) {
  for (const Specimen& specimen : {cubes(4, 5, 6, 3e-3), core()}) {
    const FreeSides sides(specimen, tessellate(specimen));
    ASSERT_TRUE(sides.known());
    const Vec3d turn{0, 0, 1e-3}, shift{1e-5, -2e-5, 3e-5};
    const auto rigid = [&](const Vec3d& x) { return shift + cross(turn, x); };
    // 1e-10 of the displacements, which are about 1e-5 m: the areas of the facets close the sides to rounding errors
    EXPECT_NEAR(sides.contraction(moved(specimen, sides, rigid, turn)), 0, 1e-15);
  }
}

// The curved side is the integral over its facets.
TEST(FreeSides, OfACylinderAreTheIntegralOverItsFacets) {
  const Specimen specimen = core();
  const Tessellation cells = tessellate(specimen);
  const FreeSides sides(specimen, cells);
  const Vec3d middle{0.007, 0.007, 0}, turn{2e-3, -1e-3, 3e-3};
  const auto widened = [&](const Vec3d& x) { return 1e-3 * Vec3d{x.x - middle.x, x.y - middle.y, 0}; };
  double outwards = 0, lost = 0;
  std::set<std::int32_t> particles;
  for (const Facet& f : cells.facets) {
    if (f.b != wall_x_lo || f.a >= static_cast<std::int32_t>(specimen.size())) continue;
    const Vec3d& centre = specimen.centre[static_cast<std::size_t>(f.a)];
    outwards += f.area * dot(f.normal, widened(centre) + cross(turn, f.centroid - centre));
    lost += f.area * dot(f.normal, widened(f.centroid));
    particles.insert(f.a);
  }
  EXPECT_EQ(sides.particles(), (std::vector<std::int32_t>{particles.begin(), particles.end()}));
  const double volume = specimen.box.volume(), height = specimen.box.size.z;
  EXPECT_NEAR(sides.contraction(moved(specimen, sides, widened, turn)) / (-0.5 * outwards / volume * height), 1, 1e-12);
  // If the side itself widens by 1e-3, the integral is that of the divergence, 2e-3, over the volume.
  EXPECT_NEAR(0.5 * lost / volume, 1e-3, 1e-12);
}

// Cells of voids do not count, and a side that only voids touch has no displacement.
TEST(FreeSides, NeedACellAtEverySide) {
  Specimen specimen = cubes(1, 1, 3, 3e-3);
  Tessellation cells = tessellate(specimen);
  ASSERT_TRUE(FreeSides(specimen, cells).known());
  std::erase_if(cells.facets, [](const Facet& f) { return f.b == wall_y_hi; });
  EXPECT_FALSE(FreeSides(specimen, cells).known());
}

}  // namespace
}  // namespace macadam::test
