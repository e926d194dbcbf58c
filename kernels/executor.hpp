// SPDX-License-Identifier: GPL-3.0-or-later
/// \file executor.hpp  The contract of an executor: how the arrays of a scene are kept and its steps are taken.
///
/// Three keep it: ExecCpu (threads and SIMD registers), ExecCuda (two kernels a step, any law and form), ExecCudaTiles
/// (blocks of steps over tiles). Made once of a network and a layout, an executor serves many starts. For each start,
/// StepperImpl calls, in this order:
///   begin(start)             all bodies at rest; what the options decide
///   wall_table(values)       room for the walls' table
///   set_bodies(…)            what moves the bodies
///   set_group(…)             each group's arrays (the first time) or states, and the functor that steps its contacts
///   prepare(motion)          nothing more is to come
/// and then, again and again, set_wall_rows(), run() and, at the end of them, wait(). Everything else reads.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/particle_motion.hpp"
#include "kernels/state_list.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// What a start is made with.
struct ExecStart {
  const StepperOptions& options;
  const FactsTable& laws;
  Vec3d size;               ///< of the specimen [m]
  bool first;               ///< groups come whole; later only their states do
  std::size_t group_bytes;  ///< of the groups to come, the first time
};

template <class E>
concept Executor = requires(E exec, const E& read, const ExecStart& start, const ContactNetwork& network,
                            std::vector<typename E::Policy::Particle> words, std::vector<double> doubles,
                            ParticleMotion<typename E::Policy> motion) {
  typename E::AnyLaw;  // std::variant<…> of the laws that it can step
  { E::lanes + 0 } -> std::convertible_to<int>;
  { E::tile_size(network, start.options) } -> std::same_as<TileSize>;
  { read.suits(start) } -> std::same_as<bool>;  // whether groups once taken can be stepped so
  exec.begin(start);
  { exec.wall_table(std::size_t{}) } -> std::same_as<const typename E::Policy::Particle*>;
  exec.set_bodies(words, words);
  exec.prepare(motion);
  exec.set_wall_rows(words);
  exec.run(std::int64_t{}, std::int64_t{});  // first step, number of steps; the walls' table begins with the first
  exec.wait();
  read.gather();     // what a step changes is whole, though several processes have taken the steps
  exec.end_steps();  // the same after an error, which it may be in the way of others to leave as it is
  { read.forces(std::int32_t{}, std::size_t{}) } -> std::same_as<std::vector<Twist<typename E::Policy::Particle>>>;
  { read.forces_with_weight() } -> std::same_as<bool>;  // whether these have the body forces in them
  { read.velocities() } -> std::same_as<std::vector<typename E::Policy::Particle>>;
  { read.displacements() } -> std::same_as<std::vector<double>>;
  { read.wall_displacements() } -> std::same_as<std::vector<double>>;
  { read.wall_velocities() } -> std::same_as<std::vector<typename E::Policy::Particle>>;
  exec.set_velocities(words);
  exec.set_displacements(doubles);
  { read.first_divergent(doubles, double{}) } -> std::same_as<std::int64_t>;  // radii in specimen order, time step
  {read.group_state(std::size_t{}, std::size_t{}, std::size_t{})};            // of group, numbers of chains, of frames
  { read.device_motion() } -> std::same_as<DeviceMotion>;
  { read.states() } -> std::same_as<const StateList&>;
  { read.description() } -> std::same_as<std::string>;
  { read.kernels() } -> std::same_as<std::vector<KernelUse>>;
  { read.bytes() } -> std::same_as<std::int64_t>;
  { read.traffic() } -> std::same_as<std::int64_t>;
  { read.traffic_by_place() } -> std::same_as<Traffic>;
  exec.start_clock();  // the parts of the steps to come are timed
  { exec.stop_clock() } -> std::same_as<std::vector<PartTime>>;
  read.use_device();  // a thread has a current device of its own, and may serve several steppers
};

}  // namespace macadam::kernels
