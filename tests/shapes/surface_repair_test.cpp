// SPDX-License-Identifier: GPL-3.0-or-later
// surface_repair_test.cpp  Tests the repair of faulty surfaces, and the limit on the change of volume and area.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <map>
#include <set>

#include "macadam/error.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

/// Repairs a surface and expects a good one of about the given volume.
SurfaceRepair repaired(const Surface& s, double volume, double tolerance, bool wrap = false) {
  SurfaceRepair repair;
  const Surface r = repair_surface(s, &repair, {}, wrap);
  EXPECT_EQ(r.name, s.name);
  EXPECT_TRUE(check_surface(r).good()) << check_surface(r).text();
  const ShapeMeasure measure = measure_shape(r);
  EXPECT_NEAR(measure.volume, volume, tolerance * volume) << repair.what;
  EXPECT_NEAR(repair.volume_after, measure.volume, 1e-12 * volume);
  EXPECT_NEAR(repair.area_after, measure.area, 1e-12 * measure.area);
  return repair;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RepairSurface, LeavesGoodOnesAsTheyAre) {
  const Surface s = lump(1, 2, {3, 2, 1}, 0.2);
  SurfaceRepair repair;
  const Surface r = repair_surface(s, &repair);
  EXPECT_EQ(r.facets, s.facets);
  EXPECT_EQ(repair.what, "nothing to do");
  EXPECT_EQ(repair.volume_after, repair.volume_before);
  EXPECT_EQ(repair.area_after, repair.area_before);
}

/// The volume before the repair includes the hole as if it were filled.
TEST(RepairSurface, FillsHoles) {
  Surface s = box_surface(1, 2, 3);
  s.facets.erase(s.facets.begin(), s.facets.begin() + 2);  // removes a face of 1 by 3
  const SurfaceRepair repair = repaired(s, 6, 1e-12);
  EXPECT_EQ(repair.what, "filled 1 hole with 2 facets, 14 % of the area");
  EXPECT_EQ(repair.changes(), "volume 6 m3 (before 6, +0.00 %), area 22 m2 (before 22, +0.00 %)");
}

TEST(RepairSurface, RefusesToGuessALargePart) {
  Surface s = box_surface(2, 2, 2);
  s.facets.erase(s.facets.begin(), s.facets.begin() + 6);  // removes three of six faces
  EXPECT_THROW(repair_surface(s), RunError);
  SurfaceRepair repair;
  EXPECT_TRUE(check_surface(repair_surface(s, &repair, {}, true)).good());
  EXPECT_GT(repair.filled, SurfaceRepair::most_filled);
}

TEST(RepairSurface, DropsClosedPores) {
  const Surface body = icosphere(3);
  const double volume = measure_shape(body).volume, area = measure_shape(body).area;
  for (const bool inward : {true, false}) {
    Surface pores =
        joined(mapped(icosphere(2), [](const Vec3d& p) { return 0.3 * p; }), moved(tetrahedron(0.1), {0.6, 0.1, 0.2}));
    for (auto& f : pores.facets) {
      if (inward) std::swap(f[1], f[2]);
    }
    const SurfaceRepair repair = repaired(joined(pores, body), volume, 1e-12);
    EXPECT_TRUE(contains(repair.what, "dropped 2 closed pores, 2.6 % of the volume and 8")) << repair.what;
    EXPECT_FALSE(contains(repair.what, "wrapped") || contains(repair.what, "turned")) << repair.what;
    EXPECT_NEAR(repair.volume_before, volume, 1e-12 * volume);
    EXPECT_NEAR(repair.area_before, area, 1e-12 * area);
  }
}

TEST(RepairSurface, TurnsFacets) {
  Surface s = icosphere(2);
  const double volume = measure_shape(s).volume;
  for (const int f : {3, 77, 78}) std::swap(s.facets[f][0], s.facets[f][2]);
  EXPECT_EQ(repaired(s, volume, 1e-12).what, "turned 3 facets");
  for (auto& f : s.facets) std::swap(f[0], f[2]);
  EXPECT_TRUE(contains(repaired(s, volume, 1e-12).what, "turned inside out"));
}

TEST(RepairSurface, JoinsRepeatedPointsAndDropsWhatIsNoFacet) {
  const Surface s = icosphere(1);
  Surface soup{"soup", {}, {}};
  for (const auto& f : s.facets) {
    const auto n = static_cast<std::int32_t>(soup.points.size());
    for (const auto p : f) soup.points.push_back(s.points[p]);
    soup.facets.push_back({n, n + 1, n + 2});
  }
  soup.facets.push_back({0, 1, 1});
  soup.facets.push_back(soup.facets[5]);
  EXPECT_EQ(check_surface(soup).open.size(), 79u);  // the repeated facet shares all edges with its copy
  const std::string what = repaired(soup, measure_shape(s).volume, 1e-12).what;
  EXPECT_TRUE(contains(what, "joined or dropped 198 points")) << what;
  EXPECT_TRUE(contains(what, "dropped 1 degenerate facet")) << what;
  EXPECT_TRUE(contains(what, "dropped 1 repeated facet")) << what;
}

TEST(RepairSurface, RefusesPointsThatAreNowhere) {
  Surface s = icosphere(1);
  s.points[3].y = std::nan("");
  EXPECT_THROW(repair_surface(s), InputError);
}

TEST(RepairSurface, DropsSpecksButDoesNotChooseBetweenBodies) {
  const Surface body = icosphere(2), speck = moved(tetrahedron(0.1), {2, 0, 0});
  const SurfaceRepair repair = repaired(joined(speck, body), measure_shape(body).volume, 1e-12);
  EXPECT_EQ(repair.what, "dropped 1 speck");
  EXPECT_NEAR(repair.volume_before - repair.volume_after, measure_shape(speck).volume, 1e-12);
  // A speck with 4 % of the area is too large to be removed without --wrap.
  const Surface larger = moved(tetrahedron(0.53), {2, 0, 0});
  EXPECT_THROW(repair_surface(joined(larger, body)), RunError);
  EXPECT_NO_THROW(repair_surface(joined(larger, body), nullptr, {}, true));
  try {
    repair_surface(joined(body, moved(body, {3, 0, 0})));
    ADD_FAILURE() << "chose";
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("icosphere: cannot be repaired: ", 0), 0u) << error.what();
    EXPECT_TRUE(contains(error.what(), "still 2 pieces")) << error.what();
  }
}

TEST(RepairSurface, WrapsWhatCutsItself) {
  // Two unit cubes that overlap by half have a union of volume 1.5 and area 8. The wrap lies outside of the union, at a
  // distance of about 1/1000 of the diagonal (1.8), which adds 0.014 to the volume. The wrap also rounds edges and
  // fills concave edges at a scale of 1/40 of the diagonal.
  const Surface s = joined(box_surface(1, 1, 1), moved(box_surface(1, 1, 1), {0.5, 0.01, 0.02}));
  EXPECT_FALSE(check_surface(s).self_intersecting.empty());
  const SurfaceRepair repair = repaired(s, 1.52, 0.03, true);
  EXPECT_TRUE(contains(repair.what, "wrapped")) << repair.what;
  EXPECT_NEAR(repair.volume_before, 2, 1e-12);  // the facets count the common part twice
  EXPECT_NEAR(repair.area_before, 12, 1e-12);
}

/// A wrap (a new skin around the surface) that changes the volume is refused unless `wrap` is set. The message states
/// the volumes before and after.
TEST(RepairSurface, RefusesAWrapThatChangesTheVolume) {
  const Surface s = joined(box_surface(1, 1, 1), moved(box_surface(1, 1, 1), {0.5, 0.01, 0.02}));
  try {
    repair_surface(s);
    ADD_FAILURE() << "wrapped";
  } catch (const RunError& error) {
    EXPECT_TRUE(contains(error.what(),
                         "box: the repair changes volume or area by more than 1 %; give --wrap to accept the repair: "))
        << error.what();
    EXPECT_TRUE(contains(error.what(), "wrapped")) << error.what();
    EXPECT_TRUE(contains(error.what(), "(before 2, -2")) << error.what();
  }
}

/// Two neighbouring points are exchanged, so that eight facets intersect. The wrap changes volume and area by less than
/// the limit, so the repair may wrap even if `wrap` is not set.
TEST(RepairSurface, WrapsASmallFaultUnasked) {
  Surface s = mapped(icosphere(4), [](const Vec3d& p) { return 5.0 * p; });
  std::swap(s.points[s.facets[100][0]], s.points[s.facets[100][1]]);
  SurfaceRepair repair;
  ASSERT_FALSE(check_surface(s).self_intersecting.empty());
  const Surface r = repair_surface(s, &repair);
  EXPECT_TRUE(check_surface(r).good());
  EXPECT_TRUE(contains(repair.what, "wrapped")) << repair.what;
  EXPECT_NEAR(repair.volume_after, repair.volume_before, 0.01 * repair.volume_before);
}

/// Returns the surface of unit cubes. Cubes that share only an edge or a point are pinched there.
Surface voxels(const std::set<std::array<int, 3>>& cubes) {
  Surface s{"voxels", {}, {}};
  std::map<std::array<int, 3>, std::int32_t> number;
  const auto point = [&](const std::array<int, 3>& p) {
    const auto [found, is_new] = number.try_emplace(p, static_cast<std::int32_t>(number.size()));
    if (is_new) s.points.push_back({0.1 * p[0], 0.1 * p[1], 0.1 * p[2]});
    return found->second;
  };
  for (const auto& cube : cubes) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beside = cube;
        beside[axis] += 2 * side - 1;
        if (cubes.contains(beside)) continue;
        std::array<std::int32_t, 4> corner;
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> p = cube;
          p[axis] += side, p[(axis + 1) % 3] += k == 1 || k == 2, p[(axis + 2) % 3] += k >= 2;
          corner[k] = point(p);
        }
        if (side == 0) std::swap(corner[1], corner[3]);
        s.facets.push_back({corner[0], corner[1], corner[2]});
        s.facets.push_back({corner[0], corner[2], corner[3]});
      }
    }
  }
  return s;
}

/// Repair splits a pinched vertex into two vertices at one position; reading the file merges them again. The surface
/// must be good after reading, too.
TEST(RepairSurface, IsGoodAsItIsReadBack) {
  const fs::path folder = fs::path(testing::TempDir()) / ("macadam_repair_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::set<std::array<int, 3>> at_an_edge{{0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}};
  const std::set<std::array<int, 3>> at_a_point{{0, 0, 0},  {1, 1, 1}, {0, 0, -1}, {1, 0, -1},
                                                {2, 0, -1}, {2, 0, 0}, {2, 0, 1},  {2, 1, 1}};
  for (const auto& [cubes, ending] : {std::pair{at_an_edge, "off"}, {at_an_edge, "stl"}, {at_a_point, "ply"}}) {
    const Surface s = voxels(cubes);
    EXPECT_FALSE(check_surface(s).non_manifold.empty());
    const fs::path file = folder / (std::string("stone.") + ending);
    SurfaceRepair repair;
    write_surface(file, repair_surface(s, &repair, file, true));
    EXPECT_TRUE(check_surface(read_surface(file)).good()) << check_surface(read_surface(file)).text();
    EXPECT_TRUE(contains(repair.what, "non-manifold point")) << repair.what;
    if (file.extension() == ".off") {  // the repair must also work without a file name
      write_surface(file, repair_surface(s, nullptr, {}, true));
      EXPECT_TRUE(check_surface(read_surface(file)).good());
    }
  }
  fs::remove_all(folder);
}

/// Two points of a good surface differ as doubles but are equal as floats, so facets between them would vanish in an
/// STL file. The repair takes the float numbers of STL into account.
TEST(RepairSurface, IsGoodInTheFilesOwnPrecision) {
  const Surface s = prism({{0, 0}, {1, 0.5}, {1, 0.5 + 1e-9}, {0.5, 1}}, 1);
  SurfaceRepair repair;
  const Surface off = repair_surface(s, &repair, "stone.off");
  EXPECT_EQ(repair.what, "nothing to do");
  EXPECT_EQ(off.facets, s.facets);
  const Surface stl = repair_surface(s, &repair, "stone.stl");
  EXPECT_TRUE(contains(repair.what, "good, but the written file would be read back with faults: ")) << repair.what;
  EXPECT_EQ(stl.points.size(), 6u) << repair.what;
  EXPECT_TRUE(check_surface(stl).good());
  for (const Vec3d& p : stl.points) EXPECT_EQ(p.x, static_cast<float>(p.x));
  Surface large = tetrahedron(1e40);
  EXPECT_THROW(repair_surface(large, &repair, "stone.stl"), InputError);
  EXPECT_THROW(write_surface("stone.stl", large), InputError);
}

TEST(RepairSurface, GivesUpWithTheVerdict) {
  const Surface line{"line", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(repair_surface(line), RunError);
}

}  // namespace
}  // namespace macadam::test
