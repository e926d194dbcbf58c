// SPDX-License-Identifier: GPL-3.0-or-later
// course.cpp  The loop over samples of every stepped test.
#include "host/experiments/stepped/course.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/simulation/phases.hpp"
#include "host/stepping/divergence.hpp"
#include "macadam/ranks.hpp"

namespace macadam {
namespace {

/// Advances in pieces of some tenths of a second, so that a signal is answered soon however long a step takes.
class Pieces {
 public:
  /// Goes from one step to another and calls look() after each piece, once at least.
  void advance(Stepper& stepper, std::int64_t from, std::int64_t to, const std::function<void(std::int64_t)>& look) {
    do {
      const auto start = Clock::now();
      const std::int64_t piece = std::min(piece_, to - from);
      if (piece > 0) stepper.advance(piece);
      from += piece;
      const double seconds = of_first_rank(seconds_since(start));  // all take the same pieces
      if (piece == piece_ && seconds < 0.1) piece_ *= 2;
      if (seconds > 0.4) piece_ = std::max<std::int64_t>(1, piece_ / 2);
      look(from);
    } while (from < to);
  }

 private:
  std::int64_t piece_ = 16;
};

/// What is foretold of a run rests on so many seconds of it.
constexpr double first_seconds = 3;

}  // namespace

Courses::Courses(const Scene& scene, const Preparation& prepared, const Watcher& watcher, RunResult& result,
                 const std::filesystem::path& out, bool resumed, std::function<void(const std::string&)> warn)
    : watcher_(watcher),
      result_(result),
      warn_(std::move(warn)),
      checkpoints_(out / checkpoint_name, scene, prepared, result.backend, watcher.stop, warn_, resumed),
      fields_(scene, prepared, out) {}

void Courses::begin_fields(const std::string& name, int samples, double time) {
  const InPhase writing(result_.phases, &PhaseSeconds::writing);
  for (const std::string& gap : fields_.begin(name, samples, time)) warn_(gap);
}

void Courses::run(Stepper& stepper, const Course& course, ContactForm form, Geometry geometry) {
  const InPhase stepping(result_.phases, &PhaseSeconds::stepping);
  const auto start = Clock::now();
  std::int64_t step = stepper.observe().step;
  const std::int64_t begun = step, end = course.step_of(course.last);
  const std::int64_t every = watcher_.stepped ? watcher_.every : 0;
  bool told = !course.foretold;
  const auto speed = [&](std::int64_t now) { return static_cast<double>(now - begun) / seconds_since(start); };
  const auto look = [&](std::int64_t now) {
    if (!told && seconds_since(start) > first_seconds) {
      told = true;
      course.foretold(static_cast<double>(end - now) / speed(now));
    }
    const InPhase writing(result_.phases, &PhaseSeconds::writing);  // nearly nothing where no checkpoint is due
    checkpoints_.look(course.content, stepper, course.name);
  };
  Pieces pieces;
  for (std::int64_t k = course.first; k <= course.last; ++k) {
    const std::int64_t to = course.step_of(k);
    do {  // stops on the way where the watcher wants to be told
      const std::int64_t next = every > 0 ? std::min(to, (step / every + 1) * every) : to;
      pieces.advance(stepper, step, next, look);
      if (every > 0 && next > step && next % every == 0) watcher_.stepped(stepper, course.frequency);
      step = next;
    } while (step < to);
    const bool frame = fields_.wants(k);
    if (!frame && !course.taken(k)) continue;
    const Observation now = stepper.observe();
    require_convergence(stepper, now, course.name + ", dt = " + fmt::format("{:.6g} s", course.dt));
    course.take(k, now);
    if (frame) {
      const InPhase writing(result_.phases, &PhaseSeconds::writing);
      fields_.add(stepper, form, geometry, now.time);
    }
    if (watcher_.progress && step > 0) {
      watcher_.progress(course.shown(step, speed(step)), static_cast<double>(step) / static_cast<double>(end));
    }
  }
  const InPhase writing(result_.phases, &PhaseSeconds::writing);
  fields_.end();
}

}  // namespace macadam
