// SPDX-License-Identifier: GPL-3.0-or-later
// packet_width_test.cpp  Processors with SIMD registers of different widths: the same bits, and checkpoints that go
// from one to another.
#include <gtest/gtest.h>

#include "kernels/exec_cpu.hpp"
#include "kernels/stepper_impl.hpp"
#include "stepper_cases.hpp"
#include "test_files.hpp"
#include "test_scenes.hpp"

namespace macadam::test {
namespace {

template <class P>
class PacketWidth : public testing::Test {};
using Precisions = testing::Types<kernels::DoublePrecision, kernels::MixedPrecision>;
TYPED_TEST_SUITE(PacketWidth, Precisions);

TYPED_TEST(PacketWidth, DoesNotShowInTheNumbers) {
  const TestScene scene = make_scene(random_specimen(21));
  StepperOptions options = shaking_options(scene);
  options.precision = TypeParam::value;
  const auto make = [&](auto width) {
    using Exec = kernels::ExecCpu<TypeParam, Law, decltype(width)::value>;
    return kernels::make_stepper_on<Exec>(scene.specimen, scene.network, scene.laws, scene.inertia, options, nullptr);
  };
  for (const auto form : {ContactForm::condensed, ContactForm::points}) {
    for (const auto geometry : {Geometry::updated, Geometry::fixed}) {
      options.form = form, options.geometry = geometry;
      const auto narrow = make(std::integral_constant<std::size_t, 4>{});
      const auto wide = make(std::integral_constant<std::size_t, 8>{}),
                 taken = make(std::integral_constant<std::size_t, 8>{});
      narrow->advance(100);
      taken->set_state(narrow->state());
      narrow->advance(200);
      wide->advance(300);
      taken->advance(200);
      EXPECT_TRUE(same_bits(narrow->state(), wide->state())) << to_string(form) << ", " << to_string(geometry);
      EXPECT_TRUE(same_bits(taken->state(), wide->state())) << to_string(form) << ", " << to_string(geometry);
      EXPECT_EQ(narrow->observe().top_force(), wide->observe().top_force());
    }
  }
}

}  // namespace
}  // namespace macadam::test
