// SPDX-License-Identifier: GPL-3.0-or-later
// particle_files_test.cpp  Tests the files of `macadam specimen --export` for LAMMPS and OVITO.
#include "host/files/particle_files.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "host/specimen/foreign_packing.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

struct ParticleFiles : Program {
  Outcome specimen(const std::string& options) const {
    return macadam("specimen " + path("scene.toml") + " --out " + path("out") + " " + options);
  }
};

TEST_F(ParticleFiles, HaveTheParticlesAndContactsOfTheSpecimen) {
  write_t8("kind = \"cyclic\"\nfrequencies = [20.0]\n", "", "contacts = true\n");
  ASSERT_EQ(specimen("--export data --export dump --export xyz").code, 0);
  const Specimen t8 = read_specimen_csv(folder_ / "t8.csv", Domain{{0.008, 0.008, 0.011}});

  // the dump, read by another reader of this program, has all digits
  const ForeignPacking dump = read_packing(folder_ / "out/specimen.dump", 1);
  EXPECT_EQ(dump.format, "LAMMPS dump");
  EXPECT_EQ(dump.radius, t8.radius);
  ASSERT_EQ(dump.centre.size(), t8.size());
  for (std::size_t i = 0; i < t8.size(); ++i) EXPECT_EQ(dump.centre[i].z, t8.centre[i].z);

  std::istringstream xyz(read(folder_ / "out/specimen.xyz"));
  std::string line, species;
  std::getline(xyz, line);
  EXPECT_EQ(line, "175");
  std::getline(xyz, line);
  EXPECT_EQ(line,
            "Lattice=\"0.008 0 0 0 0.008 0 0 0 0.011\" Origin=\"0 0 0\" pbc=\"F F F\" "
            "Properties=species:S:1:pos:R:3:radius:R:1:id:I:1:molecule:I:1");
  for (std::size_t i = 0; i < t8.size(); ++i) {
    double x = 0, y = 0, z = 0, r = 0;
    std::int64_t id = 0, molecule = 0;
    ASSERT_TRUE(xyz >> species >> x >> y >> z >> r >> id >> molecule) << i;
    EXPECT_EQ(species, t8.phase[i] == Phase::aggregate ? "aggregate" : "mastic");
    EXPECT_EQ(x, t8.centre[i].x);
    EXPECT_EQ(r, t8.radius[i]);
    EXPECT_EQ(id, std::int64_t(i) + 1);
    EXPECT_EQ(molecule, t8.body[i] + 1);
  }

  // the data file: the header agrees with the sections, and the bonds are the contacts between particles
  const std::vector<std::string> lines = lines_of(read(folder_ / "out/specimen.data"));
  const auto section = [&](const std::string& title) {
    auto at = std::find(lines.begin(), lines.end(), title);
    std::vector<std::string> out;
    if (at == lines.end()) return out;
    for (at += 2; at != lines.end() && !at->empty(); ++at) out.push_back(*at);
    return out;
  };
  const std::vector<std::string> atoms = section("Atoms # bpm/sphere"), bonds = section("Bonds");
  EXPECT_EQ(atoms.size(), t8.size());
  EXPECT_EQ(lines.at(2), "175 atoms");
  EXPECT_EQ(lines.at(3), fmt::format("{} bonds", bonds.size()));
  std::vector<std::string> expected;
  const std::vector<std::string> contacts = lines_of(read(folder_ / "out/contacts.csv"));
  for (std::size_t k = 1; k < contacts.size(); ++k) {
    int a = 0, b = 0;
    char pair[8] = "";
    ASSERT_EQ(std::sscanf(contacts[k].c_str(), "%d,%d,%7[^,]", &a, &b, pair), 3);
    const std::vector<std::string> types{"M-M", "M-A", "A-A", "inner"};
    const auto type = std::find(types.begin(), types.end(), pair);
    if (b >= 0)
      expected.push_back(fmt::format("{} {} {} {}", expected.size() + 1, type - types.begin() + 1, a + 1, b + 1));
  }
  EXPECT_EQ(bonds, expected);
  std::istringstream first(atoms.front());
  double id = 0, molecule = 0, type = 0, diameter = 0, density = 0;
  first >> id >> molecule >> type >> diameter >> density;
  EXPECT_EQ(diameter, 2 * t8.radius[0]);
  EXPECT_EQ(density, t8.phase[0] == Phase::aggregate ? 2630 : 2110);  // of the scene
}

TEST_F(ParticleFiles, AreRemovedWithTheSpecimenThatTheyShow) {
  write_scene();
  ASSERT_EQ(specimen("--export xyz").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/specimen.xyz"));
  EXPECT_FALSE(fs::exists(folder_ / "out/specimen.data"));
  ASSERT_EQ(specimen("").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/specimen.xyz"));
}

TEST_F(ParticleFiles, AnUnknownFormatIsRefusedBeforeAnything) {
  write_scene();
  const Outcome outcome = specimen("--export vtk");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.err, "--export: found \"vtk\", expected one of data|dump|xyz")) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace macadam::test
