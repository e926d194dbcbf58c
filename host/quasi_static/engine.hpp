// SPDX-License-Identifier: GPL-3.0-or-later
/// \file engine.hpp  Declares the operations of which Newton's method consists. An engine owns the state of a specimen
/// and all vectors and matrices, in the memory of the processor that computes. Only sums come back.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/quasi_static/tangent_solver.hpp"
#include "macadam/experiments/cracks.hpp"

namespace macadam::quasi_static {

using Walls = std::array<Vec3d, wall_count>;  ///< by wall_index()

/// Sums at a trial, which is a motion of particles and walls in the increment.
struct TrialSums {
  double size = 0;     ///< of the loads that are out of balance: root of Σ load²/intact stiffness
  double scale = 0;    ///< of the loads of all contacts: the same root, with the sum of their magnitudes as the load
  Walls reaction{};    ///< external forces that hold the walls [N]
  double opening = 0;  ///< mean increase of the openings of the points that grew in the last increment, by area [m]
};

/// The unknowns of a linear system: the correction, for which the loads are out of balance by the trial's residual, and
/// the motion that a unit displacement of the top wall causes.
enum class Unknown : std::uint8_t { correction, by_wall };

/// Motion and states that accept() changes, in the order of the specimen and of the network.
struct EngineState {
  Vector displacement;         ///< since the undeformed state [6·particles]
  std::vector<double> states;  ///< as ContactIncrements::states()
  std::vector<char> grew;      ///< as ContactIncrements::grew()
};

class Engine {
 public:
  virtual ~Engine() = default;

  /// Prepares an increment from the accepted state. `dt`: its duration for the law of each pair type [s]; `guess`: the
  /// motion at which the trial begins [6·particles]; `drag`: WallIncrement::drag.
  virtual void begin(const LawTimes& dt, const Vector& guess, double drag) = 0;
  /// Evaluates all contacts at the trial, with these displacements of the walls and this increase of the temperature
  /// [K] in the increment.
  virtual TrialSums evaluate(const Walls& wall, double warming) = 0;
  /// Returns the size (TrialSums::scale) of the loads that this warming causes if no particle moves, with the
  /// stiffnesses of the last evaluation.
  virtual double restrained_size(double /*warming*/) const { return 0; }
  /// Returns the work of the contacts' forces against the expansion of the increment, before accept() [J].
  virtual double thermal_work(double /*warming*/) const { return 0; }

  /// Whether the linear solver needs a symmetric matrix at first.
  virtual bool wants_symmetric() const = 0;
  /// Assembles the tangent, or its symmetric part, at the last evaluation, and prepares its solution. `loose`: number
  /// of particles without stiffness. The drag counts as stiffness.
  virtual LinearReport prepare(bool symmetric, std::int64_t& loose) = 0;
  virtual LinearReport solve(Unknown unknown, double tolerance) = 0;
  /// Adds `factor` times the motion by the wall to the correction.
  virtual void add_by_wall(double factor) = 0;
  /// Returns the change of the top wall's reaction along z that a solution causes.
  virtual double on_top(Unknown unknown) = 0;
  /// Returns the change of TrialSums::opening that a solution causes.
  virtual double opening_change(Unknown unknown) = 0;
  /// Returns the derivative of the top wall's reaction with respect to its displacement, of the last tangent.
  virtual double wall_stiffness() const = 0;

  /// Keeps the trial, as the origin of the next calls of move().
  virtual void keep() = 0;
  /// The trial becomes the kept one plus `length` times the correction.
  virtual void move(double length) = 0;

  /// Takes over the last evaluation.
  virtual ContactEnergies accept() = 0;
  /// Returns the part of the area of points with a crack law that grows at the last evaluation.
  virtual double growing_part() = 0;

  /// Returns the motion of the last evaluation, also after accept() [6·particles].
  virtual Vector motion() const = 0;
  virtual EngineState state() const = 0;
  virtual void set_state(EngineState state) = 0;
  /// Returns displacements and rotations of the accepted state [6·particles].
  virtual Vector displacement() const = 0;
  /// Returns the contacts in the accepted state.
  virtual const ContactIncrements& contacts() const = 0;
  virtual std::vector<laws::PointCrack> point_cracks() const { return contacts().point_cracks(); }
  /// Returns the cracks in short if the states are on a device.
  virtual std::optional<experiments::CrackSurvey> survey_cracks() { return {}; }
  virtual std::vector<Break> point_breaks() const { return contacts().point_breaks(); }

  /// For example "cpu, double, direct solver".
  virtual std::string description() const = 0;
  virtual std::int64_t bytes() const = 0;  ///< of states and matrices
};

/// Returns the diagonal of the intact, instantaneous stiffness with which loads are weighted, from the diagonal of the
/// tangent [6·particles]. Entries that are much smaller than others of the same kind are enlarged.
Vector intact_stiffness(const Vector& diagonal, const Specimen& specimen);

/// Duration of an increment in which only springs and cracks react, because dashpots have no time to move [s].
inline constexpr double instant = 1e-30;

/// Returns the same duration for all laws.
inline LawTimes all_laws(double dt) {
  LawTimes out;
  out.fill(dt);
  return out;
}

/// Part of the intact stiffness that is added to the diagonal of the tangent, so that rigid motions of the specimen,
/// which no contact resists, do not make it singular. It changes corrections, not the equilibrium.
inline constexpr double held_part = 1e-11;
/// A particle whose stiffness is less than this part of the intact one is loose. It keeps this part of its intact
/// stiffness in the tangent.
inline constexpr double loose_part = 1e-4;

/// Makes an engine on the CPU. \throws InputError as QuasiStatic.
std::unique_ptr<Engine> make_cpu_engine(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                                        const QuasiStaticOptions& options);
/// Makes an engine on a CUDA device. \throws InputError as QuasiStatic, for several devices, and for contacts that
/// expand; RunError if the device has too little memory.
std::unique_ptr<Engine> make_device_engine(const Specimen& specimen, const ContactNetwork& network,
                                           const LawTable& laws, const QuasiStaticOptions& options);

}  // namespace macadam::quasi_static
