// SPDX-License-Identifier: GPL-3.0-or-later
/// \file block_settling.hpp  Updates the viscoelastic states of a contact at the end of each block of steps, by
/// equations (6.8) and (6.9) of docs/model/motion.md. A block is a number of steps during which contacts store only the
/// change of their force. The CPU and the GPUs share this code.
///
/// f is the force density of one displacement component of a contact. During a block a contact stores only two numbers
/// per component, in single precision: δf, which is the change of f since the beginning of the block; and the sum, over
/// the steps so far, of δf before the step and δf after it. `drift` is the constant D of (6.8): the effect that the
/// states at the beginning of the block have on every step. The loads of the contacts at the beginning of the block are
/// summed once per block. Callers are cpu_blocks.hpp and settle_kernels.hpp.
#pragma once

#include <cmath>

#include "kernels/contact/contact_step.hpp"
#include "macadam/laws/facts.hpp"

namespace macadam::kernels {

/// Result of the update of one contact: its frame, drift and loads for the next block.
template <class R>
struct SettledContact {
  Placement<double> frame;
  float drift[6];
  ContactLoad<R> load;
};

/// Updates the contacts of one group, in full precision.
template <class P, class Block, int Units, Geometry geometry>
struct BlockSettling {
  using State = typename P::State;
  using R = typename P::Particle;
  ContactView<P> view;
  Block law;

  /// Updates the contact in lane `item.lane` of a packet. `steps`: number of steps of the block that ends; 0 if no
  /// block ends, in which case `change` and `sum` are 0. `now`, `before`: displacements now, and at the beginning of
  /// the block that ends, [body][8].
  template <class Item>
  MACADAM_HD SettledContact<R> operator()(const Item& item, std::uint32_t packet, const float (&change)[6],
                                          const float (&sum)[6], const double* now, const double* before,
                                          int steps) const {
    constexpr auto lanes = static_cast<std::size_t>(Item::lanes());
    const std::size_t slot = packet * lanes + item.lane;
    const int units = Units >= 0 ? Units : view.units;
    const auto* g = view.geometry + packet * static_cast<std::size_t>(view.geometry_words) * lanes + item.lane;
    const auto word = [&](int k) { return static_cast<double>(g[static_cast<std::size_t>(k) * lanes]); };
    const Vec3<double> n0{word(n_x), word(n_y), word(n_z)};
    SettledContact<R> out;
    if constexpr (geometry == Geometry::updated)
      out.frame = frame_after_block(item, packet, slot, n0, word(arm_a), word(arm_b), word(distance), now, before);
    else
      out.frame = canonical_placement(n0, ::copysign(1.0, n0.z), word(arm_a), word(arm_b));

    double f[6] = {0, 0, 0, 0, 0, 0}, m[6];
    for (int k = 0; k < 6; ++k) m[k] = word(moment_0 + k);
    for (float& d : out.drift) d = 0;
    if (!view.chain) {  // without states: f follows from the current displacements
      const std::int32_t a = view.body_a[slot], b = view.body_b[slot];
      double x[6];
      relative_rates(out.frame, Twist<double>{{0, 0, 0}, vector(now, a, 4)},
                     Twist<double>{vector(now, b, 0) - vector(now, a, 0), vector(now, b, 4)}, x);
      for (int c = 0; c < 6; ++c) {
        if (c < view.components) f[c] = law.rate * x[c];
      }
      if (view.series != 0) {
        const auto factors = SeriesFactors<double>::of(word(view.series), law.rate, static_cast<double>(view.alpha));
        for (int c = 0; c < 6; ++c) f[c] *= factors.of_component(c);
      }
    }
    // If the number of units is known at compile time, all chains are loaded before the first is stored. The loops have
    // compile-time bounds, because a GPU keeps an array in registers only if every index is known at compile time.
    constexpr int together = Units >= 0 ? 6 : 1, most = Units >= 0 ? Units : Block::most_units;
    for (int first = 0; view.chain && first < (Units >= 0 ? 1 : view.components); first += together) {
      State held[together][1 + most];
      const auto each = [&](auto&& each_word) {
        for (int c = 0; c < together; ++c) {
          const auto chains = static_cast<std::size_t>(view.components) * packet + static_cast<std::size_t>(first + c);
          State* chain = view.chain + chains * static_cast<std::size_t>(1 + units) * lanes + item.lane;
          if (first + c >= view.components) continue;
          for (int l = 0; l <= units; ++l) each_word(held[c][l], chain[static_cast<std::size_t>(l) * lanes]);
        }
      };
      each([](State& here, const State& there) { here = there; });
      for (int c = 0; c < together; ++c) {
        if (first + c >= view.components) continue;
        double x[most > 0 ? most : 1];
        for (int l = 0; l < units; ++l) x[l] = held[c][1 + l];
        const auto unit = [&](int l) -> double& { return x[l]; };
        const double start = held[c][0];
        double& now_f = f[first + c];
        now_f = start + change[first + c];
        if (steps > 0) law.template settle<Units>(2.0 * steps * start + sum[first + c], unit);
        out.drift[first + c] = static_cast<float>(law.template drift<Units>(now_f, unit));
        held[c][0] = static_cast<State>(now_f);
        for (int l = 0; l < units; ++l) held[c][1 + l] = static_cast<State>(x[l]);
      }
      each([](State& here, State& there) { there = here; });
    }
    const auto load = to_centres(out.frame, condensed_load(f, static_cast<double>(view.alpha), m));
    const auto rounded = [](const Vec3<double>& a) { return Vec3<R>{R(a.x), R(a.y), R(a.z)}; };
    out.load = {rounded(load.force_a), rounded(load.moment_a), rounded(load.moment_b)};
    return out;
  }

 private:
  /// Returns three words of a body's displacement, from word `first` on.
  MACADAM_HD static Vec3<double> vector(const double* u, std::int32_t body, int first) {
    const double* w = u + static_cast<std::size_t>(body) * displacement_words + first;
    return {w[0], w[1], w[2]};
  }

  /// Returns the frame of a contact at the end of a whole block (Eq. 5–6 of [1]). ContactForces::carry() is the
  /// counterpart for one step: it also computes the frame in the middle of the step, and finds the previous normal with
  /// a series instead of a root. Both functions use follow_branch() and turn_tangent() (carried_frame.hpp).
  template <class Item>
  MACADAM_HD Placement<double> frame_after_block(const Item& item, std::uint32_t packet, std::size_t slot,
                                                 const Vec3<double>& n0, double arm_a, double arm_b, double d0,
                                                 const double* now, const double* before) const {
    const std::int32_t a = view.body_a[slot], b = view.body_b[slot];
    const Vec3<double> branch = d0 * n0 + (vector(now, b, 0) - vector(now, a, 0));
    Placement<double> out{n0, {}, {}, arm_a, arm_b};
    follow_branch(out, n0, d0, branch, view.wall);
    Vec3<double> n_before = n0;
    if (!view.wall) {
      const Vec3<double> branch_before = d0 * n0 + (vector(before, b, 0) - vector(before, a, 0));
      n_before = (1 / norm(branch_before)) * branch_before;
    }
    const Vec3<double> turned = (vector(now, a, 4) - vector(before, a, 4)) + (vector(now, b, 4) - vector(before, b, 4));
    const double spin = 0.25 * dot(turned, n_before + out.n);
    State* stored =
        view.frame + packet * static_cast<std::size_t>(view.frame_words) * static_cast<std::size_t>(Item::lanes());
    out.s = turn_tangent<double>(item, stored, n_before, out.n, spin).now;
    out.t = cross(out.n, out.s);
    return out;
  }
};

}  // namespace macadam::kernels
