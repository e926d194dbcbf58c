// SPDX-License-Identifier: GPL-3.0-or-later
// contact_data_test.cpp  Checks that the memory predicted for a group of contacts equals the size of its arrays.
#include "kernels/contact/contact_data.hpp"

#include <gtest/gtest.h>

#include "tests/support/general_laws.hpp"
#include "kernels/contact/precision.hpp"
#include "tests/support/test_scenes.hpp"

namespace macadam::test {
namespace {

/// Expects that GroupShape predicts the bytes of the arrays of every group in the layout.
template <class P>
void expect_foretold(const TestScene& scene, const StepperOptions& options) {
  const kernels::Layout layout = kernels::make_layout(scene.specimen, scene.network, 8, 100);
  for (const auto& group : layout.groups) {
    const LawFacts law = facts_of(scene.laws)[static_cast<std::size_t>(group.pair)].value();
    auto arrays = kernels::fill_contacts<P>(scene.network, layout, group, law, options);
    kernels::fill_states<P>(scene.network, layout, group, law, options, arrays);
    kernels::ContactView<P> view = arrays.shape;
    std::size_t bytes = 0;
    arrays.for_each_array(view, [&](auto, auto, auto& array, auto&) { bytes += array.size() * sizeof(array[0]); });
    EXPECT_GT(bytes, 0u);
    EXPECT_EQ(kernels::GroupShape<P>(layout, group, law, options).bytes(), bytes) << to_string(group.pair);
  }
}

TEST(GroupShape, ForetellsTheArrays) {
  TestScene scene = make_scene(random_specimen(3));
  for (const int units : {3, 5}) {
    if (units != 3) scene.laws = general_laws(scene.laws, units);
    for (const auto form : {ContactForm::condensed, ContactForm::points}) {
      for (const auto geometry : {Geometry::updated, Geometry::fixed}) {
        StepperOptions options = shaking_options(scene);
        options.form = form, options.geometry = geometry;
        expect_foretold<kernels::DoublePrecision>(scene, options);
        expect_foretold<kernels::MixedPrecision>(scene, options);
        expect_foretold<kernels::SinglePrecision>(scene, options);
      }
    }
  }
  for (std::size_t c = 0; c < scene.network.contacts.size(); c += 100) scene.network.contacts[c].series = 1e-11;
  for (const auto form : {ContactForm::condensed, ContactForm::points}) {
    for (const auto geometry : {Geometry::updated, Geometry::fixed}) {
      StepperOptions options = shaking_options(scene);
      options.form = form, options.geometry = geometry;
      expect_foretold<kernels::DoublePrecision>(scene, options);
      expect_foretold<kernels::SinglePrecision>(scene, options);
    }
  }
  for (Contact& c : scene.network.contacts) c.series = 0;
  scene.laws.fill(laws::BrittleBond{1e9, 1e6});  // coupled laws need all three components and the distance
  for (const auto geometry : {Geometry::updated, Geometry::fixed}) {
    StepperOptions options = shaking_options(scene);
    options.form = ContactForm::points, options.geometry = geometry;
    expect_foretold<kernels::DoublePrecision>(scene, options);
    expect_foretold<kernels::SinglePrecision>(scene, options);
  }
}

}  // namespace
}  // namespace macadam::test
