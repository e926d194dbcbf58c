// SPDX-License-Identifier: GPL-3.0-or-later
// iterative_test.cpp  The frequency domain without factors: against factors, for every kind of network, and in blocks.
#include <gtest/gtest.h>
#include <omp.h>

#include "cluster_specimens.hpp"
#include "host/harmonic/iterative/contact_rows.hpp"
#include "host/harmonic/linear_solver.hpp"
#include "macadam/harmonic.hpp"
#include "test_scenes.hpp"

namespace macadam::test {
namespace {

using harmonic::Complex;

const std::vector<double> frequencies{2, 5, 10, 20};

std::vector<HarmonicResult> solve(const TestScene& scene, LinearMethod linear, const std::vector<HarmonicLoad>& loads) {
  return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = linear}, 6).solve(loads);
}

/// E* enters by the square of residuals of 1e-11 times the condition, some 1e5: what is left is rounding of the sums.
void expect_same(const TestScene& scene, const std::vector<HarmonicLoad>& loads, const std::string& what,
                 double tolerance = 1e-9) {
  const auto found = solve(scene, LinearMethod::iterative, loads), expected = solve(scene, LinearMethod::direct, loads);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    EXPECT_EQ(found[i].linear, LinearMethod::iterative);
    EXPECT_NEAR(found[i].top.e_star_pa / expected[i].top.e_star_pa, 1, tolerance) << what;
    EXPECT_NEAR(found[i].top.phase_deg, expected[i].top.phase_deg, 100 * tolerance) << what;
    EXPECT_NEAR(found[i].bottom.e_star_pa / expected[i].bottom.e_star_pa, 1, 10 * tolerance) << what;
  }
}

std::vector<HarmonicLoad> loads_of(double density_scaling = 0, double viscous_damping = 0) {
  std::vector<HarmonicLoad> out;
  for (const double f : frequencies) out.push_back({f, density_scaling, viscous_damping});
  return out;
}

TEST(Iterative, AgreesWithFactorsForEveryKindOfNetwork) {
  const unsigned seed = test_seed();
  const Specimen specimen = random_specimen(seed);
  for (const Quadrature quadrature : {Quadrature::lumped, Quadrature::exact}) {
    for (const bool walls : {false, true}) {
      NetworkSpec spec;
      spec.quadrature = quadrature;
      spec.lateral_walls = walls;
      for (const Laws& laws : {am1_laws(), am2_laws()}) {
        expect_same(make_scene(specimen, spec, laws), loads_of(), std::to_string(seed));
      }
    }
  }
}

TEST(Iterative, AgreesWithFactorsWithInertiaAndDamping) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  for (const double scaling : {1.0, 1e3, 1e5}) {
    for (const double damping : {0.0, 50.0}) expect_same(scene, loads_of(scaling, damping), std::to_string(scaling));
  }
}

TEST(Iterative, AgreesWithFactorsOnClusters) {
  for (const Laws& laws : {am1_laws(), am2_laws()}) {
    expect_same(make_scene(few_clusters(test_seed()), {}, laws), loads_of(), "clusters");
  }
}

// Almost without shear stiffness facets still resist bending, which is far softer: the condition grows, and so does the
// error.
TEST(Iterative, AgreesWithFactorsAlmostWithoutShear) {
  Laws laws = am1_laws();
  for (auto& law : laws) std::visit([](auto& l) { l.alpha = 1e-3; }, *law);
  expect_same(make_scene(random_specimen(test_seed()), {}, laws), loads_of(), "alpha = 0.001", 1e-8);
}

// What the iteration cannot do in double precision, factors do: the residual of 1e-11 is below rounding there.
TEST(Iterative, ContrastsOfStiffness) {
  for (const double contrast : {1e2, 1e4}) {
    Laws laws;
    laws.fill(laws::Elastic{1e9, 0.1});
    laws[static_cast<std::size_t>(PairType::aa)] = laws::Elastic{1e9 * contrast, 0.1};
    laws[static_cast<std::size_t>(PairType::ma)] = laws::Elastic{1e9 * std::sqrt(contrast), 0.1};
    expect_same(make_scene(random_specimen(test_seed()), {}, laws), loads_of(), std::to_string(contrast), 1e-8);
  }
}

// One frequency alone takes other code than four together, and begins elsewhere than from rest after another inertia.
TEST(Iterative, OneAtATimeGivesTheSame) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  const auto together = solve(scene, LinearMethod::iterative, loads_of(1e4));
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = LinearMethod::iterative}, 6);
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    harmonic.solve(frequencies[i]);
    const HarmonicResult alone = harmonic.solve(frequencies[i], 1e4);
    EXPECT_NEAR(alone.top.e_star_pa / together[i].top.e_star_pa, 1, 1e-10);
    EXPECT_NEAR(alone.top.phase_deg, together[i].top.phase_deg, 1e-8);
  }
  const auto three = solve(scene, LinearMethod::iterative, {{2, 1e4}, {5, 1e4}, {20, 1e4}});
  EXPECT_NEAR(three[2].top.e_star_pa / together[3].top.e_star_pa, 1, 1e-10);
}

TEST(Iterative, SameBitsForAnyNumberOfThreads) {
  const TestScene scene = make_scene(random_specimen(test_seed(), 6, 6, 8));
  const int before = omp_get_max_threads();
  std::vector<std::vector<Complex>> motions;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    motions.push_back(solve(scene, LinearMethod::iterative, loads_of())[1].motion);
  }
  omp_set_num_threads(before);
  EXPECT_TRUE(motions[0] == motions[1] && motions[0] == motions[2]);
}

// Boxes of particles take part in the preconditioner alone: however many there are, the solution is the same, and with
// more of them it takes fewer iterations.
TEST(Iterative, BoxesSaveIterationsAndChangeNoSolution) {
  const TestScene scene = make_scene(random_specimen(test_seed(), 8, 8, 20));
  const std::size_t n = scene.specimen.size();
  const auto stiffness = harmonic::pair_stiffness(scene.laws, 40);
  const auto free = harmonic::find_free_motions(scene.specimen, scene.network, stiffness, scene.inertia);
  harmonic::LinearTask asked;
  asked.stiffness = stiffness;
  asked.tolerance = 1e-10;
  const harmonic::ContactOperator contacts(scene.network, n);
  contacts.forces(stiffness, harmonic::Vector(6 * n, 0), 1.0, asked.right);
  const auto modulus = [&](const harmonic::LinearTask& t) {
    return contacts.energy_parts(stiffness, t.motion, 1.0).modulus();
  };
  const auto solved = [&](std::optional<std::size_t> boxes) {
    harmonic::LinearTask task = asked;
    harmonic::make_iterative_solver(scene.specimen, scene.network, stiffness, scene.inertia, free, boxes)
        ->solve({&task});
    EXPECT_TRUE(task.converged);
    return task;
  };
  const auto usual = solved({}), none = solved(0), few = solved(4), same = solved(harmonic::usual_boxes(n));
  EXPECT_TRUE(same.motion == usual.motion && same.iterations == usual.iterations);
  EXPECT_LT(usual.iterations, few.iterations);
  EXPECT_LT(few.iterations, none.iterations);
  for (const auto* task : {&none, &few}) {  // E* by the square of residuals of 1e-10 times the condition, some 1e5
    EXPECT_NEAR(std::abs(modulus(*task) / modulus(usual) - 1.0), 0, 1e-9);
  }
}

/// The rows' kernels against the operator that the checks of a solution use.
template <int F>
void expect_same_rows() {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  const std::size_t n = scene.specimen.size();
  const auto layout = kernels::make_layout(scene.specimen, scene.network, 1, 100);
  const harmonic::ContactRows rows(scene.network, layout);
  const harmonic::ContactOperator contacts(scene.network, n);
  harmonic::BlockStiffness<F> block;
  block.inert = false;
  harmonic::LaneVector<F> x(6 * n);
  std::vector<harmonic::Vector> motion(F, harmonic::Vector(6 * n)), expected(F);
  for (int f = 0; f < F; ++f) {
    const auto own = harmonic::pair_stiffness(scene.laws, 10.0 * (f + 1));
    const Complex inertia(1e7 * (f + 1), -1e6);
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      block.k[pair].set(f, own.k[pair]);
      block.alpha[pair] = own.alpha[pair];
    }
    block.inertia.set(f, inertia);
    for (std::size_t i = 0; i < 6 * n; ++i) motion[f][i] = {std::sin(1.0 + double(i) * (f + 1)), std::cos(double(i))};
    contacts.resistance(own, inertia, scene.inertia, motion[f], expected[f]);
    for (std::size_t body = 0; body < n; ++body) {
      for (std::size_t c = 0; c < 6; ++c) {
        x[6 * body + c].set(f, motion[f][6 * static_cast<std::size_t>(layout.particle[body]) + c]);
      }
    }
  }
  for (std::size_t body = 0; body < n; ++body) {
    const auto particle = static_cast<std::size_t>(layout.particle[body]);
    double mass[6];
    for (std::size_t c = 0; c < 6; ++c) mass[c] = harmonic::inertia_at(scene.inertia, 6 * particle + c);
    harmonic::Lanes<F> out[6];
    harmonic::apply_row<F>(rows, block, mass, body, x, out);
    for (int f = 0; f < F; ++f) {
      double scale = 0;
      for (std::size_t i = 0; i < 6 * n; ++i) scale = std::max(scale, std::abs(expected[f][i]));
      for (std::size_t c = 0; c < 6; ++c) {  // some 15 contacts of a dozen products each
        EXPECT_NEAR(std::abs(out[c].at(f) - expected[f][6 * particle + c]), 0, 1e-14 * scale);
      }
    }
  }
}
TEST(Iterative, RowsOfOneFrequency) { expect_same_rows<1>(); }
TEST(Iterative, RowsOfFourFrequencies) { expect_same_rows<4>(); }

// Three columns side by side that do not touch: nine motions of theirs are free, more than the iteration keeps out.
TEST(Iterative, ManyFreeMotionsAreLeftToFactors) {
  Specimen columns;
  columns.box.size = {9, 3, 4};
  for (int x = 0; x < 3; ++x) {
    for (int z = 0; z < 4; ++z) {
      columns.centre.push_back({1.5 + 3 * x, 1.5 + 0.01 * z, 0.5 + z});
      columns.radius.push_back(0.5);
      columns.phase.push_back(Phase::mastic);
      columns.body.push_back(-1);
    }
  }
  NetworkSpec spec;
  spec.gap_max = 0.5;
  const TestScene scene = make_scene(columns, spec);
  EXPECT_THROW(solve(scene, LinearMethod::iterative, {{2}}), RunError);
  const HarmonicResult r = solve(scene, LinearMethod::automatic, {{2}}).front();
  EXPECT_EQ(r.linear, LinearMethod::direct);
  EXPECT_NEAR(r.bottom.e_star_pa / r.top.e_star_pa, 1, 1e-8);
}

// Free ends: a particle that only its neighbour's facet holds has no stiffness of its own against turning.
TEST(Iterative, AMechanismIsRefusedByBoth) {
  Laws laws;
  laws.fill(laws::Elastic{1e10, 0.0});
  TestScene scene = make_scene(random_specimen(8), {}, laws);
  for (Contact& c : scene.network.contacts) c.moments = {c.moments.a, 0, 0, 0, 0, 0};
  for (const LinearMethod linear : {LinearMethod::automatic, LinearMethod::iterative, LinearMethod::direct}) {
    EXPECT_THROW(solve(scene, linear, {{2}}), RunError) << to_string(linear);
  }
}

}  // namespace
}  // namespace macadam::test
