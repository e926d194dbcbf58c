// SPDX-License-Identifier: GPL-3.0-or-later
/// \file stepper_impl.hpp  Implements the stepper for any executor (executor.hpp): prepares inputs, passes steps on to
/// the executor, and converts the executor's arrays to the order of the specimen. stepper_cpu_*.cpp and
/// stepper_cuda_*.cu compile it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "kernels/base/checksum.hpp"
#include "kernels/base/parallel.hpp"
#include "kernels/contact/contact_readout.hpp"
#include "kernels/step/body_inputs.hpp"
#include "kernels/step/executor.hpp"
#include "kernels/contact/law_functors.hpp"
#include "kernels/layout/layout.hpp"
#include "kernels/step/particle_motion.hpp"
#include "kernels/contact/precision.hpp"
#include "kernels/step/stepper_input.hpp"
#include "kernels/step/wall_motion.hpp"
#include "macadam/error.hpp"

namespace macadam::kernels {

/// Calls f(std::integral_constant) with the value of an enum that has two values.
template <auto First, auto Second, class F>
void dispatch(decltype(First) value, F&& f) {
  if (value == First)
    f(std::integral_constant<decltype(First), First>{});
  else
    f(std::integral_constant<decltype(First), Second>{});
}

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
    const auto kept = [](const StepperOptions& o) {
      return std::tie(o.form, o.geometry, o.skip_shear, o.skip_rotations, o.threads, o.devices, o.multiprocessors,
                      o.ranks);
    };
    if (kept(next) != kept(options_) || network.contacts.size() != contacts_ || !keep_alike(facts, facts_of(laws_)) ||
        !exec_.can_restart_with({next, facts, size_, false, 0}))
      return false;
    options_ = next;
    begin(network, laws, inertia, false);
    return true;
  }

  void advance(std::int64_t steps) override {
    exec_.use_device();
    if (options_.ranks) options_.ranks->require_same("the number of time steps to take", steps);
    try {
      StepsToTake all{step_, step_ + steps};
      queue_until(all.end, all);
      exec_.wait();
    } catch (...) {  // thrown by a drive or by the device
      exec_.end_steps();
      throw;
    }
  }

  std::vector<Sample> advance_sampled(std::int64_t every, std::int64_t times) override {
    exec_.use_device();
    const auto samples = static_cast<std::int64_t>(exec_.max_samples(radius_));
    if (samples == 0) return Stepper::advance_sampled(every, 1);
    return advance_with_samples(every, std::clamp<std::int64_t>(times, 1, samples));
  }

  Observation observe() const override {
    exec_.use_device();
    const auto forces = exec_.forces(static_cast<std::int32_t>(layout_.particles()), walls);
    if (!motion_.wall.by_force) return observation(step_, forces, {}, {});
    return observation(step_, forces, exec_.wall_displacements(), exec_.wall_velocities());
  }

  ParticleState particles() const override {
    exec_.use_device();
    exec_.gather();
    const std::size_t n = layout_.particles();
    ParticleState out;
    for (auto* list : {&out.displacement, &out.rotation, &out.velocity, &out.spin, &out.force, &out.moment})
      list->resize(n);
    const bool weigh = !exec_.forces_with_weight() && !options_.boundary.body_force.empty();
    const auto v = exec_.velocities();
    const auto u = exec_.displacements();
    const auto forces = exec_.forces(0, n);
    for_each_of(n, [&](std::size_t b) {
      const auto i = static_cast<std::size_t>(layout_.particle[b]);
      const R* vb = &v[b * velocity_words];
      const double* ub = &u[b * displacement_words];
      const auto& f = forces[b];
      out.displacement[i] = {ub[0], ub[1], ub[2]};
      out.rotation[i] = {ub[4], ub[5], ub[6]};
      out.velocity[i] = {vb[0], vb[1], vb[2]};
      out.spin[i] = {vb[4], vb[5], vb[6]};
      out.force[i] = {f.linear.x, f.linear.y, f.linear.z};
      if (weigh) out.force[i] += options_.boundary.body_force[i];
      out.moment[i] = {f.angular.x, f.angular.y, f.angular.z};
    });
    return out;
  }

  std::vector<MotionOfParticle> motions(const std::vector<std::int32_t>& of) const override {
    exec_.use_device();
    exec_.gather();
    const std::vector<double> u = exec_.displacements();
    std::vector<MotionOfParticle> out;
    out.reserve(of.size());
    for (const std::int32_t particle : of) {
      const double* ub = &u[static_cast<std::size_t>(layout_.body_of(particle)) * displacement_words];
      out.push_back({ub[0], ub[1], ub[2], ub[4], ub[5], ub[6]});
    }
    return out;
  }

  ContactState contacts(const ContactNetwork& network) const override {
    ContactState out;
    read_contacts(network, out);
    return out;
  }

  void read_contacts(const ContactNetwork& network, ContactState& out) const override {
    exec_.use_device();
    exec_.gather();
    const std::vector<double> u = exec_.displacements();
    const std::size_t n = network.contacts.size();
    if (n != contacts_) {
      throw InputError("contacts of a stepper: found a network of " + std::to_string(n) +
                       " contacts, expected the network of " + std::to_string(contacts_) +
                       " contacts that the stepper was made from");
    }
    const std::size_t points = network.point_area.size();
    const bool breaks = can_break(facts_of(laws_)), cracks = can_crack(facts_of(laws_));
    out.force.resize(n), out.moment.resize(n), out.relative.resize(n);
    out.broken.resize(breaks ? n : 0), out.point_breaks.resize(breaks ? points : 0);
    out.point_cracks.resize(cracks ? points : 0);
    const auto each_group = [&](auto&& f) {
      for (std::size_t g = 0; g < layout_.groups.size(); ++g) {
        const GroupLayout& group = layout_.groups[g];
        std::visit([&](const auto& law) { f(g, group, law); }, laws_[static_cast<std::size_t>(group.pair)].value());
      }
    };
    out.chain_begin.resize(n + 1);
    out.chain_begin[0] = 0;
    each_group([&](std::size_t, const GroupLayout& group, const auto& law) {
      const GroupReading<P, std::decay_t<decltype(law)>> read(network, layout_, group, law, options_, u, {});
      for_each_of(group.contact.size(), [&](std::size_t slot) {
        const std::uint32_t c = group.contact[slot];
        if (c != inert) out.chain_begin[c + 1] = read.numbers(network.contacts[c]);
      });
    });
    std::partial_sum(out.chain_begin.begin(), out.chain_begin.end(), out.chain_begin.begin());
    out.chain.resize(out.chain_begin.back());
    each_group([&](std::size_t g, const GroupLayout& group, const auto& law) {
      const GroupShape<P> shape(layout_, group, facts_of(law), options_);
      GroupReading<P, std::decay_t<decltype(law)>>(network, layout_, group, law, options_, u,
                                                   exec_.group_state(g, shape.chain(), shape.frame()))
          .read(out);
    });
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
    for (std::size_t b = 0; b < layout_.particles(); ++b) {
      const auto i = static_cast<std::size_t>(layout_.particle[b]);
      const double words[velocity_words] = {velocity[i].x, velocity[i].y, velocity[i].z, 0,
                                            spin[i].x,     spin[i].y,     spin[i].z,     0};
      for (int w = 0; w < velocity_words; ++w)
        v[b * velocity_words + static_cast<std::size_t>(w)] = static_cast<R>(words[w]);
    }
    for (const std::int32_t i : options_.boundary.fixed) {
      const auto first = v.begin() + static_cast<std::ptrdiff_t>(layout_.body_of(i)) * velocity_words;
      std::fill(first, first + velocity_words, R(0));
    }
    exec_.set_velocities(v);
  }

  std::vector<StateArray> state() const override {
    exec_.use_device();
    exec_.gather();
    std::vector<StateArray> out{{"step", "1", std::vector{step_}}};
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
    step_ = step->front();
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
  /// Returns whether two tables of laws have states of the same kinds and sizes, and act on the same components with
  /// the same factor α of the shear stiffness.
  static bool keep_alike(const FactsTable& a, const FactsTable& b) {
    const auto kind = [](const LawFacts& f) {
      return std::tuple(std::string_view(f.name), f.alpha, f.units, f.only_units, f.memoryless, f.linear, f.blocks,
                        f.coupled);
    };
    return std::ranges::equal(a, b, [&](const auto& x, const auto& y) {
      return x && y ? kind(*x) == kind(*y) : x.has_value() == y.has_value();
    });
  }
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
    step_ = 0;
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
    wall_table_ = WallTable<R>(options.boundary);
    WallMotion<R> wall = wall_table_.motion();
    wall.table = exec_.wall_table(wall_table_.most_values());
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
    for (std::size_t b = 0; b < layout_.particles(); ++b) {
      const auto i = static_cast<std::size_t>(layout_.particle[b]);
      const Vec3d &at = start.displacement[i], &turn = start.rotation[i];
      const double words[displacement_words] = {at.x, at.y, at.z, 0, turn.x, turn.y, turn.z, 0};
      std::copy(words, words + displacement_words, &u[b * displacement_words]);
    }
    for (std::size_t w = 0; w < wall_count; ++w) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const WallAxis& a = options_.boundary.wall[w].axis[axis];
        if (a.by == DrivenBy::displacement)
          u[(layout_.particles() + w) * displacement_words + axis] = a.drive->value(-1);
      }
    }
    exec_.set_displacements(u);
    step_ = -1;
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
    with_functor(laws[static_cast<std::size_t>(group.pair)].value(), [&](const auto& law, const auto& functor) {
      exec_.set_group(number, first, law, std::move(arrays), functor);
    });
  }

  /// Counts the steps that are enqueued in several parts, and the rows of the walls' table that are filled in for these
  /// steps.
  struct StepsToTake {
    std::int64_t begin, end, row = 0, rows = 0;
  };
  /// Enqueues steps up to number `to`, which is the end or, if samples are taken, any step before it.
  void queue_until(std::int64_t to, StepsToTake& all) {
    while (step_ < to) {
      if (all.row == all.rows) {
        all.rows = wall_table_.rows(step_ - all.begin, all.end - step_), all.row = 0;
        exec_.set_wall_rows(wall_table_.fill(step_, all.rows));
      }
      const std::int64_t n = std::min(to - step_, all.rows - all.row);
      exec_.run(step_, n, all.row);
      step_ += n, all.row += n;
    }
  }

  /// Does the same as advance_sampled(), for an executor that takes samples while it runs.
  std::vector<Sample> advance_with_samples(std::int64_t every, std::int64_t times) {
    StepsToTake all{step_, step_ + every * times};
    std::vector<Sample> out;
    try {
      for (std::int64_t k = 0; k < times; ++k) {
        queue_until(step_ + every, all);
        exec_.take_sample(static_cast<std::size_t>(k));
      }
      std::int64_t step = all.begin;
      for (const auto& sample : exec_.wait_for_samples(static_cast<std::size_t>(times))) {
        out.push_back(
            {observation(step += every, sample.force, sample.displacement, sample.velocity), sample.divergent});
      }
    } catch (...) {
      exec_.end_steps();
      throw;
    }
    return out;
  }

  /// `moved`, `speed`: displacements and velocities of the walls, read only if walls are driven by forces.
  Observation observation(std::int64_t step, const std::vector<Twist<R>>& forces, const std::vector<double>& moved,
                          const std::vector<R>& speed) const {
    Observation out;
    out.step = step;
    out.time = static_cast<double>(step) * options_.dt;
    for (std::size_t w = 0; w < walls; ++w) {
      const auto& f = forces[w].linear;
      out.wall_force[w] = {f.x, f.y, f.z};
      double* u[3] = {&out.wall_displacement[w].x, &out.wall_displacement[w].y, &out.wall_displacement[w].z};
      double* v[3] = {&out.wall_velocity[w].x, &out.wall_velocity[w].y, &out.wall_velocity[w].z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const WallAxis& a = options_.boundary.wall[w].axis[axis];
        if (a.by == DrivenBy::displacement) {
          *u[axis] = a.drive->value(step);
          if (step > 0 || started_) *v[axis] = a.drive->rate(step - 1);
        } else if (a.by == DrivenBy::force) {
          *u[axis] = moved[w * displacement_words + axis];
          *v[axis] = static_cast<double>(speed[w * velocity_words + axis]);
        }
      }
    }
    return out;
  }

  /// Calls f(law, functor) with the functor that steps the law's contacts; its view is not set.
  template <class F>
  void with_functor(const typename Exec::AnyLaw& any, F&& f) const {
    using State = typename P::State;
    std::visit(
        [&](const auto& law) {
          using L = std::decay_t<decltype(law)>;
          [[maybe_unused]] const auto with = [&](auto units, auto form) {
            dispatch<Geometry::updated, Geometry::fixed>(options_.geometry, [&](auto geometry) {
              const auto step = law.template step<State>(options_.dt);
              f(law, ContactForces<P, std::decay_t<decltype(step)>, units(), form(), geometry()>{
                         {}, step, static_cast<State>(options_.dt)});
            });
          };
          dispatch_units<Exec::five_units_in_registers>(law, [&]([[maybe_unused]] auto units) {
            if constexpr (!suits_precision<P, L>) {
              throw InputError(std::string("precision: found single beside law ") + L::name +
                               ", whose states need double precision; expected mixed or double");
            } else if constexpr (linear_law<L>) {
              dispatch<ContactForm::condensed, ContactForm::points>(options_.form,
                                                                    [&](auto form) { with(units, form); });
            } else {
              with(units, std::integral_constant<ContactForm, ContactForm::points>{});
            }
          });
        },
        any);
  }

  StepperOptions options_;
  std::vector<double> radius_;
  Vec3d size_;  // of the specimen [m]
  std::size_t contacts_ = 0;
  Laws laws_;
  typename Exec::Plan plan_;
  const Layout& layout_ = plan_.layout;
  Exec exec_;
  ParticleMotion<P> motion_{};
  WallTable<R> wall_table_;
  std::int64_t step_ = 0;
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
