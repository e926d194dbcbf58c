// SPDX-License-Identifier: GPL-3.0-or-later
/// \file random_stream.hpp  Generates uniform random numbers that are the same on every platform.
#pragma once

#include <cstdint>
#include <random>

namespace macadam {

/// Random stream number `stream` of a seed; the streams of a seed are independent. The C++ standard fixes the output of
/// the engine but leaves its distributions open, so the distributions are implemented here.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : engine_(mixed(mixed(seed) + stream)) {}

  /// Returns a number uniformly distributed in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// Returns a number uniformly distributed in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Returns an integer uniformly distributed in 0 … n − 1. The bias of 2⁻⁵³·n is negligible.
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

 private:
  /// Applies the finaliser of SplitMix64, which gives unrelated engine states for consecutive seeds and streams.
  static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace macadam
