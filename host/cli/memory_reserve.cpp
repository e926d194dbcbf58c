// SPDX-License-Identifier: GPL-3.0-or-later
// memory_reserve.cpp  Installs the handler that operator new calls when memory runs out, and makes GMP use operator
// new.
#include "host/cli/memory_reserve.hpp"

#include <gmp.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <new>

namespace macadam {
namespace {

constexpr std::size_t bytes_in_reserve = 4 << 20;  ///< never written to, so it takes address space only
std::atomic<void*> reserve{nullptr};

void give_back_reserve() {
  void* const kept = reserve.exchange(nullptr);
  if (!kept) throw std::bad_alloc();
  ::operator delete(kept);
}

void* allocate(std::size_t bytes) { return ::operator new(bytes); }
void release(void* memory, std::size_t) { ::operator delete(memory); }
void* reallocate(void* memory, std::size_t bytes, std::size_t wanted) {
  void* const out = ::operator new(wanted);
  std::memcpy(out, memory, std::min(bytes, wanted));
  ::operator delete(memory);
  return out;
}

}  // namespace

void keep_memory_in_reserve() {
  reserve = ::operator new(bytes_in_reserve, std::nothrow);
  std::set_new_handler(give_back_reserve);
  mp_set_memory_functions(allocate, reallocate, release);
}

}  // namespace macadam
