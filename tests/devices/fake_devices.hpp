// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fake_devices.hpp  A fixture with two fake devices (GPUs), which compute on the processor (fake_plugin.cpp).
/// The fake devices stay for the whole process, because the program looks for a backend only once.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "macadam/backend.hpp"
#include "tests/support/test_folder.hpp"

namespace macadam::test {

/// Sets an environment variable and removes it in the destructor.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  Environment(const Environment&) = delete;
  ~Environment() { ::unsetenv(name_); }

 private:
  const char* name_;
};

class FakeDevices : public TestFolder {
 protected:
  static void SetUpTestSuite() {
    std::string name = (fs::path(testing::TempDir()) / "macadam_plugin_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr) << name;
    plugins_ = name;
    fs::create_symlink(FAKE_DEVICE_PLUGIN, plugins_ / "libmacadam_cuda.so");
    const Environment path("MACADAM_PLUGIN_PATH", plugins_), number("FAKE_DEVICES", "2");
    ASSERT_EQ(report_backends().devices.size(), 2u);
  }
  static void TearDownTestSuite() { fs::remove_all(plugins_); }

  const Environment devices_{"FAKE_DEVICES", "2"};

 private:
  static inline fs::path plugins_;
};

}  // namespace macadam::test
