// SPDX-License-Identifier: GPL-3.0-or-later
// energy_ledger.cpp  Sums the work of the walls and the energies of contacts and particles.
#include "host/run/energy_ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Numbers of a LedgerState before its chains: work, dissipation, time, kinetic energy, and two vectors per wall.
constexpr std::size_t head_numbers = 4 + 6 * wall_count;
/// Number of contacts or particles in a piece of a parallel sum.
constexpr std::size_t items_at_once = 1024;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Returns how many numbers of a component lie between f and the states of its units.
template <class L>
constexpr std::size_t numbers_before_units() {
  if constexpr (requires { L::crack_numbers; })
    return static_cast<std::size_t>(L::crack_numbers);
  else
    return 0;
}

/// Returns how many numbers a chain of a law has: f, those of a crack, and the states of the units.
template <class L>
std::size_t words_of(const L& law) {
  return static_cast<std::size_t>(1 + law.units());
}

}  // namespace

std::vector<double> LedgerState::numbers() const {
  std::vector<double> out{work_j, viscous_j, time_s, kinetic_j};
  for (const auto* list : {&wall_displacement, &wall_force}) {
    for (const Vec3d& v : *list) out.insert(out.end(), {v.x, v.y, v.z});
  }
  out.insert(out.end(), chain.begin(), chain.end());
  return out;
}

LedgerState LedgerState::from(const std::vector<double>& numbers) {
  if (numbers.size() < head_numbers) {
    throw InputError(fmt::format("checkpoint: found {} numbers for the balance of energies, expected at least {}",
                                 numbers.size(), head_numbers));
  }
  LedgerState out;
  out.work_j = numbers[0], out.viscous_j = numbers[1], out.time_s = numbers[2], out.kinetic_j = numbers[3];
  std::size_t at = 4;
  for (auto* list : {&out.wall_displacement, &out.wall_force}) {
    for (Vec3d& v : *list) v = {numbers[at], numbers[at + 1], numbers[at + 2]}, at += 3;
  }
  out.chain.assign(numbers.begin() + static_cast<std::ptrdiff_t>(head_numbers), numbers.end());
  return out;
}

EnergyLedger::EnergyLedger(const ContactNetwork& network, const LawTable& laws, const Inertia& inertia,
                           double density_scaling, double dt, bool damped, LedgerState before)
    : network_(network),
      laws_(laws),
      inertia_(inertia),
      density_scaling_(density_scaling),
      dt_(dt),
      damped_(damped),
      state_(std::move(before)) {}

void EnergyLedger::observe(const Observation& now) {
  for (std::size_t w = 0; w < wall_count; ++w) {
    const Vec3d moved = now.wall_displacement[w] - state_.wall_displacement[w];
    // the particles exert the force on the wall, so the wall exerts the opposite force on the particles
    state_.work_j -= 0.5 * dot(now.wall_force[w] + state_.wall_force[w], moved);
  }
  state_.wall_displacement = now.wall_displacement;
  state_.wall_force = now.wall_force;
}

// Kinetic energy with the product of the velocities half a step before and half a step after the step. With it, the
// leapfrog scheme conserves energy exactly if the contact forces are linear.
double EnergyLedger::kinetic(const ParticleState& p) const {
  return 0.5 * sum_in_parallel<double>(
                   p.velocity.size(),
                   [&](std::size_t i) {
                     const Vec3d &v = p.velocity[i], &w = p.spin[i];
                     return density_scaling_ * (inertia_.mass[i] * dot(v, v) + inertia_.inertia[i] * dot(w, w)) +
                            dt_ * (dot(p.force[i], v) + dot(p.moment[i], w));
                   },
                   items_at_once);
}

EnergyLedger::ChainEnergies EnergyLedger::chains(const ContactState& now, double dt) const {
  std::size_t most_words = 1;
  for (const auto& law : laws_) {
    if (law) most_words = std::max(most_words, std::visit([](const auto& l) { return words_of(l); }, *law));
  }
  const std::vector<double> at_rest(most_words, 0.0);
  const double* const before = state_.chain.empty() ? nullptr : state_.chain.data();
  return sum_of_pieces<ChainEnergies>(network_.contacts.size(), items_at_once, [&](std::size_t from, std::size_t to) {
    ChainEnergies sum;
    for (std::size_t c = from; c < to; ++c) {
      const Contact& contact = network_.contacts[c];
      std::visit(
          [&]<class L>(const L& law) {
            add_chains(law, contact, &now.chain[now.chain_begin[c]], before ? before + now.chain_begin[c] : nullptr,
                       at_rest.data(), dt, sum);
          },
          laws_[static_cast<std::size_t>(contact.pair)].value());
    }
    return sum;
  });
}

template <class L>
void EnergyLedger::add_chains(const L& law, const Contact& contact, const double* now, const double* before,
                              const double* at_rest, double dt, ChainEnergies& sum) const {
  if constexpr (has_energy<L>) {
    const std::size_t words = words_of(law);
    constexpr std::size_t skipped = 1 + numbers_before_units<L>();
    std::size_t at = 0;
    for (std::uint32_t point = contact.point_begin; point < contact.point_end; ++point) {
      const double opening = network_.point_area[point] / contact.length, weights[2] = {opening, opening * law.alpha};
      for (int k = 0; k < 3; ++k, at += words) {
        const double weight = weights[k > 0];
        const double *f = now + at, *f_before = before ? before + at : at_rest;
        sum.elastic += weight * law.stored(*f, f + skipped);
        sum.viscous += weight * law.dissipated(dt, *f_before, f_before + skipped, *f, f + skipped);
      }
    }
  } else {
    sum.elastic = sum.viscous = unknown;
  }
}

experiments::Energies EnergyLedger::sample(const Observation& now, ContactState& contacts,
                                           const ParticleState& particles, const experiments::CrackSums& cracks) {
  observe(now);
  experiments::Energies out;
  out.work_j = state_.work_j;
  out.crack_j = cracks.crack_energy_j;
  out.friction_j = cracks.friction_energy_j;
  out.kinetic_j = kinetic(particles) - state_.kinetic_j;
  if (contacts.chain.empty()) {
    out.elastic_j = out.viscous_j = unknown;
  } else {
    const ChainEnergies of_chains = chains(contacts, now.time - state_.time_s);
    state_.viscous_j += of_chains.viscous;
    out.elastic_j = of_chains.elastic;
    out.viscous_j = state_.viscous_j;
  }
  state_.time_s = now.time;
  state_.chain.swap(contacts.chain);
  if (damped_) out.damping_j = out.missing();
  return out;
}

}  // namespace macadam
