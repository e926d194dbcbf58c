// SPDX-License-Identifier: GPL-3.0-or-later
// fields_test.cpp  Checks that the arrays of fields satisfy the sums and balances that theory requires.
#include "macadam/fields.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <numbers>

#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

const FieldArray& array(const std::vector<FieldArray>& arrays, const std::string& name) {
  for (const FieldArray& a : arrays) {
    if (a.name == name) return a;
  }
  throw std::runtime_error("no array " + name);
}
const std::vector<float>& floats(const std::vector<FieldArray>& arrays, const std::string& name) {
  return std::get<std::vector<float>>(array(arrays, name).values);
}
const std::vector<std::int32_t>& whole(const std::vector<FieldArray>& arrays, const std::string& name) {
  return std::get<std::vector<std::int32_t>>(array(arrays, name).values);
}
Vec3d vector(const std::vector<float>& list, std::size_t i) { return {list[3 * i], list[3 * i + 1], list[3 * i + 2]}; }

Specimen with_a_void(Specimen s) {
  s.voids.push_back({{0.0041, 0.0038, 0.0049}, 0.4e-3});
  return s;
}

TEST(FieldMeshes, EveryCellIsClosedAndHasItsVolume) {
  const Specimen s = with_a_void(random_specimen(test_seed()));
  const Tessellation t = tessellate(s);
  const FieldMesh mesh = cell_mesh(s, t, {});
  const auto &particle = whole(mesh.arrays, "particle"), &neighbour = whole(mesh.arrays, "neighbour"),
             &phase = whole(mesh.arrays, "phase"), &body = whole(mesh.arrays, "body");
  std::vector<double> volume(s.cells());
  std::map<std::pair<std::int32_t, std::int32_t>, double> area;
  for (std::size_t p = 0; p < mesh.cell_count(); ++p) {
    const auto cell = static_cast<std::size_t>(particle[p]);
    ASSERT_LT(cell, s.cells());
    EXPECT_EQ(phase[p], cell < s.size() ? static_cast<int>(s.phase[cell]) : 2);
    EXPECT_EQ(body[p], cell < s.size() ? s.body[cell] : -1);
    const auto corner = [&](std::int64_t k) {
      return vector(mesh.points, static_cast<std::size_t>(mesh.connectivity[static_cast<std::size_t>(k)]));
    };
    Vec3d twice{};
    const Vec3d first = corner(mesh.offsets[p]);
    for (std::int64_t k = mesh.offsets[p] + 1; k + 1 < mesh.offsets[p + 1]; ++k) {
      twice += cross(corner(k) - first, corner(k + 1) - first);
    }
    volume[cell] += dot(first, twice) / 6;  // volume by the divergence theorem; facets point outwards
    EXPECT_TRUE((area.emplace(std::pair{particle[p], neighbour[p]}, 0.5 * norm(twice)).second));
    // Corners are in single precision: they are wrong by up to 6e-8 times their coordinates, which are at most 8 mm.
    // For facets with sides of about 2 mm, the area is then wrong by less than 1e-6 of 4 mm².
    EXPECT_NEAR(floats(mesh.arrays, "area")[p], 0.5 * norm(twice), 1e-6 * 4e-6);
  }
  // Corners are wrong by up to 6e-8 times 8 mm. Over a surface of about 2e-5 m² this changes the volume by about 1e-14
  // m³.
  for (std::size_t i = 0; i < s.cells(); ++i) EXPECT_NEAR(volume[i], t.cell_volume[i], 2e-14) << i;
  for (const auto& [pair, one] : area) {
    if (pair.second >= 0) { EXPECT_NEAR(one, area.at({pair.second, pair.first}), 1e-12); }
  }
}

TEST(FieldMeshes, LinesJoinWhatContactsJoin) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  const FieldMesh mesh = contact_mesh(scene.specimen, scene.network);
  ASSERT_EQ(mesh.cell_count(), scene.network.contacts.size());
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const Contact& contact = scene.network.contacts[c];
    const auto a = static_cast<std::size_t>(mesh.connectivity[2 * c]),
               b = static_cast<std::size_t>(mesh.connectivity[2 * c + 1]);
    EXPECT_EQ(a, static_cast<std::size_t>(contact.a));
    if (contact.b >= 0) { EXPECT_EQ(b, static_cast<std::size_t>(contact.b)); }
    const Vec3d line = vector(mesh.points, b) - vector(mesh.points, a);
    EXPECT_NEAR(norm(line), contact.distance, 1e-8);  // single precision, for coordinates up to 10 mm
    EXPECT_NEAR(dot(line, contact.n), contact.distance, 1e-8);
    EXPECT_EQ(whole(mesh.arrays, "b")[c], contact.b);
    EXPECT_EQ(whole(mesh.arrays, "pair")[c], static_cast<int>(contact.pair));
  }
}

// Facets that can crack are the polygons of their contacts; each has the means of the cracks of its points.
TEST(FieldMeshes, PolygonsOfCracksAreTheFacetsOfContactsThatCrack) {
  const Specimen s = random_specimen(test_seed());
  const Tessellation t = tessellate(s);
  const ContactNetwork network = build_network(s, t);
  Laws laws = elastic_laws();
  laws[static_cast<std::size_t>(PairType::mm)] =
      laws::Cracked<laws::Elastic>{laws::Elastic{1e10, 0.1}, {1e6, 50, 2e6, 50, 0, 0}};
  const FieldMesh mesh = crack_mesh(t, network, facts_of(laws));
  ASSERT_EQ(static_cast<std::int64_t>(mesh.cell_count()), network.count[static_cast<std::size_t>(PairType::mm)]);
  ContactState state;
  state.point_cracks.resize(network.point_area.size());
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    for (std::uint32_t j = network.contacts[c].point_begin; j < network.contacts[c].point_end; ++j) {
      const double number = static_cast<double>(c);
      state.point_cracks[j] = {1e-6 * number, 2e-6 * number, number / 1e4, number, 0};
    }
  }
  const std::vector<FieldArray> arrays = crack_arrays(network, facts_of(laws), state);
  for (std::size_t p = 0; p < mesh.cell_count(); ++p) {
    const auto number = static_cast<std::size_t>(whole(mesh.arrays, "contact")[p]);
    const Contact& contact = network.contacts[number];
    EXPECT_EQ(contact.pair, PairType::mm);
    const auto corner = [&](std::int64_t k) {
      return vector(mesh.points, static_cast<std::size_t>(mesh.connectivity[static_cast<std::size_t>(k)]));
    };
    Vec3d twice{};
    const Vec3d first = corner(mesh.offsets[p]);
    for (std::int64_t k = mesh.offsets[p] + 1; k + 1 < mesh.offsets[p + 1]; ++k)
      twice += cross(corner(k) - first, corner(k + 1) - first);
    // as for the cells: corners in single precision move the area by less than 1e-6 of 4 mm²
    EXPECT_NEAR(0.5 * norm(twice), contact.area, 1e-6 * 4e-6);
    const auto value = static_cast<double>(number);
    // single precision
    EXPECT_NEAR(floats(arrays, "opening")[p], 1e-6 * value, 1e-12 * value);
    EXPECT_NEAR(floats(arrays, "slip")[p], 2e-6 * value, 1e-12 * value);
    EXPECT_NEAR(floats(arrays, "damage")[p], value / 1e4, 1e-10 * value);
    EXPECT_NEAR(floats(arrays, "crack_energy")[p], value, 1e-6 * value);
  }
}

TEST(FieldMeshes, SizeClassesAreThoseOfTheAggregates) {
  Specimen s = random_specimen(1);
  std::vector<Aggregate> aggregates(2);
  aggregates[0].body = 0, aggregates[0].size_class = 3;
  aggregates[1].body = 1, aggregates[1].size_class = 1;
  const FieldMesh mesh = particle_mesh(s, aggregates);
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(whole(mesh.arrays, "size_class")[i], s.body[i] == 0 ? 3 : s.body[i] == 1 ? 1 : -1);
    EXPECT_EQ(floats(mesh.arrays, "radius")[i], static_cast<float>(s.radius[i]));
  }
  EXPECT_THROW(array(particle_mesh(s, {}).arrays, "size_class"), std::runtime_error);
}

/// Returns two ratios: the largest sum of forces on any particle over the largest force of a contact, and the largest
/// sum of moments on any particle over this force times 1 mm. The forces and moments given act on the first particle of
/// each contact, at x0.
std::pair<double, double> imbalance(const TestScene& scene, const std::vector<float>& force,
                                    const std::vector<float>& moment) {
  std::vector<Vec3d> sum(scene.specimen.size()), turn(scene.specimen.size());
  double largest_force = 0;
  for (std::size_t c = 0; c < scene.network.contacts.size(); ++c) {
    const Contact& contact = scene.network.contacts[c];
    const Vec3d f = vector(force, c), m = vector(moment, c);
    largest_force = std::max(largest_force, norm(f));
    const auto a = static_cast<std::size_t>(contact.a);
    sum[a] += f;
    turn[a] += m + contact.arm_a * cross(contact.n, f);
    if (contact.b < 0) continue;
    const auto b = static_cast<std::size_t>(contact.b);
    sum[b] -= f;
    turn[b] -= m - contact.arm_b * cross(contact.n, f);
  }
  return {largest(sum) / largest_force, largest(turn) / (largest_force * 1e-3)};
}

TEST(HarmonicFields, ForcesOnEveryParticleAreInEquilibriumAndThoseOfTheWallGiveTheModulus) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  constexpr double frequency = 20, amplitude = 3e-6;
  const HarmonicResult solved =
      Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency).solve(frequency);
  const auto arrays = contact_arrays(scene.network, scene.laws, frequency, solved.motion, amplitude);
  // single precision, and sums of about twenty forces
  constexpr double tolerance = 2e-6;
  for (const std::string part : {"real", "imag"}) {
    const auto [force, moment] = imbalance(scene, floats(arrays, "force_" + part), floats(arrays, "moment_" + part));
    EXPECT_LT(force, tolerance);
    EXPECT_LT(moment, tolerance);
  }
  std::complex<double> top = 0;
  for (std::size_t c = 0; c < scene.network.contacts.size(); ++c) {
    const Contact& contact = scene.network.contacts[c];
    const std::complex<double> n{dot(vector(floats(arrays, "force_real"), c), contact.n),
                                 dot(vector(floats(arrays, "force_imag"), c), contact.n)};
    const double scale = std::abs(n) + floats(arrays, "shear_force_amplitude")[c];
    EXPECT_NEAR(floats(arrays, "normal_force_amplitude")[c], std::abs(n), 1e-6 * scale);
    if (std::abs(n) > 1e-3 * scale) {
      const double phase = floats(arrays, "normal_force_phase")[c] * std::numbers::pi / 180;
      EXPECT_NEAR(std::abs(std::polar(1.0, phase) - n / std::abs(n)), 0, 1e-3);
    }
    if (contact.b == wall_z_hi) top += n;  // n is +z, so tension pulls the particle up
  }
  const Vec3d size = scene.specimen.box.size;
  const std::complex<double> modulus = top / (size.x * size.y) / (amplitude / size.z);
  EXPECT_NEAR(std::abs(modulus) / solved.top.e_star_pa, 1, 1e-6);
  EXPECT_NEAR(std::arg(modulus) * 180 / std::numbers::pi, solved.top.phase_deg, 1e-4);
}

/// The stretches of all units and springs of a contact add up to its relative displacement, and the opening agrees with
/// the motion of its particles.
TEST(HarmonicFields, StretchesAndSpringsMakeUpTheRelativeDisplacement) {
  const TestScene scene = make_scene(random_specimen(test_seed()));
  constexpr double frequency = 5, amplitude = 1e-6;
  const HarmonicResult solved =
      Harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {}, frequency).solve(frequency);
  const auto arrays = contact_arrays(scene.network, scene.laws, frequency, solved.motion, amplitude);
  const auto particles = particle_arrays(solved.motion, amplitude);
  const std::complex<double> s(0, 2 * std::numbers::pi * frequency);
  const auto at = [&](const std::string& name, std::size_t i) {
    return std::complex<double>(floats(arrays, name + "_real")[i], floats(arrays, name + "_imag")[i]);
  };
  for (std::size_t c = 0; c < scene.network.contacts.size(); ++c) {
    const Contact& contact = scene.network.contacts[c];
    const auto& law = *scene.laws[static_cast<std::size_t>(contact.pair)];
    const auto* kelvin = std::get_if<laws::GeneralisedKelvin>(&law);
    for (std::size_t k = 0; k < 6; ++k) {
      const std::complex<double> x = at("relative_displacement", 6 * c + k);
      std::complex<double> sum = 0;
      for (int l = 1; l <= 3; ++l) sum += at(fmt::format("stretch_{}", l), 6 * c + k);
      if (!kelvin) {
        EXPECT_EQ(sum, 0.0);  // an elastic contact has no units
        continue;
      }
      const std::complex<double> f = kelvin->stiffness(s) * x;
      EXPECT_NEAR(std::abs(sum + f * (1 / kelvin->E_m + 1.0 / (s * kelvin->C_m)) - x), 0, 1e-6 * std::abs(x));
    }
    if (contact.b < 0) continue;
    // The opening is the difference of the displacements along the normal.
    std::complex<double> opening = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = k == 0 ? contact.n.x : k == 1 ? contact.n.y : contact.n.z;
      const std::size_t a = 3 * static_cast<std::size_t>(contact.a) + k,
                        b = 3 * static_cast<std::size_t>(contact.b) + k;
      opening += n * std::complex<double>(
                         floats(particles, "displacement_real")[b] - floats(particles, "displacement_real")[a],
                         floats(particles, "displacement_imag")[b] - floats(particles, "displacement_imag")[a]);
    }
    EXPECT_NEAR(std::abs(opening - at("relative_displacement", 6 * c)), 0, 1e-6 * amplitude);
  }
}

TEST(HarmonicFields, AmplitudeAndPhaseAreThoseOfThePartsForAWallThatMovesAsACosine) {
  const std::vector<std::complex<double>> motion{{3, 4}, {0, -2}, {-1, 0}, {0.5, 0}, {0, 0}, {0, 1}};
  const auto arrays = particle_arrays(motion, 2.0);
  EXPECT_EQ(floats(arrays, "displacement_real"), (std::vector<float>{6, 0, -2}));
  EXPECT_EQ(floats(arrays, "displacement_imag"), (std::vector<float>{8, -4, 0}));
  EXPECT_EQ(floats(arrays, "displacement_amplitude"), (std::vector<float>{10, 4, 2}));
  EXPECT_NEAR(floats(arrays, "displacement_phase")[0], 53.130102, 1e-5);
  EXPECT_FLOAT_EQ(floats(arrays, "displacement_phase")[1], -90);
  EXPECT_FLOAT_EQ(std::abs(floats(arrays, "displacement_phase")[2]), 180);
  EXPECT_EQ(floats(arrays, "rotation_imag"), (std::vector<float>{0, 0, 2}));
}

// Every contact, including those at the walls, gets the force that a uniform stress exerts on its facet. Every cell
// must then have this stress, whatever the shape of the cell.
TEST(SteppedFields, AUniformStressIsThatOfEveryCell) {
  NetworkSpec spec;
  spec.lateral_walls = true;
  const TestScene scene = make_scene(random_specimen(test_seed()), spec);
  const double xx = 3e5, yy = -1e5, zz = 2e6, xy = 4e5, yz = -7e5, xz = 5e4;
  ContactState state;
  for (const Contact& c : scene.network.contacts) {
    const Vec3d &n = c.n, traction{xx * n.x + xy * n.y + xz * n.z, xy * n.x + yy * n.y + yz * n.z,
                                   xz * n.x + yz * n.y + zz * n.z};
    state.force.push_back(c.area * traction);
  }
  const FieldArray stress = stress_array(tessellate(scene.specimen), scene.network, state);
  EXPECT_EQ(stress.components, 6);
  EXPECT_EQ(stress.unit, "Pa");
  const auto& found = std::get<std::vector<float>>(stress.values);
  ASSERT_EQ(found.size(), 6 * scene.specimen.size());
  const double expected[6] = {xx, yy, zz, xy, yz, xz};
  // the arrays are in single precision
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i % 6], 1e-6 * zz) << i;
}

// In a lattice at rest under a platen (a wall that moves under a load), each cube has the stress of the platen.
TEST(SteppedFields, StressOfALatticeIsThatOfItsWalls) {
  const double side = 2e-3, force = -3.0;
  const HandMade made = cubic_lattice_network(2, 2, 3, side, 2e-5);
  const Laws laws = same_law(laws::Elastic{3e9, 0});
  StepperOptions options;
  options.dt = 0.3 * critical_step(made.network, laws, made.inertia, options).dt;
  options.damping_kind = Damping::local;
  options.damping = 0.7;
  options.boundary.load(wall_z_hi, 2, std::make_shared<drives::Ramp>(force, options.dt, 100), 1e-4);
  const auto stepper = make_stepper(Backend::cpu, made.specimen, made.network, laws, made.inertia, options);
  stepper->advance(6000);
  const FieldArray stress = stress_array(tessellate(made.specimen), made.network, stepper->contacts(made.network));
  const double expected = force / (4 * side * side);
  for (std::size_t i = 0; i < made.specimen.size(); ++i) {
    const float* one = &std::get<std::vector<float>>(stress.values)[6 * i];
    EXPECT_NEAR(one[2], expected, 1e-3 * std::abs(expected));
    for (const int k : {0, 1, 3, 4, 5}) EXPECT_NEAR(one[k], 0, 1e-3 * std::abs(expected)) << k;
  }
}

TEST(SteppedFields, NormalsTurnWithTheParticles) {
  const HandMade made = two_sphere_network();
  ContactState state;
  state.force = {{3, 0, 4}};
  state.moment = {{1, 2, 3}};
  state.relative = {{1, 2, 3, 4, 5, 6}};
  state.chain = {10, 11, 12, 20, 21, 22, 30, 31, 32, 40, 41, 42, 50, 51, 52, 60, 61, 62};  // two Kelvin units
  state.chain_begin = {0, 18};
  const auto still = contact_arrays(made.specimen, made.network, state, {});
  EXPECT_EQ(floats(still, "normal_force"), std::vector<float>{4});  // n is along z
  EXPECT_EQ(floats(still, "shear_force"), std::vector<float>{3});
  EXPECT_EQ(floats(still, "moment"), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(floats(still, "relative_displacement"), (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(floats(still, "stretch_1"), (std::vector<float>{11, 21, 31, 41, 51, 61}));
  EXPECT_EQ(floats(still, "stretch_2"), (std::vector<float>{12, 22, 32, 42, 52, 62}));
  EXPECT_THROW(array(still, "stretch_3"), std::runtime_error);
  // Particle b is displaced sideways until the line of centres is along x + z.
  const double distance = norm(made.specimen.centre[1] - made.specimen.centre[0]);
  const auto turned = contact_arrays(made.specimen, made.network, state, {{0, 0, 0}, {distance, 0, 0}});
  EXPECT_FLOAT_EQ(floats(turned, "normal_force")[0], static_cast<float>(7 / std::sqrt(2.0)));
  EXPECT_FLOAT_EQ(floats(turned, "shear_force")[0], static_cast<float>(1 / std::sqrt(2.0)));
}

}  // namespace
}  // namespace macadam::test
