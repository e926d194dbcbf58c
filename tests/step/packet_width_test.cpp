// SPDX-License-Identifier: GPL-3.0-or-later
// packet_width_test.cpp  Processors with SIMD registers of different widths give the same bits, and can resume each
// other's checkpoints. The steppers of this file are compiled with sanitizers (tests/CMakeLists.txt), so every default
// run of the tests checks the CPU kernels, even if the library is not built with sanitizers.
#include <gtest/gtest.h>

#include "kernels/cpu/exec_cpu.hpp"
#include "kernels/step/stepper_impl.hpp"
#include "tests/support/stepper_cases.hpp"
#include "tests/support/test_files.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

template <class P>
class PacketWidth : public testing::Test {
 protected:
  /// A stepper whose packets of contacts have the other width: 8 if the width of this file is 4, and 4 if it is 8. If
  /// the library is compiled for this machine, this file has the packet width of this machine. If the library contains
  /// code for several processors, this file is compiled for the oldest of them.
  using OtherExec = kernels::ExecCpu<P, Law, 12 - kernels::packet_width<P>>;

  static void expect_same(const TestScene& scene, StepperOptions options) {
    options.precision = P::value;
    const auto other = [&] {
      std::unique_ptr<Stepper> used;
      return kernels::make_stepper_on<OtherExec>(scene.specimen, scene.network, scene.laws, scene.inertia, options,
                                                 used);
    };
    const auto own = make_stepper(Backend::cpu, scene.specimen, scene.network, scene.laws, scene.inertia, options);
    const auto theirs = other(), taken = other();
    own->advance(100);
    taken->set_state(own->state());
    own->advance(200);
    theirs->advance(300);
    taken->advance(200);
    EXPECT_TRUE(same_bits(own->state(), theirs->state()))
        << to_string(options.form) << ", " << to_string(options.geometry);
    EXPECT_TRUE(same_bits(taken->state(), theirs->state()))
        << to_string(options.form) << ", " << to_string(options.geometry);
    EXPECT_EQ(own->observe().top_force(), theirs->observe().top_force());
  }
};
using Precisions = testing::Types<kernels::DoublePrecision, kernels::MixedPrecision>;
TYPED_TEST_SUITE(PacketWidth, Precisions);

TYPED_TEST(PacketWidth, DoesNotShowInTheNumbers) {
  const TestScene scene = make_scene(random_specimen(21));
  StepperOptions options = shaking_options(scene);
  for (const auto form : {ContactForm::condensed, ContactForm::points}) {
    for (const auto geometry : {Geometry::updated, Geometry::fixed}) {
      options.form = form, options.geometry = geometry;
      this->expect_same(scene, options);
    }
  }
}

TYPED_TEST(PacketWidth, DoesNotShowWhereBondsBreak) {
  Laws laws = same_law(laws::BrittleBond{2e10, 3e4, 2e4, 0.3});
  laws[static_cast<std::size_t>(PairType::mm)] = mastic_am1();
  const TestScene scene = make_scene(random_specimen(11), {}, laws);
  StepperOptions options = shaking_options(scene);
  options.form = ContactForm::points;  // only the contact form `points` allows bonds that break
  this->expect_same(scene, options);
}

}  // namespace
}  // namespace macadam::test
