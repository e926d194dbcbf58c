// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_positions.hpp  Maps the contacts of the layout's groups to their positions in the tiles (a tile is the
/// part of the specimen that one thread block steps).
///
/// A contact has one slot in its group (layout.hpp), and one or two positions in TilePlan::contact: a contact between
/// particles of two tiles is in both. TileData fills the map in add_contacts() and uploads it in start(). The
/// kernels between two blocks of steps use it to find the words of a slot's contact (settle_kernels.hpp), and
/// checkpoints use it to write the tiles' words in the order of the network.
///
/// Words: a slot is numbered over all groups, one group after the other; a position is packet · 32 + lane.
/// docs/gpu-step.md explains the whole path.
#pragma once

#include <utility>
#include <vector>

#include "kernels/cuda/device/device_store.hpp"
#include "kernels/cuda/multi_gpu/device_team.hpp"
#include "kernels/cuda/tiles/tile_step.hpp"

namespace macadam::kernels {

/// The positions of every slot. They are on the host until keep(), then on the device.
class TilePositions {
 public:
  explicit TilePositions(const Layout& layout) : layout_(layout) {
    for (const auto& group : layout.groups) {
      first_slot_.push_back(slots_);
      slots_ += group.contact.size();
    }
    positions_.assign(slots_, uint2{UINT32_MAX, UINT32_MAX});
  }

  /// Number of slots of all groups; first slot of one group.
  std::size_t slots() const { return slots_; }
  std::size_t first_slot(std::size_t group) const { return first_slot_[group]; }

  /// Adds `position` to the positions of a slot's contact.
  void add(std::size_t group, std::size_t slot, std::uint32_t position) {
    uint2& of_slot = positions_[first_slot_[group] + slot];
    (of_slot.x == UINT32_MAX ? of_slot.x : of_slot.y) = position;
  }
  /// Calls f(member, positions) for the slots of each member of the team; only before keep().
  template <class F>
  void for_each_slot(const TeamCuts& cuts, F&& f) const {
    each_slot(*this, cuts, f);
  }
  /// Orders the two positions of each slot so that the first belongs to the slot's own member, because the update
  /// between two blocks of steps reads the first one. `owner`: position → member.
  template <class Owner>
  void own_first(const TeamCuts& cuts, Owner&& owner) {
    each_slot(*this, cuts, [&](std::size_t m, uint2& position) {
      if (position.y != UINT32_MAX && owner(position.x) != m) std::swap(position.x, position.y);
    });
  }
  /// Uploads the positions; none can be added after this.
  void keep(DeviceStore& store, const Shares& shares) {
    on_device_ = store.keep(positions_, shares);
    positions_ = {};
  }
  const uint2* on_device() const { return on_device_; }

  /// Returns the order in which a checkpoint stores an array of the tiles: contacts in the order of the network.
  /// `count`: words per contact in the array; `fields`: the numbers of a contact that are stored.
  StateOrder order(int count, const std::vector<TileContactWords::Field>& fields) const {
    const std::vector<uint2> positions = copied(0, slots_);
    const auto at = [&](std::uint32_t position) {
      return position == UINT32_MAX ? StateOrder::none : std::uint64_t{TileContactWords::first(position, count)} * 4;
    };
    StateOrder out;
    for (const auto& field : fields) {
      for (int k = 0; k < field.components; ++k)
        out.word.push_back(static_cast<std::uint64_t>(field.word) * 32 * 4 + static_cast<std::uint64_t>(k));
    }
    for (std::size_t g = 0; g < layout_.groups.size(); ++g) {
      for (const std::uint32_t slot : slots_in_order(layout_.groups[g])) {
        const uint2 position = positions[first_slot_[g] + slot];
        out.first.push_back(at(position.x));
        out.twin.push_back(at(position.y));
      }
    }
    return out;
  }

  /// Returns δf of the contacts of a group, [slot][6], from the tiles' states. δf is the change of the force density
  /// since the block of steps began. `count`: size of `state`.
  std::vector<float> changes(std::size_t group, const float4* state, std::size_t count) const {
    std::vector<float4> all(count);
    copy_now(all.data(), state, count * sizeof(float4), "states");
    const std::vector<uint2> positions = copied(first_slot_[group], layout_.groups[group].contact.size());
    std::vector<float> out(6 * positions.size(), 0.0f);
    for (std::size_t slot = 0; slot < positions.size(); ++slot) {
      const std::uint32_t position = positions[slot].x;
      if (position == UINT32_MAX) continue;
      float change[6], sum[6];
      TileContactWords::read_state<false>(TileContactWords::at(all.data(), position, TileContactWords::states), change,
                                          sum);
      std::copy(change, change + 6, &out[6 * slot]);
    }
    return out;
  }

 private:
  template <class Self, class F>
  static void each_slot(Self& self, const TeamCuts& cuts, F&& f) {
    for (std::size_t g = 0; g < self.layout_.groups.size(); ++g) {
      const GroupLayout& group = self.layout_.groups[g];
      for (std::size_t m = 0; m < cuts.members(); ++m) {
        for (std::size_t s = cuts.slot(group, m); s < cuts.slot(group, m + 1); ++s)
          f(m, self.positions_[self.first_slot_[g] + s]);
      }
    }
  }
  /// Returns a host copy of the positions of some slots.
  std::vector<uint2> copied(std::size_t first, std::size_t count) const {
    std::vector<uint2> out(count);
    if (count > 0) copy_now(out.data(), on_device_ + first, count * sizeof(uint2), "positions");
    return out;
  }

  const Layout& layout_;
  std::size_t slots_ = 0;
  std::vector<std::size_t> first_slot_;  // [group]
  std::vector<uint2> positions_;         // empty after keep()
  const uint2* on_device_ = nullptr;
};

}  // namespace macadam::kernels
