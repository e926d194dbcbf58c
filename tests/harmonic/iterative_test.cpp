// SPDX-License-Identifier: GPL-3.0-or-later
// iterative_test.cpp  Compares the iterative solver of the frequency domain with the direct one, for every kind of
// network, with several frequencies at once.
#include <gtest/gtest.h>
#include <omp.h>

#include "host/tools/bench/cases.hpp"
#include "bench/stability/hostile_scenes.hpp"
#include "tests/support/cluster_specimens.hpp"
#include "host/harmonic/iterative/apply_row.hpp"
#include "host/harmonic/iterative/make_system.hpp"
#include "host/harmonic/check_solutions.hpp"
#include "host/harmonic/linear_solver.hpp"
#include "macadam/harmonic.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

using harmonic::Complex;

const std::vector<double> frequencies{2, 5, 10, 20};

/// Runs on each backend of the iterative solver; the direct solver is always on the CPU.
class Iterative : public BackendTest<std::tuple<Backend>> {
 protected:
  HarmonicOptions options(LinearMethod linear, double tolerance = HarmonicOptions{}.tolerance) const {
    HarmonicOptions out;
    out.tolerance = tolerance;
    out.linear = linear;
    out.backend = linear == LinearMethod::direct ? Backend::cpu : backend();
    return out;
  }
  std::vector<HarmonicResult> solve(const TestScene& scene, LinearMethod linear, const std::vector<HarmonicLoad>& loads,
                                    double tolerance = HarmonicOptions{}.tolerance) const {
    return Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, options(linear, tolerance), 6)
        .solve(loads);
  }
  void expect_same(const TestScene& scene, const std::vector<HarmonicLoad>& loads, const std::string& what,
                   double tolerance = 1e-9) const;
};
INSTANTIATE_TEST_SUITE_P(Backends, Iterative, testing::Combine(all_backends()), name_of_case<Backend>);

/// Expects the same E* from the iterative and the direct solver. The error of E* is the square of the residual of 1e-11
/// times a condition number of about 1e5. This error is far below the rounding of the sums, which the tolerance allows
/// for.
void Iterative::expect_same(const TestScene& scene, const std::vector<HarmonicLoad>& loads, const std::string& what,
                            double tolerance) const {
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

TEST_P(Iterative, AgreesWithFactorsForEveryKindOfNetwork) {
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

TEST_P(Iterative, AgreesWithFactorsWithInertiaAndDamping) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  for (const double scaling : {1.0, 1e3, 1e5}) {
    for (const double damping : {0.0, 50.0}) expect_same(scene, loads_of(scaling, damping), std::to_string(scaling));
  }
}

TEST_P(Iterative, AgreesWithFactorsOnClusters) {
  for (const Laws& laws : {am1_laws(), am2_laws()}) {
    expect_same(make_scene(few_clusters(test_seed()), {}, laws), loads_of(), "clusters");
  }
}

// If the shear stiffness is almost zero, facets still resist bending, but the bending stiffness is small too. So the
// condition number of the matrix and the error of E* are larger.
TEST_P(Iterative, AgreesWithFactorsAlmostWithoutShear) {
  Laws laws = am1_laws();
  for (auto& law : laws) std::visit([](auto& l) { l.alpha = 1e-3; }, *law);
  expect_same(make_scene(random_specimen(test_seed()), {}, laws), loads_of(), "alpha = 0.001", 1e-8);
}

/// Returns networks that are hard to solve: very different stiffnesses, very different sizes, and sliver facets.
std::vector<std::pair<std::string, TestScene>> hostile_networks() {
  std::vector<std::pair<std::string, TestScene>> out;
  for (const double ratio : {1e2, 1e4, 1e6}) {
    out.emplace_back("A-A stiffer by " + std::to_string(ratio), stability::stiff_aggregates(ratio));
    out.emplace_back("inner stiffer by " + std::to_string(ratio), stability::stiff_clusters(ratio));
  }
  for (const double ratio : {3.0, 10.0, 25.0, 50.0})
    out.emplace_back("radii 1:" + std::to_string(ratio), stability::two_sizes(ratio));
  for (const double jitter : {1e-2, 1e-4, 1e-6, 1e-8})
    out.emplace_back("lattice off by " + std::to_string(jitter), stability::nearly_cubic(jitter));
  return out;
}

// Two particles have about a hundred contacts each. On a device (GPU) a whole thread block works on each of them.
TEST_P(Iterative, AgreesWithFactorsWhereParticlesTouchAHundredOthers) {
  const TestScene scene = make_scene(boulders(test_seed()));
  std::size_t with_many = 0;
  for (std::size_t i = 0; i < scene.specimen.size(); ++i) with_many += scene.network.row(i).size() >= 80;
  EXPECT_EQ(with_many, 2u);
  expect_same(scene, loads_of(), "four loads");
  expect_same(scene, {{10}}, "one");
}

// Some loads are much larger than the load of the wall and cancel each other. A residual of 1e-11 is then below
// rounding, but E* is as accurate as usual.
TEST_P(Iterative, AgreesWithFactorsOnHostileNetworks) {
  for (const auto& [name, scene] : hostile_networks()) expect_same(scene, {{10}}, name);
}

// The error of E* is the square of the residual times a condition number, so a residual of 1e-8 gives nine digits. For
// the specimens of examples/ see bench/results/harmonic-digits.csv.
TEST_P(Iterative, AResidualOf1e8GivesNineDigits) {
  auto networks = hostile_networks();
  networks.emplace_back("random", make_scene(random_specimen(test_seed(), 6, 6, 8)));
  networks.emplace_back("clusters", make_scene(few_clusters(8)));
  networks.emplace_back("AM2", make_scene(random_specimen(8), {}, am2_laws()));
  networks.emplace_back("t8", make_scene(read_specimen_csv(MACADAM_TEST_DATA "/t8.csv", {{0.008, 0.008, 0.011}})));
  for (const auto& [name, scene] : networks) {
    const auto rough = solve(scene, LinearMethod::iterative, loads_of(), 1e-8);
    const auto exact = solve(scene, LinearMethod::direct, loads_of());
    for (std::size_t i = 0; i < rough.size(); ++i) {
      EXPECT_NEAR(rough[i].top.e_star_pa / exact[i].top.e_star_pa, 1, 1e-9) << name;
      EXPECT_NEAR(rough[i].top.phase_deg, exact[i].top.phase_deg, 1e-7) << name;
    }
  }
}

// At s = a + iω, stiffness, inertia and damping have the values for a motion proportional to e^(s·t). For real s the
// modulus is real, and conjugate s give conjugate moduli.
TEST_P(Iterative, AnyComplexFrequency) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  for (const double growth : {0.5, 30.0}) {
    for (const double scaling : {0.0, 1e3}) {
      const std::vector<HarmonicLoad> loads{
          {0, scaling, 20, growth}, {3, scaling, 20, growth}, {-3, scaling, 20, growth}, {40, scaling, 0, growth}};
      expect_same(scene, loads, std::to_string(growth));
      const auto found = solve(scene, LinearMethod::iterative, loads);
      EXPECT_EQ(found[0].top.phase_deg, 0);
      EXPECT_NEAR(found[1].top.e_star_pa / found[2].top.e_star_pa, 1, 1e-12);
      EXPECT_NEAR(found[1].top.phase_deg, -found[2].top.phase_deg, 1e-10);
    }
  }
}

TEST_P(Iterative, SameBitsEveryRun) {
  const TestScene scene = make_scene(random_specimen(test_seed(), 6, 6, 8));
  const auto once = solve(scene, LinearMethod::iterative, loads_of()),
             again = solve(scene, LinearMethod::iterative, loads_of());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_TRUE(once[i].motion == again[i].motion);
}

TEST_P(Iterative, StopsWhenAsked) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  for (const LinearMethod linear : {LinearMethod::iterative, LinearMethod::direct}) {
    HarmonicOptions asked = options(linear);
    asked.stop = [] { return true; };
    Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, asked, 6);
    EXPECT_THROW(harmonic.solve(5), InterruptedError);
  }
}

// The solver has separate code for a single frequency and for four frequencies together. Here the single frequency also
// starts from the solution for another inertia, not from rest.
TEST_P(Iterative, OneAtATimeGivesTheSame) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  const auto together = solve(scene, LinearMethod::iterative, loads_of(1e4));
  Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, options(LinearMethod::iterative), 6);
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const HarmonicResult still = harmonic.solve(frequencies[i]);
    const HarmonicResult alone = harmonic.solve({{frequencies[i], 1e4, 0, 0, &still.motion}}).front();
    EXPECT_LT(alone.iterations, together[i].iterations);
    EXPECT_NEAR(alone.top.e_star_pa / together[i].top.e_star_pa, 1, 1e-10);
    EXPECT_NEAR(alone.top.phase_deg, together[i].top.phase_deg, 1e-8);
  }
  const auto three = solve(scene, LinearMethod::iterative, {{2, 1e4}, {5, 1e4}, {20, 1e4}});
  EXPECT_NEAR(three[2].top.e_star_pa / together[3].top.e_star_pa, 1, 1e-10);
}

// If the solver starts at a solution, it needs no iteration. The network is so large that a device (GPU) copies the
// solutions in parts.
TEST_P(Iterative, BeginsAtASolutionAndStaysThere) {
  const bench::BenchCase lattice = bench::lattice(backend() == Backend::cuda ? 380'000 : 15'000, true);
  const TestScene scene{lattice.specimen, lattice.network, lattice.laws, lattice.inertia};
  const HarmonicResult found = solve(scene, LinearMethod::iterative, {{.frequency_hz = 20}}, 1e-6)[0];
  EXPECT_GT(found.iterations, 0);
  EXPECT_LE(found.residual, 1e-6);  // computed on the host from the contacts
  const HarmonicLoad there{.frequency_hz = 20, .near = &found.motion};
  const HarmonicResult again = solve(scene, LinearMethod::iterative, {there}, 1e-5)[0];
  EXPECT_EQ(again.iterations, 0);
  double apart = 0;  // largest difference, from rounding when free motions are removed from the starting point
  for (std::size_t i = 0; i < found.motion.size(); ++i) {
    apart = std::max(apart, std::abs(again.motion[i] - found.motion[i]));
  }
  EXPECT_LT(apart, 1e-10);  // the top wall moves by 1
}

// The lattice is so large that the particle order, the matrix rows, the coarse matrix and all sums are computed in
// several pieces.
TEST_P(Iterative, SameBitsForAnyNumberOfThreads) {
  const bench::BenchCase lattice = bench::lattice(15000, true);
  const TestScene scene{lattice.specimen, lattice.network, lattice.laws, lattice.inertia};
  const int before = omp_get_max_threads();
  std::vector<std::vector<Complex>> motions;
  std::vector<Complex> moduli;
  std::vector<std::vector<std::int32_t>> orders;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    orders.push_back(kernels::make_order(scene.specimen, 30).particle);
    const HarmonicResult r = solve(scene, LinearMethod::iterative, {{5}, {20}}, 1e-3)[1];
    motions.push_back(r.motion);
    moduli.push_back(r.parts.modulus());
  }
  omp_set_num_threads(before);
  EXPECT_TRUE(orders[0] == orders[1] && orders[0] == orders[2]);
  EXPECT_TRUE(motions[0] == motions[1] && motions[0] == motions[2]);
  EXPECT_TRUE(moduli[0] == moduli[1] && moduli[0] == moduli[2]);
}

// Boxes of particles (the coarse space) are only a part of the preconditioner. Their number does not change the
// solution, but with more boxes the solver needs fewer iterations.
TEST(CoarseSpace, SavesIterationsAndChangesNoSolution) {
  const TestScene scene = make_scene(random_specimen(test_seed(), 8, 8, 20));
  const std::size_t n = scene.specimen.size();
  const auto stiffness = harmonic::pair_stiffness(scene.laws, Complex(0, 40));
  const auto free = harmonic::find_free_motions(scene.specimen, scene.network, stiffness, scene.inertia);
  harmonic::LinearTask asked;
  asked.stiffness = stiffness;
  asked.tolerance = 1e-10;
  const harmonic::ContactOperator contacts(scene.network, n);
  asked.right = contacts.wall_loads(stiffness);
  const auto modulus = [&](const harmonic::LinearTask& t) {
    return harmonic::check_solutions(scene.network, scene.inertia, {&t}, 0).front().parts.modulus();
  };
  const auto solved = [&](std::optional<std::size_t> boxes) {
    harmonic::LinearTask task = asked;
    harmonic::make_iterative_solver(scene.specimen, scene.network, stiffness, scene.inertia, free, Backend::cpu, {},
                                    boxes)
        ->solve({&task}, {});
    EXPECT_TRUE(task.converged);
    return task;
  };
  const auto usual = solved({}), none = solved(0), few = solved(4), same = solved(harmonic::usual_boxes(n));
  EXPECT_TRUE(same.motion == usual.motion && same.iterations == usual.iterations);
  EXPECT_LT(usual.iterations, few.iterations);
  EXPECT_LT(few.iterations, none.iterations);
  // the error of E* is the square of residuals of 1e-10 times a condition number of about 1e5
  for (const auto* task : {&none, &few}) { EXPECT_NEAR(std::abs(modulus(*task) / modulus(usual) - 1.0), 0, 1e-9); }
}

/// Compares the kernels of the solver, which work on rows of the matrix, with the operator that checks solutions.
template <int F>
void expect_same_rows() {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  const std::size_t n = scene.specimen.size();
  const auto layout = kernels::make_order(scene.specimen, 5);
  const auto typical = harmonic::pair_stiffness(scene.laws, Complex(0, 10));
  const kernels::LinearSystem system =
      harmonic::make_system(scene.network, scene.specimen, layout, typical, scene.inertia,
                            harmonic::find_free_motions(scene.specimen, scene.network, typical, scene.inertia));
  const harmonic::ContactOperator contacts(scene.network, n);
  harmonic::BlockStiffness<F> block;
  block.inert = false;
  harmonic::LaneVector<F> x(6 * n);
  std::vector<harmonic::Vector> motion(F, harmonic::Vector(6 * n)), expected(F);
  for (int f = 0; f < F; ++f) {
    const auto own = harmonic::pair_stiffness(scene.laws, Complex(0, 10.0 * (f + 1)));
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
    harmonic::Lanes<F> out[6];
    harmonic::apply_row<F>(system, block, body, x, {}, out);
    for (int f = 0; f < F; ++f) {
      double scale = 0;
      for (std::size_t i = 0; i < 6 * n; ++i) scale = std::max(scale, std::abs(expected[f][i]));
      for (std::size_t c = 0; c < 6; ++c) {  // about 15 contacts with a dozen products each
        EXPECT_NEAR(std::abs(out[c].at(f) - expected[f][6 * particle + c]), 0, 1e-14 * scale);
      }
    }
  }
}
TEST(IterativeRows, OfOneFrequency) { expect_same_rows<1>(); }
TEST(IterativeRows, OfFourFrequencies) { expect_same_rows<4>(); }

// Three separate columns have nine free motions, more than the iterative solver can exclude. The direct solver takes
// over.
TEST_P(Iterative, ManyFreeMotionsAreLeftToFactors) {
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
  EXPECT_HAS(message_of([&] { solve(scene, LinearMethod::iterative, {{2}}); }),
             "found 9 rigid motions of the whole specimen that no wall resists");
  const HarmonicResult r = solve(scene, LinearMethod::automatic, {{2}}).front();
  EXPECT_EQ(r.linear, LinearMethod::direct);
  EXPECT_NEAR(r.bottom.e_star_pa / r.top.e_star_pa, 1, 1e-8);
}

// The contacts resist neither sliding nor bending, so particles at free ends can rotate. The direct and the iterative
// solver both refuse such a mechanism.
TEST_P(Iterative, AMechanismIsRefusedByBoth) {
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
