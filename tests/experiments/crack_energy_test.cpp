// SPDX-License-Identifier: GPL-3.0-or-later
// crack_energy_test.cpp  Tests what a stepped test of a scene with cracks reports: cracked and broken points, energies,
// and the strength.
#include <gtest/gtest.h>

#include <algorithm>
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
  Scene two_cubes(const std::string& loading, const std::string& solver = "",
                  const std::string& law = "law = \"elastic\"\nE = 1e9\n") const {
    write(folder_ / "cubes.csv",
          "id,x,y,z,radius,phase,body\n0,0.005,0.005,0.005,0.005,mastic,-1\n1,0.005,0.005,0.015,0.005,mastic,-1\n");
    write(folder_ / "cubes.toml",
          "[specimen]\nfile = \"cubes.csv\"\nbox = [0.01, 0.01, 0.02]\n[materials.mastic]\ndensity = 2000.0\n"
          "[[contacts]]\npair = \"M-M\"\n" +
              law +
              "alpha = 0.5\ncrack = { tensile_strength = 1e5, "
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
  // The test starts with the velocities of the strain rate, but the cracking facet causes waves of some percent
  EXPECT_NEAR(found.peak->stress_pa, strength, 0.1 * strength);
  double before = 0;
  for (const SteppedPoint& p : found.points) {
    EXPECT_GE(p.cracks.crack_energy_j, before * (1 - 1e-9));
    EXPECT_EQ(p.cracks.cracked, p.cracks.crack_energy_j > 0 ? 5 : 0);
    EXPECT_EQ(p.cracks.friction_energy_j, 0);
    before = p.cracks.crack_energy_j;
  }
  // Errors are the difference between the walls relative to the largest stress, also where the stress has fallen
  double largest = 0;
  for (const SteppedPoint& p : found.points) {
    largest = std::max(largest, std::abs(p.stress_pa));
    EXPECT_NEAR(p.error, std::abs(p.top_pa - p.bottom_pa) / largest, 1e-12);
  }
  EXPECT_EQ(found.points.front().broken_points, 0);
  EXPECT_EQ(found.points.back().broken_points, 5);
  EXPECT_NEAR(found.points.back().cracks.crack_energy_j, energy * area, 1e-8 * energy * area);
  EXPECT_NEAR(found.points.back().strain, 0.02, 1e-3);  // two points are 5e-4 apart

  const std::string table = read(out("out") / "monotonic.csv");
  EXPECT_HAS(table,
             "kinetic_j,cracked_points,broken_points,crack_energy_j,viscous_energy_j,elastic_energy_j,"
             "friction_energy_j,kinetic_energy_j,work_j,damping_energy_j,poisson_ratio\n");
  EXPECT_HAS(results_table(result), "5 of 5 contact points that can break are broken; 5 have begun to crack");
  const auto all = nlohmann::json::parse(read(out("out") / "summary.json"));
  const auto last = all.at("results").at(0).at("points").back();
  EXPECT_EQ(last.at("cracked_points"), 5);
  EXPECT_EQ(last.at("crack_energy_j"), found.points.back().cracks.crack_energy_j);
  EXPECT_EQ(all.at("cracks").at("M-M").at("tension"), 5);
  const auto& test = all.at("results").at(0);
  EXPECT_EQ(test.at("largest_stress_pa"), found.peak->stress_pa);
  EXPECT_EQ(test.at("strength_pa"), found.fitted ? found.fitted->stress_pa : found.peak->stress_pa);
  EXPECT_EQ(test.at("strength_from"), found.fitted ? "fit" : "largest stress");
  EXPECT_EQ(test.at("work_of_fracture_j"), found.points.back().energies.work_j);
  EXPECT_TRUE(test.at("energy_error").is_null()) << "the energy of damping is the remainder of the balance";
  EXPECT_EQ(all.at("cracks").at("M-M").at("cracked_points"), 5);
  EXPECT_EQ(last.at("cracked_area_m2").size(), 1u);
  EXPECT_NEAR(last.at("cracked_area_m2").at("M-M"), area, 1e-12 * area);
  EXPECT_NEAR(all.at("cracks").at("M-M").at("cracked_area_m2"), area, 1e-12 * area);

  // One contact of five points has separated; the faces are as far apart as the crack is open
  EXPECT_HAS(read(out("out") / "cracks.csv"), "area_m2,mode,opening_m,slip_m,damage,time_s\n");
  std::istringstream damage(read(out("out") / "damage.csv"));
  std::string comment, head, row, more;
  std::getline(damage, comment), std::getline(damage, head), std::getline(damage, row);
  EXPECT_FALSE(std::getline(damage, more));
  EXPECT_EQ(
      head,
      "contact,a,b,pair,x,y,z,nx,ny,nz,area_m2,opening_m,slip_m,damage,energy_j,friction_j,cracked_points,points");
  std::vector<std::string> cells;
  std::istringstream line(row);
  for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
  ASSERT_EQ(cells.size(), 18u);
  EXPECT_EQ(cells[3], "M-M");
  EXPECT_NEAR(std::stod(cells[6]), 0.01, 1e-9);  // z of the facet
  EXPECT_GE(std::stod(cells[11]), 2 * energy / strength);
  EXPECT_NEAR(std::stod(cells[13]), 1, 1e-12);
  EXPECT_NEAR(std::stod(cells[14]), energy * area, 1e-8 * energy * area);
  EXPECT_EQ(cells[16], "5");
}

// The test takes less than 10,000 steps, so the work is summed at every step. The balance then has errors only in the
// steps in which the crack begins or shuts. In such a step the wall moves by some 1e-7 m while the stress changes by
// some 1e4 Pa, and the trapezoidal rule is wrong by up to an eighth of their product, about 6e-6 of the work.
TEST_F(CrackEnergy, BalanceOfAnElasticTestCloses) {
  const RunResult result = run(two_cubes(pulled, "density_scaling = 1.0\n"), out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.energy_error());
  EXPECT_LT(*found.energy_error(), 1e-5);
  for (const SteppedPoint& p : found.points) {
    EXPECT_EQ(p.energies.viscous_j, 0);
    EXPECT_EQ(p.energies.damping_j, 0);
    EXPECT_EQ(p.energies.crack_j, p.cracks.crack_energy_j);
    EXPECT_GE(p.energies.elastic_j, 0);
  }
  const auto all = nlohmann::json::parse(read(out("out") / "summary.json"));
  EXPECT_EQ(all.at("results").at(0).at("energy_error"), *found.energy_error());
  EXPECT_EQ(all.at("results").at(0).at("points").back().at("work_j"), found.points.back().energies.work_j);
}

// A tenth of the work goes into the dashpots. The force rises within less than one of the 600 intervals of the table,
// in which it is taken as linear; this interval has 5e-4 of the dissipation of the dashpots.
TEST_F(CrackEnergy, BalanceWithDashpotsCloses) {
  std::string loading = pulled;
  loading.replace(loading.find("points = 60"), 11, "points = 600");
  const RunResult result = run(two_cubes(loading, "density_scaling = 1.0\n",
                                         "law = \"generalised_kelvin\"\nE_m = 1e9\nC_m = 1e6\nE = [2e9]\nC = "
                                         "[1e7]\n"),
                               out("out"));
  const auto& found = std::get<SteppedResponse>(result.found);
  ASSERT_TRUE(found.energy_error());
  EXPECT_LT(*found.energy_error(), 1e-3);
  const experiments::Energies& end = found.points.back().energies;
  EXPECT_GT(end.viscous_j, 0.02 * end.work_j);
  EXPECT_LT(end.viscous_j, 0.3 * end.work_j);
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
  asked.experiment = experiments::Sweep{{1, 10}, {}};
  EXPECT_HAS(message_of([&] { run(asked, out("out")); }), "elastic with crack, which has no complex stiffness");
  asked = two_cubes("kind = \"cyclic\"\nfrequencies = [10.0]\nstrain_amplitude = 1e-5\n");
  asked.solver.precision = Precision::single;
  EXPECT_HAS(message_of([&] { run(asked, out("out")); }), "single beside law elastic with crack of pair M-M");
}

}  // namespace
}  // namespace macadam::test
