// SPDX-License-Identifier: GPL-3.0-or-later
/// \file lane_item.hpp  Gives a thread access to the one contact of a packet of 32 that it steps.
#pragma once

#include <cuda_runtime.h>

#include "kernels/contact/contact_step.hpp"

namespace macadam::kernels {

/// Loads three numbers by loads of 16 bytes; `p` is aligned to 16 bytes.
__device__ __forceinline__ Vec3<float> load_vec3(const float* p) {
  const float4 v = __ldg(reinterpret_cast<const float4*>(p));
  return {v.x, v.y, v.z};
}
__device__ __forceinline__ Vec3<double> load_vec3(const double* p) {
  const double2 v = __ldg(reinterpret_cast<const double2*>(p)), w = __ldg(reinterpret_cast<const double2*>(p + 2));
  return {v.x, v.y, w.x};
}

/// Loads and stores the words of the contact in lane `lane` of a packet of 32. It is the Item of contact_step.hpp on
/// the GPU.
struct LaneItem {
  std::uint32_t lane;
  template <class R>
  using Value = R;
  static constexpr bool staged = true;  ///< all chains of a contact are loaded before the first is stored

  MACADAM_HD static constexpr std::size_t lanes() { return 32; }
  // The words of a contact are used once per step. Streaming loads are used so that these words do not push bodies and
  // load records out of the cache.
  template <class R>
  __device__ __forceinline__ R load(const R* p) const {
    return __ldcs(p + lane);
  }
  template <class R>
  __device__ __forceinline__ void store(R* p, R x) const {
    __stcs(p + lane, x);
  }
  template <class R>
  MACADAM_HD R& ref(R* p) const {
    return p[lane];
  }
  template <class To, class From>
  MACADAM_HD static To convert(From x) {
    return static_cast<To>(x);
  }
  MACADAM_HD static double copysign_one(double z) { return ::copysign(1.0, z); }
  MACADAM_HD static float copysign_one(float z) { return ::copysignf(1.0f, z); }
  template <class T>
  MACADAM_HD static T select(bool mask, T yes, T no) {
    return mask ? yes : no;
  }
  template <class R>
  __device__ __forceinline__ Twist<R> twist(const R* velocity, const std::int32_t* body) const {
    const R* v = velocity + static_cast<std::size_t>(body[lane]) * velocity_words;
    return {load_vec3(v), load_vec3(v + 4)};
  }
  template <class To, class R>
  __device__ __forceinline__ Vec3<To> vector(const R* displacement, const std::int32_t* body) const {
    const Vec3<R> u = load_vec3(displacement + static_cast<std::size_t>(body[lane]) * displacement_words);
    return {static_cast<To>(u.x), static_cast<To>(u.y), static_cast<To>(u.z)};
  }
  template <class To, class R>
  __device__ __forceinline__ Vec3<To> relative(const R* displacement, const std::int32_t* a,
                                               const std::int32_t* b) const {
    const Vec3<R> ua = load_vec3(displacement + static_cast<std::size_t>(a[lane]) * displacement_words);
    const Vec3<R> ub = load_vec3(displacement + static_cast<std::size_t>(b[lane]) * displacement_words);
    const Vec3<R> d = ub - ua;
    return {static_cast<To>(d.x), static_cast<To>(d.y), static_cast<To>(d.z)};
  }
};

}  // namespace macadam::kernels
