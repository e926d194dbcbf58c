// SPDX-License-Identifier: GPL-3.0-or-later
// run_events.cpp  Writes the stages and results of a run as JSON.
#include "host/cli/scene_commands/run_events.hpp"

#include <nlohmann/json.hpp>

#include "host/cli/terminal/json_lines.hpp"
#include "host/experiments/experiment.hpp"
#include "host/files/result_files.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void print_start_event(const std::vector<std::pair<std::string, std::filesystem::path>>& scenes) {
  if (!json_lines_are_on()) return;
  Json event{{"event", "start"}, {"macadam", version()}, {"scenes", Json::array()}};
  for (const auto& [scene, out] : scenes) event["scenes"].push_back({{"scene", scene}, {"out", out.string()}});
  print_json_line(event);
}

void print_prepared_event(const std::string& scene, const Preparation& prepared) {
  if (!json_lines_are_on()) return;
  Json contacts = Json::object();
  for (int pair = 0; pair < pair_types; ++pair)
    contacts[to_string(static_cast<PairType>(pair))] = prepared.network.count[static_cast<std::size_t>(pair)];
  print_json_line({{"event", "prepared"},
                   {"scene", scene},
                   {"particles", prepared.specimen.size()},
                   {"voids", prepared.specimen.voids.size()},
                   {"contacts", contacts},
                   {"contact_points", prepared.network.point_area.size()},
                   {"loose_particles", prepared.loose_particles},
                   {"specimen_s", prepared.seconds_specimen},
                   {"tessellation_s", prepared.seconds_tessellation},
                   {"network_s", prepared.seconds_network}});
}

void print_planned_event(const std::string& scene, const RunResult& planned) {
  if (!json_lines_are_on()) return;
  Json skips = Json::array();
  for (const Skip& skip : planned.skips)
    skips.push_back({{"what", skip.what}, {"why", skip.why}, {"effect", skip.effect}});
  print_json_line({{"event", "planned"},
                   {"scene", scene},
                   {"backend", to_string(planned.backend)},
                   {"decisions", planned.decisions},
                   {"skips", skips}});
}

void print_result_event(const std::string& scene, const std::filesystem::path& out,
                        const std::vector<std::string>& files, const RunResult& result) {
  if (!json_lines_are_on()) return;
  const Json summary = Json::parse(read_whole(out / "summary.json"));
  print_json_line({{"event", "result"},
                   {"scene", scene},
                   {"out", out.string()},
                   {"files", files},
                   {"warnings", result.warnings},
                   {"results", summary.at("results")},
                   {"solver", summary.at("solver")},
                   {"timing_s", summary.at("timing_s")}});
}

std::vector<std::string> files_left(const Scene& scene, const std::filesystem::path& out) {
  std::vector<std::string> files;
  for (const std::string& name : files_of_run(scene, !scene.specimen.file))
    if (std::filesystem::exists(out / name)) files.push_back(name);
  if (scene.output.fields.any()) files.emplace_back("fields/");
  return files;
}

}  // namespace macadam
