// SPDX-License-Identifier: GPL-3.0-or-later
/// \file exec_cuda_tiles.hpp  Defines the executor of the tile path on CUDA devices. It takes blocks of steps; each
/// thread block steps one tile, which is a part of the specimen.
///
/// The tile path applies to condensed contacts in mixed and single precision, laws that can be stepped in blocks, and
/// walls driven by displacements; ExecCuda steps everything else. make_cuda.hpp asks this executor first. StepperImpl
/// calls it in the order that executor.hpp describes. Bodies, walls and group arrays are in the base class
/// CudaBodyArrays. Three members do the rest: TileData owns the arrays of the tiles, TileLaunch launches steps,
/// resident or streamed, and TileBlocks divides a run into blocks. docs/gpu-step.md explains the whole path.
#pragma once

#include <optional>

#include "kernels/step/block_length.hpp"
#include "kernels/cuda/common/body_arrays.hpp"
#include "kernels/cuda/common/sample_buffer.hpp"
#include "kernels/cuda/tiles/tile_blocks.hpp"

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

  /// The layout, the tiles, and the kernel that steps them.
  struct Plan {
    Layout layout;
    TilePlan tiles;
    TileFit fit;
    TileContent content;
  };
  /// Plans the tiles; nothing is allocated on a device. Returns nothing if the tiles do not fit the devices.
  static std::optional<Plan> plan(const Specimen& specimen, const ContactNetwork& network,
                                  const StepperOptions& options) {
    const DeviceTeam team(options.devices, options.ranks);
    const DeviceLimits limits = DeviceLimits::of_each(team, options.multiprocessors);
    Plan out{make_layout(specimen, network, Base::lanes, tile_size(network, options, team, limits)),
             {},
             {},
             tile_content(network, options)};
    const TeamCuts cuts(team, out.layout);
    std::vector<bool>
        begins_share;  // [tile] whether it is the first tile of another device; empty if every array is on one device
    for (std::size_t m = 1; m < team.size() && !team.ranks(); ++m) {
      begins_share.resize(cuts.tile(team.size()), false);
      begins_share[cuts.tile(m)] = true;
    }
    out.tiles = plan_tiles(network, out.layout, begins_share);
    out.fit = fit_tiles<P>(out.tiles, team, cuts, limits, out.content);
    if (out.fit.way == TileFit::Way::none) return std::nullopt;
    return out;
  }

  /// Returns the number of steps per block; 0 if the run cannot be stepped in blocks.
  static int block_of(const StepperOptions& options, const FactsTable& laws, const Vec3d& size) {
    return options.form == ContactForm::condensed ? block_steps(options, laws, size) : 0;
  }

  /// Moves the tiles out of the plan. The plan's layout must outlive the executor.
  ExecCudaTiles(const ContactNetwork& network, Plan& plan, const StepperOptions& options)
      : Base(network, plan.layout, options, RecordOrder::by_number),
        data_(this->team_, this->cuts_, plan.layout, std::move(plan.tiles), plan.content, this->crossing_),
        launch_(this->team_, this->cuts_, plan.layout, data_, plan.fit),
        blocks_(this->team_, this->cuts_, plan.layout, this->parts_, data_, launch_) {}

  ~ExecCudaTiles() { end_steps(); }

  bool can_restart_with(const ExecStart& start) const { return block_of(start.options, start.laws, start.size) > 0; }

  void begin(const ExecStart& start) {
    this->rest();
    dt_ = start.options.dt;
    launch_.set_memory(data_.content().series || !blocks_are_exact(start.options.geometry, start.laws));
    blocks_.begin(block_of(start.options, start.laws, start.size), start.options.observed_every > 0);
    if (start.first) this->require_memory(start.group_bytes + data_.bytes_to_come(this->lists_.records));
  }

  template <class L, class Forces>
  void set_group(std::size_t number, bool first, const L& law, ContactArrays<P> arrays, const Forces&) {
    const ContactView<P> view = this->take_group(number, first, arrays);
    if constexpr (has_blocks<L> && Forces::form_of == ContactForm::condensed) {
      if (first) data_.add_contacts(static_cast<int>(number), arrays, view);
      blocks_.template set_group<Forces::geometry_of>(static_cast<int>(number), law, view, dt_);
    }
  }

  void prepare(const ParticleMotion<P>& motion) {
    data_.start(motion, this->lists_);
    launch_.start();
    blocks_.start();
    this->add_body_states();
    data_.add_states(this->states_);
    blocks_.add_state(this->states_);
  }

  void set_wall_rows(const std::vector<R>& rows) {
    mark_failed_on_throw([&] { Base::set_wall_rows(rows); });
  }
  /// Enqueues steps. `row`: row of the walls' table for the first step.
  void run(std::int64_t first, std::int64_t steps, std::int64_t row) {
    mark_failed_on_throw([&] { blocks_.run(first, steps, row); });
  }
  void wait() {
    mark_failed_on_throw([&] {
      launch_.mark_end();
      Base::wait();
    });
    launch_.give_back();
  }

  /// Returns how many samples can be taken before the host reads them; 0 with several devices or ranks. `radius` in
  /// specimen order [m].
  std::size_t max_samples(const std::vector<double>& radius) {
    if (this->team_.ranks() || this->team_.size() > 1) return 0;
    this->require_divergence_search(radius);
    return samples_per_read;
  }
  /// Enqueues sample number `k` behind the enqueued steps.
  void take_sample(std::size_t k) {
    mark_failed_on_throw(
        [&] { this->queue_sample(samples_, k, dt_, data_.forces() + this->layout_.particles() * velocity_words); });
  }
  /// Waits for all steps and returns the first `number` samples.
  std::vector<WallSample<R>> wait_for_samples(std::size_t number) {
    mark_failed_on_throw([&] { samples_.read(number, this->team_.stream()); });
    wait();
    return Base::wall_samples(samples_, number);
  }

  /// Ends all work after an error or before destruction: releases tiles that wait for a failed device, waits for all
  /// devices, and gives the multiprocessors back.
  void end_steps() noexcept {
    if (std::exchange(failed_, false)) launch_.release();
    Base::end_steps();
    launch_.give_back();
  }

  std::vector<Twist<R>> forces(std::int32_t first, std::size_t count) const {
    std::vector<R> out(count * velocity_words);
    check_cuda(cudaMemcpyAsync(out.data(), data_.forces() + static_cast<std::size_t>(first) * velocity_words,
                               out.size() * sizeof(R), cudaMemcpyDeviceToHost, this->team_.stream()),
               "sums");
    check_cuda(cudaStreamSynchronize(this->team_.stream()), "sums");
    return Base::twists(out);
  }
  bool forces_with_weight() const { return true; }
  void gather() const {
    if (!this->team_.ranks()) return;
    Base::gather();
    data_.gather();
    Base::wait();
  }

  GroupState<P> group_state(std::size_t number, std::size_t chain, std::size_t frame) const {
    GroupState<P> out = Base::group_state(number, chain, frame);
    out.change = data_.changes(number);
    return out;
  }

  std::string description() const { return this->described(launch_.name()); }
  std::vector<KernelUse> kernels() const { return {launch_.use()}; }
  std::int64_t traffic() const { return launch_.traffic() + this->body_traffic(); }
  Traffic traffic_by_place() const { return launch_.traffic_by_place(traffic()); }
  std::int64_t bytes() const { return this->held_bytes() + data_.bytes() + samples_.bytes(); }

 private:
  /// Returns one tile per multiprocessor if the specimen fits in registers and shared memory, else tiles so small that
  /// two share a multiprocessor.
  static TileSize tile_size(const ContactNetwork& network, const StepperOptions& options, const DeviceTeam& team,
                            const DeviceLimits& limits) {
    auto chips = static_cast<std::size_t>(limits.multiprocessors) * team.size();
    const auto shared = static_cast<std::size_t>(limits.shared);
    const std::size_t contacts = network.contacts.size();
    if (options.side_by_side > 1) {
      // Several specimens run at the same time. Each uses only part of the multiprocessors if their registers can hold
      // all its states. Otherwise every step would read states from memory, and the states of all specimens would not
      // fit in the cache. Three full specimens (35,760 particles each) that ran side by side took 44 µs per step each
      // (H200). If the specimens take turns, each on all multiprocessors, a step takes 20 µs.
      const std::size_t part = std::max<std::size_t>(1, chips / static_cast<std::size_t>(options.side_by_side));
      if (computed_per_contact * static_cast<double>(contacts) <= static_cast<double>(part * contacts_in_registers))
        chips = part;
    }
    if (team.ranks() || expected_resident_bytes<P>(network, chips) > shared)
      return {std::min(streamed_contacts, shared / shared_bytes_per_contact)};
    return {std::max(least_resident_contacts, contacts / (chips + 1) + 1), true};
  }

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
  TileData<P> data_;
  TileLaunch<P> launch_;
  TileBlocks<P, AnyLaw> blocks_;
  DeviceSamples<R> samples_;
};

}  // namespace macadam::kernels
