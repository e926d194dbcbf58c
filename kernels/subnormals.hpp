// SPDX-License-Identifier: GPL-3.0-or-later
/// \file subnormals.hpp  Numbers below 1e-38 of single precision are zero while steps run.
#pragma once

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace macadam::kernels {

/// Area moments of slivers, and waves that have hardly begun, are of this size: nothing next to rounding, but some
/// processors take a hundred times as long for them. Of the thread that makes it, for as long as it lives.
template <bool wanted>
class SubnormalsAreZero {
 public:
  SubnormalsAreZero(const SubnormalsAreZero&) = delete;
#ifdef __SSE2__
  SubnormalsAreZero() : before_(_mm_getcsr()) {
    if (wanted) _mm_setcsr(before_ | 0x8040);  // results and operands
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
