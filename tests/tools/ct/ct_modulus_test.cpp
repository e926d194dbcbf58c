// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `macadam ct modulus`: exact solutions with complex moduli, the choice of voxels, files, and wrong inputs.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "host/tools/ct/continuum/compression.hpp"
#include "host/tools/ct/continuum/modulus_files.hpp"
#include "host/tools/ct/continuum/scan_modulus.hpp"
#include "macadam/ct.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using continuum::ModulusPlan;
using continuum::PointModulus;
using continuum::ScanPhases;
using Complex = std::complex<double>;
using Phases = Image<std::uint8_t>;

constexpr double plenty = 1e10;  // memory [bytes]
constexpr std::uint8_t air = 0, mastic = 1, rock = 2, outside = 255;

// The solver ends at a residual of 1e-6 of the first one. The modulus follows from the energy, whose error is the
// square of this.
constexpr double tolerance = 1e-9;

class CtModulus : public Program {
 protected:
  /// Writes a scene whose phases have Poisson's ratios `nu`. `more`: lines of [network].
  fs::path scene_of(double nu, const std::string& loading = "kind = \"cyclic\"\nfrequencies = [1.0, 20.0]\n",
                    const std::string& more = "", const std::string& materials = "") const {
    const std::string of_phases =
        materials.empty()
            ? fmt::format(
                  "[materials.aggregate]\ndensity = 2600\nlaw = \"elastic\"\nE = 60e9\npoisson_ratio = {0}\n"
                  "[materials.mastic]\ndensity = 2100\nlaw = \"generalised_kelvin\"\npoisson_ratio = {0}\nE_m = 6e9\n"
                  "C_m = 1e9\nE = [2e8]\nC = [4e9]\nshift = \"table\"\ntemperatures = [0, 20]\nlog10_a_T = [1, 0]\n",
                  nu)
            : materials;
    write(folder_ / "scene.toml", "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n" + of_phases +
                                      "[network]\nrule = \"series\"\n" + more + "[loading]\n" + loading +
                                      "[solver]\nmethod = \"harmonic\"\n");
    return folder_ / "scene.toml";
  }

  /// Writes phases.mha with cubes of 0.5 mm. `phase(i, j, k)` gives the phase of a voxel.
  template <class F>
  fs::path scan_of(std::array<std::int64_t, 3> size, F&& phase, Vec3d edges = {5e-4, 5e-4, 5e-4}) const {
    Phases image(size, edges);
    for (std::int64_t k = 0; k < size[2]; ++k)
      for (std::int64_t j = 0; j < size[1]; ++j)
        for (std::int64_t i = 0; i < size[0]; ++i) image.at(i, j, k) = phase(i, j, k);
    fs::create_directories(folder_ / "scan");
    write_image(folder_ / "scan/phases.mha", image);
    return folder_ / "scan";
  }

  /// Returns the law of the scene's mastic at a frequency and shift factor, independent of the program's laws.
  static Complex mastic_modulus(double frequency, double shift = 1) {
    const Complex s{0, 2 * std::numbers::pi * frequency * shift};
    return 1.0 / (1 / 6e9 + 1.0 / (s * 1e9) + 1.0 / (2e8 + s * 4e9));
  }

  void expect_exact(const PointModulus& found, Complex modulus, double poisson) const {
    EXPECT_EQ(found.sizes, 3);
    EXPECT_NEAR(std::abs(found.limit.modulus / modulus - 1.0), 0, tolerance);
    // as exact as the displacement
    EXPECT_NEAR(std::abs(found.limit.poisson), poisson, 1e-6);
  }
};

TEST_F(CtModulus, AHomogeneousScanHasTheModulusOfItsPhase) {
  const ScanPhases phases = continuum::phases_of(read_scene(scene_of(0.3)));
  ASSERT_EQ(phases.points.size(), 2u);
  // A prism with an L as cross-section in a larger image
  const ModulusPlan plan = continuum::plan_modulus(scan_of({30, 28, 26},
                                                           [](auto i, auto j, auto k) {
                                                             const bool in = i >= 2 && i < 26 && j >= 4 && j < 28 &&
                                                                             k >= 3 && k < 19 && (i < 14 || j < 16);
                                                             return in ? mastic : outside;
                                                           }),
                                                   plenty);
  EXPECT_EQ(plan.blocks, (std::vector<int>{4, 2, 1}));
  EXPECT_EQ(plan.mastic, 1);
  EXPECT_EQ(plan.loose, 0);
  EXPECT_TRUE(plan.warnings.empty());
  const auto found = continuum::solve_modulus(plan, phases);
  for (std::size_t p = 0; p < 2; ++p) {
    expect_exact(found[p], mastic_modulus(phases.points[p].frequency_hz), 0.3);
    EXPECT_LT(found[p].limit.uncertainty, 10 * tolerance * std::abs(found[p].limit.modulus));
    EXPECT_LT(found[p].limit.phase_uncertainty, 10 * tolerance);
  }
}

TEST_F(CtModulus, LayersInParallelHaveTheMeanModulus) {
  const ScanPhases phases = continuum::phases_of(read_scene(scene_of(0.3)));
  const ModulusPlan plan =
      continuum::plan_modulus(scan_of({16, 16, 16}, [](auto i, auto, auto) { return i < 4 ? rock : mastic; }), plenty);
  const auto found = continuum::solve_modulus(plan, phases);
  // equal lateral strains, so no stress between the layers
  for (std::size_t p = 0; p < 2; ++p)
    expect_exact(found[p], 0.25 * 60e9 + 0.75 * mastic_modulus(phases.points[p].frequency_hz), 0.3);
}

/// The boundary of the layers cuts the largest elements, but not the others.
TEST_F(CtModulus, LayersInSeriesHaveTheMeanCompliance) {
  const ScanPhases phases = continuum::phases_of(read_scene(scene_of(0)));
  const ModulusPlan plan =
      continuum::plan_modulus(scan_of({16, 16, 16}, [](auto, auto, auto k) { return k < 6 ? rock : mastic; }), plenty);
  std::vector<continuum::ModulusSolution> solutions;
  continuum::ModulusWatcher watcher;
  watcher.solved = [&](const continuum::ModulusSolution& solution) { solutions.push_back(solution); };
  const auto found = continuum::solve_modulus(plan, phases, watcher);
  for (std::size_t p = 0; p < 2; ++p) {
    const Complex soft = mastic_modulus(phases.points[p].frequency_hz);
    expect_exact(found[p], 1.0 / (0.375 / 60e9 + 0.625 / soft), 0);
  }
  EXPECT_EQ(solutions.size(), 8u);  // two points; two rules with the largest elements, then one
}

TEST_F(CtModulus, TemperaturesShiftTheLawOfTheMastic) {
  const ScanPhases phases = continuum::phases_of(
      read_scene(scene_of(0.3, "kind = \"sweep\"\nfrequencies = [1.0, 10.0]\ntemperatures = [20.0, 10.0]\n")));
  ASSERT_EQ(phases.points.size(), 4u);
  EXPECT_EQ(phases.rock.modulus, 60e9);
  for (std::size_t p = 0; p < 4; ++p) {
    const double temperature = p < 2 ? 20 : 10, frequency = p % 2 == 0 ? 1 : 10;
    EXPECT_EQ(phases.points[p].temperature_c, temperature);
    EXPECT_EQ(phases.points[p].frequency_hz, frequency);
    // the table has log10 a = 0.5 at 10 degrees
    const Complex expected = mastic_modulus(frequency, p < 2 ? 1 : std::sqrt(10.0));
    EXPECT_NEAR(std::abs(phases.points[p].mastic.young() / expected - 1.0), 0, 1e-12);  // some roundings
  }
}

TEST_F(CtModulus, MemoryAndTheOptionDecideTheSizesOfElements) {
  const fs::path scan = scan_of({64, 64, 70}, [](auto, auto, auto) { return mastic; });
  const ModulusPlan fine = continuum::plan_modulus(scan, plenty);
  EXPECT_EQ(fine.blocks, (std::vector<int>{4, 2, 1}));
  EXPECT_EQ(fine.scan.size.z, 68);
  EXPECT_NEAR(fine.removed_height, 1e-3, 1e-12);
  const ModulusPlan less = continuum::plan_modulus(scan, 0.9 * fine.bytes);
  EXPECT_EQ(less.blocks, (std::vector<int>{8, 4, 2}));
  EXPECT_LE(less.bytes, 0.9 * fine.bytes);
  EXPECT_EQ(continuum::plan_modulus(scan, plenty, 1.5e-3).blocks, (std::vector<int>{12, 6, 3}));
  const auto refused = [&](double memory, double voxel) {
    return message_of([&] { continuum::plan_modulus(scan, memory, voxel); });
  };
  EXPECT_HAS(refused(plenty, 0.7e-3), "--voxel: found 0.7 mm, expected a multiple of the scan's 0.5 mm");
  EXPECT_HAS(refused(plenty, 2.5e-3), "--voxel: found 2.5 mm, expected at most 2 mm, because 4 of the largest");
  EXPECT_HAS(refused(0.9 * fine.bytes, 0.5e-3), "expected at least 1 mm, because");
  EXPECT_HAS(refused(1e6, 0), "phases.mha: memory: found 0.001 GB, expected at least");
}

TEST_F(CtModulus, WrongScansAreNamed) {
  const auto refused = [&](const fs::path& folder) {
    return message_of([&] { continuum::plan_modulus(folder, plenty); });
  };
  EXPECT_HAS(refused(folder_ / "none"), "none: image of the phases: found no such file, expected phases.mha");
  fs::create_directories(folder_ / "labels");
  write_image(folder_ / "labels/labels.mha", Image<std::uint32_t>({16, 16, 16}, {5e-4, 5e-4, 5e-4}, {}, 1));
  EXPECT_HAS(refused(folder_ / "labels"), "labels.mha, which does not show voids");
  EXPECT_HAS(refused(folder_ / "labels/labels.mha"), "found labels, which do not show voids");
  const auto all = [](auto, auto, auto) { return mastic; };
  EXPECT_HAS(refused(scan_of({16, 16, 15}, all)),
             "phases.mha: voxels along the shortest edge of the specimen: found 15, expected at least 16");
  EXPECT_HAS(refused(scan_of({16, 16, 16}, all, {5e-4, 5e-4, 1e-3})),
             "phases.mha: edges of a voxel: found 0.5 x 0.5 x 1 mm, expected equal edges");
  EXPECT_HAS(refused(scan_of({16, 16, 16}, [](auto, auto, auto) { return outside; })),
             "voxels of the specimen: found none");
  EXPECT_HAS(refused(scan_of({16, 16, 16}, [](auto i, auto, auto) { return i == 3 ? std::uint8_t{7} : mastic; })),
             "phase of a voxel: found 7, expected 0, 1, 2 or 255");
  const std::string whole = read(scan_of({16, 16, 16}, all) / "phases.mha");
  write(folder_ / "scan/phases.mha", whole.substr(0, whole.size() - 8));
  EXPECT_HAS(refused(folder_ / "scan"), "phases.mha: packed voxels: found");
}

TEST_F(CtModulus, AGapBetweenThePlatensIsDescribed) {
  // Voids fill the layers from 2 to 3 mm. Above them there are 3/4 of the cross-section, which is 10/13 of the
  // material.
  const fs::path scan = scan_of({16, 16, 16}, [](auto i, auto, auto k) {
    if (k == 4 || k == 5) return air;
    return k > 5 && i < 4 ? air : mastic;
  });
  const std::string message = message_of([&] { continuum::plan_modulus(scan, plenty); });
  EXPECT_HAS(message,
             "phases.mha: connection of bottom and top: found material whose pieces at the bottom (34.8 % of "
             "it) end at a height of 2 mm, and whose pieces at the top (65.2 %) begin at 3 mm");
}

TEST_F(CtModulus, LoosePiecesAndRoughEndsAreWarnedOf) {
  const ModulusPlan plan =
      continuum::plan_modulus(scan_of({16, 16, 16},
                                      [](auto i, auto, auto k) {
                                        if (i == 8) return air;  // cuts off the part with i > 8
                                        return (k == 0 && i > 3) || (k == 15 && i > 8) ? air : mastic;
                                      }),
                              plenty);
  ASSERT_EQ(plan.warnings.size(), 3u);
  // 4 of 16 columns at the bottom, 8 at the top; the mean is 15 − (11 + 7)/16 = 13.9
  EXPECT_HAS(plan.warnings[0], "the bottom layer of voxels has 29 % of the mean cross-section");
  EXPECT_HAS(plan.warnings[1], "the top layer of voxels has 58 % of the mean cross-section");
  // 7 of 15 columns, 14 layers high
  EXPECT_NEAR(plan.loose, 7.0 * 14 / (7 * 14 + 8 * 15 + 4), 1e-12);
  EXPECT_HAS(plan.warnings[2], "% of the material is in pieces that do not connect both platens");
}

TEST_F(CtModulus, WrongScenesAreNamed) {
  const auto refused = [&](const fs::path& scene) {
    return message_of([&] { continuum::phases_of(read_scene(scene)); });
  };
  const std::string usual = "kind = \"cyclic\"\nfrequencies = [1.0]\n";
  EXPECT_HAS(refused(write_scene()), "scene.toml: rule in [network]: found \"centres\", expected \"series\"");
  EXPECT_HAS(refused(scene_of(0.3, usual, "lateral_walls = true\n")), "lateral_walls in [network]: found true");
  EXPECT_HAS(refused(scene_of(0.3, "kind = \"relaxation\"\ntimes = [1.0]\n")), "kind in [loading]");
  const std::string of_mastic = "[materials.mastic]\ndensity = 2100\nlaw = \"elastic\"\nE = 1e9\npoisson_ratio = 0.3\n";
  EXPECT_HAS(refused(scene_of(0.3, usual, "", of_mastic)), "law in [materials.aggregate]: found nothing");
  EXPECT_HAS(refused(scene_of(0.3, usual, "",
                              of_mastic + "[materials.aggregate]\ndensity = 2600\nlaw = \"elastic\"\nE = 1e9\n")),
             "poisson_ratio in [materials.aggregate]: found nothing");
}

TEST_F(CtModulus, ASolutionThatIsNotANumberIsAnError) {
  continuum::Grid<double> grid(continuum::Size{8, 8, 8});
  std::fill(grid.mu.begin(), grid.mu.end(), Complex(1));
  std::fill(grid.lambda.begin(), grid.lambda.end(), Complex(1));
  grid.mu[100] = NAN;
  continuum::Field<double> u;
  EXPECT_HAS(message_of([&] { continuum::compress(grid, 64, 1e-6, u); }), "that is not a number");
}

/// An interruption with the smallest elements leaves the results of the larger ones.
TEST_F(CtModulus, AnInterruptionLeavesWhatWasComputed) {
  const ScanPhases phases = continuum::phases_of(read_scene(scene_of(0.3)));
  const ModulusPlan plan = continuum::plan_modulus(
      scan_of({16, 16, 16}, [](auto i, auto j, auto k) { return (i + 2 * j + k) % 5 < 2 ? rock : mastic; }), plenty);
  std::vector<PointModulus> known(phases.points.size());
  continuum::ModulusFiles files(folder_ / "out", plan, phases, "scene.toml");
  continuum::ModulusWatcher watcher;
  watcher.solved = [&](const continuum::ModulusSolution& solution) { files.add(solution); };
  watcher.improved = [&](const std::vector<PointModulus>& improved) {
    known = improved;
    files.write(known, "running");
  };
  watcher.stop = [&] { return known[1].sizes == 2; };
  EXPECT_THROW(continuum::solve_modulus(plan, phases, watcher), InterruptedError);
  files.write(known, "interrupted");
  const nlohmann::json summary = this->summary("out");
  EXPECT_EQ(summary["status"], "interrupted");
  ASSERT_EQ(summary["results"].size(), 2u);
  EXPECT_EQ(summary["results"][1]["voxel_sizes"], 2);
  EXPECT_NEAR(summary["results"][1]["voxel_m"].get<double>(), 1e-3, 1e-15);
  EXPECT_EQ(lines_of(read(folder_ / "out/modulus.csv")).size(), 3u);
  EXPECT_EQ(lines_of(read(folder_ / "out/voxels.csv")).size(), 9u);  // 2 sizes, 2 rules, 2 points
}

TEST_F(CtModulus, TheCommandWritesTablesWithTheSameDigitsForAnyThreads) {
  // large enough for several threads
  scan_of({32, 32, 32}, [](auto i, auto j, auto k) {
    const auto in = [&](double x, double y, double z, double r) {
      return std::pow(double(i) - x, 2) + std::pow(double(j) - y, 2) + std::pow(double(k) - z, 2) < r * r;
    };
    if (in(8, 9, 10, 7) || in(22, 20, 8, 8) || in(16, 16, 24, 7)) return rock;
    return in(26, 6, 22, 3) ? air : mastic;
  });
  scene_of(0.3);
  const auto run_with = [&](const std::string& threads) {
    const Outcome outcome = macadam("ct modulus " + path("scan") + " --scene " + path("scene.toml") + " --threads " +
                                    threads + " --out " + path("out" + threads));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_HAS(outcome.out, "specimen of 16 x 16 x 16 mm, from 32 x 32 x 32 voxels of 0.5 mm: aggregate");
    EXPECT_HAS(outcome.out, "finite elements of 2, 1 and 0.5 mm: up to 0.033 million elements");
    EXPECT_HAS(outcome.out, "expected time: about");
    return read(folder_ / ("out" + threads) / "modulus.csv");
  };
  const std::string one = run_with("1");
  EXPECT_EQ(one, run_with("2"));
  const std::vector<std::string> lines = lines_of(one);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "temperature_c,frequency_hz,e_star_pa,e_star_uncertainty_pa,phase_deg,phase_uncertainty_deg,poisson_ratio,"
            "poisson_phase_deg,voxel_m,voxel_sizes");
  const nlohmann::json summary = this->summary("out1");
  EXPECT_EQ(summary["status"], "done");
  for (const nlohmann::json& result : summary["results"]) {
    // between the mastic and the mean of the phases
    EXPECT_GT(result["e_star_pa"], result["mastic_e_star_pa"]);
    EXPECT_LT(result["e_star_pa"].get<double>(),
              60e9 * summary["aggregate"].get<double>() + result["mastic_e_star_pa"].get<double>());
    EXPECT_LT(result["phase_deg"], result["mastic_phase_deg"]);
  }
  const Outcome refused =
      macadam("ct modulus " + path("none") + " --scene " + path("scene.toml") + " --out " + path("refused"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_HAS(refused.err, "image of the phases: found no such file");
  EXPECT_FALSE(fs::exists(folder_ / "refused"));
}

}  // namespace
}  // namespace macadam::test
