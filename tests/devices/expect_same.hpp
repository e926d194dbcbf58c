// SPDX-License-Identifier: GPL-3.0-or-later
/// \file expect_same.hpp  Checks that states or vectors are equal bit by bit.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "macadam/stepper.hpp"

namespace macadam::test {

/// Expects the same arrays: equal names and equal values, bit by bit.
inline void expect_same(const std::vector<StateArray>& a, const std::vector<StateArray>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_TRUE(a[i].values == b[i].values) << a[i].name;
  }
}

/// Expects equal vectors; the message gives the number of vectors that differ.
inline void expect_same(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += a[i].x != b[i].x || a[i].y != b[i].y || a[i].z != b[i].z;
  EXPECT_EQ(different, 0u) << what << ", of " << a.size();
}

}  // namespace macadam::test
