// SPDX-License-Identifier: GPL-3.0-or-later
/// \file numeric.hpp  Defines vectors with three components, for code that is compiled for the CPU (components are
/// scalars or SIMD packs) and for devices (GPUs).
#pragma once

#include <cmath>

#if defined(__CUDACC__)
#define MACADAM_HD __host__ __device__ __forceinline__
#else
#define MACADAM_HD inline __attribute__((always_inline))
#endif

namespace macadam {

/// Returns a·b + c. On a device (GPU) the result is always rounded only once, so that different kernels compute the
/// same bits.
template <class R>
MACADAM_HD R multiply_add(R a, R b, R c) {
#ifdef __CUDA_ARCH__
  return fma(a, b, c);
#else
  return a * b + c;
#endif
}

/// A vector with three components. T is double, float or a SIMD pack of either.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  MACADAM_HD Vec3& operator+=(const Vec3& o) {
    x += o.x, y += o.y, z += o.z;
    return *this;
  }
  MACADAM_HD Vec3& operator-=(const Vec3& o) {
    x -= o.x, y -= o.y, z -= o.z;
    return *this;
  }
  friend MACADAM_HD Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend MACADAM_HD Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend MACADAM_HD Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend MACADAM_HD Vec3 operator*(const T& k, const Vec3& a) { return {k * a.x, k * a.y, k * a.z}; }
};

using Vec3d = Vec3<double>;

template <class T>
MACADAM_HD T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}

template <class T>
MACADAM_HD Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {multiply_add(a.y, b.z, -(a.z * b.y)), multiply_add(a.z, b.x, -(a.x * b.z)),
          multiply_add(a.x, b.y, -(a.y * b.x))};
}

/// Returns k·a + b.
template <class T>
MACADAM_HD Vec3<T> multiply_add(const T& k, const Vec3<T>& a, const Vec3<T>& b) {
  return {multiply_add(k, a.x, b.x), multiply_add(k, a.y, b.y), multiply_add(k, a.z, b.z)};
}

/// Returns the Euclidean length. For SIMD packs the square root is found by argument-dependent lookup.
template <class T>
MACADAM_HD T norm(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

}  // namespace macadam
