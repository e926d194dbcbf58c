// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoints.cpp  A run's state as texts and arrays; a checkpoint of any other run is refused.
#include "host/simulation/checkpoints.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>

#include "macadam/error.hpp"
#include "macadam/version.hpp"

/// A value or null.
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  static void to_json(json& out, const std::optional<T>& value) { out = value ? json(*value) : json(); }
  static void from_json(const json& in, std::optional<T>& value) {
    if (!in.is_null()) value = in.get<T>();
  }
};

namespace macadam {

// JSON's numbers are the shortest that give the same double again; all of these are finite.
namespace drives {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cyclic, amplitude, frequency, steps_per_period, ramp_steps)
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Stiffness, e_star_pa, phase_deg)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ErrorEstimate, e_star, phase_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CriticalStep, dt, particle)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrequencyPlan, loading, density_scaling, start, cycles, fit_cycles, known, predicted)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Plan, form, geometry, precision, geometry_error, critical, frequencies, decisions)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunState, plan, seconds_planning, seconds, seconds_running, warnings)

namespace {

constexpr const char *plan_text = "plan", *specimen_text = "specimen", *samples_array = "samples";
constexpr const char *motion_prefix = "motion of frequency ", *state_prefix = "state ";
constexpr std::size_t sample_words = 4;

/// What a checkpoint must have in common with the run that goes on from it, besides the specimen. Precision, form and
/// geometry as asked for: where nothing is, the plan holds what was chosen.
std::map<std::string, std::string> identity(const Scene& scene, Backend backend) {
  const auto asked = [](const auto& choice) { return std::string(choice ? to_string(*choice) : "not given"); };
  return {{"scene", scene.text},
          {"version", version()},
          {"backend", to_string(backend)},
          {"precision", asked(scene.solver.precision)},
          {"form", asked(scene.solver.form)},
          {"geometry", asked(scene.solver.geometry)}};
}

/// Particles and contacts with a checksum of all that the steps take from them.
std::string fingerprint(const Preparation& prepared) {
  uLong sum = crc32(0, nullptr, 0);
  const auto add = [&](const auto& list) {
    sum = crc32_z(sum, reinterpret_cast<const Bytef*>(list.data()), list.size() * sizeof(list[0]));
  };
  const Specimen& s = prepared.specimen;
  add(s.centre), add(s.radius), add(s.phase), add(s.body);  // voids show in the contacts
  const ContactNetwork& n = prepared.network;
  add(n.point_s), add(n.point_t), add(n.point_area);
  return fmt::format("{} particles, {} contacts, {} contact points, CRC-32 {:08x}", s.size(), n.contacts.size(),
                     n.point_area.size(), sum);
}

/// The first line that two texts do not share, in words.
std::pair<std::string, std::string> first_difference(const std::string& found, const std::string& expected) {
  std::istringstream a(found), b(expected);
  for (int line = 1;; ++line) {
    std::string left, right;
    const bool more_left = !!std::getline(a, left), more_right = !!std::getline(b, right);
    if (left == right && more_left && more_right) continue;
    const auto shown = [&](bool more, const std::string& text) {
      return more ? fmt::format("line {}: {}", line, text) : fmt::format("no line {}", line);
    };
    return {shown(more_left, left), shown(more_right, right)};
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what, const std::string& found,
                         const std::string& expected) {
  throw InputError(file.string(), 0, "checkpoint of another " + what, found, expected + ", as in this run");
}

}  // namespace

bool keeps_checkpoints(const Scene& scene, Backend backend, std::string* why_not) {
  const char* why = scene.solver.method == SolverMethod::harmonic ? "method harmonic"
                    : backend == Backend::reference               ? "backend reference"
                    : scene.text.empty()                          ? "a scene that was not read from a file"
                                                                  : nullptr;
  if (why && why_not) *why_not = std::string(why) + " keeps no checkpoints";
  return !why;
}

bool is_checkpoint_of(const std::filesystem::path& file, const Scene& scene, Backend backend) {
  try {
    read_run_state(file, scene, backend);
    return true;
  } catch (const InputError&) { return false; }
}

RunState read_run_state(const std::filesystem::path& file, const Scene& scene, Backend backend) {
  Checkpoint checkpoint = read_checkpoint(file);
  for (const auto& [what, expected] : identity(scene, backend)) {
    const std::string& found = checkpoint.texts[what];
    if (found == expected) continue;
    if (what != "scene") refuse(file, what, found, expected);
    const auto [there, here] = first_difference(found, expected);
    refuse(file, what, there, here);
  }
  const auto damaged = [&](const std::string& what) {
    throw InputError(file.string(), 0, "checkpoint", what, "what this version writes");
  };
  RunState out;
  try {
    out = nlohmann::json::parse(checkpoint.texts[plan_text]).get<RunState>();
  } catch (const nlohmann::json::exception& error) { damaged(error.what()); }
  out.specimen = checkpoint.texts[specimen_text];
  for (StateArray& array : checkpoint.arrays) {
    if (array.name.starts_with(state_prefix)) {
      array.name.erase(0, std::string_view(state_prefix).size());
      out.state.push_back(std::move(array));
      continue;
    }
    const auto* values = std::get_if<std::vector<double>>(&array.values);
    if (!values) damaged("array " + array.name + " in another precision");
    if (array.name == samples_array) {
      for (std::size_t i = 0; i + sample_words <= values->size(); i += sample_words) {
        const double* word = &(*values)[i];
        out.samples.push_back({word[0], word[1], word[2], word[3]});
      }
    }
    for (std::size_t i = 0; i < out.plan.frequencies.size(); ++i) {
      if (array.name != motion_prefix + std::to_string(i)) continue;
      for (std::size_t k = 0; k + 1 < values->size(); k += 2) {
        out.plan.frequencies[i].motion.emplace_back((*values)[k], (*values)[k + 1]);
      }
    }
  }
  if (out.seconds.size() >= out.plan.frequencies.size()) damaged("no frequency that is still to be run");
  if (out.state.empty()) damaged("no state");
  return out;
}

void require_same_specimen(const std::filesystem::path& file, const RunState& state, const Preparation& prepared) {
  if (const std::string here = fingerprint(prepared); state.specimen != here) {
    refuse(file, "specimen", state.specimen, here);
  }
}

Checkpoints::Checkpoints(const std::filesystem::path& file, const Scene& scene, const Preparation& prepared,
                         Backend backend, std::function<bool()> stop, std::function<void(const std::string&)> warn,
                         bool resumed)
    : file_(file),
      scene_(scene),
      prepared_(prepared),
      backend_(backend),
      stop_(std::move(stop)),
      warn_(std::move(warn)),
      own_(resumed) {}

void Checkpoints::look(const RunState& at, double seconds_running, const Stepper& stepper, const std::string& where) {
  constexpr double usual = 600;  // [s]
  const double period = scene_.output.checkpoint.value_or(usual);
  std::string why_not;
  const bool kept = keeps_checkpoints(scene_, backend_, &why_not), stopping = stop_ && stop_();
  const bool due = period > 0 && std::chrono::duration<double>(Clock::now() - last_).count() >= period;
  if (!stopping && !(kept && due)) return;
  std::string failure;
  if (kept) {
    try {
      write(at, seconds_running, stepper);
      own_ = true;
    } catch (const RunError& error) { failure = error.what(); } catch (const std::bad_alloc&) {
      failure = "not enough memory for it";
    }
    last_ = Clock::now();
  }
  if (!stopping && !failure.empty()) warn_(fmt::format("no checkpoint at {}: {}", where, failure));
  if (!stopping) return;
  std::string resumable = file_.string() + " is written: the same command with --resume goes on from it";
  if (!kept) resumable = "it cannot be resumed: " + why_not;
  if (!failure.empty()) {
    const bool older = own_ && std::filesystem::exists(file_);
    resumable = fmt::format("its checkpoint is not there: {}; {}", failure,
                            older ? "--resume goes on from the one before" : "it cannot be resumed");
  }
  throw InterruptedError(fmt::format("interrupted at {}, t = {:.6g} s; {}", where, stepper.observe().time, resumable));
}

void Checkpoints::write(const RunState& at, double seconds_running, const Stepper& stepper) const {
  Checkpoint out;
  out.texts = identity(scene_, backend_);
  nlohmann::json plan = at;
  plan["seconds_running"] = seconds_running;
  out.texts[plan_text] = plan.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  out.texts[specimen_text] = fingerprint(prepared_);
  std::vector<double> samples;
  for (const ResponseSample& s : at.samples) {
    samples.insert(samples.end(), {s.frequency_hz, s.time_s, s.strain, s.stress_pa});
  }
  out.arrays.push_back({samples_array, "Hz, s, 1, Pa", std::move(samples)});
  for (std::size_t i = at.seconds.size() + 1; i < at.plan.frequencies.size(); ++i) {  // those still to be started
    std::vector<double> motion;
    for (const auto& z : at.plan.frequencies[i].motion) motion.insert(motion.end(), {z.real(), z.imag()});
    if (!motion.empty()) out.arrays.push_back({motion_prefix + std::to_string(i), "m/m, rad/m", std::move(motion)});
  }
  for (StateArray& array : stepper.state()) {
    array.name = state_prefix + array.name;
    out.arrays.push_back(std::move(array));
  }
  write_checkpoint(file_, out);
}

}  // namespace macadam
