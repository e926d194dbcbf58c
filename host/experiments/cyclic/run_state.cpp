// SPDX-License-Identifier: GPL-3.0-or-later
// run_state.cpp  Stores the state of a stepped cyclic test in a checkpoint: plan and wall times as text, samples and
// motions as arrays.
#include "host/experiments/cyclic/run_state.hpp"

#include <nlohmann/json.hpp>

#include "host/run/cracks.hpp"
#include "macadam/error.hpp"

/// Stores an optional value as the value or as null.
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  static void to_json(json& out, const std::optional<T>& value) { out = value ? json(*value) : json(); }
  static void from_json(const json& in, std::optional<T>& value) {
    if (!in.is_null()) value = in.get<T>();
  }
};

namespace macadam {

// A number in JSON is written with the fewest digits from which the same double is read again. JSON has no infinity and
// no NaN, but all of these numbers are finite.
namespace drives {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cyclic, amplitude, frequency, steps_per_period, ramp_steps)
}
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Stiffness, e_star_pa, phase_deg)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ErrorEstimate, e_star, phase_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CriticalStep, dt, particle)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrequencyPlan, loading, density_scaling, start, cycles, fit_cycles, known, predicted)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Plan, form, geometry, precision, geometry_error, critical, samples_per_cycle,
                                   frequencies, decisions)
namespace experiments {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Increments, increments, rejected, systems, error, imbalance, increment_error, loose,
                                   by_opening)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Rupture, time_s, strain, time_before_s, strain_before)
}  // namespace experiments
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrequencyCracks, rupture, time_s, strain)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunState, plan, seconds_planning, seconds, seconds_running, warnings, cracks,
                                   increments)

namespace {

constexpr const char *plan_text = "plan", *samples_array = "samples", *motion_prefix = "motion of frequency ",
                     *cracks_prefix = "cracks of frequency ";
constexpr std::size_t sample_words = 5;

}  // namespace

RunState to_run_state(Checkpoint checkpoint, const std::filesystem::path& file) {
  const auto damaged = [&](const std::string& what) {
    throw InputError(file.string(), 0, "checkpoint", what, "data as this version of Macadam writes them");
  };
  RunState out;
  try {
    out = nlohmann::json::parse(checkpoint.texts[plan_text]).get<RunState>();
  } catch (const nlohmann::json::exception& error) { damaged(error.what()); }
  out.state = take_state(checkpoint);
  for (const StateArray& array : checkpoint.arrays) {
    const auto* values = std::get_if<std::vector<double>>(&array.values);
    if (!values) damaged("array " + array.name + " in another precision");
    if (array.name == samples_array) {
      if (values->size() % sample_words != 0) damaged("array " + array.name + " of another kind");
      for (std::size_t i = 0; i + sample_words <= values->size(); i += sample_words) {
        const double* word = &(*values)[i];
        out.samples.push_back({word[0], word[1], word[2], word[3], word[4]});
      }
    }
    for (std::size_t i = 0; i < out.cracks.size(); ++i) {
      if (array.name != cracks_prefix + std::to_string(i)) continue;
      try {
        out.cracks[i].events = to_cracks(*values);
      } catch (const InputError& error) { damaged(error.what()); }
    }
    for (std::size_t i = 0; i < out.plan.frequencies.size(); ++i) {
      if (array.name != motion_prefix + std::to_string(i)) continue;
      for (std::size_t k = 0; k + 1 < values->size(); k += 2) {
        out.plan.frequencies[i].motion.emplace_back((*values)[k], (*values)[k + 1]);
      }
    }
  }
  if (out.seconds.size() >= out.plan.frequencies.size()) damaged("no frequency that is still to be run");
  if (out.cracks.size() != out.plan.frequencies.size()) damaged("another number of frequencies in the list of cracks");
  if (out.state.empty()) damaged("no state");
  return out;
}

void add_to(Checkpoint& out, const RunState& at, double seconds_running) {
  nlohmann::json plan = at;
  plan["seconds_running"] = seconds_running;
  out.texts[plan_text] = plan.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  std::vector<double> samples;
  for (const ResponseSample& s : at.samples) {
    samples.insert(samples.end(), {s.frequency_hz, s.time_s, s.strain, s.stress_pa, s.lateral_strain});
  }
  out.arrays.push_back({samples_array, "Hz, s, 1, Pa, 1", std::move(samples)});
  for (std::size_t i = 0; i < at.cracks.size(); ++i) {
    if (at.cracks[i].events.empty()) continue;
    out.arrays.push_back({cracks_prefix + std::to_string(i), "1, 1, 1, s, m, m", to_numbers(at.cracks[i].events)});
  }
  // frequencies that have not been started
  for (std::size_t i = at.seconds.size() + 1; i < at.plan.frequencies.size(); ++i) {
    std::vector<double> motion;
    for (const auto& z : at.plan.frequencies[i].motion) motion.insert(motion.end(), {z.real(), z.imag()});
    if (!motion.empty()) out.arrays.push_back({motion_prefix + std::to_string(i), "m/m, rad/m", std::move(motion)});
  }
}

}  // namespace macadam
