// SPDX-License-Identifier: GPL-3.0-or-later
// info_command.cpp  Implements `macadam info`, which prints the version, backends and devices, or every key of a scene.
#include "host/cli/scene_commands/info_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/json_lines.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/scene/keys_page.hpp"
#include "host/backends/rank_device.hpp"
#include "macadam/macadam.hpp"

namespace macadam {
namespace {

enum class Keys : std::uint8_t { markdown, json };

void info_command() {
  const BackendReport report = report_backends();
  say("macadam {}\n", version());
  say("cpu        yes, {} threads, compiled for {}\n", report.threads, report.processor);
  say("reference  yes, only for checks: one contact point after the other, double precision, one thread\n");
  say("cuda       {}: {}\n", report.devices.empty() ? "no" : "yes", report.cuda_status);
  const auto list = [](const std::vector<DeviceInfo>& devices, const char* remark) {
    for (const DeviceInfo& d : devices) {
      say("           device {}: {}, compute capability {}.{}, {} multiprocessors, {:.1f} GiB{}\n", d.number, d.name,
          d.compute_capability / 10, d.compute_capability % 10, d.multiprocessors,
          static_cast<double>(d.memory_bytes) / (1 << 30), remark);
    }
  };
  list(report.devices, "");
  list(report.devices_without_code, "; this build has no code for it");
  const std::string alone = why_no_ranks();
  say("ranks      {}\n",
      alone.empty() ? "yes: mpirun can start one process per device, with run --ranks" : "no: " + alone);
  std::string reason;
  const Backend chosen = select_backend(Backend::automatic, &reason);
  say("auto       {} ({})\n", to_string(chosen), reason);
}

nlohmann::ordered_json devices_json(const std::vector<DeviceInfo>& devices) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const DeviceInfo& d : devices)
    out.push_back({{"number", d.number},
                   {"name", d.name},
                   {"compute_capability", fmt::format("{}.{}", d.compute_capability / 10, d.compute_capability % 10)},
                   {"multiprocessors", d.multiprocessors},
                   {"memory_bytes", d.memory_bytes}});
  return out;
}

/// Writes the event `info`.
void print_info_event() {
  const BackendReport report = report_backends();
  const std::string alone = why_no_ranks();
  std::string reason;
  const Backend chosen = select_backend(Backend::automatic, &reason);
  const nlohmann::ordered_json event{
      {"event", "info"},
      {"macadam", version()},
      {"threads", report.threads},
      {"processor", report.processor},
      {"cuda", report.cuda_status},
      {"devices", devices_json(report.devices)},
      {"devices_without_code", devices_json(report.devices_without_code)},
      {"ranks", alone.empty()},
      {"why_no_ranks", alone.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(alone)},
      {"backend", to_string(chosen)},
      {"reason", reason}};
  print_json_line(event);
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("info", "print the version, backends and devices, or every key of a scene");
  const auto keys = std::make_shared<std::optional<Keys>>();
  CLI::Option* const of_keys =
      add_choice(command, "--keys", *keys, "print only the list of all keys of a scene, in this format",
                 {{"markdown", Keys::markdown}, {"json", Keys::json}});
  const auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "print one JSON object per line, for other programs")
      ->disable_flag_override()
      ->excludes(of_keys);
  add_examples(command, {"macadam info", "macadam info --json", "macadam info --keys markdown"});
  command.callback([keys, json] {
    if (*json)
      print_info_event();
    else if (!*keys)
      info_command();
    else
      say_text(**keys == Keys::json ? scene::keys_json() : scene::keys_page());
  });
}

}  // namespace macadam
