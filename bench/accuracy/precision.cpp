// SPDX-License-Identifier: GPL-3.0-or-later
// precision.cpp  Lists the runs of the study of precision, makes them, and writes their table.
#include "bench/accuracy/precision.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "host/run/error_model.hpp"
#include "macadam/error.hpp"

namespace macadam::accuracy {
namespace {

/// Returns a text with the backend, the specimen, the loading and the stepping of a case.
std::string describe(const Case& c) {
  return fmt::format("{} {} {}{}, {:g} Hz, {} x {} steps, {} {} from {}", to_string(c.backend), c.scene, c.mix,
                     c.stiff.empty() ? "" : fmt::format(" {} x {:g}", c.stiff, c.factor), c.frequency, c.cycles.back(),
                     c.cycle_steps, to_string(c.form), to_string(c.geometry), to_string(c.start));
}

/// Builds the list of runs.
class List {
 public:
  explicit List(Backend backend) : backend_(backend) {}

  std::vector<Case> make() {
    for (const char* scene : {"grid 4x4x5", "grid 2x2x30", "t8", "few clusters"}) {
      for (const char* mix : {"AM1", "AM2"}) {
        for (const std::int64_t steps : {10'000, 100'000}) add(scene, mix, 20, steps);
      }
      add(scene, "AM1", 2, 300'000);
    }
    add("grid 2x2x60", "AM1", 20, 100'000);
    for (const char* mix : {"AM1", "AM2"}) add("grid 4x4x5", mix, 2, 1'000'000);
    add("grid 4x4x5", "AM1", 2, 4'000'000);
    add("few clusters", "AM2", 2, 1'000'000);
    stiffer();
    otherwise();
    add("seed 101", "AM1", 20, 40'000);
    add("demo", "AM1", 20, 80'000);
    for (const char* mix : {"AM1", "AM2"}) add("clusters", mix, 20, 10'000);
    if (backend_ == Backend::cuda) {
      for (const char* mix : {"AM1", "AM2"}) add("full", mix, 20, 100'000);
      add("full", "AM1", 20, 1'000'000);
    }
    return std::move(list_);
  }

 private:
  Case& add(const char* scene, const char* mix, double frequency, std::int64_t steps) {
    Case& c = list_.emplace_back();
    c.study = "precision", c.backend = backend_, c.scene = scene, c.mix = mix;
    c.frequency = frequency, c.cycle_steps = steps;
    return c;
  }

  /// Adds runs with stiffened contacts. Densities are scaled such that a cycle has the given number of steps. Stiffer
  /// contacts have a shorter critical step, so with the same number of steps the masses would be larger, and so would
  /// be the effect of inertia on the result. Therefore runs with the stiffest contacts have more steps.
  void stiffer() {
    const auto add_stiff = [&](const char* scene, const char* what, double factor, std::int64_t steps) {
      Case& c = add(scene, "AM1", 20, steps);
      c.stiff = what, c.factor = factor;
    };
    for (const char* what : {"aggregate", "walls"}) {
      add_stiff("grid 4x4x5", what, 1e2, 100'000);
      add_stiff("grid 4x4x5", what, 1e4, 100'000);
      add_stiff("grid 4x4x5", what, 1e6, 1'000'000);
      add_stiff("few clusters", what, 1e2, 30'000);
      add_stiff("few clusters", what, 1e4, 100'000);
    }
  }

  /// Adds runs with updated geometry, with contact points, from rest, and over several cycles.
  void otherwise() {
    for (const char* scene : {"t8", "few clusters", "grid 2x2x30"}) {
      add(scene, "AM1", 20, 100'000).geometry = Geometry::updated;
    }
    add("few clusters", "AM2", 20, 30'000).form = ContactForm::points;
    add("grid 4x4x5", "AM1", 20, 10'000).cycles = {16};
    Case& rest = add("few clusters", "AM1", 20, 10'000);
    rest.start = Start::rest, rest.ramp_cycles = 1, rest.cycles = {5};
  }

  Backend backend_;
  std::vector<Case> list_;
};

constexpr const char* first_columns = "backend,scene,mix,stiff,factor,";

/// Returns the comment lines and the rows of an existing table that belong to other backends.
std::pair<std::string, std::string> of_others(const std::filesystem::path& csv, const std::string& backend) {
  std::pair<std::string, std::string> out;
  std::ifstream in(csv);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("# " + backend + ":") || line.starts_with(backend + ",") || line.starts_with(first_columns)) {
      continue;
    }
    (line.starts_with("#") ? out.first : out.second) += line + "\n";
  }
  return out;
}

}  // namespace

std::vector<Case> precision_cases(Backend backend) { return List(backend).make(); }

void measure_precision(Runner& runner, Backend backend, const std::filesystem::path& csv, const std::string& machine,
                       const std::string& only) {
  const std::string name = to_string(backend);
  const auto [about, rows] = of_others(csv, name);
  std::FILE* file = std::fopen(csv.c_str(), "w");
  if (!file) throw RunError("cannot write " + csv.string());
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> closed(file, std::fclose);
  fmt::print(file, "{}# {}: {}, {:%Y-%m-%d}\n", about, name, machine, std::chrono::system_clock::now());
  fmt::print(file,
             "{}particles,contacts,frequency_hz,density_scaling,form,geometry,start,cycles,steps,layers,contrast,"
             "inertia,precision,e_star,phase_rad\n{}",
             first_columns, rows);
  for (Case& c : precision_cases(backend)) {
    if (describe(c).find(only) == std::string::npos) continue;
    std::vector<Outcome> exact;
    for (const Precision precision : {Precision::double_, Precision::mixed, Precision::single}) {
      c.precision = precision;
      const std::vector<Outcome> found = runner.run(c);
      if (found.size() != c.cycles.size() || found.back().status != "done") throw RunError(describe(c) + " diverged");
      if (precision == Precision::double_) exact = found;
      const Preparation& p = runner.prepared(c);
      for (std::size_t i = 0; i < found.size() && precision != Precision::double_; ++i) {
        const Outcome& o = found[i];
        const ErrorEstimate e = difference(o.found, exact[i].found);
        const RoundingScale s = rounding_scale(runner.scene_of(c), p, c.frequency, o.steps, c.density_scaling);
        fmt::print(file, "{},{},{},{},{:g},{},{},{:g},{:.4g},{},{},{},{},{},{:.3g},{:.3g},{:.3g},{},{:.2e},{:.2e}\n",
                   to_string(backend), c.scene, c.mix, c.stiff, c.factor, p.specimen.size(), p.network.contacts.size(),
                   c.frequency, c.density_scaling, to_string(c.form), to_string(c.geometry), to_string(c.start),
                   o.cycles, o.steps, s.layers, s.contrast, s.inertia, to_string(precision), e.e_star, e.phase_rad);
        fmt::print(stderr, "{}, {}: |E*| {:+.1e}, phi {:+.1e} rad, {:.2f} s\n", describe(c), to_string(precision),
                   e.e_star, e.phase_rad, o.seconds);
      }
      std::fflush(file);
    }
  }
}

}  // namespace macadam::accuracy
