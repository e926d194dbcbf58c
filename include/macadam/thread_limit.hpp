// SPDX-License-Identifier: GPL-3.0-or-later
/// \file thread_limit.hpp  Limits the number of CPU threads of a job.
#pragma once

#include <optional>

namespace macadam {

/// Sets the number of OpenMP threads for parallel regions of the calling thread. The destructor restores the earlier
/// number. Every part of a job uses this number of threads: generation of the specimen, tessellation, contacts, linear
/// solutions (including BLAS) and time steps.
class ThreadLimit {
 public:
  /// `threads`: 0 or no value changes nothing.
  explicit ThreadLimit(std::optional<int> threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit();

 private:
  int before_;
};

}  // namespace macadam
