// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_pair.hpp  Helpers for the tests of the reference stepper: an elastic law, a pair that moves as
/// prescribed, and a comparison of vectors.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "host/reference/reference_stepper.hpp"
#include "tests/support/test_networks.hpp"

namespace macadam::test {

inline constexpr double E = 1e9, alpha = 0.3;
inline const laws::Elastic spring{E, alpha};

inline StepperOptions options_of(double dt, Geometry geometry) {
  StepperOptions options;
  options.dt = dt;
  options.geometry = geometry;
  return options;
}

inline std::unique_ptr<Stepper> make(const HandMade& made, const Law& law, const StepperOptions& options) {
  return make_reference_stepper(made.specimen, made.network, same_law(law), made.inertia, options);
}

/// Returns a pair so heavy that contact forces do not change its motion: it keeps the velocities that a test sets.
inline PairShape heavy(const Vec3d& n = {0, 0, 1}) {
  PairShape shape;
  shape.mass_a = shape.mass_b = 1e30;
  shape.n = n;
  return shape;
}

/// Expects each component within `tolerance` of the expected one.
inline void expect_near(const Vec3d& found, const Vec3d& expected, double tolerance, const char* what) {
  EXPECT_NEAR(found.x, expected.x, tolerance) << what;
  EXPECT_NEAR(found.y, expected.y, tolerance) << what;
  EXPECT_NEAR(found.z, expected.z, tolerance) << what;
}

}  // namespace macadam::test
