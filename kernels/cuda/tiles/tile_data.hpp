// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_data.hpp  Owns the plan of the tiles (parts of the specimen, one per thread block) and their arrays on
/// the devices: uploads them, resets them for a start, and copies them for checkpoints.
///
/// ExecCudaTiles owns one TileData and calls it in the order of executor.hpp: add_contacts() for each group (first
/// start only), set_law() for each group, and start(). TileLaunch and TileBlocks read and change the arrays through
/// arrays() and settled(). docs/gpu-step.md explains the terms.
#pragma once

#include <memory>
#include <utility>

#include "kernels/cuda/common/load_record_order.hpp"
#include "kernels/cuda/device/device_store.hpp"
#include "kernels/cuda/device/tuning.hpp"
#include "kernels/cuda/tiles/contact_positions.hpp"
#include "kernels/cuda/tiles/rank_messages.hpp"
#include "kernels/cuda/tiles/settle_launch.hpp"

namespace macadam::kernels {

/// The tiles of one specimen in the memory of the devices of a team.
template <class P>
class TileData {
 public:
  using R = typename P::Particle;

  /// Takes ownership of `plan`.
  TileData(const DeviceTeam& team, const TeamCuts& cuts, const Layout& layout, TilePlan plan, TileContent content,
           const std::optional<Crossing>& crossing)
      : team_(team),
        cuts_(cuts),
        crossing_(crossing),
        layout_(layout),
        plan_(std::move(plan)),
        owners_(plan_, cuts),
        content_(content),
        carried_(content.carried),
        bodies_(layout.particles()),
        constants_(plan_.contact.size() * static_cast<std::size_t>(TileContactWords::constants(carried_))),
        positions_(layout),
        tables_(team.size()) {
    arrays_.most_bodies = plan_.most_bodies;
    arrays_.most_locals = plan_.most_locals;
    arrays_.most_cells = plan_.most_cells;
    arrays_.places = static_cast<std::uint32_t>(plan_.body.size());
  }
  TileData(const TileData&) = delete;

  const std::vector<Tile>& tiles() const { return plan_.tile; }
  const TileOwners& owners() const { return owners_; }
  const TileMessages<P>& messages() const { return messages_; }
  TileContent content() const { return content_; }
  bool carried() const { return carried_; }
  /// Number of particles.
  std::size_t particles() const { return bodies_; }
  std::size_t first_slot(int group) const { return positions_.first_slot(static_cast<std::size_t>(group)); }

  /// Packs the constants of the contacts of group `number` for the tiles. `view` points to device arrays.
  void add_contacts(int number, const ContactArrays<P>& arrays, const ContactView<P>& view) {
    const auto g = static_cast<std::uint32_t>(number);
    for (std::size_t i = 0; i < plan_.contact.size(); ++i) {
      const TileContact& c = plan_.contact[i];
      if (c.group_slot == UINT32_MAX || c.group != g) continue;
      positions_.add(g, c.group_slot, static_cast<std::uint32_t>(i));
      const auto words = static_cast<std::size_t>(view.geometry_words);
      const auto* geo = &arrays.geometry[c.group_slot / 32 * words * 32 + c.group_slot % 32];
      TileContactWords::pack(constant_of(i), c, [&](int w) { return static_cast<float>(geo[w * 32]); });
    }
  }
  /// Sets the coefficients of a step of group `number`; see TileArrays::law.
  void set_law(int number, const float4& coefficients) { arrays_.law[number] = coefficients; }

  /// Uploads the arrays (the first time) and sets everything to its value before the first step.
  void start(const ParticleMotion<P>& motion, const LoadLists& lists) {
    arrays_.motion = motion;
    if (!std::exchange(uploaded_, true)) upload(lists);
    wall_table_ = motion.wall.table;
    const std::size_t loads = (bodies_ + walls) * velocity_words;
    clear(arrays_.state, state_count_);
    clear(base_, loads);
    clear(arrays_.force, loads);
    if (motion.body.weight) {
      launch("weights", begin_with_weight<R>, (bodies_ + short_kernel_threads - 1) / short_kernel_threads,
             short_kernel_threads, 0, team_.stream(), motion.body.weight, static_cast<std::uint32_t>(bodies_),
             arrays_.force);
    }
    clear(arrays_.wall_load, wall_load_count_);
    clear(before_, (bodies_ + walls) * displacement_words);
  }
  bool is_uploaded() const { return uploaded_; }
  /// Clears the velocities exchanged between tiles, and their tags.
  void clear_exchange() {
    clear(arrays_.even, exchange_words());
    clear(arrays_.odd, exchange_words());
  }
  std::size_t exchange_words() const { return 2 * (std::size_t{arrays_.places} + walls); }

  /// Returns the arguments of a launch on the first member; arrays_of() returns the arguments for another member.
  TileArrays<P>& arrays() { return arrays_; }
  const TileArrays<P>& arrays() const { return arrays_; }
  /// Returns the arguments of a launch on member m.
  TileArrays<P> arrays_of(std::size_t m) const {
    TileArrays<P> out = arrays_;
    const Tables& own = tables_[m];
    out.tile = own.tile, out.body = own.body, out.list = own.list, out.diagonal = own.diagonal, out.halo = own.halo;
    out.body_data = own.body_data;
    out.first_tile = static_cast<std::uint32_t>(cuts_.tile(m));
    // The first member moves the walls; other devices of the process read the walls' velocities from its memory
    out.moves_walls = m == team_.first();
    return out;
  }
  /// Allocates `bytes` per tile of member m, for data of bodies that does not fit in shared memory.
  void allocate_body_data(std::size_t m, std::size_t bytes) {
    tables_[m].body_data = store_.template zeros<unsigned char>((cuts_.tile(m + 1) - cuts_.tile(m)) * bytes);
  }
  /// Makes the walls' table begin at row `row` of the last upload.
  void set_wall_row(std::int64_t row) {
    arrays_.motion.wall.table = wall_table_ + static_cast<std::size_t>(row) * arrays_.motion.wall.row_words();
  }
  /// Moves the beginning of the walls' table forward by `rows` rows.
  void skip_wall_rows(std::uint32_t rows) { arrays_.motion.wall.table += rows * arrays_.motion.wall.row_words(); }

  /// Returns the arrays that the update between blocks reads and writes.
  SettledArrays<P> settled() const {
    return {constant_.data(), arrays_.state, arrays_.motion.body.displacement,
            before_,          records_,      positions_.on_device()};
  }
  /// Stores the displacements of all bodies as their displacements at the beginning of the block.
  void store_displacements() {
    check_cuda(cudaMemcpyAsync(before_, arrays_.motion.body.displacement,
                               (bodies_ + walls) * displacement_words * sizeof(*before_), cudaMemcpyDeviceToDevice,
                               team_.stream()),
               "first block");
  }
  /// Enqueues the kernel that sums the base loads and stores the displacements at the beginning of the block.
  void sum_base_loads() const {
    team_.each([&](std::size_t m) {
      const auto [long_body, long_lists] = lists_->long_lists(m, true);
      const std::size_t first = cuts_.body(m), end = cuts_.body(m + 1);
      launch("base loads", sum_base<P>, long_lists + (end - first + bodies_a_block - 1) / bodies_a_block, body_threads,
             0, team_.stream(m), records_, long_body, long_lists, static_cast<std::uint32_t>(first),
             static_cast<std::uint32_t>(end), arrays_.motion.body.weight, static_cast<std::uint32_t>(bodies_), base_,
             arrays_.motion.body.displacement, before_);
    });
  }
  /// Returns the loads on all bodies after the last step, [body][8]. Sums the walls' loads first.
  const R* forces() const {
    messages_.wall_loads(team_);
    launch("wall loads", add_wall_loads<R>, walls, body_threads, 0, team_.stream(),
           reinterpret_cast<const float*>(arrays_.wall_load), wall_begin_, base_ + bodies_ * velocity_words,
           arrays_.force + bodies_ * velocity_words);
    return arrays_.force;
  }

  /// With several ranks, completes on every device the arrays that a block in progress changes.
  void gather() const {
    const auto of_packets = [&](float4* data, int words) {
      queue_whole(team_, data, static_cast<std::size_t>(words) * 32,
                  [this](std::size_t m) { return owners_.first_packet(m); });
    };
    of_packets(constant_.data(), TileContactWords::constants(carried_));
    of_packets(arrays_.state, TileContactWords::states);
    const auto of_bodies = [&](auto* data) {
      queue_whole(team_, data, velocity_words, [this](std::size_t m) { return cuts_.body(m); });
    };
    static_assert(velocity_words == displacement_words);
    of_bodies(base_);
    of_bodies(arrays_.force);
    of_bodies(before_);
    messages_.wall_loads(team_);
  }

  /// Adds to the states of a checkpoint the arrays that a block in progress needs in addition to the chains.
  void add_states(StateList& states) {
    const auto words = [](auto* data) { return reinterpret_cast<float*>(data); };
    const std::size_t loads = (bodies_ + walls) * velocity_words;
    const auto by_body = [this] { return body_order(layout_, velocity_words); };
    add_device_state(states, "tile_drifts", "Pa m, 1, m", words(constant_.data()), 4 * constant_.size(), [this] {
      return positions_.order(TileContactWords::constants(carried_), TileContactWords::settled_fields(carried_));
    });
    add_device_state(states, "tile_states", "Pa m", words(arrays_.state), 4 * state_count_,
                     [this] { return positions_.order(TileContactWords::states, TileContactWords::state_fields()); });
    add_device_state(states, "base_loads", "N, N m", base_, loads, by_body);
    // The loads on walls are left out, because forces() computes them again
    add_device_state(states, "forces", "N, N m", arrays_.force, bodies_ * velocity_words,
                     [this] { return body_order(layout_, velocity_words, false); });
    add_device_state(states, "wall_loads", "N, N m", words(arrays_.wall_load), 4 * wall_load_count_);
    if (carried_) add_device_state(states, "displacement_at_block", "m, rad", before_, loads, by_body);
  }
  /// Returns the change of the force density f since the beginning of the block of steps, [slot][6] of group `number`.
  std::vector<float> changes(std::size_t number) const {
    return positions_.changes(number, arrays_.state, state_count_);
  }

  /// Bytes on the devices.
  std::int64_t bytes() const { return store_.bytes() + static_cast<std::int64_t>(constant_.bytes()); }
  /// Returns the device memory that start() will allocate, except for a few bytes per tile. `records`: number of load
  /// records.
  std::size_t bytes_to_come(std::size_t records) const {
    const std::size_t loads = 2 * velocity_words * sizeof(R) + displacement_words * sizeof(double);
    return constants_.size() * sizeof(float4) + plan_.contact.size() * TileContactWords::states * sizeof(float4) +
           (bodies_ + walls) * loads + records * record_words * sizeof(R) + (bodies_ + walls) * 4 * sizeof(ulonglong2) +
           positions_.slots() * sizeof(uint2) +
           (plan_.body.size() + plan_.list.size() + plan_.halo.size()) * 4 * (team_.ranks() ? 1 : team_.size());
  }

 private:
  /// Returns the address of the constants of contact `i` of the plan, on the host.
  float4* constant_of(std::size_t i) {
    return &constants_[TileContactWords::first(i, TileContactWords::constants(carried_))];
  }
  template <class T>
  void clear(T* data, std::size_t n) const {
    check_cuda(cudaMemsetAsync(data, 0, n * sizeof *data, team_.stream()), "start");
  }

  /// Uploads the arrays that no start changes, and allocates the others.
  void upload(const LoadLists& lists) {
    for (std::size_t i = 0; i < plan_.contact.size(); ++i) {
      if (plan_.contact[i].group_slot == UINT32_MAX) TileContactWords::pack_inert(constant_of(i), carried_);
    }
    // Each thread block reads the following arrays at its beginning, so every device has its own copy
    team_.each([&](std::size_t m) {
      tables_[m].tile = store_.keep(plan_.tile);
      tables_[m].body = store_.keep(plan_.body);
      tables_[m].list = reinterpret_cast<const uint2*>(store_.keep(plan_.list));
      tables_[m].diagonal = store_.keep(plan_.diagonal);
      tables_[m].halo = store_.keep(plan_.halo);
    });
    const Shares by_body = cuts_.bodies(), packets = cuts_.of([&](std::size_t m) { return owners_.first_packet(m); });
    const Shares places =
        cuts_.of([&](std::size_t m) { return owners_.first_place(m) + (m == team_.size() ? walls : 0); });
    constant_ = DeviceArray<float4>::of(constants_, packets);
    arrays_.constant = constant_.data();
    state_count_ = plan_.contact.size() * TileContactWords::states;
    arrays_.state = store_.template zeros<float4>(packets, TileContactWords::states * 32);
    arrays_.base = base_ = store_.template zeros<R>(by_body, velocity_words);
    arrays_.force = store_.template zeros<R>(by_body, velocity_words);
    wall_load_count_ = 2 * (plan_.wall_begin.back() + 1);
    arrays_.wall_load = store_.template zeros<float4>(wall_load_count_);
    arrays_.even = store_.template zeros<ulonglong2>(places, 2);
    arrays_.odd = store_.template zeros<ulonglong2>(places, 2);
    before_ = store_.template zeros<double>(by_body, displacement_words);
    wall_begin_ = store_.keep(plan_.wall_begin);
    lists_ = &lists;
    records_ = {store_.template zeros<R>(lists.shares, record_words), lists.begin.data(), lists.place.data()};
    positions_.own_first(cuts_, [&](std::size_t contact) { return owners_.of_contact(contact); });
    if (crossing_) {
      messages_.make_ready(team_, layout_, cuts_, plan_, owners_, positions_, *crossing_, arrays_, settled(), before_,
                           base_, carried_);
    }
    positions_.keep(store_, cuts_.all_slots());
    constants_ = {};
    plan_.contact = {};
  }

  /// The plan's arrays on one device.
  struct Tables {
    const Tile* tile = nullptr;
    const std::int32_t *body = nullptr, *halo = nullptr;
    const uint2* list = nullptr;
    const std::uint32_t* diagonal = nullptr;
    unsigned char* body_data = nullptr;
  };

  const DeviceTeam& team_;
  const TeamCuts& cuts_;
  const std::optional<Crossing>& crossing_;
  const Layout& layout_;
  TilePlan plan_;  // its contacts are dropped after the upload
  TileOwners owners_;
  TileContent content_;
  bool carried_, uploaded_ = false;
  std::size_t bodies_, state_count_ = 0, wall_load_count_ = 0;
  std::vector<float4> constants_;  // empty after the upload
  TilePositions positions_;
  TileArrays<P> arrays_{};
  DeviceArray<float4> constant_;
  R* base_ = nullptr;              ///< [body][8] base loads, as arrays_.base
  double* before_ = nullptr;       ///< [body][8] displacements at the beginning of the block
  const R* wall_table_ = nullptr;  ///< first row of the walls' table
  const std::uint32_t* wall_begin_ = nullptr;
  const LoadLists* lists_ = nullptr;
  std::vector<Tables> tables_;  // [member]
  LoadRecords<R> records_{};
  TileMessages<P> messages_;  // with several ranks
  DeviceStore store_;
};

}  // namespace macadam::kernels
