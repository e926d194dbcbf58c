// SPDX-License-Identifier: GPL-3.0-or-later
/// \file content_digest.hpp  Computes a digest of texts, by which results are kept and found again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace macadam {

/// The digest FNV-1a with 128 bits. Equal contents have equal digests; it does not protect against forgery.
class ContentDigest {
 public:
  /// Adds a text. The length is added too, so that "ab", "c" and "a", "bc" differ.
  void add(std::string_view text) {
    add_bytes(text);
    add_bytes("/" + std::to_string(text.size()) + "/");
  }
  /// Returns 32 hexadecimal digits.
  std::string digits() const {
    std::string out;
    for (int shift = 124; shift >= 0; shift -= 4) out += "0123456789abcdef"[static_cast<int>(state_ >> shift) & 15];
    return out;
  }

 private:
  __extension__ using Number = unsigned __int128;
  static constexpr Number joined(std::uint64_t high, std::uint64_t low) { return (Number(high) << 64) | low; }

  void add_bytes(std::string_view text) {
    for (const char c : text) {
      state_ ^= static_cast<unsigned char>(c);
      state_ *= joined(1u << 24, 0x13b);
    }
  }
  Number state_ = joined(0x6c62272e07bb0142, 0x62b821756295c58d);
};

}  // namespace macadam
