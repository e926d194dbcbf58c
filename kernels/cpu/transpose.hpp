// SPDX-License-Identifier: GPL-3.0-or-later
/// \file transpose.hpp  Transposes half lines of bodies (four words each) into SIMD packets, and back.
///
/// Gathering word by word costs one scalar load and one insertion per word, which takes several times as long as the
/// arithmetic of a contact. Loading half lines and transposing them with about two shuffles per packet takes a third of
/// the time of gathering.
#pragma once

#include <cstddef>

namespace macadam::kernels {

template <class R, std::size_t n>
struct WordsOf {
  typedef R type __attribute__((vector_size(n * sizeof(R))));
};
/// A vector of n words of R, in the compiler's own type; n is four or eight.
template <class R, std::size_t n>
using Words = typename WordsOf<R, n>::type;
/// Half of the line of a body (its data in one array): a vector (v, ω, u or θ) and one unused word.
template <class R>
using HalfLine = Words<R, 4>;

/// Returns, for every block of four words, four of the eight words of a's and b's blocks. The words i, j, k, l are
/// selected; 0 … 3 are words of a's block, and 4 … 7 are words of b's block.
template <int i, int j, int k, int l, class V>
inline __attribute__((always_inline)) V pick(const V& a, const V& b) {
  if constexpr (sizeof(V) == 4 * sizeof(a[0])) {
    return __builtin_shufflevector(a, b, i, j, k, l);
  } else {
    constexpr auto at = [](int w) { return w < 4 ? w : w + 4; };
    return __builtin_shufflevector(a, b, at(i), at(j), at(k), at(l), at(i) + 4, at(j) + 4, at(k) + 4, at(l) + 4);
  }
}

/// Transposes every block of four words: r[i][j] ↔ r[j][i]. Each pick() is one instruction. Floats and doubles need
/// different instructions, so the picks differ.
template <class V>
inline __attribute__((always_inline)) void transpose(V (&r)[4]) {
  if constexpr (sizeof(r[0][0]) == 4) {
    const V a = pick<0, 4, 1, 5>(r[0], r[1]), b = pick<2, 6, 3, 7>(r[0], r[1]);
    const V c = pick<0, 4, 1, 5>(r[2], r[3]), d = pick<2, 6, 3, 7>(r[2], r[3]);
    r[0] = pick<0, 1, 4, 5>(a, c), r[1] = pick<2, 3, 6, 7>(a, c);
    r[2] = pick<0, 1, 4, 5>(b, d), r[3] = pick<2, 3, 6, 7>(b, d);
  } else {
    const V a = pick<0, 4, 2, 6>(r[0], r[1]), b = pick<1, 5, 3, 7>(r[0], r[1]);
    const V c = pick<0, 4, 2, 6>(r[2], r[3]), d = pick<1, 5, 3, 7>(r[2], r[3]);
    r[0] = pick<0, 1, 4, 5>(a, c), r[1] = pick<0, 1, 4, 5>(b, d);
    r[2] = pick<2, 3, 6, 7>(a, c), r[3] = pick<2, 3, 6, 7>(b, d);
  }
}

/// Puts word w of all half lines into words[w].
template <class R, std::size_t lanes>
inline __attribute__((always_inline)) void turn(const HalfLine<R> (&half)[lanes], Words<R, lanes> (&words)[4]) {
  for (std::size_t j = 0; j < 4; ++j) {
    if constexpr (lanes == 4)
      words[j] = half[j];
    else
      words[j] = __builtin_shufflevector(half[j], half[j + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  }
  transpose(words);
}

/// Makes the half lines whose word w is in words[w].
template <class R, std::size_t lanes>
inline __attribute__((always_inline)) void turn_back(Words<R, lanes> (&words)[4], HalfLine<R> (&half)[lanes]) {
  transpose(words);
  for (std::size_t j = 0; j < 4; ++j) {
    if constexpr (lanes == 4) {
      half[j] = words[j];
    } else {
      half[j] = __builtin_shufflevector(words[j], words[j], 0, 1, 2, 3);
      half[j + 4] = __builtin_shufflevector(words[j], words[j], 4, 5, 6, 7);
    }
  }
}

}  // namespace macadam::kernels
