// SPDX-License-Identifier: GPL-3.0-or-later
// monotonic.cpp  Kind "monotonic": stress under a strain that grows evenly.
#include <fmt/format.h>

#include "host/experiments/loaded/load_test.hpp"
#include "host/experiments/read_points.hpp"
#include "macadam/drives/constant_rate.hpp"

namespace macadam {

using experiments::Monotonic;
using experiments::ResponsePoint;

template <>
Monotonic ExperimentOf<Monotonic>::read(const scene::Section& section) {
  using namespace scene;
  constexpr Rule rule{[](double v) { return v != 0; }, "a rate that is not 0"};
  constexpr Rule any{[](double v) { return v != 0 && v > -1; }, "a strain above -1 that is not 0"};
  constexpr int usual_points = 100;
  Monotonic out;
  Points times;
  std::optional<double> strain;
  std::vector<Key> keys = times.keys("times", duration, Need::optional);
  keys.insert(keys.end(),
              {kind_key(),
               poisson_key(out.poisson_ratio),
               {"rate", Need::required, into(out.rate, scene::rate, rule), "of the strain; tension positive"},
               {"strain", Need::optional, into(strain, ratio, any),
                "at which the test ends, in place of times; its sign is that of the rate", "times"}});
  section.read(keys);
  if (!strain) {
    if (!section.has("times")) section.refuse("times", "nothing", "times, or the strain at which the test ends");
    out.times = times.all(section, "times", "s", "time");
    return out;
  }
  for (const char* key : {"times", "points_per_decade"}) {
    if (section.has(key)) section.refuse(key, std::string(key) + " beside strain", "one of them");
  }
  const double end = *strain / out.rate;
  if (!(end > 0)) section.refuse("strain", fmt::format("{} at a rate of {} 1/s", *strain, out.rate), "the rate's sign");
  const int points = times.evenly.value_or(usual_points);
  for (int i = 1; i <= points; ++i) out.times.push_back(end * i / points);
  return out;
}

LoadTest load_test(const Monotonic& spec) {
  const double end = spec.times.back();
  LoadTest out;
  out.kind = spec.kind;
  out.history = {spec.times, {{0, end}}};
  out.poisson_ratio = spec.poisson_ratio;
  out.load = {{"rate_1_s", spec.rate}};
  out.grows = true;
  out.strain = spec.rate * end;
  out.unstepped = [spec](const Spectrum& spectrum, double t) -> ResponsePoint {
    const double secant = spectrum.relaxation.after_ramp(t, t), strain = spec.rate * t;
    return {t, strain, secant * strain, secant};
  };
  out.drive = [spec, end](double unit, double dt, double) {
    return std::make_shared<drives::ConstantRate>(unit * spec.rate, dt, end);
  };
  return out;
}

template <>
std::unique_ptr<Solution> ExperimentOf<Monotonic>::plan(const Monotonic& spec, const Scene& scene,
                                                        const Preparation& prepared, const Watcher& watcher,
                                                        std::optional<Resumed> resumed, RunResult& result) {
  return plan_load_test(load_test(spec), scene, prepared, watcher, std::move(resumed), result);
}

}  // namespace macadam
