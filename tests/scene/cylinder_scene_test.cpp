// SPDX-License-Identifier: GPL-3.0-or-later
// cylinder_scene_test.cpp  Tests scenes whose specimen is a cylinder or another domain: their keys, messages about
// wrong values, and the generated specimens.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "host/simulation/refused_combinations.hpp"
#include "host/specimen/generate.hpp"
#include "macadam/macadam.hpp"
#include "tests/scene/scene_file.hpp"
#include "tests/support/test_files.hpp"

namespace macadam {
namespace {

using test::SceneFile, test::text_of;

struct CylinderScene : SceneFile {
  /// Returns the valid scene with other keys in place of `box`.
  static std::string with(const std::string& keys, const std::string& network = "[network]") {
    return text_of({{2, keys}, {27, network}});
  }
  static std::string cylinder(const std::string& diameter, const std::string& height) {
    return "domain = \"cylinder\"\ndiameter = " + diameter + "\nheight = " + height;
  }
};

TEST_F(CylinderScene, DiameterAndHeightGiveTheDomain) {
  const Scene scene = read(with(cylinder("\"20 mm\"", "0.03")));
  EXPECT_STREQ(scene.specimen.box.name(), "cylinder");
  EXPECT_EQ(scene.specimen.box.size.x, 0.02);
  EXPECT_EQ(scene.specimen.box.size.y, 0.02);
  EXPECT_EQ(scene.specimen.box.size.z, 0.03);
  EXPECT_TRUE(read(with("domain = \"box\"\nbox = [0.02, 0.02, 0.03]")).specimen.box.is_box());
}

TEST_F(CylinderScene, TheKeysOfAShapeGiveItsDimensions) {
  const auto domain = [&](const std::string& keys) { return read(with(keys)).specimen.box; };
  const Domain disc = domain("domain = \"disc\"\nthickness = 0.02\ndiameter = \"30 mm\"");
  EXPECT_STREQ(disc.name(), "disc");
  EXPECT_EQ(norm(disc.size - Vec3d{0.03, 0.02, 0.03}), 0);
  EXPECT_EQ(norm(domain("domain = \"half_disc\"\ndiameter = 0.06\nthickness = 0.02").size - Vec3d{0.06, 0.02, 0.03}),
            0);
  EXPECT_EQ(
      norm(domain("domain = \"beam\"\nlength = 0.06\nwidth = 0.02\nheight = 0.03").size - Vec3d{0.06, 0.02, 0.03}), 0);
  const Domain trapezoid =
      domain("domain = \"trapezoid\"\nbase_width = 0.04\ntop_width = 0.02\nthickness = 0.025\nheight = 0.05");
  EXPECT_EQ(trapezoid.values(), (std::vector<double>{0.04, 0.02, 0.025, 0.05}));
  EXPECT_DOUBLE_EQ(trapezoid.volume(), 0.03 * 0.025 * 0.05);
}

TEST_F(CylinderScene, WrongKeysAreNamed) {
  EXPECT_HAS(message(with("domain = \"disc\"\ndiameter = 0.02")), "[specimen] thickness: found nothing");
  EXPECT_HAS(message(with("domain = \"disc\"\ndiameter = 0.02\nthickness = 0.03\nheight = 0.1")),
             "[specimen] height: found this key with domain = \"disc\", expected diameter and thickness");
  EXPECT_HAS(message(with("domain = \"beam\"\nlength = 0.02\nwidth = 0.03\nheight = 0.02")),
             "a length greater than width and height");
  EXPECT_HAS(
      message(with("domain = \"trapezoid\"\nbase_width = 0.02\ntop_width = 0.03\nthickness = 0.02\nheight = 0.02")),
      "a top width above 0 and at most the base width");
  EXPECT_HAS(message(with("box = [0.02, 0.02, 0.03]\nthickness = 0.02")),
             "[specimen] thickness: found this key without domain = \"disc\", \"half_disc\" or \"trapezoid\"");
  EXPECT_HAS(message(with("domain = \"disc\"\ndiameter = 0.02\nthickness = 0.009")),
             "less than the smaller of diameter and thickness, 0.009 m");
  EXPECT_HAS(message(with("domain = \"cylinder\"\nheight = 0.03")),
             "[specimen] diameter: found nothing, expected this key, which is required");
  EXPECT_HAS(message(with("domain = \"cylinder\"\ndiameter = 0.03")), "[specimen] height: found nothing");
  EXPECT_HAS(message(with(cylinder("-0.02", "0.03"))), "[specimen] diameter: found -0.02, expected a positive number");
  EXPECT_HAS(message(with(cylinder("0.02", "0"))), "[specimen] height: found 0, expected a positive number");
  EXPECT_HAS(message(with(cylinder("1e-200", "1e-200"))), "[specimen] height: found a volume of");
  EXPECT_HAS(message(with("domain = \"cylindre\"\nbox = [0.02, 0.02, 0.03]")), "\"cylinder\"");
  EXPECT_HAS(message(with(cylinder("0.02", "0.03") + "\nbox = [0.02, 0.02, 0.03]")),
             "[specimen] box: found this key with domain = \"cylinder\", expected diameter and height");
  EXPECT_HAS(message(with("box = [0.02, 0.02, 0.03]\ndiameter = 0.02")),
             "[specimen] diameter: found this key without domain = \"cylinder\"");
  EXPECT_HAS(message(with("domain = \"cylinder\"\nbox = [0.02, 0.02, 0.03]")), "[specimen] box: found this key");
  EXPECT_HAS(message(with(cylinder("0.009", "0.03"))), "less than the smaller of diameter and height, 0.009 m");
  EXPECT_HAS(message(with(cylinder("0.02", "0.03"), "[network]\nlateral_walls = true")),
             "[network] lateral_walls: found true with domain = \"cylinder\"");
  EXPECT_HAS(message(with("")), "[specimen] box: found nothing");
}

// Stress and strain of the tests are those of two platens with equal sections between them.
TEST_F(CylinderScene, TestsOfDomainsWithoutAUniformSectionAreRefused) {
  const auto refusal = [&](const std::string& keys) {
    return test::message_of([&] { require_combination(read(with(keys))); });
  };
  EXPECT_HAS(refusal("domain = \"disc\"\ndiameter = 0.02\nthickness = 0.02"),
             "kind in [loading]: found \"cyclic\" with domain = \"disc\" in [specimen]");
  EXPECT_HAS(refusal("domain = \"trapezoid\"\nbase_width = 0.04\ntop_width = 0.02\nthickness = 0.025\nheight = 0.05"),
             "with domain = \"trapezoid\"");
  require_combination(read(with("domain = \"beam\"\nlength = 0.06\nwidth = 0.02\nheight = 0.03")));
  require_combination(read(with(cylinder("0.02", "0.03"))));
}

SpecimenSpec small_mix(const Domain& domain, std::uint64_t seed) {
  SpecimenSpec spec;
  spec.box = domain;
  spec.seed = seed;
  spec.aggregate = {{0.002, 0.00475, 0.2, {}}, {0.00475, 0.0095, 0.2, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  return spec;
}

TEST_F(CylinderScene, ASpecimenFileGivesTheSameSpecimen) {
  const Domain domain = cylinder_domain(0.013, 0.012);
  const Specimen made = generate_specimen(small_mix(domain, 5)).specimen;
  const auto csv = folder_ / "core.csv";
  write_specimen_csv(csv, made);
  const Specimen read = read_specimen_csv(csv, domain);
  ASSERT_EQ(read.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(norm(read.centre[i] - made.centre[i]), 0);
    EXPECT_EQ(read.radius[i], made.radius[i]);
  }
  EXPECT_FALSE(read.box.is_box());
  // a narrower cylinder leaves spheres outside, and the message names the row
  EXPECT_HAS(test::message_of([&] { read_specimen_csv(csv, cylinder_domain(0.011, 0.012)); }), "core.csv:");
}

}  // namespace
}  // namespace macadam
