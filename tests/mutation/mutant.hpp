// SPDX-License-Identifier: GPL-3.0-or-later
/// \file mutant.hpp  Selects which of the mutants that tests/mutation/campaign put into the sources is active: the
/// number in the environment variable MUTANT, or none. The campaign compiles every source with this file included
/// first.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace mutation {

inline constexpr int most = 4096;

/// The mutants whose code was reached. At exit their numbers are appended to the file that the environment variable
/// MUTANTS_REACHED names.
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

/// Returns whether mutant `number` is active. Always false in constant evaluation, so that constant expressions stay
/// constant.
constexpr bool on(int number) {
  if (__builtin_is_constant_evaluated()) return false;
  if (!reached.at[number]) reached.at[number] = true;
  return chosen() == number;
}

}  // namespace mutation
