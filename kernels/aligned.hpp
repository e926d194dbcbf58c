// SPDX-License-Identifier: GPL-3.0-or-later
/// \file aligned.hpp  Vectors that start on a cache line, so that a packet's load never straddles two.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace macadam::kernels {

template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

/// Leaves numbers as they are found: a large array's pages are first touched by the threads that fill it.
template <class T>
struct RawAllocator : AlignedAllocator<T> {
  RawAllocator() = default;
  template <class U>
  RawAllocator(const RawAllocator<U>&) {}
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
};

template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace macadam::kernels
