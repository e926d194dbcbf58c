// SPDX-License-Identifier: GPL-3.0-or-later
/// \file draws_ahead.hpp  Runs random trials on several threads with the same results as trials made one after another
/// on one thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "kernels/base/parallel.hpp"
#include "host/spheres/random_stream.hpp"

namespace macadam {

/// The random numbers of one trial, which were drawn in advance. The class has the same functions as RandomStream.
class Draws {
 public:
  explicit Draws(const double* next) : next_(next) {}

  double uniform() { return *next_++; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

 private:
  const double* next_;
};

/// A random stream whose numbers can be drawn in advance. Trials run on all threads, and more trials run than are
/// needed. The trials that succeed, and the numbers that the stream returns next, are the same as if the trials had
/// been made in order on one thread.
class DrawsAhead {
 public:
  explicit DrawsAhead(RandomStream random) : random_(random) {}

  /// Returns the random numbers of the first of up to `most` trials for which attempt(Draws) returns true, or nothing
  /// if no trial succeeds. The returned numbers are valid until the next call. The numbers of this trial and of all
  /// earlier ones are consumed. Every trial gets `size` numbers, whether or not it reads all of them. `chunk` is the
  /// number of trials that one thread processes at a time.
  template <class Attempt>
  std::optional<Draws> first_good(std::int64_t most, std::size_t size, std::int64_t chunk, const Attempt& attempt) {
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    for (std::int64_t begin = 0, block = chunk; begin < most; block = std::min(4 * block, 256 * chunk)) {
      const std::int64_t n = std::min(block, most - begin);
      look(static_cast<std::size_t>(n) * size);
      std::atomic<std::int64_t> good = none;
      const auto run = [&](std::size_t part) {
        const std::int64_t from = static_cast<std::int64_t>(part) * chunk;
        for (std::int64_t k = from; k < std::min(n, from + chunk) && k < good; ++k) {
          if (!attempt(draws(k, size))) continue;
          std::int64_t first = good;
          while (k < first && !good.compare_exchange_weak(first, k)) continue;
          break;
        }
      };
      for_each_in_parallel(static_cast<std::size_t>((n + chunk - 1) / chunk), run, n > alone * chunk);
      const std::int64_t used = good == none ? n : good + 1;
      const Draws last = draws(used - 1, size);
      used_ += static_cast<std::size_t>(used) * size;
      if (good != none) return last;
      begin += used;
    }
    return std::nullopt;
  }

  /// Makes trials, which succeed if attempt(Draws) returns true. Calls take(Draws) for the successful trials, in order,
  /// until take() returns false; then returns true. Returns false as soon as `most` consecutive trials have failed. The
  /// numbers of the last trial and of all earlier ones are consumed. attempt() must not depend on what take() did.
  template <class Attempt, class Take>
  bool each_good(std::int64_t most, std::size_t size, std::int64_t chunk, const Attempt& attempt, const Take& take) {
    std::vector<std::uint8_t> good;
    for (std::int64_t failed = 0, n = chunk;; n = std::min(2 * n, 256 * chunk)) {
      look(static_cast<std::size_t>(n) * size);
      good.assign(static_cast<std::size_t>(n), 0);
      const auto run = [&](std::size_t part) {
        const std::int64_t from = static_cast<std::int64_t>(part) * chunk;
        for (std::int64_t k = from; k < std::min(n, from + chunk); ++k) good[k] = attempt(draws(k, size));
      };
      for_each_in_parallel(static_cast<std::size_t>((n + chunk - 1) / chunk), run, n > chunk);
      for (std::int64_t k = 0; k < n; ++k) {
        failed = good[k] ? 0 : failed + 1;
        const bool more = good[k] ? take(draws(k, size)) : failed < most;
        if (more) continue;
        used_ += static_cast<std::size_t>(k + 1) * size;
        return good[k];
      }
      used_ += static_cast<std::size_t>(n) * size;
    }
  }

 private:
  /// If there are at most this many chunks of trials, the calling thread makes all trials alone, because waking other
  /// threads would take longer.
  static constexpr std::int64_t alone = 4;

  /// Returns the numbers of a trial.
  Draws draws(std::int64_t attempt, std::size_t size) const {
    return Draws(drawn_.data() + used_ + static_cast<std::size_t>(attempt) * size);
  }

  /// Draws numbers in advance until at least `n` are available.
  void look(std::size_t n) {
    if (drawn_.size() - used_ >= n) return;
    drawn_.erase(drawn_.begin(), drawn_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ = 0;
    while (drawn_.size() < n) drawn_.push_back(random_.uniform());
  }

  RandomStream random_;
  /// Numbers drawn in advance; the first used_ of them are consumed.
  std::vector<double> drawn_;
  std::size_t used_ = 0;
};

}  // namespace macadam
