// SPDX-License-Identifier: GPL-3.0-or-later
/// \file executor.hpp  Defines the functions that an executor must have. An executor owns the arrays of a specimen and
/// takes its time steps, on the CPU or on devices (GPUs).
///
/// There are three executors: ExecCpu (threads and SIMD registers), ExecCuda (two kernels per step, any law and contact
/// form), and ExecCudaTiles (blocks of steps over tiles). plan() answers whether the specimen fits the devices, without
/// allocating anything on them. An executor is made once for a network and a plan, and can be restarted many times. For
/// each start, StepperImpl calls, in this order:
///   begin(start)             sets all bodies to rest; applies the options
///   wall_table(values)       allocates the table of the walls' motion; returns its address
///   set_bodies(…)            sets masses and body forces
///   set_group(…)             called once per group (contacts of one pair type). On the first start it sets the group's
///                            arrays, on later starts only the states; it always sets the functor that steps the group
///   prepare(motion)          ends the set-up
/// After that it calls, any number of times, set_wall_rows(), run() and, after the last of them, wait(). The other
/// functions read results, or copy and replace the states of a checkpoint. Between two calls of run(), StepperImpl may
/// take samples (max_samples(), take_sample(), wait_for_samples()); executors that cannot take samples inherit
/// NoSamples.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/layout/layout.hpp"
#include "kernels/step/particle_motion.hpp"
#include "kernels/step/state_list.hpp"
#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Arguments of a start.
struct ExecStart {
  const StepperOptions& options;
  const FactsTable& laws;
  Vec3d size;               ///< edges of the specimen [m]
  bool first;               ///< first start: set_group() sets all arrays; at later starts only states
  std::size_t group_bytes;  ///< size of the arrays of all groups, if `first`
};

/// Plan of an executor that needs no plan beyond the layout.
struct LayoutPlan {
  Layout layout;
};

/// Forces and motion of the walls at one step, sampled by an executor while it runs. R: precision of the particles.
template <class R>
struct WallSample {
  std::vector<Twist<R>> force;       ///< [wall] exerted by the particles [N, N·m]
  std::vector<double> displacement;  ///< [wall][8] at the whole step [m, rad]
  std::vector<R> velocity;           ///< [wall][8] at the last half step [m/s, rad/s]
  std::int64_t divergent;            ///< first particle that moves too far in a step (specimen order), or −1
};
/// Base class of executors that take no samples while they run.
template <class R>
struct NoSamples {
  std::size_t max_samples(const std::vector<double>&) const { return 0; }
  void take_sample(std::size_t) const {}
  std::vector<WallSample<R>> wait_for_samples(std::size_t) const { return {}; }
};

template <class E>
concept Executor = requires(E exec, const E& read, const ExecStart& start, const Specimen& specimen,
                            const ContactNetwork& network, std::vector<typename E::Policy::Particle> words,
                            std::vector<double> doubles, ParticleMotion<typename E::Policy> motion) {
  typename E::AnyLaw;  // std::variant<…> of the laws that it can step
  { E::lanes + 0 } -> std::convertible_to<int>;
  // Plans the run; returns nothing if it does not fit the devices. E::Plan has a member `layout`
  { E::plan(specimen, network, start.options) } -> std::same_as<std::optional<typename E::Plan>>;
  {
    read.can_restart_with(start)
    } -> std::same_as<bool>;  // whether a start with these options can use the groups set before
  exec.begin(start);
  { exec.wall_table(std::size_t{}) } -> std::same_as<const typename E::Policy::Particle*>;
  exec.set_bodies(words, words);
  exec.prepare(motion);
  exec.set_wall_rows(words);
  // Arguments: first step, number of steps, row of the walls' table for the first step (0 without samples)
  exec.run(std::int64_t{}, std::int64_t{}, std::int64_t{});
  exec.wait();
  // Returns how many samples can be taken before they are read; 0: none. Argument: radii in specimen order [m]
  { exec.max_samples(doubles) } -> std::same_as<std::size_t>;
  exec.take_sample(std::size_t{});  // enqueues sample number k behind the enqueued steps
  // Waits for all steps and returns the samples 0 … number − 1
  { exec.wait_for_samples(std::size_t{}) } -> std::same_as<std::vector<WallSample<typename E::Policy::Particle>>>;
  read.gather();     // with ranks, completes on every device the arrays that steps change
  exec.end_steps();  // waits for queued work after an error, so that other devices and runs are not blocked
  { read.forces(std::int32_t{}, std::size_t{}) } -> std::same_as<std::vector<Twist<typename E::Policy::Particle>>>;
  { read.forces_with_weight() } -> std::same_as<bool>;  // whether forces() includes the body forces
  { read.velocities() } -> std::same_as<std::vector<typename E::Policy::Particle>>;
  { read.displacements() } -> std::same_as<std::vector<double>>;
  { read.wall_displacements() } -> std::same_as<std::vector<double>>;
  { read.wall_velocities() } -> std::same_as<std::vector<typename E::Policy::Particle>>;
  exec.set_velocities(words);
  exec.set_displacements(doubles);
  // Arguments: radii in specimen order [m], time step [s]
  { read.first_divergent(doubles, double{}) } -> std::same_as<std::int64_t>;
  // Arguments: number of the group, size of its array of chains, size of its array of frames
  {read.group_state(std::size_t{}, std::size_t{}, std::size_t{})};
  { read.device_motion() } -> std::same_as<DeviceMotion>;
  { read.states() } -> std::same_as<const StateList&>;
  { read.description() } -> std::same_as<std::string>;
  { read.kernels() } -> std::same_as<std::vector<KernelUse>>;
  { read.bytes() } -> std::same_as<std::int64_t>;
  { read.traffic() } -> std::same_as<std::int64_t>;
  { read.traffic_by_place() } -> std::same_as<Traffic>;
  exec.start_clock();  // from now on, measures the time of each part of a step
  { exec.stop_clock() } -> std::same_as<std::vector<PartTime>>;
  read.use_device();  // makes the device current for the calling thread, which may serve several steppers
};

}  // namespace macadam::kernels
