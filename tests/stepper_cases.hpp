// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper_cases.hpp  The combinations over which kernels are tested, and their names.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "test_scenes.hpp"

namespace macadam::test {

/// All backends, precisions, forms and geometries.
using StepperCase = std::tuple<Backend, Precision, ContactForm, Geometry>;
inline auto all_stepper_cases() {
  return testing::Combine(testing::ValuesIn(tested_backends()),
                          testing::Values(Precision::double_, Precision::mixed, Precision::single),
                          testing::Values(ContactForm::condensed, ContactForm::points),
                          testing::Values(Geometry::updated, Geometry::fixed));
}

/// The names of a tuple's choices, one after another.
template <class... Choices>
std::string name_of_case(const testing::TestParamInfo<std::tuple<Choices...>>& info) {
  std::string out;
  const auto add = [&](const auto& choice) { out += (out.empty() ? "" : "_") + std::string(to_string(choice)); };
  std::apply([&](const auto&... choice) { (add(choice), ...); }, info.param);
  return out;
}

}  // namespace macadam::test
