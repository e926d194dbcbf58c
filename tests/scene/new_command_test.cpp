// SPDX-License-Identifier: GPL-3.0-or-later
// new_command_test.cpp  Tests macadam new: every scene that it writes can be read and run, and so can every key in its
// comments.
#include <regex>
#include <set>

#include "host/scene/new_scene.hpp"
#include "macadam/error.hpp"
#include "macadam/scene.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using scene::NewKind;

struct NewCommand : Program {
  /// Returns the text of a new scene. The folder has t8 as specimen.csv.
  std::string scene_text(NewKind kind, const std::string& test) const {
    fs::copy_file(folder_ / "t8.csv", folder_ / "specimen.csv", fs::copy_options::skip_existing);
    return scene::new_scene(kind, test);
  }
  Scene read_text(const std::string& text) const { return read_scene(folder_ / "scene.toml", text); }
};

constexpr std::array kinds{NewKind::recipe, NewKind::spheres, NewKind::shapes, NewKind::file};
constexpr std::array names{"recipe", "spheres", "shapes", "file"};

std::string replaced(const std::string& text, const std::string& what, const std::string& by) {
  EXPECT_TRUE(contains(text, what)) << what;
  std::string out = text;
  if (const auto at = out.find(what); at != std::string::npos) out.replace(at, what.size(), by);
  return out;
}

TEST_F(NewCommand, EverySceneIsRead) {
  ASSERT_GE(scene::tests_of_new_scenes().size(), 5u);
  for (const NewKind kind : kinds)
    for (const std::string& test : scene::tests_of_new_scenes()) {
      const std::string text = scene_text(kind, test);
      EXPECT_EQ(kind_of(read_text(text).experiment), test);
      for (const std::string& line : lines_of(text)) EXPECT_LE(line.size(), 120u) << line;
    }
}

// If the # is removed from a comment that shows a key with its default value, the scene keeps its meaning. A comment on
// a key without a fixed default states that it has none.
TEST_F(NewCommand, EveryKeyInACommentCanBeTakenOut) {
  const std::regex key("^# ([A-Za-z0-9_]+ = )(.*)$");
  for (const NewKind kind : kinds) {
    for (const std::string& test : scene::tests_of_new_scenes()) {
      const std::vector<std::string> lines = lines_of(scene_text(kind, test));
      std::size_t taken = 0;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (!std::regex_match(lines[i], match, key) || match[2].str().starts_with("...")) continue;
        std::string text;
        for (std::size_t j = 0; j < lines.size(); ++j) text += (i == j ? lines[j].substr(2) : lines[j]) + "\n";
        ++taken;
        try {
          read_text(text);
        } catch (const InputError& error) {
          ADD_FAILURE() << names[static_cast<std::size_t>(kind)] << ", " << test << ": " << lines[i] << "\n"
                        << error.what();
        }
      }
      EXPECT_GE(taken, 9u);
    }
  }
}

TEST_F(NewCommand, KeysAreExplainedWhereTheirSectionComesFirst) {
  for (const NewKind kind : kinds) {
    std::set<std::string> sections;
    bool first = true;
    std::size_t again = 0;
    for (const std::string& line : lines_of(scene_text(kind, "cyclic"))) {
      if (line.starts_with('[')) first = sections.insert(line).second;
      // a comment on its own line belongs to the whole section
      if (first || line.empty() || line.starts_with('#')) continue;
      EXPECT_FALSE(contains(line, "#")) << line;
      ++again;
    }
    EXPECT_GE(again, 15u);  // keys of the sections [[contacts]] after the first one
  }
}

// A comment behind or above every key explains it. This includes keys that only this kind of loading or this law has.
TEST_F(NewCommand, KeysOfTheTestAndOfTheLawAreExplained) {
  for (const std::string& test : scene::tests_of_new_scenes()) {
    std::set<std::string> sections;
    std::string before;
    bool explained = false;
    std::size_t keys = 0;
    for (const std::string& line : lines_of(scene_text(NewKind::spheres, test))) {
      if (line.starts_with('['))
        explained = (line == "[loading]" || line == "[[contacts]]") && sections.insert(line).second;
      else if (explained && !line.empty() && !line.starts_with('#')) {
        EXPECT_TRUE(contains(line, "# ") || before.starts_with("# ")) << test << ": " << line;
        ++keys;
      }
      before = line;
    }
    EXPECT_GE(keys, 10u) << test;
  }
}

TEST_F(NewCommand, WritesWhatItSaysAndReplacesNothing) {
  const Outcome first = macadam("new --kind spheres --test sweep " + path("mix.toml"));
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(contains(first.out, "macadam run ")) << first.out;
  EXPECT_EQ(read(folder_ / "mix.toml"), scene::new_scene(NewKind::spheres, "sweep"));
  const Outcome second = macadam("new " + path("mix.toml"));
  EXPECT_EQ(second.code, 2);
  EXPECT_TRUE(contains(second.err, "an existing file")) << second.err;
  EXPECT_EQ(read(folder_ / "mix.toml"), scene::new_scene(NewKind::spheres, "sweep"));
  EXPECT_EQ(macadam("new " + path("nowhere/mix.toml")).code, 1);
}

// Pairs of particles have cracks, walls have none; the scene is a strength test that is stepped.
TEST_F(NewCommand, CracksAreForStrengthTests) {
  fs::copy_file(folder_ / "t8.csv", folder_ / "specimen.csv");
  for (const NewKind kind : kinds) {
    const std::string text = scene::new_scene(kind, "monotonic", ContactRule::centres, true);
    const Scene made = read_text(text);
    const FactsTable laws = facts_of(made.laws);
    for (const PairType pair : {PairType::mm, PairType::ma, PairType::aa})
      EXPECT_TRUE(laws[static_cast<std::size_t>(pair)]->cracks) << to_string(pair);
    for (const PairType pair : {PairType::aw, PairType::mw})
      EXPECT_FALSE(laws[static_cast<std::size_t>(pair)]->cracks) << to_string(pair);
    EXPECT_EQ(made.solver.method, SolverMethod::explicit_);
    for (const std::string& line : lines_of(text)) EXPECT_LE(line.size(), 120u) << line;
  }
  EXPECT_TRUE(contains(macadam("new --cracks " + path("mix.toml")).err, "expected --test monotonic"));
  EXPECT_TRUE(
      contains(macadam("new --cracks --test monotonic --rule series " + path("mix.toml")).err, "--rule centres"));
}

TEST_F(NewCommand, EveryKindRuns) {
  for (const NewKind kind : kinds) {
    std::string text = scene_text(kind, "cyclic");
    if (kind == NewKind::file) text = replaced(text, "[\"20 mm\", \"20 mm\", \"30 mm\"]", "[0.008, 0.008, 0.011]");
    // 82 packed shapes take seconds; shaped_specimen_test tests them
    if (kind == NewKind::shapes) text = replaced(text, "library = \"aggregates\"", "library = \"icosahedron\"");
    write(folder_ / "mix.toml", text);
    const Outcome outcome = macadam("run " + path("mix.toml") + " --backend cpu --out " + path("out"));
    EXPECT_EQ(outcome.code, 0) << names[static_cast<std::size_t>(kind)] << outcome.err;
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(NewCommand, EveryTestRuns) {
  for (const std::string& test : scene::tests_of_new_scenes()) {
    const bool is_bent_beam = test == "three_point_bending", is_half_disc = test == "semicircular_bending";
    const bool is_disc = test.starts_with("indirect_"), is_beam = test == "bending" || is_bent_beam;
    const bool is_cylinder = test == "torsion";
    const bool is_box = !is_disc && !is_beam && !is_half_disc && !is_cylinder;  // as the file's specimen is
    std::string text = scene_text(is_box ? NewKind::file : NewKind::spheres, test);
    if (is_beam)
      text = replaced(replaced(replaced(text, "\"120 mm\"", "0.06"), "width = \"20 mm\"", "width = 0.012"),
                      "height = \"20 mm\"", "height = 0.012");
    else if (is_cylinder)
      text = replaced(replaced(text, "\"24 mm\"", "0.012"), "height = \"40 mm\"", "height = 0.02");
    else if (is_half_disc)
      text =
          replaced(replaced(replaced(replaced(text, "\"60 mm\"", "0.04"), "thickness = \"20 mm\"", "thickness = 0.012"),
                            "at = \"30 mm\"", "at = 0.02"),
                   "\"6 mm\"", "0.004");
    else if (is_disc)
      text = replaced(replaced(text, "\"60 mm\"", "0.024"), "thickness = \"20 mm\"", "thickness = 0.012");
    else
      text = replaced(text, "[\"20 mm\", \"20 mm\", \"30 mm\"]", "[0.008, 0.008, 0.011]");
    if (test == "indirect_tensile_strength")
      text =
          replaced(replaced(text, "displacement = \"0.4 mm\"", "displacement = 5e-6"), "points = 100", "points = 10");
    if (is_half_disc)
      text =
          replaced(replaced(text, "displacement = \"0.3 mm\"", "displacement = 5e-6"), "points = 100", "points = 10");
    if (is_bent_beam) {
      text = replaced(replaced(text, "at = \"60 mm\"", "at = 0.03"), "\"6 mm\"", "0.004");
      text =
          replaced(replaced(text, "displacement = \"0.5 mm\"", "displacement = 5e-6"), "points = 100", "points = 10");
    }
    if (test == "cooling") text = replaced(text, "to = \"-30 degC\"", "to = \"10 degC\"");
    write(folder_ / "mix.toml", text);
    const Outcome outcome = macadam("run " + path("mix.toml") + " --backend cpu --out " + path("out"));
    EXPECT_EQ(outcome.code, 0) << test << outcome.err;
    fs::remove_all(folder_ / "out");
  }
}

}  // namespace
}  // namespace macadam::test
