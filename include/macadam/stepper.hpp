// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper.hpp  Explicit time stepping of a contact network: the one interface of every backend.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/boundary.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/drives/all.hpp"
#include "macadam/ranks.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// A state of motion to start from. Displacements and chains are those of step −1. The stepper takes the step to 0 when
/// it is made, and so has the forces of step 0. With updated geometry, contact frames are carried from the undeformed
/// specimen to step −1 in one step. docs/model.md, section 18.
struct StartState {
  std::vector<Vec3d> displacement, rotation;  ///< at step −1, specimen order [m] [rad]
  std::vector<Vec3d> velocity, spin;          ///< half a step before step 0 [m/s] [rad/s]
  /// Chains of the six relative displacements of each contact (model (5.2): opening, its slopes along s and t, slips
  /// along s and t, twist) at step −1, network order: contact c has six chains of 1 + units numbers from chain_begin[c]
  /// on: f per unit of area over distance, then x_l. [Pa·m or Pa, m or 1]
  std::vector<double> chain;
  std::vector<std::size_t> chain_begin;
};

/// What the stepper is told once, before the loop.
struct StepperOptions {
  double dt = 0;  ///< [s]
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  Damping damping_kind = Damping::none;
  double damping = 0;          ///< χ, or β [1/s]
  double density_scaling = 1;  ///< multiplies mass and inertia
  bool skip_shear = true;      ///< no shear chains where α = 0
  bool skip_rotations = true;  ///< no rotations where nothing_turns()
  int threads = 0;             ///< cpu: 0 is OpenMP's choice; results do not depend on it
  DeviceList devices;          ///< cuda: that share the specimen, the first made the calling thread's
  int multiprocessors = 0;     ///< cuda: plan for so many, as if it had no more; 0: all; results do not depend on it
  int side_by_side = 1;        ///< cuda: so many specimens are on the device now: a small one leaves room for others;
                               ///< results do not depend on it
  Ranks* ranks = nullptr;      ///< cuda: the processes that step this specimen together, which outlive the stepper;
                               ///< null: this one alone
  Boundary boundary;           ///< what drives the walls, fixes and loads particles; drives' dt() is dt
  const StartState* start = nullptr;  ///< read by make_stepper() only; a cyclic drive must have no ramp then
  /// Mixed and single precision may take steps in blocks, within which laws are not settled (model (6.8)). At least so
  /// many blocks go into the shortest of the drives' and the laws' times. What a block neglects is of second order in
  /// its length; where no law has a memory and the geometry is fixed it is nothing, and a tenth of the blocks will do.
  double blocks = 4000;
  /// Steps from one observe() to the next, 0: not known. Blocks end there where they can.
  std::int64_t observed_every = 0;
};

/// Mass and moment of inertia of every particle, density scaling not included.
struct Inertia {
  std::vector<double> mass;     ///< [kg]
  std::vector<double> inertia;  ///< 2/5·m·R² [kg·m²]
};

/// Solid spheres, model (1.1).
Inertia make_inertia(const Specimen& specimen, double density_aggregate, double density_mastic);

/// Motion of all particles, specimen order.
struct ParticleState {
  std::vector<Vec3d> displacement;  ///< since the undeformed specimen, at the whole step [m]
  std::vector<Vec3d> rotation;      ///< likewise: the sum of the turns of all steps [rad]
  std::vector<Vec3d> velocity;      ///< at the last half step [m/s]
  std::vector<Vec3d> spin;          ///< angular velocity at the last half step [rad/s]
  std::vector<Vec3d> force;         ///< of contacts and body forces at the whole step, damping not included [N]
  std::vector<Vec3d> moment;        ///< about the centre, likewise [N·m]
};

/// What is measured of a run at a whole step.
struct Observation {
  std::int64_t step = 0;
  double time = 0;                                    ///< [s]
  std::array<Vec3d, wall_count> wall_displacement{};  ///< of the walls, by wall_index() [m]
  std::array<Vec3d, wall_count> wall_velocity{};      ///< likewise, at the last half step [m/s]
  std::array<Vec3d, wall_count> wall_force{};         ///< on the walls by the particles [N]

  /// Of the top wall along z: what the uniaxial test measures.
  double top_displacement() const { return wall_displacement[wall_index(wall_z_hi)].z; }
  double top_force() const { return wall_force[wall_index(wall_z_hi)].z; }
};

/// What is looked at where a run is sampled.
struct Sample {
  Observation now;
  std::int64_t divergent = -1;  ///< Stepper::first_divergent() then
};

/// One array of a stepper's state, in the private order of its backend.
struct StateArray {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int64_t>>;
  std::string name, unit;
  Values values;
};

/// What a kernel of the step takes of a multiprocessor of a device.
struct KernelUse {
  std::string name;
  int registers = 0;              ///< a thread
  std::int64_t shared_bytes = 0;  ///< a block
  double occupancy = 0;           ///< threads that fit over the most that a multiprocessor can have
};

/// Bytes that a step moves, by where from or to.
struct Traffic {
  std::int64_t memory = 0;
  std::int64_t cache = 0;   ///< the second-level cache of a device, that has no need of the memory
  std::int64_t shared = 0;  ///< shared memories of the multiprocessors
};

/// A part of a step: a kernel, or what lies between two blocks of steps.
struct PartTime {
  std::string name;
  double seconds = 0;
};

/// Where the motion of the bodies lies on a device, for those who go on with it there. Valid until the stepper's next
/// call or end. Body b is particle[b] of the specimen; the walls are behind them, by wall_index().
struct DeviceMotion {
  int device = 0;
  bool doubles = false;                  ///< whether `velocity` is double, not float
  const void* velocity = nullptr;        ///< [body][8] v, –, ω, – at the last half step [m/s, rad/s]
  const double* displacement = nullptr;  ///< [body][8] u, –, θ, – at the whole step [m, rad]
  std::vector<std::int32_t> particle;    ///< [body]
};

/// Forces and deformation of all contacts, network order.
struct ContactState {
  std::vector<Vec3d> force;                     ///< on the contact's first body, at the facet's centroid x0 [N]
  std::vector<Vec3d> moment;                    ///< likewise, about x0 [N·m]
  std::vector<std::array<double, 6>> relative;  ///< Eq. 8 about x0, in the contact's frame (n, s, t) of now, from the
                                                ///< displacements and rotations of now: opening [m], its slopes along s
                                                ///< and t, slips along s and t [m], twist
  /// As StartState::chain: f and the units' states of the six relative displacements, or, in points form, of the three
  /// of each point, one point after another. Where steps are taken in blocks, the units' are those of the block's
  /// begin.
  std::vector<double> chain;
  std::vector<std::size_t> chain_begin;  ///< contact c has the numbers from chain_begin[c] to chain_begin[c + 1]
  /// Number of broken points over number of points of each contact. Empty where no law of the scene can break.
  std::vector<double> broken = {};
  /// Whether and how each contact point broke, in the order of the network's points. Empty as `broken`.
  std::vector<Break> point_breaks = {};
};

/// Steps a network in time (leapfrog: velocities at half steps, displacements and forces at whole steps).
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Takes `steps` steps.
  virtual void advance(std::int64_t steps) = 0;

  /// Reaction and displacement of the walls now.
  virtual Observation observe() const = 0;

  /// advance(every), observe() and first_divergent(), `times` times in a row or less often, but once at least; both
  /// numbers are 1 or more. Then the stepper is at the last of these samples. A device has no pause in between.
  virtual std::vector<Sample> advance_sampled(std::int64_t every, [[maybe_unused]] std::int64_t times) {
    advance(every);
    return {{observe(), first_divergent()}};
  }

  /// Motion of all particles now, specimen order.
  virtual ParticleState particles() const = 0;

  /// Forces and deformation of all contacts now; `network`: that it was made of. \throws RunError for backend
  /// reference.
  virtual ContactState contacts(const ContactNetwork& network) const = 0;

  /// Whether and how each contact point broke, in the order of the network's points; empty where no law of the scene
  /// can break. Every backend has it. `network`: as in contacts().
  virtual std::vector<Break> point_breaks(const ContactNetwork& network) const {
    return contacts(network).point_breaks;
  }

  /// The motion on the device; nothing of the processor's steppers.
  virtual DeviceMotion device_motion() const { return {}; }

  /// Sets the half-step velocities and spins (specimen order), e.g. for free assemblies in tests.
  virtual void set_velocities(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin) = 0;

  /// Everything that advance() changes. A stepper made of the same scene and options by the same program, given this by
  /// set_state(), goes on to the same bits. \throws RunError for backend reference, which keeps no checkpoints.
  virtual std::vector<StateArray> state() const = 0;

  /// Puts back what state() gave, or changes nothing. \throws RunError naming the array that does not fit; as state().
  virtual void set_state(const std::vector<StateArray>& arrays) = 0;

  /// First particle (specimen order) whose motion is not finite or exceeds its radius in a step; −1 if none.
  virtual std::int64_t first_divergent() const = 0;

  /// The backend, precision and form that run, in words, e.g. `"cpu, double, condensed, 2 threads"`.
  virtual std::string description() const = 0;

  /// The kernels that advance() launches every step; none where the step runs on the processor.
  virtual std::vector<KernelUse> kernels() const { return {}; }

  /// Bytes of state and geometry held for the step.
  virtual std::int64_t bytes() const = 0;

  /// Bytes that a step moves at the least: states read and written, all else read once. 0 where nobody counts.
  virtual std::int64_t traffic() const { return 0; }

  /// The same by place, where it does not all come from memory.
  virtual Traffic traffic_by_place() const { return {traffic(), 0, 0}; }

  /// advance(), slower, with the time that each part took on the average of the steps [s]; none where nobody measures.
  virtual std::vector<PartTime> advance_timed(std::int64_t steps) {
    advance(steps);
    return {};
  }
};

/// Observes a stepper now and after every `every` steps, `n` times more: f(observation), which may read the stepper.
/// \throws DivergenceError naming the first particle whose motion is out of range.
void sample(Stepper& stepper, std::int64_t every, std::int64_t n, const std::function<void(const Observation&)>& f);

/// Whether no motion of the particles can turn any of them: no shear stiffness anywhere, and every facet's centroid on
/// the line of its centres (first moments below 1e-12 of area × size, which is rounding).
bool nothing_turns(const ContactNetwork& network, const FactsTable& laws);
inline bool nothing_turns(const ContactNetwork& network, const LawTable& laws) {
  return nothing_turns(network, facts_of(laws));
}

/// Makes the stepper of a backend (`automatic` is resolved first). `used`: one made of the same specimen and network
/// that is no longer needed. If the laws are of the same kinds and alpha, what it holds that does not depend on time
/// step, masses, loading and start is kept; the new one takes the same steps, to the bit, as if made without it.
/// \throws RunError when the backend is not there; InputError when an option does not fit the backend.
std::unique_ptr<Stepper> make_stepper(Backend backend, const Specimen& specimen, const ContactNetwork& network,
                                      const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                      std::unique_ptr<Stepper> used = nullptr);

/// A step that is surely stable, model (11.1): √(2/max λ_max(M_i⁻¹·K_ii)) over the particles' own 6 × 6
/// blocks with instantaneous stiffnesses, rotations included, and over the walls that options.boundary loads; local
/// damping χ shortens it by √(1 + χ).
struct CriticalStep {
  double dt = 0;               ///< [s]
  std::int32_t particle = -1;  ///< the particle that sets it; −1: a wall under a force
};
CriticalStep critical_step(const ContactNetwork& network, const FactsTable& laws, const Inertia& inertia,
                           const StepperOptions& options);
inline CriticalStep critical_step(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia,
                                  const StepperOptions& options) {
  return critical_step(network, facts_of(laws), inertia, options);
}

}  // namespace macadam
