// SPDX-License-Identifier: GPL-3.0-or-later
/// \file packet.hpp  Defines packets of complex numbers that a processor multiplies and adds at once.
#pragma once

#include <complex>
#include <cstddef>
#include <cstring>
#include <utility>

namespace macadam::continuum {

#if defined(__AVX512F__)
constexpr std::size_t packet_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t packet_bytes = 32;
#else
constexpr std::size_t packet_bytes = 16;
#endif

/// A packet of complex numbers: real and imaginary parts alternate.
template <class T>
struct Packet {
  static constexpr std::size_t words = packet_bytes / sizeof(T);  ///< real numbers per packet
  static constexpr std::size_t numbers = words / 2;               ///< complex numbers per packet
  typedef T Words __attribute__((vector_size(packet_bytes)));
  Words w;

  static Packet load(const std::complex<T>* from) {
    Packet out;
    std::memcpy(&out.w, from, packet_bytes);
    return out;
  }
  void store(std::complex<T>* to) const { std::memcpy(static_cast<void*>(to), &w, packet_bytes); }
  Packet operator+(const Packet& b) const { return {w + b.w}; }
  Packet operator-(const Packet& b) const { return {w - b.w}; }
  Packet operator*(T factor) const { return {w * factor}; }
};

/// Factors of a product with a packet of complex numbers: their real parts twice, and their imaginary parts with both
/// signs.
template <class T>
class PacketFactor {
 public:
  explicit PacketFactor(const Packet<T>& of) : PacketFactor(of, std::make_index_sequence<Packet<T>::words>()) {}
  Packet<T> operator*(const Packet<T>& b) const { return multiply(b, std::make_index_sequence<Packet<T>::words>()); }

 private:
  template <std::size_t... I>
  PacketFactor(const Packet<T>& of, std::index_sequence<I...>)
      : real_{__builtin_shufflevector(of.w, of.w, int(I & ~std::size_t(1))...)},
        imaginary_{__builtin_shufflevector(of.w, of.w, int(I | 1)...) *
                   typename Packet<T>::Words{(I % 2 == 0 ? T(-1) : T(1))...}} {}
  template <std::size_t... I>
  Packet<T> multiply(const Packet<T>& b, std::index_sequence<I...>) const {
    return {real_.w * b.w + imaginary_.w * __builtin_shufflevector(b.w, b.w, int(I ^ 1)...)};
  }
  Packet<T> real_, imaginary_;
};

}  // namespace macadam::continuum
