// SPDX-License-Identifier: GPL-3.0-or-later
// contact_data.cpp  Fills the arrays of a group of contacts. The slots are divided among threads. This is safe because
// no two slots share a word.
#include "kernels/contact/contact_data.hpp"

#include <utility>

#include "kernels/contact/initial_contact.hpp"
#include "kernels/contact/precision.hpp"
#include "kernels/contact/start_frame.hpp"

namespace macadam::kernels {
namespace {

/// Calls f(slot, packet, lane, whether the slot has a contact, contact) for all slots, on all threads. For an inert
/// slot, passes the contact in lane 0 of its packet, which always exists.
template <class F>
void for_each_slot(const ContactNetwork& network, const Layout& layout, const GroupLayout& group, F&& f) {
  const auto lanes = static_cast<std::size_t>(layout.lanes);
#pragma omp parallel for schedule(static)
  for (std::size_t slot = 0; slot < group.contact.size(); ++slot) {
    const std::size_t packet = slot / lanes;
    const bool real = group.contact[slot] != inert;
    f(slot, packet, slot % lanes, real, network.contacts[group.contact[real ? slot : packet * lanes]]);
  }
}

}  // namespace

template <class P>
ContactArrays<P> fill_contacts(const ContactNetwork& network, const Layout& layout, const GroupLayout& group,
                               const LawFacts& law, const StepperOptions& options) {
  using Geo = typename P::Geometry;
  const GroupShape<P> sizes(layout, group, law, options);
  ContactArrays<P> out;
  const auto& shape = out.shape = sizes.view;
  const bool turns = !options.skip_rotations, by_points = sizes.by_points;
  const std::size_t lanes = sizes.lanes;
  out.body_a = ZeroVector<std::int32_t>(sizes.slots);
  out.body_b = ZeroVector<std::int32_t>(sizes.slots);
  out.geometry = ZeroVector<Geo>(sizes.geometry());
  out.points = ZeroVector<Geo>(sizes.points());
  if (by_points) out.packet_layer.assign(group.packet_layer.begin(), group.packet_layer.end());

  for_each_slot(network, layout, group, [&](auto slot, auto packet, auto lane, bool real, const Contact& c) {
    out.body_a[slot] = layout.body_of(c.a);
    out.body_b[slot] = layout.body_of(real ? c.b : c.a);
    auto word = [&](int w) -> Geo& {
      return out
          .geometry[(packet * static_cast<std::size_t>(shape.geometry_words) + static_cast<std::size_t>(w)) * lanes +
                    lane];
    };
    word(n_x) = static_cast<Geo>(c.n.x);
    word(n_y) = static_cast<Geo>(c.n.y);
    word(n_z) = static_cast<Geo>(c.n.z);
    if (sizes.has_distance) word(distance) = static_cast<Geo>(c.distance);
    if (!real) return;
    word(arm_a) = static_cast<Geo>(c.arm_a);
    word(arm_b) = static_cast<Geo>(c.arm_b);
    if (shape.series != 0) word(shape.series) = static_cast<Geo>(c.series);
    double moments[6];
    moments_over_length(c, moments);
    for (int k = 0; k < (turns ? 6 : 1); ++k) word(moment_0 + k) = static_cast<Geo>(moments[k]);
    for (std::uint32_t j = 0; by_points && j < c.point_end - c.point_begin; ++j) {
      Geo* layer = &out.points[(group.packet_layer[packet] + j) * point_words * lanes];
      layer[point_s * lanes + lane] = static_cast<Geo>(network.point_s[c.point_begin + j]);
      layer[point_t * lanes + lane] = static_cast<Geo>(network.point_t[c.point_begin + j]);
      layer[point_weight * lanes + lane] = static_cast<Geo>(network.point_area[c.point_begin + j] / c.length);
    }
  });
  return out;
}

template <class P>
void fill_states(const ContactNetwork& network, const Layout& layout, const GroupLayout& group, const LawFacts& law,
                 const StepperOptions& options, ContactArrays<P>& out) {
  using State = typename P::State;
  const GroupShape<P> sizes(layout, group, law, options);
  const std::size_t lanes = sizes.lanes, frame_words = static_cast<std::size_t>(sizes.view.frame_words);
  const auto words = static_cast<std::size_t>(1 + sizes.view.units),
             components = static_cast<std::size_t>(sizes.view.components);
  out.frame = ZeroVector<State>(sizes.frame());
  out.chain = ZeroVector<State>(sizes.chain());
  if (frame_words == 0 && !options.start) return;

  for_each_slot(network, layout, group, [&](auto slot, auto packet, auto lane, bool real, const Contact& c) {
    if (frame_words > 0) {
      const Vec3d from = options.start && real ? carried_to_start(c, *options.start) : c.s;
      const double s[3] = {from.x, from.y, from.z};
      for (std::size_t k = 0; k < 3; ++k)
        out.frame[(packet * frame_words + k) * lanes + lane] = static_cast<State>(s[k]);
    }
    if (!real || !options.start || sizes.stateless) return;
    const StartChain start{&options.start->chain[options.start->chain_begin[group.contact[slot]]], words};
    auto set_chain = [&](std::size_t layer, auto&& value) {
      for (std::size_t i = 0; i < components * words; ++i) {
        out.chain[(layer * components * words + i) * lanes + lane] =
            static_cast<State>(value(static_cast<int>(i / words), i % words));
      }
    };
    if (!sizes.by_points) set_chain(packet, [&](int component, std::size_t w) { return start.facet(component, w); });
    for (std::uint32_t j = 0; sizes.by_points && j < c.point_end - c.point_begin; ++j) {
      set_chain(group.packet_layer[packet] + j, [&](int component, std::size_t w) {
        return start.point(component, w, network.point_s[c.point_begin + j], network.point_t[c.point_begin + j]);
      });
    }
  });
}

#define MACADAM_FILL_IN(P)                                                                                \
  template ContactArrays<P> fill_contacts<P>(const ContactNetwork&, const Layout&, const GroupLayout&,    \
                                             const LawFacts&, const StepperOptions&);                     \
  template void fill_states<P>(const ContactNetwork&, const Layout&, const GroupLayout&, const LawFacts&, \
                               const StepperOptions&, ContactArrays<P>&);
MACADAM_FILL_IN(DoublePrecision)
MACADAM_FILL_IN(MixedPrecision)
MACADAM_FILL_IN(SinglePrecision)
#undef MACADAM_FILL_IN

}  // namespace macadam::kernels
