// SPDX-License-Identifier: GPL-3.0-or-later
// files_page_test.cpp  docs/output-files.md lists the columns of every table that the program writes.
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

struct FilesPage : Program {
  std::string page_ = read(fs::path(MACADAM_EXAMPLES).parent_path() / "docs/output-files.md");

  /// Expects that the columns of all tables in a folder are on the page; returns the number of tables.
  int expect_columns(const std::string& folder) const {
    int tables = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
      if (entry.path().extension() != ".csv") continue;
      ++tables;
      std::string columns;
      for (const std::string& line : lines_of(read(entry.path()))) {
        columns = line;
        if (!line.starts_with('#')) break;
      }
      const std::string name = entry.path().filename().string();
      if (name == "shapes.csv" || name == "correlation.csv") {
        EXPECT_TRUE(columns.find("volume_m3") != std::string::npos || name != "shapes.csv") << columns;
        continue;
      }
      EXPECT_TRUE(contains(page_, "`" + columns + "`")) << name << ": " << columns;
      EXPECT_TRUE(contains(page_, "`" + name + "`") || name.starts_with("section_")) << name;
    }
    return tables;
  }
};

TEST_F(FilesPage, HasTheColumnsOfRuns) {
  const std::string options = " --backend cpu --out ";
  for (const auto& [loading, tables] :
       std::vector<std::pair<std::string, int>>{{"kind = \"cyclic\"\nfrequencies = [20.0]\ncycles = 1\n", 3},
                                                {"kind = \"sweep\"\nfrequencies = [20.0]\n", 3},
                                                {"kind = \"relaxation\"\ntimes = [1.0]\n", 5},
                                                {"kind = \"creep\"\nstress = 1e5\ntimes = [1.0]\n", 5},
                                                {"kind = \"monotonic\"\nrate = 1e-4\nstrain = 1e-4\n", 5}}) {
    const bool cyclic = contains(loading, "cyclic");
    write_t8(loading, cyclic ? quick : "", "contacts = true\n");
    const Outcome outcome = macadam("run " + path("scene.toml") + options + path("out"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(expect_columns("out"), tables) << loading;
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(FilesPage, HasTheColumnsOfSpecimensAndShapes) {
  const std::string examples = MACADAM_EXAMPLES;
  write_scene();
  ASSERT_EQ(macadam("specimen " + path("scene.toml") + " --section z=0.005 --out " + path("specimen")).code, 0);
  EXPECT_EQ(expect_columns("specimen"), 2);
  ASSERT_EQ(macadam("new " + path("mix.toml")).code, 0);
  ASSERT_EQ(macadam("specimen " + path("mix.toml") + " --out " + path("mix")).code, 0);
  EXPECT_EQ(expect_columns("mix"), 3);  // specimen, aggregates, gradation
  ASSERT_EQ(macadam("shapes measure " + examples + "/icosahedron --out " + path("measured")).code, 0);
  EXPECT_EQ(expect_columns("measured"), 3);
  ASSERT_EQ(
      macadam("shapes fill " + examples + "/icosahedron/icosahedron.off --radius 0.2,0.3 --out " + path("filled")).code,
      0);
  EXPECT_EQ(expect_columns("filled"), 1);
}

}  // namespace
}  // namespace macadam::test
