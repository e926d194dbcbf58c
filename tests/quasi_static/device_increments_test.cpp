// SPDX-License-Identifier: GPL-3.0-or-later
// device_increments_test.cpp  Compares quasi-static increments on a device with those of the CPU. All tests are skipped
// without a device.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "macadam/quasi_static.hpp"
#include "tests/support/cracking_t8.hpp"

namespace macadam::test {
namespace {

constexpr std::size_t driven = wall_index(wall_z_hi);

class QuasiStaticDevice : public testing::Test {
 protected:
  void SetUp() override {
    if (std::ranges::count(tested_backends(), Backend::cuda) == 0) GTEST_SKIP() << "no CUDA device";
  }
};

/// Results of a test: force on the top wall, its displacement, and energies at the end of each increment.
struct Course {
  std::vector<double> force, moved, crack, elastic, viscous;
};

/// Takes `count` increments of strain, the last `by_opening` of which are controlled by the opening of cracks.
Course follow(const TestScene& scene, QuasiStaticOptions options, Backend backend, double strain, int count,
              int by_opening = 0) {
  options.backend = backend;
  QuasiStatic q(scene.specimen, scene.network, scene.laws, options);
  Course out;
  for (int k = 0; k < count; ++k) {
    WallIncrement next;
    next.dt = 6e-5;
    if (k >= count - by_opening)
      next.opening = q.last_opening();
    else
      next.wall[driven].z = strain * t8_height;
    const IncrementReport report = q.solve(next);
    EXPECT_TRUE(report.converged) << to_string(backend) << ", increment " << k << ", residual " << report.residual;
    if (!report.converged) break;
    q.accept();
    out.force.push_back(q.wall_force()[driven].z);
    out.moved.push_back(q.wall_displacement()[driven].z);
    out.crack.push_back(q.energies().crack_j);
    out.elastic.push_back(q.energies().elastic_j);
    out.viscous.push_back(q.energies().viscous_j);
  }
  EXPECT_LT(q.energies().imbalance(), 1e-8);
  return out;
}

/// Expects two lists of numbers to agree to `tolerance` of the largest one.
void expect_close(const std::vector<double>& found, const std::vector<double>& right, double tolerance,
                  const char* what) {
  ASSERT_EQ(found.size(), right.size()) << what;
  double largest = 0;
  for (const double v : right) largest = std::max(largest, std::abs(v));
  for (std::size_t k = 0; k < right.size(); ++k) EXPECT_NEAR(found[k], right[k], tolerance * largest) << what << k;
}

/// Compares the device with the CPU, and the device with itself.
void compare(const TestScene& scene, const QuasiStaticOptions& options, double strain, int count, int by_opening = 0) {
  const Course right = follow(scene, options, Backend::cpu, strain, count, by_opening),
               found = follow(scene, options, Backend::cuda, strain, count, by_opening),
               again = follow(scene, options, Backend::cuda, strain, count, by_opening);
  // forces are out of balance by 1e-10 at most; energies are sums over forces times displacements
  expect_close(found.force, right.force, 1e-9, "force ");
  expect_close(found.moved, right.moved, 1e-9, "displacement ");
  expect_close(found.crack, right.crack, 1e-8, "crack energy ");
  expect_close(found.elastic, right.elastic, 1e-8, "elastic energy ");
  expect_close(found.viscous, right.viscous, 1e-8, "viscous energy ");
  EXPECT_EQ(again.force, found.force);
  EXPECT_EQ(again.moved, found.moved);
  EXPECT_EQ(again.crack, found.crack);
}

QuasiStaticOptions by_iterations() {
  QuasiStaticOptions out;
  out.direct_below = 0;
  return out;
}

TEST_F(QuasiStaticDevice, AgreesInTension) { compare(cracking_t8(), {}, 6e-5, 10); }
TEST_F(QuasiStaticDevice, AgreesInTensionByIterations) { compare(cracking_t8(), by_iterations(), 6e-5, 10); }
TEST_F(QuasiStaticDevice, AgreesInCompression) { compare(cracking_t8(), {}, -1e-4, 8); }
// Friction makes the tangent unsymmetric; GMRES takes over from conjugate gradients.
TEST_F(QuasiStaticDevice, AgreesInCompressionByIterations) { compare(cracking_t8(), by_iterations(), -1e-4, 3); }
TEST_F(QuasiStaticDevice, AgreesUnderControlByOpening) { compare(cracking_t8(), {}, 1e-4, 7, 3); }
TEST_F(QuasiStaticDevice, AgreesUnderControlByOpeningByIterations) {
  compare(cracking_t8(), by_iterations(), 1e-4, 6, 2);
}

// An elastic column of cubes: springs in series, so that the force is known.
TEST_F(QuasiStaticDevice, StretchesAnElasticColumn) {
  HandMade made = cubic_lattice_network(1, 1, 4, 2e-3, 1e-5);
  Laws laws;
  laws.fill(laws::Elastic{1e10, 0.1});
  double compliance = 0;
  for (const Contact& c : made.network.contacts) compliance += c.length / (1e10 * c.moments.a);
  for (const std::size_t direct_below : {std::size_t{0}, std::size_t{6000}}) {
    QuasiStaticOptions options;
    options.backend = Backend::cuda;
    options.direct_below = direct_below;
    QuasiStatic q(made.specimen, made.network, laws, options);
    WallIncrement next;
    next.dt = 1;
    next.wall[driven].z = 1e-7;
    ASSERT_TRUE(q.solve(next).converged);
    q.accept();
    EXPECT_NEAR(q.wall_force()[driven].z, -1e-7 / compliance, 1e-9 * 1e-7 / compliance);
  }
}

// A test that goes on from a state takes the same increments: to the bit with the direct solver, on the same backend
// and from a state of the CPU to the rounding of sums.
TEST_F(QuasiStaticDevice, ContinuesFromStates) {
  const TestScene scene = cracking_t8();
  for (const Backend before : {Backend::cuda, Backend::cpu}) {
    QuasiStaticOptions first_options, options;
    first_options.backend = before, options.backend = Backend::cuda;
    QuasiStatic whole(scene.specimen, scene.network, scene.laws, options),
        first(scene.specimen, scene.network, scene.laws, first_options),
        second(scene.specimen, scene.network, scene.laws, options);
    const auto pull = [](QuasiStatic& q) {
      WallIncrement next;
      next.dt = 6e-5;
      next.wall[driven].z = 6e-5 * t8_height;
      ASSERT_TRUE(q.solve(next).converged);
      q.accept();
    };
    for (int k = 0; k < 5; ++k) pull(whole);
    for (int k = 0; k < 3; ++k) pull(first);
    second.set_state(first.state());
    for (int k = 0; k < 2; ++k) pull(second);
    const double tolerance = before == Backend::cuda ? 0 : 1e-9;
    EXPECT_NEAR(second.wall_force()[driven].z, whole.wall_force()[driven].z,
                tolerance * std::abs(whole.wall_force()[driven].z));
  }
}

// The short report of cracks has the sums of the states of all points.
TEST_F(QuasiStaticDevice, SurveysItsCracks) {
  const TestScene scene = cracking_t8();
  QuasiStaticOptions options;
  options.backend = Backend::cuda;
  QuasiStatic q(scene.specimen, scene.network, scene.laws, options);
  for (int k = 0; k < 12; ++k) {
    WallIncrement next;
    next.dt = 1e-4;
    next.wall[driven].z = 1e-4 * t8_height;
    ASSERT_TRUE(q.solve(next).converged);
    q.accept();
  }
  const auto survey = q.survey_cracks();
  ASSERT_TRUE(survey);
  const std::vector<laws::PointCrack> cracks = q.point_cracks();
  const std::vector<Break> breaks = q.point_breaks();
  double energy = 0;
  std::int64_t cracked = 0, broken = 0;
  for (std::size_t j = 0; j < cracks.size(); ++j) {
    energy += cracks[j].energy * scene.network.point_area[j];
    cracked += cracks[j].damage > 0;
    broken += breaks[j] != Break::none;
  }
  EXPECT_GT(cracked, 100);
  EXPECT_EQ(survey->sums.cracked, cracked);
  EXPECT_EQ(std::ssize(survey->broken), broken);
  EXPECT_NEAR(survey->sums.crack_energy_j, energy, 1e-12 * energy);  // a sum in another order
  EXPECT_NEAR(survey->sums.crack_energy_j, q.energies().crack_j, 1e-12 * energy);
  for (const experiments::CrackEvent& event : survey->broken) {
    EXPECT_EQ(event.how, breaks[event.point]);
    EXPECT_GE(event.point, scene.network.contacts[event.contact].point_begin);
    EXPECT_LT(event.point, scene.network.contacts[event.contact].point_end);
  }
}

TEST_F(QuasiStaticDevice, RefusesSeveralDevices) {
  const TestScene scene = cracking_t8();
  QuasiStaticOptions options;
  options.backend = Backend::cuda;
  options.devices = {0, 0};
  EXPECT_THROW(QuasiStatic(scene.specimen, scene.network, scene.laws, options), InputError);
}

}  // namespace
}  // namespace macadam::test
