// SPDX-License-Identifier: GPL-3.0-or-later
/// \file void_test.cpp  Tests air voids in files, in generated specimens and in every solver. An air void is a cell
/// without a particle; its facets are free surfaces.
#include <algorithm>
#include <numbers>

#include "host/reference/reference_spectrum.hpp"
#include "macadam/harmonic.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"

namespace macadam::test {
namespace {

double volume_of(double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; }

/// Returns 3 × 3 × 5 touching mastic spheres.
Specimen lattice() {
  Specimen out;
  out.box.size = {6e-3, 6e-3, 10e-3};
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) out.centre.push_back({1e-3 + 2e-3 * i, 1e-3 + 2e-3 * j, 1e-3 + 2e-3 * k});
  out.radius.assign(out.centre.size(), 1e-3);
  out.phase.assign(out.centre.size(), Phase::mastic);
  out.body.assign(out.centre.size(), -1);
  return out;
}

/// Returns the specimen with one particle replaced by a void.
Specimen with_void(Specimen s, std::size_t particle) {
  const auto at = static_cast<std::ptrdiff_t>(particle);
  s.voids.push_back({s.centre[particle], s.radius[particle]});
  s.centre.erase(s.centre.begin() + at), s.radius.erase(s.radius.begin() + at);
  s.phase.erase(s.phase.begin() + at), s.body.erase(s.body.begin() + at);
  return s;
}

/// Returns random spheres, some of which are voids.
Specimen porous(unsigned seed) {
  Specimen s = random_specimen(seed, 5, 5, 6);
  for (const std::size_t particle : {110U, 77U, 62U, 31U}) s = with_void(std::move(s), particle);
  return s;
}

TEST(Voids, HaveTheCellsOfParticlesAndNoContacts) {
  const Specimen whole = random_specimen(3, 5, 5, 6);
  for (const std::size_t gone : {0U, 62U, 149U}) {  // at walls and inside
    const Specimen s = with_void(whole, gone);
    const Tessellation before = tessellate(whole), after = tessellate(s);
    EXPECT_NEAR(after.cell_volume.back() / before.cell_volume[gone], 1, 1e-9);
    const TessellationInvariants i = measure_invariants(s, after);
    EXPECT_LT(std::max({i.volume, i.closure, i.flatness, i.power, i.walls}), 1e-9);
    // The contacts of all other particles must stay, with renumbered particles.
    const ContactNetwork all = build_network(whole, before), left = build_network(s, after);
    std::size_t k = 0;
    const auto number = [&](std::int32_t particle) { return particle - (particle > static_cast<int>(gone) ? 1 : 0); };
    for (const Contact& c : all.contacts) {
      if (c.a == static_cast<int>(gone) || c.b == static_cast<int>(gone)) continue;
      ASSERT_LT(k, left.contacts.size());
      const Contact& d = left.contacts[k++];
      EXPECT_EQ(d.a, number(c.a));
      EXPECT_EQ(d.b, number(c.b));
      EXPECT_EQ(d.pair, c.pair);
      // Areas differ by rounding: the triangulation processes the sites in another order, and the area of a facet is a
      // sum of differences of its corners.
      EXPECT_NEAR(d.area, c.area, 1e-9 * 4e-6);
      EXPECT_NEAR(d.moments.ss, c.moments.ss, 1e-9 * 4e-12);
    }
    EXPECT_EQ(k, left.contacts.size());
  }
}

// Without shear stiffness the nine columns of a lattice are parallel springs. A void interrupts one column.
TEST(Voids, CutAColumnOfALattice) {
  const Laws laws = same_law(laws::Elastic{2e10, 0});
  for (const std::size_t particle : {4U, 22U, 26U}) {  // at the bottom wall, in the middle, at an edge
    const TestScene scene = make_scene(with_void(lattice(), particle), {}, laws);
    const double expected = 2e10 * 8 / 9;
    EXPECT_NEAR(reference_static_modulus(scene.specimen, scene.network, scene.laws) / expected, 1, 1e-9) << particle;
    EXPECT_EQ(scene.inertia.mass.size(), 44U);
  }
}

TEST(Voids, MakeASpecimenSofterInEverySolver) {
  const Specimen whole = random_specimen(7, 5, 5, 6);
  const Laws laws = same_law(laws::Elastic{2e10, 0.1});
  const TestScene full = make_scene(whole, {}, laws), scene = make_scene(porous(7), {}, laws);
  const double e_full = reference_static_modulus(full.specimen, full.network, full.laws);
  const double e = reference_static_modulus(scene.specimen, scene.network, scene.laws);
  EXPECT_LT(e, 0.99 * e_full);
  EXPECT_GT(e, 0.5 * e_full);
  for (const LinearMethod linear : {LinearMethod::iterative, LinearMethod::direct}) {
    Harmonic harmonic(scene.specimen, scene.network, scene.laws, scene.inertia, {.linear = linear}, 1);
    EXPECT_NEAR(harmonic.solve(1).top.e_star_pa / e, 1, 1e-8);  // the residuals of the two solvers are different
  }
}

class VoidsInSteps : public BackendTest<StepperCase> {};

INSTANTIATE_TEST_SUITE_P(All, VoidsInSteps, all_stepper_cases(), [](const auto& info) { return name_of_case(info); });

TEST_P(VoidsInSteps, AgreeWithTheReference) {
  const TestScene scene = make_scene(porous(11));
  StepperOptions options = shaking_options(scene);
  options.form = std::get<ContactForm>(GetParam());
  options.geometry = std::get<Geometry>(GetParam());
  const auto reference =
      make_stepper(Backend::reference, scene.specimen, scene.network, scene.laws, scene.inertia, options);
  options.precision = std::get<Precision>(GetParam());
  const auto stepper = make_stepper(backend(), scene.specimen, scene.network, scene.laws, scene.inertia, options);
  reference->advance(100), stepper->advance(100);
  // The tolerance allows for rounding errors that accumulate over 100 steps.
  const double loose = options.precision == Precision::double_ ? 1e-9 : 1e-3;
  EXPECT_LT(relative_difference(stepper->particles().displacement, reference->particles().displacement), loose);
}

class VoidFiles : public testing::Test {
 protected:
  VoidFiles() : folder_(fs::path(testing::TempDir()) / fmt::format("macadam_voids_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~VoidFiles() override { fs::remove_all(folder_); }

  Specimen read_rows(const std::string& rows) const {
    write(folder_ / "s.csv", "id,x,y,z,radius,phase,body\n" + rows);
    return read_specimen_csv(folder_ / "s.csv", {{0.01, 0.01, 0.01}});
  }
  std::string refused(const std::string& rows) const {
    return message_of([&] { read_rows(rows); });
  }
  fs::path folder_;
};

TEST_F(VoidFiles, AreReadAsTheyWereWritten) {
  const Specimen s = porous(5);
  write_specimen_csv(folder_ / "porous.csv", s);
  const Specimen t = read_specimen_csv(folder_ / "porous.csv", s.box);
  EXPECT_EQ(t.radius, s.radius);
  ASSERT_EQ(t.voids.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(norm(t.voids[k].centre - s.voids[k].centre), 0);
    EXPECT_EQ(t.voids[k].radius, s.voids[k].radius);
  }
}

TEST_F(VoidFiles, AreRefusedWhereTheyCannotBe) {
  const std::string mastic = "0,0.002,0.005,0.005,0.002,mastic,-1\n";
  EXPECT_EQ(read_rows(mastic + "1,0.008,0.005,0.005,0.001,void,-1\n").voids.size(), 1U);
  EXPECT_HAS(refused("1,0.008,0.005,0.005,0.001,void,-1\n" + mastic),
             "s.csv:3: column phase: found \"mastic\" after a void");
  EXPECT_HAS(refused(mastic + "1,0.008,0.005,0.005,0.001,void,3\n"), "s.csv:3: column body of a void: found \"3\"");
  EXPECT_HAS(refused(mastic + "1,0.008,0.005,0.005,0,void,-1\n"), "s.csv:3: void 1: radius: found 0");
  EXPECT_HAS(refused(mastic + "1,0.018,0.005,0.005,0.001,void,-1\n"), "s.csv:3: void 1: centre");
  EXPECT_HAS(refused(mastic + "1,0.002,0.005,0.005,0.001,void,-1\n"), "the centre of particle 0");
  EXPECT_HAS(refused(mastic + "1,0.008,0.005,0.005,0.001,air,-1\n"), "expected aggregate, mastic or void");
  EXPECT_HAS(refused("1,0.008,0.005,0.005,0.001,void,-1\n"), "particles");  // only voids, no particles
  Specimen s = lattice();
  s.phase[7] = Phase::air_void;  // voids must be in `voids`
  EXPECT_HAS(message_of([&] { validate(s, "here"); }), "here: particle 7: phase");
}

TEST_F(VoidFiles, OfAHiddenVoidIsSaid) {
  // The smaller of two voids with nearly the same centre has no cell.
  const Specimen s = read_rows(
      "0,0.002,0.005,0.005,0.002,mastic,-1\n1,0.008,0.005,0.005,0.002,void,-1\n2,0.0081,0.005,0.005,0.001,void,-1\n");
  EXPECT_HAS(message_of([&] { build_network(s, tessellate(s)); }), "particles and voids (number 2)");
}

SpecimenSpec mix(double fraction) {
  SpecimenSpec spec;
  spec.box = {{0.014, 0.014, 0.014}};
  spec.aggregate = {{0.002, 0.00475, 0.25, {}}};
  spec.mastic = MasticSpec{0.00075, 0.001, 0.05, {}};
  if (fraction > 0) spec.voids = VoidSpec{0.0006, 0.0012, fraction, {}};
  return spec;
}

void expect_sound(const SpecimenSpec& spec, const GeneratedSpecimen& made, double fraction) {
  const Specimen& s = made.specimen;
  double air = 0, solid = 0;
  for (std::size_t k = 0; k < s.voids.size(); ++k) {
    const VoidSphere& v = s.voids[k];
    air += volume_of(v.radius);
    EXPECT_GE(v.radius, 0.0006 * (1 - 1e-12));
    EXPECT_LE(v.radius, 0.0012 * (1 + 1e-12));
    for (const double wall : {v.centre.x, v.centre.y, v.centre.z}) {
      EXPECT_GE(wall, v.radius - 1e-15);
      EXPECT_LE(wall, 0.014 - v.radius + 1e-15);
    }
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s.phase[i] == Phase::aggregate) { EXPECT_GE(norm(s.centre[i] - v.centre), s.radius[i] + v.radius - 1e-15); }
    }
    for (std::size_t l = 0; l < k; ++l)
      EXPECT_GE(norm(s.voids[l].centre - v.centre), s.voids[l].radius + v.radius - 1e-15);
  }
  for (const Aggregate& a : made.aggregates) solid += a.volume;
  for (std::size_t i = 0; i < s.size(); ++i) solid += s.phase[i] == Phase::mastic ? volume_of(s.radius[i]) : 0;
  const double box = spec.box.volume();
  EXPECT_NEAR(air / box, fraction, volume_of(0.0012) / box);
  // The porosity is the fraction of pores in the volume without voids. The tolerance is the volume of the last sphere.
  EXPECT_NEAR(solid / box, 0.95 * (1 - fraction), volume_of(0.001) / box);
  EXPECT_EQ(made.composition.back().name, "voids");
  EXPECT_EQ(made.composition.back().count, static_cast<std::int64_t>(s.voids.size()));
  EXPECT_DOUBLE_EQ(made.composition.back().fraction, air / box);
  EXPECT_TRUE(particles_without_cell(s).empty());
}

TEST(GeneratedVoids, HaveTheFractionAndTheSizesAskedFor) {
  const GeneratedSpecimen made = generate_specimen(mix(0.05));
  expect_sound(mix(0.05), made, 0.05);
  const GeneratedSpecimen again = generate_specimen(mix(0.05));
  EXPECT_EQ(again.specimen.radius, made.specimen.radius);
  EXPECT_EQ(norm(again.specimen.voids.back().centre - made.specimen.voids.back().centre), 0);
  SpecimenSpec counted = mix(0);
  counted.voids = VoidSpec{0.0006, 0.0012, {}, 7};
  EXPECT_EQ(generate_specimen(counted).specimen.voids.size(), 7U);
}

TEST(GeneratedVoids, LieOutsideOfShapes) {
  SpecimenSpec spec = mix(0.04);
  spec.aggregate = {{0.003, 0.006, 0.3, {}}};
  spec.shapes = ShapeSpec{};
  spec.shapes->library = ShapeSpec::Library::icosahedron;
  spec.shapes->fill.radius_min = spec.shapes->fill.radius_max = 0.00055;
  const GeneratedSpecimen made = generate_specimen(spec);
  ASSERT_FALSE(made.aggregates.empty());
  ASSERT_EQ(made.surfaces.size(), 1U);
  expect_sound(spec, made, 0.04);
  for (const Aggregate& a : made.aggregates) {
    if (a.surface < 0) continue;
    Surface placed = made.surfaces.front();
    for (Vec3d& p : placed.points) p = a.pose(p);
    const ShapeMeasure m = measure_shape(placed);
    EXPECT_NEAR(m.volume / a.volume, 1, 1e-9);
    EXPECT_LT(norm(m.centroid - a.centre), 1e-9);
    EXPECT_NEAR(m.d_intermediate / a.size, 1, 1e-9);
  }
}

TEST(GeneratedVoids, AreRefusedWhereTheyAreImpossible) {
  SpecimenSpec spec = mix(0.05);
  spec.fix_aggregates = false;
  EXPECT_HAS(message_of([&] { generate_specimen(spec); }), "fix_aggregates");
  spec = mix(0.05), spec.voids->count = 3;
  EXPECT_HAS(message_of([&] { generate_specimen(spec); }), "voids: found both fraction and count");
  spec = mix(0.05), spec.voids->radius_max = 0.0001;
  EXPECT_HAS(message_of([&] { generate_specimen(spec); }), "voids: sizes");
  spec = mix(0.9);
  EXPECT_HAS(message_of([&] { generate_specimen(spec); }), "void");
  spec = mix(0.55), spec.attempts = 2000;
  EXPECT_HAS(message_of([&] { generate_specimen(spec); }), "no space for void");
}

TEST(VoidCells, HaveTheVolumesOfTheirSpheres) {
  const Specimen s = generate_specimen(mix(0.05)).specimen;
  const Tessellation plain = tessellate(s), equal = tessellate_with_void_volumes(s);
  ASSERT_EQ(equal.void_weight.size(), s.voids.size());
  EXPECT_TRUE(plain.void_weight.empty());
  double spheres = 0, cells = 0;
  for (std::size_t k = 0; k < s.voids.size(); ++k) {
    const double sphere = volume_of(s.voids[k].radius);
    spheres += sphere, cells += plain.cell_volume[s.size() + k];
    EXPECT_NEAR(equal.cell_volume[s.size() + k] / sphere, 1, 1e-3) << k;  // the tolerance that the function promises
  }
  EXPECT_GT(cells, 1.05 * spheres);  // otherwise the test would show nothing
  const TessellationInvariants i = measure_invariants(s, equal);
  EXPECT_LT(std::max({i.volume, i.closure, i.flatness, i.power, i.walls}), 1e-9);
  for (const Facet& f : equal.facets) {
    if (f.b < 0 || f.b >= static_cast<std::int32_t>(s.size())) continue;
    const auto a = static_cast<std::size_t>(f.a), b = static_cast<std::size_t>(f.b);
    const double d = norm(s.centre[b] - s.centre[a]);
    const double arm = 0.5 * (d + (s.radius[a] * s.radius[a] - s.radius[b] * s.radius[b]) / d);
    EXPECT_NEAR(dot(f.centroid - s.centre[a], f.normal) / d, arm / d, 1e-9);  // rounding of the vertices
  }
}

TEST(VoidCells, AreThoseOfTheTessellationWithoutVoids) {
  const Specimen s = random_specimen(3, 5, 5, 6);
  const Tessellation plain = tessellate(s), equal = tessellate_with_void_volumes(s);
  EXPECT_EQ(equal.cell_volume, plain.cell_volume);
  EXPECT_EQ(equal.facets.size(), plain.facets.size());
  EXPECT_TRUE(equal.void_weight.empty());
}

TEST_F(VoidFiles, MayNeedNegativeWeights) {
  const Specimen s = read_rows("0,0.002,0.005,0.005,0.002,mastic,-1\n1,0.008,0.005,0.005,0.001,void,-1\n");
  const Tessellation cells = tessellate_with_void_volumes(s);
  ASSERT_EQ(cells.void_weight.size(), 1U);
  // A cell of 4.18879 mm³ begins at x = 10 - 0.0418879 mm. There (36 + 4 - weight)/12 = x - 2 with lengths in mm.
  EXPECT_NEAR(cells.void_weight[0], -55.49735e-6, 0.001 * 4.19e-9 / 100e-6 * 12e-3);  // 0.1 % of the volume
  EXPECT_NEAR(cells.cell_volume[1] / volume_of(0.001), 1, 1e-3);
  const TessellationInvariants i = measure_invariants(s, cells);
  EXPECT_LT(std::max({i.volume, i.closure, i.flatness, i.power, i.walls}), 1e-9);
}

TEST_F(VoidFiles, LeaveTheCellsOfParticles) {
  // The two voids have more volume than the box, so cells of this volume would leave nothing to the mastic.
  const Specimen s = read_rows(
      "0,0.002,0.005,0.005,0.002,mastic,-1\n1,0.006,0.005,0.005,0.005,void,-1\n2,0.0062,0.005,0.005,0.005,void,-1\n");
  const Tessellation cells = tessellate_with_void_volumes(s);
  EXPECT_TRUE(cells.hidden.empty());
  EXPECT_GT(cells.cell_volume[0], 0);
}

class VoidScenes : public VoidFiles {
 protected:
  Scene scene(const std::string& specimen, const std::string& voids) const {
    const std::string contacts = am1_contacts;
    write(folder_ / "scene.toml", "[specimen]\nbox = [0.014, 0.014, 0.014]\n" + specimen +
                                      "[specimen.mastic]\nradius = [\"0.75 mm\", \"1 mm\"]\n" + voids +
                                      "[loading]\nkind = \"cyclic\"\nfrequencies = [10.0]\n[solver]\nmethod = "
                                      "\"harmonic\"\n" +
                                      // densities follow from the recipe
                                      contacts.substr(contacts.find("[[contacts]]")));
    return read_scene(folder_ / "scene.toml");
  }
  static constexpr const char* recipe = R"([specimen.recipe]
gradation = [["4 mm", 1], ["2 mm", 0.6], ["0.063 mm", 0.08]]
binder = "6 %"
binder_of = "mix"
aggregate_density = 2700
binder_density = 1030
air_voids = "4 %"
)";
};

TEST_F(VoidScenes, TakeTheAirVoidsOfARecipe) {
  const Scene all = scene(recipe, "[specimen.voids]\nradius = [\"0.6 mm\", \"1 mm\"]\n");
  EXPECT_DOUBLE_EQ(*all.specimen.voids->fraction, 0.04);
  EXPECT_NEAR(*all.specimen.mastic->porosity, 0, 1e-15);  // all air is in the voids
  const Scene some = scene(recipe, "[specimen.voids]\nradius = [\"0.6 mm\", \"1 mm\"]\nfraction = \"3 %\"\n");
  EXPECT_NEAR((1 - *some.specimen.mastic->porosity) * 0.97, 0.96, 1e-12);
  const MixVolumes asked = volumes_of(*all.recipe);
  for (const Scene& s : {all, some}) {  // the mix design gives the solid volumes, with or without voids
    const GeneratedSpecimen made = generate_specimen(s.specimen);
    const double rounding = volume_of(0.001) / s.specimen.box.volume();
    EXPECT_NEAR(made.composition[0].fraction, asked.classes[0].volume, rounding);
    EXPECT_NEAR(made.composition[1].fraction, asked.mastic_volume, rounding);
    const auto curve = gradation_of(*s.recipe, made.composition);
    EXPECT_NEAR(curve[1].reached, 0.6, 0.01);
  }
  const auto voids = [&](const std::string& keys) {
    return message_of([&] { scene(recipe, "[specimen.voids]\nradius = [\"0.6 mm\", \"1 mm\"]\n" + keys); });
  };
  EXPECT_HAS(voids("fraction = \"5 %\"\n"), "the mix has only 4 % of air voids");
  EXPECT_HAS(voids("count = 3\n"), "count");
}

TEST_F(VoidScenes, AreRefusedAtTheirLines) {
  const std::string plain = "[[specimen.aggregate]]\nsieve = [\"2 mm\", \"4 mm\"]\nvolume_fraction = 0.2\n";
  const auto message = [&](const std::string& voids) {
    return message_of([&] {
      write(folder_ / "scene.toml", "[specimen]\nbox = [0.014, 0.014, 0.014]\n" + plain +
                                        "[specimen.mastic]\nradius = [\"0.75 mm\", \"1 mm\"]\nporosity = 0.05\n" +
                                        "[specimen.voids]\n" + voids +
                                        "[loading]\nkind = \"cyclic\"\nfrequencies = [10.0]\n" + am1_contacts);
      read_scene(folder_ / "scene.toml");
    });
  };
  EXPECT_EQ(message("radius = [\"0.6 mm\", \"1 mm\"]\nfraction = 0.04\n"), "nothing was thrown");
  EXPECT_HAS(message("fraction = 0.04\n"), "radius");
  EXPECT_HAS(message("radius = [\"0.6 mm\", \"1 mm\"]\n"), "neither fraction nor count");
  EXPECT_HAS(message("radius = [\"0.6 mm\", \"1 mm\"]\nfraction = 0.04\ncount = 3\n"), "fraction and count");
  EXPECT_HAS(message("radius = [\"1 mm\", \"0.6 mm\"]\nfraction = 0.04\n"), "min not above max");
  EXPECT_HAS(message("radius = [\"0.6 mm\", \"8 mm\"]\nfraction = 0.04\n"), "smallest edge of the box");
  EXPECT_HAS(message("radius = [\"0.6 mm\", \"1 mm\"]\nfraction = 1\n"), "a fraction from 0 to below 1");
  EXPECT_HAS(message("radius = [\"0.6 mm\", \"1 mm\"]\nfractoin = 0.1\n"), "fraction");
}

TEST_F(VoidScenes, AreReportedInSummaryAndSections) {
  const Scene s = scene(recipe, "[specimen.voids]\nradius = [\"0.6 mm\", \"1 mm\"]\n");
  const Preparation prepared = prepare_into(folder_ / "out", s, {{'z', 0.007}});
  const std::string summary = read(folder_ / "out" / "summary.json");
  EXPECT_HAS(summary, fmt::format("\"voids\": {}", prepared.specimen.voids.size()));
  EXPECT_HAS(summary, "\"void_cells\": 0.0");
  EXPECT_HAS(read(folder_ / "out" / "section_z_0.007.csv"), ",void,-1,");
  EXPECT_EQ(prepared.loose_particles, 0);
}

}  // namespace
}  // namespace macadam::test
