// SPDX-License-Identifier: GPL-3.0-or-later
/// \file aligned.hpp  Vectors that start on a cache line, so that a packet's load never straddles two.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstring>
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

/// Zero without being touched: what is large comes as pages that the system makes when they are first written, near the
/// processor that does, and that take no memory until then. Not where the address sanitizer guards the ends of arrays.
template <class T>
struct ZeroAllocator : RawAllocator<T> {
  ZeroAllocator() = default;
  template <class U>
  ZeroAllocator(const ZeroAllocator<U>&) {}
  T* allocate(std::size_t n) {
    if (!by_pages(n)) return static_cast<T*>(std::memset(RawAllocator<T>::allocate(n), 0, n * sizeof(T)));
    void* p = ::mmap(nullptr, n * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) throw std::bad_alloc();
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) {
    if (by_pages(n))
      ::munmap(p, n * sizeof(T));
    else
      RawAllocator<T>::deallocate(p, n);
  }

 private:
  static constexpr bool by_pages(std::size_t n) {
#ifdef __SANITIZE_ADDRESS__
    static_cast<void>(n);
    return false;
#else
    return n * sizeof(T) >= std::size_t{1} << 20;
#endif
  }
};

template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

/// All zero when it is made with a size. What is resized afterwards is not: assign a new one.
template <class T>
using ZeroVector = std::vector<T, ZeroAllocator<T>>;

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace macadam::kernels
