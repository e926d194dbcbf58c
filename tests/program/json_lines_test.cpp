// SPDX-License-Identifier: GPL-3.0-or-later
// json_lines_test.cpp  With --json, every line of standard output is a JSON object whose event and keys are described
// in docs/json.md.
#include "macadam/version.hpp"
#include "tests/support/program.hpp"

namespace macadam::test {
namespace {

using Json = nlohmann::json;

struct JsonLines : Program {
  std::string page_ = read(fs::path(MACADAM_EXAMPLES).parent_path() / "docs/json.md");

  /// Parses every line, and expects that the page describes the event and its keys. The last event of a run is `end`
  /// with the exit code; other commands have a single event.
  std::vector<Json> events_of(const Outcome& outcome, bool run = false) const {
    std::vector<Json> events;
    for (const std::string& line : lines_of(outcome.out)) {
      const Json event = Json::parse(line, nullptr, false);
      EXPECT_TRUE(event.is_object() && event.contains("event")) << line;
      if (!event.is_object() || !event.contains("event")) continue;
      EXPECT_TRUE(contains(page_, "| `" + event["event"].get<std::string>() + "` |")) << line;
      for (const auto& [key, value] : event.items()) EXPECT_TRUE(contains(page_, "`" + key + "`")) << key;
      events.push_back(event);
    }
    EXPECT_FALSE(events.empty()) << outcome.err;
    if (!run) {
      EXPECT_EQ(events.size(), 1u) << outcome.out;
    } else if (!events.empty()) {
      EXPECT_EQ(events.back(), (Json{{"event", "end"}, {"code", outcome.code}}));
    }
    return events;
  }

  static std::vector<Json> all_of(const std::vector<Json>& events, const std::string& kind) {
    std::vector<Json> out;
    for (const Json& event : events)
      if (event["event"] == kind) out.push_back(event);
    return out;
  }
};

TEST_F(JsonLines, InfoIsOneEvent) {
  const Outcome outcome = macadam("info --json");
  const std::vector<Json> events = events_of(outcome);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0]["event"], "info");
  EXPECT_EQ(events[0]["macadam"], version());
  EXPECT_GE(events[0]["threads"], 1);
  EXPECT_TRUE(events[0]["devices"].is_array());
  EXPECT_EQ(macadam("info --json --keys json").code, 2);
}

TEST_F(JsonLines, CheckIsOnePrediction) {
  write_scene();
  const std::vector<Json> events = events_of(macadam("check --json " + path("scene.toml") + " --backend cpu"));
  ASSERT_EQ(events.size(), 1u);
  const Json& forecast = events[0];
  EXPECT_EQ(forecast["event"], "forecast");
  EXPECT_EQ(forecast["scene"], (folder_ / "scene.toml").string());
  EXPECT_EQ(forecast["particles"], 175);
  EXPECT_EQ(forecast["steps"][0]["frequency_hz"], 20.0);
  for (const auto& [key, value] : forecast["steps"][0].items()) EXPECT_TRUE(contains(page_, "`" + key + "`")) << key;
}

TEST_F(JsonLines, ARunReportsItsStagesAndResults) {
  write_scene();
  const Outcome outcome = run_quick("out", "--backend cpu --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<Json> events = events_of(outcome, true);
  std::vector<std::string> kinds;
  for (const Json& event : events)
    if (event["event"] != "progress" && event["event"] != "warning") kinds.push_back(event["event"]);
  EXPECT_EQ(kinds, (std::vector<std::string>{"start", "prepared", "planned", "result", "end"}));
  const std::string scene = (folder_ / "scene.toml").string(), out = (folder_ / "out").string();
  EXPECT_EQ(events.front()["scenes"], (Json{{{"scene", scene}, {"out", out}}}));
  const Json progress = all_of(events, "progress"), result = all_of(events, "result").at(0);
  ASSERT_FALSE(progress.empty());
  for (const Json& event : progress) {
    EXPECT_EQ(event["scene"], scene);
    EXPECT_TRUE(event["fraction"] >= 0 && event["fraction"] <= 1) << event;
  }
  EXPECT_EQ(result["results"], summary("out")["results"]);
  EXPECT_EQ(result["warnings"], summary("out")["warnings"]);
  for (const std::string name : result["files"]) EXPECT_TRUE(fs::exists(fs::path(out) / name)) << name;
  EXPECT_EQ(all_of(events, "prepared").at(0)["particles"], 175);
  // the text for people is on standard error
  EXPECT_TRUE(contains(outcome.err, "175 particles")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "files in ")) << outcome.err;
}

TEST_F(JsonLines, ErrorsNameFileLineAndKey) {
  write_scene("density_scalling = 1e6\n");  // the misspelt key is in line 9 of the scene
  const std::string scene = (folder_ / "scene.toml").string();
  for (const char* command : {"run", "check"}) {
    const std::string out = std::string(command) == "run" ? " --out " + path("out") : "";
    const Outcome outcome = macadam(std::string(command) + " --json " + path("scene.toml") + out);
    EXPECT_EQ(outcome.code, 2);
    const std::vector<Json> errors = all_of(events_of(outcome, !out.empty()), "error");
    ASSERT_EQ(errors.size(), 1u) << outcome.out;
    const Json& error = errors[0];
    EXPECT_EQ(error["kind"], "input");
    EXPECT_EQ(error["file"], scene);
    EXPECT_EQ(error["line"], 9);
    EXPECT_EQ(error["key"], "[solver] density_scalling");
    EXPECT_EQ(error["found"], "an unknown key");
    EXPECT_TRUE(error["expected"].get<std::string>().starts_with("density_scaling (the nearest of ")) << error;
    EXPECT_EQ("macadam: " + error["message"].get<std::string>() + "\n", outcome.err);
  }
  write_scene();
  const Json set =
      all_of(events_of(macadam("check --json " + path("scene.toml") + " --set solver.safety=2")), "error").at(0);
  EXPECT_EQ(set["file"], "--set solver.safety=2");
  EXPECT_TRUE(set["line"].is_null());
  EXPECT_EQ(set["key"], "[solver] safety");
  const Json usage = all_of(events_of(macadam("check --json " + path("scene.toml") + " --fast")), "error").at(0);
  EXPECT_EQ(usage["kind"], "usage");
  EXPECT_TRUE(usage["file"].is_null() && usage["line"].is_null() && usage["key"].is_null()) << usage;
  EXPECT_TRUE(contains(usage["message"], "found \"--fast\"")) << usage;
  // "--json=true" is the same as "--json", and no other value is taken
  EXPECT_EQ(all_of(events_of(macadam("check --json=true " + path("missing.toml"))), "error").size(), 1u);
  EXPECT_EQ(macadam("check --json=false " + path("scene.toml")).code, 2);
}

TEST_F(JsonLines, OfSeveralScenesEachHasItsResultOrItsError) {
  fs::copy_file(write_scene(), folder_ / "a.toml");
  // no contact of this scene is large enough, which is found when its contacts are made
  std::ofstream(folder_ / "b.toml") << read(folder_ / "a.toml") << "[network]\narea_min = 100\n";
  const Outcome outcome =
      macadam("run --json " + path("a.toml") + " " + path("b.toml") + " --out " + path("out") + " --backend cpu");
  const std::vector<Json> events = events_of(outcome, true);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const std::vector<Json> errors = all_of(events, "error"), results = all_of(events, "result");
  ASSERT_EQ(errors.size(), 2u) << outcome.out;
  EXPECT_EQ(errors[0]["scene"], (folder_ / "b.toml").string());
  EXPECT_EQ(errors[0]["file"], (folder_ / "b.toml").string());
  EXPECT_EQ(errors[0]["key"], "contact network");
  EXPECT_EQ(errors[1]["message"], "1 of 2 scenes failed");
  EXPECT_EQ(errors[1]["kind"], "run");
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0]["scene"], (folder_ / "a.toml").string());
  EXPECT_EQ(results[0]["results"], summary("out/a")["results"]);
}

TEST_F(JsonLines, HelpHasNoEvents) {
  const Outcome help = macadam("run --json --help");
  EXPECT_EQ(help.code, 0);
  EXPECT_FALSE(contains(help.out, "\"event\"")) << help.out;
}

}  // namespace
}  // namespace macadam::test
