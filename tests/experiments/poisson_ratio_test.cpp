// SPDX-License-Identifier: GPL-3.0-or-later
// poisson_ratio_test.cpp  Compares Poisson's ratio of stepped tests with that of the frequency domain, and checks where
// it is reported.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

using experiments::HarmonicCyclic;
using experiments::SteppedCyclic;
using experiments::SteppedPoint;
using experiments::SteppedResponse;

class PoissonRatio : public TestFolder {
 protected:
  RunResult run_t8(const std::string& loading, const std::string& solver, const std::string& output = "") const {
    fs::remove_all(out("out"));
    return run(read_scene(write_t8(loading, "backend = \"cpu\"\n" + solver, output)), out("out"));
  }
  nlohmann::json result() const { return nlohmann::json::parse(read(out("out") / "summary.json")).at("results").at(0); }
  /// Writes a scene of t8 with one elastic law in every contact, without friction at the platens if `alpha` < 1.
  fs::path write_elastic(double alpha, const std::string& rest) const {
    std::string contacts;
    for (const char* pair : {"M-M", "M-A", "A-A", "A-W", "M-W"}) {
      const bool wall = std::string(pair).ends_with("-W");
      contacts += fmt::format("[[contacts]]\npair = \"{}\"\nlaw = \"elastic\"\nE = 2e10\nalpha = {}\n", pair,
                              wall && alpha < 1 ? 0 : alpha);
    }
    write(folder_ / "elastic.toml",
          "[specimen]\nfile = \"t8.csv\"\nbox = [0.008, 0.008, 0.011]\n[materials.aggregate]\ndensity = 2630\n"
          "[materials.mastic]\ndensity = 2110\n" +
              contacts + rest);
    return folder_ / "elastic.toml";
  }
  std::complex<double> harmonic_ratio(const fs::path& scene) const {
    const RunResult found = run(read_scene(scene), out("harmonic"));
    return std::get<HarmonicCyclic>(found.found).frequencies.at(0).poisson_ratio.value();
  }
};

const std::string cyclic = "kind = \"cyclic\"\nfrequencies = [20.0]\n", heavy = "density_scaling = 1e4\n";

// Both methods have the same mass, so they differ by the errors of the steps and of the changing geometry, which are
// below 1e-6 in such specimens; a factor of ten is allowed. Mixed precision adds rounding errors of 1e-7 per step,
// which are summed in double.
TEST_F(PoissonRatio, OfSteppedCyclesIsThatOfTheSteadyState) {
  const RunResult known = run_t8(cyclic, "method = \"harmonic\"\ninertia = true\n" + heavy);
  const std::complex<double> expected = std::get<HarmonicCyclic>(known.found).frequencies.at(0).poisson_ratio.value();
  ASSERT_GT(std::abs(expected), 0.05);
  for (const auto& [precision, tolerance] : {std::pair{"double", 1e-5}, {"mixed", 1e-4}}) {
    for (const std::string output : {"", "response = false\n"}) {
      const RunResult stepped =
          run_t8(cyclic + "start = \"steady\"\n",
                 fmt::format("method = \"explicit\"\nprecision = \"{}\"\n{}", precision, heavy), output);
      const auto found = std::get<SteppedCyclic>(stepped.found).frequencies.at(0).poisson_ratio;
      ASSERT_TRUE(found);
      EXPECT_NEAR(std::abs(*found - expected), 0, tolerance * std::abs(expected)) << precision;
      EXPECT_EQ(result().at("poisson_ratio"), std::abs(*found));
      EXPECT_TRUE(result().contains("poisson_phase_deg"));
    }
  }
}

// Specimens with held sides have no lateral strain.
TEST_F(PoissonRatio, IsAbsentIfTheSidesAreHeld) {
  const std::string held = "[network]\nlateral_walls = true\n";
  const RunResult cycles = run_t8(cyclic + "start = \"steady\"\nsamples_per_cycle = 40\n",
                                  "method = \"explicit\"\ndensity_scaling = 1e6\n", held);
  EXPECT_FALSE(std::get<SteppedCyclic>(cycles.found).frequencies.at(0).poisson_ratio);
  EXPECT_FALSE(result().contains("poisson_ratio"));
  run_t8("kind = \"relaxation\"\nramp = \"0.2 ms\"\ntimes = [\"1 ms\"]\n", "method = \"explicit\"\n", held);
  EXPECT_HAS(read(out("out") / "relaxation.csv"), "bottom_pa,kinetic_j\n");
  EXPECT_FALSE(result().at("points").at(0).contains("poisson_ratio"));
}

// An elastic specimen has the same ratio at all times and in tests under strain and stress. Increments are solved to a
// residual of 1e-9 of the load; the condition number of the specimen is about 1e2.
TEST_F(PoissonRatio, OfIncrementsOfAnElasticSpecimenIsThatOfTheFrequencyDomain) {
  const std::complex<double> known = harmonic_ratio(
      write_elastic(0.1, "[loading]\n" + cyclic + "[solver]\nmethod = \"harmonic\"\nbackend = \"cpu\"\n"));
  ASSERT_GT(known.real(), 0.05);
  for (const std::string loading :
       {"kind = \"relaxation\"\nstrain = -1e-5\nramp = 1e-3\ntimes = [1e-2, 1e-1]\npoints_per_decade = 2\n",
        "kind = \"creep\"\nstress = 1e4\nramp = 1e-3\ntimes = [1e-2, 1e-1]\npoints_per_decade = 2\n",
        "kind = \"monotonic\"\nrate = 1e-3\nstrain = 1e-5\npoints = 3\n"}) {
    const RunResult found = run(
        read_scene(write_elastic(0.1, "[loading]\n" + loading + "[solver]\nmethod = \"quasi_static\"\n")), out("out"));
    const auto& points = std::get<SteppedResponse>(found.found).points;
    ASSERT_FALSE(points.empty());
    for (const SteppedPoint& p : points) EXPECT_NEAR(p.poisson_ratio, known.real(), 1e-6) << loading << p.time_s;
    EXPECT_EQ(result().at("points").back().at("poisson_ratio"), points.back().poisson_ratio);
  }
}

// With equal normal and shear stiffness everywhere a uniform strain without lateral strain is the solution.
TEST_F(PoissonRatio, OfAHomogeneousSpecimenIsZeroIfNormalAndShearStiffnessAreEqual) {
  const RunResult found =
      run(read_scene(write_elastic(1,
                                   "[loading]\nkind = \"monotonic\"\nrate = 1e-3\nstrain = 1e-5\npoints = 3\n"
                                   "[solver]\nmethod = \"quasi_static\"\n")),
          out("out"));
  for (const SteppedPoint& p : std::get<SteppedResponse>(found.found).points)
    EXPECT_NEAR(p.poisson_ratio, 0, 1e-6) << p.time_s;  // tolerance as above
}

// Stepped points, and points after interruptions. The strain returns after the release of creep, but not to 0.
TEST_F(PoissonRatio, IsTheSameAfterInterruptions) {
  const std::string solver = "backend = \"cpu\"\nmethod = \"explicit\"\n";
  const Scene creep = read_scene(write_t8(
      "kind = \"creep\"\nstress = 1e5\nramp = 2e-4\nrelease = 2e-3\ntimes = [1e-3, 1.5e-3, 2e-3, 3e-3]\n", solver));
  run(creep, out("one"));
  int interrupted = 0;
  for (const int asked : {2, 3, 2, 1'000'000}) interrupted += run_until(creep, "pieces", asked, interrupted > 0);
  EXPECT_GT(interrupted, 0);
  EXPECT_EQ(read(out("pieces") / "creep.csv"), read(out("one") / "creep.csv"));
  EXPECT_HAS(read(out("one") / "creep.csv"), "kinetic_j,poisson_ratio\n");

  const std::string steps = solver + "density_scaling = 1e5\n", loading = cyclic + "start = \"steady\"\n";
  const Scene cycles = read_scene(write_t8(loading, steps));
  const auto ratio = [](const RunResult& r) {
    return std::get<SteppedCyclic>(r.found).frequencies.at(0).poisson_ratio.value();
  };
  const std::complex<double> whole = ratio(run(cycles, out("cycles")));
  ASSERT_TRUE(run_until(cycles, "resumed", 300));  // amid the samples of the cycle
  EXPECT_EQ(ratio(run(cycles, out("resumed"), {}, true)), whole);
}

}  // namespace
}  // namespace macadam::test
