// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pack_item.hpp  The CPU's Item: a packet of eight contacts in SIMD registers (std::experimental::simd).
#pragma once

#include <experimental/simd>

#include "kernels/contact_forces.hpp"
#include "kernels/transpose.hpp"

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

  /// The same eight words as a vector of the compiler's, and back (a packet may be made of several registers).
  template <class R>
  static void to_line(const Value<R>& x, Line<R>& line) {
    x.copy_to(reinterpret_cast<R*>(&line), stdx::vector_aligned);
  }
  template <class R>
  static Value<R> to_pack(const Line<R>& line) {
    return Value<R>(reinterpret_cast<const R*>(&line), stdx::vector_aligned);
  }

  /// Velocity and spin of one body a lane.
  template <class R>
  static Twist<Value<R>> twist(const R* velocity, const std::int32_t* body) {
    Line<R> r[8];
    for (std::size_t j = 0; j < 8; ++j) {
      r[j] = *reinterpret_cast<const Line<R>*>(velocity + static_cast<std::size_t>(body[j]) * velocity_words);
    }
    transpose<R>(r);
    return {{to_pack<R>(r[0]), to_pack<R>(r[1]), to_pack<R>(r[2])},
            {to_pack<R>(r[4]), to_pack<R>(r[5]), to_pack<R>(r[6])}};
  }

  /// u of one body a lane, and u_b − u_a, subtracted before it is rounded to To; `u` points to the first body's.
  template <class To, class R>
  static Vec3<Value<To>> vector(const R* u, const std::int32_t* body) {
    HalfLine<R> lines[8];
    for (std::size_t j = 0; j < 8; ++j) lines[j] = half_line(u, body[j]);
    return turned<To, R>(lines);
  }
  template <class To, class R>
  static Vec3<Value<To>> relative(const R* u, const std::int32_t* a, const std::int32_t* b) {
    HalfLine<R> lines[8];
    for (std::size_t j = 0; j < 8; ++j) lines[j] = half_line(u, b[j]) - half_line(u, a[j]);
    return turned<To, R>(lines);
  }

 private:
  template <class R>
  static HalfLine<R> half_line(const R* u, std::int32_t body) {
    return *reinterpret_cast<const HalfLine<R>*>(u + static_cast<std::size_t>(body) * displacement_words);
  }
  template <class To, class R>
  static Vec3<Value<To>> turned(const HalfLine<R> (&lines)[8]) {
    Line<R> words[3];
    transpose_three<R>(lines, words);
    return {convert<To>(to_pack<R>(words[0])), convert<To>(to_pack<R>(words[1])), convert<To>(to_pack<R>(words[2]))};
  }
};

}  // namespace macadam::kernels
