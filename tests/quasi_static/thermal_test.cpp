// SPDX-License-Identifier: GPL-3.0-or-later
// thermal_test.cpp  Tests thermal expansion in increments without inertia: restrained and free columns, a specimen that
// expands without stress, two materials, and laws whose relaxation times change with the temperature during the test.
#include <gtest/gtest.h>

#include <cmath>

#include "host/quasi_static/increments.hpp"
#include "macadam/drives/table.hpp"
#include "macadam/quasi_static.hpp"
#include "macadam/temperature.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

constexpr std::size_t driven = wall_index(wall_z_hi);
constexpr double side = 2e-3, area = side * side, E = 1e10;
constexpr double coefficient = 2e-5, warming = -12;  ///< [1/K] [K]

/// Returns a column of cubes along z whose contacts have a law without shear stiffness.
HandMade column(int cubes) { return cubic_lattice_network(1, 1, cubes, side, 1e-5); }

/// Returns options with the expansion of a specimen, and with residuals near rounding error.
QuasiStaticOptions expanding(const Specimen& specimen, const ContactNetwork& network, const Expansion& expansion) {
  QuasiStaticOptions out;
  out.expansion = free_openings(network, specimen, expansion);
  out.residual = 1e-12;
  return out;
}

/// Cools a specimen in one increment, with the top wall held or, with `free`, without force on it.
QuasiStatic cooled(const Specimen& specimen, const ContactNetwork& network, const Laws& laws,
                   const QuasiStaticOptions& options, bool free) {
  QuasiStatic out(specimen, network, laws, options);
  WallIncrement next;
  next.dt = 1, next.warming = warming;
  if (free) next.load = 0;
  const IncrementReport report = out.solve(next);
  EXPECT_TRUE(report.converged) << report.residual;
  if (report.converged) out.accept();
  return out;
}

// A lattice of cubes without shear stiffness has the modulus of its contacts. Tolerances of 1e-12 are rounding errors
// of a few systems with 30 unknowns.
TEST(ThermalColumn, HasTheStressOfARestrainedBar) {
  const HandMade made = column(5);
  const QuasiStatic q = cooled(made.specimen, made.network, same_law(laws::Elastic{E, 0}),
                               expanding(made.specimen, made.network, {0, coefficient}), false);
  const double want = -E * coefficient * warming;
  EXPECT_NEAR(-q.wall_force()[driven].z / area, want, 1e-12 * want);
  EXPECT_NEAR(q.wall_force()[wall_index(wall_z_lo)].z / area, want, 1e-12 * want);
  // the forces work against the contraction; the springs keep this work
  const double energy = 0.5 * want * want / E * area * 5 * side;
  EXPECT_NEAR(q.energies().thermal_j, energy, 1e-12 * energy);
  EXPECT_NEAR(q.energies().elastic_j, energy, 1e-12 * energy);
  EXPECT_LT(q.energies().imbalance(), 1e-12);
}

TEST(ThermalColumn, HasTheStrainOfAFreeBar) {
  const HandMade made = column(5);
  const QuasiStatic q = cooled(made.specimen, made.network, same_law(laws::Elastic{E, 0}),
                               expanding(made.specimen, made.network, {0, coefficient}), true);
  const double want = coefficient * warming;
  EXPECT_NEAR(q.wall_displacement()[driven].z / (5 * side), want, 1e-12 * std::abs(want));
  EXPECT_NEAR(q.wall_force()[driven].z / area, 0, 1e-12 * E * std::abs(want));
}

// Every second cube is rock. A contact contracts by the half lengths of its two cubes; compliances are in series.
TEST(ThermalColumn, AddsTheHalvesOfTwoMaterials) {
  HandMade made = column(6);
  for (const std::size_t i : {1, 3, 5}) made.specimen.phase[i] = Phase::aggregate;
  const Expansion expansion{8e-6, 5e-5};
  const QuasiStaticOptions options = expanding(made.specimen, made.network, expansion);
  const double both = 0.5 * side * (expansion.aggregate + expansion.mastic);
  int walls = 0;
  for (std::size_t k = 0; k < made.network.contacts.size(); ++k) {
    const Contact& c = made.network.contacts[k];
    const double at_wall = 0.5 * side * (c.b == wall_z_hi ? expansion.aggregate : expansion.mastic);
    EXPECT_DOUBLE_EQ(options.expansion[k], c.b < 0 ? at_wall : both);
    walls += c.b < 0;
  }
  EXPECT_EQ(walls, 2);
  const QuasiStatic q = cooled(made.specimen, made.network, same_law(laws::Elastic{E, 0}), options, false);
  const double want = -E * 0.5 * (expansion.aggregate + expansion.mastic) * warming;
  EXPECT_NEAR(-q.wall_force()[driven].z / area, want, 1e-12 * want);
}

// With laws of phases the parts of the line in mastic and in rock expand, wherever the facet is.
TEST(ThermalContacts, AddTheLengthsInMasticAndRock) {
  HandMade made = column(4);
  ContactNetwork& network = made.network;
  network.rule = ContactRule::series, network.rock_modulus = 6e10;
  Contact &plain = network.contacts[0], &joined = network.contacts[1], &inner = network.contacts[2];
  joined.length = 0.25 * joined.distance;
  joined.series = 0.75 * joined.distance / (joined.length * network.rock_modulus);
  inner.pair = PairType::inner;
  const std::vector<double> found = free_openings(network, made.specimen, {8e-6, 5e-5});
  EXPECT_DOUBLE_EQ(found[0], 5e-5 * plain.distance);
  EXPECT_DOUBLE_EQ(found[1], (0.25 * 5e-5 + 0.75 * 8e-6) * joined.distance);
  EXPECT_DOUBLE_EQ(found[2], 8e-6 * inner.distance);
}

// One coefficient everywhere and a free top: all distances change by the same factor, and nothing carries stress, with
// any shape of cells. Particles do not turn.
TEST(ThermalSpecimen, ExpandsWithoutStress) {
  for (const unsigned seed : {1U, 4U}) {
    const TestScene scene = make_scene(random_specimen(seed));
    const QuasiStatic q = cooled(scene.specimen, scene.network, scene.laws,
                                 expanding(scene.specimen, scene.network, {coefficient, coefficient}), true);
    const double strain = coefficient * warming, height = scene.specimen.box.size.z, size = std::abs(strain) * height;
    EXPECT_NEAR(q.wall_displacement()[driven].z, strain * height, 1e-12 * size);
    // Relative motions are those of the expansion. The particles may turn about z together, which no contact resists.
    const ContactState contacts = q.contacts();
    double largest_force = 0, restrained = 0;
    for (std::size_t k = 0; k < contacts.force.size(); ++k) {
      const Contact& c = scene.network.contacts[k];
      const auto& u = contacts.relative[k];
      EXPECT_NEAR(u[0], strain * c.distance, 1e-12 * size);
      for (const double other : {u[3], u[4], side * u[1], side * u[2], side * u[5]}) {
        if (c.b >= 0) { EXPECT_NEAR(other, 0, 1e-12 * size); }
      }
      largest_force = std::max(largest_force, norm(contacts.force[k]));
      // the force of a contact of mastic that is held
      restrained = std::max(restrained, std::abs(strain) * mastic_am1().E_m * c.area);
    }
    // forces are out of balance by 1e-12
    EXPECT_LT(largest_force, 1e-11 * restrained);
  }
}

// A specimen of two materials has stresses inside although its top is free; both linear solvers find the same ones.
TEST(ThermalSpecimen, HasInnerStressesIfItsMaterialsDiffer) {
  const TestScene scene = make_scene(random_specimen(4));
  QuasiStaticOptions options = expanding(scene.specimen, scene.network, {8e-6, 5e-5});
  options.residual = 1e-11;
  const QuasiStatic direct = cooled(scene.specimen, scene.network, scene.laws, options, true);
  options.direct_below = 0;
  const QuasiStatic iterative = cooled(scene.specimen, scene.network, scene.laws, options, true);
  const double strain = direct.wall_displacement()[driven].z / scene.specimen.box.size.z;
  EXPECT_LT(strain, 8e-6 * warming);
  EXPECT_GT(strain, 5e-5 * warming);
  EXPECT_GT(direct.energies().elastic_j, 0);
  EXPECT_NEAR(iterative.wall_displacement()[driven].z / scene.specimen.box.size.z, strain, 1e-7 * std::abs(strain));
  EXPECT_LT(direct.energies().imbalance(), 1e-9);
}

// A contact that cracks in tension: cooling a held bar opens the weakest facet as pulling it by the same length does.
TEST(ThermalSpecimen, CracksAsIfItWerePulled) {
  const HandMade made = column(4);
  Laws laws = same_law(laws::Elastic{E, 0});
  laws[static_cast<std::size_t>(PairType::mm)] =
      laws::Cracked<laws::Elastic>{laws::Elastic{E, 0.1}, {2e6, 60, 3e6, 60, 0, 0}};
  const QuasiStaticOptions expansion = expanding(made.specimen, made.network, {0, coefficient});
  QuasiStatic cold(made.specimen, made.network, laws, expansion), pulled(made.specimen, made.network, laws, {});
  for (int k = 0; k < 20; ++k) {
    WallIncrement cooling, pull;
    cooling.dt = pull.dt = 1;
    cooling.warming = -1;
    pull.wall[driven].z = coefficient * 4 * side;
    ASSERT_TRUE(cold.solve(cooling).converged) << k;
    cold.accept();
    ASSERT_TRUE(pulled.solve(pull).converged) << k;
    pulled.accept();
    EXPECT_NEAR(cold.wall_force()[driven].z, pulled.wall_force()[driven].z, 1e-9 * 2e6 * area) << k;
  }
  EXPECT_GT(pulled.energies().crack_j, 0);  // the strength was reached at 10 K
  EXPECT_NEAR(cold.energies().thermal_j, pulled.energies().work_j, 1e-8 * pulled.energies().work_j);
}

// One facet of 0.2 MPa softens over 5e-7 m, less than the 8e-7 m by which the column shortens at this stress. So no
// equilibrium exists beyond the strength, which is reached after 10 K of cooling.
TEST(ThermalSpecimen, HasNoEquilibriumBeyondASuddenBreak) {
  const HandMade made = column(2);
  constexpr double soft = 1e9, strength = 2e5;
  Laws laws = same_law(laws::Elastic{soft, 0});
  laws[static_cast<std::size_t>(PairType::mm)] =
      laws::Cracked<laws::Elastic>{laws::Elastic{soft, 0.1}, {strength, 0.05, 2 * strength, 0.1, 0, 0}};
  quasi_static::CourseOptions options;
  constexpr double unit = 3600.0 / 1'000'000;
  options.drive = std::make_shared<drives::Table>(unit, std::vector<double>{0, 3600}, std::vector<double>{0, 0});
  options.height = 2 * side, options.area = area, options.first = 200;
  for (int k = 1; k <= 4; ++k) options.stops.push_back(250'000 * k);
  options.temperature = {{0, 3600}, {20, -10}};
  options.solver.expansion = free_openings(made.network, made.specimen, {0, coefficient});
  quasi_static::Increments increments(made.specimen, made.network, laws, options);
  try {
    while (increments.step() < 1'000'000) increments.advance();
    FAIL() << "an equilibrium was found beyond the strength";
  } catch (const quasi_static::NoEquilibrium& error) {
    // the last increment is at most a hundredth of the longest one, which lasts 900 s, or 7.5 K
    EXPECT_NEAR(options.temperature.at(error.last.time_s), 10, 0.1);
    EXPECT_NEAR(error.last.stress_pa, strength, 0.01 * strength);
    EXPECT_EQ(error.last.strain, 0);
  }
}

constexpr laws::Wlf wlf{12, 90, 20};

/// Returns the stress of a held bar whose chain has one Kelvin unit, by Runge and Kutta's method in short steps.
double reference_stress(const laws::GeneralisedKelvin& law, const TemperatureHistory& history, double end) {
  constexpr int steps = 200'000;
  const double dt = end / steps;
  std::array<double, 2> x{};  // strains of the dashpot and of the unit
  const auto stress = [&](double t, const std::array<double, 2>& now) {
    return law.E_m * (-coefficient * (history.at(t) - history.at(0)) - now[0] - now[1]);
  };
  const auto rate = [&](double t, const std::array<double, 2>& now) {
    const double a = std::pow(10.0, laws::log10_shift(wlf, history.at(t))), f = stress(t, now);
    return std::array<double, 2>{f / (law.C_m * a), (f - law.E[0] * now[1]) / (law.C[0] * a)};
  };
  const auto moved = [](const std::array<double, 2>& from, const std::array<double, 2>& by, double h) {
    return std::array<double, 2>{from[0] + h * by[0], from[1] + h * by[1]};
  };
  for (int k = 0; k < steps; ++k) {
    const double t = k * dt;
    const auto k1 = rate(t, x), k2 = rate(t + dt / 2, moved(x, k1, dt / 2)),
               k3 = rate(t + dt / 2, moved(x, k2, dt / 2)), k4 = rate(t + dt, moved(x, k3, dt));
    for (std::size_t i = 0; i < 2; ++i) x[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return stress(end, x);
}

// A held column cools by 30 K in an hour, then keeps its temperature. Its relaxation times grow by a factor of 2e5.
TEST(ThermalHistory, ChangesTheRelaxationTimesDuringTheTest) {
  const HandMade made = column(3);
  const laws::GeneralisedKelvin law{1e10, 2e12, {4e9}, {3e11}, 0};
  const TemperatureHistory history{{0, 3600, 5400}, {20, -10, -10}};
  quasi_static::CourseOptions options;
  constexpr double unit = 5400.0 / 1'000'000;
  options.drive = std::make_shared<drives::Table>(unit, std::vector<double>{0, 5400}, std::vector<double>{0, 0});
  options.height = 3 * side, options.area = area;
  options.tolerance = 1e-4, options.first = 100;
  options.stops = {333'333, 666'667, 1'000'000}, options.kinks = {666'667};
  options.temperature = history;
  options.shifts.fill(wlf);
  options.solver.expansion = free_openings(made.network, made.specimen, {0, coefficient});
  quasi_static::Increments increments(made.specimen, made.network, same_law(law), options);
  const double peak = reference_stress(law, history, 3600);
  for (const std::int64_t stop : options.stops) {
    while (increments.step() < stop) increments.advance();
    const double want = reference_stress(law, history, static_cast<double>(stop) * unit);
    // ten errors of an increment
    EXPECT_NEAR(-increments.network().wall_force()[driven].z / area, want, 10 * options.tolerance * peak) << stop;
  }
  EXPECT_LT(increments.network().energies().imbalance(), 1e-9);
  // the temperature matters: with the laws of 20 °C the bar would have relaxed to far less
  EXPECT_GT(peak, 0.5 * E * coefficient * 30);
}

// At a constant temperature the increments are those of the laws shifted to it.
TEST(ThermalHistory, EqualsShiftedLawsAtAConstantTemperature) {
  const HandMade made = column(3);
  const laws::GeneralisedKelvin law{1e10, 2e12, {4e9}, {3e11}, 0};
  const double a_T = std::pow(10.0, laws::log10_shift(wlf, 5));
  QuasiStatic reduced(made.specimen, made.network, same_law(law), {}),
      shifted(made.specimen, made.network, same_law(laws::shifted(law, a_T)), {});
  for (int k = 0; k < 5; ++k) {
    WallIncrement next;
    next.dt = 10, next.wall[driven].z = 1e-7;
    ASSERT_TRUE(shifted.solve(next).converged);
    shifted.accept();
    next.reduced_dt.emplace().fill(10 / a_T);
    ASSERT_TRUE(reduced.solve(next).converged);
    reduced.accept();
    EXPECT_NEAR(reduced.wall_force()[driven].z, shifted.wall_force()[driven].z,
                1e-9 * std::abs(shifted.wall_force()[driven].z));  // the residual is 1e-10
  }
}

TEST(ThermalHistory, IsLinearBetweenItsTimes) {
  const TemperatureHistory history{{0, 10, 30}, {20, 10, -10}};
  EXPECT_EQ(history.at(0), 20);
  EXPECT_DOUBLE_EQ(history.at(5), 15);
  EXPECT_DOUBLE_EQ(history.at(10), 10);
  EXPECT_DOUBLE_EQ(history.at(20), 0);
  EXPECT_EQ(history.at(40), -10);
}

// In a table log10 a_T is linear in the temperature, so the integral has a closed form on each piece.
TEST(ThermalHistory, HasTheReducedTimeOfATable) {
  const laws::Shift table = laws::ShiftTable{{-10, 0, 20}, {5, 3, 0}};
  const TemperatureHistory history{{0, 30, 40}, {20, -10, -10}};
  const auto piece = [](double seconds, double from, double to) {  // ∫ 10^−(from … to)
    return seconds * (std::pow(10, -from) - std::pow(10, -to)) / ((to - from) * std::log(10.0));
  };
  const double want = piece(20, 0, 3) + piece(10, 3, 5) + 10 * 1e-5;
  EXPECT_NEAR(reduced_time(table, history, 0, 40), want, 1e-12 * want);
  EXPECT_NEAR(reduced_time(table, history, 0, 17) + reduced_time(table, history, 17, 40), want, 1e-12 * want);
  EXPECT_EQ(reduced_time(laws::NoShift{}, history, 3, 7), 4);
  EXPECT_TRUE(std::isnan(reduced_time(laws::ShiftTable{{0, 20}, {3, 0}}, history, 0, 40)));
}

}  // namespace
}  // namespace macadam::test
