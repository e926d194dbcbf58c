// SPDX-License-Identifier: GPL-3.0-or-later
/// \file pack_item.hpp  Gives access to a packet of contacts in SIMD registers (std::experimental::simd). It is the
/// Item of contact_step.hpp for the CPU.
#pragma once

#include <algorithm>
#include <experimental/simd>

#include "kernels/contact/contact_step.hpp"
#include "kernels/cpu/transpose.hpp"

namespace macadam::kernels {

namespace stdx = std::experimental;

/// Contacts per packet: the SIMD width of the geometry type, in which most of a step is computed, but at least 4 and at
/// most 8. It is a multiple of four, because the eight words of a body are loaded in two halves of four words.
template <class P>
inline constexpr std::size_t packet_width = std::clamp<std::size_t>(stdx::native_simd<typename P::Geometry>::size(), 4,
                                                                    8);

/// Loads, converts and stores the words of a packet of `width` contacts.
template <std::size_t width>
struct PackItem {
  static_assert(width == 4 || width == 8);
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

  /// Refers to one word of all lanes; the word can be read and added to.
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

  /// Returns velocity and spin of one body per lane.
  template <class R>
  static Twist<Value<R>> twist(const R* velocity, const std::int32_t* body) {
    return {gather<R>(velocity, body), gather<R>(velocity + velocity_words / 2, body)};
  }

  /// vector() returns the vector u of one body per lane. relative() returns u_b − u_a. The difference is computed
  /// before it is rounded to type To. `u` points to the vector of the first body.
  template <class To, class R>
  static Vec3<Value<To>> vector(const R* u, const std::int32_t* body) {
    return gather<To>(u, body);
  }
  template <class To, class R>
  static Vec3<Value<To>> relative(const R* u, const std::int32_t* a, const std::int32_t* b) {
    return gather<To>(u, b, a);
  }

  /// Adds one vector per lane to line `line[j]` of `sums`, which points to the first line. A line is the eight words of
  /// a body.
  template <class R, class T>
  static void scatter_add(R* sums, const std::uint32_t* line, const Vec3<T>& vector) {
    using From = typename T::value_type;
    if constexpr (one_register<From>) {
      Words<From, width> zero{};
      // Hides the value from gcc 12. If gcc knows that this vector is zero, it may leave other numbers in the unused
      // word of a line; checkpoints of processors of different packet widths would then differ.
#ifdef __x86_64__
      asm("" : "+x"(zero));
#endif
      Words<From, width> words[4] = {to_words<From>(vector.x), to_words<From>(vector.y), to_words<From>(vector.z),
                                     zero};
      HalfLine<From> half[width];
      turn_back<From, width>(words, half);
      for (std::size_t j = 0; j < width; ++j) {
        *reinterpret_cast<HalfLine<R>*>(sums + line[j] * line_words) += __builtin_convertvector(half[j], HalfLine<R>);
      }
    } else {
      const T* components[3] = {&vector.x, &vector.y, &vector.z};
      for (std::size_t w = 0; w < 3; ++w) {
        From words[width];
        components[w]->copy_to(words, stdx::element_aligned);
        for (std::size_t j = 0; j < width; ++j) sums[line[j] * line_words + w] += static_cast<R>(words[j]);
      }
    }
  }

 private:
  static constexpr std::size_t line_words = 8;
  static_assert(velocity_words == line_words && displacement_words == line_words);

  /// Whether a packet of R fits in one register. gcc 12 keeps wider vectors in memory and moves their words one by one.
  template <class R>
  static constexpr bool one_register = width * sizeof(R) <= sizeof(stdx::native_simd<R>);

  /// Converts a packet to a vector type of the compiler, and back.
  template <class R>
  static Words<R, width> to_words(const Value<R>& x) {
    Words<R, width> words;
    x.copy_to(reinterpret_cast<R*>(&words), stdx::vector_aligned);
    return words;
  }
  template <class R>
  static Value<R> to_pack(const Words<R, width>& words) {
    return Value<R>(reinterpret_cast<const R*>(&words), stdx::vector_aligned);
  }

  /// Returns u of one body per lane, minus u of the bodies `minus` if they are given.
  template <class To, class R, class... Bodies>
  static Vec3<Value<To>> gather(const R* u, const std::int32_t* body, Bodies... minus) {
    auto line = [u](std::int32_t i) { return u + static_cast<std::size_t>(i) * line_words; };
    if constexpr (one_register<To>) {
      auto half_line = [&](std::int32_t i) { return *reinterpret_cast<const HalfLine<R>*>(line(i)); };
      HalfLine<To> half[width];
      for (std::size_t j = 0; j < width; ++j) {
        half[j] = __builtin_convertvector((half_line(body[j]) - ... - half_line(minus[j])), HalfLine<To>);
      }
      Words<To, width> words[4];
      turn<To, width>(half, words);
      return {to_pack<To>(words[0]), to_pack<To>(words[1]), to_pack<To>(words[2])};
    } else {
      auto word = [&](std::size_t w) {
        return Value<To>([&](auto j) { return static_cast<To>((line(body[j])[w] - ... - line(minus[j])[w])); });
      };
      return {word(0), word(1), word(2)};
    }
  }
};

}  // namespace macadam::kernels
