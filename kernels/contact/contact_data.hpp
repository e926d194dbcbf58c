// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_data.hpp  Defines and fills the arrays of one group of contacts. Constant arrays are filled from the
/// contact network once. States are filled whenever a run starts.
///
/// Layout: blocked structure of arrays. Word w of the contact in lane j of packet p is at [(p·words + w)·lanes + j]. A
/// packet is a SIMD register on the CPU and a warp on the device; both load one word of all lanes at once.
#pragma once

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "kernels/base/aligned.hpp"
#include "kernels/contact/carried_frame.hpp"
#include "kernels/layout/layout.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Words of ContactView::geometry, in order. `distance` is only present if the geometry is updated during the run, or
/// if the law advances the components of a contact point together. One more word, ContactView::series, is only present
/// if some contact of the group has rock in series.
enum GeometryWord { n_x, n_y, n_z, arm_a, arm_b, moment_0, distance = moment_0 + 6 };
/// Words of one layer of ContactView::points.
enum PointWord { point_s, point_t, point_weight, point_words };

/// Pointers to the arrays of one group, as kernels receive them. A layer is one contact point of each lane of a packet.
template <class P>
struct ContactView {
  using State = typename P::State;
  using Geometry = typename P::Geometry;
  const std::int32_t* body_a;         ///< [slot] body number
  const std::int32_t* body_b;         ///< [slot]
  const Geometry* geometry;           ///< [packet][geometry_words][lane]; arms [m], moments over length [m] [m²] [m³]
  const Geometry* points;             ///< [layer][point_words][lane]; s, t [m], A_J/length [m]; points form only
  const std::uint32_t* packet_layer;  ///< [packet + 1]; points form only
  /// [packet][components][1 + units][lane], in points form [layer] instead of [packet]: f [Pa·m], then x_l [m] of each
  /// Kelvin unit. Null if the contacts are stateless.
  State* chain;
  State* frame;  ///< [packet][frame_words][lane] ŝ and, in single precision, the spin not yet applied to it
  std::uint32_t packets;
  std::int32_t geometry_words;
  std::int32_t series;  ///< number of the word of geometry that holds Contact::series [1/Pa]; 0: no such word
  std::int32_t frame_words;
  /// Number of displacement components that have chains. Condensed form: 6, or 3 without shear, or 1 without shear and
  /// rotations. Points form: 3, or 1 without shear.
  std::int32_t components;
  std::int32_t units;  ///< Kelvin units
  bool by_points;      ///< points form: each contact point has its own chains
  bool wall;           ///< whether body_b is a wall, whose plane is the facet
  Geometry alpha;
};

/// The arrays of one group on the host. Devices receive copies.
template <class P>
struct ContactArrays {
  ZeroVector<std::int32_t> body_a, body_b;
  ZeroVector<typename P::Geometry> geometry, points;
  AlignedVector<std::uint32_t> packet_layer;
  ZeroVector<typename P::State> chain, frame;
  ContactView<P> shape{};  ///< sizes and flags of the view; its pointers are null

  /// Calls f(name, unit, array, pointer of the view that addresses the array) for every array.
  template <class F>
  void for_each_array(ContactView<P>& view, F&& f) {
    f("body_a", "1", body_a, view.body_a);
    f("body_b", "1", body_b, view.body_b);
    f("geometry", "1, m, m, m2, m3, 1/Pa", geometry, view.geometry);
    f("points", "m, m, m", points, view.points);
    f("packet_layer", "1", packet_layer, view.packet_layer);
    f("chain", "Pa m, m", chain, view.chain);
    f("frame", "1, rad", frame, view.frame);
  }
};

/// Sizes of the arrays of a group.
template <class P>
struct GroupShape {
  ContactView<P> view{};  ///< sizes and flags only; pointers are null
  bool by_points, stateless;
  bool has_distance;                 ///< whether the geometry has the word `distance`
  std::size_t slots, lanes, layers;  ///< layers: number of layers of chains

  /// `options.skip_rotations` must be final (StepperImpl::decided()).
  GroupShape(const Layout& layout, const GroupLayout& group, const LawFacts& law, const StepperOptions& options)
      : by_points(options.form == ContactForm::points),
        stateless(options.geometry == Geometry::fixed && law.memoryless),
        has_distance(options.geometry == Geometry::updated || law.coupled),
        slots(group.contact.size()),
        lanes(static_cast<std::size_t>(layout.lanes)),
        layers(by_points ? group.packet_layer.back() : group.packets()) {
    const bool shear = law.alpha != 0 || !options.skip_shear || law.coupled, turns = !options.skip_rotations;
    view.by_points = by_points;
    view.alpha = static_cast<typename P::Geometry>(law.alpha);
    view.packets = static_cast<std::uint32_t>(group.packets());
    view.geometry_words = has_distance ? distance + 1 : distance;
    if (group.series) view.series = view.geometry_words++;
    view.frame_words = options.geometry == Geometry::updated ? tangent_words<typename P::State> : 0;
    view.components = by_points ? (shear ? 3 : 1) : shear ? 6 : turns ? 3 : 1;
    view.units = law.units;
    view.wall = group.pair == PairType::aw || group.pair == PairType::mw;
  }
  std::size_t geometry() const { return slots * static_cast<std::size_t>(view.geometry_words); }
  std::size_t frame() const { return slots * static_cast<std::size_t>(view.frame_words); }
  std::size_t chain() const {
    return stateless ? 0 : layers * lanes * static_cast<std::size_t>(view.components * (1 + view.units));
  }
  std::size_t points() const { return by_points ? layers * lanes * point_words : 0; }
  std::size_t packet_layer() const { return by_points ? slots / lanes + 1 : 0; }
  /// Bytes of all arrays of the group.
  std::size_t bytes() const {
    return 2 * slots * sizeof(std::int32_t) + (geometry() + points()) * sizeof(typename P::Geometry) +
           (chain() + frame()) * sizeof(typename P::State) + packet_layer() * sizeof(std::uint32_t);
  }
};

/// Returns the arrays of a group that no step changes, and the sizes in its view. An inert slot reads `body_a` of a
/// real contact and has zero arms and moments, so it adds zero. `options.skip_rotations` must be final
/// (StepperImpl::decided()).
template <class P>
ContactArrays<P> fill_contacts(const ContactNetwork& network, const Layout& layout, const GroupLayout& group,
                               const LawFacts& law, const StepperOptions& options);

/// Fills the arrays that a step changes. Sets the start state in the options or, if `options.start` is null, the state
/// at rest.
template <class P>
void fill_states(const ContactNetwork& network, const Layout& layout, const GroupLayout& group, const LawFacts& law,
                 const StepperOptions& options, ContactArrays<P>& out);

}  // namespace macadam::kernels
