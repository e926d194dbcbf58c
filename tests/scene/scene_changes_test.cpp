// SPDX-License-Identifier: GPL-3.0-or-later
// scene_changes_test.cpp  Tests values that a command sets in a scene: the scene that is read, its new text, and
// refused values.
#include "host/scene/scene_changes.hpp"

#include "tests/scene/scene_file.hpp"

namespace macadam::test {
namespace {

using Changes = std::vector<std::string>;

struct SceneChanges : SceneFile {
  Scene changed(const Changes& changes, const std::string& text = text_of()) const {
    std::ofstream(file(), std::ios::binary) << text;
    return read_changed_scene(file(), changes);
  }
  std::string refused(const Changes& changes) const {
    try {
      changed(changes);
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  static std::string text_with(const std::string& text, const Changes& changes) {
    return scene::with_changes(toml::parse(text), text, changes).text;
  }
};

TEST_F(SceneChanges, AreReadAsIfTheyStoodInTheFile) {
  const Scene scene = changed({"solver.damping=0.1", "specimen.seed = 8", "contacts.A-W.delta=3",
                               "contacts.0.alpha=0.2", "loading.frequencies=[1, \"4 Hz\"]",
                               "specimen.mastic.porosity=6 %", "network.gap_max=50 %", "contacts.M-M.E.1=2e9"});
  EXPECT_EQ(scene.solver.damping, 0.1);
  EXPECT_EQ(scene.specimen.seed, 8u);
  EXPECT_EQ(scene.deltas[static_cast<std::size_t>(PairType::aw)], 3);
  const auto& mm = std::get<laws::GeneralisedKelvin>(scene.laws[static_cast<std::size_t>(PairType::mm)].value());
  EXPECT_EQ(mm.alpha, 0.2);
  EXPECT_EQ(mm.E[1], 2e9);
  EXPECT_EQ(frequencies_of(scene.experiment), (std::vector<double>{1, 4}));
  EXPECT_EQ(scene.specimen.mastic->porosity, 0.06);
  EXPECT_EQ(scene.network.gap_max, 0.5);
  EXPECT_EQ(scene.changes.size(), 8u);
  // the text of the scene has the values: without changes it is the same scene
  const Scene again = read_scene(file(), scene.text);
  EXPECT_EQ(again.solver.damping, 0.1);
  EXPECT_EQ(again.specimen.seed, 8u);
  EXPECT_EQ(again.text, scene.text);
}

TEST_F(SceneChanges, NoChangesLeaveTheSceneAsItIs) {
  const Scene scene = changed({});
  EXPECT_EQ(scene.text, text_of());
  EXPECT_TRUE(scene.changes.empty());
}

TEST_F(SceneChanges, ATableReplacesTheSection) {
  const Scene scene = changed({"loading={kind = \"relaxation\", strain = 1e-4, times = [1.0, 10.0]}",
                               "solver={method = \"harmonic\"}", "output={}"});
  EXPECT_STREQ(kind_of(scene.experiment), "relaxation");
  EXPECT_EQ(scene.solver.method, SolverMethod::harmonic);
  EXPECT_FALSE(scene.solver.damping_given);
  EXPECT_FALSE(scene.output.contacts);
}

TEST_F(SceneChanges, TheLaterOfTwoChangesHolds) {
  EXPECT_EQ(changed({"specimen.seed=8", "specimen.seed=9"}).specimen.seed, 9u);
}

TEST_F(SceneChanges, KeepCommentsAndOrderOfTheText) {
  const std::string text =
      "# a mix\n[specimen]  # the box\nbox = [1, 2, 3]\nseed = 1  # any\n\n[loading]\nkind = \"cyclic\" # "
      "é\n[output]\n";
  EXPECT_EQ(text_with(text, {"specimen.seed=2"}),
            "# a mix\n[specimen]  # the box\nbox = [1, 2, 3]\nseed = 2  # any\n\n[loading]\nkind = \"cyclic\" # "
            "é\n[output]\n");
  EXPECT_EQ(text_with("a = { b = 1 }\n", {"a.c=2"}), "a = { c = 2, b = 1 }\n");
  // a key that the section lacks, a section without keys, and a section that the text lacks
  EXPECT_EQ(text_with("[a]\nb = 1\n", {"a.c=x"}), "[a]\nc = \"x\"\nb = 1\n");
  EXPECT_EQ(text_with("[a]\n[b]\nc = 1\n", {"a.c=2"}), "[a]\nc = 2\n[b]\nc = 1\n");
  EXPECT_EQ(text_with("[a]\nb = 1\n", {"c.d=2"}), "[a]\nb = 1\n\n[c]\nd = 2\n");
  EXPECT_EQ(text_with("[a.b]\nc = 1", {"a.d=2"}), "[a.b]\nc = 1\n\n[a]\nd = 2\n");
  EXPECT_EQ(text_with("[a.b]\nc = 1\n[d]\ne = 1 # e\n", {"a={b = 2, f = {g = 1}}"}),
            "[d]\ne = 1 # e\n\n[a]\nb = 2\nf = { g = 1 }\n");
  EXPECT_EQ(
      text_with("[[contacts]]\npair = \"M-M\"\n[[contacts]]\npair = \"M-A\"\n", {"contacts.M-A.crack.friction=0.5"}),
      "[[contacts]]\npair = \"M-M\"\n[[contacts]]\ncrack.friction = 0.5\npair = \"M-A\"\n");
}

TEST_F(SceneChanges, EveryTextHasTheContentOfTheTables) {
  const std::string text = "a.b = 1\n[c]\nd = [\n  1, # one\n  2,\n]\n[[e]]\nf = 1\n[e.g]\nh = 1\n[[e]]\nf = 2\n";
  for (const char* change : {"a.b=2", "a.c=2", "c.d.1=7", "c.d=[]", "e.1.f=3", "e.0.g.h=2", "e.0.g.i=2", "e.1.g.h=2",
                             "e=[{f = 1}]", "e.0={f = 9}", "i.j.k=\"1 = 2\"", "c={}", "a={x = 1}", "\"q r\".s=1"}) {
    const toml::table table = toml::parse(text);
    const scene::ChangedScene found = scene::with_changes(toml::parse(text), text, {change});
    EXPECT_TRUE(toml::parse(found.text) == found.table) << change << "\n" << found.text;
    EXPECT_FALSE(found.table == table) << change;
  }
}

TEST_F(SceneChanges, ErrorsNameTheOptionInPlaceOfTheFile) {
  for (const auto& [change, message] : std::map<std::string, std::string>{
           {"solver.methd=harmonic",
            "--set solver.methd=harmonic: [solver] methd: found an unknown key, expected method (the nearest of "},
           {"solvr.method=harmonic",
            "--set solvr.method=harmonic: [solvr]: found an unknown section, expected solver "},
           {"solver.method=harmnic",
            "--set solver.method=harmnic: [solver] method: found \"harmnic\", expected one of "},
           {"#=1", "--set #=1: TOML syntax: found the key \"#\", expected KEY=VALUE"},
           {"[a]#=1", "--set [a]#=1: TOML syntax: found the key \"[a]#\", expected KEY=VALUE"},
           {"[[contacts]]#=1", "TOML syntax: found the key \"[[contacts]]#\", expected KEY=VALUE"},
           {"specimen.notch.0.at=0.1", "found no list specimen.notch in the scene, expected specimen.notch=[{…}]"},
           {"solver.safety=2", "--set solver.safety=2: [solver] safety: found 2, expected "},
           {"contacts.M-M.E.1=-1", "--set contacts.M-M.E.1=-1: [[contacts]] E, entry 2: found -1, expected "},
           {"contacts.M-M.Em=1", "--set contacts.M-M.Em=1: [[contacts]] Em: found an unknown key, expected E_m "},
           {"contacts.M-X.delta=1",
            "--set contacts.M-X.delta=1: key: found \"M-X\", which the scene does not have, expected "},
           {"specimen.aggregate.1.volume_fraction=0.1",
            "found \"1\", which the scene does not have, expected a number "
            "from 0 to 0"},
           {"specimen.seed.x=1",
            "--set specimen.seed.x=1: key: found a value at \"seed\" in the scene, expected a section "
            "or a list there"},
           {"loading={kind=\"creep\"}", "--set loading={kind=\"creep\"}: [loading] "},
           {"solver.method", "--set solver.method: TOML syntax: found no \"=\", expected KEY=VALUE"},
           {"=1", "--set =1: TOML syntax: found no key, expected KEY=VALUE"},
           {"solver.damping=", "--set solver.damping=: TOML syntax: found no value, expected KEY=VALUE"},
           {"loading.frequencies=[1, 2", "--set loading.frequencies=[1, 2: TOML syntax: found "},
           {"solver..damping=1", "--set solver..damping=1: TOML syntax: found the key \"solver..damping\""},
           {"solver.damping=1\n[output]", "found a control character"}}) {
    EXPECT_NE(refused({change}).find(message), std::string::npos) << refused({change});
  }
  // an error about something else in the file keeps the line of the file
  try {
    changed({"specimen.seed=1"}, text_of({{25, "E = -1"}, {43, "[[contacts]]  # without a pair"}, {44, ""}}));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("scene.toml:25: [[contacts]] E: found -1"), std::string::npos)
        << error.what();
  }
  EXPECT_NE(refused({"loading.frequencies=[1, 2, 3]"}).find("scene.toml:37: "), std::string::npos)
      << refused({"loading.frequencies=[1, 2, 3]"});
}

}  // namespace
}  // namespace macadam::test
