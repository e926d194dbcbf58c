// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_runner.hpp  Runs the tile path from the host: owns the plan and the device arrays of the tiles, and
/// launches the blocks of steps. Used for condensed contacts in mixed and single precision.
///
/// ExecCudaTiles owns one TileRunner and calls it in this order. The constructor plans the tiles (tile_plan.hpp) and
/// chooses the kernel: resident if every tile fits a multiprocessor, else streamed, else possible() is false. For each
/// start follow begin(), add_contacts() for each group (the first time only), set_group() for each group, and
/// prepare(), which uploads the arrays (first time) and resets the states. Then run() is called any number of times,
/// followed by end_of_steps() and leave_room() when the host waits. release() is called only after an error of one
/// device.
///
/// run() works block by block. At the end of each block, settle() updates the viscoelastic states and the constants of
/// the contacts (settle_kernels.hpp) and sums the base loads of the bodies; then the kernel takes the steps of the next
/// block, in one launch (resident) or one launch per step (streamed).
///
/// Words: tile, packet, place, slot, row and halo are explained in tile_plan.hpp. Room is the number of multiprocessors
/// that this specimen occupies while its steps run (multiprocessor_lease.hpp). A member is one device of the team
/// (device_team.hpp). The tag is the number of the next step, which marks velocities exchanged between tiles.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "kernels/cuda/device/part_clock.hpp"
#include "kernels/cuda/common/load_record_order.hpp"
#include "kernels/step/block_schedule.hpp"
#include "kernels/cuda/device/multiprocessor_lease.hpp"
#include "kernels/cuda/tiles/settle_launch.hpp"
#include "kernels/cuda/multi_gpu/device_limits.hpp"
#include "kernels/cuda/tiles/rank_messages.hpp"
#include "kernels/cuda/tiles/contact_places.hpp"
#include "kernels/cuda/tiles/traffic.hpp"
#include "kernels/cuda/tiles/resident_kernel.hpp"
#include "kernels/cuda/tiles/streamed_kernel.hpp"

namespace macadam::kernels {

/// Runs one specimen in blocks of steps; made once, before the first step.
template <class P, class AnyLaw>
class TileRunner {
 public:
  using R = typename P::Particle;

  TileRunner(const ContactNetwork& network, const Layout& layout, const StepperOptions& options, const DeviceTeam& team,
             const TeamCuts& cuts, PartClock& parts, const std::optional<Crossing>& crossing)
      : team_(team),
        cuts_(cuts),
        parts_(parts),
        crossing_(crossing),
        plan_(plan_tiles(network, layout, begins_share())),
        owners_(plan_, cuts),
        carried_(options.geometry == Geometry::updated),
        layout_(layout),
        bodies_(layout.particles()),
        constants_(plan_.contact.size() * static_cast<std::size_t>(TileContactWords::constants(carried_))),
        places_(layout),
        tables_(team.size()),
        settling_(team, cuts, layout) {
    choose(options.multiprocessors);
  }

  /// Returns whether these devices can run the specimen in tiles.
  bool possible() const { return static_cast<bool>(run_); }
  std::string description() const { return resident_ ? "tiles on the chip" : "tiles streamed"; }
  std::vector<KernelUse> kernels() const { return {memory_ ? use_ : use_without_memory_}; }

  /// Prepares for a new start, with blocks of `block` steps. `memory`: some law has a memory, or the geometry is
  /// updated. `to_observations`: the run is observed at regular steps.
  void begin(int block, bool memory, bool to_observations) {
    block_ = block;
    memory_ = memory;
    schedule_.begin(block, to_observations);
  }

  /// Packs the constants of the contacts of group `number` for the tiles. `view` points to device arrays.
  void add_contacts(int number, const ContactArrays<P>& arrays, const ContactView<P>& view) {
    const auto g = static_cast<std::uint32_t>(number);
    for (std::size_t i = 0; i < plan_.contact.size(); ++i) {
      const TileContact& c = plan_.contact[i];
      if (c.group_slot == UINT32_MAX || c.group != g) continue;
      places_.add(g, c.group_slot, static_cast<std::uint32_t>(i));
      const auto words = static_cast<std::size_t>(view.geometry_words);
      const auto* geo = &arrays.geometry[c.group_slot / 32 * words * 32 + c.group_slot % 32];
      TileContactWords::pack(constant_of(i), c, [&](int w) { return static_cast<float>(geo[w * 32]); });
    }
  }

  /// Sets the law of group `number` for steps of `dt`. \throws InputError if begin() was told that no law has a memory,
  /// but this one has.
  template <Geometry geometry, class L>
  void set_group(int number, const L& law, const ContactView<P>& view, double dt) {
    const auto block = law.block(dt, block_);
    if (!memory_ && (block.relax != 0 || block.follow != 0)) {
      throw InputError(std::string("law of ") + to_string(static_cast<PairType>(number)) +
                       ": found a block with relax " + std::to_string(block.relax) + " and follow " +
                       std::to_string(block.follow) + ", expected 0 of a memoryless law");
    }
    scene_.law[number] = {static_cast<float>(block.rate * dt), static_cast<float>(block.relax),
                          static_cast<float>(view.alpha), static_cast<float>(block.follow)};
    settling_.template set_group<geometry>(number, places_.first_slot(static_cast<std::size_t>(number)), law, view, dt);
  }

  /// Ends the set-up of a start: uploads the arrays (the first time) and sets everything to its value before the first
  /// step.
  void prepare(const ParticleMotion<P>& motion, const RecordRows& rows) {
    scene_.motion = motion;
    if (!std::exchange(prepared_, true)) keep_arrays(rows);
    wall_table_ = motion.wall.table;
    const auto clear = [&](auto* data, std::size_t n) {
      check_cuda(cudaMemsetAsync(data, 0, n * sizeof *data, team_.stream()), "start");
    };
    const std::size_t loads = (bodies_ + walls) * velocity_words;
    clear(scene_.state, state_count_);
    clear(base_, loads);
    clear(scene_.force, loads);
    if (motion.body.weight) {
      launch("weights", begin_with_weight<R>, (bodies_ + short_kernel_threads - 1) / short_kernel_threads,
             short_kernel_threads, 0, team_.stream(), motion.body.weight, static_cast<std::uint32_t>(bodies_),
             scene_.force);
    }
    clear(scene_.wall_load, wall_load_count_);
    clear(before_, (bodies_ + walls) * displacement_words);
    if (std::exchange(released_, false)) {  // otherwise the words stay as they are, because tags continue to rise
      clear(scene_.even, words_of_exchange());
      clear(scene_.odd, words_of_exchange());
      tag_ = 1;
    }
    team_.meet();
    settling_.run(settling_starts, block_, settled());
    messages_.after_settling(team_);
    team_.wait("start");
  }

  /// Returns the device memory that prepare() will allocate, except for a few bytes per tile. `records`: number of load
  /// records.
  std::size_t bytes_to_come(std::size_t records) const {
    const std::size_t loads = 2 * velocity_words * sizeof(R) + displacement_words * sizeof(double);
    return constants_.size() * sizeof(float4) + plan_.contact.size() * TileContactWords::states * sizeof(float4) +
           (bodies_ + walls) * loads + records * record_words * sizeof(R) + (bodies_ + walls) * 4 * sizeof(ulonglong2) +
           places_.slots() * sizeof(uint2) +
           (plan_.body.size() + plan_.row.size() + plan_.halo.size()) * 4 * (team_.ranks() ? 1 : team_.size());
  }

  /// With several ranks, completes on every device the arrays that a block in progress changes.
  void gather() const {
    const auto of_packets = [&](float4* data, int words) {
      queue_whole(team_, data, static_cast<std::size_t>(words) * 32,
                  [this](std::size_t m) { return owners_.first_packet(m); });
    };
    of_packets(constant_.data(), TileContactWords::constants(carried_));
    of_packets(scene_.state, TileContactWords::states);
    const auto of_bodies = [&](auto* data) {
      queue_whole(team_, data, velocity_words, [this](std::size_t m) { return cuts_.body(m); });
    };
    static_assert(velocity_words == displacement_words);
    of_bodies(base_);
    of_bodies(scene_.force);
    of_bodies(before_);
    messages_.wall_loads(team_);
  }

  /// Adds to `states` what a block in progress holds in addition to the chains.
  void add_states(StateList& states) {
    const auto words = [](auto* data) { return reinterpret_cast<float*>(data); };
    const std::size_t loads = (bodies_ + walls) * velocity_words;
    const auto by_body = [this] { return body_order(layout_, velocity_words); };
    add_device_state(states, "tile_drifts", "Pa m, 1, m", words(constant_.data()), 4 * constant_.size(), [this] {
      return places_.order(TileContactWords::constants(carried_), TileContactWords::settled_fields(carried_));
    });
    add_device_state(states, "tile_states", "Pa m", words(scene_.state), 4 * state_count_,
                     [this] { return places_.order(TileContactWords::states, TileContactWords::state_fields()); });
    add_device_state(states, "base_loads", "N, N m", base_, loads, by_body);
    // The loads on walls are left out: forces() sums them
    add_device_state(states, "forces", "N, N m", scene_.force, bodies_ * velocity_words,
                     [this] { return body_order(layout_, velocity_words, false); });
    add_device_state(states, "wall_loads", "N, N m", words(scene_.wall_load), 4 * wall_load_count_);
    if (carried_) add_device_state(states, "displacement_at_block", "m, rad", before_, loads, by_body);
    schedule_.add_state(states);
  }

  TileRunner(const TileRunner&) = delete;
  ~TileRunner() {
    if (end_) cudaEventDestroy(end_);
  }

  /// Marks the end of the enqueued steps, so that the next specimen may enqueue its steps behind them
  /// (MultiprocessorLease). The caller enqueues nothing more before leave_room().
  void end_of_steps() {
    if (!has_room_ || team_.size() > 1) return;
    if (!end_) check_cuda(cudaEventCreateWithFlags(&end_, cudaEventDisableTiming), "event");
    check_cuda(cudaEventRecord(end_, team_.stream()), "event");
    MultiprocessorLease::is_queued(number_, end_);
  }
  /// Gives the multiprocessors back. All enqueued steps have finished.
  void leave_room() {
    if (std::exchange(has_room_, false)) MultiprocessorLease::give(number_);
  }

  /// After an error of one device, ends the kernels of the other devices: their tiles would wait forever for the tiles
  /// of the failed one. Writes the release tag into all words of the exchange.
  void release() noexcept {
    if (team_.size() == 1 || !resident_ || !prepared_) return;
    released_ = true;
    try {
      const auto tag = static_cast<unsigned long long>(release_of(tag_)) << 32;
      const std::vector<ulonglong2> words(words_of_exchange(), {0, tag});
      // repeatedly, because tiles that still run overwrite the words with their own
      while (team_.works() && write_on_any(words)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } catch (const std::exception&) {  // the first error is the one to report
    }
  }

  /// Enqueues the steps first … first + steps − 1. `row`: row of the walls' table for the first of them.
  void run(std::int64_t first, std::int64_t steps, std::int64_t row) {
    const Range range("time steps");
    if (resident_ && !has_room_) {
      MultiprocessorLease::take(number_, room_, room_of_device_, team_.behind());
      has_room_ = true;
    }
    team_.meet();  // the start may have written to memory on other streams
    scene_.motion.wall.table = wall_table_ + static_cast<std::size_t>(row) * scene_.motion.wall.row_words();
    for (std::int64_t done = 0; done < steps;) {
      if (schedule_.is_due()) settle(schedule_.next(first + done));
      const auto n = static_cast<std::uint32_t>(std::min(schedule_.left(), steps - done));
      scene_.begins_block = schedule_.begins();
      run_(n);
      parts_.end_of(resident_ ? "tiles on the chip" : "tiles streamed", team_.stream());
      scene_.motion.wall.table += n * scene_.motion.wall.row_words();
      tag_ += n;
      schedule_.take(n);
      done += n;
    }
  }

  /// Returns the loads on all bodies after the last step, [body][8]. Sums the walls' loads first.
  const R* forces() const {
    messages_.wall_loads(team_);
    launch("wall loads", add_wall_loads<R>, walls, body_threads, 0, team_.stream(),
           reinterpret_cast<const float*>(scene_.wall_load), wall_begin_, base_ + bodies_ * velocity_words,
           scene_.force + bodies_ * velocity_words);
    return scene_.force;
  }
  /// Returns the bytes of contacts and particles that a step must move at least: states read and written, constants and
  /// base loads read.
  std::int64_t traffic() const {
    const int words = TileContactWords::constants_read(carried_, memory_) + 2 * TileContactWords::states_moved(memory_);
    const auto of_packet = static_cast<std::size_t>(words) * 32 * sizeof(float4);
    std::size_t packets = 0;
    for (const Tile& tile : plan_.tile) packets += tile.packets;
    return static_cast<std::int64_t>(packets * of_packet + bodies_ * velocity_words * sizeof(R));
  }
  /// Returns these bytes (`all`) and the others that a step moves, divided by the memory they move through.
  Traffic traffic_by_place(std::int64_t all) const {
    return resident_ ? traffic_on_chip<P>(plan_.tile, scene_, carried_, memory_) : traffic_streamed(plan_.tile, all);
  }
  /// Returns the change of f since the beginning of the block, [slot][6] of group `number`.
  std::vector<float> changes(std::size_t number) const { return places_.changes(number, scene_.state, state_count_); }
  std::int64_t bytes() const { return store_.bytes() + static_cast<std::int64_t>(constant_.bytes()); }

 private:
  /// Returns the address of the constants of contact `i` of the plan, on the host.
  float4* constant_of(std::size_t i) {
    return &constants_[TileContactWords::first(i, TileContactWords::constants(carried_))];
  }
  /// Chooses the kernel by the limits of the devices.
  void choose(int multiprocessors) {
    if (!plan_.fits) return;
    limits_ = DeviceLimits::of_each(team_, multiprocessors);
    scene_.most_bodies = plan_.most_bodies;
    scene_.most_locals = plan_.most_locals;
    scene_.most_slots = plan_.most_slots;
    scene_.places = static_cast<std::uint32_t>(plan_.body.size());
    const auto pick = [&](auto carried) {
      // Resident tiles need devices that reach each
      const bool on_chip = !team_.ranks() && try_resident<decltype(carried)::value>();
      // other's memory, which ranks do not
      if (!on_chip) use_streamed<decltype(carried)::value>();
    };
    if (carried_)
      pick(std::true_type{});
    else
      pick(std::false_type{});
  }

  /// Sets up the resident kernel. Chooses the first of `here`, `away`, `all_away` (BodyStorage) whose tiles fit in
  /// shared memory. Returns false if not all tiles can run at the same time.
  template <bool carried>
  bool try_resident() {
    constexpr int Threads = resident_threads;
    const auto limit = static_cast<std::uint32_t>(limits_.shared);
    const auto most = [&](BodyStorage where, std::uint32_t room) {
      std::uint32_t bytes = 0;
      for (const Tile& tile : plan_.tile)
        bytes = std::max(bytes, ResidentMemory<P>(tile, TileContactWords::constants(carried), where, room).total);
      return bytes;
    };
    scene_.where = BodyStorage::all_away;
    for (const BodyStorage where : {BodyStorage::away, BodyStorage::here}) {
      if (most(where, 0) <= limit) scene_.where = where;
    }
    const auto kernel_of = [&](auto memory) {
      constexpr bool has = decltype(memory)::value;
      return scene_.where == BodyStorage::here   ? run_resident<P, Threads, carried, has, BodyStorage::here>
             : scene_.where == BodyStorage::away ? run_resident<P, Threads, carried, has, BodyStorage::away>
                                                 : run_resident<P, Threads, carried, has, BodyStorage::all_away>;
    };
    const auto usual = kernel_of(std::true_type{}), without_memory = kernel_of(std::bool_constant<carried>{});
    const std::uint32_t shared = scene_.room = most(scene_.where, limit);
    bool fits = true;
    team_.each([&](std::size_t m) {
      for (const auto kernel : {usual, without_memory})
        fits = fits && fits_resident(limits_, kernel, tiles(m), Threads, shared);
    });
    if (!fits) return false;
    resident_ = true;
    team_.each([&](std::size_t m) {
      room_[team_.device(m)] += static_cast<int>(tiles(m));
      room_of_device_[team_.device(m)] = DeviceLimits::query(0).multiprocessors;
    });
    if (scene_.where != BodyStorage::here) {
      const std::size_t bytes = ResidentMemory<P>::rest_bytes(plan_.most_bodies, scene_.where);
      team_.each([&](std::size_t m) { tables_[m].rest = store_.template zeros<unsigned char>(tiles(m) * bytes); });
    }
    use_ = kernel_use("tiles on the chip", usual, Threads, shared);
    use_without_memory_ = kernel_use("tiles on the chip", without_memory, Threads, shared);
    run_ = [this, usual, without_memory](std::uint32_t steps) {
      const auto kernel = memory_ ? usual : without_memory;
      team_.each([&](std::size_t m) {
        const std::string what = "time steps on device " + std::to_string(team_.device(m));
        launch_together(what.c_str(), kernel, tiles(m), Threads, scene_.room, team_.stream(m), scene_of(m), steps,
                        tag_);
      });
      check_cuda(cudaGetLastError(), "time steps");
      if (waits_for_launches()) team_.wait("time steps");
    };
    return true;
  }

  /// Sets up the streamed kernel; sets nothing if a tile needs too much shared memory.
  template <bool carried>
  void use_streamed() {
    const auto usual = run_streamed<P, streamed_threads, streamed_blocks, carried, true>;
    const auto without_memory = run_streamed<P, streamed_threads, streamed_blocks, carried, carried>;
    const std::uint32_t shared = StreamedMemory(plan_.most_locals, plan_.most_slots).total;
    if (shared > static_cast<std::uint32_t>(limits_.shared)) return;
    team_.each([&](std::size_t) {
      for (const auto kernel : {usual, without_memory}) allow_all_shared_memory(limits_, kernel);
    });
    use_ = kernel_use("tiles streamed", usual, streamed_threads, shared);
    use_without_memory_ = kernel_use("tiles streamed", without_memory, streamed_threads, shared);
    run_ = [this, usual, without_memory, shared](std::uint32_t steps) {
      const auto kernel = memory_ ? usual : without_memory;
      team_.each([&](std::size_t m) {
        const auto first = static_cast<std::uint32_t>(owners_.first_place(m));
        const auto end =
            first + static_cast<std::uint32_t>(layout_.tile_body[cuts_.tile(m + 1)] - layout_.tile_body[cuts_.tile(m)]);
        launch("time steps", begin_streamed<P>, (end - first + short_kernel_threads - 1) / short_kernel_threads,
               short_kernel_threads, 0, team_.stream(m), scene_of(m), 0u, first, end);
      });
      for (std::uint32_t k = 0; k < steps; ++k) {
        team_.meet();
        messages_.velocities(team_, k);
        team_.each([&](std::size_t m) {
          launch("time steps", kernel, tiles(m), streamed_threads, shared, team_.stream(m), scene_of(m), k,
                 k + 1 == steps);
        });
      }
    };
  }

  /// Returns [tile] whether a member's tiles begin there, except for the first member; empty with ranks or one device.
  std::vector<bool> begins_share() const {
    std::vector<bool> out;
    if (team_.ranks()) return out;  // with ranks, each array is on one device
    for (std::size_t m = 1; m < team_.size(); ++m) {
      out.resize(cuts_.tile(team_.size()), false);
      out[cuts_.tile(m)] = true;
    }
    return out;
  }
  /// Overwrites all words of the exchange with `words`, from the first device that still works. Returns whether one
  /// did. Uses copies, because no multiprocessor is free for a kernel.
  bool write_on_any(const std::vector<ulonglong2>& words) {
    bool done = false;
    team_.each([&](std::size_t) {
      if (done) return;
      try {
        copy_now(scene_.even, words.data(), words.size() * sizeof words[0], "release");
        copy_now(scene_.odd, words.data(), words.size() * sizeof words[0], "release");
        done = true;
      } catch (const RunError&) { cudaGetLastError(); }  // this device has failed; try the next one
    });
    return done;
  }
  std::size_t words_of_exchange() const { return 2 * (std::size_t{scene_.places} + walls); }
  std::size_t tiles(std::size_t m) const { return cuts_.tile(m + 1) - cuts_.tile(m); }
  /// Returns the arguments of the launches on member m.
  TileArrays<P> scene_of(std::size_t m) const {
    TileArrays<P> out = scene_;
    const Tables& own = tables_[m];
    out.tile = own.tile, out.body = own.body, out.row = own.row, out.diagonal = own.diagonal, out.halo = own.halo;
    out.rest = own.rest;
    out.first_tile = static_cast<std::uint32_t>(cuts_.tile(m));
    out.moves_walls = m == team_.first();  // with several devices of one process, the others read the walls' velocities
                                           // from the first one's memory
    return out;
  }

  /// Uploads the arrays that no start changes, and allocates the others.
  void keep_arrays(const RecordRows& rows) {
    for (std::size_t i = 0; i < plan_.contact.size(); ++i) {
      if (plan_.contact[i].group_slot != UINT32_MAX) continue;
      TileContactWords::pack_inert(constant_of(i));
    }
    team_.each([&](std::size_t m) {  // each thread block reads these first, so every device has its own copy
      tables_[m].tile = store_.keep(plan_.tile);
      tables_[m].body = store_.keep(plan_.body);
      tables_[m].row = reinterpret_cast<const uint2*>(store_.keep(plan_.row));
      tables_[m].diagonal = store_.keep(plan_.diagonal);
      tables_[m].halo = store_.keep(plan_.halo);
    });
    const Shares by_body = cuts_.bodies(), packets = cuts_.of([&](std::size_t m) { return owners_.first_packet(m); });
    const Shares places =
        cuts_.of([&](std::size_t m) { return owners_.first_place(m) + (m == team_.size() ? walls : 0); });
    constant_ = DeviceArray<float4>::of(constants_, packets);
    scene_.constant = constant_.data();
    state_count_ = plan_.contact.size() * TileContactWords::states;
    scene_.state = store_.template zeros<float4>(packets, TileContactWords::states * 32);
    scene_.base = base_ = store_.template zeros<R>(by_body, velocity_words);
    scene_.force = store_.template zeros<R>(by_body, velocity_words);
    wall_load_count_ = 2 * (plan_.wall_begin.back() + 1);
    scene_.wall_load = store_.template zeros<float4>(wall_load_count_);
    scene_.even = store_.template zeros<ulonglong2>(places, 2);
    scene_.odd = store_.template zeros<ulonglong2>(places, 2);
    before_ = store_.template zeros<double>(by_body, displacement_words);
    wall_begin_ = store_.keep(plan_.wall_begin);
    rows_ = &rows;
    records_ = {store_.template zeros<R>(rows.shares, record_words), rows.begin.data(), rows.place.data()};
    places_.own_first(cuts_, [&](std::size_t contact) { return owners_.of_contact(contact); });
    if (crossing_) {
      messages_.make_ready(team_, layout_, cuts_, plan_, owners_, places_, *crossing_, scene_, settled(), before_,
                           base_, carried_);
    }
    places_.keep(store_, cuts_.all_slots());
    constants_ = {};
    plan_.contact = {};
  }

  /// Returns the arrays that the update between blocks reads and writes.
  SettledArrays<P> settled() const {
    return {constant_.data(), scene_.state, scene_.motion.body.displacement, before_, records_, places_.on_device()};
  }

  /// Ends the block in progress, if there is one, and begins the next with `steps` steps: updates the contacts, then
  /// sums the base loads.
  void settle(int steps) {
    const Range range("settling");
    if (!schedule_.has_begun()) {
      check_cuda(cudaMemcpyAsync(before_, scene_.motion.body.displacement,
                                 (bodies_ + walls) * displacement_words * sizeof(*before_), cudaMemcpyDeviceToDevice,
                                 team_.stream()),
                 "first block");
    }
    team_.meet();
    messages_.before_settling(team_);
    settling_.run(schedule_.ended(), steps, settled());
    team_.meet();
    messages_.after_settling(team_);
    parts_.end_of("settling", team_.stream());
    team_.each([&](std::size_t m) {
      const auto [long_body, long_rows] = rows_->long_rows(m, true);
      const std::size_t first = cuts_.body(m), end = cuts_.body(m + 1);
      launch("base loads", sum_base<P>, long_rows + (end - first + bodies_a_block - 1) / bodies_a_block, body_threads,
             0, team_.stream(m), records_, long_body, long_rows, static_cast<std::uint32_t>(first),
             static_cast<std::uint32_t>(end), scene_.motion.body.weight, static_cast<std::uint32_t>(bodies_), base_,
             scene_.motion.body.displacement, before_);
    });
    team_.meet();
    messages_.after_base(team_);
    parts_.end_of("base loads", team_.stream());
    schedule_.start(steps);
  }

  /// The plan's arrays on one device.
  struct Tables {
    const Tile* tile = nullptr;
    const std::int32_t *body = nullptr, *halo = nullptr;
    const uint2* row = nullptr;
    const std::uint32_t* diagonal = nullptr;
    unsigned char* rest = nullptr;
  };

  const DeviceTeam& team_;
  const TeamCuts& cuts_;
  PartClock& parts_;
  const std::optional<Crossing>& crossing_;
  TilePlan plan_;
  TileOwners owners_;
  bool carried_, memory_ = true, resident_ = false, prepared_ = false, released_ = false;
  int block_ = 0;  // steps per block
  BlockSchedule schedule_;
  const Layout& layout_;
  std::size_t bodies_, state_count_ = 0, wall_load_count_ = 0;
  DeviceLimits limits_;
  std::vector<float4> constants_;
  TilePlaces places_;
  TileArrays<P> scene_{};
  std::uint32_t tag_ = 1;  ///< tag of the next step
  DeviceArray<float4> constant_;
  R* base_ = nullptr;              ///< [body][8] base loads, as scene_.base
  double* before_ = nullptr;       ///< [body][8] displacements at the beginning of the block
  const R* wall_table_ = nullptr;  ///< first row of the walls' table
  const std::uint32_t* wall_begin_ = nullptr;
  const RecordRows* rows_ = nullptr;
  std::vector<Tables> tables_;  // [member]
  const std::uint64_t number_ = MultiprocessorLease::next_number();
  MultiprocessorLease::Share room_,
      room_of_device_;  ///< multiprocessors that the tiles occupy, and that each device has
  bool has_room_ = false;
  cudaEvent_t end_ = nullptr;  // end of the enqueued steps
  LoadRecords<R> records_{};
  Settling<P, AnyLaw> settling_;
  TileMessages<P> messages_;                // with several ranks
  std::function<void(std::uint32_t)> run_;  ///< takes steps with the chosen kernel; empty if neither fits
  KernelUse use_, use_without_memory_;
  DeviceStore store_;
};

}  // namespace macadam::kernels
