// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper_cases.hpp  The combinations of backend, precision, form and geometry that kernels are tested over, and
/// the names of these cases.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "tests/support/test_scenes.hpp"

namespace macadam::test {

/// Returns every backend except the reference, whether or not this build and machine can run it.
inline auto all_backends() { return testing::Values(Backend::cpu, Backend::cuda); }

/// Fixture of tests that run on each backend. Without a device (GPU), a CUDA case is skipped with the reason, so that
/// it is counted as skipped.
template <class Case>
class BackendTest : public testing::TestWithParam<Case> {
 protected:
  Backend backend() const { return std::get<Backend>(this->GetParam()); }
  void SetUp() override {
    const std::vector<Backend> tested = tested_backends();
    if (std::find(tested.begin(), tested.end(), backend()) == tested.end()) {
      GTEST_SKIP() << to_string(backend()) << ": " << report_backends().cuda_status;
    }
  }
};

/// Returns all combinations of backend, precision, form and geometry.
using StepperCase = std::tuple<Backend, Precision, ContactForm, Geometry>;
inline auto all_stepper_cases() {
  return testing::Combine(all_backends(), testing::Values(Precision::double_, Precision::mixed, Precision::single),
                          testing::Values(ContactForm::condensed, ContactForm::points),
                          testing::Values(Geometry::updated, Geometry::fixed));
}

/// Returns the names of a case's choices, joined by underscores.
template <class... Choices>
std::string name_of_case(const testing::TestParamInfo<std::tuple<Choices...>>& info) {
  std::string out;
  const auto add = [&](const auto& choice) { out += (out.empty() ? "" : "_") + std::string(to_string(choice)); };
  std::apply([&](const auto&... choice) { (add(choice), ...); }, info.param);
  return out;
}

}  // namespace macadam::test
