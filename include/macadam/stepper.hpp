// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper.hpp  Declares explicit time stepping of a contact network: the interface that all backends share.
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

/// A state of motion from which a stepper starts. Displacements and chains (the force and the Kelvin units of one
/// relative displacement) belong to step −1. The stepper takes the step from −1 to 0 when it is made, and then has the
/// forces of step 0. With updated geometry, contact frames are carried from the undeformed specimen to step −1 in one
/// step. docs/model.md, section 18.
struct StartState {
  std::vector<Vec3d> displacement, rotation;  ///< at step −1, specimen order [m] [rad]
  std::vector<Vec3d> velocity, spin;          ///< half a step before step 0 [m/s] [rad/s]
  /// Chains of the six relative displacements of each contact (model (5.2): opening, its slopes along s and t, slips
  /// along s and t, twist) at step −1, in network order. Contact c has six chains of 1 + units numbers, from
  /// chain_begin[c] on: f per unit of area over distance, then x_l. [Pa·m or Pa, m or 1]
  std::vector<double> chain;
  std::vector<std::size_t> chain_begin;
};

/// Options of a stepper, fixed when it is made.
struct StepperOptions {
  double dt = 0;  ///< [s]
  ContactForm form = ContactForm::condensed;
  Geometry geometry = Geometry::updated;
  Precision precision = Precision::double_;
  Damping damping_kind = Damping::none;
  double damping = 0;          ///< χ, or β [1/s]
  double density_scaling = 1;  ///< multiplies mass and inertia
  bool skip_shear = true;      ///< leave out the chains of shear displacements if α = 0
  bool skip_rotations = true;  ///< leave out rotations if nothing_turns()
  int threads = 0;             ///< cpu: 0 is OpenMP's choice; results do not depend on it
  DeviceList devices;  ///< cuda: devices that step the specimen together; the first becomes the calling thread's
                       ///< current device
  /// cuda: use only this number of the device's multiprocessors; 0: all; results do not depend on it.
  int multiprocessors = 0;
  int side_by_side = 1;    ///< cuda: number of specimens on the device at the same time, so that small ones leave
                           ///< multiprocessors to others; results do not depend on it
  Ranks* ranks = nullptr;  ///< cuda: the processes that step this specimen together; they must outlive the stepper;
                           ///< null: this process alone
  Boundary boundary;       ///< motion of the walls, and fixed and loaded particles; the drives' dt() must be dt
  /// State of motion to start from; only read by make_stepper(); a cyclic drive must then have no ramp.
  const StartState* start = nullptr;
  /// Mixed and single precision may take steps in blocks, within which viscoelastic states are not updated (model
  /// (6.8)). This is the smallest number of blocks in the shortest characteristic time of the drives and the laws. The
  /// error of a block is of second order in its length. If no law has a memory and the geometry is fixed, blocks have
  /// no error, and a tenth of this number is used.
  double blocks = 4000;
  /// Number of steps from one observe() to the next; 0: not known. If possible, blocks end at these observations.
  std::int64_t observed_every = 0;
};

/// Mass and moment of inertia of every particle, without density scaling.
struct Inertia {
  std::vector<double> mass;     ///< [kg]
  std::vector<double> inertia;  ///< 2/5·m·R² [kg·m²]
};

/// Returns mass and moment of inertia of solid spheres, model (1.1).
Inertia make_inertia(const Specimen& specimen, double density_aggregate, double density_mastic);

/// Motion of all particles, specimen order.
struct ParticleState {
  std::vector<Vec3d> displacement;  ///< since the undeformed specimen, at the last whole step [m]
  std::vector<Vec3d> rotation;      ///< at the last whole step: the sum of the rotations of all steps [rad]
  std::vector<Vec3d> velocity;      ///< at the last half step [m/s]
  std::vector<Vec3d> spin;          ///< angular velocity at the last half step [rad/s]
  std::vector<Vec3d> force;         ///< sum of contact and body forces at the last whole step, without damping [N]
  std::vector<Vec3d> moment;        ///< about the centre, at the last whole step [N·m]
};

/// Displacement [m] and rotation [rad] of one particle at the last whole step, as in ParticleState: ux uy uz θx θy θz.
using MotionOfParticle = std::array<double, 6>;

/// Returns the motion of some particles, given by their numbers in the specimen.
inline std::vector<MotionOfParticle> motions_of(const ParticleState& state,
                                                const std::vector<std::int32_t>& particles) {
  std::vector<MotionOfParticle> out;
  out.reserve(particles.size());
  for (const std::int32_t particle : particles) {
    const auto i = static_cast<std::size_t>(particle);
    const Vec3d &u = state.displacement[i], &turn = state.rotation[i];
    out.push_back({u.x, u.y, u.z, turn.x, turn.y, turn.z});
  }
  return out;
}

/// Measurements of a run at a whole step.
struct Observation {
  std::int64_t step = 0;
  double time = 0;                                    ///< [s]
  std::array<Vec3d, wall_count> wall_displacement{};  ///< by wall_index() [m]
  std::array<Vec3d, wall_count> wall_velocity{};      ///< by wall_index(), at the last half step [m/s]
  std::array<Vec3d, wall_count> wall_force{};         ///< exerted on the walls by the particles [N]

  /// Displacement and force of the top wall along z, which the uniaxial test measures.
  double top_displacement() const { return wall_displacement[wall_index(wall_z_hi)].z; }
  double top_force() const { return wall_force[wall_index(wall_z_hi)].z; }
};

/// One sample of a run.
struct Sample {
  Observation now;
  std::int64_t divergent = -1;  ///< Stepper::first_divergent() at the sample
};

/// One array of a stepper's state, as in a checkpoint.
struct StateArray {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int64_t>>;
  std::string name, unit;
  Values values;
};

/// Resources of a GPU multiprocessor that a kernel of the step uses.
struct KernelUse {
  std::string name;
  int registers = 0;              ///< per thread
  std::int64_t shared_bytes = 0;  ///< per thread block
  /// Number of threads of this kernel that fit on a multiprocessor, over the largest number that it can have.
  double occupancy = 0;
};

/// Bytes that a step moves, by kind of memory.
struct Traffic {
  std::int64_t memory = 0;
  std::int64_t cache = 0;   ///< bytes to and from a device's L2 cache that do not reach device memory
  std::int64_t shared = 0;  ///< bytes to and from the shared memories of the multiprocessors
};

/// Time of a part of a step: a kernel, or the work between two blocks of steps.
struct PartTime {
  std::string name;
  double seconds = 0;
};

/// Device addresses of the motion of the bodies (particles and walls), for code on the device that reads this motion.
/// The addresses are valid until the next call of the stepper or until the stepper is destroyed. Body b is particle[b]
/// of the specimen; the walls follow, by wall_index().
struct DeviceMotion {
  int device = 0;
  bool doubles = false;                  ///< whether `velocity` is double, not float
  const void* velocity = nullptr;        ///< [body][8] v, –, ω, – at the last half step [m/s, rad/s]
  const double* displacement = nullptr;  ///< [body][8] u, –, θ, – at the whole step [m, rad]
  std::vector<std::int32_t> particle;    ///< [body]: number of the particle in the specimen
};

/// Forces and deformation of all contacts, network order.
struct ContactState {
  std::vector<Vec3d> force;   ///< on the contact's first body, at the facet's centroid x0 [N]
  std::vector<Vec3d> moment;  ///< on the contact's first body, about x0 [N·m]
  /// Relative displacements (Eq. 8) about x0 in the contact's current frame (n, s, t), from the current displacements
  /// and rotations: opening [m], its slopes along s and t, slips along s and t [m], twist.
  std::vector<std::array<double, 6>> relative;
  /// Chains in the format of StartState::chain: f and the states of the Kelvin units, for the six relative
  /// displacements or, in points form, for the three of each point, one point after another. If steps are taken in
  /// blocks, the states of the units belong to the beginning of the block.
  std::vector<double> chain;
  std::vector<std::size_t> chain_begin;  ///< contact c has chain[chain_begin[c]] … chain[chain_begin[c + 1] − 1]
  /// Number of broken points over number of points of each contact. Empty if no law of the scene can break.
  std::vector<double> broken = {};
  /// Whether and how each contact point broke, in the order of the network's points. Empty if no law can break.
  std::vector<Break> point_breaks = {};
  /// Cracks of the contact points, in the order of the network's points. Empty if no law has a crack.
  std::vector<laws::PointCrack> point_cracks = {};
};

/// Steps a network in time (leapfrog: velocities at half steps, displacements and forces at whole steps).
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Takes `steps` steps.
  virtual void advance(std::int64_t steps) = 0;

  /// Returns forces and motion of the walls now.
  virtual Observation observe() const = 0;

  /// Calls advance(every), observe() and first_divergent() up to `times` times in a row, at least once; both arguments
  /// must be at least 1. Then the stepper is at the last of the returned samples. A device does not pause between
  /// samples.
  virtual std::vector<Sample> advance_sampled(std::int64_t every, [[maybe_unused]] std::int64_t times) {
    advance(every);
    return {{observe(), first_divergent()}};
  }

  /// Returns the current motion of all particles, specimen order.
  virtual ParticleState particles() const = 0;

  /// Returns the current motion of some particles, given by their numbers in the specimen. Copies less than
  /// particles().
  virtual std::vector<MotionOfParticle> motions(const std::vector<std::int32_t>& of) const {
    return motions_of(particles(), of);
  }

  /// Returns the current forces and deformation of all contacts. `network`: the one that the stepper was made of.
  /// \throws RunError for backend reference.
  virtual ContactState contacts(const ContactNetwork& network) const = 0;

  /// Sets `out` to contacts(network). Reuses the memory of `out`, which is faster if the contacts are read many times.
  virtual void read_contacts(const ContactNetwork& network, ContactState& out) const { out = contacts(network); }

  /// Returns whether and how each contact point broke, in the order of the network's points; empty if no law of the
  /// scene can break. Every backend has this. `network`: as in contacts().
  virtual std::vector<Break> point_breaks(const ContactNetwork& network) const {
    return contacts(network).point_breaks;
  }

  /// Returns the crack of each contact point, in the order of the network's points; empty if no law of the scene has a
  /// crack. Every backend has this. `network`: as in contacts().
  virtual std::vector<laws::PointCrack> point_cracks(const ContactNetwork& network) const {
    return contacts(network).point_cracks;
  }

  /// Returns the addresses of the motion in device memory; empty for steppers on the CPU.
  virtual DeviceMotion device_motion() const { return {}; }

  /// Sets the half-step velocities and spins (specimen order), for example of free assemblies in tests.
  virtual void set_velocities(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin) = 0;

  /// Returns everything that advance() changes. A stepper made from the same scene and options by the same program
  /// gives the same bits from here on if set_state() gives it these arrays. \throws RunError for backend reference,
  /// which has no checkpoints.
  virtual std::vector<StateArray> state() const = 0;

  /// Restores the state that state() returned. If that is not possible, changes nothing. \throws RunError naming the
  /// array that does not fit; also RunError for backend reference.
  virtual void set_state(const std::vector<StateArray>& arrays) = 0;

  /// Returns the first particle (specimen order) whose motion is not finite or that moves more than its radius in a
  /// step; −1 if none.
  virtual std::int64_t first_divergent() const = 0;

  /// Returns the backend, precision and form that run, in words, for example "cpu, double, condensed, 2 threads".
  virtual std::string description() const = 0;

  /// Returns the kernels that advance() launches in every step; empty on the CPU.
  virtual std::vector<KernelUse> kernels() const { return {}; }

  /// Returns the bytes of state and geometry held for the step.
  virtual std::int64_t bytes() const = 0;

  /// Returns the least number of bytes that a step moves: states are read and written, everything else is read once.
  /// Returns 0 if this is not counted.
  virtual std::int64_t traffic() const { return 0; }

  /// Returns the bytes of traffic() by kind of memory. By default, all of them count as device memory.
  virtual Traffic traffic_by_place() const { return {traffic(), 0, 0}; }

  /// Takes steps as advance() does, but slower, and returns the mean time per step of each part of a step [s]; empty if
  /// the parts are not measured.
  virtual std::vector<PartTime> advance_timed(std::int64_t steps) {
    advance(steps);
    return {};
  }
};

/// Observes a stepper in its present state, and then `n` more times, each time after `every` further steps. Each time
/// calls f(observation), which may read the stepper. \throws DivergenceError naming the first particle whose motion is
/// out of range.
void sample(Stepper& stepper, std::int64_t every, std::int64_t n, const std::function<void(const Observation&)>& f);

/// Returns whether the particles never rotate, however they move: no pair has shear stiffness, and the centroid of
/// every facet lies on the line that joins the centres of its two particles. First area moments below 1e-12 of area ×
/// size count as rounding errors.
bool nothing_turns(const ContactNetwork& network, const FactsTable& laws);
inline bool nothing_turns(const ContactNetwork& network, const LawTable& laws) {
  return nothing_turns(network, facts_of(laws));
}

/// Makes the stepper of a backend (resolves `automatic` first). `used`: a stepper that was made of the same specimen
/// and network and is not needed any more. If the laws are of the same kinds and have the same alpha, the data of
/// `used` that do not depend on time step, masses, loading and start are kept. The new stepper takes the same steps, to
/// the bit, as without `used`. \throws RunError if the backend is not available; InputError if an option does not fit
/// the backend.
std::unique_ptr<Stepper> make_stepper(Backend backend, const Specimen& specimen, const ContactNetwork& network,
                                      const LawTable& laws, const Inertia& inertia, const StepperOptions& options,
                                      std::unique_ptr<Stepper> used = nullptr);

/// A time step that is certainly stable, model (11.1): √(2/max λ_max(M_i⁻¹·K_ii)) over the particles' own 6 × 6
/// stiffness matrices with instantaneous stiffnesses, rotations included, and over the walls that options.boundary
/// loads. Local damping χ shortens it by √(1 + χ).
struct CriticalStep {
  double dt = 0;               ///< [s]
  std::int32_t particle = -1;  ///< the particle that determines the step; −1: a wall under a force
};
CriticalStep critical_step(const ContactNetwork& network, const FactsTable& laws, const Inertia& inertia,
                           const StepperOptions& options);
inline CriticalStep critical_step(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia,
                                  const StepperOptions& options) {
  return critical_step(network, facts_of(laws), inertia, options);
}

}  // namespace macadam
