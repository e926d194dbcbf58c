// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper_impl.hpp  Implements the stepper for any executor (executor.hpp): sets its groups and bodies
/// for a start, lets step_queue.hpp enqueue the steps, and returns results, which read_contacts.hpp, specimen_order.hpp
/// and wall_observation.hpp convert. stepper_cpu_*.cpp and stepper_cuda_*.cu compile this file.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "kernels/base/checksum.hpp"
#include "kernels/contact/precision.hpp"
#include "kernels/layout/layout.hpp"
#include "kernels/step/body_inputs.hpp"
#include "kernels/step/executor.hpp"
#include "kernels/step/read_contacts.hpp"
#include "kernels/step/restart_rules.hpp"
#include "kernels/step/specimen_order.hpp"
#include "kernels/step/step_functor.hpp"
#include "kernels/step/step_queue.hpp"
#include "kernels/step/stepper_input.hpp"
#include "kernels/step/wall_observation.hpp"
#include "macadam/error.hpp"

namespace macadam::kernels {

/// The stepper of one executor. Its public functions are documented in macadam/stepper.hpp.
template <Executor Exec>
class StepperImpl final : public Stepper {
 public:
  using P = typename Exec::Policy;
  using R = typename P::Particle;
  using Laws = std::array<std::optional<typename Exec::AnyLaw>, pair_types>;

  StepperImpl(typename Exec::Plan plan, const Specimen& specimen, const ContactNetwork& network, const Laws& laws,
              const Inertia& inertia, const StepperOptions& options)
      : options_(decided(options, network, facts_of(laws))),
        radius_(specimen.radius),
        size_(specimen.box.size),
        plan_(std::move(plan)),
        exec_(network, plan_, options_) {
    begin(network, laws, inertia, true);
  }
  StepperImpl(const StepperImpl&) = delete;
  ~StepperImpl() override { exec_.use_device(); }

  /// Starts again with other options, for the network for which the stepper was made. Returns false and changes nothing
  /// if the arrays of the stepper do not suit these options, or if the laws are of other kinds.
  bool begin_again(const ContactNetwork& network, const Laws& laws, const Inertia& inertia,
                   const StepperOptions& options) {
    const FactsTable facts = facts_of(laws);
    const StepperOptions next = decided(options, network, facts);
    if (!keep_alike(next, options_) || network.contacts.size() != contacts_ || !keep_alike(facts, facts_of(laws_)) ||
        !exec_.can_restart_with({next, facts, size_, false, 0}))
      return false;
    options_ = next;
    begin(network, laws, inertia, false);
    return true;
  }

  void advance(std::int64_t steps) override {
    exec_.use_device();
    if (options_.ranks) options_.ranks->require_same("the number of time steps to take", steps);
    queue_.advance(steps);
  }

  std::vector<Sample> advance_sampled(std::int64_t every, std::int64_t times) override {
    exec_.use_device();
    const auto samples = static_cast<std::int64_t>(exec_.max_samples(radius_));
    if (samples == 0) return Stepper::advance_sampled(every, 1);
    std::vector<Sample> out;
    queue_.advance_sampled(every, std::clamp<std::int64_t>(times, 1, samples), [&](std::int64_t step, const auto& s) {
      out.push_back({observation(step, s.force, s.displacement, s.velocity), s.divergent});
    });
    return out;
  }

  Observation observe() const override {
    exec_.use_device();
    const auto forces = exec_.forces(static_cast<std::int32_t>(layout_.particles()), walls);
    if (!motion_.wall.by_force) return observation(queue_.step(), forces, {}, {});
    return observation(queue_.step(), forces, exec_.wall_displacements(), exec_.wall_velocities());
  }

  ParticleState particles() const override {
    exec_.use_device();
    exec_.gather();
    const std::vector<R> v = exec_.velocities();
    const std::vector<double> u = exec_.displacements();
    const std::vector<Vec3d>* weight = exec_.forces_with_weight() ? nullptr : &options_.boundary.body_force;
    return particle_state(layout_, v, u, exec_.forces(0, layout_.particles()), weight);
  }

  std::vector<MotionOfParticle> motions(const std::vector<std::int32_t>& of) const override {
    exec_.use_device();
    exec_.gather();
    return motions_of_particles(layout_, exec_.displacements(), of);
  }

  ContactState contacts(const ContactNetwork& network) const override {
    ContactState out;
    read_contacts(network, out);
    return out;
  }

  void read_contacts(const ContactNetwork& network, ContactState& out) const override {
    exec_.use_device();
    exec_.gather();
    if (network.contacts.size() != contacts_) {
      throw InputError("contacts of a stepper: found a network of " + std::to_string(network.contacts.size()) +
                       " contacts, expected the network of " + std::to_string(contacts_) +
                       " contacts that the stepper was made from");
    }
    kernels::read_contacts(exec_, network, layout_, laws_, options_, out);
  }

  DeviceMotion device_motion() const override {
    exec_.use_device();
    exec_.gather();
    return exec_.device_motion();
  }

  void set_velocities(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin) override {
    exec_.use_device();
    if (options_.skip_rotations && largest(spin) > 0) {
      throw InputError(
          "angular velocities were given, but the stepper leaves out rotations: set skip_rotations to false");
    }
    exec_.gather();
    std::vector<R> v = exec_.velocities();
    put_velocities(layout_, velocity, spin, options_.boundary.fixed, v);
    exec_.set_velocities(v);
  }

  std::vector<StateArray> state() const override {
    exec_.use_device();
    exec_.gather();
    std::vector<StateArray> out{{"step", "1", std::vector{queue_.step()}}};
    for (StateArray& array : exec_.states().copy()) out.push_back(std::move(array));
    return out;
  }

  void set_state(const std::vector<StateArray>& arrays) override {
    exec_.use_device();
    const std::vector<std::int64_t>* step = nullptr;
    for (const StateArray& array : arrays) {
      if (array.name == "step") step = std::get_if<std::vector<std::int64_t>>(&array.values);
    }
    if (!step || step->size() != 1) throw RunError("state: found no step number, expected one");
    exec_.states().replace(arrays);
    queue_.set_step(step->front());
  }

  std::int64_t first_divergent() const override {
    exec_.use_device();
    return exec_.first_divergent(radius_, options_.dt);
  }

  std::string description() const override {
    return exec_.description() + ", " + to_string(P::value) + ", " + to_string(options_.form) + ", geometry " +
           to_string(options_.geometry);
  }
  std::vector<KernelUse> kernels() const override {
    exec_.use_device();
    return exec_.kernels();
  }
  std::int64_t bytes() const override { return exec_.bytes(); }
  std::int64_t traffic() const override { return exec_.traffic(); }
  Traffic traffic_by_place() const override { return exec_.traffic_by_place(); }

  std::vector<PartTime> advance_timed(std::int64_t steps) override {
    exec_.use_device();
    exec_.start_clock();
    advance(steps);
    std::vector<PartTime> out = exec_.stop_clock();
    for (PartTime& part : out) part.seconds /= static_cast<double>(std::max<std::int64_t>(steps, 1));
    return out;
  }

 private:
  /// Returns the given options, with `skip_rotations` cleared if any body can rotate, now or after the stepper is
  /// started again from another state.
  static StepperOptions decided(StepperOptions options, const ContactNetwork& network, const FactsTable& laws) {
    options.skip_rotations = options.skip_rotations && nothing_turns(network, laws);
    return options;
  }
  static double largest(const std::vector<Vec3d>& list) {
    double out = 0;
    for (const Vec3d& v : list) out = std::max(out, dot(v, v));
    return out;
  }

  /// Applies the options. The first time, makes the groups of contacts, which are kept; later only sets their states.
  void begin(const ContactNetwork& network, const Laws& laws, const Inertia& inertia, bool first) {
    exec_.use_device();
    const StepperOptions& options = options_;
    queue_.set_step(0);
    laws_ = laws;
    contacts_ = network.contacts.size();
    const FactsTable facts = facts_of(laws);
    std::size_t bytes = 0;
    for (const auto& group : layout_.groups) {
      if (first) bytes += GroupShape<P>(layout_, group, fact_of(facts, group.pair), options).bytes();
    }
    exec_.begin({options, facts, size_, first, bytes});
    std::vector<R> inverse = inverse_masses<R>(layout_, inertia, options);
    if (options.ranks) {
      Checksum all;
      all.add(inverse), all.add(std::vector{options.dt});
      if (const StartState* s = options.start)
        all.add(s->displacement), all.add(s->rotation), all.add(s->velocity), all.add(s->spin), all.add(s->chain);
      options.ranks->require_same(
          "checksum of time step, masses and start state (equal only if all hosts are of the same kind)", all.value());
    }
    const WallMotion<R> wall = queue_.set_walls(options.boundary);
    const double beta = options.damping_kind == Damping::viscous ? options.damping : 0;
    motion_ = {exec_.set_bodies(std::move(inverse), body_forces<R>(layout_, options.boundary)),
               options.damping_kind,
               static_cast<R>(options.damping_kind == Damping::local ? options.damping : 0),
               static_cast<R>((1 - beta * options.dt / 2) / (1 + beta * options.dt / 2)),
               static_cast<R>(1 / (1 + beta * options.dt / 2)),
               options.dt,
               wall};
    for (std::size_t g = 0; g < layout_.groups.size(); ++g) set_group(network, g, laws, facts, first);
    exec_.prepare(motion_);
    started_ = options.start != nullptr;
    if (started_) start_from(*options.start);
    options_.start = nullptr;
  }

  /// Takes the step from −1 to 0. The forces at step −1 are not needed, because the given velocities already belong to
  /// the middle of this step.
  void start_from(const StartState& start) {
    std::vector<Vec3d> velocity = start.velocity, spin = start.spin;
    for (auto* list : {&velocity, &spin}) {
      for (Vec3d& v : *list)
        v = (1 / static_cast<double>(motion_.damping_factor)) * v;  // because the step multiplies by this factor
    }
    // If rotations are skipped, the spins of the steady state are only rounding errors
    if (options_.skip_rotations) spin.assign(spin.size(), {});
    set_velocities(velocity, spin);
    std::vector<double> u = exec_.displacements();
    put_start(layout_, start, options_.boundary, u);
    exec_.set_displacements(u);
    queue_.set_step(-1);
    advance(1);
  }

  /// \throws InputError if a law is not linear and the contact form requires a linear law.
  const LawFacts& fact_of(const FactsTable& facts, PairType pair) const {
    const LawFacts& law = facts[static_cast<std::size_t>(pair)].value();
    if (law.linear || options_.form == ContactForm::points) return law;
    throw InputError(std::string("contact form of pair ") + to_string(pair) + ": found \"condensed\" with law " +
                     law.name + ", which is not linear, expected \"points\"");
  }

  void set_group(const ContactNetwork& network, std::size_t number, const Laws& laws, const FactsTable& facts,
                 bool first) {
    const GroupLayout& group = layout_.groups[number];
    const LawFacts& fact = fact_of(facts, group.pair);
    ContactArrays<P> arrays;
    if (first) arrays = fill_contacts<P>(network, layout_, group, fact, options_);
    fill_states<P>(network, layout_, group, fact, options_, arrays);
    with_functor<Exec>(
        laws[static_cast<std::size_t>(group.pair)].value(), options_,
        [&](const auto& law, const auto& functor) { exec_.set_group(number, first, law, std::move(arrays), functor); });
  }

  /// `moved`, `speed`: displacements and velocities of the walls, read only if walls are driven by forces.
  Observation observation(std::int64_t step, const std::vector<Twist<R>>& forces, const std::vector<double>& moved,
                          const std::vector<R>& speed) const {
    return observe_walls(options_, step, forces, moved, speed, started_);
  }

  StepperOptions options_;
  std::vector<double> radius_;
  Vec3d size_;  // of the specimen [m]
  std::size_t contacts_ = 0;
  Laws laws_;
  typename Exec::Plan plan_;
  const Layout& layout_ = plan_.layout;
  Exec exec_;
  StepQueue<Exec> queue_{exec_};
  ParticleMotion<P> motion_{};
  bool started_ = false;  // whether the run started in motion, at step −1
};

/// Starts the used stepper again and returns it if that is possible; otherwise makes a new one. If the specimen does
/// not fit the devices, returns null and does not change `used`.
template <Executor Exec>
std::unique_ptr<Stepper> make_stepper_on(const Specimen& specimen, const ContactNetwork& network,
                                         const std::array<std::optional<typename Exec::AnyLaw>, pair_types>& laws,
                                         const Inertia& inertia, const StepperOptions& options,
                                         std::unique_ptr<Stepper>& used) {
  require_input(specimen.size(), network, facts_of(laws), options);
  auto* again = dynamic_cast<StepperImpl<Exec>*>(used.get());
  if (again && again->begin_again(network, laws, inertia, options)) return std::move(used);
  auto plan = Exec::plan(specimen, network, options);
  if (!plan) return nullptr;
  used.reset();  // frees the memory of the used stepper before the new one is made
  return std::make_unique<StepperImpl<Exec>>(*std::move(plan), specimen, network, laws, inertia, options);
}

}  // namespace macadam::kernels
