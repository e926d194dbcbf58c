// SPDX-License-Identifier: GPL-3.0-or-later
// notch_scene_test.cpp  Tests scenes with notches: their keys, messages about wrong values, and prepared specimens.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "host/simulation/summary.hpp"
#include "macadam/macadam.hpp"
#include "tests/scene/scene_file.hpp"
#include "tests/support/test_files.hpp"

namespace macadam {
namespace {

using test::SceneFile, test::text_of;

struct NotchScene : SceneFile {
  /// Returns the valid scene, whose box is 20 x 20 x 30 mm, with the keys of a notch. A law joins all pairs.
  static std::string with(const std::string& notch) {
    return text_of({{9, "porosity = \"5 %\"\n[[specimen.notch]]\n" + notch}});
  }
};

TEST_F(NotchScene, KeysGiveTheRectangle) {
  const Scene scene =
      read(with("axis = \"x\"\nat = \"9 mm\"\ny = [\"0 mm\", 0.02]\nz = [-0.001, \"6 mm\"]\n"
                "[[specimen.notch]]\naxis = \"z\"\nat = 0.015\nx = [0.005, 0.015]"));
  ASSERT_EQ(scene.network.notches.size(), 2U);
  const Notch &first = scene.network.notches[0], &second = scene.network.notches[1];
  EXPECT_EQ(first.axis, 0);
  EXPECT_EQ(first.position, 0.009);
  EXPECT_EQ(first.low[1], 0);
  EXPECT_EQ(first.high[1], 0.02);
  EXPECT_EQ(first.low[2], -0.001);
  EXPECT_EQ(first.high[2], 0.006);
  EXPECT_EQ(first.line, 10);
  EXPECT_EQ(second.axis, 2);
  EXPECT_EQ(second.low[0], 0.005);
  EXPECT_TRUE(std::isinf(second.low[1]) && std::isinf(second.high[1]));
}

TEST_F(NotchScene, WrongKeysAreNamed) {
  EXPECT_HAS(message(with("at = 0.009")), "[[specimen.notch]] axis: found nothing");
  EXPECT_HAS(message(with("axis = \"x\"")), "[[specimen.notch]] at: found nothing");
  EXPECT_HAS(message(with("axis = \"w\"\nat = 0.009")), "\"x\", \"y\", \"z\"");
  EXPECT_HAS(message(with("axis = \"x\"\nat = 0.02")), "at: found 0.02 m, which is outside the specimen");
  EXPECT_HAS(message(with("axis = \"x\"\nat = 0.009\nx = [0, 0.01]")), "limits along the other two axes");
  EXPECT_HAS(message(with("axis = \"x\"\nat = 0.009\ny = [0.01, 0.005]")), "from less than to");
  EXPECT_HAS(message(with("axis = \"x\"\nat = 0.009\ny = [0.01]")), "two, [from, to]");
  EXPECT_HAS(message(with("axis = \"x\"\nat = 0.009\nwidth = 0.001")), "width");
}

// The scene lacks laws of some pairs, which a run would need; build_network() does not.
TEST_F(NotchScene, TheSummaryHasTheLigament) {
  const Scene scene = read(with("axis = \"x\"\nat = \"9 mm\"\nz = [0, \"6 mm\"]"));
  Preparation made;
  made.specimen = generate_specimen(scene.specimen).specimen;
  made.tessellation = tessellate(made.specimen);
  made.network = build_network(made.specimen, made.tessellation, scene.network);
  ASSERT_EQ(made.network.notches.size(), 1U);
  EXPECT_NEAR(made.network.notches[0].ligament / (0.02 * 0.024), 1, 1e-9);  // sums of some hundred facets
  const auto summary = nlohmann::json::parse(summary_json(scene, made, {}, "prepared"));
  EXPECT_EQ(summary.at("notches").at(0).at("ligament_m2"), made.network.notches[0].ligament);
}

}  // namespace
}  // namespace macadam
