// SPDX-License-Identifier: GPL-3.0-or-later
/// \file energy_ledger.hpp  Keeps the balance of energies of a stepped test with cracks (docs/cracks.md).
///
/// Springs, cracks, friction and motion have energies that follow from the state at a sample. The work of the walls is
/// summed with the trapezoidal rule from observations, and the dissipation of dashpots from the states of two
/// successive samples. So steps between samples cost nothing, and the balance has an error that can be measured.
#pragma once

#include <array>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/experiments/cracks.hpp"
#include "macadam/experiments/energies.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// Everything that the ledger remembers between samples.
struct LedgerState {
  double work_j = 0, viscous_j = 0;                                 ///< until now
  double time_s = 0;                                                ///< of the last sample
  double kinetic_j = 0;                                             ///< at t = 0
  std::array<Vec3d, wall_count> wall_displacement{}, wall_force{};  ///< at the last observation
  std::vector<double> chain;  ///< ContactState::chain at the last sample; empty: at rest

  /// Return the state as one list of numbers, for a checkpoint. \throws InputError for a list of another length.
  /// @{
  std::vector<double> numbers() const;
  static LedgerState from(const std::vector<double>& numbers);
  /// @}
};

/// Sums energies of a specimen that has no deformation at t = 0, and is at rest unless start() is called.
class EnergyLedger {
 public:
  /// Network, laws and inertia must outlive this object.
  EnergyLedger(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia, double density_scaling,
               double dt, bool damped, LedgerState before = {});

  /// Takes the motion at t = 0, whose energy is not counted.
  void start(const ParticleState& particles) { state_.kinetic_j = kinetic(particles); }
  /// Adds the work of the walls since the last observation. May be called more often than sample(), and twice for the
  /// same step.
  void observe(const Observation& now);
  /// Returns the energies now and adds the dissipation of the dashpots since the last sample. `contacts`: the present
  /// state, in points form; without chains (backend reference), the energies of springs and dashpots are NaN. The
  /// ledger keeps its chains; `contacts.chain` then holds the chains of the last sample, whose memory the next read can
  /// use. `cracks`: the sums over the cracks at the same time. If the steps are damped, the energy that damping takes
  /// is the remainder of the balance. The bits of the energies do not depend on the number of threads.
  experiments::Energies sample(const Observation& now, ContactState& contacts, const ParticleState& particles,
                               const experiments::CrackSums& cracks);

  const LedgerState& state() const { return state_; }

 private:
  /// Energy that springs store and energy that dashpots have dissipated since the last sample [J].
  struct ChainEnergies {
    double elastic = 0, viscous = 0;
    ChainEnergies& operator+=(const ChainEnergies& other) {
      elastic += other.elastic, viscous += other.viscous;
      return *this;
    }
  };
  ChainEnergies chains(const ContactState& now, double dt) const;
  /// Adds the energies of the chains of a contact. `now`, `before`: numbers of its first chain; `before` is null if the
  /// chains were at rest, whose numbers `at_rest` has.
  template <class L>
  void add_chains(const L& law, const Contact& contact, const double* now, const double* before, const double* at_rest,
                  double dt, ChainEnergies& sum) const;
  double kinetic(const ParticleState& particles) const;

  const ContactNetwork& network_;
  const LawTable& laws_;
  const Inertia& inertia_;
  double density_scaling_, dt_;
  bool damped_;
  LedgerState state_;
};

}  // namespace macadam
