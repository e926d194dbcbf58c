// SPDX-License-Identifier: GPL-3.0-or-later
/// \file thread_limit.hpp  How many threads a job may use, whatever parts it has.
#pragma once

#include <omp.h>

#include <optional>

namespace macadam {

/// Sets the number of OpenMP threads of the calling thread's parallel regions for as long as it lives, and then
/// restores the earlier number. Every part of a job reads that number: specimen, cells, contacts, solutions and their
/// BLAS, steps.
class ThreadLimit {
 public:
  /// `threads`: 0 or nothing changes nothing.
  explicit ThreadLimit(std::optional<int> threads) : before_(omp_get_max_threads()) {
    if (threads.value_or(0) > 0) omp_set_num_threads(*threads);
  }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit() { omp_set_num_threads(before_); }

 private:
  int before_;
};

}  // namespace macadam
