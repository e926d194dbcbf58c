// SPDX-License-Identifier: GPL-3.0-or-later
// thread_limit.cpp  Sets and restores OpenMP's number of threads.
#include "macadam/thread_limit.hpp"

#include <omp.h>

namespace macadam {

ThreadLimit::ThreadLimit(std::optional<int> threads) : before_(omp_get_max_threads()) {
  if (threads.value_or(0) > 0) omp_set_num_threads(*threads);
}

ThreadLimit::~ThreadLimit() { omp_set_num_threads(before_); }

}  // namespace macadam
