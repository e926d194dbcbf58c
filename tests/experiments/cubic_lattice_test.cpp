// SPDX-License-Identifier: GPL-3.0-or-later
// cubic_lattice_test.cpp  A cubic lattice of equal spheres without shear stiffness has the modulus of its contacts.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>
#include <tuple>

#include "host/reference/reference_spectrum.hpp"
#include "tests/support/stepper_cases.hpp"

namespace macadam::test {
namespace {

constexpr double E = 2e10, side = 2e-3;

/// Returns mastic spheres at the centres of cubes that fill the box. At every corner of a cell facets of eight spheres
/// meet, which is the most degenerate input of a tessellation.
Specimen lattice(int nx, int ny, int nz, double radius) {
  Specimen out;
  out.box.size = {nx * side, ny * side, nz * side};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) out.centre.push_back({(i + 0.5) * side, (j + 0.5) * side, (k + 0.5) * side});
    }
  }
  out.radius.assign(out.centre.size(), radius);
  out.phase.assign(out.centre.size(), Phase::mastic);
  out.body.assign(out.centre.size(), -1);
  return out;
}

// The lattice consists of columns of springs: E·A/side between spheres and E·A/(side/2) at the walls. In series they
// give the modulus E over the whole height. Sizes are not powers of two, so that coordinates are rounded.
TEST(CubicLattice, StaticModulusIsE) {
  for (const auto& [nx, ny, nz] : {std::tuple{1, 1, 1}, {1, 1, 7}, {3, 3, 5}, {6, 5, 7}, {10, 10, 11}}) {
    for (const double radius : {0.4 * side, 0.5 * side, 0.6 * side}) {  // spheres apart, touching, overlapping
      const TestScene scene = make_scene(lattice(nx, ny, nz, radius), {}, same_law(laws::Elastic{E, 0}));
      ASSERT_EQ(scene.network.contacts.size(),
                static_cast<std::size_t>((nx - 1) * ny * nz + nx * (ny - 1) * nz + nx * ny * (nz + 1)));
      EXPECT_NEAR(reference_static_modulus(scene.specimen, scene.network, scene.laws) / E, 1, 1e-9)
          << fmt::format("{} x {} x {} spheres of radius {}", nx, ny, nz, radius);
    }
  }
}

TEST(CubicLattice, AnotherModulusAtTheWallsActsInSeries) {
  Laws laws = same_law(laws::Elastic{E, 0});
  laws[static_cast<std::size_t>(PairType::mw)] = laws::Elastic{3 * E, 0};
  const TestScene scene = make_scene(lattice(3, 3, 5, 0.5 * side), {}, laws);
  const double expected = E / (4.0 / 5 + 1.0 / 5 / 3);  // half a side at each wall is 1/5 of the height
  EXPECT_NEAR(reference_static_modulus(scene.specimen, scene.network, scene.laws) / expected, 1, 1e-9);
}

using Case = std::tuple<Backend, ContactForm, Geometry>;

class LoadedLattice : public BackendTest<Case> {
 protected:
  /// Returns |E*| and φ of a sinusoidal load of four cycles, of which the first three are a smooth start.
  Stiffness modulus(const TestScene& scene, double frequency) const {
    StepperOptions options;
    std::tie(std::ignore, options.form, options.geometry) = GetParam();
    options.threads = 1;
    const double limit = critical_step(scene.network, scene.laws, scene.inertia, options).dt;
    constexpr int samples = 100;
    const Vec3d size = scene.specimen.box.size;
    drives::Cyclic loading;
    loading.amplitude = 1e-6 * size.z;
    loading.frequency = frequency;
    const auto stride = static_cast<std::int64_t>(std::ceil(1 / (frequency * 0.5 * limit * samples)));
    loading.steps_per_period = samples * stride;
    loading.ramp_steps = 3 * loading.steps_per_period;
    options.boundary = moving_top(loading);
    options.dt = loading.dt();
    const auto stepper = make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
    std::vector<ResponseSample> response;
    sample(*stepper, stride, 4 * samples, [&](const Observation& now) {
      response.push_back({frequency, now.time, now.top_displacement() / size.z, -now.top_force() / (size.x * size.y)});
    });
    return evaluate_cyclic(response, frequency, 1).fit;
  }
};

INSTANTIATE_TEST_SUITE_P(All, LoadedLattice,
                         testing::Combine(all_backends(), testing::Values(ContactForm::condensed, ContactForm::points),
                                          testing::Values(Geometry::updated, Geometry::fixed)),
                         [](const auto& info) { return name_of_case(info); });

// A bar of height H that is held at the bottom and driven at the top with the angular frequency ω has the modulus
// E·κ/tan κ = E·(1 − κ²/3 − κ⁴/45 …) with κ = ω·H·√(ρ/E). So the effect of inertia on E grows with the square of the
// frequency. A column of n spheres has its mass at n heights; therefore Σ ((i − ½)/n)²/n = ⅓·(1 − 1/(4n²)) replaces ⅓.
TEST_P(LoadedLattice, SlowLoadingReachesTheStaticModulus) {
  constexpr int n = 5;
  const TestScene scene = make_scene(lattice(3, 3, n, 0.5 * side), {}, same_law(laws::Elastic{E, 0}));
  const double height = scene.specimen.box.size.z, density = scene.inertia.mass[0] / (side * side * side);
  for (const double kappa : {0.1, 0.02, 0.005}) {
    SCOPED_TRACE(fmt::format("kappa {}", kappa));
    const double square = kappa * kappa, fourth = square * square / 45;
    const double expected = 1 - square / 3 * (1 - 0.25 / (n * n)) - fourth;
    const Stiffness found = modulus(scene, kappa / (2 * std::numbers::pi * height * std::sqrt(density / E)));
    // The discrete heights of the masses change the fourth-order term by a fraction of about 1/n²; a tenth is allowed.
    // The start is smooth enough to keep ringing below 1e-8.
    EXPECT_NEAR(found.e_star_pa / E, expected, fourth / 10 + 1e-8);
    EXPECT_NEAR(found.phase_deg, 0, 1e-5);
  }
}

}  // namespace
}  // namespace macadam::test
