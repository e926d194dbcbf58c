// SPDX-License-Identifier: GPL-3.0-or-later
// crack_energy_test.cpp  Tests what a stepped test of a scene with cracks reports: cracked and broken points, energies,
// and the strength.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/test_folder.hpp"

namespace macadam::test {
namespace {

using experiments::SteppedPoint;
using experiments::SteppedResponse;

constexpr double strength = 1e5, energy = 20, area = 1e-4;  ///< f_t [Pa], G_f [J/m²], area of the facet [m²]

class CrackEnergy : public TestFolder {
 protected:
  /// Returns a tensile test of two cubes of 10 mm with one facet between them, which has 5 contact points.
  Scene two_cubes(const std::string& loading, const std::string& solver = "") const {
    write(folder_ / "cubes.csv",
          "id,x,y,z,radius,phase,body\n0,0.005,0.005,0.005,0.005,mastic,-1\n1,0.005,0.005,0.015,0.005,mastic,-1\n");
    write(folder_ / "cubes.toml",
          "[specimen]\nfile = \"cubes.csv\"\nbox = [0.01, 0.01, 0.02]\n[materials.mastic]\ndensity = 2000.0\n"
          "[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = 1e9\nalpha = 0.5\ncrack = { tensile_strength = 1e5, "
          "fracture_energy = 20 }\n[[contacts]]\npair = \"M-W\"\nlaw = \"elastic\"\nE = 1e9\n[loading]\n" +
              loading + "[solver]\nmethod = \"explicit\"\nbackend = \"cpu\"\n" + solver);
    return read_scene(folder_ / "cubes.toml");
  }
};

constexpr const char* pulled = "kind = \"monotonic\"\nrate = 0.5\nstrain = 0.03\npoints = 60\n";

// The crack is separated at an opening of 2·G_f/f_t = 0.4 mm, a strain of 0.02. Until then the energy rises to G_f·A,
// and the test ends with the separation.
TEST_F(CrackEnergy, RisesToTheFractureEnergyOfTheFacet) {
  const RunResult result = run(two_cubes(pulled, "density_scaling = 1.0\ndamping = 0.1\n"), out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.rupture);
  ASSERT_TRUE(found.peak);
  // The stress jumps to the load's rate, and its waves add some percent to the peak
  EXPECT_NEAR(found.peak->stress_pa, strength, 0.1 * strength);
  double before = 0;
  for (const SteppedPoint& p : found.points) {
    EXPECT_GE(p.cracks.crack_energy_j, before * (1 - 1e-9));
    EXPECT_EQ(p.cracks.cracked, p.cracks.crack_energy_j > 0 ? 5 : 0);
    EXPECT_EQ(p.cracks.friction_energy_j, 0);
    before = p.cracks.crack_energy_j;
  }
  EXPECT_EQ(found.points.front().broken_points, 0);
  EXPECT_EQ(found.points.back().broken_points, 5);
  EXPECT_NEAR(found.points.back().cracks.crack_energy_j, energy * area, 1e-8 * energy * area);
  EXPECT_NEAR(found.points.back().strain, 0.02, 1e-3);  // two points are 5e-4 apart

  const std::string table = read(out("out") / "monotonic.csv");
  EXPECT_HAS(table, "kinetic_j,cracked_points,broken_points,crack_energy_j,friction_energy_j\n");
  EXPECT_HAS(results_table(result), "5 of 5 contact points that can break are broken; 5 have begun to crack");
  const auto all = nlohmann::json::parse(read(out("out") / "summary.json"));
  const auto last = all.at("results").at(0).at("points").back();
  EXPECT_EQ(last.at("cracked_points"), 5);
  EXPECT_EQ(last.at("crack_energy_j"), found.points.back().cracks.crack_energy_j);
  EXPECT_EQ(all.at("cracks").at("M-M").at("tension"), 5);
  EXPECT_EQ(all.at("results").at(0).at("strength_pa"), found.peak->stress_pa);
}

/// A test in pieces gives the same table as a whole test.
TEST_F(CrackEnergy, InterruptionsDoNotChangeTheTable) {
  const Scene asked = two_cubes(pulled);
  run(asked, out("whole"));
  int interrupted = 0;
  for (const int stop : {2, 9, 5, 0}) interrupted += run_until(asked, "pieces", stop, interrupted > 0);
  EXPECT_GT(interrupted, 0);
  EXPECT_EQ(read(out("pieces") / "monotonic.csv"), read(out("whole") / "monotonic.csv"));
}

/// The frequency domain refuses a scene with cracks by the name of its law; single precision and blocks are refused.
TEST_F(CrackEnergy, LinearMethodsRefuseCracks) {
  Scene asked = two_cubes("kind = \"cyclic\"\nfrequencies = [10.0]\nstrain_amplitude = 1e-5\n");
  asked.solver.method = SolverMethod::harmonic;
  EXPECT_HAS(message_of([&] { run(asked, out("out")); }), "elastic with crack, which has no complex stiffness");
  asked.solver.method = SolverMethod::explicit_;
  asked.solver.precision = Precision::single;
  EXPECT_HAS(message_of([&] { run(asked, out("out")); }), "single beside law elastic with crack of pair M-M");
}

}  // namespace
}  // namespace macadam::test
