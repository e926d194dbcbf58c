// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_solver.cpp  Reads `[solver]`: how the scene is stepped or solved.
#include <algorithm>

#include <fmt/format.h>

#include "host/scene/sections.hpp"

namespace macadam::scene {
namespace {

/// Reads the damping. `damping` is the coefficient for the kind of damping that `damping_kind` names; if no kind is
/// given, the damping is local.
void read_damping(const Section& section, SolverSpec& spec) {
  constexpr Rule chi{[](double v) { return v >= 0 && v < 1; }, "a local damping from 0 to below 1"};
  const auto value = section.find("damping");
  const auto kind = section.find("damping_kind");
  spec.damping_given = value || kind;
  if (!kind) spec.damping_kind = Damping::local;
  if (value) {
    spec.damping = spec.damping_kind == Damping::local ? value->number(ratio, chi) : value->number(rate, non_negative);
  } else if (kind && spec.damping_kind != Damping::none) {
    section.refuse("damping", "nothing", "a value, because damping_kind is " + kind->shown());
  }
  if (spec.damping_kind == Damping::none && spec.damping > 0) {
    section.refuse("damping", value->shown(), "0, because damping_kind is \"none\"");
  }
  if (spec.damping == 0) spec.damping_kind = Damping::none;
}

/// Reads the density scaling: one number for all frequencies, or an array with one number per frequency.
std::vector<double> read_density_scaling(const Value& value, std::size_t frequencies) {
  if (!value.is_array()) return {value.number(ratio, positive)};
  std::vector<double> scaling = value.numbers(ratio, positive);
  if (scaling.size() != frequencies) {
    value.refuse(fmt::format("{} entries", scaling.size()),
                 fmt::format("a number, or an array of length {} with one number per frequency", frequencies));
  }
  return scaling;
}

/// Reads the GPUs to use: one device number, an array of different device numbers, or every device for "all".
DeviceList read_devices(const Value& value, int most) {
  const auto number = [&](const Value& v) { return static_cast<int>(v.integer(0, most)); };
  if (value.shown() == "\"all\"") return {every_device};
  if (!value.is_array()) return {number(value)};
  DeviceList out;
  for (const Value& entry : value.entries("an array of device numbers")) {
    out.push_back(number(entry));
    if (std::count(out.begin(), out.end(), out.back()) > 1) entry.refuse(entry.shown() + " twice", "each device once");
  }
  if (out.empty()) value.refuse("no entry", "at least one device");
  return out;
}

/// Refuses the keys that apply only to time steps, in a scene that is solved by increments. \throws InputError
void refuse_steps(const Section& section) {
  for (const char* key :
       {"density_scaling", "safety", "time_step", "damping_kind", "damping", "form", "inertia", "linear"}) {
    if (const auto value = section.find(key))
      section.refuse(key, value->shown() + " with method \"quasi_static\"",
                     "no such key, because increments have no inertia and no time step; or method = \"explicit\"");
  }
  const auto only = [&](const char* key, const char* possible) {
    const auto value = section.find(key);
    if (value && value->shown() != fmt::format("\"{}\"", possible) && value->shown() != "\"auto\"")
      section.refuse(key, value->shown() + " with method \"quasi_static\"", fmt::format("\"{}\"", possible));
  };
  only("geometry", "fixed");
  only("precision", "double");
  if (const auto value = section.find("backend"); value && value->shown() == "\"reference\"")
    section.refuse("backend", value->shown() + " with method \"quasi_static\"", "\"auto\", \"cpu\" or \"cuda\"");
}

}  // namespace

void choose_method(SolverSpec& solver, const Experiment& experiment, const LawTable& laws) {
  if (solver.method_given || stepping_of(experiment) != experiments::Stepping::if_asked) return;
  if (!can_crack(facts_of(laws)) && temperature_history_of(experiment).empty()) return;
  const bool steps = solver.density_scaling || solver.safety || solver.time_step || solver.damping_given ||
                     solver.form || solver.geometry == Geometry::updated || solver.backend == Backend::cuda ||
                     solver.backend == Backend::reference || !solver.devices.empty() ||
                     solver.precision.value_or(Precision::double_) != Precision::double_;
  solver.method = steps ? SolverMethod::explicit_ : SolverMethod::quasi_static;
}

SolverSpec usual_solver(const Experiment& experiment) {
  SolverSpec out;
  if (stepping_of(experiment) != experiments::Stepping::usual) out.method = SolverMethod::harmonic;
  return out;
}

SolverSpec read_solver(const Section& section, const Experiment& experiment) {
  const std::vector<double> frequencies = frequencies_of(experiment);
  constexpr Rule share{[](double v) { return v > 0 && v <= 1; },
                       "a fraction of the critical step, above 0 and at most 1"};
  // errors are measured against the harmonic solution, which itself is not accurate enough for errors below 1e-7
  constexpr Rule error{[](double v) { return v >= 1e-7 && v <= 0.1; }, "an error from 1e-7 to 0.1"};
  constexpr std::int64_t most_threads = 65'536, most_devices = 1023;
  SolverSpec spec = usual_solver(experiment);
  section.read(
      {{"method", Need::optional,
        into<SolverMethod>(spec.method, {{"explicit", SolverMethod::explicit_},
                                         {"harmonic", SolverMethod::harmonic},
                                         {"quasi_static", SolverMethod::quasi_static}}),
        "step the test in time, solve it in the frequency domain, or follow it by increments without inertia",
        "cyclic: \"explicit\"; other tests: \"harmonic\", or with cracks \"quasi_static\", or \"explicit\" if a key "
        "for inertia or damping is given"},
       {"tolerance", Need::optional, into(spec.tolerance, ratio, error),
        "largest relative error of |E*| and largest error of phi [rad]; the program chooses and reports the settings "
        "that are not given so that the errors are smaller. Method \"quasi_static\": largest estimated error of the "
        "stress in one increment, relative to the largest stress, and in cyclic tests also of |E*| and phi",
        "none; method \"quasi_static\": 0.001"},
       {"density_scaling",
        Need::optional,
        {[&](const Value& v) {
           spec.density_scaling = read_density_scaling(v, std::max<std::size_t>(1, frequencies.size()));
         },
         {"number or list of numbers", &ratio, positive.words}},
        "factor on mass and inertia, one number or one per frequency; the time step grows with its square root",
        "1; chosen if tolerance is given"},
       {"safety", Need::optional, into(spec.safety, ratio, share),
        "time step as a fraction of the computed critical time step", "0.8; with tolerance 0.95"},
       {"time_step", Need::optional, into(spec.time_step, duration, positive),
        "time step, in place of the computed one", "computed"},
       {"damping_kind", Need::optional,
        into<Damping>(spec.damping_kind,
                      {{"local", Damping::local}, {"viscous", Damping::viscous}, {"none", Damping::none}}),
        "kind of damping", "\"local\" if damping is given, else \"none\""},
       {"damping",
        Need::optional,
        {[](const Value&) {}, {"number", &rate}},  // read_damping() reads the value, once damping_kind is known
        "chi of local damping (a number below 1), or beta of viscous damping [1/s]",
        "0; chosen for stepped relaxation, creep, constant rates and histories"},
       {"form", Need::optional,
        into<ContactForm>(spec.form, {{"condensed", ContactForm::condensed}, {"points", ContactForm::points}}),
        "six generalised displacements per contact, or three per contact point",
        "\"condensed\"; \"points\" if a law is not linear"},
       {"geometry", Need::optional,
        into<Geometry>(spec.geometry, {{"updated", Geometry::updated}, {"fixed", Geometry::fixed}}),
        "normals and lever arms follow the particles, or keep their initial values",
        "\"updated\"; chosen if tolerance is given"},
       {"precision", Need::optional,
        into<Precision>(spec.precision,
                        {{"double", Precision::double_}, {"mixed", Precision::mixed}, {"single", Precision::single}}),
        "precision of the time steps", "\"double\"; chosen if tolerance is given"},
       {"backend", Need::optional,
        into<Backend>(spec.backend, {{"auto", Backend::automatic},
                                     {"cpu", Backend::cpu},
                                     {"cuda", Backend::cuda},
                                     {"reference", Backend::reference}}),
        "backend that computes: auto is a CUDA device if there is one, else the CPU"},
       {"linear", Need::optional,
        into<LinearMethod>(spec.linear, {{"auto", LinearMethod::automatic},
                                         {"iterative", LinearMethod::iterative},
                                         {"direct", LinearMethod::direct}}),
        "solver of the frequency domain: iterative, or direct by factorisation on the CPU"},
       {"threads", Need::optional, into(spec.threads, 0, most_threads),
        "number of threads of the CPU; results do not depend on it; 0: all"},
       {"device",
        Need::optional,
        {[&](const Value& v) { spec.devices = read_devices(v, most_devices); },
         {"whole number, list of them or \"all\"", nullptr, fmt::format("from 0 to {}", most_devices)}},
        "number of a CUDA device in the list of macadam info, or of several devices that share the specimen",
        "the first device that can run Macadam; a stepped run of 300,000 contacts or more also uses idle devices of "
        "the same type"},
       {"inertia", Need::optional, into(spec.inertia), "method \"harmonic\": whether particles have inertia"}});
  spec.method_given = section.has("method");
  read_damping(section, spec);

  if (spec.method == SolverMethod::explicit_ && stepping_of(experiment) == experiments::Stepping::never) {
    section.refuse("method", fmt::format("\"explicit\" with kind = \"{}\" in [loading]", kind_of(experiment)),
                   "\"harmonic\", because this kind is not stepped in time");
  }
  if (spec.method == SolverMethod::quasi_static && stepping_of(experiment) == experiments::Stepping::never) {
    section.refuse("method", fmt::format("\"quasi_static\" with kind = \"{}\" in [loading]", kind_of(experiment)),
                   "\"harmonic\", because this kind has no time");
  }
  if (spec.method == SolverMethod::quasi_static) refuse_steps(section);
  if (spec.inertia && spec.method == SolverMethod::explicit_) {
    section.refuse("inertia", "true with method \"explicit\"",
                   "no key inertia, because this method always has inertia; or method = \"harmonic\"");
  }
  if (!spec.devices.empty() && (spec.backend == Backend::cpu || spec.backend == Backend::reference)) {
    section.refuse("device", to_string(spec.devices), "no device, or backend = \"cuda\" or \"auto\"");
  }
  // The fit of the fundamental with offset and trend needs at least eight samples per cycle, and a sample takes at
  // least one step.
  constexpr double fewest_steps = 8;
  const double fastest = frequencies.empty() ? 0 : *std::max_element(frequencies.begin(), frequencies.end());
  if (spec.time_step && *spec.time_step * fastest * fewest_steps > 1) {
    section.refuse("time_step", fmt::format("{} s", *spec.time_step),
                   fmt::format("at most {} s, which is {} steps per cycle at {} Hz", 1 / (fewest_steps * fastest),
                               fewest_steps, fastest));
  }
  return spec;
}

}  // namespace macadam::scene

namespace macadam {

const char* to_string(SolverMethod method) {
  switch (method) {
    case SolverMethod::explicit_:
      return "explicit";
    case SolverMethod::harmonic:
      return "harmonic";
    case SolverMethod::quasi_static:
      return "quasi_static";
  }
  return "unknown";
}

}  // namespace macadam
