// SPDX-License-Identifier: GPL-3.0-or-later
// motion_guess.cpp  Extrapolates the motions of the last two increments.
#include "host/quasi_static/motion_guess.hpp"

#include <algorithm>

#include "kernels/base/parallel.hpp"

namespace macadam::quasi_static {
namespace {

constexpr std::size_t top_wall = wall_index(wall_z_hi);
/// If the wall moves by more than this many times its last displacement, the motion is not guessed.
constexpr double most_growth = 10;

/// The guess is last·(motion of the last increment) + before·(motion of the increment before).
struct Factors {
  double last = 0, before = 0;
};

/// Returns the ratio of the next increment to `past`, by the quantity that the motion is in proportion to; 0: the
/// motion cannot be guessed from `past`.
double factor_of(const MotionGuess::Past& past, const WallIncrement& next) {
  if (past.dt == 0) return 0;
  if (next.opening) return past.opening > 0 ? std::clamp(*next.opening / past.opening, 0.0, 2.0) : 0;
  const double now = next.wall[top_wall].z;
  if (next.load || (past.wall == 0 && now == 0)) return next.dt / past.dt;
  const double factor = past.wall != 0 ? now / past.wall : 0;
  return factor > 0 && factor < most_growth ? factor : 0;
}

/// Returns the factors of a guess that continues the change of the motion. `last`, `before`: ratios of the next
/// increment to the last two ones. The motion divided by the length of an increment is the rate in its middle; the rate
/// of the next increment follows by a straight line through the other two.
Factors changing(double last, double before) {
  // lengths of the last two increments; the next one has length 1
  const double a1 = 1 / last, a2 = 1 / before, change = (1 + a1) / (a1 + a2);
  return {last * (1 + change), -before * change};
}

}  // namespace

MotionGuess::MotionGuess(std::size_t particles) {
  last_.motion.assign(6 * particles, 0.0);
  before_.motion = last_.motion;
}

void MotionGuess::guess(const WallIncrement& next, Trial& trial) const {
  Factors by{factor_of(last_, next), 0};
  const double before = next.opening ? 0 : factor_of(before_, next);
  if (continues_change_ && by.last > 0 && before > 0) by = changing(by.last, before);
  trial.motion.resize(last_.motion.size());
  for_each_of(trial.motion.size(),
              [&](std::size_t i) { trial.motion[i] = by.last * last_.motion[i] + by.before * before_.motion[i]; });
  if (next.load || next.opening) trial.wall[top_wall].z = by.last * last_.wall + by.before * before_.wall;
}

void MotionGuess::accept(const WallIncrement& increment, const Trial& trial, double opening) {
  const double last = factor_of(last_, increment), before = factor_of(before_, increment);
  continues_change_ = false;
  if (!increment.opening && last > 0 && before > 0) {
    const Factors by = changing(last, before);
    const auto error = [&](double of_last, double of_before) {
      return sum_in_parallel<double>(trial.motion.size(), [&](std::size_t i) {
        const double wrong = trial.motion[i] - of_last * last_.motion[i] - of_before * before_.motion[i];
        return i % 6 < 3 ? wrong * wrong : 0.0;  // displacements; rotations have another unit
      });
    };
    continues_change_ = error(by.last, by.before) < error(last, 0);
  }
  std::swap(before_, last_);
  last_.dt = increment.dt, last_.wall = trial.wall[top_wall].z, last_.opening = opening;
  last_.motion = trial.motion;
}

void MotionGuess::set(Past last, Past before, bool continues_change) {
  last_ = std::move(last), before_ = std::move(before), continues_change_ = continues_change;
}

}  // namespace macadam::quasi_static
