// SPDX-License-Identifier: GPL-3.0-or-later
// increments.cpp  Takes increments of a length for which the estimated error is within the tolerance. If no
// equilibrium exists at a larger displacement of the wall, the test is controlled by the opening of cracks, or the
// stress drops suddenly (sudden_drop.cpp).
#include "host/quasi_static/increments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/quasi_static/contact_increments.hpp"
#include "macadam/error.hpp"

namespace macadam::quasi_static {
namespace {

constexpr std::size_t driven = wall_index(wall_z_hi);
/// Error of the trapezoidal rule over the difference from the extrapolation through three earlier values, for a smooth
/// response and increments of equal length: 1/12 over 1.
constexpr double error_per_difference = 1.0 / 12;
/// Part of the tolerance that one increment may take. The errors of increments partly cancel.
constexpr double per_increment = 0.25;
/// An increment is repeated with a shorter length if its error is this many times its part.
constexpr double repeated_above = 4;
constexpr double longer_at_most = 2, shorter_at_most = 0.4, caution = 0.85;
/// Newton's method is fastest with at most this number of passes.
constexpr int usual_passes = 9;
/// After this many halvings an increment counts as impossible; also if it is shorter than this part of a usual one.
constexpr int most_halvings = 7;
constexpr double impossibly_short = 1.0 / 100;
/// Usual lengths and openings are the largest ones, each of which loses this factor with each increment after it.
constexpr double forgotten = 0.8;
/// In an increment controlled by opening, the stress may change by at most this part of the largest stress.
constexpr double stress_change = 0.03;
/// Where the stress may drop, an increment counts as impossible after this many halvings, or if it is shorter than this
/// part of a usual one, because iterations need long to find no solution.
constexpr int halvings_before_drop = 2;
constexpr double too_short_before_drop = 1.0 / 20;

}  // namespace

Increments::Increments(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                       CourseOptions options)
    : options_(std::move(options)),
      may_drop_(
          options_.grows && !options_.by_force && !options_.solver.solves_directly(specimen.size()) &&
          std::ranges::any_of(pair_laws(network, laws), [](const PairLaw& law) { return law.cracked.has_value(); })),
      network_(specimen, network, laws, options_.solver),
      length_(static_cast<double>(options_.first)),
      past_{{0, 0}} {}

void Increments::start(const StartState& state) {
  network_.start(state);
  const double value = observed_value();
  largest_ = std::abs(value);
  past_ = {{0, value}};
}

std::int64_t Increments::next_stop() const {
  const auto at = std::upper_bound(options_.stops.begin(), options_.stops.end(), step_);
  if (at == options_.stops.end()) throw RunError("quasi-static: the test has no stop after its last sample");
  return *at;
}

std::int64_t Increments::length_to(std::int64_t stop) const {
  const std::int64_t left = stop - step_;
  auto wanted = std::max<std::int64_t>(1, std::llround(length_));
  if (options_.longest > 0) wanted = std::min(wanted, options_.longest);
  if (wanted >= left) return left;
  // two increments of equal length in place of a long and a very short one
  return 2 * wanted > left ? (left + 1) / 2 : wanted;
}

WallIncrement Increments::increment_of(std::int64_t steps) const {
  WallIncrement out;
  const double unit = options_.drive->dt();
  out.dt = static_cast<double>(steps) * unit;
  const TemperatureHistory& history = options_.temperature;
  if (history.empty()) return out;
  const double from = static_cast<double>(step_) * unit, to = static_cast<double>(step_ + steps) * unit;
  out.warming = history.at(to) - history.at(from);
  std::array<double, pair_types>& times = out.reduced_dt.emplace();
  for (std::size_t pair = 0; pair < pair_types; ++pair)
    times[pair] = reduced_time(options_.shifts[pair], history, from, to);
  return out;
}

double Increments::observed_value() const {
  if (options_.by_force) return network_.wall_displacement()[driven].z / options_.height;
  return -network_.wall_force()[driven].z / options_.area;
}

double Increments::extrapolated(double step) const {
  double out = 0;
  for (std::size_t i = 0; i < past_.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < past_.size(); ++j) {
      if (j != i) weight *= (step - past_[j].step) / (past_[i].step - past_[j].step);
    }
    out += weight * past_[i].value;
  }
  return out;
}

// Over a length h the rule has the error h³·y'''/12. The difference d from the extrapolation through the values at
// three earlier times t1, t2, t3 is y'''·(t − t1)(t − t2)(t − t3)/6, so the error is d·h³/(2·(t − t1)(t − t2)(t − t3)).
double Increments::error_of_rule(double step, double value) const {
  if (past_.size() < 2) return 0;
  const double difference = value - extrapolated(step);
  if (past_.size() < 3) return error_per_difference * difference;
  const double length = step - past_.back().step;
  double product = 2;
  for (const Past& p : past_) product *= (step - p.step) / length;
  return difference / product;
}

double Increments::error_at(double step, double value) const {
  if (past_.size() < 2) return -1;
  const double scale = std::max(largest_, std::abs(value));
  return scale > 0 ? error_per_difference * std::abs(value - extrapolated(step)) / scale : 0;
}

void Increments::accept(std::int64_t steps, const IncrementReport& found, bool by_time) {
  const double value = observed_value();
  network_.accept();
  step_ += steps;
  count(found);
  if (by_time) error_sum_ += error_of_rule(static_cast<double>(step_), value);
  largest_error_ = std::max(largest_error_, std::abs(error_sum_));
  largest_ = std::max(largest_, std::abs(value));
  if (largest_ > 0) report_.error = largest_error_ / largest_;
  usual_ = std::max(static_cast<double>(steps), forgotten * usual_);
  usual_opening_ = std::max(network_.last_opening(), forgotten * usual_opening_);
  past_.push_back({static_cast<double>(step_), value});
  if (past_.size() > 3) past_.erase(past_.begin());
}

void Increments::advance() {
  if (by_opening_) return advance_by_opening(next_stop());
  const std::int64_t stop = next_stop();
  const double part = per_increment * options_.tolerance;
  int halvings = 0;
  while (true) {
    const std::int64_t steps = length_to(stop);
    WallIncrement next = increment_of(steps);
    const double moved = network_.wall_displacement()[driven].z;
    if (options_.by_force) {
      next.load = options_.drive->value(step_ + steps);
    } else {
      next.wall[driven].z = drive_at(step_ + steps) - moved;
    }
    const IncrementReport found = solve(next);
    if (!found.converged) {
      ++report_.rejected;
      const bool too_short =
          static_cast<double>(steps) <= (may_drop_ ? too_short_before_drop : impossibly_short) * usual_;
      if (steps > 1 && !too_short && ++halvings <= (may_drop_ ? halvings_before_drop : most_halvings)) {
        length_ = 0.5 * static_cast<double>(steps);
        continue;
      }
      if (may_drop_) return drop(steps);
      if (!options_.grows || options_.by_force || network_.last_opening() <= 0) fail(found);
      by_opening_ = true;
      furthest_ = moved;
      opening_ = 0.5 * usual_opening_;
      opening_steps_ = std::max<std::int64_t>(1, std::llround(0.25 * usual_));
      if (!report_.unstable) report_.unstable = {network_.time(), moved / options_.height, past_.back().value};
      return advance_by_opening(stop);
    }
    const double error = error_at(static_cast<double>(step_ + steps), observed_value());
    if (error > repeated_above * part && steps > 1) {
      network_.reject();
      ++report_.rejected;
      length_ = static_cast<double>(steps) * std::max(shorter_at_most, caution * std::cbrt(part / error));
      continue;
    }
    accept(steps, found, true);
    const double by_error = error > 0 ? caution * std::cbrt(part / error) : longer_at_most;
    const double by_passes = found.passes > usual_passes ? 0.7 : longer_at_most;
    const double factor = std::clamp(std::min(by_error, by_passes), shorter_at_most, longer_at_most);
    // an increment that a stop has cut short says little about longer ones
    length_ = std::max(factor * static_cast<double>(steps), std::min(1.0, factor) * length_);
    if (std::binary_search(options_.kinks.begin(), options_.kinks.end(), step_)) {
      past_ = {past_.back()};
      length_ = static_cast<double>(options_.first);
    }
    return;
  }
}

void Increments::advance_by_opening(std::int64_t stop) {
  for (int halvings = 0; halvings <= 2 * most_halvings; ++halvings, opening_ *= 0.5) {
    const std::int64_t steps = std::min(opening_steps_, stop - step_);
    WallIncrement next = increment_of(steps);
    next.opening = opening_;
    const double moved = network_.wall_displacement()[driven].z, before = past_.back().value;
    const IncrementReport found = solve(next);
    const double change = found.converged ? std::abs(observed_value() - before) / largest_ : 0;
    if (!found.converged || change > 2 * stress_change) {
      network_.reject();
      ++report_.rejected;
      if (halvings == 2 * most_halvings) fail(found);
      continue;
    }
    const double stress = observed_value();
    accept(steps, found, false);
    ++report_.by_opening;
    if (found.passes <= usual_passes) opening_ *= std::clamp(0.8 * stress_change / std::max(change, 1e-300), 0.7, 1.4);
    const double at = network_.wall_displacement()[driven].z;
    const bool beyond = std::abs(at) > std::abs(furthest_) && std::abs(at) > std::abs(moved);
    if (beyond || std::abs(stress) < 1e-3 * largest_) {
      by_opening_ = false;
      // The drive goes on from the first step at which it has this displacement
      std::int64_t low = step_ - lag_, high = low;
      while (low > 0 && std::abs(options_.drive->value(low)) > std::abs(at)) low /= 2;
      while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        (std::abs(options_.drive->value(middle)) > std::abs(at) ? high : low) = middle;
      }
      lag_ = step_ - high;
      past_ = {past_.back()};
      length_ = static_cast<double>(opening_steps_);
    }
    return;
  }
}

void Increments::count(const IncrementReport& found) {
  ++report_.increments;
  report_.loose = std::max(report_.loose, found.loose);
  report_.residual = std::max(report_.residual, found.residual);
}

IncrementReport Increments::solve(const WallIncrement& next) {
  const IncrementReport found = network_.solve(next);
  report_.passes += found.passes, report_.iterations += found.iterations;
  return found;
}

void Increments::fail(const IncrementReport& found) const {
  const std::string text = fmt::format(
      "quasi-static: found no equilibrium after t = {:.6g} s at a strain of {:.6g} (the forces are out of balance by "
      "{:.1e} of their size{}), although increments became very short; either the specimen fails there, or it moves "
      "suddenly{}",
      network_.time(), network_.wall_displacement()[driven].z / options_.height, found.residual,
      found.lost_stability ? "; its stiffness has a negative direction" : "",
      options_.temperature.empty()
          ? ", which method = \"explicit\" in [solver] can follow"
          : fmt::format("; its temperature is {:.4g} degrees C", options_.temperature.at(network_.time())));
  const double strain = network_.wall_displacement()[driven].z / options_.height;
  throw NoEquilibrium(text, {network_.time(), strain, -network_.wall_force()[driven].z / options_.area});
}

std::vector<StateArray> Increments::state() const {
  std::vector<StateArray> out = network_.state();
  std::vector<double> numbers{static_cast<double>(step_),
                              length_,
                              largest_,
                              by_opening_ ? 1.0 : 0.0,
                              opening_,
                              static_cast<double>(opening_steps_),
                              furthest_,
                              static_cast<double>(lag_),
                              static_cast<double>(report_.increments),
                              static_cast<double>(report_.rejected),
                              static_cast<double>(report_.passes),
                              static_cast<double>(report_.iterations),
                              report_.error,
                              static_cast<double>(report_.loose),
                              static_cast<double>(report_.by_opening),
                              report_.unstable ? 1.0 : 0.0};
  const CourseReport::Unstable unstable = report_.unstable.value_or(CourseReport::Unstable{});
  numbers.insert(numbers.end(), {unstable.time_s, unstable.strain, unstable.stress_pa});
  const CourseReport::Unstable dropped = report_.first_drop.value_or(CourseReport::Unstable{});
  numbers.push_back(static_cast<double>(past_.size()));
  numbers.insert(numbers.end(), {usual_, usual_opening_, error_sum_, largest_error_});
  for (std::size_t k = 0; k < 3; ++k) {
    const Past p = k < past_.size() ? past_[k] : Past{0, 0};
    numbers.insert(numbers.end(), {p.step, p.value});
  }
  numbers.insert(numbers.end(), {static_cast<double>(report_.drops), dropped.time_s, dropped.strain, dropped.stress_pa,
                                 report_.residual});
  out.push_back({"increments", "1", std::move(numbers)});
  return out;
}

void Increments::set_state(const std::vector<StateArray>& arrays) {
  const std::vector<double>* n = nullptr;
  for (const StateArray& array : arrays) {
    if (array.name == "increments") n = std::get_if<std::vector<double>>(&array.values);
  }
  if (!n || n->size() != 35 || !((*n)[19] >= 1 && (*n)[19] <= 3))
    throw RunError("state: found no array increments with 35 numbers for method \"quasi_static\"");
  network_.set_state(arrays);
  const auto whole = [&](std::size_t k) { return static_cast<std::int64_t>((*n)[k]); };
  usual_ = (*n)[20], usual_opening_ = (*n)[21], error_sum_ = (*n)[22], largest_error_ = (*n)[23];
  step_ = whole(0), length_ = (*n)[1], largest_ = (*n)[2], by_opening_ = (*n)[3] != 0, opening_ = (*n)[4];
  opening_steps_ = whole(5), furthest_ = (*n)[6], lag_ = whole(7);
  report_ = {whole(8), whole(9), whole(10), whole(11), (*n)[12], whole(13), (*n)[34], {}, whole(14)};
  if ((*n)[15] != 0) report_.unstable = {(*n)[16], (*n)[17], (*n)[18]};
  report_.drops = whole(30);
  if (report_.drops > 0) report_.first_drop = {(*n)[31], (*n)[32], (*n)[33]};
  past_.clear();
  for (std::size_t k = 0; k < static_cast<std::size_t>((*n)[19]); ++k)
    past_.push_back({(*n)[24 + 2 * k], (*n)[25 + 2 * k]});
}

}  // namespace macadam::quasi_static
