// SPDX-License-Identifier: GPL-3.0-or-later
// free_motions_test.cpp  Free motions are motions that no contact resists: columns turn, parts slide, single spheres
// rotate. A specimen with free motions still has a unique modulus.
#include <gtest/gtest.h>

#include "host/harmonic/rigid_motions.hpp"
#include "macadam/harmonic.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

constexpr double of_mastic = 1e9, of_mixed = 3e9, of_aggregate = 5e9, of_wall = 2e9;  // moduli of the contacts [Pa]

Laws laws_of(double mm, double ma, double aa) {
  Laws out;
  const auto set = [&](PairType pair, double e, double alpha) {
    out[static_cast<std::size_t>(pair)] = laws::Elastic{e, alpha};
  };
  set(PairType::mm, of_mastic, mm), set(PairType::ma, of_mixed, ma), set(PairType::aa, of_aggregate, aa);
  set(PairType::mw, of_wall, 0), set(PairType::aw, of_wall, 0), set(PairType::inner, of_aggregate, aa);
  return out;
}

/// Returns a cubic lattice of nx × nx × nz touching spheres of radius 1 mm. Layer z is aggregate if `is_aggregate(z)`,
/// otherwise mastic.
Specimen lattice(int nx, int nz, const std::function<bool(int z)>& is_aggregate) {
  Specimen s;
  s.box.size = {2e-3 * nx, 2e-3 * nx, 2e-3 * nz};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < nx; ++y)
      for (int x = 0; x < nx; ++x) {
        s.centre.push_back({(2 * x + 1) * 1e-3, (2 * y + 1) * 1e-3, (2 * z + 1) * 1e-3});
        s.radius.push_back(1e-3);
        s.phase.push_back(is_aggregate(z) ? Phase::aggregate : Phase::mastic);
        s.body.push_back(is_aggregate(z) ? static_cast<std::int32_t>(s.size()) : -1);
      }
  return s;
}

/// Returns the modulus of the contacts in series: half a layer at each wall, and a layer between successive centres.
double in_series(const Specimen& s, int nz) {
  const std::size_t per_layer = s.size() / static_cast<std::size_t>(nz);
  double soft = 2 * 0.5 / of_wall;
  for (std::size_t z = 0; z + 1 < static_cast<std::size_t>(nz); ++z) {
    const int aggregates =
        (s.phase[z * per_layer] == Phase::aggregate) + (s.phase[(z + 1) * per_layer] == Phase::aggregate);
    soft += 1 / (aggregates == 0 ? of_mastic : aggregates == 1 ? of_mixed : of_aggregate);
  }
  return nz / soft;
}

bool none(int) { return false; }
bool every_other(int z) { return z % 2 == 1; }

class FreeMotions : public BackendTest<std::tuple<Backend>> {
 protected:
  double modulus(const TestScene& scene, LinearMethod linear, double density_scaling = 0) const {
    HarmonicOptions options;
    options.linear = linear;
    options.backend = linear == LinearMethod::direct ? Backend::cpu : backend();
    const HarmonicResult r =
        Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, options, 5).solve(5, density_scaling);
    EXPECT_EQ(r.linear, linear == LinearMethod::automatic ? r.linear : linear);
    EXPECT_LT(r.held_force, 1e-10);
    return r.top.e_star_pa;
  }
  /// Expects that the direct and the iterative solver find the modulus `expected`. The tolerance is the rounding of
  /// about ten contacts times the condition number of the matrix, which is at most 1e4.
  void expect_by_both(const TestScene& scene, double expected) const {
    for (const LinearMethod linear : {LinearMethod::direct, LinearMethod::iterative})
      EXPECT_NEAR(modulus(scene, linear) / expected, 1, 1e-11) << to_string(linear);
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, FreeMotions, testing::Combine(all_backends()), name_of_case<Backend>);

std::size_t number_of_free_motions(const TestScene& scene) {
  const auto found = harmonic::find_free_motions(
      scene.specimen, scene.network, harmonic::pair_stiffness(scene.laws, harmonic::Complex(0, 1)), scene.inertia);
  EXPECT_EQ(found.pins.size(), found.motions.size());
  return found.motions.size();
}

// A single sphere can rotate about the vertical through its centre. The modulus equals the modulus of the wall
// contacts, also if the box is not a cube and the sphere is not in the middle of the box.
TEST_P(FreeMotions, OneSphere) {
  Specimen s = lattice(1, 1, none);
  expect_by_both(make_scene(s, {}, laws_of(0.1, 0.1, 0.1)), of_wall);
  s.box.size = {5e-3, 4e-3, 5e-3};
  s.centre[0] = {2e-3, 2.5e-3, 1.5e-3};
  expect_by_both(make_scene(s, {}, laws_of(0.1, 0.1, 0.1)), of_wall);
}

/// A column has three free motions. The modulus follows from its contacts in series.
TEST_P(FreeMotions, ColumnsTurnAboutTheirAxis) {
  for (const int n : {2, 3, 7}) {
    const TestScene scene = make_scene(lattice(1, n, every_other), {}, laws_of(0.1, 0.1, 0.1));
    EXPECT_EQ(number_of_free_motions(scene), 3u);
    expect_by_both(scene, in_series(scene.specimen, n));
  }
}

// Without shear stiffness each sphere of a column can slide and rotate on its own. The iterative solver refuses more
// free motions than it can exclude.
TEST_P(FreeMotions, ColumnsWithoutShear) {
  const TestScene two = make_scene(lattice(1, 2, none), {}, laws_of(0, 0, 0));
  EXPECT_EQ(number_of_free_motions(two), 6u);
  expect_by_both(two, 4e9 / 3);
  const TestScene ten = make_scene(lattice(1, 10, none), {}, laws_of(0, 0, 0));
  EXPECT_EQ(number_of_free_motions(ten), 30u);
  EXPECT_NEAR(modulus(ten, LinearMethod::automatic) / in_series(ten.specimen, 10), 1, 1e-11);
  EXPECT_HAS(message_of([&] { modulus(ten, LinearMethod::iterative); }), "found 30 rigid motions");
}

// Mastic on mastic resists sliding, mastic on aggregate does not. So the layers M M A M M form three parts with three
// free motions each.
TEST_P(FreeMotions, PartsOfAColumnSlideOnOneAnother) {
  const TestScene scene = make_scene(lattice(1, 5, [](int z) { return z == 2; }), {}, laws_of(0.1, 0, 0.1));
  EXPECT_EQ(number_of_free_motions(scene), 9u);
  EXPECT_NEAR(modulus(scene, LinearMethod::direct) / in_series(scene.specimen, 5), 1, 1e-11);
}

/// Two blocks of several columns slide on each other; each block has three free motions.
TEST_P(FreeMotions, TwoBlocksSlideOnOneAnother) {
  const TestScene scene = make_scene(lattice(3, 4, [](int z) { return z >= 2; }), {}, laws_of(0.1, 0, 0.1));
  EXPECT_EQ(number_of_free_motions(scene), 6u);
  expect_by_both(scene, in_series(scene.specimen, 4));
}

// Each facet has only one contact point, which lies on the axis of the column, so nothing resists the rotation of a
// sphere about this axis. The spheres at the two ends of the column can also tilt about their only contact point.
TEST_P(FreeMotions, SpheresOfAColumnTurnByThemselvesAboutSinglePoints) {
  NetworkSpec spec;
  spec.quadrature = Quadrature::one_point;
  const TestScene scene = make_scene(lattice(1, 2, none), spec, laws_of(0.1, 0.1, 0.1));
  EXPECT_NEAR(modulus(scene, LinearMethod::direct) / (4e9 / 3), 1, 1e-11);
}

// The inertia of free motions does not contribute to the load, so the direct and the iterative solver agree with
// inertia too.
TEST_P(FreeMotions, BothSolversAgreeWithInertia) {
  for (const auto& laws : {laws_of(0.1, 0.1, 0.1), laws_of(0, 0, 0)}) {
    const TestScene scene = make_scene(lattice(1, 2, every_other), {}, laws);
    const double direct = modulus(scene, LinearMethod::direct, 1e6);
    EXPECT_GT(std::abs(direct / in_series(scene.specimen, 2) - 1), 1e-6);
    EXPECT_NEAR(modulus(scene, LinearMethod::iterative, 1e6) / direct, 1, 1e-10);
  }
}

// The free motions of the three parts of a column are orthonormal with respect to mass.
TEST(FreeMotionsOfParts, AreOrthonormal) {
  const TestScene scene = make_scene(lattice(1, 5, [](int z) { return z == 2; }), {}, laws_of(0.1, 0, 0.1));
  const auto found = harmonic::find_free_motions(
      scene.specimen, scene.network, harmonic::pair_stiffness(scene.laws, harmonic::Complex(0, 1)), scene.inertia);
  const std::size_t n = 6 * scene.specimen.size();
  std::vector<std::vector<double>> whole;
  for (const harmonic::FreeMotion& m : found.motions) {
    std::vector<double>& one = whole.emplace_back(n, 0.0);
    for (std::size_t i = 0; i < m.motion.size(); ++i)
      one[6 * static_cast<std::size_t>(m.particles[i / 6]) + i % 6] = m.motion[i];
  }
  for (std::size_t a = 0; a < whole.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      double product = 0;
      for (std::size_t i = 0; i < n; ++i) product += whole[a][i] * harmonic::inertia_at(scene.inertia, i) * whole[b][i];
      EXPECT_NEAR(product, a == b, 1e-12) << a << " " << b;
    }
}

}  // namespace
}  // namespace macadam::test
