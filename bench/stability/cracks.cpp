// SPDX-License-Identifier: GPL-3.0-or-later
// cracks.cpp  Steps specimens whose contacts crack under conditions in which an unstable scheme would gain energy:
// faces that chatter, walls that reverse, fracture energies just above the smallest allowed one, and large ratios of
// stiffness.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/stability/stability.hpp"
#include "host/run/energy_ledger.hpp"

namespace macadam::stability {
namespace {

constexpr double alpha = 0.3;

/// Returns an elastic law that cracks at a strain of 1e-4. Its fracture energy is `times` the smallest one that is
/// allowed for contacts of length `d`.
laws::Cracked<laws::Elastic> cracked(double modulus, double d, double times) {
  laws::Crack crack{1e-4 * modulus, 1, 1.5e-4 * modulus, 1, 0.5, 0.5};
  const double least = crack.least_fracture_energy(modulus, alpha, d);
  crack.fracture_energy = crack.shear_fracture_energy = times * least;
  return {laws::Elastic{modulus, alpha}, crack};
}

double longest(const ContactNetwork& network) {
  double out = 0;
  for (const Contact& c : network.contacts) out = std::max(out, c.length);
  return out;
}

/// Returns the settings whose states have double precision, which laws with cracks require.
std::vector<Setting> settings_of_cracks(Effort effort) {
  std::vector<Setting> out;
  for (const Setting& setting : settings()) {
    const bool is_left_out = effort == Effort::test && setting.precision == Precision::mixed;
    if (setting.precision != Precision::single && !is_left_out) out.push_back(setting);
  }
  return out;
}

StepperOptions by_points(double dt) {
  StepperOptions out;
  out.dt = dt;
  out.form = ContactForm::points;
  out.geometry = Geometry::fixed;
  return out;
}

Vec3d momentum(const test::TestScene& scene, const ParticleState& state, double& size) {
  Vec3d out{};
  size = 0;
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    out += scene.inertia.mass[i] * state.velocity[i];
    size += scene.inertia.mass[i] * norm(state.velocity[i]);
  }
  return out;
}

/// Kicks a free assembly so that contacts crack, close and slide at random. Damage and friction only take energy, so
/// the energy must not grow. Forces come in opposite pairs, so the momentum must not change. `ratio`: modulus of the
/// contacts between aggregates, divided by the modulus of the contacts between mastic particles.
void chatter_rows(Rows& rows, const Setting& setting, double ratio, std::int64_t steps) {
  NetworkSpec spec;
  spec.bottom_top_walls = false;
  auto scene = test::make_scene(test::random_specimen(12, 3, 3, 3), spec, test::same_law(laws::Elastic{1e10, alpha}));
  const double d = longest(scene.network), soft = 1e10 / std::sqrt(ratio), stiff = 1e10 * std::sqrt(ratio);
  for (std::size_t pair = 0; pair < pair_types; ++pair) {
    const auto type = static_cast<PairType>(pair);
    const double modulus = type == PairType::mm ? soft : type == PairType::ma ? 1e10 : stiff;
    if (type == PairType::aw || type == PairType::mw)
      scene.laws[pair] = laws::Elastic{modulus, alpha};
    else
      scene.laws[pair] = cracked(modulus, d, 2);
  }
  StepperOptions options = by_points(0);
  options.dt = 0.8 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  const auto stepper = make(setting, scene, options);
  // Velocities of 1e-3 times the speed of waves in the softest contacts give strains of some 1e-3
  shake(*stepper, scene, 1e-3 * std::sqrt(soft / 2000));
  EnergyLedger ledger(scene.network, scene.laws, scene.inertia, 1, options.dt, false);
  double size = 0;
  const Vec3d before = momentum(scene, stepper->particles(), size);
  const auto energy = [&] {
    ContactState contacts = stepper->contacts(scene.network);
    const auto now = ledger.sample(stepper->observe(), contacts, stepper->particles(), {});
    return now.elastic_j + now.kinetic_j;
  };
  const double start = energy();
  stepper->advance(steps);
  double unused = 0;
  const double drift = norm(momentum(scene, stepper->particles(), unused) - before) / size;
  std::int64_t cracked_points = 0;
  for (const laws::PointCrack& crack : stepper->point_cracks(scene.network)) cracked_points += crack.damage > 0;
  const std::string name = fmt::format("27 free particles, moduli in the ratio 1:{:g}", ratio);
  rows.push_back({name, setting.name(), "points that have cracked", 1, 1e9, "otherwise nothing is tested",
                  static_cast<double>(cracked_points)});
  rows.push_back({name, setting.name(), "energy of springs and motion, end / start", 0, 1,
                  "cracks and friction only take energy", energy() / start});
  rows.push_back({name, setting.name(), "drift of the momentum / sum of the momenta of the particles", 0,
                  10 * setting.rounding() * std::sqrt(static_cast<double>(steps)),
                  "forces are in pairs; rounding adds up like a random walk", drift});
}

/// A bar of four cubes along z, pulled by the top wall. The middle contact has another pair type and 98 % of the
/// strength of the others.
struct Bar {
  test::HandMade made = test::cubic_lattice_network(1, 1, 4, 2e-3, 1e-5);
  test::TestScene scene;
  std::size_t weak = 0;
  StepperOptions options = by_points(0);
  double facet_energy = 0;  ///< G_f·A of the middle contact [J]

  explicit Bar(double times) {
    std::vector<Contact>& contacts = made.network.contacts;
    for (weak = contacts.size() / 2; contacts[weak].b < 0;) weak = (weak + 1) % contacts.size();
    contacts[weak].pair = PairType::ma;
    --made.network.count[static_cast<std::size_t>(PairType::mm)];
    ++made.network.count[static_cast<std::size_t>(PairType::ma)];
    auto strong = cracked(1e10, 2e-3, times), weaker = strong;
    strong.crack.fracture_energy *= 1.1, strong.crack.shear_fracture_energy *= 1.1;
    weaker.crack.tensile_strength *= 0.98, weaker.crack.shear_strength *= 0.98;
    scene = {made.specimen, made.network, test::same_law(laws::Elastic{1e10, 0}), made.inertia};
    scene.laws[static_cast<std::size_t>(PairType::mm)] = strong;
    scene.laws[static_cast<std::size_t>(PairType::ma)] = weaker;
    facet_energy = weaker.crack.fracture_energy * contacts[weak].area;
    options.damping_kind = Damping::local;
    options.damping = 0.3;  // otherwise the waves of the separation crack other contacts
    options.dt = 0.5 * critical_step(scene.network, scene.laws, scene.inertia, options).dt;
  }
  /// Returns the energy of the cracks of the middle contact or of all others.
  double energy(const Stepper& stepper, bool of_weak) const {
    const auto cracks = stepper.point_cracks(scene.network);
    const Contact& c = scene.network.contacts[weak];
    double out = 0;
    for (std::size_t j = 0; j < cracks.size(); ++j) {
      if ((j >= c.point_begin && j < c.point_end) == of_weak) out += cracks[j].energy * scene.network.point_area[j];
    }
    return out;
  }
  double separation() const {
    return std::get<laws::Cracked<laws::Elastic>>(*scene.laws[static_cast<std::size_t>(PairType::ma)])
        .crack.separation();
  }
};

/// Pulls the bar apart with a fracture energy just above the least one, at which the middle contact loses its stress
/// within few steps.
void energy_rows(Rows& rows, const Setting& setting, double times, std::int64_t steps) {
  Bar bar(times);
  const double end = static_cast<double>(steps) * bar.options.dt, reached = 4 * (bar.separation() + 4 * 2e-3 * 1e-4);
  bar.options.boundary.move(
      wall_z_hi, 2, std::make_shared<drives::Table>(bar.options.dt, std::vector{0.0, end}, std::vector{0.0, reached}));
  const auto stepper = make(setting, bar.scene, bar.options);
  stepper->advance(steps);
  const std::string name = fmt::format("bar of four cubes, {:g} times the least fracture energy", times);
  rows.push_back({name, setting.name(), "energy of the middle contact / (G_f·A) − 1", -1e-8, 1e-8,
                  "a separated crack has taken its fracture energy",
                  bar.energy(*stepper, true) / bar.facet_energy - 1});
}

/// Opens and closes the crack of the middle contact many times to the same displacement.
void reversal_rows(Rows& rows, const Setting& setting, int cycles, std::int64_t per_cycle) {
  Bar bar(20);
  drives::Cyclic loading;
  loading.amplitude = 0.3 * bar.separation();
  loading.steps_per_period = loading.ramp_steps = per_cycle;
  loading.frequency = 1 / (bar.options.dt * static_cast<double>(per_cycle));
  bar.options.boundary.move(wall_z_hi, 2, std::make_shared<drives::Cyclic>(loading));
  const auto stepper = make(setting, bar.scene, bar.options);
  stepper->advance(2 * per_cycle);
  const double first = bar.energy(*stepper, true);
  stepper->advance((cycles - 2) * per_cycle);
  const double last = bar.energy(*stepper, true);
  const std::string name = fmt::format("bar of four cubes, {} cycles of opening and closing", cycles);
  rows.push_back({name, setting.name(), "energy of the middle contact after two cycles / (G_f·A)", 1e-3, 1,
                  "the crack has opened but is not separated", first / bar.facet_energy});
  rows.push_back({name, setting.name(), "energy of the middle contact, after all cycles / after two cycles − 1", -1e-6,
                  1e-2,
                  "damage never falls, and grows only beyond the largest opening, to which vibrations add little; the "
                  "stored part follows the opening at the sample",
                  last / first - 1});
}

}  // namespace

Rows cracks(Effort effort) {
  Rows rows;
  for (const Setting& setting : settings_of_cracks(effort)) {
    const auto steps = by_effort<std::int64_t>(effort, 5000, 50'000, 10'000'000);
    const std::vector<double> ratios = effort == Effort::test ? std::vector{1.0, 1e6} : std::vector{1.0, 1e2, 1e4, 1e6};
    for (const double ratio : ratios) chatter_rows(rows, setting, ratio, steps);
    for (const double times : {1.001, 1.1, 2.0})
      energy_rows(rows, setting, times, by_effort<std::int64_t>(effort, 20'000, 100'000, 1'000'000));
    reversal_rows(rows, setting, by_effort(effort, 10, 100, 1000), by_effort<std::int64_t>(effort, 2000, 5000, 10'000));
  }
  return rows;
}

}  // namespace macadam::stability
