// SPDX-License-Identifier: GPL-3.0-or-later
// json_lines.cpp  Writes progress, warnings and errors as JSON.
#include "host/cli/terminal/json_lines.hpp"

#include <chrono>
#include <cstdio>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/cli/terminal/streams.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

using Json = nlohmann::ordered_json;

bool on = false, streaming = false;

/// The event that was written last about the progress of a scene.
struct LastProgress {
  std::string stage;
  std::chrono::steady_clock::time_point time;
};
std::map<std::string, LastProgress> last_progress;

Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// Returns the event about an error. The parts of a message are null if the error does not have them.
Json error_event(const char* kind, const std::string& message, const InputCulprit& culprit) {
  return {{"event", "error"},
          {"kind", kind},
          {"file", or_null(culprit.file)},
          {"line", culprit.line > 0 ? Json(culprit.line) : Json()},
          {"key", or_null(culprit.what)},
          {"found", or_null(culprit.found)},
          {"expected", or_null(culprit.expected)},
          {"message", message}};
}

const char* kind_of(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error)) return "input";
  return dynamic_cast<const InterruptedError*>(&error) ? "interrupted" : "run";
}

}  // namespace

bool wants_json_lines(int argc, const char* const* argv) {
  if (argc < 2) return false;
  const std::string_view command = argv[1];
  if (command != "run" && command != "check" && command != "info") return false;
  for (int k = 2; k < argc && std::string_view(argv[k]) != "--"; ++k)
    if (const std::string_view word = argv[k]; word == "--json" || word == "--json=true") return true;
  return false;
}

void begin_json_lines(bool stream) {
  on = true, streaming = stream;
  say_to_standard_error();
}

bool json_lines_are_on() { return on; }

void print_json_line(const Json& event) {
  if (!on) return;
  const std::string text = event.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fputc('\n', stdout);
  std::fflush(stdout);  // if this fails, the end of the program reports it
}

void print_json_progress(const std::string& scene, const std::string& stage, double fraction) {
  if (!on) return;
  const auto now = std::chrono::steady_clock::now();
  const auto [last, is_first] = last_progress.try_emplace(scene);
  if (!is_first && last->second.stage == stage && now - last->second.time < std::chrono::seconds(1)) return;
  last->second = {stage, now};
  print_json_line({{"event", "progress"}, {"scene", scene}, {"stage", stage}, {"fraction", fraction}});
}

void print_json_warning(const std::string& scene, const std::string& message) {
  if (on) print_json_line({{"event", "warning"}, {"scene", scene}, {"message", message}});
}

void print_json_error(const std::exception& error, const std::optional<std::string>& scene) {
  if (!on) return;
  const auto* input = dynamic_cast<const InputError*>(&error);
  const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  const InputCulprit nothing;
  const InputCulprit* culprit = input ? input->culprit() : nullptr;
  Json event = error_event(kind_of(error), memory ? "out of memory" : error.what(), culprit ? *culprit : nothing);
  if (scene) event["scene"] = *scene;
  print_json_line(event);
}

void print_json_usage_error(const std::string& message) {
  if (on) print_json_line(error_event("usage", message, {}));
}

void print_json_out_of_memory() {
  constexpr std::string_view event =
                                 "{\"event\":\"error\",\"kind\":\"run\",\"file\":null,\"line\":null,\"key\":null,"
                                 "\"found\":null,\"expected\":null,"
                                 "\"message\":\"out of memory\"}\n",
                             end = "{\"event\":\"end\",\"code\":1}\n";
  if (!on) return;
  std::fwrite(event.data(), 1, event.size(), stdout);
  if (streaming) std::fwrite(end.data(), 1, end.size(), stdout);
  std::fflush(stdout);
}

void print_json_end(int code) {
  if (on && streaming) print_json_line({{"event", "end"}, {"code", code}});
}

}  // namespace macadam
