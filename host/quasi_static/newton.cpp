// SPDX-License-Identifier: GPL-3.0-or-later
// newton.cpp  Solves the equations of an increment. Each pass evaluates all contacts, assembles the tangent and solves
// a linear system. The correction is shortened if the residual does not fall.
#include "host/quasi_static/newton.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::quasi_static {
namespace {

/// Part of the intact stiffness that is added to the diagonal of the tangent, so that rigid motions of the specimen,
/// which no contact resists, do not make it singular. It changes corrections, not the equilibrium.
constexpr double held_part = 1e-11;
/// A particle whose stiffness is less than this part of the intact one is loose. It keeps this part of its intact
/// stiffness in the tangent.
constexpr double loose_part = 1e-4;
/// Systems that are solved by iterations have the symmetric part of the tangent. If a correction leaves more than this
/// part of the residual, friction makes the rest of the tangent matter.
constexpr double slow = 0.3;

/// Numbers of contacts or particles in a piece of parallel work.
constexpr std::size_t contacts_at_once = 512, particles_at_once = 1024;

/// Forces on all walls.
struct WallForces {
  std::array<Vec3d, wall_count> of{};
  WallForces& operator+=(const WallForces& other) {
    for (std::size_t w = 0; w < wall_count; ++w) of[w] += other.of[w];
    return *this;
  }
};

LawTimes all_laws(double dt) {
  LawTimes out;
  out.fill(dt);
  return out;
}

Six wall_motion(const std::array<Vec3d, wall_count>& walls, std::int32_t wall) {
  const Vec3d& x = walls[wall_index(wall)];
  return {x.x, x.y, x.z, 0, 0, 0};
}

}  // namespace

Newton::Newton(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
               const QuasiStaticOptions& options)
    : network_(network),
      options_(options),
      particles_(specimen.size()),
      contacts_(network, laws),
      matrix_(network, specimen.size()),
      solver_(6 * specimen.size() <= options.direct_below ? make_direct_solver() : make_iterative_solver(specimen)),
      intact_(6 * specimen.size()) {
  if (!options.expansion.empty() && options.expansion.size() != network.contacts.size())
    throw InputError("quasi-static: found expansions of " + std::to_string(options.expansion.size()) +
                     " contacts, expected " + std::to_string(network.contacts.size()));
  for (std::size_t number = 0; number < network.contacts.size(); ++number) {
    if (network.contacts[number].b < 0) at_walls_.push_back(static_cast<std::uint32_t>(number));
  }
  contacts_.begin(all_laws(1e-30));
  contacts_.evaluate(std::vector<Six>(network.contacts.size(), Six{}));
  matrix_.assemble(contacts_, true);
  double typical = 0;
  for (std::size_t i = 0; i < particles_; ++i)
    typical = std::max(typical, matrix_.diagonal(i).diagonal().head<3>().sum());
  for (std::size_t i = 0; i < particles_; ++i) {
    const auto diagonal = matrix_.diagonal(i).diagonal();
    const double forces = std::max(diagonal.head<3>().maxCoeff(), 1e-6 * typical);
    const double moments =
        std::max(diagonal.tail<3>().maxCoeff(), 1e-3 * forces * specimen.radius[i] * specimen.radius[i]);
    for (std::size_t k = 0; k < 6; ++k)
      intact_[6 * i + k] = std::max(diagonal(static_cast<Eigen::Index>(k)), 1e-3 * (k < 3 ? forces : moments));
  }
  find_wall_stiffness();
}

void Newton::find_wall_stiffness() {
  wall_stiffness_ = sum_in_parallel<double>(
      at_walls_.size(),
      [&](std::size_t k) {
        const Contact& c = network_.contacts[at_walls_[k]];
        if (c.b != wall_z_hi) return 0.0;
        const SixBySix own = motion_matrix(c, 1);
        const Eigen::Map<const Block> g(own.data()), stiffness(contacts_.stiffness(at_walls_[k]).data());
        return (g.transpose() * stiffness * g)(2, 2);
      },
      contacts_at_once);
}

double Newton::size_of(const Vector& loads) const {
  return std::sqrt(
      sum_in_parallel<double>(loads.size(), [&](std::size_t i) { return loads[i] * loads[i] / intact_[i]; }));
}

double Newton::restrained_size(const WallIncrement& increment) const {
  if (options_.expansion.empty() || increment.warming == 0) return 0;
  Vector sizes(6 * particles_, 0.0);
  for (std::size_t number = 0; number < network_.contacts.size(); ++number) {
    const Contact& c = network_.contacts[number];
    const double force = contacts_.stiffness(number)[0] * options_.expansion[number] * increment.warming;
    for (const int end : {0, 1}) {
      const std::int32_t particle = end == 0 ? c.a : c.b;
      if (particle < 0) continue;
      const Six load = load_on(c, {force, 0, 0, 0, 0, 0}, end);
      for (std::size_t k = 0; k < 6; ++k) sizes[6 * static_cast<std::size_t>(particle) + k] += std::abs(load[k]);
    }
  }
  return size_of(sizes);
}

void Newton::evaluate(const WallIncrement& increment, Trial& trial) {
  trial.relative.resize(network_.contacts.size());
  for_each_of(network_.contacts.size(), [&](std::size_t number) {
    const Contact& c = network_.contacts[number];
    const Six wall = c.b < 0 ? wall_motion(trial.wall, c.b) : Six{};
    const double* b = c.b < 0 ? wall.data() : &trial.motion[6 * static_cast<std::size_t>(c.b)];
    trial.relative[number] = relative(c, &trial.motion[6 * static_cast<std::size_t>(c.a)], b);
    if (!options_.expansion.empty()) trial.relative[number][0] -= options_.expansion[number] * increment.warming;
  });
  contacts_.evaluate(trial.relative);
  trial.residual.resize(6 * particles_);
  Vector sizes(6 * particles_);
  for_each_of(particles_, [&](std::size_t i) {
    Six sum{}, size{};
    for (const std::uint32_t number : network_.row(i)) {
      const Contact& c = network_.contacts[number];
      const Six load = load_on(c, contacts_.force(number), c.a == static_cast<std::int32_t>(i) ? 0 : 1);
      for (std::size_t k = 0; k < 6; ++k) sum[k] += load[k], size[k] += std::abs(load[k]);
    }
    for (std::size_t k = 0; k < 6; ++k) trial.residual[6 * i + k] = sum[k], sizes[6 * i + k] = size[k];
  });
  trial.size = size_of(trial.residual);
  trial.scale = std::max(size_of(sizes), least_scale_);
  const auto forces =
      sum_of_pieces<WallForces>(at_walls_.size(), contacts_at_once, [&](std::size_t from, std::size_t to) {
        WallForces sum;
        for (std::size_t k = from; k < to; ++k) {
          const Contact& c = network_.contacts[at_walls_[k]];
          const Six load = load_on(c, contacts_.force(at_walls_[k]), 1);
          sum.of[wall_index(c.b)] += Vec3d{load[0], load[1], load[2]};
        }
        return sum;
      });
  trial.reaction = forces.of;
}

void Newton::assemble(bool symmetric, IncrementReport& report) {
  matrix_.assemble(contacts_, symmetric);
  find_wall_stiffness();
  const auto hold = [&](std::size_t i) {
    const auto diagonal = matrix_.diagonal(i).diagonal();
    double now = 0, intact = 0;
    for (std::size_t k = 0; k < 3; ++k) now += diagonal(static_cast<Eigen::Index>(k)), intact += intact_[6 * i + k];
    const bool is_loose = now < loose_part * intact;
    for (std::size_t k = 0; k < 6; ++k)
      matrix_.add_to_diagonal(6 * i + k, (is_loose ? loose_part : held_part) * intact_[6 * i + k]);
    return std::int64_t{is_loose};
  };
  report.loose = sum_in_parallel<std::int64_t>(particles_, hold, particles_at_once);
}

bool Newton::correct(const Trial& trial, double tolerance, bool wall_unknown, bool whole_tangent,
                     IncrementReport& report, Vector& correction, Vector& by_wall) {
  Vector right(trial.residual.size()), top(trial.residual.size());
  for_each_of(right.size(), [&](std::size_t i) { right[i] = -trial.residual[i]; });
  for (const bool symmetric : {true, false}) {
    if (symmetric && (whole_tangent || !solver_->wants_symmetric())) continue;
    assemble(symmetric, report);
    const LinearReport prepared = solver_->prepare(matrix_);
    report.negative_pivots = prepared.negative_pivots;
    report.lost_stability = prepared.negative;
    if (!prepared.solved) continue;
    LinearReport solved = solver_->solve(right, correction, tolerance);
    report.iterations += solved.iterations;
    if (solved.solved && wall_unknown) {
      for_each_of(top.size(), [&](std::size_t i) { top[i] = -matrix_.top_column()[i]; });
      solved = solver_->solve(top, by_wall, 0.01 * tolerance);
      report.iterations += solved.iterations;
    }
    report.lost_stability = report.lost_stability || solved.negative;
    if (solved.solved) return true;
  }
  return false;
}

double Newton::tolerance_of(double residual) const {
  const double wanted = 0.3 * options_.residual / residual;
  return std::clamp(wanted > 1e-2 ? wanted : std::sqrt(wanted), 1e-3, 0.05);
}

double Newton::opening_change(const Vector& motion) const {
  static constexpr Six at_rest{};
  const auto change = [&](std::size_t number) {
    const Contact& c = network_.contacts[number];
    const Six& rate = contacts_.opening_rate(number);
    if (rate == Six{}) return 0.0;
    const Six u = relative(c, &motion[6 * static_cast<std::size_t>(c.a)],
                           c.b < 0 ? at_rest.data() : &motion[6 * static_cast<std::size_t>(c.b)]);
    double out = 0;
    for (std::size_t k = 0; k < 6; ++k) out += rate[k] * u[k];
    return out;
  };
  return sum_in_parallel<double>(network_.contacts.size(), change, contacts_at_once);
}

double Newton::missed(const WallIncrement& increment, const Trial& trial) const {
  if (increment.load) {
    const double reaction = trial.reaction[wall_index(wall_z_hi)].z;
    return std::abs(reaction - *increment.load) /
           std::max(std::abs(*increment.load), trial.scale * 1e-3 * std::sqrt(wall_stiffness_));
  }
  if (increment.opening) return std::abs(contacts_.opening() - *increment.opening) / std::abs(*increment.opening);
  return 0;
}

double Newton::wall_correction(const WallIncrement& increment, const Trial& trial, const Vector& correction,
                               const Vector& by_wall) const {
  if (increment.load) {
    const auto on_top = [&](const Vector& x) {
      return sum_in_parallel<double>(x.size(), [&](std::size_t i) { return matrix_.top_column()[i] * x[i]; });
    };
    return (*increment.load - trial.reaction[wall_index(wall_z_hi)].z - on_top(correction)) /
           (wall_stiffness_ + on_top(by_wall));
  }
  return (*increment.opening - contacts_.opening() - opening_change(correction)) / opening_change(by_wall);
}

IncrementReport Newton::solve(const WallIncrement& increment, double scale, Trial& trial) {
  IncrementReport out;
  const bool wall_unknown = increment.load || increment.opening;
  double& top = trial.wall[wall_index(wall_z_hi)].z;
  contacts_.begin(increment.reduced_dt.value_or(all_laws(increment.dt)));
  least_scale_ = 0;
  evaluate(increment, trial);
  if (!options_.expansion.empty()) {
    least_scale_ = std::max(scale, restrained_size(increment));
    trial.scale = std::max(trial.scale, least_scale_);
  }
  Vector correction, by_wall;
  int stuck = 0;
  // The condition for the wall is as accurate as the residual, relative to its own scale
  const auto merit = [&] {
    const double size = std::max(scale, trial.scale);
    return (size > 0 ? trial.size / size : 0.0) + (wall_unknown ? missed(increment, trial) : 0.0);
  };
  double now = merit();
  while (true) {
    out.residual = now;
    if (now <= options_.residual) return out.converged = true, out;
    if (out.passes >= options_.passes || !std::isfinite(now) || stuck >= 4) return out;
    ++out.passes;
    const double tolerance = tolerance_of(now);
    // The first correction of an increment is far from the solution in any case
    const bool whole_tangent = friction_matters_ && out.passes > 1;
    if (!correct(trial, tolerance, wall_unknown, whole_tangent, out, correction, by_wall)) return out;
    double wall_step = 0;
    if (wall_unknown) {
      wall_step = wall_correction(increment, trial, correction, by_wall);
      if (!std::isfinite(wall_step)) return out;
      for_each_of(correction.size(), [&](std::size_t i) { correction[i] += wall_step * by_wall[i]; });
    }
    const Vector from = trial.motion;
    const double wall_from = top;
    double best = INFINITY, best_length = 1;
    const auto move = [&](double length) {
      for_each_of(from.size(), [&](std::size_t i) { trial.motion[i] = from[i] + length * correction[i]; });
      top = wall_from + length * wall_step;
      evaluate(increment, trial);
      return merit();
    };
    double length = 1;
    for (int attempt = 0; attempt < 5; ++attempt, length *= 0.5) {
      const double found = move(length);
      if (found < best) best = found, best_length = length;
      if (found < 0.7 * now) break;
    }
    if (best_length != length && std::isfinite(best)) best = move(best_length);
    friction_matters_ = friction_matters_ || best > slow * now;
    stuck = best < 0.95 * now ? 0 : stuck + 1;
    now = best;
  }
}

}  // namespace macadam::quasi_static
