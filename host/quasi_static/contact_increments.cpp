// SPDX-License-Identifier: GPL-3.0-or-later
// contact_increments.cpp  Computes forces and tangent stiffnesses of contacts. The laws are those of the time step;
// contacts with cracks use the consistent tangent of laws/crack_tangent.hpp at each of their points.
#include "host/quasi_static/contact_increments.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam::quasi_static {

namespace {

/// Number of contacts in a piece of a parallel sum.
constexpr std::size_t contacts_at_once = 1024;

kernels::Placement<double> placement(const Contact& c) { return {c.n, c.s, c.t, c.arm_a, c.arm_b}; }

kernels::LinearContact linear_contact(const Contact& c) {
  kernels::LinearContact out{c.series, {}};
  const auto m = moments_over_length(c);
  std::copy(m.begin(), m.end(), out.moments);
  return out;
}

/// Gives access to number n of component k of a contact or of a point.
auto numbers_of(double* state, const kernels::IncrementLaw& law) {
  return [state, words = static_cast<std::size_t>(law.words)](int k, int n) -> double& {
    return state[static_cast<std::size_t>(k) * words + static_cast<std::size_t>(n)];
  };
}

}  // namespace

std::array<double, 6> moments_over_length(const Contact& c) {
  const AreaMoments& m = c.moments;
  return {m.a / c.length, m.s / c.length, m.t / c.length, m.ss / c.length, m.st / c.length, m.tt / c.length};
}

Six relative(const Contact& c, const double* a, const double* b) {
  using kernels::Twist;
  double u[6];
  kernels::relative_rates(placement(c), Twist<double>{{a[0], a[1], a[2]}, {a[3], a[4], a[5]}},
                          Twist<double>{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}, u);
  return {u[0], u[1], u[2], u[3], u[4], u[5]};
}

Six load_on(const Contact& c, const Six& f, int end) {
  Six out;
  kernels::load_on(placement(c), f.data(), end, out.data());
  return out;
}

SixBySix motion_matrix(const Contact& c, int end) {
  const double sign = end == 0 ? -1 : 1, arm = end == 0 ? c.arm_a : c.arm_b;
  const Vec3d n = sign * c.n, s = sign * c.s, t = sign * c.t, across = arm * c.s, along = -arm * c.t;
  return {n.x, n.y, n.z, 0,        0,        0,         //
          0,   0,   0,   -t.x,     -t.y,     -t.z,      //
          0,   0,   0,   s.x,      s.y,      s.z,       //
          s.x, s.y, s.z, along.x,  along.y,  along.z,   //
          t.x, t.y, t.z, across.x, across.y, across.z,  //
          0,   0,   0,   n.x,      n.y,      n.z};
}

PairLaws pair_laws(const ContactNetwork& network, const LawTable& laws) {
  const auto chain_of = [](const auto& law) -> laws::GeneralisedKelvin {
    if constexpr (requires { law.E_m; }) {
      return {law.E_m, law.C_m, law.E, law.C, law.alpha};
    } else {
      return {law.E, std::numeric_limits<double>::infinity(), {}, {}, law.alpha};
    }
  };
  PairLaws out;
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair] || network.count[pair] == 0) continue;
    std::visit(
        [&]<class L>(const L& law) {
          if constexpr (cracking_law<L> || has_stiffness<L>) {
            out[pair].chain = chain_of(law);
            if constexpr (cracking_law<L>) out[pair].cracked.emplace(laws::Cracked{out[pair].chain, law.crack});
          } else {
            throw InputError(std::string("quasi-static: found law ") + L::name + " of " +
                             to_string(static_cast<PairType>(pair)) +
                             ", expected elastic or generalised_kelvin, with or without a crack (a crack with the "
                             "softening \"brittle\" breaks as a brittle_bond)");
          }
        },
        *laws[pair]);
  }
  return out;
}

ContactIncrements::ContactIncrements(const ContactNetwork& network, const LawTable& laws)
    : network_(network), laws_(pair_laws(network, laws)) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    has_cracks_ = has_cracks_ || laws_[pair].cracked;
    increment_[pair] = laws_[pair].increment(0);
  }
  const std::size_t n = network.contacts.size();
  begin_.assign(1, 0);
  base_begin_.assign(1, 0);
  for (const Contact& c : network.contacts) {
    const kernels::IncrementLaw& l = law(c);
    const std::size_t points = c.point_end - c.point_begin, components = l.cracks ? 3 * points : 6;
    begin_.push_back(begin_.back() + components * static_cast<std::size_t>(l.words));
    base_begin_.push_back(base_begin_.back() + components);
    if (!l.cracks) continue;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) crackable_area_ += network.point_area[j];
  }
  states_.assign(begin_.back(), 0.0);
  base_.assign(base_begin_.back(), 0.0);
  force_.assign(n, Six{});
  stiffness_.assign(n, SixBySix{});
  if (!has_cracks_) return;
  grew_.assign(network.point_area.size(), 0);
  grows_ = grew_;
  opening_of_.assign(n, 0.0);
  opening_rate_.assign(n, Six{});
}

void ContactIncrements::begin(const LawTimes& dt, double drag) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (dt[pair] != increment_[pair].dt) increment_[pair] = laws_[pair].increment(dt[pair]);
    increment_[pair].drag = drag;
  }
  if (drag > 0) drag_.resize(3 * grew_.size());
  growing_area_ = area_of(grew_);
  for_each_of(network_.contacts.size(), [&](std::size_t c) { prepare(c); });
}

void ContactIncrements::prepare(std::size_t number) {
  const Contact& c = network_.contacts[number];
  const kernels::IncrementLaw& l = law(c);
  double* state = states_.data() + begin_[number];
  double* base = base_.data() + base_begin_[number];
  if (!l.cracks) return kernels::prepare_linear(l, c.series, numbers_of(state, l), base);
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j, state += 3 * l.words, base += 3)
    kernels::prepare_point(l, c.length, c.series, numbers_of(state, l), base);
}

void ContactIncrements::evaluate(const std::vector<Six>& u) {
  for_each_of(network_.contacts.size(), [&](std::size_t c) {
    if (law(network_.contacts[c]).cracks)
      evaluate_points(c, u[c]);
    else
      evaluate_linear(c, u[c]);
  });
  opening_ = 0;
  if (growing_area_ > 0) {
    opening_ = sum_in_parallel<double>(opening_of_.size(), [&](std::size_t c) { return opening_of_[c]; });
  }
}

void ContactIncrements::evaluate_linear(std::size_t number, const Six& u) {
  const Contact& c = network_.contacts[number];
  const kernels::LinearContact linear = linear_contact(c);
  kernels::linear_forces(law(c), linear, base_.data() + base_begin_[number], u.data(), force_[number].data());
  kernels::linear_stiffness(law(c), linear, stiffness_[number].data());
}

void ContactIncrements::evaluate_points(std::size_t number, const Six& u) {
  const Contact& c = network_.contacts[number];
  const kernels::IncrementLaw& l = law(c);
  const auto words = static_cast<std::size_t>(l.words);
  const auto stiffness = kernels::PointStiffness::of(l, c.length, c.series);
  const bool follows_opening = growing_area_ > 0;
  kernels::PointSums sums;
  kernels::TangentSums tangent;
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
    const std::size_t p = j - c.point_begin;
    const double* base = base_.data() + base_begin_[number] + 3 * p;
    const double* state = states_.data() + begin_[number] + 3 * p * words;
    const double area = network_.point_area[j];
    const kernels::PointStart point{network_.point_s[j],
                                    network_.point_t[j],
                                    area,
                                    {base[0], base[1], base[2]},
                                    {state[1], {state[words + 1], state[2 * words + 1]}, state[2]},
                                    follows_opening && grew_[j] ? area / growing_area_ : 0};
    grows_[j] = kernels::add_point(l, stiffness, point, u.data(), sums, tangent);
  }
  std::copy(sums.force, sums.force + 6, force_[number].begin());
  std::copy(tangent.stiffness, tangent.stiffness + 36, stiffness_[number].begin());
  if (!follows_opening) return;
  opening_of_[number] = sums.opening;
  std::copy(tangent.opening_rate, tangent.opening_rate + 6, opening_rate_[number].begin());
}

Six ContactIncrements::accepted_force(std::size_t number) const {
  const Contact& c = network_.contacts[number];
  const kernels::IncrementLaw& l = law(c);
  const double* state = states_.data() + begin_[number];
  const auto words = static_cast<std::size_t>(l.words);
  Six out{};
  if (!l.cracks) {
    Six f;
    for (std::size_t k = 0; k < 6; ++k) f[k] = state[k * words];
    kernels::condensed_forces(f.data(), l.alpha(), linear_contact(c).moments, out.data());
    return out;
  }
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
    const double* own = state + 3 * (j - c.point_begin) * words;
    const double s = network_.point_s[j], t = network_.point_t[j], part = network_.point_area[j] / c.length;
    const double f[3] = {part * own[0], l.alpha() * part * own[words], l.alpha() * part * own[2 * words]};
    out[0] += f[0], out[1] += s * f[0], out[2] += t * f[0];
    out[3] += f[1], out[4] += f[2], out[5] += s * f[2] - t * f[1];
  }
  return out;
}

double ContactIncrements::area_of(const std::vector<char>& points) const {
  return sum_in_parallel<double>(points.size(),
                                 [&](std::size_t j) { return points[j] ? network_.point_area[j] : 0.0; });
}

double ContactIncrements::growing_part() const { return crackable_area_ > 0 ? area_of(grows_) / crackable_area_ : 0; }

ContactEnergies ContactIncrements::accept(const std::vector<Six>& u) {
  const auto sums =
      sum_of_pieces<ContactEnergies>(network_.contacts.size(), contacts_at_once, [&](std::size_t from, std::size_t to) {
        ContactEnergies sum;
        for (std::size_t c = from; c < to; ++c) sum += accept_contact(c, u[c]);
        return sum;
      });
  grew_ = grows_;
  if (sums.drag == 0) drag_.clear();
  return sums;
}

ContactEnergies ContactIncrements::accept_contact(std::size_t number, const Six& u) {
  const Contact& c = network_.contacts[number];
  const kernels::IncrementLaw& l = law(c);
  double* state = states_.data() + begin_[number];
  if (!l.cracks) {
    return kernels::accept_linear(l, linear_contact(c), base_.data() + base_begin_[number], u.data(),
                                  numbers_of(state, l));
  }
  ContactEnergies out;
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j, state += 3 * l.words) {
    kernels::accept_point(l, c.length, c.series, network_.point_s[j], network_.point_t[j], network_.point_area[j],
                          grows_[j], u.data(), numbers_of(state, l), out);
    if (drag_.empty()) continue;
    kernels::accept_drag(
        l, kernels::PointStiffness::of(l, c.length, c.series), network_.point_s[j], network_.point_t[j],
        network_.point_area[j], u.data(), [&](int k) -> double& { return drag_[3 * j + static_cast<std::size_t>(k)]; },
        out);
  }
  return out;
}

std::vector<laws::PointCrack> ContactIncrements::point_cracks() const {
  if (!has_cracks_) return {};
  std::vector<laws::PointCrack> out(network_.point_area.size());
  for_each_of(network_.contacts.size(), [&](std::size_t number) {
    const Contact& c = network_.contacts[number];
    const kernels::IncrementLaw& l = law(c);
    if (!l.cracks) return;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j)
      out[j] = cracked(c).crack_of(states_.data() + begin_[number] +
                                   3 * (j - c.point_begin) * static_cast<std::size_t>(l.words));
  });
  return out;
}

std::vector<Break> ContactIncrements::point_breaks() const {
  if (!has_cracks_) return {};
  std::vector<Break> out(network_.point_area.size(), Break::none);
  for_each_of(network_.contacts.size(), [&](std::size_t number) {
    const Contact& c = network_.contacts[number];
    const kernels::IncrementLaw& l = law(c);
    if (!l.cracks) return;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j)
      out[j] = cracked(c).break_of(states_.data() + begin_[number] +
                                   3 * (j - c.point_begin) * static_cast<std::size_t>(l.words));
  });
  return out;
}

void ContactIncrements::set_states(std::vector<double> states, std::vector<char> grew) {
  states_ = std::move(states);
  grew_ = std::move(grew);
  grows_ = grew_;
  drag_.clear();
}

std::int64_t ContactIncrements::bytes() const {
  return static_cast<std::int64_t>(
      (states_.size() + base_.size()) * sizeof(double) + force_.size() * (sizeof(Six) + sizeof(SixBySix)) +
      2 * grew_.size() + drag_.size() * sizeof(double) + opening_rate_.size() * (sizeof(Six) + sizeof(double)));
}

}  // namespace macadam::quasi_static
