// SPDX-License-Identifier: GPL-3.0-or-later
// packing_check_test.cpp  Tests that a specimen that does not fill its box, or overfills it, gives a warning before a
// run.
#include "macadam/tessellation.hpp"

#include <numbers>
#include <random>

#include "tests/support/cluster_specimens.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

void add_mastic(Specimen& s, const Vec3d& centre, double radius) {
  s.centre.push_back(centre), s.radius.push_back(radius), s.phase.push_back(Phase::mastic), s.body.push_back(-1);
}

/// Returns touching spheres of radius 0.5 m in a box of nx × ny × nz m, shifted at random by up to 0.1 m.
Specimen touching(int nx, int ny, int nz, double radius = 0.5) {
  std::mt19937 random(3);
  const auto off = [&] { return 0.2 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  Specimen out;
  out.box.size = {1.0 * nx, 1.0 * ny, 1.0 * nz};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) add_mastic(out, {x + 0.5 + off(), y + 0.5 + off(), z + 0.5 + off()}, radius);
  return out;
}

/// Returns spheres of radius 1 m at random positions in a cube without overlap. They fill the fraction `fill` of the
/// cube.
Specimen random_spheres(double fill, std::size_t number, unsigned seed) {
  std::mt19937 random(seed);
  const double edge = std::cbrt(static_cast<double>(number) * 4 * std::numbers::pi / 3 / fill);
  const auto place = [&] { return 1 + (edge - 2) * (static_cast<double>(random()) / 4294967296.0); };
  Specimen out;
  out.box.size = {edge, edge, edge};
  while (out.size() < number) {
    const Vec3d c{place(), place(), place()};
    if (std::ranges::none_of(out.centre, [&](const Vec3d& other) { return norm(other - c) < 2; }))
      add_mastic(out, c, 1);
  }
  return out;
}

std::vector<std::string> warnings_of(const Specimen& s) { return packing_warnings(s, tessellate(s)); }

TEST(PackingCheck, ABoxTwiceAsHighNamesTheTopWall) {
  Specimen s = touching(5, 5, 6);
  EXPECT_TRUE(warnings_of(s).empty()) << testing::PrintToString(warnings_of(s));
  s.box.size.z *= 2;
  const auto found = warnings_of(s);
  ASSERT_EQ(found.size(), 1u) << testing::PrintToString(found);
  EXPECT_HAS(found[0], "the packing does not fill its box: the program treats the gap between particle 1");
  EXPECT_HAS(found[0], " and the +z wall as solid material");
  EXPECT_HAS(found[0], " reaches 6");  // 6 m above the spheres, measured to a corner of the facet
  EXPECT_HAS(found[0], "spheres fill 26.2 % of the box of 5 x 5 x 12 m");  // half of π/6
}

TEST(PackingCheck, ABoxTwiceAsWideNamesASide) {
  Specimen s = touching(5, 5, 6);
  s.box.size.x *= 2;
  const auto found = warnings_of(s);
  ASSERT_EQ(found.size(), 1u) << testing::PrintToString(found);
  EXPECT_HAS(found[0], " and the +x wall as solid material");
}

// The corners of the box are at least 3.7 m from the spheres of the cylinder.
TEST(PackingCheck, ACylinderInABoxIsFound) {
  const Specimen block = touching(18, 18, 6);
  Specimen s;
  s.box = block.box;
  for (const Vec3d& c : block.centre)
    if (std::hypot(c.x - 9, c.y - 9) < 8.5) add_mastic(s, c, 0.5);
  const auto found = warnings_of(s);
  ASSERT_EQ(found.size(), 1u) << testing::PrintToString(found);
  EXPECT_HAS(found[0], "the packing does not fill its box");
  EXPECT_HAS(found[0], " reaches 4.");
}

TEST(PackingCheck, DiametersForRadiiFillTooMuch) {
  Specimen s = touching(3, 3, 3, 1.0);
  const auto found = warnings_of(s);
  ASSERT_EQ(found.size(), 1u) << testing::PrintToString(found);
  EXPECT_EQ(
      found[0],
      "spheres fill 419 % of the box of 3 x 3 x 3 m, expected at most 150 %; the column radius may hold diameters");
}

// Spheres of one aggregate overlap. The check counts at most the volume of a sphere's cell, so the overlap is not
// counted twice.
TEST(PackingCheck, ClustersOfOverlappingSpheresAreNoFault) {
  Specimen s = few_clusters(1);
  EXPECT_TRUE(warnings_of(s).empty()) << testing::PrintToString(warnings_of(s));
  Specimen one = touching(3, 3, 3, 1.0);
  one.phase.assign(one.size(), Phase::aggregate);
  one.body.assign(one.size(), 0);
  EXPECT_TRUE(warnings_of(one).empty()) << testing::PrintToString(warnings_of(one));
}

// The smallest of these filled fractions is just above the limit below which a box counts as sparse. In such packings a
// cell reaches up to 6 radii, or 1.8 mean spacings, from the centre of its sphere.
TEST(PackingCheck, LoosePackingsAreNoFault) {
  for (const double fill : {0.101, 0.15, 0.25}) {
    for (const unsigned seed : {test_seed(), test_seed() + 1}) {
      const Specimen s = random_spheres(fill, 600, seed);
      EXPECT_TRUE(warnings_of(s).empty()) << fill << " " << seed << testing::PrintToString(warnings_of(s));
    }
  }
}

// A layer of large spheres lies below a layer of small spheres. The gaps between the large spheres are many mean
// spacings wide. This is not a fault.
TEST(PackingCheck, LayersOfDifferentSizesAreNoFault) {
  Specimen s = touching(4, 4, 2);
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) add_mastic(s, {0.05 + 0.1 * x, 0.05 + 0.1 * y, 2.15 + 0.1 * z}, 0.05);
  s.box.size.z = 3.1;
  EXPECT_TRUE(warnings_of(s).empty()) << testing::PrintToString(warnings_of(s));
}

TEST(PackingCheck, EverySceneOfTheExamplesThatIsSmallFillsItsBox) {
  for (const char* name : {"demo", "mastic", "stepped_creep", "aggregate_cube", "study"}) {
    const Preparation made = prepare(read_scene(fs::path(MACADAM_EXAMPLES) / name / "scene.toml"));
    const auto found = packing_warnings(made.specimen, made.tessellation);
    EXPECT_TRUE(found.empty()) << name << testing::PrintToString(found);
  }
}

using PackingCheckOfCommands = Program;

TEST_F(PackingCheckOfCommands, WarnBeforeTheRunAndInTheSummary) {
  write_specimen_csv(folder_ / "pack.csv", touching(4, 4, 5));
  write(folder_ / "scene.toml",
        "[specimen]\nfile = \"pack.csv\"\nbox = [4.0, 4.0, 10.0]\n[materials.mastic]\ndensity = 2000.0\n"
        "[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = 1e9\nalpha = 0.1\n"
        "[[contacts]]\npair = \"M-W\"\nlaw = \"elastic\"\nE = 1e9\nalpha = 0.0\n"
        "[loading]\nkind = \"cyclic\"\nfrequencies = [1.0]\n[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n");
  const std::string sentence = "the packing does not fill its box: ";
  const Outcome check = macadam("check " + path("scene.toml"));
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_HAS(check.out, sentence);
  const Outcome json = macadam("check --json " + path("scene.toml"));
  EXPECT_HAS(nlohmann::json::parse(json.out).at("warnings").at(0).get<std::string>(), sentence);
  const Outcome specimen = macadam("specimen " + path("scene.toml") + " --out " + path("specimen"));
  EXPECT_HAS(specimen.out, "warning: " + sentence);
  EXPECT_HAS(summary("specimen").at("warnings").at(0).get<std::string>(), sentence);
  const Outcome run = macadam("run " + path("scene.toml") + " --out " + path("run"));
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_HAS(run.err, "macadam: warning: " + sentence);  // printed before the run
  EXPECT_HAS(run.out, "warning: " + sentence);           // printed with its results
  EXPECT_HAS(summary("run").at("warnings").at(0).get<std::string>(), sentence);
}

}  // namespace
}  // namespace macadam::test
