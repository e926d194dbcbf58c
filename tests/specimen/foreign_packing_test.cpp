// SPDX-License-Identifier: GPL-3.0-or-later
// foreign_packing_test.cpp  Packings of other programs: their formats, the specimen around them, refused files, and the
// scene that macadam new writes.
#include "host/specimen/foreign_packing.hpp"

#include <map>

#include "macadam/error.hpp"
#include "macadam/scene.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

struct ForeignPackings : Program {
  ForeignPacking packing(const std::string& text, double unit = 1) const {
    std::ofstream(folder_ / "packing.txt", std::ios::binary) << text;
    return read_packing(folder_ / "packing.txt", unit);
  }
};

/// Two spheres in all formats; the second one in the first file's order has twice the radius.
constexpr const char* dump =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\nITEM: ATOMS id x y z "
    "radius\n"
    "1 9 9 9 9\nITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\n"
    "ITEM: ATOMS id type x y z vx radius\n1 1 1 2 3 0.5 1\n2 1 1 2 6 0.5 2\n";

TEST_F(ForeignPackings, OfEveryFormatAreTheSameSpheres) {
  for (const auto& [text, format] : std::map<std::string, std::string>{
           {dump, "LAMMPS dump"},
           {"#format x_y_z_r\n1\t2\t3\t1\n1\t2\t6\t2\n", "text"},
           {"1 2 3 1 7\n\n# a remark\n1 2 6 2 7\n", "text"},
           {"id,x,y,z,diameter\r\n0,1,2,3,2\r\n1,1,2,6,4\r\n", "text with column names"},
           {"\xEF\xBB\xBFRadius; X; Y; Z\n1; 1; 2; 3\n2; 1; 2; 6\n", "text with column names"},
           {"# x y z r\n1 2 3 1\n1 2 6 2\n", "text with column names"}}) {
    const ForeignPacking found = packing(text, 1e-3);
    EXPECT_EQ(found.format, format) << text;
    ASSERT_EQ(found.radius.size(), 2u) << text;
    // products with the unit 1e-3, which the same product gives here
    EXPECT_EQ(found.radius, (std::vector<double>{1 * 1e-3, 2 * 1e-3})) << text;
    EXPECT_EQ(found.centre[1].x, 1 * 1e-3);
    EXPECT_EQ(found.centre[1].y, 2 * 1e-3);
    EXPECT_EQ(found.centre[1].z, 6 * 1e-3);
  }
}

TEST_F(ForeignPackings, TheSpecimenIsTheSmallestBoxOrCylinderAroundTheSpheres) {
  // numbers of few binary digits, so that all sums are exact
  const ForeignPacking found = packing("1 2 3 1\n1 2 6 2\n-3 2 3 0.5\n");
  const Specimen box = specimen_of(found, false, "packing");
  EXPECT_TRUE(box.box.is_box());
  EXPECT_EQ(box.box.size.x, 6.5);  // from −3.5 to 3
  EXPECT_EQ(box.box.size.y, 4);    // from 0 to 4
  EXPECT_EQ(box.box.size.z, 6);    // from 2 to 8
  EXPECT_EQ(box.centre[0].x, 4.5);
  EXPECT_EQ(box.centre[0].y, 2);
  EXPECT_EQ(box.centre[0].z, 1);
  EXPECT_EQ(box.phase, std::vector<Phase>(3, Phase::mastic));
  EXPECT_EQ(box.body, std::vector<std::int32_t>(3, -1));
  const Specimen round = specimen_of(found, true, "packing");
  EXPECT_STREQ(round.box.name(), "cylinder");
  // the axis is at x = −0.25; the farthest points are 1.25 + 2 and 2.75 + 0.5 from it
  EXPECT_EQ(round.box.size.x, 6.5);
  EXPECT_EQ(round.box.size.z, 6);
  EXPECT_EQ(round.centre[0].y, 3.25);
}

TEST_F(ForeignPackings, WrongFilesAreRefusedAtTheirLine) {
  for (const auto& [text, message] : std::map<std::string, std::string>{
           {"1 2 3 1\n1 2 x 2\n", ":2: z: found \"x\", expected a number"},
           {"1 2 3 1\n1 2 inf 2\n", ":2: z: found \"inf\", expected a number"},
           {"x;y;z;radius\n0,1;0,2;0,3;0,05\n",
            ":2: columns: found 8, expected 4 as names, numbers with decimal points"},
           {"x,y,z,radius,mat\n,1,0,0.5,1\n", ":2: columns: found 4, expected 5 as names"},
           {"0,1;0,2;0,3;0,05\n", ":1: numbers: found \"0,1;0,2;0,3;0,05\", expected decimal points"},
           {"1 2 3 0\n", ":1: radius: found 0, expected a positive number"},
           {"1 2 3\n", ":1: radius: found 3 columns, expected one more column"},
           {"a,b,c\n1,2,3\n", ":1: columns: found \"a\", expected the names x, y, z and radius"},
           {"1 2 3 1\nend\n", ":2: x: found \"end\", expected a number"},
           {"", ": spheres: found none, expected rows with x, y, z and a radius"},
           {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id x y z radius\n1 0 0 0 1\n",
            ":6: spheres of the last snapshot: found 1, expected 2 as the dump says"},
           {"ITEM: TIMESTEP\n0\nITEM: ATOMS id xs ys zs radius\n",
            ":3: columns of the dump: found \"id xs ys zs radius\""}}) {
    try {
      packing(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) { EXPECT_TRUE(contains(error.what(), message)) << error.what(); }
  }
  EXPECT_THROW(read_packing(folder_ / "none.txt", 1), InputError);
}

TEST_F(ForeignPackings, ANewSceneOfAPackingRuns) {
  // a cubic packing of 3 x 3 x 4 touching spheres, in millimetres
  std::ofstream file(folder_ / "packing.csv");
  file << "x,y,z,r\n";
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) file << 10 + i << ',' << j << ',' << k - 20 << ",0.5\n";
  file.close();
  const std::string options = " --kind packing --packing " + path("packing.csv") + " --unit mm ";
  const Outcome made = macadam("new" + options + path("mix.toml"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(contains(made.out, "36 spheres with radii from 0.0005 to 0.0005 m")) << made.out;
  const Scene scene = read_scene(folder_ / "mix.toml");
  EXPECT_NEAR(scene.specimen.box.size.x, 0.003, 1e-15);  // rounding of a few operations on numbers below 0.02
  EXPECT_NEAR(scene.specimen.box.size.z, 0.004, 1e-15);
  EXPECT_TRUE(contains(read(folder_ / "mix.toml"), "gap_max = 0.1 keeps")) << read(folder_ / "mix.toml");
  ASSERT_EQ(macadam("run " + path("mix.toml") + " --out " + path("out") + " --backend cpu").code, 0);
  EXPECT_EQ(summary("out")["particles"], 36);
  EXPECT_GT(summary("out")["results"][0]["e_star_pa"], 0);
  // nothing is replaced
  EXPECT_EQ(macadam("new" + options + path("mix.toml")).code, 2);
  fs::remove(folder_ / "mix.toml");
  EXPECT_TRUE(contains(macadam("new" + options + path("mix.toml")).err, "mix.csv: scene: found an existing file"));
  const Outcome round = macadam("new --cylinder" + options + path("round.toml"));
  ASSERT_EQ(round.code, 0) << round.err;
  EXPECT_STREQ(read_scene(folder_ / "round.toml").specimen.box.name(), "cylinder");
}

TEST_F(ForeignPackings, OptionsOfPackingsNeedTheKind) {
  EXPECT_TRUE(
      contains(macadam("new --kind packing " + path("a.toml")).err, "--packing: found nothing, expected a file"));
  EXPECT_TRUE(contains(macadam("new --kind packing --packing x --test indirect_tension " + path("a.toml")).err,
                       "--test: found indirect_tension with --kind packing"));
  for (const std::string test : {"bending", "torsion"})
    EXPECT_TRUE(contains(macadam("new --kind packing --packing x --test " + test + " " + path("a.toml")).err,
                         "--test: found " + test + " with --kind packing"));
  EXPECT_TRUE(contains(macadam("new --kind packing --packing x --test semicircular_bending " + path("a.toml")).err,
                       "--test: found semicircular_bending with --kind packing"));
  EXPECT_TRUE(contains(macadam("new --kind packing --packing x --test three_point_bending " + path("a.toml")).err,
                       "--test: found three_point_bending with --kind packing"));
  EXPECT_TRUE(contains(macadam("new --packing x " + path("a.toml")).err, "expected --kind packing as well"));
  EXPECT_TRUE(
      contains(macadam("new --unit mm " + path("a.toml")).err, "--unit: found this option without --kind packing"));
  std::ofstream(folder_ / "p.txt") << "1 2 3 1\n";
  EXPECT_TRUE(contains(macadam("new --kind packing --packing " + path("p.txt") + " --unit kg " + path("a.toml")).err,
                       "--unit: found \"kg\", expected a unit of length"));
  EXPECT_FALSE(fs::exists(folder_ / "a.toml"));
}

}  // namespace
}  // namespace macadam::test
