// SPDX-License-Identifier: GPL-3.0-or-later
// prepared_specimens.cpp  Solves the specimens for given laws, each solution starting from its estimate, and computes
// these estimates.
#include "host/tools/calibration/prepared_specimens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/base/parallel.hpp"
#include "host/scene/shift_keys.hpp"
#include "host/run/harmonic_options.hpp"
#include "host/tools/fit/isotherms.hpp"
#include "macadam/error.hpp"

namespace macadam::calibration {
namespace {

using Complex = std::complex<double>;

bool shifts(const laws::Shift& shift) { return !std::holds_alternative<laws::NoShift>(shift); }

/// Returns the standard deviation of a sample; 0 for a single value.
double scatter(const std::vector<double>& values) {
  double mean = 0, sum = 0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) sum += (v - mean) * (v - mean);
  return values.size() > 1 ? std::sqrt(sum / static_cast<double>(values.size() - 1)) : 0;
}

/// Residual tolerance of the solutions. With this tolerance E* has nine correct digits (harmonic.cpp). The derivatives
/// of E* have only seven, because their error is of first order in the error of the motion.
constexpr double residual = 1e-8;

/// Classes of contacts with rock in series (host/harmonic/rock_classes.hpp). With this spacing the error of an estimate
/// is below 1e-5, and correct() removes it at the laws of a solution. The reserve is the largest factor by which one
/// round of a calibration changes a parameter, e².
constexpr double class_spacing = 0.01, class_reserve = 8;

double degrees(Complex modulus) { return std::arg(modulus) * 180 / std::numbers::pi; }

/// Frequencies [Hz] and temperatures [°C] of the scene's experiment; empty for experiments in time.
struct Loading {
  std::vector<double> frequencies, temperatures;
};

Loading loading_of(const Scene& scene) {
  if (const auto* cyclic = std::get_if<experiments::Cyclic>(&scene.experiment))
    return {cyclic->frequencies, cyclic->temperatures};
  if (const auto* sweep = std::get_if<experiments::Sweep>(&scene.experiment))
    return {sweep->frequencies, sweep->temperatures};
  return {};
}

/// Returns whether the laws are evaluated at the temperature of every reading. This is the case if all shifts of the
/// scene are formulas of temperature (WLF, Arrhenius). Otherwise readings are grouped into isotherms, because a shift
/// table only has entries for isotherms, and a scene without shifts has one set of laws.
bool follows_each_reading(const Scene& scene) {
  const auto is_table = [](const laws::Shift& shift) { return std::holds_alternative<laws::ShiftTable>(shift); };
  return std::any_of(scene.shifts.begin(), scene.shifts.end(), shifts) &&
         std::none_of(scene.shifts.begin(), scene.shifts.end(), is_table);
}

/// Returns the temperature of an isotherm at which the laws are evaluated. If a shift table of the scene has an
/// entry for this isotherm, it is the temperature of the entry, otherwise the mean of the readings.
double temperature_of_laws(const Scene& scene, const fitting::Isotherm& isotherm) {
  for (const laws::Shift& shift : scene.shifts) {
    if (const auto* table = std::get_if<laws::ShiftTable>(&shift)) {
      for (const double t : table->temperatures)
        if (fitting::distance_from(isotherm, t) <= fitting::same_isotherm) return t;
    }
  }
  return isotherm.temperature;
}

/// Returns the temperature at which the laws are evaluated for each measurement. All measurements must have a
/// temperature. Readings that differ by tenths of a kelvin are one isotherm, as in a fit with a free shift.
std::vector<std::optional<double>> measured_temperatures(const Scene& scene, const ModulusData& data) {
  std::vector<double> readings;
  for (const ModulusPoint& p : data.points) readings.push_back(p.temperature_c);
  if (follows_each_reading(scene)) return {readings.begin(), readings.end()};
  const std::vector<fitting::Isotherm> isotherms = fitting::isotherms_of(readings);
  std::vector<std::optional<double>> out;
  for (const double reading : readings)
    out.emplace_back(temperature_of_laws(scene, isotherms[fitting::isotherm_at(isotherms, reading)]));
  return out;
}

}  // namespace

std::vector<std::optional<double>> temperatures_of(const Scene& scene, const ModulusData& data) {
  const auto refuse = [&](const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError(data.source, 0, what, found, expected);
  };
  std::vector<std::optional<double>> out;
  const std::vector<double> several = loading_of(scene).temperatures;
  if (!data.temperatures && several.size() > 1) {
    refuse("column temperature_c", fmt::format("no such column, but {} temperatures in the scene", several.size()),
           "this column, or a single temperature in the scene");
  }
  if (data.temperatures) {
    out = measured_temperatures(scene, data);
  } else if (!several.empty()) {
    out.assign(data.points.size(), several.front());
  } else {
    out.assign(data.points.size(), scene.materials.temperature);
  }
  const bool shifted = std::any_of(scene.shifts.begin(), scene.shifts.end(), shifts);
  for (const std::optional<double>& t : out) {
    if (!t) continue;
    if (!shifted && *t != *out.front()) {
      refuse("column temperature_c",
             fmt::format("{} and {} degrees C, between which no law of the scene changes", *out.front(), *t),
             fmt::format("one temperature, or a scene with shift = \"wlf\", \"arrhenius\" or \"table\" in {}",
                         has_laws_of_phases(scene.network.rule) ? "[materials.mastic]" : "a section [[contacts]]"));
    }
    const LawTable laws = laws_at(scene, *t);
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      if (laws[pair] && !laws::usable(*laws[pair])) {
        refuse(
            "column temperature_c",
            fmt::format("{} degrees C, where the shift of {} has no value", *t, to_string(static_cast<PairType>(pair))),
            scene::range_of(scene.shifts[pair]));
      }
    }
  }
  return out;
}

double Specimens::density_scaling_at(double frequency) const {
  const auto& scaling = scene_.solver.density_scaling;
  if (!inertia_) return 0;
  if (!scaling || scaling->size() == 1) return density_scaling_of(scene_.solver, 0);
  const std::vector<double> known = loading_of(scene_).frequencies;
  const auto at = std::find(known.begin(), known.end(), frequency);
  if (at == known.end()) {
    throw InputError(
        data_.source, 0, "column frequency_hz",
        fmt::format("{} Hz, for which density_scaling of the scene has no entry", frequency),
        fmt::format(
            "frequencies of the scene ({} Hz), one density_scaling for all frequencies, or method = \"harmonic\" "
            "without inertia",
            fmt::join(known, ", ")));
  }
  return density_scaling_of(scene_.solver, static_cast<std::size_t>(at - known.begin()));
}

Specimens::Specimens(const Scene& scene, const ModulusData& data, int seeds, const Watcher& watcher)
    : scene_(scene), data_(data), watcher_(watcher) {
  const SolverSpec& solver = scene.solver;
  inertia_ = solver.inertia || solver.method == SolverMethod::explicit_;  // a stepped run always has inertia
  viscous_ = inertia_ && solver.damping_kind == Damping::viscous ? solver.damping : 0;
  backend_ = select_backend(solver.backend, nullptr, solver.devices);
  if (backend_ == Backend::reference || solver.linear == LinearMethod::direct) backend_ = Backend::cpu;
  solver_ = fmt::format("harmonic, {} inertia{}, {}", inertia_ ? "with" : "without",
                        viscous_ > 0 ? " and viscous damping" : "", to_string(backend_));
  const std::vector<std::optional<double>> temperatures = temperatures_of(scene, data);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Place place{data.points[i].frequency_hz, density_scaling_at(data.points[i].frequency_hz), temperatures[i]};
    const auto same = std::find_if(places_.begin(), places_.end(), [&](const Place& p) {
      return p.frequency == place.frequency && p.temperature == place.temperature;
    });
    place_of_.push_back(static_cast<std::size_t>(same - places_.begin()));
    if (same != places_.end()) continue;
    const auto isotherm = std::find_if(isotherms_.begin(), isotherms_.end(), [&](const auto& of) {
      return places_[of.front()].temperature == place.temperature;
    });
    if (isotherm == isotherms_.end()) {
      isotherms_.push_back({places_.size()});
    } else {
      isotherm->push_back(places_.size());
    }
    places_.push_back(place);
  }
  for (int k = 0; k < seeds; ++k) {
    if (!scene.specimen.file) {
      scene_.specimen.seed = scene.specimen.seed + static_cast<std::uint64_t>(k);
      seeds_.push_back(scene_.specimen.seed);
    }
    Preparation prepared = prepare(scene_, watcher.progress);
    Inertia inertia = make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic);
    bodies_.push_back(
        std::make_unique<Body>(Body{std::move(prepared.specimen), std::move(prepared.network), std::move(inertia),
                                    nullptr, std::vector<Complex>(places_.size(), 1.0), 1}));
    Body& body = *bodies_.back();
    body.seen =
        std::make_unique<harmonic::ReducedModel>(body.specimen, body.network, inertia_ ? body.inertia : Inertia{},
                                                 harmonic::RockClassing{scene.laws, class_spacing, class_reserve});
  }
}

Specimens::Answer Specimens::answer_of(const ModulusParts& parts, const LawTable& laws, const HarmonicLoad& load,
                                       const std::vector<Parameter>& free) const {
  Answer out{parts.modulus(), {}};
  const bool of_phases = scene_.network.rule == ContactRule::series;
  const auto all = of_phases ? phase_sensitivities(parts, laws, load.s()) : sensitivities(parts, laws, load.s());
  for (const Parameter& parameter : free) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.parameter == parameter.name; });
    if (found == all.end() && parameter.phase) {
      const bool mastic = *parameter.phase == Phase::mastic;
      throw InputError("free parameters", 0, parameter.name,
                       std::string("a specimen without contacts that ") + (mastic ? "mastic" : "rock") + " resists",
                       "parameters of phases that the specimen contains");
    }
    if (found == all.end()) {
      throw InputError("free parameters", 0, parameter.name,
                       fmt::format("a specimen without {} contacts", to_string(parameter.pair)),
                       "parameters of pairs that have contacts in the specimen");
    }
    out.by.push_back(out.modulus *
                     Complex(found->d_e_star_pa / std::abs(out.modulus), found->d_phase_deg * std::numbers::pi / 180));
  }
  return out;
}

void Specimens::set_rock(Body& body, const LawTable& laws) const {
  const double rock = rock_compliance(scene_, laws);
  if (rock == body.rock) return;
  for (Contact& c : body.network.contacts) c.series *= rock / body.rock;
  body.rock = rock;
}

void Specimens::correct(Body& body, const LawTable& laws, const Answers& solved) const {
  if (body.seen->rock().error() == 0) return;
  for_each_in_parallel(places_.size(), [&](std::size_t i) {
    const auto found = body.seen->solve(laws_of(places_[i], laws), load_of(places_[i]), body.rock);
    body.correction[i] = solved[i].modulus / found.parts.modulus();
  });
}

Specimens::Answers Specimens::solve(Body& body, const LawTable& laws, const std::vector<Parameter>& free) const {
  Answers out(places_.size());
  set_rock(body, laws);
  std::vector<harmonic::Vector> motions;
  for (const auto& places : isotherms_) {
    const LawTable at = laws_of(places_[places.front()], laws);
    std::vector<double> frequencies;
    for (const std::size_t p : places) frequencies.push_back(places_[p].frequency);
    Harmonic harmonic(body.specimen, body.network, at, body.inertia,
                      harmonic_options(scene_, backend_, watcher_.stop, residual), geometric_mean(frequencies));
    constexpr std::size_t block = 4;  // number of frequencies that are solved at the same time
    for (std::size_t begin = 0; begin < places.size(); begin += block) {
      if (watcher_.stop && watcher_.stop()) throw InterruptedError("");
      const std::size_t count = std::min(block, places.size() - begin);
      std::vector<harmonic::Vector> near(count);
      std::vector<HarmonicLoad> loads;
      for (std::size_t i = 0; i < count; ++i) {
        loads.push_back(load_of(places_[places[begin + i]]));
        if (body.seen->motions() == 0) continue;
        near[i] = body.seen->motion(body.seen->solve(at, loads[i], body.rock));
        loads[i].near = &near[i];
      }
      std::vector<HarmonicResult> solved = harmonic.solve(loads);
      for (std::size_t i = 0; i < count; ++i) {
        out[places[begin + i]] = answer_of(solved[i].parts, at, loads[i], free);
        motions.push_back(std::move(solved[i].motion));
      }
    }
  }
  body.seen->add(motions);
  correct(body, laws, out);
  return out;
}

std::vector<Predicted> Specimens::solve(const LawTable& laws, const std::vector<Parameter>& free) {
  ++solutions_;
  std::vector<Answers> answers;
  for (const auto& body : bodies_) {
    if (watcher_.progress) {
      watcher_.progress(fmt::format("solution {}", solutions_),
                        static_cast<double>(answers.size()) / static_cast<double>(bodies_.size()));
    }
    answers.push_back(solve(*body, laws, free));
  }
  return mean_of(answers, free.size());
}

std::vector<Predicted> Specimens::estimate(const LawTable& laws, const std::vector<Parameter>& free) const {
  if (watcher_.stop && watcher_.stop()) throw InterruptedError("");
  const double rock = rock_compliance(scene_, laws);
  std::vector<Answers> answers;
  for (const auto& body : bodies_) {
    answers.emplace_back(places_.size());
    for_each_in_parallel(places_.size(), [&](std::size_t i) {
      const LawTable at = laws_of(places_[i], laws);
      const HarmonicLoad load = load_of(places_[i]);
      Answer& answer = answers.back()[i];
      answer = answer_of(body->seen->solve(at, load, rock).parts, at, load, free);
      answer.modulus *= body->correction[i];
      for (Complex& by : answer.by) by *= body->correction[i];
    });
  }
  return mean_of(answers, free.size());
}

std::vector<Predicted> Specimens::mean_of(const std::vector<Answers>& by_body, std::size_t free) const {
  std::vector<Predicted> out(data_.points.size());
  const double weight = 1 / static_cast<double>(by_body.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].by.assign(free, 0);
    std::vector<double> log_moduli, phases;
    for (const Answers& of_body : by_body) {
      const Answer& a = of_body[place_of_[i]];
      out[i].modulus += weight * a.modulus;
      for (std::size_t k = 0; k < free; ++k) out[i].by[k] += weight * a.by[k];
      log_moduli.push_back(std::log(std::abs(a.modulus)));
      phases.push_back(degrees(a.modulus));
    }
    out[i].e_star_scatter = scatter(log_moduli);
    out[i].phase_scatter_deg = scatter(phases);
  }
  return out;
}

}  // namespace macadam::calibration
