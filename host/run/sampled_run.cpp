// SPDX-License-Identifier: GPL-3.0-or-later
// sampled_run.cpp  Runs the loop over samples for every experiment that is stepped in time. Steps are taken in pieces
// that last some tenths of a second of wall time; after each piece the run checks whether it must stop or write a
// checkpoint. If nothing but an observation is made at each sample, one call of the stepper covers several samples.
#include "host/run/sampled_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/run/phases.hpp"
#include "host/stepping/divergence.hpp"
#include "macadam/piecewise_stepper.hpp"

namespace macadam {
namespace {

/// The remaining time of a run is predicted after this many seconds.
constexpr double first_seconds = 3;
/// No stepper takes more samples than this in one call.
constexpr std::int64_t most_samples = 64;

}  // namespace

SampledRuns::SampledRuns(const Scene& scene, const Preparation& prepared, const Watcher& watcher, RunResult& result,
                         const std::filesystem::path& out, bool resumed, std::function<void(const std::string&)> warn)
    : watcher_(watcher),
      result_(result),
      warn_(std::move(warn)),
      checkpoints_(out / checkpoint_name, scene, prepared, result.backend, watcher.stop, warn_, resumed),
      fields_(scene, prepared, out) {}

void SampledRuns::begin_fields(const std::string& name, int samples, double time) {
  const InPhase writing(result_.phases, &PhaseSeconds::writing);
  for (const std::string& gap : fields_.begin(name, samples, time)) warn_(gap);
}

void SampledRuns::run(Stepper& stepper, const Course& course, ContactForm form, Geometry geometry) {
  const InPhase stepping(result_.phases, &PhaseSeconds::stepping);
  const auto start = Clock::now();
  std::int64_t step = stepper.observe().step;
  const std::int64_t begun = step, end = course.step_of(course.last);
  const std::int64_t every = watcher_.stepped ? watcher_.every : 0, between = course.between_every;
  bool is_reported = !course.report_remaining;
  const auto speed = [&](std::int64_t now) { return static_cast<double>(now - begun) / seconds_since(start); };
  const auto look = [&](std::int64_t now) {
    if (!is_reported && seconds_since(start) > first_seconds) {
      is_reported = true;
      course.report_remaining(static_cast<double>(end - now) / speed(now));
    }
    this->look(stepper, course);
  };
  bool ended = false;
  const auto take = [&](std::int64_t k, const Sample& sample) {
    require_convergence(sample, course.name + ", dt = " + fmt::format("{:.6g} s", course.dt));
    course.take(k, sample.now);
    ended = course.ended && course.ended();
    if (fields_.wants(k) || (ended && fields_.begun())) {
      const InPhase writing(result_.phases, &PhaseSeconds::writing);
      fields_.add(stepper, form, geometry, sample.now.time);
    }
    if (watcher_.progress && step > 0) {
      watcher_.progress(course.shown(step, speed(step)), static_cast<double>(step) / static_cast<double>(end));
    }
  };
  const auto needs_stepper = [&](std::int64_t k) {
    return fields_.wants(k) || (course.uses_stepper && course.uses_stepper(k));
  };
  // Returns how many samples directly after sample k can be taken in the same call of the stepper. These samples need
  // only an observation, and they follow one another at a constant distance: the distance of sample k from the current
  // step.
  const auto alike = [&](std::int64_t k) {
    const std::int64_t most = every > 0 ? 0 : most_samples;
    const std::int64_t distance = course.step_of(k) - step;
    std::int64_t n = 0;
    while (n < most && k + n < course.last && !needs_stepper(k + n) && course.taken(k + n + 1) &&
           course.step_of(k + n + 1) - course.step_of(k + n) == distance)
      ++n;
    return n;
  };
  if (between > 0 && step % between == 0) course.between(stepper.observe());
  PiecewiseStepper pieces(stepper);
  for (std::int64_t k = course.first; k <= course.last && !ended;) {
    const std::int64_t to = course.step_of(k);
    // stops between samples to call functions of the watcher and of the course
    while ((every > 0 || between > 0) && step < to) {
      std::int64_t next = to;
      for (const std::int64_t n : {every, between}) next = n > 0 ? std::min(next, (step / n + 1) * n) : next;
      if (every == 0 && next - step == between) {  // these observations follow one another at a constant distance
        const std::int64_t more = std::min(most_samples, (to - step) / between) - 1;
        for (const Sample& sample : pieces.sample(step, next, more, look)) {
          step = sample.now.step;
          course.between(sample.now);
        }
        look(step);
        continue;
      }
      pieces.advance(step, next, look);
      if (every > 0 && next % every == 0) watcher_.stepped(stepper, course.frequency);
      if (between > 0 && next % between == 0) course.between(stepper.observe());
      step = next;
    }
    if (!fields_.wants(k) && !course.taken(k)) {
      pieces.advance(step, to, look);
      step = to, ++k;
      continue;
    }
    const std::vector<Sample> samples = pieces.sample(step, to, alike(k), look);
    for (const Sample& sample : samples) {
      step = sample.now.step;
      if (&sample == &samples.back()) look(step);
      take(k++, sample);
    }
  }
  const InPhase writing(result_.phases, &PhaseSeconds::writing);
  fields_.end();
}

void SampledRuns::look(const Stepper& stepper, const Course& course) {
  // this takes a noticeable time only when a checkpoint is written
  const InPhase writing(result_.phases, &PhaseSeconds::writing);
  checkpoints_.look(course.content, stepper, course.name);
}

}  // namespace macadam
