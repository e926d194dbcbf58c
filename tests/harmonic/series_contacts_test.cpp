// SPDX-License-Identifier: GPL-3.0-or-later
// series_contacts_test.cpp  Contacts whose law has a length of rock in series, in the frequency domain: compares with a
// dense solution, with closed forms, and derivatives with differences.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <functional>
#include <numbers>
#include <random>

#include "host/harmonic/law_stiffness.hpp"
#include "host/network/contact_stiffness.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/sensitivity.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

using Complex = std::complex<double>;

/// Returns a random specimen whose contacts have random lengths, and rock in series of up to three times the compliance
/// of 1e10 Pa. Pairs A-A have the α of a film with a Poisson's ratio of 0.35.
TestScene scene_with_rock(unsigned seed) {
  TestScene scene = make_scene(random_specimen(seed), {}, am1_laws());
  std::visit([](auto& law) { law.alpha = 0.2308; }, *scene.laws[static_cast<std::size_t>(PairType::aa)]);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (Contact& c : scene.network.contacts) {
    c.length = c.distance * (0.05 + 0.95 * uniform(random));
    if (uniform(random) > 0.3) c.series = 3e-10 * uniform(random);
  }
  return scene;
}

/// Returns the stiffness block of a contact from its two springs: law and rock, in normal and in shear direction.
Eigen::Matrix<Complex, 6, 6> block_of(const Contact& c, Complex k, double alpha, int i, int j) {
  Contact plain = c;
  plain.series = 0;
  const Matrix6 normal = contact_block(plain, 1, 0, i, j), shear = contact_block(plain, 1, 1, i, j) - normal;
  const auto of_both = [&](Complex law) { return 1.0 / (1.0 / law + c.series); };
  return of_both(k) * normal.cast<Complex>() + (alpha == 0 ? Complex(0) : of_both(alpha * k)) * shear.cast<Complex>();
}

Complex dense_modulus(const TestScene& scene, double frequency) {
  const auto n = static_cast<Eigen::Index>(6 * scene.specimen.size());
  Eigen::MatrixXcd k = Eigen::MatrixXcd::Zero(n, n);
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(n);
  const auto block = [&](const Contact& c, int i, int j) {
    const auto& law = *scene.laws[static_cast<std::size_t>(c.pair)];
    const Complex s(0, 2 * std::numbers::pi * frequency);
    return block_of(c, with_stiffness<Complex>(c.pair, law, [&](const auto& l) { return l.stiffness(s); }),
                    std::visit([](const auto& l) { return l.alpha; }, law), i, j);
  };
  for (const Contact& c : scene.network.contacts) {
    k.block<6, 6>(6 * c.a, 6 * c.a) += block(c, 0, 0);
    if (c.b == wall_z_hi) right.segment<6>(6 * c.a) -= block(c, 0, 1).col(2);
    if (c.b < 0) continue;
    k.block<6, 6>(6 * c.b, 6 * c.b) += block(c, 1, 1);
    k.block<6, 6>(6 * c.a, 6 * c.b) += block(c, 0, 1);
    k.block<6, 6>(6 * c.b, 6 * c.a) += block(c, 1, 0);
  }
  const Eigen::VectorXcd u = k.completeOrthogonalDecomposition().solve(right);
  Complex reaction = 0;
  for (const Contact& c : scene.network.contacts) {
    if (c.b != wall_z_hi) continue;
    reaction += block(c, 1, 1)(2, 2) + (block(c, 1, 0).row(2) * u.segment<6>(6 * c.a))(0);
  }
  const Vec3d& box = scene.specimen.box.size;
  return reaction * box.z / (box.x * box.y);
}

// One load and four, by both solvers. 480 unknowns with a condition number of about 1e5; a tolerance of 1e-9 leaves a
// margin of two digits.
TEST(SeriesContacts, AgreeWithADenseSolution) {
  const unsigned seed = test_seed();
  const TestScene scene = scene_with_rock(seed);
  for (const LinearMethod linear : {LinearMethod::iterative, LinearMethod::direct}) {
    Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = linear}, 7);
    std::vector<HarmonicResult> found = harmonic.solve(std::vector<HarmonicLoad>{
        {.frequency_hz = 2}, {.frequency_hz = 7}, {.frequency_hz = 20}, {.frequency_hz = 50}});
    found.push_back(harmonic.solve(7));
    for (const HarmonicResult& r : found) {
      const Complex expected = dense_modulus(scene, r.frequency_hz);
      EXPECT_NEAR(r.top.e_star_pa, std::abs(expected), 1e-9 * std::abs(expected)) << "seed " << seed;
      EXPECT_NEAR(r.top.phase_deg, std::arg(expected) * 180 / std::numbers::pi, 1e-7) << "seed " << seed;
      EXPECT_NEAR(r.bottom.e_star_pa, r.top.e_star_pa, 1e-9 * r.top.e_star_pa);
    }
  }
}

// On a network with α = 1 and one law everywhere a uniform strain without lateral strain is the solution, so ν = 0.
// The tolerance is the residual of the solution times its condition number.
TEST(PoissonRatio, IsZeroIfNormalAndShearStiffnessAreEqual) {
  Laws laws;
  laws.fill(laws::Elastic{2e10, 1.0});
  const Specimen specimen = random_specimen(4);
  const Tessellation cells = tessellate(specimen);
  const ContactNetwork network = build_network(specimen, cells);
  const Inertia inertia = make_inertia(specimen, 1, 1);
  const HarmonicResult found = Harmonic(specimen, network, laws, inertia, {}, 1).solve(1);
  EXPECT_NEAR(found.top.e_star_pa, 2e10, 2e10 * 1e-10);
  const auto ratio = poisson_ratio(specimen, cells, found);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(std::abs(*ratio), 0, 1e-8);
}

// With a smaller shear stiffness the sides move inwards. A uniform strain of a network with normals in all directions
// gives ν = (1 − α)/(4 + α). The spheres of this specimen stand near the points of a cubic grid, so most normals are
// near the axes, where they do not couple the axes: ν lies between a third of this value and the value.
TEST(PoissonRatio, GrowsAsTheShearStiffnessFalls) {
  const Specimen specimen = random_specimen(4, 6, 6, 7);
  const Tessellation cells = tessellate(specimen);
  const ContactNetwork network = build_network(specimen, cells);
  const Inertia inertia = make_inertia(specimen, 1, 1);
  double before = 0;
  for (const double alpha : {0.6, 0.3, 0.1}) {
    Laws laws;
    laws.fill(laws::Elastic{2e10, alpha});
    for (const PairType wall : {PairType::aw, PairType::mw})  // platens without friction
      laws[static_cast<std::size_t>(wall)] = laws::Elastic{2e10, 0};
    const HarmonicResult found = Harmonic(specimen, network, laws, inertia, {}, 1).solve(1);
    const double ratio = poisson_ratio(specimen, cells, found)->real();
    EXPECT_GT(ratio, before) << "alpha " << alpha;
    const double isotropic = (1 - alpha) / (4 + alpha);
    EXPECT_GT(ratio, isotropic / 3) << "alpha " << alpha;
    EXPECT_LT(ratio, isotropic) << "alpha " << alpha;
    before = ratio;
  }
}

// With α = 1 an elastic law and rock in series are one spring of another length.
TEST(SeriesContacts, AreLongerContactsIfAllIsElastic) {
  Laws laws;
  laws.fill(laws::Elastic{2e10, 1.0});
  TestScene scene = scene_with_rock(3);
  scene.laws = laws;
  TestScene longer = scene;
  for (Contact& c : longer.network.contacts) c.length *= 1 + 2e10 * c.series, c.series = 0;
  const auto solve = [](const TestScene& s) {
    return Harmonic(s.specimen, s.network, s.laws, s.inertia, {}, 1).solve(1).top.e_star_pa;
  };
  const double expected = solve(longer);
  EXPECT_NEAR(solve(scene), expected, 1e-9 * expected);
}

HarmonicResult solve_at_7_hz(const TestScene& s) {
  return Harmonic(s.specimen, s.network, s.laws, s.inertia, {}, 7).solve(7);
}

/// Compares the derivatives of |E*| and φ with a central difference of 1e-4 of the parameter `name`, which
/// change(scene, factor) multiplies by a factor. The error of the difference is 1e-8 of the derivative, and rounding
/// adds 1e-11/1e-4 of E*.
void expect_derivative(const TestScene& scene, double modulus, const std::vector<Sensitivity>& list,
                       const std::string& name, const std::function<void(TestScene&, double)>& change) {
  const auto at = [&](double factor) {
    TestScene changed = scene;
    change(changed, factor);
    return solve_at_7_hz(changed).top;
  };
  const double step = 1e-4;
  const Stiffness more = at(1 + step), less = at(1 - step);
  const auto entry = std::find_if(list.begin(), list.end(), [&](const Sensitivity& s) { return s.parameter == name; });
  ASSERT_NE(entry, list.end()) << name;
  EXPECT_NEAR(entry->d_e_star_pa, (more.e_star_pa - less.e_star_pa) / (2 * step), 1e-6 * modulus) << name;
  EXPECT_NEAR(entry->d_phase_deg, (more.phase_deg - less.phase_deg) / (2 * step), 1e-4) << name;
}

TEST(SeriesContacts, DerivativesAgreeWithDifferences) {
  const TestScene scene = scene_with_rock(5);
  const HarmonicResult found = solve_at_7_hz(scene);
  const auto list = sensitivities(found.parts, scene.laws, Complex(0, 2 * std::numbers::pi * 7));
  const auto expect = [&](const std::string& name, auto&& change) {
    expect_derivative(scene, found.top.e_star_pa, list, name, change);
  };
  expect("rock.E", [](TestScene& s, double factor) {
    for (Contact& c : s.network.contacts) c.series /= factor;
  });
  const auto law = [](TestScene & s, PairType pair) -> auto& { return *s.laws[static_cast<std::size_t>(pair)]; };
  expect("M-A.E_m",
         [&](TestScene& s, double factor) { std::get<laws::GeneralisedKelvin>(law(s, PairType::ma)).E_m *= factor; });
  expect("A-A.alpha",
         [&](TestScene& s, double factor) { std::get<laws::Elastic>(law(s, PairType::aa)).alpha *= factor; });
}

// With the laws of the phases one parameter changes all pairs that have this law, and the rock changes the pairs of the
// rock and the compliances in series.
TEST(SeriesContacts, DerivativesByPhaseAgreeWithDifferences) {
  TestScene scene = scene_with_rock(5);
  laws::GeneralisedKelvin mastic = mastic_am1(), film = mastic;
  mastic.alpha = 1, film.alpha = 0.2308;
  scene.laws = same_law(mastic);
  const auto law = [](TestScene & s, PairType pair) -> auto& { return *s.laws[static_cast<std::size_t>(pair)]; };
  law(scene, PairType::aa) = film;
  for (const PairType pair : {PairType::inner, PairType::aw}) {
    law(scene, pair) = laws::Elastic{6e10, 1};
    for (Contact& c : scene.network.contacts)
      if (c.pair == pair) c.series = 0;
  }
  const HarmonicResult found = solve_at_7_hz(scene);
  const auto list = phase_sensitivities(found.parts, scene.laws, Complex(0, 2 * std::numbers::pi * 7));
  EXPECT_EQ(list.size(), 9u) << "E_m, C_m, three pairs of E and C, E of the rock";
  const auto expect = [&](const std::string& name, auto&& change) {
    expect_derivative(scene, found.top.e_star_pa, list, name, change);
  };
  const auto of_mastic = [&](auto&& change) {
    return [&, change](TestScene& s, double factor) {
      for (const PairType pair : {PairType::mm, PairType::ma, PairType::aa, PairType::mw})
        change(std::get<laws::GeneralisedKelvin>(law(s, pair)), factor);
    };
  };
  expect("mastic.E_m", of_mastic([](auto& l, double factor) { l.E_m *= factor; }));
  expect("mastic.C_m", of_mastic([](auto& l, double factor) { l.C_m *= factor; }));
  expect("mastic.C_2", of_mastic([](auto& l, double factor) { l.C[1] *= factor; }));
  expect("aggregate.E", [&](TestScene& s, double factor) {
    for (const PairType pair : {PairType::inner, PairType::aw}) std::get<laws::Elastic>(law(s, pair)).E *= factor;
    for (Contact& c : s.network.contacts) c.series /= factor;
  });
}

}  // namespace
}  // namespace macadam::test
