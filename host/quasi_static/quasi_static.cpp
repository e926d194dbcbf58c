// SPDX-License-Identifier: GPL-3.0-or-later
// quasi_static.cpp  Keeps the accepted state of a specimen, and guesses the motion of the next increment.
#include "macadam/quasi_static.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/quasi_static/motion_guess.hpp"
#include "kernels/base/parallel.hpp"
#include "macadam/error.hpp"

namespace macadam {

using quasi_static::MotionGuess;
using quasi_static::Newton;
using quasi_static::Six;
using quasi_static::Trial;

namespace {

double sum_of(const QuasiStaticEnergies& e) {
  return std::max(
      {std::abs(e.work_j), std::abs(e.thermal_j), e.elastic_j + e.viscous_j + std::abs(e.crack_work_j) + e.damping_j});
}

std::unique_ptr<quasi_static::Engine> make_engine(const Specimen& specimen, const ContactNetwork& network,
                                                  const LawTable& laws, const QuasiStaticOptions& options) {
  if (options.backend == Backend::reference)
    throw InputError("quasi-static: found backend reference, expected cpu, cuda or auto");
  if (!options.expansion.empty() && options.expansion.size() != network.contacts.size())
    throw InputError("quasi-static: found expansions of " + std::to_string(options.expansion.size()) +
                     " contacts, expected " + std::to_string(network.contacts.size()));
  const bool only_cpu = options.backend == Backend::automatic && !options.expansion.empty();
  const bool on_device = !only_cpu && select_backend(options.backend, nullptr, options.devices) == Backend::cuda;
  return (on_device ? quasi_static::make_device_engine : quasi_static::make_cpu_engine)(specimen, network, laws,
                                                                                        options);
}

}  // namespace

double QuasiStaticEnergies::imbalance() const {
  const double sum = sum_of(*this);
  return sum > 0 ? std::abs(work_j + thermal_j - elastic_j - viscous_j - crack_work_j - damping_j) / sum : 0;
}

double QuasiStaticEnergies::increment_error() const {
  const double sum = sum_of(*this);
  return sum > 0 ? std::abs(crack_j + friction_j - crack_work_j) / sum : 0;
}

struct QuasiStatic::Parts {
  Parts(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
        const QuasiStaticOptions& options)
      : network(network),
        particles(specimen.size()),
        newton(make_engine(specimen, network, laws, options), options),
        motions(particles) {}

  const ContactNetwork& network;
  std::size_t particles;
  Newton newton;
  // The accepted state; the engine has the states of particles and contacts
  double time = 0, scale = 0;
  quasi_static::Walls wall{}, reaction{};
  MotionGuess motions;
  QuasiStaticEnergies energies;
  double last_opening = 0;
  double drag = 0;  ///< as QuasiStatic::drag()
  // The solution, until it is accepted
  Trial trial;
  WallIncrement increment;
  bool solved = false;
  quasi_static::Walls shown_force{}, shown_wall{};

  quasi_static::Engine& engine() { return newton.engine(); }

  void show(const quasi_static::Walls& at, const quasi_static::Walls& held) {
    shown_wall = at;
    for (std::size_t w = 0; w < wall_count; ++w) shown_force[w] = -held[w];
  }

  IncrementReport solve(const WallIncrement& next) {
    increment = next;
    trial.wall = next.wall;
    motions.guess(next, trial);
    const IncrementReport out = newton.solve(next, scale, trial);
    solved = out.converged;
    if (solved) {
      auto at = wall;
      for (std::size_t w = 0; w < wall_count; ++w) at[w] += trial.wall[w];
      show(at, trial.sums.reaction);
    } else {
      show(wall, reaction);
    }
    return out;
  }

  void start(const StartState& state) {
    const auto& contacts = engine().contacts();
    if (contacts.has_cracks() || state.chain.size() != contacts.states().size() ||
        state.displacement.size() != particles || state.rotation.size() != particles)
      throw InputError("quasi-static: found a state of motion with " + std::to_string(state.chain.size()) +
                       " numbers of contacts and " + std::to_string(state.displacement.size()) +
                       " particles, expected " + std::to_string(contacts.states().size()) + " and " +
                       std::to_string(particles) + ", and laws without cracks");
    quasi_static::EngineState to{quasi_static::Vector(6 * particles), state.chain, contacts.grew()};
    for (std::size_t i = 0; i < particles; ++i) {
      const Vec3d &u = state.displacement[i], &r = state.rotation[i];
      const double six[6] = {u.x, u.y, u.z, r.x, r.y, r.z};
      std::copy(six, six + 6, &to.displacement[6 * i]);
    }
    engine().set_state(std::move(to));
    const auto& started = engine().contacts();
    reaction.fill({});
    for (std::size_t c = 0; c < network.contacts.size(); ++c) {
      const Contact& contact = network.contacts[c];
      if (contact.b >= 0) continue;
      const Six load = quasi_static::load_on(contact, started.accepted_force(c), 1);
      reaction[wall_index(contact.b)] += Vec3d{load[0], load[1], load[2]};
    }
    show(wall, reaction);
    drag = 0;
  }

  void accept() {
    if (!solved) throw RunError("quasi-static: accept() needs an increment that has converged");
    energies.thermal_j += engine().thermal_work(increment.warming);
    const quasi_static::ContactEnergies sums = engine().accept();
    for (std::size_t w = 0; w < wall_count; ++w) {
      energies.work_j += 0.5 * dot(reaction[w] + trial.sums.reaction[w], trial.wall[w]);
      wall[w] += trial.wall[w];
    }
    reaction = trial.sums.reaction;
    energies.elastic_j = sums.elastic;
    energies.viscous_j += sums.viscous;
    energies.crack_j = sums.crack;
    energies.friction_j = sums.friction;
    energies.crack_work_j += sums.crack_work;
    energies.damping_j += sums.damping;
    drag = sums.drag;
    last_opening = sums.growing > 0 ? sums.opened / sums.growing : 0;
    trial.motion = engine().motion();
    scale = std::max(scale, trial.sums.scale);
    motions.accept(increment, trial, last_opening);
    time += increment.dt;
    solved = false;
  }
};

QuasiStatic::QuasiStatic(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                         const QuasiStaticOptions& options)
    : parts_(std::make_unique<Parts>(specimen, network, laws, options)) {}
QuasiStatic::~QuasiStatic() = default;
QuasiStatic::QuasiStatic(QuasiStatic&&) noexcept = default;

void QuasiStatic::start(const StartState& state) { parts_->start(state); }
IncrementReport QuasiStatic::solve(const WallIncrement& increment) { return parts_->solve(increment); }
void QuasiStatic::accept() { parts_->accept(); }
void QuasiStatic::reject() {
  parts_->solved = false;
  parts_->show(parts_->wall, parts_->reaction);
}
const std::array<Vec3d, wall_count>& QuasiStatic::wall_force() const { return parts_->shown_force; }
const std::array<Vec3d, wall_count>& QuasiStatic::wall_displacement() const { return parts_->shown_wall; }
double QuasiStatic::growing_area() const { return parts_->engine().growing_part(); }
double QuasiStatic::last_opening() const { return parts_->last_opening; }
double QuasiStatic::drag() const { return parts_->drag; }
double QuasiStatic::time() const { return parts_->time; }
const QuasiStaticEnergies& QuasiStatic::energies() const { return parts_->energies; }
std::vector<laws::PointCrack> QuasiStatic::point_cracks() const { return parts_->engine().point_cracks(); }
std::vector<Break> QuasiStatic::point_breaks() const { return parts_->engine().point_breaks(); }
std::optional<experiments::CrackSurvey> QuasiStatic::survey_cracks() const { return parts_->engine().survey_cracks(); }
std::int64_t QuasiStatic::bytes() const { return parts_->engine().bytes(); }
std::string QuasiStatic::description() const { return "quasi-static, " + parts_->engine().description(); }

ParticleState QuasiStatic::particles() const {
  ParticleState out;
  const std::vector<double> u = parts_->engine().displacement();
  out.displacement.resize(parts_->particles), out.rotation.resize(parts_->particles);
  for_each_of(parts_->particles, [&](std::size_t i) {
    out.displacement[i] = {u[6 * i], u[6 * i + 1], u[6 * i + 2]};
    out.rotation[i] = {u[6 * i + 3], u[6 * i + 4], u[6 * i + 5]};
  });
  out.velocity.assign(parts_->particles, {});
  out.spin = out.velocity, out.force = out.velocity, out.moment = out.velocity;
  return out;
}

ContactState QuasiStatic::contacts() const {
  ContactState out;
  const auto& contacts = parts_->engine().contacts();
  const auto& network = parts_->network;
  const std::vector<double> u = parts_->engine().displacement();
  out.point_breaks = contacts.point_breaks();
  out.point_cracks = contacts.point_cracks();
  const std::size_t n = network.contacts.size();
  out.force.resize(n), out.moment.resize(n), out.relative.resize(n);
  out.broken.resize(out.point_breaks.empty() ? 0 : n);
  for_each_of(n, [&](std::size_t number) {
    const Contact& c = network.contacts[number];
    const Six f = contacts.accepted_force(number);
    // The force and moment on A about x0 are the negative of what moves B; model (7.1)
    const auto seen = [&](double n, double s, double t) { return n * c.n + s * c.s + t * c.t; };
    out.force[number] = seen(f[0], f[3], f[4]);
    out.moment[number] = seen(f[5], f[2], -f[1]);
    Six wall{};
    if (c.b < 0) {
      const Vec3d& x = parts_->wall[wall_index(c.b)];
      wall = {x.x, x.y, x.z, 0, 0, 0};
    }
    out.relative[number] = quasi_static::relative(c, &u[6 * static_cast<std::size_t>(c.a)],
                                                  c.b < 0 ? wall.data() : &u[6 * static_cast<std::size_t>(c.b)]);
    if (!out.point_breaks.empty()) {
      double broken = 0;
      for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) broken += out.point_breaks[j] != Break::none;
      const std::uint32_t points = c.point_end - c.point_begin;
      out.broken[number] = points > 0 ? broken / points : 0;
    }
  });
  out.chain = contacts.states();
  out.chain_begin = contacts.state_begin();
  return out;
}

std::vector<StateArray> QuasiStatic::state() const {
  if (parts_->drag > 0)
    throw RunError("state: found a specimen that moves against a drag, expected one in equilibrium");
  const Parts& p = *parts_;
  const MotionGuess::Past &last = p.motions.last(), &before = p.motions.before();
  std::vector<double> numbers{p.time,      p.scale,       p.last_opening, p.motions.continues_change() ? 1.0 : 0.0,
                              last.dt,     last.wall,     last.opening,   before.dt,
                              before.wall, before.opening};
  for (const auto* walls : {&p.wall, &p.reaction}) {
    for (const Vec3d& x : *walls) numbers.insert(numbers.end(), {x.x, x.y, x.z});
  }
  const QuasiStaticEnergies& e = p.energies;
  numbers.insert(numbers.end(),
                 {e.work_j, e.elastic_j, e.viscous_j, e.crack_j, e.friction_j, e.crack_work_j, e.thermal_j});
  numbers.insert(numbers.end(), {e.damping_j, p.newton.friction_matters() ? 1.0 : 0.0});
  quasi_static::EngineState own = p.newton.engine().state();
  return {{"quasi_static", "s, 1, m, 1, s, m, m, s, m, m, m, N, J, J, 1", std::move(numbers)},
          {"displacement", "m, 1", std::move(own.displacement)},
          {"motion", "m, 1", last.motion},
          {"motion_before", "m, 1", before.motion},
          {"contacts", "Pa m, m", std::move(own.states)},
          {"growing", "1", std::vector<std::int64_t>(own.grew.begin(), own.grew.end())}};
}

void QuasiStatic::set_state(const std::vector<StateArray>& arrays) {
  parts_->drag = 0;
  const std::vector<StateArray> own = state();
  const auto find = [&](const StateArray& want) -> const StateArray& {
    for (const StateArray& array : arrays) {
      if (array.name != want.name || array.values.index() != want.values.index()) continue;
      const auto size = [](const StateArray& a) {
        return std::visit([](const auto& v) { return v.size(); }, a.values);
      };
      if (size(array) == size(want)) return array;
    }
    throw RunError("state: found no array " + want.name + " of the right kind and length for method \"quasi_static\"");
  };
  std::vector<const StateArray*> found;
  for (const StateArray& want : own) found.push_back(&find(want));
  const auto doubles = [&](std::size_t k) { return std::get<std::vector<double>>(found[k]->values); };
  Parts& p = *parts_;
  const std::vector<double> numbers = doubles(0);
  p.time = numbers[0], p.scale = numbers[1], p.last_opening = numbers[2];
  const auto past = [&](std::size_t k, std::size_t array) {
    return MotionGuess::Past{numbers[k], numbers[k + 1], numbers[k + 2], doubles(array)};
  };
  p.motions.set(past(4, 2), past(7, 3), numbers[3] != 0);
  std::size_t at = 10;
  for (auto* walls : {&p.wall, &p.reaction}) {
    for (Vec3d& x : *walls) x = {numbers[at], numbers[at + 1], numbers[at + 2]}, at += 3;
  }
  QuasiStaticEnergies& e = p.energies;
  e.work_j = numbers[at], e.elastic_j = numbers[at + 1], e.viscous_j = numbers[at + 2];
  e.crack_j = numbers[at + 3], e.friction_j = numbers[at + 4], e.crack_work_j = numbers[at + 5],
  e.thermal_j = numbers[at + 6];
  e.damping_j = numbers[at + 7];
  p.newton.set_friction_matters(numbers[at + 8] != 0);
  const auto& grew = std::get<std::vector<std::int64_t>>(found[5]->values);
  p.engine().set_state({doubles(1), doubles(4), {grew.begin(), grew.end()}});
  p.solved = false;
  p.show(p.wall, p.reaction);
}

}  // namespace macadam
