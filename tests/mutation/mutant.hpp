// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mutant.hpp  Which one of the mistakes that tests/mutation/campaign has put into the sources is made: that of
/// the environment's MUTANT, or none. The campaign compiles every source with this file before it.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace mutation {

inline constexpr int most = 4096;

/// Those whose place in the code was come by. Written down at the end where the environment's MUTANTS_REACHED names a
/// file.
struct Reached {
  bool at[most] = {};
  ~Reached() {
    const char* name = std::getenv("MUTANTS_REACHED");
    std::FILE* const out = name ? std::fopen(name, "a") : nullptr;
    if (!out) return;
    for (int n = 0; n < most; ++n)
      if (at[n]) std::fprintf(out, "%d\n", n);
    std::fclose(out);
  }
};
inline Reached reached;

inline int chosen() {
  static const int number = std::getenv("MUTANT") ? std::atoi(std::getenv("MUTANT")) : -1;
  return number;
}

/// Whether mistake `number` is made. Never where the compiler computes: what it needs must stay a constant.
constexpr bool on(int number) {
  if (__builtin_is_constant_evaluated()) return false;
  if (!reached.at[number]) reached.at[number] = true;
  return chosen() == number;
}

}  // namespace mutation
