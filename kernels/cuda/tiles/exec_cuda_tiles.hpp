// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cuda_tiles.hpp  Defines the executor of the tile path, which takes blocks of steps over tiles on CUDA
/// devices.
///
/// It applies to condensed contacts in mixed and single precision, laws that can be stepped in blocks, and walls driven
/// by displacements; ExecCuda steps everything else. make_cuda.hpp tries this executor first. StepperImpl calls it in
/// the order that executor.hpp describes. Bodies, walls and group arrays are in the base class CudaBodyArrays; tiles,
/// kernels and blocks of steps are in TileRunner (tile_runner.hpp).
///
/// In addition to the contract in executor.hpp it takes samples on the device (max_samples(), take_sample(),
/// wait_for_samples(); see sample_buffer.hpp). A sample holds wall forces, wall motion and divergence at one step.
#pragma once

#include <optional>

#include "kernels/step/block_length.hpp"
#include "kernels/cuda/common/body_arrays.hpp"
#include "kernels/cuda/common/sample_buffer.hpp"
#include "kernels/cuda/tiles/tile_runner.hpp"

namespace macadam::kernels {

/// Executor of the tile path with precision P and a list of laws; see executor.hpp for its functions.
template <class P, class Laws>
class ExecCudaTiles : public CudaBodyArrays<P> {
  using Base = CudaBodyArrays<P>;

 public:
  using AnyLaw = Laws;
  using R = typename P::Particle;
  static constexpr bool five_units_in_registers =
      true;  ///< ContactForces has code for up to five Kelvin units in registers

  /// Returns one tile per multiprocessor if the specimen fits in registers and shared memory, else tiles so small that
  /// two share a multiprocessor.
  static TileSize tile_size(const ContactNetwork& network, const StepperOptions& options) {
    const DeviceTeam team(options.devices, options.ranks);
    const DeviceLimits limits = DeviceLimits::of_each(team, options.multiprocessors);
    auto chips = static_cast<std::size_t>(limits.multiprocessors) * team.size();
    const auto shared = static_cast<std::size_t>(limits.shared);
    const std::size_t contacts = network.contacts.size();
    if (options.side_by_side > 1) {
      // Several specimens run at the same time. Each takes part of the chip only if registers hold all its states.
      // Otherwise every step would fetch states from memory, and the cache would have to hold the states of all
      // specimens. Three full specimens side by side took 44 µs per step each (H200); if they take turns on the whole
      // chip, they take 20 µs.
      const std::size_t part = std::max<std::size_t>(1, chips / static_cast<std::size_t>(options.side_by_side));
      if (computed_per_contact * static_cast<double>(contacts) <= static_cast<double>(part * contacts_in_registers))
        chips = part;
    }
    if (team.ranks() || expected_resident_bytes<P>(network, chips) > shared)
      return {std::min(streamed_contacts, shared / shared_bytes_per_contact)};
    return {std::max(least_resident_contacts, contacts / (chips + 1) + 1), true};
  }

  /// Thrown if the devices cannot run the specimen in tiles; ExecCuda can run it.
  struct Impossible {};

  /// Returns the number of steps per block; 0 if the run cannot be stepped in blocks.
  static int block_of(const StepperOptions& options, const FactsTable& laws, const Vec3d& size) {
    return options.form == ContactForm::condensed ? block_steps(options, laws, size) : 0;
  }

  /// \throws Impossible
  ExecCudaTiles(const ContactNetwork& network, const Layout& layout, const StepperOptions& options)
      : Base(network, layout, options, RecordOrder::by_number),
        tiles_(network, layout, options, this->team_, this->cuts_, this->parts_, this->crossing_) {
    if (!tiles_.possible()) throw Impossible{};
  }

  ~ExecCudaTiles() { end_steps(); }

  bool can_restart_with(const ExecStart& start) const { return block_of(start.options, start.laws, start.size) > 0; }

  void begin(const ExecStart& start) {
    this->rest();
    dt_ = start.options.dt;
    tiles_.begin(block_of(start.options, start.laws, start.size), !blocks_are_exact(start.options.geometry, start.laws),
                 start.options.observed_every > 0);
    if (start.first) this->require_memory(start.group_bytes + tiles_.bytes_to_come(this->rows_.records));
  }

  template <class L, class Forces>
  void set_group(std::size_t number, bool first, const L& law, ContactArrays<P> arrays, const Forces&) {
    const ContactView<P> view = this->take_group(number, first, arrays);
    if constexpr (has_blocks<L> && Forces::form_of == ContactForm::condensed) {
      if (first) tiles_.add_contacts(static_cast<int>(number), arrays, view);
      tiles_.template set_group<Forces::geometry_of>(static_cast<int>(number), law, view, dt_);
    }
  }

  void prepare(const ParticleMotion<P>& motion) {
    tiles_.prepare(motion, this->rows_);
    this->add_body_states();
    tiles_.add_states(this->states_);
  }

  void set_wall_rows(const std::vector<R>& rows) {
    mark_failed_on_throw([&] { Base::set_wall_rows(rows); });
  }
  /// Enqueues steps. `row`: row of the walls' table for the first step.
  void run(std::int64_t first, std::int64_t steps, std::int64_t row = 0) {
    mark_failed_on_throw([&] { tiles_.run(first, steps, row); });
  }
  void wait() {
    mark_failed_on_throw([&] {
      tiles_.end_of_steps();
      Base::wait();
    });
    tiles_.leave_room();
  }

  using Base::number_or_none, Base::twists;  // used for samples

  /// Returns how many samples can be taken before the host reads them; 0 with several devices or ranks. `radius` in
  /// specimen order [m].
  std::size_t max_samples(const std::vector<double>& radius) {
    if (this->team_.ranks() || this->team_.size() > 1) return 0;
    this->require_divergence_search(radius);
    return samples_per_read;
  }
  /// Enqueues sample number `k` behind the enqueued steps.
  void take_sample(std::size_t k) {
    mark_failed_on_throw([&] {
      const cudaStream_t stream = this->team_.stream();
      const std::size_t walls_from = this->layout_.particles();
      if (k == 0) samples_.clear(stream);
      this->divergence_->queue(this->master_.data(), dt_, 0, walls_from, samples_.divergent(k), stream);
      samples_.take(k, tiles_.forces() + walls_from * velocity_words,
                    this->master_.data() + walls_from * velocity_words,
                    this->displacement_.data() + walls_from * displacement_words, stream);
    });
  }
  /// Waits for all steps and returns the first `number` samples.
  const DeviceSamples<R>& wait_for_samples(std::size_t number) {
    mark_failed_on_throw([&] { samples_.read(number, this->team_.stream()); });
    wait();
    return samples_;
  }

  /// Ends all work after an error or before destruction: releases tiles that wait for a failed device, waits for all
  /// devices, and gives the multiprocessors back.
  void end_steps() noexcept {
    if (std::exchange(failed_, false)) tiles_.release();
    Base::end_steps();
    tiles_.leave_room();
  }

  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    std::vector<R> out(count * velocity_words);
    check_cuda(cudaMemcpyAsync(out.data(), tiles_.forces() + static_cast<std::size_t>(first) * velocity_words,
                               out.size() * sizeof(R), cudaMemcpyDeviceToHost, this->team_.stream()),
               "sums");
    check_cuda(cudaStreamSynchronize(this->team_.stream()), "sums");
    return Base::twists(out);
  }
  bool forces_with_weight() const { return true; }
  void gather() const {
    if (!this->team_.ranks()) return;
    Base::gather();
    tiles_.gather();
    Base::wait();
  }

  GroupState<P> group_state(std::size_t number, std::size_t chain, std::size_t frame) const {
    GroupState<P> out = Base::group_state(number, chain, frame);
    out.change = tiles_.changes(number);
    return out;
  }

  std::string description() const { return this->described(tiles_.description()); }
  std::vector<KernelUse> kernels() const { return tiles_.kernels(); }
  std::int64_t traffic() const { return tiles_.traffic() + this->body_traffic(); }
  Traffic traffic_by_place() const { return tiles_.traffic_by_place(traffic()); }
  std::int64_t bytes() const { return this->held_bytes() + tiles_.bytes() + samples_.bytes(); }

 private:
  /// Calls f(). If it throws, records that a device failed, so that end_steps() releases the tiles of the other
  /// devices.
  template <class F>
  void mark_failed_on_throw(F&& f) {
    try {
      f();
    } catch (...) {
      failed_ = true;
      throw;
    }
  }

  double dt_ = 0;
  bool failed_ = false;
  TileRunner<P, AnyLaw> tiles_;
  DeviceSamples<R> samples_;
};

}  // namespace macadam::kernels
