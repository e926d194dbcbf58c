// SPDX-License-Identifier: GPL-3.0-or-later
/// \file aligned.hpp  Allocates vectors that start on a cache line, so that reading a SIMD register never crosses from
/// one line to the next.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstring>
#include <new>
#include <vector>

namespace macadam::kernels {

/// Allocates memory aligned to 64 bytes.
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

/// Leaves new numbers uninitialised, so that the pages of a large array are first touched by the threads that fill it.
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

/// Allocates zeros without writing them. A large array consists of pages of the operating system, which provides a
/// zeroed page only when the page is first written, in memory near the processor that writes it. Until then the page
/// takes no memory. Builds with the address sanitizer write the zeros instead, because the sanitizer can then guard the
/// ends of the array.
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

/// A vector whose elements are zero if it is made with a size. Elements that resize() adds are not zero; assign a new
/// vector instead of resizing.
template <class T>
using ZeroVector = std::vector<T, ZeroAllocator<T>>;

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace macadam::kernels
