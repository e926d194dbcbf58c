// SPDX-License-Identifier: GPL-3.0-or-later
/// \file complex_lanes.hpp  Stores one complex number for each of F solutions in a SIMD register: first the real parts,
/// then the imaginary parts.
///
/// A real factor (a component of a frame, lever arm, area moment or preconditioner) then multiplies all 2F real numbers
/// of a register by one instruction. The data of a contact are read once for all solutions.
#pragma once

#include <complex>
#include <cstddef>
#include <utility>

#include "kernels/base/aligned.hpp"

namespace macadam::harmonic {

/// The SIMD type of F complex numbers. Each size is written out, because gcc accepts only a literal as the size of a
/// vector.
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

/// F complex numbers. Products are lane by lane: one factor must be real, and this real number is stored in both lanes.
template <int F>
struct Lanes {
  static constexpr int width = 2 * F;
  using Register = typename Registers<F>::Number;
  Register v{};

  Lanes() = default;
  Lanes(Register r) : v(r) {}
  explicit Lanes(double x) : v(Register{} + x) {}

  /// Returns the complex number f.
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

  /// Returns the numbers with real and imaginary parts exchanged.
  Lanes swapped() const { return in_order(std::make_integer_sequence<int, width>()); }

 private:
  template <int... i>
  Register in_order(std::integer_sequence<int, i...>) const {
    return __builtin_shufflevector(v, v, ((i + F) % width)...);
  }
};

/// A complex factor for each solution, prepared for multiplication.
template <int F>
struct Factor {
  /// The real part and the imaginary part of the factor are each stored in both lanes of a number. The imaginary part
  /// is stored negated in the lane of real parts, because i·i = −1.
  Lanes<F> real, imaginary;

  void set(int f, std::complex<double> z) {
    real.v[f] = real.v[F + f] = z.real();
    imaginary.v[f] = -z.imag(), imaginary.v[F + f] = z.imag();
  }
  Lanes<F> operator()(Lanes<F> x) const { return real * x + imaginary * x.swapped(); }
};

/// Returns the stiffnesses k in series with springs of compliance `series`, 1/(1/k + series), for each solution. Both
/// lanes of a number of `series` hold the same real number.
template <int F>
Factor<F> in_series(const Factor<F>& k, Lanes<F> series) {
  const auto re = k.real.v, im = k.imaginary.v, r = series.v, one = 1 + r * re, turn = r * im;
  const auto square = one * one + turn * turn;  // |1 + series·k|²
  return {(re + r * (re * re + im * im)) / square, im / square};
}

/// The sums Σ x·y without conjugates and Re Σ conj(x)·y, for each solution.
template <int F>
struct Products {
  Lanes<F> straight, crossed;

  void add(Lanes<F> x, Lanes<F> y) {
    straight += x * y;
    crossed += x * y.swapped();
  }
  void add(const Products& o) { straight += o.straight, crossed += o.crossed; }
  /// Returns Σ x·y of solution f, without conjugates.
  std::complex<double> plain(int f) const {
    return {straight.v[f] - straight.v[F + f], crossed.v[f] + crossed.v[F + f]};
  }
  /// Returns Re Σ conj(x)·y of solution f.
  double conjugated(int f) const { return straight.v[f] + straight.v[F + f]; }
};

/// Vectors of F solutions side by side, [particle][6]: ux uy uz θx θy θz.
template <int F>
using LaneVector = kernels::AlignedVector<Lanes<F>>;

}  // namespace macadam::harmonic
