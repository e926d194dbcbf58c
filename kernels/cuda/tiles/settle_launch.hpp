// SPDX-License-Identifier: GPL-3.0-or-later
/// \file settle_launch.hpp  Launches the kernel that updates contacts between two blocks of steps (settle_contacts in
/// settle_kernels.hpp).
///
/// TileBlocks owns one Settling. set_group() stores the law of each group; run() computes the coefficients for the
/// lengths of the block that ends and of the block that begins (only if they changed) and launches the kernel on every
/// device. docs/gpu-step.md explains the whole path.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "kernels/step/block_length.hpp"
#include "kernels/cuda/tiles/settle_kernels.hpp"
#include "kernels/cuda/multi_gpu/device_team.hpp"

namespace macadam::kernels {

/// Arrays of the tiles and bodies that settling reads and writes, in addition to the arrays of each group.
template <class P>
struct SettledArrays {
  float4* constant;            ///< constants of the contacts in tiles, written
  const float4* state;         ///< states (δf and sum) of the contacts in tiles
  const double *now, *before;  ///< displacements now, and at the beginning of the block [body][8]
  LoadRecords<typename P::Particle> records;
  const uint2* position;  ///< [slot of all groups] the positions of its contact in the tiles
};

/// Launches the update of all groups on all devices of a team.
template <class P, class AnyLaw>
class Settling {
 public:
  Settling(const DeviceTeam& team, const TeamCuts& cuts, const Layout& layout) : team_(team), ranges_(team.size()) {
    for (std::size_t m = 0; m < team.size(); ++m) {
      for (std::size_t g = 0; g < layout.groups.size(); ++g)
        ranges_[m].add(static_cast<int>(g), cuts.slot(layout.groups[g], m), cuts.slot(layout.groups[g], m + 1));
    }
  }

  /// Sets the law of group `number` for steps of `dt`. `first_slot`: number of its first slot among all groups.
  /// `series`: whether some contact of any group has rock in series.
  template <Geometry geometry, class L>
  void set_group(int number, std::size_t first_slot, const L& law, const ContactView<P>& view, double dt, bool series) {
    using Groups = SettleGroups<P, AnyLaw, geometry>;
    if (!groups_) groups_ = std::make_shared<Groups>();
    auto groups = std::static_pointer_cast<Groups>(groups_);
    groups->group[number].first_slot = static_cast<std::uint32_t>(first_slot);
    fill_[number] = [groups, number, law, view, dt, series](int ended, int steps) {
      const auto block = block_after(law, dt, ended, steps);
      dispatch_units<false>(law, [&](auto units) {
        groups->group[number].functor.put(
            SettleContact<P, typename L::Block, units(), geometry>{{view, block}, series});
      });
    };
    filled_ended_ = filled_steps_ = 0;  // so that run() computes coefficients for the new law and time step
    launch_ = [this, groups](int ended, const SettledArrays<P>& a) {
      groups->position = a.position;
      team_.each([&](std::size_t m) {
        launch("settling", settle_contacts<P, AnyLaw, geometry>, ranges_[m].blocks, contact_threads, 0, team_.stream(m),
               *groups, ranges_[m], a.constant, a.state, a.now, a.before, ended, a.records);
      });
    };
  }

  /// Enqueues the update between two blocks: the block that ends had `ended` steps, the next one has `steps`. `ended`
  /// is 0 if no block has ended, and settling_starts if nothing was stepped yet; the constants then get their values
  /// for the undeformed contact.
  void run(int ended, int steps, const SettledArrays<P>& arrays) {
    if (!launch_) return;
    const int known = ended > 0 ? ended : steps;
    if (filled_ended_ != known || filled_steps_ != steps) {
      filled_ended_ = known, filled_steps_ = steps;
      for (const auto& fill : fill_) {
        if (fill) fill(known, steps);
      }
    }
    launch_(ended, arrays);
  }

 private:
  const DeviceTeam& team_;
  std::vector<SettleRanges> ranges_;  // [member]
  std::shared_ptr<void> groups_;
  // [group] computes coefficients for the lengths of the block that ends and of the one that begins
  std::array<std::function<void(int, int)>, pair_types> fill_;
  int filled_ended_ = 0, filled_steps_ = 0;
  std::function<void(int, const SettledArrays<P>&)> launch_;
};

}  // namespace macadam::kernels
