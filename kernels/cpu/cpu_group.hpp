// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cpu_group.hpp  Owns the arrays of one group of contacts on the CPU, and steps the group, with or without
/// blocks of steps.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>

#include "kernels/step/block_length.hpp"
#include "kernels/contact/block_settling.hpp"
#include "kernels/contact/block_step.hpp"
#include "kernels/cpu/pack_item.hpp"

namespace macadam::kernels {

/// Words of a contact's frame within a block: n, arm_a, arm_b, ŝ. They are stored only with updated geometry.
enum PlacedWord { placed_n, placed_arm_a = 3, placed_arm_b, placed_s, placed_words = placed_s + 3 };

/// Steps packets of contacts within a block by model (6.8) (block_step.hpp); `state` and `placed` are the arrays of
/// CpuGroup.
template <class P, Geometry geometry>
struct BlockForces {
  ContactView<P> view{};
  float* state = nullptr;
  const float* placed = nullptr;
  float rate = 0, relax = 0, follow = 0;  ///< rate is multiplied by Δt
  float stiffness = 0;                    ///< rate without Δt [Pa]

  /// Steps the contacts of `item` and returns the changes of their loads. `series`: whether some contact of the group
  /// has rock in series. The choice is made per group, not per packet, because a branch here costs other groups 8 %
  /// (mixed precision, updated geometry).
  template <bool series, class Item>
  ContactLoad<typename Item::template Value<float>> step(const Item& item, std::uint32_t packet,
                                                         const MotionView<P>& motion) const {
    using T = typename Item::template Value<float>;
    const auto slot = static_cast<std::size_t>(packet) * item.lanes();
    const auto* g = view.geometry + slot * static_cast<std::size_t>(view.geometry_words);
    const auto word = [&](int w) { return item.load(g + static_cast<std::size_t>(w) * item.lanes()); };
    Placement<T> frame;
    if constexpr (geometry == Geometry::updated) {
      const auto* own = placed + slot * placed_words;
      const auto of = [&](int w) { return item.load(own + static_cast<std::size_t>(w) * item.lanes()); };
      frame = {{of(placed_n), of(placed_n + 1), of(placed_n + 2)},
               {of(placed_s), of(placed_s + 1), of(placed_s + 2)},
               {},
               of(placed_arm_a),
               of(placed_arm_b)};
      frame.t = cross(frame.n, frame.s);
    } else {
      const Vec3<T> n{word(n_x), word(n_y), word(n_z)};
      frame = canonical_placement(n, item.copysign_one(n.z), word(arm_a), word(arm_b));
    }
    T u[6], change[6] = {T(0), T(0), T(0), T(0), T(0), T(0)};
    relative_rates(frame, item.twist(motion.velocity, view.body_a + slot),
                   item.twist(motion.velocity, view.body_b + slot), u);
    const T alpha(static_cast<float>(view.alpha));
    if constexpr (series)
      advance(item, slot, u, SeriesFactors<T>::of(word(view.series), T(stiffness), alpha), change);
    else
      advance(item, slot, u, SeriesFactors<laws::NoFactor>{}, change);
    T m[6];
    for (int k = 0; k < 6; ++k) m[k] = word(moment_0 + k);
    return to_centres(frame, condensed_load(change, alpha, m));
  }

 private:
  /// Advances the components of a contact by one step of the block.
  template <class Item, class T, class Factors>
  void advance(const Item& item, std::size_t slot, const T (&u)[6], const Factors& factors, T (&change)[6]) const {
    if (view.components == 6)
      advance_first<6>(item, slot, u, factors, change);
    else if (view.components == 3)
      advance_first<3>(item, slot, u, factors, change);
    else
      advance_first<1>(item, slot, u, factors, change);
  }
  /// Advances the first N components by one step of the block.
  template <int N, class Item, class T, class Factors>
  void advance_first(const Item& item, std::size_t slot, const T (&u)[6], const Factors& factors,
                     T (&change)[6]) const {
    float* own = state + slot * 3 * N;
    const auto place = [&](int kind, int c) { return own + static_cast<std::size_t>(kind * N + c) * item.lanes(); };
    for (int c = 0; c < N; ++c) {
      change[c] = item.load(place(0, c));
      T sum = item.load(place(1, c));
      step_in_block_by<T>({T(rate), T(relax), T(follow)}, u[c], item.load(place(2, c)), change[c], sum,
                          factors.of_component(c));
      item.store(place(0, c), change[c]);
      item.store(place(1, c), sum);
    }
  }
};

/// An Item (the access of kernels to memory) for one contact of a packet. Contacts are updated one by one with this
/// Item between two blocks of steps.
template <std::size_t width>
struct OneOfPacket {
  std::size_t lane;
  static constexpr std::size_t lanes() { return width; }
  template <class R>
  R load(const R* p) const {
    return p[lane];
  }
  template <class R>
  void store(R* p, R x) const {
    p[lane] = x;
  }
  template <class To, class From>
  static To convert(From x) {
    return static_cast<To>(x);
  }
  template <class T>
  static T select(bool mask, T yes, T no) {
    return mask ? yes : no;
  }
};

/// A group of contacts. It adds its loads to the array `sums`, [accumulator][8].
template <class P, std::size_t width>
struct CpuGroup {
  using R = typename P::Particle;
  virtual ~CpuGroup() = default;
  /// Steps the packets first … end − 1 and adds their loads to `sums`. During a block, it adds only the changes of the
  /// loads since the block began.
  virtual void run(std::uint32_t first, std::uint32_t end, const MotionView<P>& motion, R* sums) = 0;
  /// Switches blocks on or off. Returns whether the group uses blocks; if not, its contacts are stepped one step at a
  /// time.
  virtual bool use_blocks(bool wanted, double dt) = 0;
  /// Ends a block of `ended` steps (0: no block ends) and begins a block of `steps` steps. settle() must then be called
  /// for all packets.
  virtual void begin_block(int ended, int steps) = 0;
  /// Updates the states of packets first … end − 1 and adds up their current loads. `now`, `before`: as in
  /// BlockSettling.
  virtual void settle(std::uint32_t first, std::uint32_t end, const double* now, const double* before, R* sums) = 0;

  /// bytes(): size of all arrays. step_bytes(): bytes that a step reads and writes. States count twice, because a step
  /// reads and writes them.
  std::int64_t bytes() const { return fixed_bytes() + chain_bytes() + block_bytes(); }
  std::int64_t step_bytes() const {
    if (!in_blocks) return fixed_bytes() + 2 * chain_bytes();
    return fixed_bytes() + block_bytes() + static_cast<std::int64_t>(2 * state.size() / 3 * sizeof(float));
  }
  /// Returns the change of the force density f since the block of steps began, [slot][6]; empty without blocks.
  std::vector<float> changes() const {
    const auto n = static_cast<std::size_t>(arrays.shape.components);
    std::vector<float> out(in_blocks ? 6 * layout->contact.size() : 0, 0);
    for (std::size_t slot = 0; 6 * slot < out.size(); ++slot) {
      for (std::size_t c = 0; c < n; ++c) out[6 * slot + c] = state[(slot / width * 3 * n + c) * width + slot % width];
    }
    return out;
  }

  ContactArrays<P> arrays;
  const GroupLayout* layout = nullptr;
  const std::uint32_t *end_a = nullptr, *end_b = nullptr;  ///< [slot] accumulators of the two ends
  bool in_blocks = false;
  ZeroVector<float> state;   ///< [packet][3][components][lane] δf, Σ (δf' + δf), drift
  ZeroVector<float> placed;  ///< [packet][placed_words][lane]

 private:
  template <class... A>
  static std::int64_t bytes_of(const A&... array) {
    return static_cast<std::int64_t>(((array.size() * sizeof(array[0])) + ...));
  }
  std::int64_t fixed_bytes() const {
    return bytes_of(arrays.body_a, arrays.body_b, arrays.geometry, arrays.points, arrays.packet_layer);
  }
  std::int64_t chain_bytes() const { return bytes_of(arrays.chain, arrays.frame); }
  std::int64_t block_bytes() const { return bytes_of(state, placed); }
};

/// Calls f(packet) for each packet; f returns the loads of its contacts. Adds these loads to the sums. Eight contacts
/// are added at a time, first on their ends A, then on B, so that the order of additions is the same for both packet
/// widths.
template <class Item, class R, class F>
[[gnu::always_inline]] inline void add_up(std::uint32_t first, std::uint32_t end, const std::uint32_t* end_a,
                                          const std::uint32_t* end_b, R* sums, F&& f) {
  constexpr auto lanes = static_cast<std::uint32_t>(Item::lanes()), together = 8 / lanes;
  R *force = sums, *moment = sums + velocity_words / 2;
  for (; first < end; first += together) {
    const std::uint32_t count = std::min(together, end - first);
    decltype(f(first)) load[together];
    for (std::uint32_t k = 0; k < count; ++k) load[k] = f(first + k);
    for (std::uint32_t k = 0; k < count; ++k) {
      Item::scatter_add(force, end_a + (first + k) * lanes, load[k].force_a);
      Item::scatter_add(moment, end_a + (first + k) * lanes, load[k].moment_a);
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      Item::scatter_add(force, end_b + (first + k) * lanes, -load[k].force_a);
      Item::scatter_add(moment, end_b + (first + k) * lanes, load[k].moment_b);
    }
  }
}

/// A group of contacts with the law L, stepped by the functor Forces.
template <class P, std::size_t width, class L, class Forces>
struct CpuGroupOf final : CpuGroup<P, width> {
  using Item = PackItem<width>;
  using R = typename P::Particle;
  /// Whether this law and form can use blocks. Stateless contacts cannot: they have no states that a block could save.
  static constexpr bool has_blocks_here = has_blocks<L> && Forces::form_of == ContactForm::condensed &&
                                          !Forces::stateless && std::is_same_v<typename P::Geometry, float>;
  Forces forces{};
  L law{};

  void run(std::uint32_t first, std::uint32_t end, const MotionView<P>& motion, R* sums) override {
    if constexpr (has_blocks_here) {
      if (this->in_blocks && forces.view.series != 0) return run_block<true>(first, end, motion, sums);
      if (this->in_blocks) return run_block<false>(first, end, motion, sums);
    }
    run_steps(first, end, motion, sums);
  }

  bool use_blocks(bool wanted, double dt) override {
    this->in_blocks = wanted && has_blocks_here;
    if constexpr (has_blocks_here) {
      const ContactView<P>& view = forces.view;
      const std::size_t slots = view.packets * width;
      const bool turns = Forces::geometry_of == Geometry::updated;
      this->state = ZeroVector<float>(this->in_blocks ? 3 * slots * static_cast<std::size_t>(view.components) : 0);
      this->placed = ZeroVector<float>(this->in_blocks && turns ? placed_words * slots : 0);
      dt_ = dt;
      block_.view = view;
      block_.state = this->state.data();
      block_.placed = this->placed.data();
      // The coefficients of a step within a block do not depend on the length of the block
      const auto coefficients = law.block(dt, 1);
      block_.rate = static_cast<float>(coefficients.rate * dt);
      block_.stiffness = static_cast<float>(coefficients.rate);
      block_.relax = static_cast<float>(coefficients.relax);
      block_.follow = static_cast<float>(coefficients.follow);
    }
    return this->in_blocks;
  }

  void begin_block(int ended, int steps) override {
    if constexpr (has_blocks_here) {
      ended_ = ended;
      settling_ =
          std::make_unique<Settling>(Settling{forces.view, block_after(law, dt_, ended > 0 ? ended : steps, steps)});
    }
  }

  void settle(std::uint32_t first, std::uint32_t end, const double* now, const double* before, R* sums) override {
    if constexpr (has_blocks_here) {
      for (std::uint32_t slot = first * width; slot < end * width; ++slot) {
        if (this->layout->contact[slot] != inert) settle(slot, now, before, sums);
      }
    }
  }

 private:
  [[gnu::flatten]] void run_steps(std::uint32_t first, std::uint32_t end, const MotionView<P>& motion, R* sums) {
    add_up<Item>(first, end, this->end_a, this->end_b, sums,
                 [&](std::uint32_t packet) { return forces(Item{}, packet, motion); });
  }
  template <bool series>
  [[gnu::flatten]] void run_block(std::uint32_t first, std::uint32_t end, const MotionView<P>& motion, R* sums) {
    add_up<Item>(first, end, this->end_a, this->end_b, sums,
                 [&](std::uint32_t packet) { return block_.template step<series>(Item{}, packet, motion); });
  }

  /// Updates the contact in one slot and adds its loads to `sums`.
  void settle(std::size_t slot, const double* now, const double* before, R* sums) {
    const OneOfPacket<width> item{slot % width};
    const auto packet = static_cast<std::uint32_t>(slot / width);
    const auto n = static_cast<std::size_t>(forces.view.components);
    float* own = this->state.data() + packet * width * 3 * n + item.lane;
    float change[6] = {0, 0, 0, 0, 0, 0}, sum[6] = {0, 0, 0, 0, 0, 0};
    for (std::size_t c = 0; c < n; ++c) change[c] = own[c * width], sum[c] = own[(n + c) * width];
    const auto [frame, drift, load] = (*settling_)(item, packet, change, sum, now, before, ended_);
    for (std::size_t c = 0; c < n; ++c) own[c * width] = own[(n + c) * width] = 0, own[(2 * n + c) * width] = drift[c];
    if constexpr (Forces::geometry_of == Geometry::updated) {
      float* place = this->placed.data() + packet * width * placed_words + item.lane;
      const double words[placed_words] = {frame.n.x,   frame.n.y, frame.n.z, frame.arm_a,
                                          frame.arm_b, frame.s.x, frame.s.y, frame.s.z};
      for (std::size_t w = 0; w < placed_words; ++w) place[w * width] = static_cast<float>(words[w]);
    }
    add(sums + this->end_a[slot] * velocity_words, load.force_a, load.moment_a);
    add(sums + this->end_b[slot] * velocity_words, -load.force_a, load.moment_b);
  }
  static void add(R* sum, const Vec3<R>& force, const Vec3<R>& moment) {
    sum[0] += force.x, sum[1] += force.y, sum[2] += force.z;
    sum[4] += moment.x, sum[5] += moment.y, sum[6] += moment.z;
  }

  static auto settling_type() {
    if constexpr (has_blocks_here)
      return std::type_identity<BlockSettling<P, typename L::Block, Forces::units_of, Forces::geometry_of>>{};
    else
      return std::type_identity<int>{};
  }
  using Settling = typename decltype(settling_type())::type;

  BlockForces<P, Forces::geometry_of> block_;
  std::unique_ptr<Settling> settling_;
  double dt_ = 0;
  int ended_ = 0;
};

}  // namespace macadam::kernels
