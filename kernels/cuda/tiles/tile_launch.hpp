// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_launch.hpp  Launches the steps of tiles by one function, whether the tiles are resident (in registers and
/// shared memory) or streamed (read from memory in every step).
///
/// take_steps() makes one launch of the resident kernel for all steps, or one launch of the streamed kernel per step.
/// Resident tiles occupy multiprocessors: lease() reserves these multiprocessors before the first step; mark_end() and
/// give_back() release them for the next specimen (multiprocessor_lease.hpp). The tag is the number of the next step,
/// which marks the velocities that resident tiles exchange (halo_exchange.hpp). docs/gpu-step.md says when each kernel
/// is chosen.
#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "kernels/cuda/device/multiprocessor_lease.hpp"
#include "kernels/cuda/tiles/tile_data.hpp"
#include "kernels/cuda/tiles/tile_fit.hpp"
#include "kernels/cuda/tiles/traffic.hpp"

namespace macadam::kernels {

/// The launches of one specimen.
template <class P>
class TileLaunch {
 public:
  using R = typename P::Particle;

  TileLaunch(const DeviceTeam& team, const TeamCuts& cuts, const Layout& layout, TileData<P>& data, const TileFit& fit)
      : team_(team), cuts_(cuts), layout_(layout), data_(data), fit_(fit) {
    data.arrays().storage = fit.storage;
    data.arrays().shared_bytes = fit.shared;
    if (!is_resident()) return;
    team.each([&](std::size_t m) {
      occupied_[team.device(m)] += static_cast<int>(tiles(m));
      of_device_[team.device(m)] = DeviceLimits::query(0).multiprocessors;
      if (fit.storage != BodyStorage::shared)
        data.allocate_body_data(m, ResidentMemory<P>::body_bytes(data.arrays().most_bodies, fit.storage));
    });
  }
  TileLaunch(const TileLaunch&) = delete;
  ~TileLaunch() {
    if (end_) cudaEventDestroy(end_);
  }

  bool is_resident() const { return fit_.way == TileFit::Way::resident; }
  /// Name of the kernel in reports.
  const char* name() const { return is_resident() ? "tiles on the chip" : "tiles streamed"; }
  KernelUse use() const {
    if (is_resident()) {
      return kernel_use(name(), resident_kernel<P>(data_.content(), fit_.storage, memory_), resident_threads,
                        fit_.shared);
    }
    return kernel_use(name(), streamed_kernel<P>(data_.content(), memory_), streamed_threads, fit_.shared);
  }

  /// Sets, for the next steps, whether some law has a memory, the geometry is updated or some contact has
  /// rock in series.
  void set_memory(bool memory) { memory_ = memory; }
  bool has_memory() const { return memory_; }
  /// Prepares for a new start. After a failure, clears the words of the exchange, which hold the release tag. Otherwise
  /// the words stay as they are, because tags continue to rise.
  void start() {
    if (!std::exchange(released_, false)) return;
    data_.clear_exchange();
    tag_ = 1;
  }

  /// Waits until the multiprocessors that resident tiles occupy are free, and takes them.
  void lease() {
    if (!is_resident() || leases_) return;
    MultiprocessorLease::take(number_, occupied_, of_device_, team_.behind());
    leases_ = true;
  }
  /// Marks the end of the enqueued steps, so that the next specimen may enqueue its steps behind them. The caller
  /// enqueues nothing more before give_back().
  void mark_end() {
    if (!leases_ || team_.size() > 1) return;
    if (!end_) check_cuda(cudaEventCreateWithFlags(&end_, cudaEventDisableTiming), "event");
    check_cuda(cudaEventRecord(end_, team_.stream()), "event");
    MultiprocessorLease::is_queued(number_, end_);
  }
  /// Gives the multiprocessors back. All enqueued steps have finished.
  void give_back() {
    if (std::exchange(leases_, false)) MultiprocessorLease::give(number_);
  }

  /// Enqueues `steps` steps of one block. The walls' table in the arrays begins with the first of them.
  void take_steps(std::uint32_t steps) {
    if (is_resident())
      launch_resident(steps);
    else
      launch_streamed(steps);
    tag_ += steps;
  }

  /// After an error of one device, ends the kernels of the other devices: their tiles would wait forever for the tiles
  /// of the failed one. To end them, writes the release tag into all words of the exchange.
  void release() noexcept {
    if (team_.size() == 1 || !is_resident() || !data_.is_uploaded()) return;
    released_ = true;
    try {
      const auto tag = static_cast<unsigned long long>(release_of(tag_)) << 32;
      const std::vector<ulonglong2> words(data_.exchange_words(), {0, tag});
      // writes repeatedly, because tiles that still run overwrite these words with their velocities
      while (team_.works() && write_on_any(words)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } catch (const std::exception&) {  // ignored: the error of the failed device is reported instead
    }
  }

  /// Returns the least number of bytes of contacts and particles that a step must move: it reads and writes states, and
  /// reads constants and base loads.
  std::int64_t traffic() const {
    const int words =
        TileContactWords::constants_read(data_.carried(), memory_) + 2 * TileContactWords::states_moved(memory_);
    const auto of_packet = static_cast<std::size_t>(words) * 32 * sizeof(float4);
    std::size_t packets = 0;
    for (const Tile& tile : data_.tiles()) packets += tile.packets;
    return static_cast<std::int64_t>(packets * of_packet + data_.particles() * velocity_words * sizeof(R));
  }
  /// Returns the bytes that a step moves through each kind of memory. `all`: the bytes of contacts and bodies, as
  /// ExecCudaTiles::traffic() returns them.
  Traffic traffic_by_place(std::int64_t all) const {
    return is_resident() ? traffic_on_chip<P>(data_.tiles(), data_.arrays(), data_.carried(), memory_)
                         : traffic_streamed(data_.tiles(), all);
  }

 private:
  void launch_resident(std::uint32_t steps) {
    const auto kernel = resident_kernel<P>(data_.content(), fit_.storage, memory_);
    team_.each([&](std::size_t m) {
      const std::string what = "time steps on device " + std::to_string(team_.device(m));
      launch_together(what.c_str(), kernel, tiles(m), resident_threads, fit_.shared, team_.stream(m),
                      data_.arrays_of(m), steps, tag_);
    });
    check_cuda(cudaGetLastError(), "time steps");
    if (waits_for_launches()) team_.wait("time steps");
  }
  void launch_streamed(std::uint32_t steps) {
    const auto kernel = streamed_kernel<P>(data_.content(), memory_);
    team_.each([&](std::size_t m) {
      const auto first = static_cast<std::uint32_t>(data_.owners().first_place(m));
      const auto end =
          first + static_cast<std::uint32_t>(layout_.tile_body[cuts_.tile(m + 1)] - layout_.tile_body[cuts_.tile(m)]);
      launch("time steps", begin_streamed<P>, (end - first + short_kernel_threads - 1) / short_kernel_threads,
             short_kernel_threads, 0, team_.stream(m), data_.arrays_of(m), 0u, first, end);
    });
    for (std::uint32_t k = 0; k < steps; ++k) {
      team_.join_streams();
      data_.messages().velocities(team_, k);
      team_.each([&](std::size_t m) {
        launch("time steps", kernel, tiles(m), streamed_threads, fit_.shared, team_.stream(m), data_.arrays_of(m), k,
               k + 1 == steps);
      });
    }
  }
  /// Overwrites all words of the exchange with `words`, from the first device on which this succeeds. Returns false if
  /// it fails on every device. Uses copies, because no multiprocessor is free for a kernel.
  bool write_on_any(const std::vector<ulonglong2>& words) {
    bool done = false;
    team_.each([&](std::size_t) {
      if (done) return;
      try {
        copy_now(data_.arrays().even, words.data(), words.size() * sizeof words[0], "release");
        copy_now(data_.arrays().odd, words.data(), words.size() * sizeof words[0], "release");
        done = true;
      } catch (const RunError&) { cudaGetLastError(); }  // this device has failed; try the next one
    });
    return done;
  }
  std::size_t tiles(std::size_t m) const { return cuts_.tile(m + 1) - cuts_.tile(m); }

  const DeviceTeam& team_;
  const TeamCuts& cuts_;
  const Layout& layout_;
  TileData<P>& data_;
  const TileFit fit_;
  bool memory_ = true, released_ = false, leases_ = false;
  std::uint32_t tag_ = 1;  ///< tag of the next step
  const std::uint64_t number_ = MultiprocessorLease::next_number();
  /// Multiprocessors that the tiles occupy, and that each device has.
  MultiprocessorLease::Share occupied_, of_device_;
  cudaEvent_t end_ = nullptr;  // end of the enqueued steps
};

}  // namespace macadam::kernels
