// SPDX-License-Identifier: GPL-3.0-or-later
// harmonic_test.cpp  Compares the harmonic solver with known results and with a dense solution, and checks its
// invariants.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <numbers>

#include "host/harmonic/contact_operator.hpp"
#include "host/harmonic/law_stiffness.hpp"
#include "host/network/contact_stiffness.hpp"
#include "host/reference/reference_spectrum.hpp"
#include "macadam/harmonic.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using Complex = std::complex<double>;

HarmonicResult solve(const TestScene& scene, double frequency, double density_scaling = 0) {
  return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency)
      .solve(frequency, density_scaling);
}

TestScene t8() { return make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}})); }

// Compares with the results of an independent program, which has its own tessellation, to the digits that it prints.
TEST(Harmonic, EightNumbersOfT8) {
  const TestScene scene = t8();
  const double frequency[4] = {2, 5, 10, 20};
  const double e_star[4] = {8.710352e9, 10.04199e9, 11.03990e9, 11.69667e9};
  const double phase[4] = {27.43740, 16.73300, 11.73221, 6.97771};
  const double last_digit[4] = {1e3, 1e4, 1e4, 1e4};
  for (const LinearMethod linear : {LinearMethod::iterative, LinearMethod::direct}) {
    Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = linear}, 6);
    for (int i = 0; i < 4; ++i) {
      const HarmonicResult r = harmonic.solve(frequency[i]);
      EXPECT_EQ(r.linear, linear);
      EXPECT_NEAR(r.top.e_star_pa, e_star[i], 0.51 * last_digit[i]);
      EXPECT_NEAR(r.top.phase_deg, phase[i], 0.51e-5);
      EXPECT_LE(r.residual, 1e-11);
      EXPECT_LT(r.iterations, linear == LinearMethod::direct ? 40 : 120);
      // In equilibrium both walls carry the same force, and nothing holds the free motions. The tolerance is the
      // residual of K·u times the condition number.
      EXPECT_NEAR(r.bottom.e_star_pa, r.top.e_star_pa, 1e-9 * r.top.e_star_pa);
      EXPECT_LT(r.held_force, 1e-10);
    }
  }
}

// On t8 a density scaling of 1000 changes |E*| by −1.4e-4 at 20 Hz. The effect of inertia grows as the scaling times
// the square of the frequency.
TEST(Harmonic, InertiaOfScaledMass) {
  const TestScene scene = t8();
  const double still = solve(scene, 20).top.e_star_pa;
  const double at_1000 = solve(scene, 20, 1000).top.e_star_pa / still - 1;
  EXPECT_NEAR(at_1000, -1.4e-4, 0.1e-4);
  EXPECT_NEAR(solve(scene, 20, 100).top.e_star_pa / still - 1, at_1000 / 10, 0.01 * std::abs(at_1000));
  const HarmonicResult scaled = solve(scene, 20, 1000);
  EXPECT_GT(scaled.bottom.e_star_pa, scaled.top.e_star_pa);  // the inertia of the specimen acts between the walls
  // If the solver did not treat free motions separately, inertia would triple the number of iterations.
  EXPECT_LE(solve(scene, 20, 1).iterations, solve(scene, 20).iterations + 2);
}

/// Solves (K* − ω²M)·u = f with dense matrices assembled from the contacts. The minimum-norm solution fixes free
/// motions.
Complex dense_modulus(const TestScene& scene, double frequency, double density_scaling) {
  const double omega = 2 * std::numbers::pi * frequency;
  const auto n = static_cast<Eigen::Index>(6 * scene.specimen.size());
  Eigen::MatrixXcd k = Eigen::MatrixXcd::Zero(n, n);
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(n);
  std::vector<std::pair<std::int32_t, Matrix6>> top;
  auto complex_block = [&](const Contact& c, int i, int j) -> Eigen::Matrix<Complex, 6, 6> {
    const auto& law = *scene.laws[static_cast<std::size_t>(c.pair)];
    const auto stiffness =
        with_stiffness<Complex>(c.pair, law, [&](const auto& l) { return l.stiffness(Complex(0, omega)); });
    const double alpha = std::visit([](const auto& l) { return l.alpha; }, law);
    return stiffness * contact_block(c, 1, alpha, i, j).cast<Complex>();
  };
  for (const Contact& c : scene.network.contacts) {
    k.block<6, 6>(6 * c.a, 6 * c.a) += complex_block(c, 0, 0);
    if (c.b == wall_z_hi) right.segment<6>(6 * c.a) -= complex_block(c, 0, 1).col(2);
    if (c.b < 0) continue;
    k.block<6, 6>(6 * c.b, 6 * c.b) += complex_block(c, 1, 1);
    k.block<6, 6>(6 * c.a, 6 * c.b) += complex_block(c, 0, 1);
    k.block<6, 6>(6 * c.b, 6 * c.a) += complex_block(c, 1, 0);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto particle = static_cast<std::size_t>(i / 6);
    k(i, i) -=
        omega * omega * density_scaling * (i % 6 < 3 ? scene.inertia.mass[particle] : scene.inertia.inertia[particle]);
  }
  const Eigen::VectorXcd u = k.completeOrthogonalDecomposition().solve(right);
  Complex reaction = 0;
  for (const Contact& c : scene.network.contacts) {
    if (c.b != wall_z_hi) continue;
    reaction += (complex_block(c, 1, 1)(2, 2));
    reaction += (complex_block(c, 1, 0).row(2) * u.segment<6>(6 * c.a))(0);
  }
  const Vec3d& box = scene.specimen.box.size;
  return reaction * box.z / (box.x * box.y);
}

TEST(Harmonic, AgreesWithADenseSolutionOnFreshSpecimens) {
  const unsigned seed = test_seed();
  for (const Quadrature quadrature : {Quadrature::lumped, Quadrature::exact}) {
    NetworkSpec spec;
    spec.quadrature = quadrature;
    const TestScene scene = make_scene(random_specimen(seed), spec);
    for (const double density_scaling : {0.0, 1e5}) {
      const Complex expected = dense_modulus(scene, 7, density_scaling);
      const HarmonicResult r = solve(scene, 7, density_scaling);
      // 480 unknowns with a condition number of about 1e5; a tolerance of 1e-9 leaves a margin of two digits
      EXPECT_NEAR(r.top.e_star_pa, std::abs(expected), 1e-9 * std::abs(expected)) << "seed " << seed;
      EXPECT_NEAR(r.top.phase_deg, std::arg(expected) * 180 / std::numbers::pi, 1e-7) << "seed " << seed;
    }
  }
}

// At the frequencies of this test the scaled specimen is beyond its first resonances. The matrix is indefinite, and
// near a resonance it is almost singular. The solver must either give the right number or refuse. Tolerance: condition
// numbers of about 1e8 times a residual of 1e-11, with some margin.
TEST(Harmonic, BeyondResonanceTheNumberIsRightOrThereIsNone) {
  const TestScene scene = make_scene(random_specimen(8));
  int found = 0, by_factors = 0;
  for (double scaling = 1e6; scaling < 1e10; scaling *= 1.7) {
    const Complex expected = dense_modulus(scene, 20, scaling);
    try {
      const HarmonicResult r = solve(scene, 20, scaling);
      const Complex modulus = r.parts.modulus();
      EXPECT_NEAR(std::abs(modulus / expected - 1.0), 0, 1e-6) << scaling;
      ++found;
      by_factors += r.linear == LinearMethod::direct;
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find("near a resonance"), std::string::npos);
    }
  }
  EXPECT_GT(found, 5);
  RecordProperty("found", found);
  RecordProperty("by_factors", by_factors);
}

TEST(Harmonic, ElasticSceneIsTheStaticModulus) {
  Laws laws;
  for (std::size_t pair = 0; pair < pair_types; ++pair) laws[pair] = laws::Elastic{1e10 * (1.0 + double(pair)), 0.2};
  const TestScene scene = make_scene(random_specimen(4), {}, laws);
  const HarmonicResult r =
      Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = LinearMethod::direct}, 3).solve(3);
  EXPECT_NEAR(r.top.e_star_pa, reference_static_modulus(scene.specimen, scene.network, scene.laws),
              1e-8 * r.top.e_star_pa);
  EXPECT_NEAR(r.top.phase_deg, 0, 1e-9);
  EXPECT_EQ(r.iterations, 1);  // the preconditioner equals the matrix
}

// Walls in a laboratory are rigid. If the wall's reaction were computed as stiffness times opening, only four digits
// would be right for a wall that is 1e12 times as stiff as the specimen. The effect of a finite stiffness of the walls
// is proportional to the inverse of this stiffness.
TEST(Harmonic, WallsFarStifferThanTheSpecimen) {
  TestScene scene = t8();
  const auto with = [&](double factor) {
    for (const PairType pair : {PairType::aw, PairType::mw}) {
      scene.laws[static_cast<std::size_t>(pair)] = laws::Elastic{factor * 1e11, 0.0};
    }
    return solve(scene, 20);
  };
  const double rigid = with(1e8).top.e_star_pa;
  for (const double factor : {1e10, 1e12}) {
    const HarmonicResult r = with(factor);
    EXPECT_NEAR(r.top.e_star_pa / rigid, 1, 1e-8) << factor;
    // The reaction of the bottom wall contains the error of the solution times the wall's stiffness.
    EXPECT_NEAR(r.bottom.e_star_pa / rigid, 1, 1e-6) << factor;
    EXPECT_NEAR(r.top.phase_deg, r.bottom.phase_deg, 1e-4) << factor;
  }
}

/// A particle without contacts is named in the error.
TEST(Harmonic, ClusterThatFloatsIsNamed) {
  TestScene scene = make_scene(random_specimen(6));
  std::vector<Contact> kept;
  for (const Contact& c : scene.network.contacts) {
    if (c.a != 17 && c.b != 17) kept.push_back(c);
  }
  scene.network.contacts = kept;
  scene.network.row_begin.assign(1, 0);
  scene.network.rows.clear();
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(scene.specimen.size()); ++i) {
    for (std::uint32_t c = 0; c < kept.size(); ++c) {
      if (kept[c].a == i || kept[c].b == i) scene.network.rows.push_back(c);
    }
    scene.network.row_begin.push_back(static_cast<std::uint32_t>(scene.network.rows.size()));
  }
  try {
    solve(scene, 2);
    FAIL() << "a particle without contacts was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("1 particles (17)"), std::string::npos) << error.what();
  }
}

TEST(Harmonic, APairWithoutALawIsNamed) {
  TestScene scene = make_scene(random_specimen(6));
  scene.laws[static_cast<std::size_t>(PairType::ma)].reset();
  try {
    solve(scene, 2);
    FAIL() << "a pair without a law was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("M-A"), std::string::npos) << error.what();
  }
}

// The operator collects contacts with the z walls in pieces of 65,536; this network has three pieces. All numbers are
// integers, so sums are exact.
TEST(ContactOperator, EveryWallContactCountsOnceInALargeNetwork) {
  ContactNetwork network;
  double area[2] = {};  // total area of the contacts of the bottom and of the top wall
  for (int i = 0; i < 140'000; ++i) {
    const bool top = i % 2 == 1;
    Contact c;
    c.b = top ? wall_z_hi : wall_z_lo;
    c.pair = PairType::mw;
    c.n = {0, 0, top ? 1.0 : -1.0};
    canonical_frame(c.n, c.s, c.t);
    c.length = c.distance = c.arm_a = 0.5;
    c.area = c.moments.a = 1 + i % 3;
    area[top] += c.area;
    network.contacts.push_back(c);
  }
  harmonic::PairStiffness stiffness;
  stiffness.k.fill({2, 1});
  const Complex of_an_area = Complex(2, 1) / 0.5;
  const harmonic::ContactOperator contacts(network, 1);
  const harmonic::Loads loads = contacts.wall_loads(stiffness);
  ASSERT_EQ(loads.size(), 1);
  EXPECT_EQ(loads[0].particle, 0);
  EXPECT_EQ(loads[0].load, (std::array<Complex, 6>{0, 0, of_an_area * area[1], 0, 0, 0}));
  EXPECT_EQ(contacts.bottom_load(stiffness, {0, 0, 1, 0, 0, 0}), -of_an_area * area[0]);
}

TEST(Harmonic, MechanismIsRefused) {
  Laws laws;  // no shear stiffness and, with the moments set to zero, no bending stiffness
  laws.fill(laws::Elastic{1e10, 0.0});
  TestScene scene = make_scene(random_specimen(8), {}, laws);
  for (Contact& c : scene.network.contacts) c.moments = {c.moments.a, 0, 0, 0, 0, 0};
  EXPECT_THROW(solve(scene, 2), RunError);
}

}  // namespace
}  // namespace macadam::test
