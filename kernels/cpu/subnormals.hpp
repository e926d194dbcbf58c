// SPDX-License-Identifier: GPL-3.0-or-later
/// \file subnormals.hpp  Treats numbers below 1e-38 (single precision) as zero while steps run.
#pragma once

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace macadam::kernels {

/// While it lives, subnormal numbers are zero in the thread that made it. The area moments of slivers, and waves that
/// have hardly begun, are of this size. They are smaller than rounding errors, but some processors take a hundred times
/// as long to compute with them.
template <bool wanted>
class SubnormalsAreZero {
 public:
  SubnormalsAreZero(const SubnormalsAreZero&) = delete;
#ifdef __SSE2__
  SubnormalsAreZero() : before_(_mm_getcsr()) {
    if (wanted) _mm_setcsr(before_ | 0x8040);  // both results and operands
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
