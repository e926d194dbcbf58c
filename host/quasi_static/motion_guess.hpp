// SPDX-License-Identifier: GPL-3.0-or-later
/// \file motion_guess.hpp  Guesses the motion of the next increment from the last two.
#pragma once

#include <vector>

#include "host/quasi_static/newton.hpp"

namespace macadam::quasi_static {

/// Guesses how the particles move in the next increment. An increment has a measure: the displacement of the top wall,
/// its duration if the load is given, or the opening of cracks. The motion per measure is that of the last increment,
/// or it continues the change between the last two increments if this would have guessed the last increment better.
class MotionGuess {
 public:
  /// An increment: its duration [s], 0 if there was none, the displacement of the top wall [m], the opening of cracks
  /// (QuasiStatic::last_opening()) [m], and the motion of the particles [6·particles].
  struct Past {
    double dt = 0, wall = 0, opening = 0;
    Vector motion;
  };

  explicit MotionGuess(std::size_t particles);

  /// Sets the motion in `trial` and, if the increment does not give it, the displacement of the top wall.
  void guess(const WallIncrement& next, Trial& trial) const;
  /// Takes over an accepted increment. `opening`: as QuasiStatic::last_opening() after it.
  void accept(const WallIncrement& increment, const Trial& trial, double opening);

  const Past& last() const { return last_; }
  const Past& before() const { return before_; }
  bool continues_change() const { return continues_change_; }
  void set(Past last, Past before, bool continues_change);

 private:
  Past last_, before_;
  bool continues_change_ = false;
};

}  // namespace macadam::quasi_static
