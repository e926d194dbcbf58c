// SPDX-License-Identifier: GPL-3.0-or-later
/// \file ct_folder.hpp  A test fixture that makes an empty folder for each test's images and removes it afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace macadam {

class CtFolder : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ = [] {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(testing::TempDir()) / (std::string(test.test_suite_name()) + "_" + test.name());
  }();
};

}  // namespace macadam
