// SPDX-License-Identifier: GPL-3.0-or-later
// without_time.cpp  A law that lacks shortest_time(). It must not compile, and the compiler's message must name the
// missing member.
#include "macadam/laws/law.hpp"

struct Timeless {
  static constexpr const char* name = "timeless";
  double alpha = 0;
  int units() const { return 0; }
  double instantaneous() const { return 1; }
  template <class R>
  struct Step {
    static constexpr bool memoryless = false;
    template <int L, class S, class Units>
    S advance(S f, S dx, Units&&) const {
      return f + dx;
    }
  };
  template <class R>
  Step<R> step(double) const {
    return {};
  }
};

static_assert(macadam::laws::SteppableLaw<Timeless>);
