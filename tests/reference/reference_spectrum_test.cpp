// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_spectrum_test.cpp  Compares the largest frequency and the static modulus of small networks with
/// values worked out on paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "host/reference/reference_spectrum.hpp"
#include "host/reference/reference_stepper.hpp"
#include "macadam/error.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam {
namespace {

using test::HandMade;
using test::PairShape;
using test::same_law;

constexpr double E = 1e9;

/// Returns a pair of equal spheres, whose modes separate into opening, twist, bending (opposed spins) and slip (equal
/// spins).
PairShape equal_spheres(double side) {
  PairShape shape;
  shape.radius_a = shape.radius_b = 1e-3;
  shape.mass_a = shape.mass_b = 1e-5;
  shape.side = side;
  shape.n = {2.0 / 7, -3.0 / 7, 6.0 / 7};
  return shape;
}

/// Returns in closed form the largest angular frequency of a pair from equal_spheres().
double largest_of_equal_spheres(const PairShape& shape, double alpha) {
  const double d = shape.distance, m = shape.mass_a, inertia = 0.4 * m * shape.radius_a * shape.radius_a;
  const double k = E * shape.side * shape.side / d;
  const double bending = E / d * test::square_second_moment(shape.side);
  const double opening_mode = 2 * k / m;
  const double twist_mode = 2 * alpha * 2 * bending / inertia;
  const double bending_mode = 2 * bending / inertia;
  const double slip_mode = alpha * k * (2 / m + d * d / (2 * inertia));  // slip is w + d·θ, with masses m/2 and 2·I
  return std::sqrt(std::max({opening_mode, twist_mode, bending_mode, slip_mode}));
}

TEST(LargestFrequency, OfTwoEqualSpheres) {
  struct Choice {
    double side, alpha;
  };
  // The largest mode is opening, bending, slip and twist in turn.
  for (const auto& [side, alpha] : {Choice{0.3e-3, 0.1}, Choice{4e-3, 0.1}, Choice{0.3e-3, 3}, Choice{4e-3, 2}}) {
    const PairShape shape = equal_spheres(side);
    const HandMade made = test::two_sphere_network(shape);
    const double found = reference_largest_frequency(made.network, same_law(laws::Elastic{E, alpha}), made.inertia);
    EXPECT_NEAR(found / largest_of_equal_spheres(shape, alpha), 1, 1e-12) << side << ' ' << alpha;
  }
}

TEST(LargestFrequency, OfTwoUnequalSpheresInOpening) {
  PairShape shape;
  shape.side = 0.2e-3;
  const HandMade made = test::two_sphere_network(shape);
  const auto law = test::mastic_am1();  // the instantaneous stiffness equals the Maxwell spring's
  const double k = law.E_m * shape.side * shape.side / shape.distance;
  const double found = reference_largest_frequency(made.network, same_law(law), made.inertia);
  EXPECT_NEAR(found / std::sqrt(k * (1 / shape.mass_a + 1 / shape.mass_b)), 1, 1e-12);
}

// The stepper is stable below 2/ω_max and diverges above.
TEST(LargestFrequency, IsTheLimitOfTheStep) {
  const HandMade made = test::cubic_lattice_network(2, 2, 2, 2e-3, 1e-5);
  const auto law = same_law(laws::Elastic{E, 0.3});
  const double limit = 2 / reference_largest_frequency(made.network, law, made.inertia);
  const auto divergent_after = [&](double share) {
    StepperOptions options;
    options.dt = share * limit;
    options.geometry = Geometry::fixed;
    auto stepper = make_reference_stepper(made.specimen, made.network, law, made.inertia, options);
    std::vector<Vec3d> velocity, spin;
    for (int i = 0; i < 8; ++i) {  // without symmetry, so that every mode is excited
      velocity.push_back({1e-3 * std::sin(i), 1e-3 * std::cos(3 * i), 1e-3 * std::sin(5 * i + 1)});
      spin.push_back({std::sin(7 * i), std::cos(2 * i), std::sin(4 * i + 2)});
    }
    stepper->set_velocities(velocity, spin);
    stepper->advance(2000);
    return stepper->first_divergent();
  };
  EXPECT_EQ(divergent_after(0.99), -1);
  EXPECT_GE(divergent_after(1.01), 0);  // grows by a factor e^{2·√0.02} per step
}

// Contacts at the walls have the distance from centre to wall, so a column of n cubes has exactly the length n·side of
// material. The shear ratio α does not matter, because nothing is sheared. If α is 0, every layer of spheres can slide;
// no force is needed to hold it.
TEST(StaticModulus, OfACubicLatticeIsE) {
  for (double alpha : {0.0, 0.3}) {
    for (const auto& size : {std::array{1, 1, 1}, std::array{1, 1, 5}, std::array{3, 3, 4}}) {
      const HandMade made = test::cubic_lattice_network(size[0], size[1], size[2], 2e-3, 1e-5);
      test::Laws laws = same_law(laws::Elastic{E, alpha});
      laws[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{E, 0};
      // The reference solves for equilibrium to 1e-12 of the load.
      EXPECT_NEAR(reference_static_modulus(made.specimen, made.network, laws) / E, 1, 1e-11) << alpha << ' ' << size[2];
    }
  }
}

// A particle without contacts has rows without stiffness in the matrix. It carries no load and must not be refused.
TEST(StaticModulus, ALooseParticleChangesNothing) {
  HandMade made = test::cubic_lattice_network(2, 2, 3, 2e-3, 1e-5);
  const test::Laws laws = same_law(laws::Elastic{E, 0.1});
  const double without = reference_static_modulus(made.specimen, made.network, laws);
  test::add_particle(made, {1e-3, 1e-3, 1e-3}, 1e-4, 1e-8, Phase::mastic);
  test::fill_rows(made.network, made.specimen.size());
  EXPECT_NEAR(reference_static_modulus(made.specimen, made.network, laws) / without, 1, 1e-11);
}

// Walls with another modulus act in series with the specimen: 1/E* = Σ (fraction of length) / modulus.
TEST(StaticModulus, OfLayersInSeries) {
  const HandMade made = test::cubic_lattice_network(2, 2, 4, 2e-3, 1e-5);
  test::Laws laws = same_law(laws::Elastic{E, 0.1});
  laws[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{3 * E, 0};
  const double expected = E / (0.75 + 0.25 / 3);
  EXPECT_NEAR(reference_static_modulus(made.specimen, made.network, laws) / expected, 1, 1e-11);
}

TEST(StaticModulus, AContactOfAParticleThatIsNotThereIsNamed) {
  HandMade made = test::cubic_lattice_network(1, 1, 2, 2e-3, 1e-5);
  const test::Laws laws = same_law(laws::Elastic{E, 0.1});
  made.network.contacts.at(1).b = 2;  // there are only particles 0 and 1
  for (const auto& compute :
       std::vector<std::function<void()>>{[&] { reference_static_modulus(made.specimen, made.network, laws); },
                                          [&] { reference_largest_frequency(made.network, laws, made.inertia); }}) {
    try {
      compute();
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("contact 1 (0 – 2)"), std::string::npos) << error.what();
    }
  }
}

TEST(StaticModulus, MissingLawIsNamed) {
  const HandMade made = test::cubic_lattice_network(1, 1, 2, 2e-3, 1e-5);
  test::Laws laws = same_law(laws::Elastic{E, 0.1});
  laws[static_cast<std::size_t>(PairType::mw)].reset();
  try {
    reference_static_modulus(made.specimen, made.network, laws);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("M-W"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace macadam
