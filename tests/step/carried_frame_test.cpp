// SPDX-License-Identifier: GPL-3.0-or-later
// carried_frame_test.cpp  Compares the series that rotate a contact's frame from step to step with closed forms. The
// series are meant for the small rotations of a time step. The rotations in this test are so large that the first
// omitted term of a series is visible. Any other error of this size would be visible too.
#include "kernels/contact/carried_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace macadam::kernels {
namespace {

/// Returns v rotated about the unit vector `axis` (Rodrigues' formula).
Vec3d turned(const Vec3d& v, const Vec3d& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

const Vec3d n = (1 / std::sqrt(14.0)) * Vec3d{1, 2, 3};
const Vec3d s = (1 / std::sqrt(5.0)) * Vec3d{2, -1, 0};  // perpendicular to n
constexpr double rounding = 1e-15;

/// The first omitted term of the series is 63/256·e⁵.
TEST(CarriedFrame, InverseRootIsASeriesOfFiveTerms) {
  for (const double e : {-0.1, -0.02, 0.0, 0.02, 0.1}) {
    const double left_out = 63.0 / 256 * std::pow(std::abs(e), 5);
    EXPECT_NEAR(inverse_root_near_one(1 - e), 1 / std::sqrt(1 - e), 1.2 * left_out + rounding) << e;
  }
}

// The series for the divisor omits the term e⁴/32. The term multiplies a vector along the sum of the normals, whose
// length is about 2. An error of the length itself enters only by its square, because the last operation restores unit
// length.
TEST(CarriedFrame, ATangentIsSwungWithItsNormal) {
  for (const double about : {0.0, 1.0, 2.0}) {  // tangents in all directions
    const Vec3d tangent = turned(s, n, about);
    for (const double angle : {0.01, 0.1, 0.3, 0.5}) {
      const Vec3d axis = s, to = turned(n, axis, angle);
      const double e = 1 - std::cos(angle), left_out = std::pow(e, 4) / 32 * 2 * std::sin(angle);
      const Vec3d swung_tangent = swung(tangent, n, to), exact = turned(tangent, axis, angle);
      EXPECT_LE(norm(swung_tangent - exact), 1.2 * left_out + rounding) << angle << ", " << about;
    }
  }
}

TEST(CarriedFrame, ATangentIsSpunAboutItsNormal) {
  for (const double angle : {-0.2, -0.01, 0.0, 0.01, 0.2}) {
    // omitted term of the series for the cosine; the error of the sine is smaller
    const double left_out = std::pow(angle, 4) / 24;
    EXPECT_LE(norm(spun(s, n, angle) - turned(s, n, angle)), 1.01 * left_out + rounding) << angle;
  }
}

}  // namespace
}  // namespace macadam::kernels
