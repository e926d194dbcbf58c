// SPDX-License-Identifier: GPL-3.0-or-later
/// \file test_files.hpp  Scene files for tests, and helpers that read the files and messages of a run.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "macadam/macadam.hpp"

namespace macadam::test {

namespace fs = std::filesystem;

/// Densities and the laws of binder AM1 as lines of a scene file.
inline constexpr const char* am1_contacts = R"(
[materials.aggregate]
density = 2630.0
[materials.mastic]
density = 2110.0
[[contacts]]
pair = "M-M"
law = "generalised_kelvin"
E_m = 1.115e10
C_m = 2.515e9
E = [3.799e8, 1.600e9, 4.308e10]
C = [8.950e9, 5.695e9, 1.114e9]
alpha = 0.10
[[contacts]]
pair = "M-A"
law = "generalised_kelvin"
E_m = 3.511e10
C_m = 7.921e9
E = [1.197e9, 5.039e9, 1.357e11]
C = [2.819e10, 1.794e10, 3.510e9]
alpha = 0.10
[[contacts]]
pair = "A-A"
law = "elastic"
E = 1.151e11
alpha = 0.05
[[contacts]]
pair = "A-W"
law = "elastic"
E = 1.151e11
alpha = 0.0
[[contacts]]
pair = "M-W"
law = "elastic"
E = 3.511e10
alpha = 0.0
)";

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// Returns the message of the Macadam error that `f` throws.
inline std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) { return error.what(); }
  return "nothing was thrown";
}
#define EXPECT_HAS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << text

/// Returns whether two states are equal bit by bit; equal bits of NaN count as equal.
inline bool same_bits(const std::vector<StateArray>& a, const std::vector<StateArray>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same = std::visit(
        [&](const auto& list) {
          const auto* other = std::get_if<std::decay_t<decltype(list)>>(&b[i].values);
          return other && other->size() == list.size() &&
                 std::memcmp(other->data(), list.data(), list.size() * sizeof(list[0])) == 0;
        },
        a[i].values);
    if (!same || a[i].name != b[i].name) return false;
  }
  return true;
}

}  // namespace macadam::test
