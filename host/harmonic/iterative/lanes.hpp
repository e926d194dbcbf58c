// SPDX-License-Identifier: GPL-3.0-or-later
/// \file lanes.hpp  One complex number of each of F frequencies in a SIMD register: real parts, then imaginary parts.
///
/// Everything that is real (frames, arms, moments, the preconditioner) then works on 2F plain numbers, and what is read
/// of a contact serves all frequencies.
#pragma once

#include <complex>
#include <cstddef>
#include <utility>

#include "kernels/aligned.hpp"

namespace macadam::harmonic {

/// gcc takes the size of a vector from a number only.
template <int F>
struct Registers;
template <>
struct Registers<1> {
  typedef double Number __attribute__((vector_size(16)));
};
template <>
struct Registers<4> {
  typedef double Number __attribute__((vector_size(64)));
};

template <int F>
struct Lanes {
  static constexpr int width = 2 * F;
  using Register = typename Registers<F>::Number;
  Register v{};

  Lanes() = default;
  Lanes(Register r) : v(r) {}
  explicit Lanes(double x) : v(Register{} + x) {}

  std::complex<double> at(int f) const { return {v[f], v[F + f]}; }
  void set(int f, std::complex<double> z) { v[f] = z.real(), v[F + f] = z.imag(); }

  Lanes& operator+=(Lanes o) {
    v += o.v;
    return *this;
  }
  Lanes& operator-=(Lanes o) {
    v -= o.v;
    return *this;
  }
  friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  friend Lanes operator-(Lanes a) { return -a.v; }
  friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  friend Lanes operator*(double a, Lanes b) { return a * b.v; }

  /// Real and imaginary parts exchanged.
  Lanes swapped() const { return in_order(std::make_integer_sequence<int, width>()); }

 private:
  template <int... i>
  Register in_order(std::integer_sequence<int, i...>) const {
    return __builtin_shufflevector(v, v, ((i + F) % width)...);
  }
};

/// A complex factor of each frequency, ready to multiply.
template <int F>
struct Factor {
  Lanes<F> real, imaginary;  ///< each twice; the imaginary part with the sign that i·i gives to the real lanes

  void set(int f, std::complex<double> z) {
    real.v[f] = real.v[F + f] = z.real();
    imaginary.v[f] = -z.imag(), imaginary.v[F + f] = z.imag();
  }
  Lanes<F> operator()(Lanes<F> x) const { return real * x + imaginary * x.swapped(); }
};

/// Σ x·y without conjugates, and Σ conj(x)·y, real part, of each frequency.
template <int F>
struct Products {
  Lanes<F> straight, crossed;

  void add(Lanes<F> x, Lanes<F> y) {
    straight += x * y;
    crossed += x * y.swapped();
  }
  void add(const Products& o) { straight += o.straight, crossed += o.crossed; }
  std::complex<double> plain(int f) const {
    return {straight.v[f] - straight.v[F + f], crossed.v[f] + crossed.v[F + f]};
  }
  double conjugated(int f) const { return straight.v[f] + straight.v[F + f]; }
};

/// [particle][6]: ux uy uz θx θy θz of all frequencies.
template <int F>
using LaneVector = kernels::AlignedVector<Lanes<F>>;

}  // namespace macadam::harmonic
