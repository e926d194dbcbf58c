// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_step.hpp  Takes one step of one contact: kinematics, law, load. SIMD packs on the CPU and threads on
/// the GPU share this code.
///
/// An Item loads and stores the words of a contact: `PackItem` (pack_item.hpp) handles all contacts of a packet at
/// once, `LaneItem` (lane_item.hpp) one contact of a packet. A step of a condensed contact with L Kelvin units
/// reads and writes 6·(1 + L) states and reads 11 to 13 words of geometry and two bodies.
#pragma once

#include <type_traits>

#include "kernels/contact/carried_frame.hpp"
#include "kernels/contact/contact_data.hpp"
#include "kernels/contact/contact_kinematics.hpp"
#include "kernels/contact/series_factors.hpp"
#include "macadam/laws/law.hpp"

namespace macadam::kernels {

/// Motion of the bodies, eight words per body, so that one body fills one cache line: v, –, ω, – and u, –, θ, –.
template <class P>
struct MotionView {
  const typename P::Geometry* velocity;  ///< [body][8] at the half step [m/s, rad/s]
  const double* displacement;            ///< [body][8] at the whole step [m, rad]
};
inline constexpr int velocity_words = 8;
inline constexpr int displacement_words = 8;

/// Returns `Units` or, if it is −1, the largest number of units of a coupled law.
template <class LawStep, int Units>
constexpr int most_units_of() {
  if constexpr (Units < 0 && requires { LawStep::most_units; })
    return LawStep::most_units;
  else
    return Units;
}

/// Functor that steps the contacts of one group. Everything that may branch (form, geometry, law, units) is a template
/// argument. `Units`: exact number of Kelvin units; 5 means at most five, all in registers; −1 means any number.
/// `with_series`: whether the group may have contacts with rock in series; if false, no code for them is compiled.
template <class P, class LawStep, int Units, ContactForm form, Geometry geometry, bool with_series = true>
struct ContactForces {
  using Policy = P;
  static constexpr ContactForm form_of = form;
  static constexpr Geometry geometry_of = geometry;
  static constexpr int units_of = Units;
  /// Whether the force density f follows from the current displacements, so that no state is read or written.
  static constexpr bool stateless = LawStep::memoryless && geometry == Geometry::fixed;
  /// Whether the law advances the three components of a contact point together.
  static constexpr bool coupled = coupled_step<LawStep>;
  static_assert(!coupled || form == ContactForm::points, "a coupled law is stepped by points");
  /// Precision in which a contact is computed. If the force follows from the displacement alone, it is computed in the
  /// precision of a state. In lower precision it would be rounded in the same way whenever the particles return to the
  /// same position; such errors do not average out, and the energy would drift.
  using Work = std::conditional_t<stateless, typename P::State, typename P::Geometry>;
  ContactView<P> view;
  LawStep law;
  typename P::State dt;  ///< [s]

  /// Returns the functor for a group without rock in series.
  ContactForces<P, LawStep, Units, form, geometry, false> without_series() const { return {view, law, dt}; }

  /// Steps the contacts of `item` and returns their loads.
  template <class Item>
  MACADAM_HD ContactLoad<typename Item::template Value<Work>> operator()(const Item& item, std::uint32_t packet,
                                                                         const MotionView<P>& motion) const {
    using T = typename Item::template Value<Work>;
    const auto slot = static_cast<std::size_t>(packet) * item.lanes();
    const std::int32_t *ia = view.body_a + slot, *ib = view.body_b + slot;
    const auto* g = view.geometry + slot * static_cast<std::size_t>(view.geometry_words);
    auto word = [&](int w) {
      return item.template convert<Work>(item.load(g + static_cast<std::size_t>(w) * item.lanes()));
    };

    const Vec3<T> n0{word(n_x), word(n_y), word(n_z)};
    Placement<T> now, middle;  // frame in which the load acts, and frame at the half step, for the velocities
    T u[6];                    // relative rates; relative displacements if the contact is stateless
    if constexpr (stateless) {
      now = canonical_placement(n0, item.copysign_one(n0.z), word(arm_a), word(arm_b));
      const auto* turn = motion.displacement + displacement_words / 2;
      relative_rates(
          now, Twist<T>{{T(0), T(0), T(0)}, item.template vector<Work>(turn, ia)},
          Twist<T>{item.template relative<Work>(motion.displacement, ia, ib), item.template vector<Work>(turn, ib)}, u);
    } else {
      const Twist<T> a = item.twist(motion.velocity, ia), b = item.twist(motion.velocity, ib);
      if constexpr (geometry == Geometry::fixed) {
        now = middle = canonical_placement(n0, item.copysign_one(n0.z), word(arm_a), word(arm_b));
      } else {
        now.arm_a = word(arm_a);
        now.arm_b = word(arm_b);
        carry(item, packet, motion, ia, ib, a, b, n0, word(distance), now, middle);
      }
      relative_rates(middle, a, b, u);
    }

    // Without rock in series, the factors compile to nothing
    const auto with_factors = [&](auto&& f) {
      if constexpr (with_series && takes_factor<LawStep>) {
        if (view.series != 0) {
          const auto factors = SeriesFactors<T>::of(word(view.series), T(static_cast<Work>(law.step_stiffness())),
                                                    T(static_cast<Work>(view.alpha)));
          const auto state = [&](const T& x) { return item.template convert<typename P::State>(x); };
          using S = typename Item::template Value<typename P::State>;
          f(SeriesFactors<S>{state(factors.normal), state(factors.shear)});
          return;
        }
      }
      f(SeriesFactors<laws::NoFactor>{});
    };
    if constexpr (form == ContactForm::condensed) {
      T density[6] = {T(0), T(0), T(0), T(0), T(0), T(0)};
      typename P::State* chain = view.chain + slot * chain_words();
      with_factors([&](const auto& factors) {
        if (view.components == 6)
          advance_chains<6>(item, u, chain, factors, density);
        else if (view.components == 3)
          advance_chains<3>(item, u, chain, factors, density);
        else
          advance_chains<1>(item, u, chain, factors, density);
      });
      T m[6];
      for (int k = 0; k < 6; ++k) m[k] = word(moment_0 + k);
      return to_centres(now, condensed_load(density, T(view.alpha), m));
    } else {
      FacetLoad<T> load;
      if constexpr (coupled)
        load = coupled_points_load(item, packet, u, word(distance));
      else
        with_factors([&](const auto& factors) { load = points_load(item, packet, u, factors); });
      return to_centres(now, load);
    }
  }

 private:
  /// Largest number of units of a coupled law. For a coupled law, `Units` is always exact.
  static constexpr int coupled_units = most_units_of<LawStep, Units>();
  MACADAM_HD int units() const { return Units >= 0 && (Units != 5 || coupled) ? Units : view.units; }
  MACADAM_HD std::size_t chain_words() const { return static_cast<std::size_t>(view.components * (1 + units())); }
  /// Returns the number of words from the beginning of a contact's chain to the beginning of its next chain.
  template <class Item>
  MACADAM_HD std::size_t chain_stride(const Item& item) const {
    return static_cast<std::size_t>(1 + units()) * item.lanes();
  }

  /// Advances the first N chains of a contact (a chain is the force density and the Kelvin units of one displacement
  /// component). A thread that handles one contact loads all of them before it stores the first, because a compiler
  /// cannot move a load past a store that may have the same address.
  template <int N, class Item, class T, class Factors>
  MACADAM_HD void advance_chains(const Item& item, const T (&u)[6], typename P::State* chain, const Factors& factors,
                                 T (&density)[6]) const {
    if constexpr (!stateless && Units >= 0 && requires { Item::staged; }) {
      using S = typename P::State;
      S state[N][1 + Units];  // units that the law does not have get zero displacements and coefficients
      const auto place = [&](int c, int l) { return chain + (c * (1 + units()) + l) * item.lanes(); };
      for (int c = 0; c < N; ++c) {
        for (int l = 0; l <= Units; ++l) state[c][l] = l <= units() ? item.load(place(c, l)) : S(0);
      }
      for (int c = 0; c < N; ++c) {
        auto unit = [&](int l) -> S& { return state[c][1 + l]; };
        state[c][0] = law_step<Units>(state[c][0], S(u[c]) * dt, unit, factors.of_component(c));
        density[c] = static_cast<T>(state[c][0]);
      }
      for (int c = 0; c < N; ++c) {
        for (int l = 0; l <= Units; ++l) {
          if (l <= units()) item.store(place(c, l), state[c][l]);
        }
      }
    } else {
      for (int c = 0; c < N; ++c)
        density[c] =
            advance(item, u[c], chain + chain_stride(item) * static_cast<std::size_t>(c), factors.of_component(c));
    }
  }

  /// Calls advance() of the law, without the last argument if the factor is 1: a law need not have this argument.
  template <int L, class S, class Units_, class Factor>
  MACADAM_HD S law_step(const S& f, const S& dx, Units_&& unit, const Factor& factor) const {
    if constexpr (std::is_same_v<Factor, laws::NoFactor>)
      return law.template advance<L>(f, dx, unit);
    else
      return law.template advance<L>(f, dx, unit, factor);
  }

  /// Advances one chain by one step with the relative rate `rate` of its displacement component, and returns its force
  /// density f. If the contact is stateless, `rate` is the displacement, from which f follows. `factor`: SeriesFactors.
  template <class Item, class T, class Factor>
  MACADAM_HD T advance(const Item& item, const T& rate, typename P::State* chain, const Factor& factor) const {
    using S = typename Item::template Value<typename P::State>;
    if constexpr (stateless) { return factor * law.value(rate); }
    const S dx = item.template convert<typename P::State>(rate) * S(dt);
    const auto place = [&](int l) { return chain + static_cast<std::size_t>(1 + l) * item.lanes(); };
    if constexpr (Units >= 0 && requires { Item::staged; }) {
      S x[Units + 1];
      const S before = item.load(chain);
      for (int l = 0; l < Units; ++l) x[l] = l < units() ? item.load(place(l)) : S(0);
      const S f = law_step<Units>(
          before, dx, [&](int l) -> S& { return x[l]; }, factor);
      item.store(chain, f);
      for (int l = 0; l < Units; ++l) {
        if (l < units()) item.store(place(l), x[l]);
      }
      return static_cast<T>(f);
    } else {
      auto unit = [&](int l) -> decltype(auto) { return item.ref(place(l)); };
      const S f = law_step<Units, S>(item.load(chain), dx, unit, factor);
      item.store(chain, f);
      return item.template convert<Work>(f);
    }
  }

  /// Returns the sum of the loads of the contact points (Eq. 3, 4; model (8.1)). Each point has its own chains.
  template <class Item, class T, class Factors>
  MACADAM_HD FacetLoad<T> points_load(const Item& item, std::uint32_t packet, const T (&u)[6],
                                      const Factors& factors) const {
    FacetLoad<T> load{T(0), T(0), T(0), T(0), T(0), T(0)};
    for (std::uint32_t layer = view.packet_layer[packet]; layer < view.packet_layer[packet + 1]; ++layer) {
      const auto* point = view.points + static_cast<std::size_t>(layer) * point_words * item.lanes();
      const auto of = [&](std::size_t w) { return item.template convert<Work>(item.load(point + w * item.lanes())); };
      const T s = of(point_s), t = of(point_t), weight = of(point_weight);
      typename P::State* chain = view.chain + static_cast<std::size_t>(layer) * chain_words() * item.lanes();
      const T n = weight * advance(item, u[0] + s * u[1] + t * u[2], chain, factors.normal);
      T along_s(0), along_t(0);
      if (view.components == 3) {
        const T shear = T(view.alpha) * weight;
        along_s = shear * advance(item, u[3] - t * u[5], chain + chain_stride(item), factors.shear);
        along_t = shear * advance(item, u[4] + s * u[5], chain + 2 * chain_stride(item), factors.shear);
      }
      add_point(load, s, t, n, along_s, along_t);
    }
    return load;
  }

  /// Returns the sum of the loads of the contact points for a law that advances the three components of a point
  /// together. `d`: distance of the contact.
  template <class Item, class T>
  MACADAM_HD FacetLoad<T> coupled_points_load(const Item& item, std::uint32_t packet, const T (&u)[6],
                                              const T& d) const {
    using S = typename Item::template Value<typename P::State>;
    const auto of = [&](const T& x) { return item.template convert<typename P::State>(x); };
    FacetLoad<T> load{T(0), T(0), T(0), T(0), T(0), T(0)};
    for (std::uint32_t layer = view.packet_layer[packet]; layer < view.packet_layer[packet + 1]; ++layer) {
      const auto* point = view.points + static_cast<std::size_t>(layer) * point_words * item.lanes();
      const auto word = [&](std::size_t w) { return item.template convert<Work>(item.load(point + w * item.lanes())); };
      const T s = word(point_s), t = word(point_t), weight = word(point_weight);
      const S dx[3] = {of(u[0] + s * u[1] + t * u[2]) * S(dt), of(u[3] - t * u[5]) * S(dt),
                       of(u[4] + s * u[5]) * S(dt)};
      typename P::State* chain = view.chain + static_cast<std::size_t>(layer) * chain_words() * item.lanes();
      const int last = Units >= 0 ? Units : view.units;
      const auto place = [&](int c, int l) {
        return chain + static_cast<std::size_t>(c * (1 + last) + l) * item.lanes();
      };
      S state[3][1 + coupled_units];
      for (int c = 0; c < 3; ++c) {
        for (int l = 0; l <= last; ++l) state[c][l] = item.load(place(c, l));
      }
      law.template advance_point<Units>(dx, of(d), [&](int c, int l) -> S& { return state[c][l]; });
      for (int c = 0; c < 3; ++c) {
        for (int l = 0; l <= last; ++l) item.store(place(c, l), state[c][l]);
      }
      add_point(load, s, t, weight * item.template convert<Work>(state[0][0]),
                T(view.alpha) * weight * item.template convert<Work>(state[1][0]),
                T(view.alpha) * weight * item.template convert<Work>(state[2][0]));
    }
    return load;
  }

  /// Adds the forces n, along_s and along_t of a point (s, t) along n, ŝ and t̂, with their moments.
  template <class T>
  MACADAM_HD static void add_point(FacetLoad<T>& load, const T& s, const T& t, const T& n, const T& along_s,
                                   const T& along_t) {
    load.n += n;
    load.moment_s += t * n;
    load.moment_t -= s * n;
    load.s += along_s;
    load.t += along_t;
    load.moment_n += s * along_t - t * along_s;
  }

  /// Updates the frame in every step by Eq. 5–6 (docs/model.md, section 9): computes the normal from the displaced
  /// centres, moves x0 by half the change of distance, turns the frame with the normal, and rotates it about the normal
  /// by the mean spin of the two bodies. `middle` is the frame half a step earlier; rates are computed in it. In the
  /// frame at the beginning or the end of the step, a rigid rotation of the pair by θ would seem to open the contact by
  /// (1 − cos θ)·d per step.
  template <class Item, class T>
  MACADAM_HD void carry(const Item& item, std::uint32_t packet, const MotionView<P>& motion, const std::int32_t* ia,
                        const std::int32_t* ib, const Twist<T>& a, const Twist<T>& b, const Vec3<T>& n0, const T& d0,
                        Placement<T>& now, Placement<T>& middle) const {
    using State = typename P::State;
    using S = typename Item::template Value<State>;
    const Vec3<T> branch = d0 * n0 + item.template relative<typename P::Geometry>(motion.displacement, ia, ib);
    const Vec3<T> step = T(static_cast<typename P::Geometry>(dt)) * (b.linear - a.linear);
    const Distance<T> d = follow_branch(now, n0, d0, branch, view.wall);
    Vec3<T> n_before = n0;
    middle = now;
    if (view.wall) {
      middle.arm_a = now.arm_a - T(0.5f) * dot(step, n0);
    } else {
      // The branch vector hardly changes its length within a step. So the branch vector before the step, multiplied by
      // the inverse of its present length (d.inverse), has nearly unit length, and the series for 1/√x near 1
      // normalises it.
      const Vec3<T> branch_before = branch - step;
      n_before = d.inverse * branch_before;
      n_before = inverse_root_near_one(dot(n_before, n_before)) * n_before;
      const T d_before = dot(branch_before, n_before);
      middle.n = T(0.5f) * (now.n + n_before);
      middle.n = inverse_root_near_one(dot(middle.n, middle.n)) * middle.n;
      const T to_middle = T(0.25f) * (d_before - d.length);
      middle.arm_a += to_middle;
      middle.arm_b += to_middle;
    }
    const T spin_rate = T(0.5f) * dot(a.angular + b.angular, middle.n);

    State* stored =
        view.frame + static_cast<std::size_t>(packet) * static_cast<std::size_t>(view.frame_words) * item.lanes();
    const auto turned =
        turn_tangent<State>(item, stored, converted<State>(item, n_before), converted<State>(item, now.n),
                            S(item.template convert<State>(spin_rate) * S(dt)));
    Vec3<S> s_middle = S(0.5f) * (turned.before + turned.now);
    const Vec3<S> nm = converted<State>(item, middle.n);
    s_middle -= dot(s_middle, nm) * nm;  // removes the small component along nm
    s_middle = inverse_root_near_one(dot(s_middle, s_middle)) * s_middle;
    now.s = converted<typename P::Geometry>(item, turned.now);
    now.t = cross(now.n, now.s);
    middle.s = converted<typename P::Geometry>(item, s_middle);
    middle.t = cross(middle.n, middle.s);
  }

  /// Returns v in another scalar type.
  template <class To, class Item, class T>
  MACADAM_HD static auto converted(const Item& item, const Vec3<T>& v) {
    return Vec3<typename Item::template Value<To>>{item.template convert<To>(v.x), item.template convert<To>(v.y),
                                                   item.template convert<To>(v.z)};
  }
};

}  // namespace macadam::kernels
