// SPDX-License-Identifier: GPL-3.0-or-later
/// \file motion_guess.hpp  Guesses the motion of the next increment from the last two.
#pragma once

#include <vector>

#include "host/quasi_static/newton.hpp"

namespace macadam::quasi_static {

/// Guesses how the particles move in the next increment: as in the last one, in proportion to the displacement of the
/// top wall. Under a given load the motion is in proportion to the duration, and in a test that the opening of cracks
/// controls, in proportion to this opening. If the motion per displacement changed steadily in the last increments, the
/// guess continues this change.
class MotionGuess {
 public:
  /// An accepted increment.
  struct Past {
    double dt = 0;       ///< duration [s]; 0: there was no increment yet
    double wall = 0;     ///< displacement of the top wall [m]
    double opening = 0;  ///< of cracks, see QuasiStatic::last_opening() [m]
    Vector motion;       ///< of the particles [6·particles]
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
  bool continues_change_ = false;  ///< whether this would have guessed the last increment better
};

}  // namespace macadam::quasi_static
