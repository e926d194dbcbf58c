// SPDX-License-Identifier: GPL-3.0-or-later
// newton.cpp  Solves the equations of an increment. Each pass evaluates all contacts, assembles the tangent and solves
// a linear system. The correction is shortened if the residual does not fall.
#include "host/quasi_static/newton.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace macadam::quasi_static {
namespace {

/// Systems that are solved by iterations have the symmetric part of the tangent. If a correction leaves more than this
/// part of the residual, friction makes the rest of the tangent matter.
constexpr double slow = 0.3;
/// Passes with iterations are expensive: if this number of them does not reduce the residual to this part, a shorter
/// increment is tried.
constexpr int slow_passes = 3;
constexpr double slow_gain = 0.5;
/// Where the stiffness is nearly singular, iterations may not find the last correction. Then this many times the wanted
/// residual is enough, because a shorter increment has the same difficulty.
constexpr double enough = 10;

}  // namespace

void Newton::evaluate(const WallIncrement& increment, Trial& trial) {
  trial.sums = engine_->evaluate(trial.wall, increment.warming);
  trial.sums.scale = std::max(trial.sums.scale, least_scale_);
}

bool Newton::correct(double tolerance, bool wall_unknown, bool whole_tangent, IncrementReport& report) {
  for (const bool symmetric : {true, false}) {
    if (symmetric && (whole_tangent || !engine_->wants_symmetric())) continue;
    const LinearReport prepared = engine_->prepare(symmetric, report.loose);
    report.negative_pivots = prepared.negative_pivots;
    report.lost_stability = prepared.negative;
    if (!prepared.solved) continue;
    LinearReport solved = engine_->solve(Unknown::correction, tolerance);
    report.iterations += solved.iterations;
    if (solved.solved && wall_unknown) {
      solved = engine_->solve(Unknown::by_wall, 0.01 * tolerance);
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

double Newton::missed(const WallIncrement& increment, const TrialSums& sums) const {
  if (increment.load) {
    const double reaction = sums.reaction[wall_index(wall_z_hi)].z;
    return std::abs(reaction - *increment.load) /
           std::max(std::abs(*increment.load), sums.scale * 1e-3 * std::sqrt(engine_->wall_stiffness()));
  }
  if (increment.opening) return std::abs(sums.opening - *increment.opening) / std::abs(*increment.opening);
  return 0;
}

double Newton::wall_correction(const WallIncrement& increment, const TrialSums& sums) {
  Engine& e = *engine_;
  if (increment.load) {
    return (*increment.load - sums.reaction[wall_index(wall_z_hi)].z - e.on_top(Unknown::correction)) /
           (e.wall_stiffness() + e.on_top(Unknown::by_wall));
  }
  return (*increment.opening - sums.opening - e.opening_change(Unknown::correction)) /
         e.opening_change(Unknown::by_wall);
}

IncrementReport Newton::solve(const WallIncrement& increment, double scale, Trial& trial) {
  IncrementReport out;
  const bool wall_unknown = increment.load || increment.opening;
  double& top = trial.wall[wall_index(wall_z_hi)].z;
  engine_->begin(increment.reduced_dt.value_or(all_laws(increment.dt)), trial.motion, increment.drag);
  least_scale_ = 0;
  evaluate(increment, trial);
  if (!options_.expansion.empty()) {
    least_scale_ = std::max(scale, engine_->restrained_size(increment.warming));
    trial.sums.scale = std::max(trial.sums.scale, least_scale_);
  }
  int stuck = 0;
  double earlier = INFINITY;  // merit at the last check of its gain
  // The condition for the wall is as accurate as the residual, relative to its own scale
  const auto merit = [&] {
    const double size = std::max(scale, trial.sums.scale);
    return (size > 0 ? trial.sums.size / size : 0.0) + (wall_unknown ? missed(increment, trial.sums) : 0.0);
  };
  double now = merit();
  while (true) {
    out.residual = now;
    if (now <= options_.residual) return out.converged = true, out;
    out.converged = engine_->wants_symmetric() && now <= enough * options_.residual;
    if (out.passes >= options_.passes || !std::isfinite(now) || stuck >= 4) return out;
    if (engine_->wants_symmetric() && out.passes % slow_passes == 0) {
      if (now > slow_gain * earlier) return out;
      earlier = now;
    }
    ++out.passes;
    const double tolerance = tolerance_of(now);
    // The first correction of an increment is far from the solution in any case
    const bool whole_tangent = friction_matters_ && out.passes > 1;
    if (!correct(tolerance, wall_unknown, whole_tangent, out)) return out;
    double wall_step = 0;
    if (wall_unknown) {
      wall_step = wall_correction(increment, trial.sums);
      if (!std::isfinite(wall_step)) return out;
      engine_->add_by_wall(wall_step);
    }
    engine_->keep();
    const double wall_from = top;
    double best = INFINITY, best_length = 1;
    const auto move = [&](double length) {
      engine_->move(length);
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
    friction_matters_ = friction_matters_ || (out.passes > 1 && best > slow * now);
    stuck = best < 0.95 * now ? 0 : stuck + 1;
    now = best;
  }
}

}  // namespace macadam::quasi_static
