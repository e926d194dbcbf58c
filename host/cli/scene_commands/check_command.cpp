// SPDX-License-Identifier: GPL-3.0-or-later
// check_command.cpp  Implements `macadam check SCENE`, which predicts particles, memory, time and files of a run
// without running it.
#include "host/cli/scene_commands/check_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/json_lines.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/simulation/forecast.hpp"
#include "macadam/overrides.hpp"

namespace macadam {
namespace {

struct CheckArguments {
  std::string scene;
  std::vector<std::string> set;
  Overrides instead;
  bool json = false;
};

/// Returns a number with two digits, because a prediction is not more accurate.
std::string about(double value) {
  if (!(value > 0)) return "0";
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  const double rounded = unit * std::round(value / unit);
  return value >= 1 ? fmt::format("{:.{}f}", rounded, value < 10 ? 1 : 0) : fmt::format("{:.2g}", rounded);
}

std::string bytes_in_words(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string time_in_words(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  return seconds < 6000 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

/// Returns the names of all files, the sizes of those above a megabyte, and the total size.
std::string files_in_words(const Forecast& f) {
  std::string out;
  for (std::size_t i = 0; i < f.files.size(); ++i) {
    out += (out.empty() ? "" : " ") + f.files[i];
    if (f.file_bytes[i] > 1e6) out += fmt::format(" ({})", bytes_in_words(f.file_bytes[i]));
  }
  const double sum = f.disk_bytes();
  return out + fmt::format("; about {} on disk", sum < 1e6 ? fmt::format("{:.0f} kB", sum / 1e3) : bytes_in_words(sum));
}

/// Returns the event `forecast`.
nlohmann::ordered_json as_json(const std::string& file, const Scene& scene, const Forecast& f) {
  nlohmann::ordered_json out{{"event", "forecast"},
                             {"scene", file},
                             {"kind", kind_of(scene.experiment)},
                             {"method", to_string(scene.solver.method)},
                             {"particles", f.census.particles()},
                             {"aggregates", f.census.aggregates},
                             {"voids", f.census.voids},
                             {"contacts", std::round(f.contacts)},
                             {"backend", to_string(f.backend)},
                             {"threads", f.threads},
                             {"solutions", f.solutions},
                             {"host_bytes", std::round(f.host_bytes)},
                             {"device_bytes", std::round(f.device_bytes)},
                             {"specimen_s", f.specimen_s},
                             {"network_s", f.network_s},
                             {"harmonic_s", f.harmonic_s},
                             {"stepping_s", f.stepping_s},
                             {"writing_s", f.writing_s},
                             {"seconds", f.seconds()},
                             {"warnings", f.census.warnings},
                             {"skips", f.skips},
                             {"files", f.files},
                             {"file_bytes", nlohmann::ordered_json::object()},
                             {"disk_bytes", std::round(f.disk_bytes())}};
  for (std::size_t i = 0; i < f.files.size(); ++i) out["file_bytes"][f.files[i]] = std::round(f.file_bytes[i]);
  if (!f.stepped) return out;
  out["precision"] = to_string(f.precision), out["form"] = to_string(f.form), out["geometry"] = to_string(f.geometry);
  out["steps"] = nlohmann::ordered_json::array();
  for (const StepForecast& s : f.steps)
    out["steps"].push_back({{"frequency_hz", s.frequency_hz},
                            {"steps", std::round(s.steps)},
                            {"dt_s", s.dt_s},
                            {"cycles", s.cycles},
                            {"density_scaling", s.density_scaling}});
  return out;
}

void say_forecast(const std::string& file, const Scene& scene, const Forecast& f) {
  const auto row = [](const char* what, const std::string& text) { say("{:<10} {}\n", what, text); };
  say("{}: the scene can be run\n", file);
  std::string specimen = fmt::format("{} particles: {} aggregates", f.census.particles(), f.census.aggregates);
  if (f.census.in_aggregates != f.census.aggregates)
    specimen += fmt::format(" with {} spheres in total", f.census.in_aggregates);
  specimen += fmt::format(", {} of mastic", f.census.mastic);
  if (f.census.voids > 0) specimen += fmt::format("; {} voids", f.census.voids);
  row("specimen", specimen + fmt::format("; about {} contacts", about(f.contacts)));
  const char* solutions =
      scene.solver.method == SolverMethod::quasi_static ? "linear systems" : "solutions in the frequency domain";
  row("test", fmt::format("{}, method {}{}", kind_of(scene.experiment), to_string(scene.solver.method),
                          f.solutions > 0 ? fmt::format(", {} {}", f.solutions, solutions) : ""));
  row("backend", fmt::format("{} ({}), {} threads", to_string(f.backend), f.reason, f.threads));
  if (f.stepped)
    row("stepping",
        fmt::format("{} precision, form {}, geometry {}{}", to_string(f.precision), to_string(f.form),
                    to_string(f.geometry),
                    scene.solver.tolerance ? "; the run itself chooses the settings that the scene leaves open" : ""));
  for (const StepForecast& s : f.steps)
    row("", fmt::format("{}about {} steps of {} s, density scaling {}",
                        s.frequency_hz > 0 ? fmt::format("{} Hz: ", s.frequency_hz) : "", about(s.steps), about(s.dt_s),
                        about(s.density_scaling)));
  row("memory",
      fmt::format("about {}{}", bytes_in_words(f.host_bytes),
                  f.device_bytes > 0 ? fmt::format(", and {} on the device", bytes_in_words(f.device_bytes)) : ""));
  row("time", fmt::format("about {}: specimen {}, network {}, solutions {}, steps {}, files {}",
                          time_in_words(f.seconds()), time_in_words(f.specimen_s), time_in_words(f.network_s),
                          time_in_words(f.harmonic_s), time_in_words(f.stepping_s), time_in_words(f.writing_s)));
  row("skips", fmt::format("{}", fmt::join(f.skips, ", ")));
  row("files", files_in_words(f));
  for (const std::string& warning : f.census.warnings) row("warning", warning);
}

void check_command(const CheckArguments& arguments) {
  Scene scene = read_changed_scene(arguments.scene, arguments.set);
  apply(arguments.instead, scene);
  const Forecast f = forecast(scene);
  if (arguments.json)
    print_json_line(as_json(arguments.scene, scene, f));
  else
    say_forecast(arguments.scene, scene, f);
}

}  // namespace

void add_check_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("check", "predict the particles, memory, time and files of a run, without running it");
  const auto arguments = std::make_shared<CheckArguments>();
  add_text(command, "scene", arguments->scene, "scene file (TOML)")->required();
  command.add_flag("--json", arguments->json, "print one JSON object per line, for other programs")
      ->disable_flag_override();
  add_set(command, arguments->set);
  add_overrides(command, arguments->instead);
  add_examples(command, {"macadam check examples/demo/scene.toml",
                         "macadam check examples/ac14_ss_am1/scene.toml --method harmonic --json"});
  command.callback([arguments] { check_command(*arguments); });
}

}  // namespace macadam
