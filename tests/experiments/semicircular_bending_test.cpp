// SPDX-License-Identifier: GPL-3.0-or-later
// semicircular_bending_test.cpp  Tests the results of a half disc that is bent until it fails: those of a known curve,
// those of a small half disc with cracks, its rollers, and the scenes that are refused.
#include <numbers>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/experiments/transient/half_disc_strength.hpp"
#include "host/experiments/transient/load_curve.hpp"
#include "host/simulation/refused_combinations.hpp"
#include "macadam/macadam.hpp"
#include "tests/scene/scene_file.hpp"
#include "tests/support/test_files.hpp"

namespace macadam {
namespace {

constexpr double diameter = 0.15, radius = 0.075, thickness = 0.05, notch = 0.015, at_peak = 1e-3;
constexpr BottomNotch in_middle{notch, true, radius - notch};

/// Returns a half disc whose lower rollers have this distance, as a part of the diameter.
Domain half_disc(double span = 0.8) {
  Domain out = domain_of("half_disc", {diameter, thickness});
  out.set_rollers({{radius * (1 - span), radius * (1 + span)}, {radius}, 0.005});
  return out;
}

/// Returns 3,000 samples of a curve. `load(x)`: load [N] at the displacement x, which is in units of `at_peak`.
template <class Load>
std::vector<StressSample> curve_of(double end, const Load& load) {
  std::vector<StressSample> out;
  const double section = section_area(half_disc());
  for (int k = 1; k <= 3000; ++k) {
    const double x = end * k / 3000;
    out.push_back({-x * at_peak / radius, -load(x) / section});
  }
  return out;
}

/// Returns the curve of a load that grows evenly until `at_peak`, and then falls evenly as if it were to vanish at
/// 3·at_peak, until the displacement end·at_peak.
std::vector<StressSample> triangle(double largest, double end = 3) {
  return curve_of(end, [largest](double x) { return largest * (x < 1 ? x : (3 - x) / 2); });
}

experiments::FittedPeak peak_at(double load) { return {-at_peak / radius, -load / section_area(half_disc()), 0}; }

// The triangle's work until 100 N is its area without a tip of 100 N·(2·at_peak·100 N/load)/2. The last sample is at
// most one interval of 1 µm beyond.
TEST(HalfDiscStrength, IsThatOfATriangle) {
  const double load = 3000;
  const experiments::HalfDiscStrength found = half_disc_strength(triangle(load), peak_at(load), half_disc(), in_middle);
  EXPECT_NEAR(found.load_n, load, 1e-9);
  EXPECT_NEAR(found.displacement_m, at_peak, 1e-15);
  const double tip = 0.5 * 100 * (2 * at_peak * 100 / load), work = 1.5 * load * at_peak - tip;
  EXPECT_NEAR(found.work_j, work, 100 * 1e-6);
  EXPECT_DOUBLE_EQ(found.fracture_energy_j_m2, found.work_j / 0.003);  // a ligament of 60 times 50 mm
  ASSERT_TRUE(found.flexibility_index);
  EXPECT_NEAR(*found.slope_n_m, 1.5e6, 1.5e-3);  // 3 kN over 2 mm; rounding of sums of positions
  EXPECT_NEAR(*found.flexibility_index, 0.01 * found.fracture_energy_j_m2 / 1.5, 1e-6);
  ASSERT_TRUE(found.strength_pa && found.toughness_pa_sqrt_m);
  EXPECT_NEAR(*found.strength_pa, 1.7052e6, 1);  // 4.263·3000/(0.15·0.05)
  // Y = 4.782 − 1.219·0.2 + 0.063·e^1.409 = 4.79599, times 4e5 Pa·√(π·0.015 m)
  EXPECT_NEAR(*found.toughness_pa_sqrt_m, 416445.9, 5);
}

// The formula of the ISRM (Kuruppu et al. 2014) was found by other computations: Y = −1.297 + 9.516·s − (0.47 +
// 16.457·s)·x + (1.071 + 34.401·s)·x² for the span s over the diameter and the notch x over the radius. Both agree
// within 2 % in its range.
TEST(HalfDiscStrength, HasTheToughnessOfAnotherFormula) {
  const double load = 3000, s = 0.8;
  for (const double x : {0.2, 0.4, 0.6}) {
    const double factor = -1.297 + 9.516 * s - (0.47 + 16.457 * s) * x + (1.071 + 34.401 * s) * x * x;
    const double expected = factor * load / (diameter * thickness) * std::sqrt(std::numbers::pi * x * radius);
    const auto found =
        half_disc_strength(triangle(load), peak_at(load), half_disc(), {x * radius, true, (1 - x) * radius});
    EXPECT_NEAR(*found.toughness_pa_sqrt_m / expected, 1, 0.02) << x;
  }
}

// A small specimen may bear less than 1 kN. Its work counts until a tenth of the largest load.
TEST(HalfDiscStrength, CountsTheWorkOfSmallLoads) {
  const double load = 90, tip = 0.5 * 0.1 * load * (0.2 * at_peak);
  const experiments::HalfDiscStrength found = half_disc_strength(triangle(load), peak_at(load), half_disc(), in_middle);
  EXPECT_NEAR(found.work_j, 1.5 * load * at_peak - tip, 0.1 * load * 1e-6);
}

TEST(HalfDiscStrength, NeedsTheNotchAndTheSpanOfTheStandards) {
  const double load = 3000;
  const auto samples = triangle(load);
  const auto found = [&](double span, const BottomNotch& of) {
    return half_disc_strength(samples, peak_at(load), half_disc(span), of);
  };
  const experiments::HalfDiscStrength whole = found(0.8, {0, true, radius});
  EXPECT_TRUE(whole.strength_pa);
  EXPECT_FALSE(whole.toughness_pa_sqrt_m);
  EXPECT_DOUBLE_EQ(whole.fracture_energy_j_m2, whole.work_j / (radius * thickness));
  const experiments::HalfDiscStrength beside = found(0.8, {notch, false, radius - notch});
  EXPECT_TRUE(beside.strength_pa && beside.flexibility_index);
  EXPECT_FALSE(beside.toughness_pa_sqrt_m);
  EXPECT_TRUE(found(0.807, in_middle).toughness_pa_sqrt_m);
  const experiments::HalfDiscStrength narrow = found(0.6, in_middle);
  EXPECT_FALSE(narrow.strength_pa || narrow.toughness_pa_sqrt_m);
  EXPECT_TRUE(narrow.flexibility_index);
}

TEST(HalfDiscStrength, HasNoIndexIfTheLoadHardlyFalls) {
  const double load = 3000;
  const experiments::HalfDiscStrength found =
      half_disc_strength(triangle(load, 1.9), peak_at(load), half_disc(), in_middle);
  EXPECT_FALSE(found.slope_n_m || found.flexibility_index);
  EXPECT_TRUE(found.toughness_pa_sqrt_m);
}

// The load falls slowly, then by 1500 N over half of the displacement at the largest load, then slowly again. A window
// that is wider than the steep part also contains slow parts.
TEST(LoadCurve, FindsTheSteepestFall) {
  const double load = 3000;
  const auto samples = curve_of(3, [load](double x) {
    if (x < 1) return load * x;
    if (x < 1.5) return load - 200 * (x - 1);
    return x < 2 ? load - 100 - 3000 * (x - 1.5) : load - 1600 - 200 * (x - 2);
  });
  const LoadCurve curve(samples, peak_at(load), half_disc());
  ASSERT_TRUE(curve.steepest_fall(0.1 * at_peak));
  EXPECT_NEAR(*curve.steepest_fall(0.1 * at_peak) * at_peak, 3000, 1e-6);
  EXPECT_NEAR(*curve.steepest_fall(at_peak) * at_peak, 1600, 1e-6);
  EXPECT_FALSE(curve.steepest_fall(2.1 * at_peak));
  EXPECT_FALSE(curve.steepest_fall(0));
  ASSERT_TRUE(curve.displacement_at(0.5));
  EXPECT_NEAR(*curve.displacement_at(0.5) / at_peak, 1.5 + 1400.0 / 3000, 1e-9);
  EXPECT_FALSE(curve.displacement_at(0.1));
}

TEST(BottomNotch, IsOneCutFromTheFlatSide) {
  Notch cut;
  cut.position = radius, cut.low[2] = 0, cut.high[2] = notch;
  const auto found = [](const std::vector<Notch>& notches) { return bottom_notch(half_disc(), notches); };
  ASSERT_TRUE(found({}));
  EXPECT_EQ(found({})->length, 0);
  ASSERT_TRUE(found({cut}));
  EXPECT_EQ(found({cut})->length, notch);
  EXPECT_TRUE(found({cut})->in_middle);
  EXPECT_FALSE(found({cut, cut}));
  Notch other = cut;
  other.position = 0.6 * radius;
  ASSERT_TRUE(found({other}));
  EXPECT_FALSE(found({other})->in_middle);
  other = cut, other.low[1] = 0, other.high[1] = thickness;
  EXPECT_TRUE(found({other}));
  other.high[1] = 0.9 * thickness;
  EXPECT_FALSE(found({other}));
  other = cut, other.low[2] = 0.001;
  EXPECT_FALSE(found({other}));
  other = cut, other.axis = 1;
  EXPECT_FALSE(found({other}));
  other = cut, other.position = 0.4 * radius, other.high[2] = 0.79 * radius;  // the arc is at 0.8 radii there
  ASSERT_TRUE(found({other}));
  EXPECT_NEAR(found({other})->ligament, 0.01 * radius, 1e-15);
  other.high[2] = 0.81 * radius;
  EXPECT_FALSE(found({other}));
}

struct SemicircularBending : test::SceneFile {
  static std::string cracks() {
    return "crack = {tensile_strength = 1e6, fracture_energy = 50, shear_strength = 1.5e6, friction = 0.5}\n";
  }
  static std::string domain() { return "domain = \"half_disc\"\ndiameter = 0.021\nthickness = 0.005\n"; }
  /// `cut`: keys of the notch. `keys`: further keys of `[loading]`.
  static std::string text(const std::string& cut = "z = [0, 0.002]\n", const std::string& keys = "",
                          const std::string& rest = "[solver]\ntolerance = 1e-2\n",
                          const std::string& crack = cracks()) {
    return "[specimen]\n" + domain() + "[[specimen.notch]]\naxis = \"x\"\nat = 0.0105\n" + cut +
           "[specimen.mastic]\nradius = [0.0009, 0.0011]\nporosity = 0.05\n"
           "[materials.aggregate]\ndensity = 2000\n[materials.mastic]\ndensity = 2000\n"
           "[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = 5e9\nalpha = 0.3\n" +
           crack +
           "[[contacts]]\npair = \"M-W\"\nlaw = \"elastic\"\nE = 5e9\n"
           "[loading]\nkind = \"semicircular_bending\"\ndisplacement = \"0.12 mm\"\npoints = 30\n"
           "roller_width = \"3 mm\"\n" +
           keys + rest;
  }
};

TEST_F(SemicircularBending, PlacesTheRollers) {
  const Scene scene = read(text());
  const domains::Rollers& rollers = *scene.specimen.box.rollers();
  ASSERT_EQ(rollers.bottom.size(), 2U);
  EXPECT_NEAR(rollers.bottom[0], 0.0021, 1e-15);
  EXPECT_NEAR(rollers.bottom[1], 0.0189, 1e-15);
  EXPECT_EQ(rollers.top, std::vector<double>{0.0105});
  EXPECT_DOUBLE_EQ(rollers.width, 0.003);
  EXPECT_TRUE(rollers.turn);
  const auto& test = std::get<experiments::SemicircularBending>(scene.experiment);
  EXPECT_EQ(test.radius, 0.0105);
  EXPECT_NEAR(test.rate, 0.05 / 60, 1e-18);
  EXPECT_EQ(test.times.size(), 30U);
  EXPECT_NEAR(test.times.back(), 0.144, 1e-12);  // 0.12 mm at 50 mm/min
  EXPECT_EQ(scene.solver.method, SolverMethod::quasi_static);

  const std::string own = "domain = \"half_disc\"\ndiameter = 0.1\nthickness = 0.02\n";
  std::string large = text("z = [0, 0.002]\n", "span = 0.06\n");
  large.replace(large.find(domain()), domain().size(), own);
  large.replace(large.find("roller_width"), std::string("roller_width = \"3 mm\"\n").size(), "");
  const domains::Rollers wide = *read(large).specimen.box.rollers();
  EXPECT_NEAR(wide.bottom[1] - wide.bottom[0], 0.06, 1e-15);
  EXPECT_NEAR(wide.width, 0.005, 1e-15);  // a tenth of the radius
}

// The half disc is much smaller than the length E·G_f/f_t² of 0.25 m, so its load falls slowly after the peak. The sum
// of the energies is the work of the upper roller. The lower rollers together bear the load of the upper one. The curve
// has few increments, so its area differs from the exact work, and it ends at the latest at a tenth of the load.
TEST_F(SemicircularBending, BendsAHalfDisc) {
  const Scene scene = read(text());
  const RunResult result = run(scene, folder_ / "out");
  const auto& found = std::get<experiments::SteppedResponse>(result.found);
  ASSERT_TRUE(found.half_disc);
  ASSERT_TRUE(found.half_disc->strength_pa && found.half_disc->toughness_pa_sqrt_m);
  EXPECT_GT(*found.half_disc->strength_pa, 0.3e6);
  EXPECT_LT(*found.half_disc->strength_pa, 4e6);
  EXPECT_EQ(found.half_disc->notch_m, 0.002);
  EXPECT_FALSE(found.disc);
  ASSERT_TRUE(found.increments);
  EXPECT_LT(found.increments->imbalance, 1e-7);
  const double largest = found.half_disc->load_n / section_area(scene.specimen.box);
  for (const experiments::SteppedPoint& p : found.points)
    EXPECT_NEAR(p.bottom_pa / largest, p.stress_pa / largest, 1e-6);
  EXPECT_LT(std::abs(found.points.back().stress_pa), 0.9 * largest);
  EXPECT_LT(found.half_disc->displacement_m, 0.1e-3);

  const nlohmann::json row = nlohmann::json::parse(std::ifstream(folder_ / "out" / "summary.json"))["results"][0];
  EXPECT_EQ(row["modulus"], "semicircular_bending");
  EXPECT_EQ(row["peak_load_n"], found.half_disc->load_n);
  EXPECT_EQ(row["bending_strength_pa"], *found.half_disc->strength_pa);
  EXPECT_EQ(row["notch_m"], 0.002);
  EXPECT_NEAR(found.points.back().energies.work_j / found.half_disc->work_j, 1, 0.1);
  EXPECT_NEAR(row["fracture_energy_j_m2"].get<double>(), found.half_disc->work_j / (0.0085 * 0.005), 1e-6);
  EXPECT_HAS(results_table(result), "bending strength");
  EXPECT_HAS(results_table(result), "half disc on two rollers");
  const std::string csv = test::read(folder_ / "out" / "semicircular_bending.csv");
  EXPECT_HAS(csv, "time_s,strain,stress_pa,displacement_m,load_n");
}

TEST_F(SemicircularBending, RefusesOtherScenes) {
  const auto refusal = [&](const std::string& scene) {
    return test::message_of([&] { require_combination(read(scene)); });
  };
  const std::string cut = "z = [0, 0.002]\n", solver = "[solver]\ntolerance = 1e-2\n";
  EXPECT_EQ(refusal(text()), "nothing was thrown");
  EXPECT_HAS(refusal(text(cut, "", solver, "")), "expected a law with a crack");
  EXPECT_HAS(refusal(text(cut, "", "[solver]\nmethod = \"harmonic\"\n")), "method in [solver]");
  EXPECT_HAS(refusal(text(cut, "", "[network]\nlateral_walls = true\n")), "lateral_walls");
  std::string box = text();
  box.replace(box.find(domain()), domain().size(), "box = [0.021, 0.01, 0.01]\n");
  EXPECT_HAS(refusal(box), "found \"box\", expected \"half_disc\"");
  EXPECT_HAS(refusal(text("z = [0.001, 0.003]\n")), "begins at z = 0");
  EXPECT_HAS(refusal(text(cut + "y = [0, 0.003]\n")), "through the whole thickness");
  EXPECT_HAS(refusal(text(cut + "[[specimen.notch]]\naxis = \"x\"\nat = 0.015\nz = [0, 0.001]\n")), "several notches");
}

TEST_F(SemicircularBending, RefusesRollersThatDoNotFit) {
  const std::string cut = "z = [0, 0.002]\n";
  EXPECT_HAS(message(text(cut, "span = 0.0205\n")), "span: found 0.0205 m, expected at most 0.018 m, the diameter");
  EXPECT_HAS(message(text(cut, "span = 0.01\n")), "roller_width: found 0.003 m, expected at most 0.0025 m");
  EXPECT_HAS(message(text(cut, "rate = \"50 mm\"\n")), "mm/min");
  EXPECT_HAS(message(text(cut, "strip_width = 0.002\n")), "strip_width");
}

}  // namespace
}  // namespace macadam
