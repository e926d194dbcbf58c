// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pack_item.hpp  The CPU's Item: a packet of eight contacts in SIMD registers (std::experimental::simd).
#pragma once

#include <experimental/simd>

#include "kernels/contact_forces.hpp"

namespace macadam::kernels {

namespace stdx = std::experimental;

struct PackItem {
  static constexpr std::size_t width = 8;
  template <class R>
  using Value = stdx::simd<R, stdx::simd_abi::deduce_t<R, width>>;

  static constexpr std::size_t lanes() { return width; }
  template <class R>
  static Value<R> load(const R* p) {
    return Value<R>(p, stdx::vector_aligned);
  }
  template <class R>
  static void store(R* p, const Value<R>& x) {
    x.copy_to(p, stdx::vector_aligned);
  }

  /// One word of all lanes that can be read and added to.
  template <class R>
  struct Ref {
    R* p;
    operator Value<R>() const { return load(p); }
    void operator+=(const Value<R>& x) const { store(p, load(p) + x); }
  };
  template <class R>
  static Ref<R> ref(R* p) {
    return {p};
  }

  template <class To, class From>
  static Value<To> convert(const From& x) {
    return stdx::static_simd_cast<Value<To>>(x);
  }
  template <class T>
  static T copysign_one(const T& z) {
    return stdx::copysign(T(1), z);
  }
  template <class Mask, class T>
  static T select(const Mask& mask, const T& yes, T no) {
    where(mask, no) = yes;
    return no;
  }

  /// Velocity and spin of one body a lane.
  template <class R>
  static Twist<Value<R>> twist(const R* velocity, const std::int32_t* body) {
    auto word = [&](std::size_t w) {
      return Value<R>([&](auto j) { return velocity[static_cast<std::size_t>(body[j]) * velocity_words + w]; });
    };
    return {{word(0), word(1), word(2)}, {word(4), word(5), word(6)}};
  }

  /// u_b − u_a, subtracted before it is rounded to To.
  template <class To, class R>
  static Vec3<Value<To>> relative(const R* displacement, const std::int32_t* a, const std::int32_t* b) {
    auto word = [&](std::size_t w) {
      return Value<To>([&](auto j) {
        return static_cast<To>(displacement[static_cast<std::size_t>(b[j]) * displacement_words + w] -
                               displacement[static_cast<std::size_t>(a[j]) * displacement_words + w]);
      });
    };
    return {word(0), word(1), word(2)};
  }
};

}  // namespace macadam::kernels
