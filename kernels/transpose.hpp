// SPDX-License-Identifier: GPL-3.0-or-later
/// \file transpose.hpp  Eight lines of eight words turned in registers: bodies' records to SIMD packets and back.
///
/// Gathering word by word costs a scalar load and an insertion a word, several times what the arithmetic of a contact
/// does; a whole line a body and 24 shuffles cost a third of it.
#pragma once

#include <cstddef>

namespace macadam::kernels {

template <class R>
struct LineOf {
  typedef R type __attribute__((vector_size(8 * sizeof(R))));
};
/// Eight words of R as one vector (gcc lowers it to what the processor has).
template <class R>
using Line = typename LineOf<R>::type;

template <class R>
struct HalfLineOf {
  typedef R type __attribute__((vector_size(4 * sizeof(R))));
};
/// Four words of R as one vector.
template <class R>
using HalfLine = typename HalfLineOf<R>::type;

/// lines[i][j] ↔ lines[j][i], by swapping blocks of one, two and four words.
template <class R>
inline __attribute__((always_inline)) void transpose(Line<R> (&r)[8]) {
  for (int i = 0; i < 8; i += 2) {
    const Line<R> a = r[i], b = r[i + 1];
    r[i] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    r[i + 1] = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 4; ++k) {
    const int i = k / 2 * 4 + k % 2;
    const Line<R> a = r[i], b = r[i + 2];
    r[i] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    r[i + 2] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int i = 0; i < 4; ++i) {
    const Line<R> a = r[i], b = r[i + 4];
    r[i] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
    r[i + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// The first three words of eight half lines, as three lines.
template <class R>
inline __attribute__((always_inline)) void transpose_three(const HalfLine<R> (&half)[8], Line<R> (&out)[3]) {
  Line<R> r[4];  // lines j and j + 4 side by side
  for (int j = 0; j < 4; ++j) r[j] = __builtin_shufflevector(half[j], half[j + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  const Line<R> a = __builtin_shufflevector(r[0], r[1], 0, 8, 2, 10, 4, 12, 6, 14);
  const Line<R> b = __builtin_shufflevector(r[0], r[1], 1, 9, 3, 11, 5, 13, 7, 15);
  const Line<R> c = __builtin_shufflevector(r[2], r[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Line<R> d = __builtin_shufflevector(r[2], r[3], 1, 9, 3, 11, 5, 13, 7, 15);
  out[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
  out[1] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
  out[2] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
}

}  // namespace macadam::kernels
