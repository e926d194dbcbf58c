// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_twin_test.cpp  Tests specimens made from scans: grains and voids stay at their places, and the scene runs.
#include "macadam/twin.hpp"

#include <algorithm>
#include <map>
#include <numbers>

#include "tests/tools/ct/ct_scenes.hpp"
#include "host/tools/ct/synthetic/void_spheres.hpp"
#include "host/network/clusters.hpp"
#include "macadam/phantom.hpp"

namespace macadam::test {
namespace {

constexpr double pi = std::numbers::pi;

class CtTwin : public CtFolder {
 protected:
  /// Writes a phantom of the scene and returns the folder of its exact phases and labels.
  fs::path truth_of(const Scene& scene, CoreShape shape = CoreShape::prism) const {
    PhantomSpec spec;
    spec.voxel = 0.2e-3;
    spec.air = 0.4e-3;
    spec.shape = shape;
    write_phantom(folder_ / "p", make_phantom(scene, spec), scene, spec);
    return folder_ / "p" / "truth";
  }
};

/// Returns volume and centroid of the spheres of each aggregate.
std::map<std::int32_t, std::pair<double, Vec3d>> bodies_of(const Specimen& s) {
  std::map<std::int32_t, std::pair<double, Vec3d>> out;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.phase[i] != Phase::aggregate) continue;
    auto& [volume, moment] = out[s.body[i]];
    const double v = 4 * pi / 3 * std::pow(s.radius[i], 3);
    volume += v;
    moment += v * s.centre[i];
  }
  for (auto& [body, sums] : out) sums.second = (1 / sums.first) * sums.second;
  return out;
}

/// A twin (the specimen made from a scan) has every grain and void of the original specimen at its place, with about
/// the same volumes and about the same modulus.
TEST_F(CtTwin, HasEveryGrainWhereItLayAndRuns) {
  const Scene scene = shapes_scene();
  const fs::path truth = truth_of(scene);
  const Specimen source = read_specimen_csv(truth / "specimen.csv", scene.specimen.box);
  const Twin twin = make_twin(truth, scene, {});
  const Vec3d size = scene.specimen.box.size;
  EXPECT_LT(norm(twin.specimen.box.size - size), 1e-9);  // the edges of the box are whole numbers of voxels
  EXPECT_LT(norm(twin.corner), 1e-9);
  const auto here = bodies_of(twin.specimen), there = bodies_of(source);
  ASSERT_EQ(here.size(), there.size());
  EXPECT_EQ(twin.lost, 0);
  for (const auto& [id, sums] : here) {  // labels count the aggregates from 1
    const auto& [volume, centre] = there.at(id - 1);
    EXPECT_LT(norm(sums.second - centre), 0.2e-3);
    EXPECT_NEAR(sums.first / volume, 1, 0.15);  // the volume is off by up to the last of about a dozen spheres
  }
  double air = 0, here_air = 0;
  for (const VoidSphere& v : source.voids) air += 4 * pi / 3 * std::pow(v.radius, 3);
  for (const VoidSphere& v : twin.specimen.voids) here_air += 4 * pi / 3 * std::pow(v.radius, 3);
  EXPECT_NEAR(here_air / air, 1, 0.03);  // the volume of air is counted in whole voxels
  EXPECT_EQ(twin.specimen.voids.size(), source.voids.size());
  const Twin without = make_twin(truth, scene, {.least_void = 1e-2});
  EXPECT_TRUE(without.specimen.voids.empty());
  EXPECT_DOUBLE_EQ(without.voids_left_out, twin.voids);
  const double mastic = (1 - 0.02) * (1 - twin.voids) - twin.aggregate;
  EXPECT_NEAR(twin.mastic, mastic, 2 * 4 * pi / 3 * std::pow(0.8e-3, 3) / scene.specimen.box.volume());

  write_twin(folder_ / "twin", twin, scene);
  const Scene made = read_scene(folder_ / "twin" / "scene.toml");
  EXPECT_EQ(made.specimen.file, folder_ / "twin" / "specimen.csv");
  EXPECT_EQ(made.cyclic().frequencies, scene.cyclic().frequencies);
  EXPECT_EQ(made.laws[0].has_value(), scene.laws[0].has_value());
  const auto modulus = [&](const fs::path& out, const Scene& s) {
    return run(s, out).harmonic().frequencies.front().stiffness;
  };
  const Stiffness a = modulus(folder_ / "a", scene), b = modulus(folder_ / "b", made);
  // With about 500 particles, other positions of the mastic spheres change |E*| by some per cent.
  EXPECT_NEAR(b.e_star_pa / a.e_star_pa, 1, 0.1);
  EXPECT_NEAR(b.phase_deg, a.phase_deg, 1.5);
}

/// If the twin is a part of the scan, grains that the box cuts are kept up to the cut.
TEST_F(CtTwin, OfABoxKeepsTheGrainsThatItCuts) {
  const Scene scene = shapes_scene();
  const fs::path truth = truth_of(scene);
  const Twin twin = make_twin(truth, scene, {.box = {{Vec3d{2e-3, 2e-3, 3e-3}, Vec3d{9e-3, 10e-3, 12e-3}}}});
  EXPECT_LT(norm(twin.specimen.box.size - Vec3d{7e-3, 8e-3, 9e-3}), 1e-12);
  EXPECT_GT(twin.grains, 2);
  double nearest = 1;
  for (std::size_t i = 0; i < twin.specimen.size(); ++i)
    if (twin.specimen.phase[i] == Phase::aggregate) nearest = std::min(nearest, twin.specimen.centre[i].x);
  EXPECT_LT(nearest, 0.8e-3);  // less than a radius from the cut
  EXPECT_NO_THROW(build_network(twin.specimen, tessellate(twin.specimen)));
}

TEST_F(CtTwin, GrainsAreSingleSpheresWhereTheSceneHasNoShapes) {
  Scene scene = shapes_scene();
  const fs::path truth = truth_of(scene);
  scene.specimen.shapes.reset();
  const Twin twin = make_twin(truth, scene, {});
  EXPECT_EQ(twin.clusters, 0);
  double volume = 0;
  for (const auto& [id, sums] : bodies_of(twin.specimen)) volume += sums.first;
  EXPECT_NEAR(volume / twin.specimen.box.volume(), twin.aggregate, 1e-9);
}

/// Mastic that a void encloses completely would not be connected to the specimen, so it is removed.
TEST_F(CtTwin, WhatVoidsEncloseIsTakenOut) {
  const Scene scene = shapes_scene();
  // A ball of mastic inside a shell of air.
  Image<std::uint8_t> phases({60, 60, 70}, {0.2e-3, 0.2e-3, 0.2e-3}, {0.1e-3, 0.1e-3, 0.1e-3},
                             static_cast<std::uint8_t>(VoxelPhase::mastic));
  for (std::int64_t k = 0; k < 70; ++k)
    for (std::int64_t j = 0; j < 60; ++j)
      for (std::int64_t i = 0; i < 60; ++i) {
        const double r = norm(phases.centre(i, j, k) - Vec3d{6e-3, 6e-3, 7e-3});
        if (r > 2.4e-3 && r < 4.4e-3) phases.at(i, j, k) = static_cast<std::uint8_t>(VoxelPhase::air_void);
      }
  write_image(folder_ / "phases.mha", phases);
  write_image(folder_ / "labels.mha", Image<std::uint32_t>::like(phases));
  std::vector<std::string> stages;
  const Twin twin = make_twin(folder_, scene, {}, [&](const std::string& stage, double) {
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
  });
  EXPECT_EQ(stages, (std::vector<std::string>{"reading the scan", "filling grains", "relaxing mastic", "tessellation",
                                              "removal of unconnected particles"}));
  EXPECT_GT(twin.enclosed_mastic, 5);  // the enclosed mastic has the volume of about 14 spheres of 0.7 mm
  EXPECT_EQ(twin.enclosed_aggregate, 0);
  for (const Vec3d& p : twin.specimen.centre) EXPECT_GT(norm(p - Vec3d{6e-3, 6e-3, 7e-3}), 3e-3);
  for (const Cluster& c : find_clusters(build_network(twin.specimen, tessellate(twin.specimen)), twin.specimen.size()))
    EXPECT_TRUE(c.spans());
}

TEST_F(CtTwin, RefusesWhatIsNoScan) {
  const Scene scene = shapes_scene();
  const auto message = [&](const fs::path& folder, const TwinSpec& spec) {
    return message_of([&] { make_twin(folder, scene, spec); });
  };
  EXPECT_HAS(message(folder_, {}), "phases.mha");
  const fs::path truth = truth_of(scene, CoreShape::cylinder);
  // the fraction of a square outside of its inscribed circle is 1 − π/4
  EXPECT_HAS(message(truth, {}), "outside of the specimen: found 21 %");
  EXPECT_HAS(message(truth, {.box = {{Vec3d{0, 0, 0}, Vec3d{1, 1, 1}}}}), "box");
  EXPECT_HAS(message(truth, {.box = {{Vec3d{5e-3, 5e-3, 5e-3}, Vec3d{4e-3, 6e-3, 6e-3}}}}), "box");
  EXPECT_EQ(message(truth, {.box = {{Vec3d{3e-3, 3e-3, 3e-3}, Vec3d{9e-3, 9e-3, 9e-3}}}}), "nothing was thrown");
  Scene counted = scene;
  counted.specimen.mastic->porosity.reset(), counted.specimen.mastic->count = 100;
  EXPECT_HAS(message_of([&] { make_twin(truth, counted, {}); }), "--porosity");
}

Image<std::uint8_t> mastic_image() {
  return {{40, 30, 30}, {1e-4, 1e-4, 1e-4}, {}, static_cast<std::uint8_t>(VoxelPhase::mastic)};
}

TEST(VoidSpheres, ARoundVoidIsOneSphere) {
  Image<std::uint8_t> image = mastic_image();
  const Vec3d centre{1.53e-3, 1.41e-3, 1.57e-3};
  std::int64_t n = 0;
  for (std::int64_t k = 0; k < 30; ++k)
    for (std::int64_t j = 0; j < 30; ++j)
      for (std::int64_t i = 0; i < 40; ++i)
        if (norm(image.centre(i, j, k) - centre) < 0.6e-3) image.at(i, j, k) = 0, ++n;
  image.at(39, 29, 29) = 0;  // a single voxel of noise
  const ct::VoidSpheres found = ct::void_spheres(image, 2e-4);
  ASSERT_EQ(found.spheres.size(), 1U);
  EXPECT_NEAR(4 * pi / 3 * std::pow(found.spheres[0].radius, 3), static_cast<double>(n) * 1e-12, 1e-20);
  EXPECT_LT(norm(found.spheres[0].centre - centre), 0.05e-3);
  EXPECT_NEAR(found.left_out, 1e-12, 1e-24);
}

/// The void consists of two cubes of 11 and 7 voxels, joined by a thin neck. Spheres that touch the faces of the cubes
/// have radii of 5.5 and 3.5 voxels. One common factor then scales both radii, so that the spheres have the volume of
/// the void.
TEST(VoidSpheres, InscribedSpheresReachTheFacesOfTheVoid) {
  Image<std::uint8_t> image = mastic_image();
  const auto carve = [&](std::array<std::int64_t, 3> low, std::array<std::int64_t, 3> size) {
    for (std::int64_t k = 0; k < size[2]; ++k)
      for (std::int64_t j = 0; j < size[1]; ++j)
        for (std::int64_t i = 0; i < size[0]; ++i) image.at(low[0] + i, low[1] + j, low[2] + k) = 0;
  };
  carve({4, 9, 9}, {11, 11, 11});
  carve({15, 14, 14}, {3, 1, 1});
  carve({18, 11, 11}, {7, 7, 7});
  const ct::VoidSpheres result = ct::void_spheres(image, 2e-4);
  ASSERT_EQ(result.spheres.size(), 2U);
  // depths are stored in single precision
  EXPECT_NEAR(result.spheres[0].radius / result.spheres[1].radius, 5.5 / 3.5, 1e-6);
  EXPECT_LT(norm(result.spheres[1].centre - image.centre(21, 14, 14)), 1e-9);
}

TEST(VoidSpheres, ALongVoidIsARowOfThem) {
  Image<std::uint8_t> image = mastic_image();
  for (std::int64_t k = 12; k < 18; ++k)
    for (std::int64_t j = 12; j < 18; ++j)
      for (std::int64_t i = 4; i < 36; ++i) image.at(i, j, k) = 0;
  const ct::VoidSpheres found = ct::void_spheres(image, 2e-4);
  EXPECT_GE(found.spheres.size(), 4U);
  EXPECT_LE(found.spheres.size(), 40U);
  double volume = 0;
  for (std::size_t k = 0; k < found.spheres.size(); ++k) {
    const VoidSphere& s = found.spheres[k];
    volume += 4 * pi / 3 * std::pow(s.radius, 3);
    EXPECT_TRUE(s.centre.y > 1.15e-3 && s.centre.y < 1.75e-3);
    EXPECT_TRUE(s.centre.z > 1.15e-3 && s.centre.z < 1.75e-3);
    // No centre lies within another sphere, so each sphere has a cell.
    for (std::size_t l = 0; l < k; ++l)
      EXPECT_GT(norm(s.centre - found.spheres[l].centre), 0.9 * std::max(s.radius, found.spheres[l].radius));
  }
  EXPECT_NEAR(volume / found.volume, 1, 1e-9);
}

}  // namespace
}  // namespace macadam::test
