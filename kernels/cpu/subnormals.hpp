// SPDX-License-Identifier: GPL-3.0-or-later
/// \file subnormals.hpp  Treats numbers below 1e-38 (single precision) as zero while steps run.
#pragma once

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace macadam::kernels {

/// While an object of this class lives, the thread that made it treats subnormal numbers as zero. The area moments of
/// very thin facets, and the motions at the front of a wave, are that small. These numbers are smaller than rounding
/// errors, but some processors take a hundred times as long to compute with them.
template <bool wanted>
class SubnormalsAreZero {
 public:
  SubnormalsAreZero(const SubnormalsAreZero&) = delete;
#ifdef __SSE2__
  SubnormalsAreZero() : before_(_mm_getcsr()) {
    if (wanted) _mm_setcsr(before_ | 0x8040);  // two bits: for subnormal results, and for subnormal operands
  }
  ~SubnormalsAreZero() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#else
  SubnormalsAreZero() {}
  ~SubnormalsAreZero() {}
#endif
};

}  // namespace macadam::kernels
