// SPDX-License-Identifier: GPL-3.0-or-later
/// \file checksum.hpp  Computes a checksum of lists of numbers, by which several processes check that their lists are
/// equal.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

namespace macadam::kernels {

/// Accumulates lists of numbers into one checksum (FNV-1a).
class Checksum {
 public:
  template <class T>
  void add(const std::vector<T>& list) {
    static_assert(sizeof(T) % 4 == 0);
    for (const T& item : list) {
      std::uint32_t word[sizeof(T) / 4];
      std::memcpy(word, &item, sizeof item);
      for (const std::uint32_t w : word) sum_ = (sum_ ^ w) * 1099511628211u;  // FNV-1a, word by word
    }
  }
  std::int64_t value() const { return static_cast<std::int64_t>((sum_ ^ sum_ >> 32) & 0xffffffff); }

 private:
  std::uint64_t sum_ = 14695981039346656037u;
};

}  // namespace macadam::kernels
