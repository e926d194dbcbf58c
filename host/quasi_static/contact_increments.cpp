// SPDX-License-Identifier: GPL-3.0-or-later
// contact_increments.cpp  Computes forces and tangent stiffnesses of contacts. The laws are those of the time step;
// contacts with cracks use the consistent tangent of laws/crack_tangent.hpp at each of their points.
#include "host/quasi_static/contact_increments.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/base/parallel.hpp"
#include "kernels/contact/contact_kinematics.hpp"
#include "kernels/contact/series_factors.hpp"
#include "macadam/error.hpp"
#include "macadam/laws/crack_tangent.hpp"

namespace macadam::quasi_static {

namespace {

/// Number of contacts in a piece of a parallel sum.
constexpr std::size_t contacts_at_once = 1024;

std::array<double, 6> moments_over_length(const Contact& c) {
  const AreaMoments& m = c.moments;
  return {m.a / c.length, m.s / c.length, m.t / c.length, m.ss / c.length, m.st / c.length, m.tt / c.length};
}

/// Returns the six forces of a condensed contact with the densities f (model (7.1)).
Six condensed_forces(const Six& f, double alpha, const std::array<double, 6>& m) {
  return {m[0] * f[0] + m[1] * f[1] + m[2] * f[2], m[1] * f[0] + m[3] * f[1] + m[4] * f[2],
          m[2] * f[0] + m[4] * f[1] + m[5] * f[2], alpha * (m[0] * f[3] - m[2] * f[5]),
          alpha * (m[0] * f[4] + m[1] * f[5]),     alpha * (-m[2] * f[3] + m[1] * f[4] + (m[3] + m[5]) * f[5])};
}

double dot_six(const Six& a, const Six& b) {
  double out = 0;
  for (std::size_t k = 0; k < 6; ++k) out += a[k] * b[k];
  return out;
}

}  // namespace

Six relative(const Contact& c, const double* a, const double* b) {
  using kernels::Twist;
  double u[6];
  const kernels::Placement<double> placement{c.n, c.s, c.t, c.arm_a, c.arm_b};
  kernels::relative_rates(placement, Twist<double>{{a[0], a[1], a[2]}, {a[3], a[4], a[5]}},
                          Twist<double>{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}, u);
  return {u[0], u[1], u[2], u[3], u[4], u[5]};
}

Six load_on(const Contact& c, const Six& f, int end) {
  const double sign = end == 0 ? -1 : 1, arm = end == 0 ? c.arm_a : c.arm_b;
  const auto at = [&](double Vec3d::*x) {
    return Six{sign * (c.n.*x * f[0] + c.s.*x * f[3] + c.t.*x * f[4]),
               sign * (c.s.*x * f[2] - c.t.*x * f[1] + c.n.*x * f[5]) + arm * (c.s.*x * f[4] - c.t.*x * f[3])};
  };
  const Six x = at(&Vec3d::x), y = at(&Vec3d::y), z = at(&Vec3d::z);
  return {x[0], y[0], z[0], x[1], y[1], z[1]};
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

ContactEnergies& ContactEnergies::operator+=(const ContactEnergies& o) {
  elastic += o.elastic, viscous += o.viscous, crack += o.crack, friction += o.friction, crack_work += o.crack_work;
  opened += o.opened, growing += o.growing;
  return *this;
}

ContactIncrements::ContactIncrements(const ContactNetwork& network, const LawTable& laws) : network_(network) {
  const auto chain_of = [](const auto& law) -> Chain {
    if constexpr (requires { law.E_m; }) {
      return {law.E_m, law.C_m, law.E, law.C, law.alpha};
    } else {
      return {law.E, std::numeric_limits<double>::infinity(), {}, {}, law.alpha};
    }
  };
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    if (!laws[pair] || network.count[pair] == 0) continue;
    PairLaw& to = laws_[pair];
    std::visit(
        [&]<class L>(const L& law) {
          if constexpr (cracking_law<L> || has_stiffness<L>) {
            to.chain = chain_of(law);
            to.words = 1 + to.chain.units();
            if constexpr (cracking_law<L>) {
              to.cracked.emplace(CrackedChain{to.chain, law.crack});
              to.words = 1 + to.cracked->units();
              has_cracks_ = true;
            }
          } else {
            throw InputError(std::string("quasi-static: found law ") + L::name + " of " +
                             to_string(static_cast<PairType>(pair)) +
                             ", expected elastic or generalised_kelvin, with or without a crack (a crack with the "
                             "softening \"brittle\" breaks as a brittle_bond)");
          }
        },
        *laws[pair]);
  }
  const std::size_t n = network.contacts.size();
  begin_.assign(1, 0);
  base_begin_.assign(1, 0);
  for (const Contact& c : network.contacts) {
    const PairLaw& l = law(c);
    const std::size_t points = c.point_end - c.point_begin, components = l.cracked ? 3 * points : 6;
    begin_.push_back(begin_.back() + components * static_cast<std::size_t>(l.words));
    base_begin_.push_back(base_begin_.back() + components);
    if (!l.cracked) continue;
    if (c.series != 0)
      throw InputError("quasi-static: a contact with rock in series cannot crack; found rule \"series\" with a crack");
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

void ContactIncrements::begin(const LawTimes& dt) {
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    PairLaw& l = laws_[pair];
    if (dt[pair] == l.dt) continue;
    l.dt = dt[pair];
    l.step = l.chain.step<double>(l.dt);
    if (l.cracked) l.increment.emplace(l.cracked->increment(l.dt));
  }
  growing_area_ = area_of(grew_);
  for_each_of(network_.contacts.size(), [&](std::size_t c) { prepare(c); });
}

void ContactIncrements::prepare(std::size_t number) {
  const Contact& c = network_.contacts[number];
  const PairLaw& l = law(c);
  double* state = states_.data() + begin_[number];
  double* base = base_.data() + base_begin_[number];
  const auto words = static_cast<std::size_t>(l.words);
  if (!l.cracked) {
    const auto factors = kernels::SeriesFactors<double>::of(c.series, l.step.inv_c, l.chain.alpha);
    for (std::size_t k = 0; k < 6; ++k) {
      double* own = state + k * words;
      base[k] = l.step.trial<-1>(
          own[0], 0.0, [own](int u) -> double& { return own[1 + u]; }, factors.of_component(static_cast<int>(k)));
    }
    return;
  }
  const std::size_t points = c.point_end - c.point_begin;
  const double over_d = 1 / c.length;
  for (std::size_t k = 0; k < 3 * points; ++k) {
    double* own = state + k * words;
    const double f =
        l.step.trial<-1>(own[0], 0.0, [own](int u) -> double& { return own[1 + CrackedChain::crack_numbers + u]; });
    base[k] = (k % 3 == 0 ? over_d : over_d * l.chain.alpha) * f;
  }
}

void ContactIncrements::evaluate(const std::vector<Six>& u) {
  for_each_of(network_.contacts.size(), [&](std::size_t c) {
    if (law(network_.contacts[c]).cracked)
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
  const PairLaw& l = law(c);
  const auto factors = kernels::SeriesFactors<double>::of(c.series, l.step.inv_c, l.chain.alpha);
  const double k[2] = {l.step.inv_c * factors.normal, l.step.inv_c * factors.shear};
  const double* base = base_.data() + base_begin_[number];
  const auto m = moments_over_length(c);
  Six f;
  for (std::size_t i = 0; i < 6; ++i) f[i] = base[i] + k[i / 3] * u[i];
  force_[number] = condensed_forces(f, l.chain.alpha, m);
  const double n = k[0], s = k[1] * l.chain.alpha;
  stiffness_[number] = {n * m[0], n * m[1], n * m[2], 0,         0,        0,          //
                        n * m[1], n * m[3], n * m[4], 0,         0,        0,          //
                        n * m[2], n * m[4], n * m[5], 0,         0,        0,          //
                        0,        0,        0,        s * m[0],  0,        -s * m[2],  //
                        0,        0,        0,        0,         s * m[0], s * m[1],   //
                        0,        0,        0,        -s * m[2], s * m[1], s * (m[3] + m[5])};
}

void ContactIncrements::evaluate_points(std::size_t number, const Six& u) {
  using laws::CrackTangent;
  const Contact& c = network_.contacts[number];
  const PairLaw& l = law(c);
  const auto words = static_cast<std::size_t>(l.words);
  const auto& crack = l.increment->crack;
  const double kappa = l.step.inv_c / c.length, kappa_s = l.chain.alpha * kappa;
  const double over_ft = 1 / l.cracked->crack.tensile_strength, over_c0 = 1 / l.cracked->crack.shear_strength;
  Six& force = force_[number];
  SixBySix& stiffness = stiffness_[number];
  force.fill(0);
  stiffness.fill(0);
  const bool follows_opening = growing_area_ > 0;
  double opening = 0;
  Six rate{};
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
    const std::size_t p = j - c.point_begin;
    const double s = network_.point_s[j], t = network_.point_t[j], area = network_.point_area[j];
    const double* base = base_.data() + base_begin_[number] + 3 * p;
    const double* state = states_.data() + begin_[number] + 3 * p * words;
    const double normal = base[0] + kappa * (u[0] + s * u[1] + t * u[2]);
    const double shear[2] = {base[1] + kappa_s * (u[3] - t * u[5]), base[2] + kappa_s * (u[4] + s * u[5])};
    const laws::CrackOpenings<double> old{state[1], {state[words + 1], state[2 * words + 1]}, state[2]};
    CrackTangent out;
    const double open = std::max(normal, 0.0) * over_ft;
    // a point below its strength without friction is intact in any case
    if (!(old.largest > 0) && open * open + (shear[0] * shear[0] + shear[1] * shear[1]) * over_c0 * over_c0 <= 1) {
      out = {{normal, shear[0], shear[1]},
             {{kappa, 0, 0}, {0, kappa_s, 0}, {0, 0, kappa_s}},
             old,
             laws::PointBranch::rests};
    } else {
      out = CrackTangent::of(crack, normal, shear, kappa, old);
    }
    const double* sigma = out.stress;
    force[0] += area * sigma[0];
    force[1] += area * s * sigma[0];
    force[2] += area * t * sigma[0];
    force[3] += area * sigma[1];
    force[4] += area * sigma[2];
    force[5] += area * (s * sigma[2] - t * sigma[1]);
    grows_[j] = out.branch == laws::PointBranch::grows;
    const double on_normal[3] = {1, s, t};
    if (follows_opening && grew_[j]) {
      const double part = area / growing_area_;
      opening += part * (out.w.opening - old.opening);
      double by[3];
      for (int k = 0; k < 3; ++k) by[k] = part * ((k == 0) - out.stiffness[0][k] / kappa);
      for (std::size_t k = 0; k < 3; ++k) rate[k] += by[0] * on_normal[k];
      rate[3] += by[1], rate[4] += by[2], rate[5] += s * by[2] - t * by[1];
    }
    // B·D·B with the rows (1, s, t, 0, 0, 0), (0, 0, 0, 1, 0, −t), (0, 0, 0, 0, 1, s) of B
    double columns[3][6];  // D·B
    for (int k = 0; k < 3; ++k) {
      const double* d = out.stiffness[k];
      const double row[6] = {d[0], d[0] * s, d[0] * t, d[1], d[2], d[2] * s - d[1] * t};
      for (int i = 0; i < 6; ++i) columns[k][i] = area * row[i];
    }
    for (std::size_t i = 0; i < 6; ++i) {
      stiffness[i] += columns[0][i];
      stiffness[6 + i] += s * columns[0][i];
      stiffness[12 + i] += t * columns[0][i];
      stiffness[18 + i] += columns[1][i];
      stiffness[24 + i] += columns[2][i];
      stiffness[30 + i] += s * columns[2][i] - t * columns[1][i];
    }
  }
  if (follows_opening) opening_of_[number] = opening, opening_rate_[number] = rate;
}

Six ContactIncrements::accepted_force(std::size_t number) const {
  const Contact& c = network_.contacts[number];
  const PairLaw& l = law(c);
  const double* state = states_.data() + begin_[number];
  const auto words = static_cast<std::size_t>(l.words);
  if (!l.cracked) {
    Six f;
    for (std::size_t k = 0; k < 6; ++k) f[k] = state[k * words];
    return condensed_forces(f, l.chain.alpha, moments_over_length(c));
  }
  Six out{};
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
    const double* own = state + 3 * (j - c.point_begin) * words;
    const double s = network_.point_s[j], t = network_.point_t[j], part = network_.point_area[j] / c.length;
    const double f[3] = {part * own[0], l.chain.alpha * part * own[words], l.chain.alpha * part * own[2 * words]};
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
        std::vector<double> before;  // states of one contact, or of one point
        for (std::size_t c = from; c < to; ++c) {
          sum += law(network_.contacts[c]).cracked ? accept_points(c, u[c], before) : accept_linear(c, u[c], before);
        }
        return sum;
      });
  grew_ = grows_;
  return sums;
}

ContactEnergies ContactIncrements::accept_linear(std::size_t number, const Six& u, std::vector<double>& before) {
  const Contact& c = network_.contacts[number];
  const PairLaw& l = law(c);
  const auto words = static_cast<std::size_t>(l.words);
  const auto units = static_cast<std::size_t>(l.chain.units());
  const auto m = moments_over_length(c);
  double* state = states_.data() + begin_[number];
  const double* base = base_.data() + base_begin_[number];
  const auto factors = kernels::SeriesFactors<double>::of(c.series, l.step.inv_c, l.chain.alpha);
  const auto form = [&](const Six& x) { return dot_six(x, condensed_forces(x, l.chain.alpha, m)); };
  before.assign(state, state + 6 * words);
  for (std::size_t k = 0; k < 6; ++k) {
    double* own = state + k * words;
    const double f = base[k] + l.step.inv_c * factors.of_component(static_cast<int>(k)) * u[k];
    l.step.follow<-1>(f + own[0], [own](int n) -> double& { return own[1 + n]; });
    own[0] = f;
  }
  const auto numbers = [&](auto&& of) {
    Six out;
    for (std::size_t k = 0; k < 6; ++k) out[k] = of(k);
    return out;
  };
  ContactEnergies out;
  const Six f = numbers([&](std::size_t k) { return state[k * words]; });
  out.elastic = 0.5 * form(f) / l.chain.E_m;
  if (c.series != 0) {  // rock takes r·f of the opening, and r·α·f of the slip
    const Six weighted = numbers([&](std::size_t k) { return k < 3 ? f[k] : l.chain.alpha * f[k]; });
    out.elastic += 0.5 * c.series * dot_six(weighted, condensed_forces(f, l.chain.alpha, m));
  }
  if (std::isfinite(l.chain.C_m)) {
    out.viscous += l.dt / l.chain.C_m * form(numbers([&](std::size_t k) { return 0.5 * (f[k] + before[k * words]); }));
  }
  for (std::size_t n = 0; n < units; ++n) {
    out.elastic += 0.5 * l.chain.E[n] * form(numbers([&](std::size_t k) { return state[k * words + 1 + n]; }));
    out.viscous += l.chain.C[n] / l.dt *
                   form(numbers([&](std::size_t k) { return state[k * words + 1 + n] - before[k * words + 1 + n]; }));
  }
  return out;
}

ContactEnergies ContactIncrements::accept_points(std::size_t number, const Six& u, std::vector<double>& before) {
  const Contact& c = network_.contacts[number];
  const PairLaw& l = law(c);
  const auto words = static_cast<std::size_t>(l.words);
  const auto units = static_cast<std::size_t>(l.chain.units());
  constexpr std::size_t first_unit = 1 + CrackedChain::crack_numbers;
  const double d = c.length, alpha = l.chain.alpha;
  ContactEnergies out;
  before.resize(3 * words);
  for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) {
    double* state = states_.data() + begin_[number] + 3 * (j - c.point_begin) * words;
    std::copy(state, state + 3 * words, before.begin());
    const double s = network_.point_s[j], t = network_.point_t[j], area = network_.point_area[j];
    const double dx[3] = {u[0] + s * u[1] + t * u[2], u[3] - t * u[5], u[4] + s * u[5]};
    l.increment->advance_point<-1>(dx, d, [state, words](int component, int n) -> double& {
      return state[static_cast<std::size_t>(component) * words + static_cast<std::size_t>(n)];
    });
    for (std::size_t k = 0; k < 3; ++k) {
      const double *now = state + k * words, *old = before.data() + k * words;
      const double weight = (k == 0 ? 1 : alpha) * area / d, mean = 0.5 * (now[0] + old[0]);
      double elastic = 0.5 * now[0] * now[0] / l.chain.E_m, viscous = 0;
      if (std::isfinite(l.chain.C_m)) viscous += l.dt / l.chain.C_m * mean * mean;
      for (std::size_t n = 0; n < units; ++n) {
        const double x = now[first_unit + n], change = x - old[first_unit + n];
        elastic += 0.5 * l.chain.E[n] * x * x;
        viscous += l.chain.C[n] / l.dt * change * change;
      }
      out.elastic += weight * elastic;
      out.viscous += weight * viscous;
      out.crack_work += weight * mean * (now[1] - old[1]);
    }
    if (grows_[j]) out.opened += area * (state[1] - before[1]), out.growing += area;
    const laws::PointCrack crack = l.cracked->crack_of(state);
    out.crack += area * crack.energy;
    out.friction += area * crack.friction;
  }
  return out;
}

std::vector<laws::PointCrack> ContactIncrements::point_cracks() const {
  if (!has_cracks_) return {};
  std::vector<laws::PointCrack> out(network_.point_area.size());
  for_each_of(network_.contacts.size(), [&](std::size_t number) {
    const Contact& c = network_.contacts[number];
    const PairLaw& l = law(c);
    if (!l.cracked) return;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j)
      out[j] = l.cracked->crack_of(states_.data() + begin_[number] +
                                   3 * (j - c.point_begin) * static_cast<std::size_t>(l.words));
  });
  return out;
}

std::vector<Break> ContactIncrements::point_breaks() const {
  if (!has_cracks_) return {};
  std::vector<Break> out(network_.point_area.size(), Break::none);
  for_each_of(network_.contacts.size(), [&](std::size_t number) {
    const Contact& c = network_.contacts[number];
    const PairLaw& l = law(c);
    if (!l.cracked) return;
    for (std::uint32_t j = c.point_begin; j < c.point_end; ++j)
      out[j] = l.cracked->break_of(states_.data() + begin_[number] +
                                   3 * (j - c.point_begin) * static_cast<std::size_t>(l.words));
  });
  return out;
}

void ContactIncrements::set_states(std::vector<double> states, std::vector<char> grew) {
  states_ = std::move(states);
  grew_ = std::move(grew);
  grows_ = grew_;
}

std::int64_t ContactIncrements::bytes() const {
  return static_cast<std::int64_t>((states_.size() + base_.size()) * sizeof(double) +
                                   force_.size() * (sizeof(Six) + sizeof(SixBySix)) + 2 * grew_.size() +
                                   opening_rate_.size() * (sizeof(Six) + sizeof(double)));
}

}  // namespace macadam::quasi_static
