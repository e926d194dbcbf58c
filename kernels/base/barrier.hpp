// SPDX-License-Identifier: GPL-3.0-or-later
/// \file barrier.hpp  Implements a thread barrier for steps of about ten microseconds. A waiting thread spins briefly,
/// then yields its core.
///
/// OpenMP's own barrier either sleeps, which costs more than a small step, or spins for milliseconds. On a busy machine
/// the spinning threads occupy the cores that the last thread needs to arrive at the barrier (measured: five times
/// slower beside other programs).
#pragma once

#include <atomic>
#include <thread>

namespace macadam::kernels {

/// Lets a fixed number of threads wait for each other; can be used any number of times.
class Barrier {
 public:
  /// Sets how many threads call wait(). Must be called before any of them does.
  void set_threads(unsigned threads) { threads_ = threads; }

  void wait() {
    if (threads_ == 1) return;
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      return;
    }
    for (unsigned spin = 0; round_.load(std::memory_order_acquire) == round; ++spin) {
      if (spin >= spins) std::this_thread::yield();
    }
  }

 private:
  static constexpr unsigned spins = 4000;  ///< polls before a thread yields, about ten microseconds
  unsigned threads_ = 1;
  alignas(64) std::atomic<unsigned> arrived_{0};
  alignas(64) std::atomic<unsigned> round_{0};
};

}  // namespace macadam::kernels
