// SPDX-License-Identifier: GPL-3.0-or-later
// shapes_command_test.cpp  Runs `macadam shapes` as a user does, and checks files, tables, exit codes and messages.
#include <gtest/gtest.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/support/test_files.hpp"
#include "tests/support/test_surfaces.hpp"

namespace macadam::test {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct Outcome {
  int code = -1;
  std::string out, err;
};

class ShapesCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        fmt::format("macadam_shapes_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
    fs::create_directories(folder_ / "stones");
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Runs the program in the test's folder.
  Outcome shapes(const std::string& arguments) const {
    const int status = std::system(fmt::format("cd '{}' && '{}' shapes {} >out.txt 2>err.txt </dev/null",
                                               folder_.string(), MACADAM_PROGRAM, arguments)
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(folder_ / "out.txt"), read(folder_ / "err.txt")};
  }

  void stone(const std::string& name, const Surface& s) const { write_surface(folder_ / "stones" / name, s); }

  static Surface open_box() {
    Surface s = box_surface(1, 2, 3);
    s.facets.pop_back();
    return s;
  }

  fs::path folder_;
};

TEST_F(ShapesCommand, MeasuresAFolderIntoTables) {
  stone("b.off", box_surface(6, 4, 3));
  stone("a.stl", box_surface(1, 1, 2));
  stone("c.ply", mapped(icosphere(1), [](const Vec3d& p) { return 1.5 * p; }));
  std::ofstream(folder_ / "stones" / "notes.txt") << "not a surface";
  const Outcome outcome = shapes("measure stones --out tables --scale 1e-3");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"D^L", "psi^A", "Pearson", "shapes by sieve (mm): 1/2 1 2/4 1 6.3/10 1\n", "shapes.csv"}) {
    EXPECT_TRUE(contains(outcome.out, word)) << word << "\n" << outcome.out;
  }
  std::istringstream csv(read(folder_ / "tables" / "shapes.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[1].rfind("a,8,12,0.00244", 0), 0u) << lines[1];  // sorted by name, in metres
  EXPECT_EQ(lines[2].rfind("b,8,12,0.00781", 0), 0u) << lines[2];
  EXPECT_TRUE(lines[2].ends_with(",0.0063,0.01")) << lines[2];
  EXPECT_EQ(lines[3].rfind("c,42,80,0.00", 0), 0u) << lines[3];
  EXPECT_TRUE(contains(read(folder_ / "tables" / "statistics.csv"), "\npoints,3,8,19.333333333333332,42,25,167,411\n"));
  EXPECT_TRUE(contains(read(folder_ / "tables" / "correlation.csv"), "property,d_long_m,"));
  EXPECT_FALSE(contains(outcome.out, "--scale")) << "no warning of millimetres";
  EXPECT_TRUE(contains(shapes("measure stones/b.off --out tables").out, "--scale 1e-3"));
}

/// One message names all faulty shapes of a folder. With --repair the command measures the shapes that it can repair.
TEST_F(ShapesCommand, FaultyShapesAreNamedAllAtOnceAndRepairedWhenAsked) {
  stone("good.off", tetrahedron());
  stone("open.off", open_box());
  std::ofstream(folder_ / "stones" / "text.obj") << "lorem ipsum";
  const Outcome refused = shapes("measure stones --out tables");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "2 of 3 files have faults")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "stones/open.off: surface: found open at 3 facets")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "stones/text.obj:1: keyword: found")) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "tables"));
  fs::remove(folder_ / "stones" / "text.obj");
  const Outcome repaired = shapes("measure stones --out tables --repair");
  EXPECT_EQ(repaired.code, 0) << repaired.err;
  EXPECT_TRUE(contains(repaired.out,
                       "stones/open.off: repaired: filled 1 hole with 1 facet, 14 % of the area; volume 6 m3 "
                       "(before 6, +0.00 %), area 22 m2 (before 22, +0.00 %)\n"))
      << repaired.out;
  std::ofstream(folder_ / "stones" / "line.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n";
  std::ofstream(folder_ / "stones" / "text.obj") << "lorem ipsum";
  const Outcome hopeless = shapes("measure stones --out tables --repair");
  EXPECT_EQ(hopeless.code, 2);
  for (const char* words : {"2 of 4 files", "line.off: cannot be repaired", "text.obj:1: keyword: found"})
    EXPECT_TRUE(contains(hopeless.err, words)) << hopeless.err;
}

TEST_F(ShapesCommand, CheckGivesAVerdictForEach) {
  stone("good.off", tetrahedron());
  const Outcome good = shapes("check stones/good.off");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_EQ(good.out, "stones/good.off: closed\n");
  stone("open.off", open_box());
  const Outcome faulty = shapes("check stones/open.off stones/good.off");
  EXPECT_EQ(faulty.code, 2);
  EXPECT_TRUE(contains(faulty.out, "stones/open.off: open at 3 facets (")) << faulty.out;
  EXPECT_TRUE(contains(faulty.out, "stones/good.off: closed\n")) << faulty.out;
  EXPECT_TRUE(contains(faulty.err, "1 of 2 surfaces")) << faulty.err;
  const Outcome missing = shapes("check stones/good.off nowhere.off");
  EXPECT_EQ(missing.code, 2);
  EXPECT_TRUE(contains(missing.out, "stones/good.off: closed\n")) << missing.out;
  EXPECT_TRUE(contains(missing.err, "nowhere.off: surface: found No such file")) << missing.err;
}

TEST_F(ShapesCommand, RepairWritesTheFormatThatTheEndingAsksFor) {
  stone("open.off", open_box());
  const Outcome outcome = shapes("repair stones/open.off --out closed.ply");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "filled 1 hole")) << outcome.out;
  EXPECT_NEAR(measure_shape(read_surface(folder_ / "closed.ply")).volume, 6, 1e-12);
  EXPECT_EQ(shapes("repair stones/open.off --out closed.step").code, 2);
  std::ofstream(folder_ / "line.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n";
  const Outcome hopeless = shapes("repair line.off --out closed.off");
  EXPECT_EQ(hopeless.code, 1);
  EXPECT_TRUE(contains(hopeless.err, "line.off: cannot be repaired")) << hopeless.err;
  EXPECT_FALSE(fs::exists(folder_ / "closed.off"));
}

/// Two overlapping boxes can only be repaired by wrapping, which changes their volume. Without --wrap this is refused,
/// and no file is written.
TEST_F(ShapesCommand, WrapsOnlyWhenAsked) {
  stone("two.off", joined(box_surface(1, 1, 1), moved(box_surface(1, 1, 1), {0.5, 0.01, 0.02})));
  const Outcome refused = shapes("repair stones/two.off --out one.off");
  EXPECT_EQ(refused.code, 1) << refused.out;
  EXPECT_TRUE(contains(refused.err, "stones/two.off: the repair changes volume or area by more than 1 %"))
      << refused.err;
  EXPECT_TRUE(contains(refused.err, "--wrap")) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "one.off"));
  const Outcome done = shapes("repair stones/two.off --out one.off --wrap");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "wrapped") && contains(done.out, "(before 2, -2")) << done.out;
  EXPECT_NEAR(measure_shape(read_surface(folder_ / "one.off")).volume, 1.5, 0.05);
  EXPECT_EQ(shapes("measure stones --out tables --repair").code, 2);
  EXPECT_EQ(shapes("measure stones --out tables --wrap").code, 2);  // --wrap has no meaning without --repair
  EXPECT_EQ(shapes("measure stones --out tables --repair --wrap").code, 0);
}

/// All commands read files in the same way and report changes that reading made.
TEST_F(ShapesCommand, WhatReadingChangedIsSaid) {
  std::ofstream(folder_ / "stones" / "cube.obj")
      << "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string said = "on reading: cut 6 polygons into triangles\n";
  const Outcome checked = shapes("check stones");
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(checked.out, "stones/cube.obj: closed; " + said);
  for (const char* command : {"measure stones --out tables", "repair stones/cube.obj --out cube.off",
                              "fill stones/cube.obj --radius 0.3 --out filled"}) {
    const Outcome outcome = shapes(command);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "stones/cube.obj: " + said)) << outcome.out;
  }
  EXPECT_TRUE(contains(read(folder_ / "tables" / "shapes.csv"), ",8,24,")) << read(folder_ / "tables" / "shapes.csv");
}

TEST_F(ShapesCommand, FillWritesSpheresAndSaysHowWellTheyFit) {
  stone("ball.off", subdivided_icosahedron(3));  // in millimetres
  const std::string fill = "fill stones/ball.off --out spheres --scale 1e-3 --radius ";
  const Outcome done = shapes(fill + "'1.5 mm,2 mm' --circumscribed '6.295 mm' --seed 3");
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string csv = read(folder_ / "spheres" / "spheres.csv");
  const auto spheres = static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n') - 1);
  EXPECT_GT(spheres, 24u);  // the shape holds 24 spheres if all have a radius of 2 mm
  EXPECT_EQ(csv.rfind("x,y,z,radius\n", 0), 0u);
  EXPECT_TRUE(contains(done.out, fmt::format("ball: {} spheres of 1.5", spheres))) << done.out;
  for (const char* word : {"D^L", "cover", "overlap", "deviation"}) EXPECT_TRUE(contains(done.out, word)) << done.out;
  EXPECT_EQ(read_surface(folder_ / "spheres" / "spheres.obj").points.size(), 42 * spheres);
  const Surface shape = read_surface(folder_ / "spheres" / "shape.obj");
  EXPECT_NEAR(measure_shape(shape).d_intermediate, 2 * 6.295e-3, 1e-12);

  const std::pair<const char*, const char*> wrong[] = {{"2mile", "2mile"},
                                                       {"1e-9", "at most 100000"},
                                                       {"2e-3,1e-3", "radius_max"},
                                                       {"2e-3 --porosity 2", "porosity"},
                                                       {"2e-3 --circumscribed=-1", "--circumscribed"},
                                                       {"2e-3 --single round", "--single"}};
  for (const auto& [arguments, word] : wrong) {
    const Outcome failed = shapes(fill + arguments);
    EXPECT_EQ(failed.code, 2) << arguments;
    EXPECT_TRUE(contains(failed.out + failed.err, word)) << failed.out << failed.err;
  }
}

TEST_F(ShapesCommand, GenerateMixesNoTwoLibraries) {
  const std::string three = "generate --out library --count 3 --seed 2";
  EXPECT_EQ(shapes(three).code, 0);
  const Outcome again = shapes(three);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(again.out.ends_with("library: aggregate_01.off … aggregate_03.off\n")) << again.out;
  const Outcome fewer = shapes("generate --out library --count 2 --seed 2");
  EXPECT_EQ(fewer.code, 2);
  EXPECT_TRUE(contains(fewer.err, "aggregate_03.off")) << fewer.err;
  const Outcome one = shapes("generate --out ball --icosahedron 0.005");
  EXPECT_TRUE(one.out.ends_with("ball: icosahedron.off\n")) << one.out;
}

TEST_F(ShapesCommand, WrongUsageIsExitCodeTwo) {
  stone("good.off", tetrahedron());
  fs::create_directories(folder_ / "nothing");
  for (const char* arguments :
       {"", "weigh", "measure", "measure stones", "measure stones --out x --scale 0",
        "measure stones --out x --scale mm", "measure nothing --out x", "measure nowhere --out x", "check",
        "check nothing", "repair stones/good.off", "repair stones --out x.off"}) {
    const Outcome outcome = shapes(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  for (const std::string command :
       {"measure stones --out x --scale ", "fill stones/good.off --out x --radius 0.1 --scale "}) {
    for (const char* scale : {"0", "-1", "nan"}) {
      const Outcome outcome = shapes(command + scale);
      EXPECT_EQ(outcome.code, 2) << command << scale;
      EXPECT_TRUE(contains(outcome.err, "--scale")) << outcome.err;
    }
  }
  for (const char* arguments : {"--help", "measure --help", "check --help", "repair --help"}) {
    EXPECT_EQ(shapes(arguments).code, 0) << arguments;
  }
}

TEST_F(ShapesCommand, UnwritableTablesAreExitCodeOne) {
  stone("good.off", tetrahedron());
  std::ofstream(folder_ / "taken") << "a file";
  EXPECT_EQ(shapes("measure stones --out taken").code, 1);
}

}  // namespace
}  // namespace macadam::test
