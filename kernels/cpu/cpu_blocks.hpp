// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cpu_blocks.hpp  Decides on the CPU whether steps are taken in blocks and when a block begins and ends, and
/// stores the loads at the beginning of a block. During a block, contacts store only changes of their forces.
/// cpu_group.hpp takes the steps of one group of contacts within a block.
#pragma once

#include <algorithm>
#include <memory>

#include "kernels/step/block_schedule.hpp"
#include "kernels/cpu/cpu_group.hpp"
#include "kernels/step/executor.hpp"
#include "kernels/cpu/tile_accumulators.hpp"

namespace macadam::kernels {

/// The blocks of steps of all groups on the CPU.
template <class P, std::size_t width>
class CpuBlocks {
 public:
  using R = typename P::Particle;
  using Groups = std::vector<std::unique_ptr<CpuGroup<P, width>>>;

  CpuBlocks(const Layout& layout, const TileAccumulators& accumulators)
      : layout_(layout), accumulators_(accumulators) {}

  /// Prepares for a start and returns whether steps are taken in blocks. Blocks shorter than 16 steps are not used,
  /// because the update of the states at the end of a block costs as much time as about ten steps save.
  bool begin(const ExecStart& start) {
    constexpr int shortest = 16;
    const bool possible = std::is_same_v<typename P::Geometry, float> && start.options.form == ContactForm::condensed;
    const int steps = possible ? block_steps(start.options, start.laws, start.size) : 0;
    schedule_.begin(steps < shortest ? 0 : steps, start.options.observed_every > 0);
    on_ = steps >= shortest;
    dt_ = start.options.dt;
    base_.assign(on_ ? accumulators_.size() * velocity_words : 0, R(0));
    const bool turns = on_ && start.options.geometry == Geometry::updated;
    before_.assign(turns ? (layout_.particles() + walls) * displacement_words : 0, 0.0);
    return on_;
  }

  void add_states(StateList& states) {
    if (!on_) return;
    states.add("base_sums", "N, N m", base_);  // not reordered, because the tiles are the same on all CPUs
    states.add("displacement_at_block", "m, rad", before_, [this] { return body_order(layout_, displacement_words); });
    schedule_.add_state(states);
  }

  /// Makes group `number` use blocks if it can, and adds its block states to `states`.
  void use(CpuGroup<P, width>& group, std::size_t number, StateList& states) const {
    if (!group.use_blocks(on_, dt_)) return;
    const GroupLayout& of = layout_.groups[number];
    const auto add = [&](const char* name, const char* unit, auto& array, std::size_t words) {
      states.add(std::string(name) + "_" + to_string(of.pair), unit, array,
                 [this, &of, words] { return contact_order(layout_, of, words, false); });
    };
    add("block_state", "Pa m", group.state, 3 * static_cast<std::size_t>(group.arrays.shape.components));
    add("block_frame", "1, m", group.placed, placed_words);
  }

  /// Begins a block if one is due before step `first`, and returns how many of the `steps` steps may be taken before
  /// the next call. `displacement`: displacements of all bodies.
  std::int64_t next(std::int64_t first, std::int64_t steps, const Groups& groups,
                    const AlignedVector<double>& displacement, int threads) {
    if (!on_) return steps;
    if (schedule_.is_due()) settle(schedule_.next(first), groups, displacement, threads);
    const std::int64_t out = std::min(steps, schedule_.left());
    schedule_.take(out);
    return out;
  }

  /// Initialises the load sums first … end − 1, to which the contacts then add. If steps are taken in blocks, a contact
  /// adds only the change of its load since the block began, so the sums begin with the base loads (the loads at the
  /// beginning of the block). Otherwise the sums begin with zero.
  void begin_sums(std::size_t first, std::size_t end, AlignedVector<R>& sums) const {
    if (on_)
      std::copy(base_.data() + first, base_.data() + end, sums.data() + first);
    else
      std::fill(sums.data() + first, sums.data() + end, R(0));
  }

  std::int64_t step_bytes() const { return static_cast<std::int64_t>(base_.size() * sizeof(R)); }
  std::int64_t bytes() const { return step_bytes() + static_cast<std::int64_t>(before_.size() * sizeof(double)); }

 private:
  /// Ends the block in progress, if there is one, and begins the next with `steps` steps.
  void settle(int steps, const Groups& groups, const AlignedVector<double>& displacement, int threads) {
    if (!schedule_.has_begun()) keep(displacement);
    for (const auto& group : groups) group->begin_block(schedule_.ended(), steps);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::size_t tile = 0; tile < layout_.tiles(); ++tile) {
      const auto* begin = accumulators_.tile_begin.data() + tile;
      std::fill(base_.data() + begin[0] * velocity_words, base_.data() + begin[1] * velocity_words, R(0));
      for (const auto& group : groups) {
        if (!group->in_blocks) continue;
        const auto& packets = group->layout->tile_packet;
        group->settle(packets[tile], packets[tile + 1], displacement.data(), before_.data(), base_.data());
      }
    }
    keep(displacement);
    schedule_.start(steps);
  }
  /// Keeps the displacements at the beginning of the block.
  void keep(const AlignedVector<double>& displacement) {
    if (!before_.empty()) before_ = displacement;
  }

  const Layout& layout_;
  const TileAccumulators& accumulators_;
  BlockSchedule schedule_;
  bool on_ = false;
  double dt_ = 0;
  AlignedVector<R> base_;         // [accumulator][8]
  AlignedVector<double> before_;  // [body][8] displacements at the beginning of the block; with updated geometry only
};

}  // namespace macadam::kernels
