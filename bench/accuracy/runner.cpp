// SPDX-License-Identifier: GPL-3.0-or-later
// runner.cpp  Makes one run: network, frequency-domain solutions, stepping, and an evaluation after each requested
// number of cycles.
#include "bench/accuracy/runner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/cluster_specimens.hpp"

namespace macadam::accuracy {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr int samples_per_cycle = 500;

/// Returns a loading with a whole number of samples per period and a whole number of steps per sample.
drives::Cyclic make_loading(const Case& c, double height, double step) {
  drives::Cyclic loading;
  loading.amplitude = c.strain * height;
  loading.frequency = c.frequency;
  loading.steps_per_period = std::llround(std::ceil(1 / (c.frequency * step * samples_per_cycle))) * samples_per_cycle;
  loading.ramp_steps = std::llround(c.ramp_cycles * static_cast<double>(loading.steps_per_period));
  return loading;
}

/// Returns the law with its moduli and viscosities multiplied by `factor`.
Law stiffened(Law law, double factor) {
  if (auto* elastic = std::get_if<laws::Elastic>(&law)) elastic->E *= factor;
  if (auto* kelvin = std::get_if<laws::GeneralisedKelvin>(&law)) {
    kelvin->E_m *= factor, kelvin->C_m *= factor;
    for (double& E : kelvin->E) E *= factor;
    for (double& C : kelvin->C) C *= factor;
  }
  return law;
}

/// Prepares a specimen: "grid 4x4x5" are spheres at jittered grid points; other specimens follow from the scene.
Preparation prepare_case(const std::string& name, const Scene& scene) {
  if (!name.starts_with("grid ")) return prepare(scene);
  int n[3];
  if (std::sscanf(name.c_str(), "grid %dx%dx%d", &n[0], &n[1], &n[2]) != 3) throw InputError("no such scene: " + name);
  Preparation out;
  out.specimen = test::random_specimen(8, n[0], n[1], n[2]);
  out.tessellation = tessellate(out.specimen);
  out.network = build_network(out.specimen, out.tessellation, scene.network);
  return out;
}

}  // namespace

/// A specimen with its contacts for one choice of quadrature and filters. It keeps the frequency-domain solutions that
/// were computed for it.
struct Runner::Network {
  Preparation prepared;
  LawTable laws;
  Inertia inertia;
  Harmonic harmonic;
  double seconds_factoring;
  std::map<std::tuple<double, double, double>, HarmonicResult> solved;

  Network(Preparation made, const Scene& scene, Clock::time_point start = Clock::now())
      : prepared(std::move(made)),
        laws(scene.laws),
        inertia(make_inertia(prepared.specimen, scene.materials.aggregate, scene.materials.mastic)),
        harmonic(prepared.specimen, prepared.network, laws, inertia, {}, 6),
        seconds_factoring(seconds_since(start)) {}

  const HarmonicResult& solve(double frequency, double scaling, double viscous) {
    auto [at, fresh] = solved.try_emplace({frequency, scaling, viscous});
    if (fresh) at->second = harmonic.solve(frequency, scaling, viscous);
    return at->second;
  }
};

Runner::Runner(std::filesystem::path root, std::filesystem::path out) : root_(std::move(root)), out_(std::move(out)) {}
Runner::~Runner() = default;

/// Returns the scene for a specimen name. It has the materials and laws of the specimens of [1]: the laws of `mix`, and
/// the laws of the contacts within clusters.
const Scene& Runner::scene(const std::string& name, const std::string& mix) {
  auto [at, fresh] = scenes_.try_emplace({name, mix});
  if (!fresh) return at->second;
  const Scene clusters = read_scene(root_ / "examples/ac14_ms_poly_fine/scene.toml");
  Scene& made = at->second = read_scene(root_ / "examples/demo/scene.toml");
  if (mix == "AM2") made.laws = read_scene(root_ / "examples/ac14_ss_am2/scene.toml").laws;
  made.laws[static_cast<std::size_t>(PairType::inner)] = clusters.laws[static_cast<std::size_t>(PairType::inner)];
  made.experiment = {};
  made.solver = {};
  if (name == "clusters") {  // box and size classes of the demo, with real shapes and fine filling
    made.specimen.shapes = clusters.specimen.shapes;
    made.specimen.shapes->placement = PlacementMethod::packing;
  } else if (name.starts_with("seed ")) {
    made.specimen.seed = std::stoull(name.substr(5));
    made.specimen.box.size = {0.012, 0.012, 0.016};
    made.specimen.aggregate = {{2e-3, 4.75e-3, 0.25, std::nullopt}};
  } else if (name == "few clusters") {
    made.specimen = test::cluster_recipe(8, {6.5e-3, 6.5e-3, 8.5e-3});
    made.specimen.aggregate = {{3.6e-3, 3.9e-3, std::nullopt, 2}};
  } else if (name != "demo" && !name.starts_with("grid ")) {
    made.specimen = {};
    made.specimen.file = root_ / "tests/data" / (name == "t8" ? "t8.csv" : "ss_full.csv.gz");
    made.specimen.box.size = name == "t8" ? Vec3d{0.008, 0.008, 0.011} : Vec3d{0.05, 0.05, 0.08};
  }
  return made;
}

Runner::Network& Runner::network(const Case& c) {
  auto& at =
      networks_[{c.scene, c.mix, c.stiff, c.factor, c.quadrature, c.gap_max.value_or(-1), c.area_min.value_or(-1)}];
  if (!at) {
    const Scene variant = scene_of(c);
    at = std::make_unique<Network>(prepare_case(c.scene, variant), variant);
  }
  return *at;
}

const Preparation& Runner::prepared(const Case& c) { return network(c).prepared; }

Scene Runner::scene_of(const Case& c) {
  Scene out = scene(c.scene, c.mix);
  out.network.quadrature = c.quadrature;
  out.network.gap_max = c.gap_max;
  out.network.area_min = c.area_min;
  const auto stiffen = [&](PairType pair, double factor) {
    auto& law = out.laws[static_cast<std::size_t>(pair)];
    law = stiffened(*law, factor);
  };
  if (c.stiff == "aggregate") {
    for (const PairType pair : {PairType::aa, PairType::inner, PairType::aw}) stiffen(pair, c.factor);
    stiffen(PairType::ma, std::sqrt(c.factor));
  } else if (c.stiff == "walls") {
    for (const PairType pair : {PairType::aw, PairType::mw}) stiffen(pair, c.factor);
  }
  return out;
}

std::vector<Outcome> Runner::run(Case& c) {
  if (c.tolerance) return run_asked(c);
  Network& n = network(c);
  const Box& box = n.prepared.specimen.box;
  const double viscous = c.damping_kind == Damping::viscous ? c.damping : 0;

  StepperOptions options;
  options.damping_kind = c.damping_kind;
  options.damping = c.damping;
  const double critical = critical_step(n.prepared.network, n.laws, n.inertia, options).dt;
  if (c.cycle_steps > 0) {
    c.density_scaling =
        (1 + 1e-9) * std::pow(1 / (c.frequency * static_cast<double>(c.cycle_steps) * c.step_share * critical), 2);
  }
  const drives::Cyclic loading = make_loading(c, box.size.z, c.step_share * critical * std::sqrt(c.density_scaling));
  options.boundary = moving_top(loading);
  options.dt = loading.dt();
  options.density_scaling = c.density_scaling;
  options.form = c.form;
  options.geometry = c.geometry;
  options.precision = c.precision;
  options.threads = 1;

  Outcome now;
  const HarmonicResult& own = n.solve(c.frequency, c.density_scaling, viscous);
  now.own = own.top;
  now.truth = n.solve(c.frequency, 1, 0).top;
  Case plain = c;
  plain.quadrature = Quadrature::lumped;
  plain.gap_max = plain.area_min = std::nullopt;
  now.model = network(plain).solve(c.frequency, 1, 0).top;
  now.seconds_harmonic = n.seconds_factoring + own.seconds;
  now.contacts = static_cast<std::int64_t>(n.prepared.network.contacts.size());
  now.dt = loading.dt();
  now.step_share = now.dt / (critical * std::sqrt(c.density_scaling));

  StartState state;
  if (c.start == Start::steady) {
    state = steady_start(n.prepared.network, n.laws, own.motion, loading);
    options.start = &state;
  }
  const auto stepper = make_stepper(c.backend, n.prepared.specimen, n.prepared.network, n.laws, n.inertia, options);
  now.bytes = stepper->bytes();

  std::vector<Outcome> out;
  std::vector<ResponseSample> samples;
  const auto start = Clock::now();
  for (int cycle = 0; cycle < c.cycles.back(); ++cycle) {
    for (int k = cycle == 0 ? 0 : 1; k <= samples_per_cycle; ++k) {
      if (k > 0) stepper->advance(loading.steps_per_period / samples_per_cycle);
      const Observation seen = stepper->observe();
      samples.push_back(
          {c.frequency, seen.time, seen.top_displacement() / gauge_length(box), -seen.top_force() / section_area(box)});
    }
    now.seconds = seconds_since(start);
    now.cycles = cycle + 1;
    now.steps = now.cycles * loading.steps_per_period;
    if (stepper->first_divergent() >= 0 || !std::isfinite(samples.back().stress_pa)) {
      now.status = "diverged";
      out.push_back(now);
      return out;
    }
    if (std::ranges::find(c.cycles, now.cycles) == c.cycles.end()) continue;
    now.fit_cycles = experiments::Cyclic{}.fitted(now.cycles);
    now.found = evaluate_cyclic(samples, c.frequency, now.fit_cycles).fit;
    out.push_back(now);
  }
  return out;
}

/// Runs the whole program with `[solver] tolerance`, and writes the settings that it chose into the case.
std::vector<Outcome> Runner::run_asked(Case& c) {
  Scene asked = scene(c.scene, c.mix);
  asked.cyclic().frequencies = {c.frequency};
  asked.cyclic().strain_amplitude = c.strain;
  asked.solver.tolerance = c.tolerance;
  asked.solver.backend = c.backend;
  asked.solver.threads = 1;
  const RunResult result = macadam::run(asked, out_);
  const experiments::SteppedCyclic& stepped = result.stepped();
  const experiments::SteppedFrequency& f = stepped.frequencies.at(0);
  c.density_scaling = f.density_scaling;
  c.precision = stepped.precision;
  c.form = stepped.form;
  c.geometry = stepped.geometry;
  c.start = f.start;
  Outcome out;
  Network& n = network(c);
  out.found = f.stiffness;
  out.truth = out.model = n.solve(c.frequency, 1, 0).top;
  out.own = n.solve(c.frequency, f.density_scaling, 0).top;
  out.cycles = f.cycles;
  out.fit_cycles = asked.cyclic().fitted(f.cycles);
  out.steps = f.steps;
  out.seconds = f.seconds;
  out.seconds_harmonic = stepped.seconds_planning;
  out.dt = f.dt_s;
  out.step_share = f.dt_s / (stepped.critical_dt_s * std::sqrt(f.density_scaling));
  out.bytes = stepped.bytes;
  out.contacts = static_cast<std::int64_t>(n.prepared.network.contacts.size());
  out.seconds_by_hand = seconds_by_hand(c);
  return {out};
}

/// Returns the stepping time of the best settings that an expert who knows the exact result would find: single
/// precision, fixed geometry, one cycle from the steady start, a time step beyond the proven limit, and the density
/// scaling raised until the error is just below the tolerance. Only the stepping counts, because the steady start needs
/// the frequency-domain solution in both cases. Returns infinity if no run meets the tolerance.
double Runner::seconds_by_hand(const Case& asked) {
  Case hand = asked;
  hand.tolerance = std::nullopt;
  hand.precision = Precision::single;
  hand.geometry = Geometry::fixed;
  hand.step_share = 1.25;
  double best = std::numeric_limits<double>::infinity();
  for (; hand.density_scaling < 1e9; hand.density_scaling *= 1.08) {
    const Outcome found = run(hand).back();
    const double error = std::max(std::abs(found.found.e_star_pa / found.truth.e_star_pa - 1),
                                  std::abs(found.found.phase_deg - found.truth.phase_deg) * std::numbers::pi / 180);
    if (found.status != "done" || error > *asked.tolerance) break;
    best = std::min(best, found.seconds);
  }
  return best;
}

}  // namespace macadam::accuracy
