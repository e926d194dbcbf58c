// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tile_blocks.hpp  Takes the time steps in blocks of several steps: updates all contacts after each block, and
/// launches the steps of the next block.
///
/// At the end of each block, settle() updates the viscoelastic states and the constants of the contacts
/// (settle_kernels.hpp) and sums the base loads of the bodies. Then TileLaunch takes the steps of the next block.
/// ExecCudaTiles calls begin(), set_group() for each group and, whenever a new start state is set, start(); then run()
/// any number of times. docs/gpu-step.md explains why steps are taken in blocks.
#pragma once

#include <algorithm>
#include <string>

#include "kernels/cuda/device/part_clock.hpp"
#include "kernels/cuda/tiles/tile_launch.hpp"
#include "kernels/step/block_schedule.hpp"

namespace macadam::kernels {

/// The blocks of steps of one specimen.
template <class P, class AnyLaw>
class TileBlocks {
 public:
  TileBlocks(const DeviceTeam& team, const TeamCuts& cuts, const Layout& layout, PartClock& parts, TileData<P>& data,
             TileLaunch<P>& steps)
      : team_(team), parts_(parts), data_(data), launch_(steps), settling_(team, cuts, layout) {}

  /// Prepares for a new start, with blocks of `block` steps. `to_observations`: the run is observed at regular steps.
  void begin(int block, bool to_observations) {
    block_ = block;
    schedule_.begin(block, to_observations);
  }

  /// Sets the law of group `number` for steps of `dt`. \throws InputError if the launch expects no law with a memory,
  /// but this law has a memory.
  template <Geometry geometry, class L>
  void set_group(int number, const L& law, const ContactView<P>& view, double dt) {
    const auto block = law.block(dt, block_);
    if (!launch_.has_memory() && (block.relax != 0 || block.follow != 0)) {
      throw InputError(std::string("law of ") + to_string(static_cast<PairType>(number)) +
                       ": its function block() returns relax = " + std::to_string(block.relax) +
                       " and follow = " + std::to_string(block.follow) +
                       ", expected 0 for both, because the law says that it has no memory");
    }
    data_.set_law(number, {static_cast<float>(block.rate * dt), static_cast<float>(block.relax),
                           static_cast<float>(view.alpha), static_cast<float>(block.follow)});
    settling_.template set_group<geometry>(number, data_.first_slot(number), law, view, dt, data_.content().series);
  }

  /// Sets the constants of all contacts to their values for the undeformed contact, and waits until this has finished.
  void start() {
    team_.join_streams();
    settling_.run(settling_starts, block_, data_.settled());
    data_.messages().after_settling(team_);
    team_.wait("start");
  }
  /// Adds the progress of the current block to the states of a checkpoint.
  void add_state(StateList& states) { schedule_.add_state(states); }

  /// Enqueues the steps first … first + steps − 1. `row`: row of the walls' table for the first of them.
  void run(std::int64_t first, std::int64_t steps, std::int64_t row) {
    const Range range("time steps");
    launch_.lease();
    team_.join_streams();  // the start may have written to memory on other streams
    data_.set_wall_row(row);
    for (std::int64_t done = 0; done < steps;) {
      if (schedule_.is_due()) settle(schedule_.next(first + done));
      const auto n = static_cast<std::uint32_t>(std::min(schedule_.left(), steps - done));
      data_.arrays().begins_block = schedule_.begins();
      launch_.take_steps(n);
      parts_.end_of(launch_.name(), team_.stream());
      data_.skip_wall_rows(n);
      schedule_.take(n);
      done += n;
    }
  }

 private:
  /// Ends the block in progress, if there is one, and begins the next with `steps` steps: updates the contacts, then
  /// sums the base loads.
  void settle(int steps) {
    const Range range("settling");
    if (!schedule_.has_begun()) data_.store_displacements();
    team_.join_streams();
    data_.messages().before_settling(team_);
    settling_.run(schedule_.ended(), steps, data_.settled());
    team_.join_streams();
    data_.messages().after_settling(team_);
    parts_.end_of("settling", team_.stream());
    data_.sum_base_loads();
    team_.join_streams();
    data_.messages().after_base(team_);
    parts_.end_of("base loads", team_.stream());
    schedule_.start(steps);
  }

  const DeviceTeam& team_;
  PartClock& parts_;
  TileData<P>& data_;
  TileLaunch<P>& launch_;
  int block_ = 0;  // steps per block
  BlockSchedule schedule_;
  Settling<P, AnyLaw> settling_;
};

}  // namespace macadam::kernels
