// SPDX-License-Identifier: GPL-3.0-or-later
// bending_test.cpp  Tests the bending test: the theory of beams, the rollers, and the modulus of a homogeneous beam,
// which is known.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "host/experiments/cyclic/beam_theory.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/macadam.hpp"
#include "tests/scene/scene_file.hpp"
#include "tests/support/test_files.hpp"

namespace macadam {
namespace {

constexpr double length = 0.08, width = 0.012, height = 0.012;

// Textbooks have the deflection at midspan under two forces F/2 at the distance a from the supports:
// F·a·(3L² − 4a²)/(48·E·I) by bending and F·a/(2·k·G·A) by shear. It is that of one force F at a.
TEST(UnitDeflection, IsThatOfThreeAndFourPoints) {
  const double span = 0.072, ratio = 0.35, second_moment = width * std::pow(height, 3) / 12;
  const double k = 10 * (1 + ratio) / (12 + 11 * ratio), e_over_g = 2 * (1 + ratio);
  const UnitDeflection unit(0.004, 0.076, 0.04, width, height, ratio);
  for (const double a : {span / 2, span / 3, span / 10}) {
    const double expected =
        a * (3 * span * span - 4 * a * a) / (48 * second_moment) + a * e_over_g / (2 * k * width * height);
    EXPECT_NEAR(unit.deflection(0.004 + a) / expected, 1, 1e-12);
    EXPECT_NEAR(unit.deflection(0.076 - a) / expected, 1, 1e-12);
  }
  EXPECT_NEAR(unit.deflection(0.004) / unit.deflection(0.04), 0, 1e-12);
  EXPECT_NEAR(unit.deflection(0.076) / unit.deflection(0.04), 0, 1e-12);
}

// By Maxwell's theorem the deflection at one place under a force at another place is the same if both are exchanged.
TEST(UnitDeflection, IsReciprocal) {
  const UnitDeflection one(0, 1, 0.3, 0.1, 0.2, 0.2), other(0, 1, 0.8, 0.1, 0.2, 0.2);
  EXPECT_NEAR(one.deflection(0.8) / other.deflection(0.3), 1, 1e-12);
}

// A Poisson's ratio of −12/11 would make the shear vanish, so that the slope is the derivative of the deflection. A
// central difference over 2e-6 has an error of 1e-12 relative to the slope's scale, and of 1e-10 by rounding.
TEST(UnitDeflection, HasASlope) {
  const UnitDeflection unit(0.1, 1.1, 0.4, 0.1, 0.2, -12.0 / 11);
  const double scale = unit.slope(0.1), step = 1e-6;
  for (const double x : {-0.2, 0.05, 0.2, 0.3, 0.5, 0.9, 1.15, 1.5}) {
    const double difference = (unit.deflection(x + step) - unit.deflection(x - step)) / (2 * step);
    EXPECT_NEAR(difference / scale, unit.slope(x) / scale, 1e-8) << x;
  }
  EXPECT_EQ(unit.slope(-0.2), unit.slope(0.1));  // the beam is straight beyond its supports
  EXPECT_EQ(unit.slope(1.5), unit.slope(1.1));
}

struct Bending : test::SceneFile {
  /// Returns a scene whose particles all have one law with the modulus 2e10 Pa. `network`: other text of `[network]`.
  static std::string text(const std::string& domain, const std::string& loading, const std::string& network = "") {
    return "[specimen]\n" + domain +
           "[specimen.mastic]\nradius = [0.0007, 0.0009]\nporosity = 0.05\n"
           "[materials.aggregate]\ndensity = 2000\nlaw = \"elastic\"\nE = 2e10\npoisson_ratio = 0\n"
           "[materials.mastic]\ndensity = 2000\nlaw = \"elastic\"\nE = 2e10\npoisson_ratio = 0\n[network]\n" +
           (network.empty() ? "rule = \"series\"\nquadrature = \"exact\"\n" : network) + "[loading]\n" + loading +
           "[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n";
  }
  static std::string beam() { return "domain = \"beam\"\nlength = 0.08\nwidth = 0.012\nheight = 0.012\n"; }
  static std::string kind(const std::string& keys = "") { return "kind = \"bending\"\nfrequencies = [1.0]\n" + keys; }
  /// Returns the message with which a scene is refused.
  std::string refusal(const std::string& scene) const {
    return test::message_of([&] { require_combination(read(scene)); });
  }
};

TEST_F(Bending, PlacesTheRollers) {
  const auto rollers = [&](const std::string& keys) { return *read(text(beam(), kind(keys))).specimen.box.rollers(); };
  const domains::Rollers four = rollers("");  // a span of 72 mm, and a third of it
  ASSERT_EQ(four.bottom.size(), 2U);
  ASSERT_EQ(four.top.size(), 2U);
  EXPECT_NEAR(four.bottom[0], 0.004, 1e-15);
  EXPECT_NEAR(four.bottom[1], 0.076, 1e-15);
  EXPECT_NEAR(four.top[0], 0.028, 1e-15);
  EXPECT_NEAR(four.top[1], 0.052, 1e-15);
  EXPECT_NEAR(four.width, 0.04 * 0.072, 1e-15);
  const domains::Rollers three = rollers("rollers = 3\nspan = 0.06\nroller_width = \"2 mm\"\n");
  EXPECT_EQ(three.top, std::vector<double>{0.5 * length});
  EXPECT_NEAR(three.bottom[0], 0.01, 1e-15);
  EXPECT_NEAR(three.width, 0.002, 1e-15);
  EXPECT_EQ(read(text(beam(), "kind = \"sweep\"\nfrequencies = [1.0]\n")).specimen.box.rollers(), nullptr);
}

// A facet of the walls −z and +z is a contact if its centroid lies within a roller. No other wall has contacts.
TEST_F(Bending, OnlyFacetsWithinRollersAreContacts) {
  const Preparation prepared =
      prepare(read(text(beam(), kind("span = 0.06\ninner_span = 0.03\nroller_width = 0.003\n"))));
  double within = 0, contacts = 0, all = 0;
  for (const Facet& f : prepared.tessellation.facets) {
    if (f.b != wall_z_lo && f.b != wall_z_hi) continue;
    all += f.area;
    const double from_middle = std::abs(f.centroid.x - 0.5 * length), roller = f.b == wall_z_lo ? 0.03 : 0.015;
    if (std::abs(from_middle - roller) <= 0.0015) within += f.area;
  }
  for (const Contact& c : prepared.network.contacts) {
    EXPECT_TRUE(c.b >= 0 || c.b <= wall_z_lo) << c.b;
    if (c.b < 0) contacts += c.area;
  }
  EXPECT_NEAR(contacts, within, 1e-15);  // rounding, in m²
  EXPECT_NEAR(all / (2 * length * width), 1, 1e-10);
  EXPECT_NEAR(within / (4 * 0.003 * width), 1, 0.3);  // some 15 facets on each roller
}

TEST_F(Bending, ARollerWithoutParticlesIsNamed) {
  const std::string message =
      test::message_of([&] { prepare(read(text(beam(), kind("rollers = 3\nroller_width = 1e-7\n")))); });
  EXPECT_NE(message.find("the roller at x = 0.004 m on the wall -z, which is 1e-07 m wide, touches no particle"),
            std::string::npos)
      << message;
}

// A homogeneous beam without lateral contraction has the modulus of its material. Timoshenko's theory neglects the
// stresses near the rollers: plane finite elements of this beam give 0.2 % (four rollers) and 0.5 % (three) too much by
// the same formulas, and 13 to 30 % too much without the moments of the rollers. The larger part of the tolerance is
// for the positions of the few particles: 7 over the height, and some tens in the boxes where the deflection is
// measured.
TEST_F(Bending, GivesTheModulusOfAHomogeneousBeam) {
  for (const std::string rollers : {"rollers = 3\n", "rollers = 4\n"}) {
    const Scene scene = read(text(beam(), kind(rollers + "poisson_ratio = 0.0\n")));
    const RunResult found = run(scene, folder_ / "out");
    const auto& points = std::get<experiments::SweepResult>(found.found).points;
    ASSERT_EQ(points.size(), 1U);
    EXPECT_NEAR(points[0].stiffness.e_star_pa / 2e10, 1, 0.05) << rollers;
    EXPECT_NEAR(points[0].bottom.e_star_pa / points[0].stiffness.e_star_pa, 1, 1e-9);
    EXPECT_FALSE(points[0].poisson_ratio);
    ASSERT_TRUE(points[0].beam);
    // the rollers sink in, so they approach each other by more than the deflection
    EXPECT_GT(points[0].beam->midspan.real(), 0);
    if (rollers == "rollers = 3\n") { EXPECT_GT(points[0].beam->rollers.real(), points[0].beam->midspan.real()); }
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "bending.csv"));
  }
}

// With one viscoelastic law everywhere, E* has the phase of the law, and the deflection lags behind the force by it.
// The residual of 1e-11 leaves six digits of the deflection.
TEST_F(Bending, HasThePhaseOfTheLaw) {
  const std::string law = "law = \"generalised_kelvin\"\nE_m = 2e10\nC_m = 1e10\nE = [1e9]\nC = [1e9]\nalpha = 0.3\n";
  std::string contacts;
  for (const std::string pair : {"M-M", "M-W"}) contacts += "[[contacts]]\npair = \"" + pair + "\"\n" + law;
  const Scene scene = read("[specimen]\n" + beam() +
                           "[specimen.mastic]\nradius = [0.0009, 0.0012]\nporosity = 0.05\n"
                           "[materials.aggregate]\ndensity = 2000\n[materials.mastic]\ndensity = 2000\n" +
                           contacts + "[loading]\n" + kind() + "[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n");
  const RunResult found = run(scene, folder_ / "out");
  const auto& point = std::get<experiments::SweepResult>(found.found).points.at(0);
  const std::complex<double> s(0, 2 * std::numbers::pi);
  const double phase = std::arg(1.0 / (1 / 2e10 + 1.0 / (1e10 * s) + 1.0 / (1e9 + 1e9 * s))),
               degree = std::numbers::pi / 180;
  EXPECT_GT(phase, 0.3);
  EXPECT_NEAR(point.stiffness.phase_deg * degree, phase, 1e-6);
  ASSERT_TRUE(point.beam);
  EXPECT_NEAR(std::arg(point.beam->midspan), -phase, 1e-6);
  EXPECT_NEAR(std::arg(point.beam->rollers), -phase, 1e-6);
}

TEST_F(Bending, RefusesOtherDomainsAndRules) {
  const std::string box = "box = [0.01, 0.01, 0.01]\n";
  const auto expect = [&](const std::string& scene, const std::string& words) {
    const std::string message = refusal(scene);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect(text(box, kind()), "domain in [specimen] with kind \"bending\": found \"box\", expected \"beam\"");
  expect(text(beam(), kind(), "rule = \"series\"\nlateral_walls = true\n"), "lateral_walls");
  expect(text(beam(), kind(), "rule = \"volumetric\"\n"), "volumetric");
  expect(text(beam(), kind()) + "[output]\nsensitivities = true\n", "sensitivities");
  expect(text(beam(), kind("poisson_ratio = 0.5\n")), "below 0.5");

  // a calibration would compare the modulus of a column
  const Scene scene = read(text(beam(), kind()));
  ModulusData data;
  data.points = {{1, 1e9, 0, 0, 0, 0}};
  EXPECT_NE(test::message_of([&] { calibrate(scene, data, {}); }).find("found \"bending\", expected \"cyclic\""),
            std::string::npos);
}

TEST_F(Bending, RefusesRollersThatDoNotFit) {
  const auto expect = [&](const std::string& keys, const std::string& words) {
    const std::string refused = message(text(beam(), kind(keys)));
    EXPECT_NE(refused.find(words), std::string::npos) << refused;
  };
  expect("rollers = 5\n", "from 3 to 4");
  expect("span = 0.079\nroller_width = 0.002\n", "span: found 0.079 m, expected at most 0.078 m");
  expect("span = 0.1\n", "span: found 0.1 m, expected at most 0.076 m");
  expect("roller_width = 0.009\n", "roller_width: found 0.009 m, expected at most 0.008 m");
  expect("span = 0.02\nroller_width = 0.006\n", "roller_width: found 0.006 m, expected at most 0.005 m");
  expect("span = 0.06\ninner_span = 0.06\n", "inner_span: found 0.06 m, expected 0.0024 to 0.0552 m");
  expect("inner_span = 0.001\n", "inner_span: found 0.001 m");
  expect("rollers = 3\ninner_span = 0.02\n", "inner_span: found 0.02 m, expected no such key");
  expect("roller_width = -0.001\n", "a positive number");
}

}  // namespace
}  // namespace macadam
