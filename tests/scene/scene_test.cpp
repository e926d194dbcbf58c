// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_test.cpp  Tests that the values of a scene are converted to the right SI values, and that an error names
/// the values that are missing.
#include "macadam/scene.hpp"

#include <cmath>

#include "tests/scene/scene_file.hpp"

namespace macadam {
namespace {

using test::Edits, test::good_scene, test::SceneFile, test::text_of;

TEST_F(SceneFile, ReadsEveryKindOfSectionInSIUnits) {
  const Scene scene = read(text_of());
  // A text with a unit is read to the same double as the literal in SI units, so all comparisons are exact.
  EXPECT_EQ(scene.file, file());
  EXPECT_EQ(scene.specimen.box.size.y, 0.02);
  EXPECT_EQ(scene.specimen.box.size.z, 0.03);
  EXPECT_EQ(scene.specimen.seed, 7u);
  EXPECT_FALSE(scene.specimen.file);
  ASSERT_EQ(scene.specimen.aggregate.size(), 1u);
  EXPECT_EQ(scene.specimen.aggregate[0].sieve_min, 0.00475);
  EXPECT_EQ(scene.specimen.aggregate[0].sieve_max, 0.0095);
  EXPECT_EQ(scene.specimen.aggregate[0].volume_fraction, 0.25);
  EXPECT_FALSE(scene.specimen.aggregate[0].count);
  ASSERT_TRUE(scene.specimen.mastic);
  EXPECT_EQ(scene.specimen.mastic->radius_min, 0.00075);
  EXPECT_EQ(scene.specimen.mastic->porosity, 0.05);
  EXPECT_EQ(scene.materials.mastic, 2110.0);
  const auto& kelvin = std::get<laws::GeneralisedKelvin>(*scene.laws[int(PairType::mm)]);
  EXPECT_EQ(kelvin.C_m, 2.515e9);
  EXPECT_EQ(kelvin.E, (std::vector<double>{3.799e8, 1.6e9}));
  EXPECT_EQ(kelvin.C, (std::vector<double>{8.950e9, 5.695e9}));
  EXPECT_EQ(kelvin.alpha, 0.10);
  const auto& elastic = std::get<laws::Elastic>(*scene.laws[int(PairType::aw)]);
  EXPECT_EQ(elastic.E, 2 * 1.151e11);
  EXPECT_EQ(elastic.alpha, 0.0);
  EXPECT_FALSE(scene.laws[int(PairType::aa)]);
  EXPECT_EQ(scene.cyclic().frequencies, (std::vector<double>{2, 5}));
  EXPECT_EQ(scene.cyclic().ramp_cycles, 0.5);
  EXPECT_EQ(scene.solver.density_scaling, (std::vector<double>{100, 16}));
  EXPECT_EQ(scene.solver.time_step, 1e-7);
  EXPECT_EQ(scene.solver.damping_kind, Damping::none);
  EXPECT_TRUE(scene.output.contacts);
}

TEST_F(SceneFile, DefaultsAreThoseOfTheHeader) {
  Edits edits;
  for (int line : {27, 28, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42}) edits[line] = "";
  const Scene scene = read(text_of(edits));
  const experiments::Cyclic loading;
  const SolverSpec solver;
  EXPECT_EQ(scene.cyclic().strain_amplitude, loading.strain_amplitude);
  EXPECT_EQ(scene.cyclic().cycles, loading.cycles);
  EXPECT_EQ(scene.cyclic().samples_per_cycle, loading.samples_per_cycle);
  EXPECT_EQ(scene.solver.density_scaling, solver.density_scaling);
  EXPECT_EQ(scene.solver.safety, solver.safety);
  EXPECT_EQ(scene.solver.backend, Backend::automatic);
  EXPECT_FALSE(scene.solver.time_step);
  EXPECT_FALSE(scene.network.gap_max);
  EXPECT_FALSE(scene.output.contacts);
}

TEST_F(SceneFile, ReadsTheOtherChoices) {
  const Scene scene = read(text_of({{3, "size_law = \"volume_uniform\"\nfix_aggregates = false\nattempts = 2e5"},
                                    {6, "count = 12"},
                                    {9, "porosity = -0.017"},
                                    {18, "C_m = inf"},
                                    {19, "gap_max = 0.5"},
                                    {20, "area_min = 0"},
                                    {28, "quadrature = \"exact\"\ngap_max = 0\narea_min = 0.026\nlateral_walls = true"},
                                    {33, "cycles = 6\nfit_cycles = 3\nsamples_per_cycle = 8"},
                                    {36, "method = \"harmonic\"\ninertia = true\nsafety = 1"},
                                    {37, "density_scaling = \"250 %\""},
                                    {39, "geometry = \"fixed\"\nprecision = \"mixed\"\nbackend = \"reference\""},
                                    {40, "damping = \"3 1/s\"\ndamping_kind = \"viscous\"\nthreads = 2"}}));
  EXPECT_EQ(scene.specimen.size_law, SizeLaw::volume_uniform);
  EXPECT_FALSE(scene.specimen.fix_aggregates);
  EXPECT_EQ(scene.specimen.attempts, 200'000);
  EXPECT_EQ(scene.specimen.aggregate[0].count, 12);
  EXPECT_EQ(scene.specimen.mastic->porosity, -0.017);
  const auto& maxwell = std::get<laws::GeneralisedKelvin>(*scene.laws[int(PairType::mm)]);
  EXPECT_TRUE(std::isinf(maxwell.C_m));
  EXPECT_EQ(maxwell.units(), 0);
  EXPECT_EQ(scene.network.quadrature, Quadrature::exact);
  EXPECT_EQ(scene.network.gap_max, 0.0);
  EXPECT_EQ(scene.network.area_min, 0.026);
  EXPECT_EQ(scene.network.of_pair[int(PairType::mm)].gap_max, 0.5);
  EXPECT_EQ(scene.network.of_pair[int(PairType::mm)].area_min, 0.0);
  EXPECT_FALSE(scene.network.of_pair[int(PairType::ma)].gap_max);
  EXPECT_TRUE(scene.network.lateral_walls);
  EXPECT_EQ(scene.cyclic().fit_cycles, 3);
  EXPECT_EQ(scene.solver.method, SolverMethod::harmonic);
  EXPECT_EQ(scene.solver.density_scaling, std::vector<double>{2.5});
  EXPECT_EQ(scene.solver.geometry, Geometry::fixed);
  EXPECT_EQ(scene.solver.precision, Precision::mixed);
  EXPECT_EQ(scene.solver.backend, Backend::reference);
  EXPECT_EQ(scene.solver.damping_kind, Damping::viscous);
  EXPECT_EQ(scene.solver.damping, 3.0);
  EXPECT_EQ(scene.solver.threads, 2);
  EXPECT_EQ(read(text_of({{40, "damping = 0.2"}})).solver.damping_kind, Damping::local);
}

TEST_F(SceneFile, UnitsGiveTheDoubleOfTheSILiteral) {
  const auto modulus = [&](const std::string& written) {
    const Scene scene = read(text_of({{25, "E = " + written}, {26, ""}}));
    return std::get<laws::Elastic>(*scene.laws[int(PairType::aw)]).E;
  };
  EXPECT_EQ(modulus("\"35 GPa\""), 35e9);
  EXPECT_EQ(modulus("\"1.151e8kPa\""), 1.151e11);
  EXPECT_EQ(modulus("\" +0.1 MPa \""), 1e5);
  EXPECT_EQ(modulus("\"7 Pa\""), 7.0);
  const auto box = [&](const std::string& written) {
    return read(text_of({{2, "box = [0.02, 0.02, " + written + "]"}})).specimen.box.size.z;
  };
  EXPECT_EQ(box("\"2.9 cm\""), 0.029);
  EXPECT_EQ(box("\"29000 um\""), 0.029);
  EXPECT_EQ(box("\"29000 \u00b5m\""), 0.029);
  EXPECT_EQ(box("\"29E-3 m\""), 0.029);
  EXPECT_EQ(read(text_of({{38, "time_step = \"1e-4 ms\""}})).solver.time_step, 1e-7);
  EXPECT_EQ(read(text_of({{13, "density = \"2.11 t/m\u00b3\""}})).materials.mastic, 2110.0);
}

TEST_F(SceneFile, ASpecimenFileIsTakenFromTheScenesFolder) {
  std::ofstream(folder_ / "particles.csv") << "id,x,y,z,radius,phase,body\n";
  const Edits edits{{3, "file = \"./particles.csv\""}, {4, ""}, {5, ""}, {6, ""}, {7, ""}, {8, ""}, {9, ""}};
  EXPECT_EQ(read(text_of(edits)).specimen.file, folder_ / "particles.csv");
  std::filesystem::remove(folder_ / "particles.csv");
  const std::string what = message(text_of(edits));
  EXPECT_NE(what.find(file().string() + ":3: [specimen] file: found no file "), std::string::npos) << what;
  EXPECT_NE(what.find("particles.csv"), std::string::npos) << what;
}

TEST_F(SceneFile, WindowsLineEndsAndByteOrderMarkAreRead) {
  std::string text = "\xef\xbb\xbf";
  for (const std::string& line : good_scene) text += line + "\r\n";
  EXPECT_EQ(read(text).specimen.seed, 7u);
}

TEST_F(SceneFile, ATextStandsForAFile) {
  const Scene scene = read_scene(file(), text_of());
  EXPECT_FALSE(std::filesystem::exists(file()));
  EXPECT_EQ(scene.file, file());
  EXPECT_EQ(scene.text, text_of());
  EXPECT_EQ(scene.specimen.seed, read(text_of()).specimen.seed);
  for (const int line : {3, 8, 23, 31, 50}) {  // keys of sections of every kind, and entries of arrays
    const Edits wrong{{line, line == 31 ? "frequencies = [2, -5]" : "wrong = 1"}};
    const std::string expected = message(text_of(wrong));
    const std::string place = file().string() + ":" + std::to_string(line);
    ASSERT_TRUE(expected.starts_with(place)) << expected;
    for (const bool lines : {true, false}) {
      try {
        read_scene(file(), text_of(wrong), lines);
        ADD_FAILURE() << line;
      } catch (const InputError& error) {
        EXPECT_EQ(error.what(), lines ? expected : file().string() + expected.substr(place.size()));
      }
    }
  }
}

TEST(RequireLaws, NamesThePairWithItsContactsAndThePhase) {
  Scene scene;
  scene.file = "mix.toml";
  scene.materials = {2630, 0};
  scene.laws[int(PairType::aa)] = laws::Elastic{1e11, 0.05};
  Specimen specimen;
  specimen.phase = {Phase::aggregate, Phase::aggregate};
  ContactNetwork network;
  network.count[int(PairType::aa)] = 1;
  EXPECT_NO_THROW(require_laws(scene, specimen, network));

  const auto message = [&] {
    try {
      require_laws(scene, specimen, network);
    } catch (const InputError& error) { return std::string(error.what()); }
    return std::string();
  };
  network.count[int(PairType::aw)] = 1234;
  EXPECT_EQ(message(),
            "mix.toml: pair A-W: found no law for its 1234 contacts, expected [[contacts]] with pair = \"A-W\"");
  specimen.phase.push_back(Phase::mastic);
  EXPECT_EQ(message(),
            "mix.toml: phase mastic: found no density for its 1 particles, expected [materials.mastic] with a density");
}

}  // namespace
}  // namespace macadam
