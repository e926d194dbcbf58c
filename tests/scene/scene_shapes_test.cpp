// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_shapes_test.cpp  Tests that `[specimen.shapes]` is converted to the right SI values, and refused if it
/// is wrong.
#include <fmt/format.h>
#include <unistd.h>

#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

class SceneShapes : public testing::Test {
 protected:
  SceneShapes() : folder_(fs::path(testing::TempDir()) / fmt::format("macadam_shapes_{}", ::getpid())) {
    fs::create_directories(folder_ / "mine");
  }
  ~SceneShapes() override { fs::remove_all(folder_); }

  Scene scene(const std::string& shapes, const std::string& specimen = "") const {
    write(folder_ / "scene.toml", "[specimen]\nbox = [0.05, 0.05, 0.08]\n" + specimen +
                                      "[[specimen.aggregate]]\nsieve = [0.002, 0.008]\ncount = 10\n" + shapes +
                                      "[specimen.mastic]\nradius = [0.001, 0.002]\nporosity = 0.05\n" + am1_contacts +
                                      "[loading]\nkind = \"cyclic\"\nfrequencies = [10.0]\n");
    return read_scene(folder_ / "scene.toml");
  }
  std::string refused(const std::string& shapes, const std::string& specimen = "") const {
    return message_of([&] { scene(shapes, specimen); });
  }
  fs::path folder_;
};

TEST_F(SceneShapes, AreReadInSIUnits) {
  const ShapeSpec spec = *scene(R"([specimen.shapes]
library = "icosahedron"
radius = ["0.75 mm", "1.5 mm"]
porosity = "3 %"
least = 5
single = "volume"
placement = "insertion"
allow_short = true
test = "spheres"
hold_out = 2.5
)",
                                "spacing = \"0.1 mm\"\n")
                              .specimen.shapes;
  EXPECT_EQ(spec.library, ShapeSpec::Library::icosahedron);
  EXPECT_EQ(spec.fill.radius_min, 0.75e-3);
  EXPECT_EQ(spec.fill.radius_max, 1.5e-3);
  EXPECT_EQ(spec.fill.porosity, 0.03);
  EXPECT_EQ(spec.fill.least, 5);
  EXPECT_EQ(spec.fill.single, SingleSphere::volume);
  EXPECT_EQ(spec.placement, PlacementMethod::insertion);
  EXPECT_TRUE(spec.allow_short);
  EXPECT_EQ(spec.test, PlacementTest::spheres);
  EXPECT_EQ(spec.hold_out, 2.5);
  const std::string inserted = "[specimen.shapes]\nradius = [0.001, 0.002]\nplacement = \"insertion\"\n";
  EXPECT_EQ(scene(inserted, "spacing = \"0.1 mm\"\n").specimen.spacing, 1e-4);
  EXPECT_EQ(scene(inserted + "library = \"aggregates and icosahedron\"\n").specimen.shapes->library,
            ShapeSpec::Library::aggregates_and_icosahedron);
}

TEST_F(SceneShapes, HaveDefaults) {
  const ShapeSpec spec = *scene("[specimen.shapes]\nradius = [0.001, 0.002]\n").specimen.shapes;
  EXPECT_EQ(spec.library, ShapeSpec::Library::aggregates);
  EXPECT_EQ(spec.fill.porosity, FillSpec{}.porosity);
  EXPECT_EQ(spec.fill.least, 8);
  EXPECT_EQ(spec.fill.single, SingleSphere::intermediate);
  EXPECT_EQ(spec.placement, PlacementMethod::packing);
  EXPECT_FALSE(spec.allow_short);
  EXPECT_EQ(spec.test, PlacementTest::surfaces);
  EXPECT_EQ(spec.hold_out, 0);
  EXPECT_EQ(scene("").specimen.spacing, 0);
  EXPECT_FALSE(scene("").specimen.shapes);
}

TEST_F(SceneShapes, MayComeFromAFolderBesideTheScene) {
  const ShapeSpec spec = *scene("[specimen.shapes]\nradius = [0.001, 0.002]\nlibrary = \"mine\"\n").specimen.shapes;
  EXPECT_EQ(spec.library, ShapeSpec::Library::folder);
  EXPECT_EQ(spec.folder, folder_ / "mine");
}

TEST_F(SceneShapes, AreRefusedAtTheirLine) {
  const std::string start = "[specimen.shapes]\nradius = [0.001, 0.002]\n";
  EXPECT_HAS(refused("[specimen.shapes]\nleast = 3\n"), "radius");
  EXPECT_HAS(refused("[specimen.shapes]\nradius = [0.002, 0.001]\n"), "min not above max");
  EXPECT_HAS(refused(start + "library = \"yours\"\n"), "no folder");
  EXPECT_HAS(refused(start + "library = \"\\u0000\"\n"), "control character U+0000");
  EXPECT_HAS(refused(start + "library = \"stones\\u0000/..\"\n"), ":8: [specimen.shapes] library: found ");
  EXPECT_HAS(refused(start + "libary = \"mine\"\n"), "library");
  EXPECT_HAS(refused(start + "porosity = 1.0\n"), "porosity");
  EXPECT_HAS(refused(start + "least = 0\n"), "least");
  EXPECT_HAS(refused(start + "single = \"large\"\n"), "single");
  EXPECT_HAS(refused(start + "allow_short = true\n"), "insertion");
  EXPECT_HAS(refused(start + "placement = \"insertion\"\ngap = 0.1\n"), "packing");
  EXPECT_HAS(refused(start, "fix_aggregates = false\n"), "fix_aggregates");
  EXPECT_HAS(refused(start, "spacing = \"0.1 mm\"\n"), "gap in [specimen.shapes]");
  EXPECT_HAS(refused(start, "spacing = -1e-4\n"), "not negative");
  EXPECT_HAS(refused(start + "test = \"spheres\"\n"), "placement = \"insertion\"");
  EXPECT_HAS(refused(start + "test = \"hulls\"\n"), "surfaces");
  EXPECT_HAS(refused(start + "hold_out = 11\n"), "from 0 to 10");
  EXPECT_HAS(refused(start + "hold_out = -1\n"), "from 0 to 10");
  for (const char* gap : {"0.9", "0.5", "0", "-0.01", "nan"})
    EXPECT_HAS(refused(fmt::format("{}gap = {}\n", start, gap)), ":8:") << gap;
}

}  // namespace
}  // namespace macadam::test
