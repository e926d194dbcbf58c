// SPDX-License-Identifier: GPL-3.0-or-later
/// \file reference_stepper.cpp  Implements the leapfrog time step contact point by contact point (docs/model.md,
/// sections 1, 5, 6 and 8 to 10). The functions below are in the order of the operations in a step.
#include "host/reference/reference_stepper.hpp"

#include <Eigen/Geometry>

#include "host/reference/reference_contact.hpp"
#include "host/reference/reference_input.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace reference {
namespace {

/// A particle: a rigid sphere in motion.
struct Body {
  Vector3d start = Vector3d::Zero();         ///< centre at the start [m]
  Vector3d displacement = Vector3d::Zero();  ///< at the whole step [m]
  Vector3d rotation = Vector3d::Zero();      ///< sum of the particle's turns since the start [rad]
  Vector3d velocity = Vector3d::Zero();      ///< at the last half step [m/s]
  Vector3d spin = Vector3d::Zero();          ///< at the last half step [rad/s]
  Vector3d force = Vector3d::Zero();         ///< sum of the forces of the particle's contacts at the whole step [N]
  Vector3d moment = Vector3d::Zero();        ///< about the centre [N·m]
  Vector3d weight = Vector3d::Zero();        ///< body force [N]
  double radius = 0, mass = 0, inertia = 0;  ///< [m] [kg] [kg·m²], density scaling included
  bool fixed = false;

  Vector3d centre() const { return start + displacement; }
};

/// A wall, which can be displaced but does not turn.
struct WallPlane {
  Vector3d displacement = Vector3d::Zero();  ///< [m]
  Vector3d velocity = Vector3d::Zero();      ///< [m/s]
  Vector3d force = Vector3d::Zero();         ///< on the wall by the particles [N]
};

Vec3d to_vec3(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// The stepper that make_reference_stepper() returns.
class ReferenceStepper : public Stepper {
 public:
  ReferenceStepper(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                   const Inertia& inertia, const StepperOptions& options)
      : options_(options), laws_(read_laws(network, laws)) {
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      Body body;
      body.start = to_eigen(specimen.centre[i]);
      body.radius = specimen.radius[i];
      body.mass = inertia.mass[i] * options.density_scaling;
      body.inertia = inertia.inertia[i] * options.density_scaling;
      if (!options.boundary.body_force.empty()) body.weight = to_eigen(options.boundary.body_force[i]);
      bodies_.push_back(body);
    }
    for (const std::int32_t i : options.boundary.fixed) bodies_[static_cast<std::size_t>(i)].fixed = true;
    for (const Contact& contact : network.contacts) {
      contacts_.push_back(make_reference_contact(network, contact, law(contact.pair).states()));
      if (law(contact.pair).point && contact.series != 0)
        throw InputError("reference stepper: found rock in series with a law that is not a chain, expected none");
    }
    if (options.start) start_from(*options.start);
    options_.start = nullptr;
  }

  void advance(std::int64_t steps) override {
    for (std::int64_t end = step_ + steps; step_ < end; ++step_) {
      move_bodies();
      move_walls();
      for (ReferenceContact& contact : contacts_) {
        if (options_.geometry == Geometry::updated) follow(contact);
        load(contact);
      }
    }
  }

  Observation observe() const override {
    Observation out;
    out.step = step_;
    out.time = static_cast<double>(step_) * options_.dt;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      out.wall_displacement[w] = to_vec3(walls_[w].displacement);
      out.wall_velocity[w] = to_vec3(walls_[w].velocity);
      out.wall_force[w] = to_vec3(walls_[w].force);
    }
    return out;
  }

  ParticleState particles() const override {
    ParticleState out;
    for (const Body& body : bodies_) {
      out.displacement.push_back(to_vec3(body.displacement));
      out.rotation.push_back(to_vec3(body.rotation));
      out.velocity.push_back(to_vec3(body.velocity));
      out.spin.push_back(to_vec3(body.spin));
      out.force.push_back(to_vec3(body.force + body.weight));
      out.moment.push_back(to_vec3(body.moment));
    }
    return out;
  }

  void set_velocities(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& spin) override {
    require_count("velocities", velocity.size(), bodies_.size());
    require_count("spins", spin.size(), bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].velocity = bodies_[i].fixed ? Vector3d(Vector3d::Zero()) : to_eigen(velocity[i]);
      bodies_[i].spin = bodies_[i].fixed ? Vector3d(Vector3d::Zero()) : to_eigen(spin[i]);
    }
  }

  ContactState contacts(const ContactNetwork&) const override {
    throw RunError("backend reference cannot report the forces of its contacts");
  }

  std::vector<Break> point_breaks(const ContactNetwork& network) const override {
    std::vector<Break> out;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const auto& break_of = law(contacts_[c].pair).break_of;
      if (!break_of) continue;
      out.resize(network.point_area.size(), Break::none);
      const std::uint32_t first = network.contacts[c].point_begin;
      for (std::size_t j = 0; j < contacts_[c].points.size(); ++j)
        out[first + j] = break_of(contacts_[c].points[j].chain);
    }
    return out;
  }

  std::vector<laws::PointCrack> point_cracks(const ContactNetwork& network) const override {
    std::vector<laws::PointCrack> out;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const auto& crack_of = law(contacts_[c].pair).crack_of;
      if (!crack_of) continue;
      out.resize(network.point_area.size());
      const std::uint32_t first = network.contacts[c].point_begin;
      for (std::size_t j = 0; j < contacts_[c].points.size(); ++j)
        out[first + j] = crack_of(contacts_[c].points[j].chain);
    }
    return out;
  }

  std::vector<StateArray> state() const override { refuse_checkpoints(); }
  void set_state(const std::vector<StateArray>&) override { refuse_checkpoints(); }

  std::int64_t first_divergent() const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& b = bodies_[i];
      const bool finite = b.displacement.allFinite() && b.velocity.allFinite() && b.spin.allFinite();
      if (!finite || b.velocity.norm() * options_.dt > b.radius) return static_cast<std::int64_t>(i);
    }
    return -1;
  }

  std::string description() const override {
    return std::string("reference, double precision, one contact point after the other, ") +
           (options_.geometry == Geometry::updated ? "updated" : "fixed") + " geometry, 1 thread";
  }

  std::int64_t bytes() const override {
    std::size_t sum = bodies_.size() * sizeof(Body) + contacts_.size() * sizeof(ReferenceContact);
    for (const ReferenceContact& contact : contacts_) {
      const std::size_t stretches = 3 * law(contact.pair).states() * sizeof(double);
      sum += contact.points.size() * (sizeof(ContactPoint) + stretches);
    }
    return static_cast<std::int64_t>(sum);
  }

 private:
  [[noreturn]] static void refuse_checkpoints() { throw RunError("backend reference keeps no checkpoints"); }

  /// Sets the displacements of step −1 and the velocities of step −1/2, then advances to step 0. The forces at step −1
  /// are unknown and stay 0. These forces are not needed, because the given velocities already belong to step −1/2. The
  /// step will multiply the velocities by the factor of viscous damping, so the given velocities are divided by this
  /// factor beforehand.
  void start_from(const StartState& start) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Body& body = bodies_[i];
      body.displacement = to_eigen(start.displacement[i]);
      body.rotation = to_eigen(start.rotation[i]);
      const double kept = options_.damping_kind == Damping::viscous
                              ? (1 - options_.damping * options_.dt / 2) / (1 + options_.damping * options_.dt / 2)
                              : 1;
      body.velocity = to_eigen(start.velocity[i]) / kept;
      body.spin = to_eigen(start.spin[i]) / kept;
      if (body.fixed) body.velocity = body.spin = Vector3d::Zero();
    }
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      for (int axis = 0; axis < 3; ++axis) {
        const WallAxis& driven = options_.boundary.wall[w].axis[static_cast<std::size_t>(axis)];
        if (driven.by == DrivenBy::displacement) walls_[w].displacement[axis] = driven.drive->value(-1);
      }
    }
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (options_.geometry == Geometry::updated) carry_to_start(contacts_[c], start.rotation);
      const ReferenceLaw& law = this->law(contacts_[c].pair);
      const std::size_t words = 1 + law.units.size();
      const auto number = [&](std::size_t component, std::size_t word) {
        return start.chain[start.chain_begin[c] + component * words + word];
      };
      for (ContactPoint& point : contacts_[c].points) {
        for (std::size_t word = 0; word < words; ++word) {
          const double along[3] = {number(0, word) + point.s * number(1, word) + point.t * number(2, word),
                                   number(3, word) - point.t * number(5, word),
                                   number(4, word) + point.s * number(5, word)};
          for (int axis = 0; axis < 3; ++axis) {
            const double scale = (axis == 0 ? 1.0 : law.alpha) * point.area / contacts_[c].length;
            if (word == 0) {
              point.chain[axis].force = scale * along[axis];
            } else {
              point.chain[axis].stretch[word - 1] = along[axis];
            }
          }
        }
      }
    }
    step_ = -1;
    advance(1);
  }

  /// Moves the frame of a contact from the undeformed geometry to step −1, in a single step.
  void carry_to_start(ReferenceContact& contact, const std::vector<Vec3d>& rotation) const {
    const Body& a = bodies_[contact.a];
    const Vector3d turn_a = to_eigen(rotation[contact.a]);
    if (contact.at_wall()) {
      const Vector3d approach = walls_[wall_index(contact.b)].displacement - a.displacement;
      contact.follow_wall(contact.initial_distance + approach.dot(contact.frame.n), turn_a / 2);
    } else {
      contact.follow_pair(bodies_[contact.b].centre() - a.centre(), (turn_a + to_eigen(rotation[contact.b])) / 2);
    }
  }

  const ReferenceLaw& law(PairType pair) const { return *laws_[static_cast<std::size_t>(pair)]; }

  /// Returns the velocity after one step of m·dv/dt = F + F_d; for moments likewise, with spin and moment of inertia
  /// (Eq. 1, 2; model (10.1)).
  Vector3d accelerate(const Vector3d& v, const Vector3d& load, double mass) const {
    const double dt = options_.dt, damping = options_.damping;
    switch (options_.damping_kind) {
      case Damping::viscous:  // F_d = −β·m·(v + v')/2 contains the new velocity v'; the equation is solved for v'
        return (v * (1 - damping * dt / 2) + dt * load / mass) / (1 + damping * dt / 2);
      case Damping::local: {  // F_d = −χ·|F|·sign(v) by component
        const Vector3d sign = v.unaryExpr([](double c) { return static_cast<double>((c > 0) - (c < 0)); });
        return v + dt * (load - damping * load.cwiseAbs().cwiseProduct(sign)) / mass;
      }
      case Damping::none:
        break;
    }
    return v + dt * load / mass;
  }

  /// Computes v(k+1/2) of the particles from the forces at k, then their displacements at k+1.
  void move_bodies() {
    for (Body& body : bodies_) {
      if (!body.fixed) {
        body.velocity = accelerate(body.velocity, body.force + body.weight, body.mass);
        body.spin = accelerate(body.spin, body.moment, body.inertia);
      }
      body.displacement += options_.dt * body.velocity;
      body.rotation += options_.dt * body.spin;
      body.force.setZero();
      body.moment.setZero();
    }
  }

  /// Computes v(k+1/2) of the walls, then their displacements at k+1. Axes with a given displacement follow their
  /// drive; axes with a given force move as a platen (model (10.2)).
  void move_walls() {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      WallPlane& wall = walls_[w];
      const WallMotionSpec& motion = options_.boundary.wall[w];
      Vector3d loaded = wall.force;  // force of the particles plus force of the drives
      for (int axis = 0; axis < 3; ++axis) {
        const WallAxis& driven = motion.axis[static_cast<std::size_t>(axis)];
        if (driven.by == DrivenBy::force) loaded[axis] += driven.drive->value(step_);
      }
      const Vector3d free = motion.mass > 0 ? accelerate(wall.velocity, loaded, motion.mass * options_.density_scaling)
                                            : Vector3d(Vector3d::Zero());
      for (int axis = 0; axis < 3; ++axis) {
        const WallAxis& driven = motion.axis[static_cast<std::size_t>(axis)];
        if (driven.by == DrivenBy::displacement) wall.velocity[axis] = driven.drive->rate(step_);
        if (driven.by == DrivenBy::force) wall.velocity[axis] = free[axis];
      }
      wall.displacement += options_.dt * wall.velocity;
      wall.force.setZero();
    }
  }

  /// Moves the frame of a contact to k+1, where forces act, and the middle frame to half a step earlier, where
  /// velocities are taken.
  void follow(ReferenceContact& contact) const {
    const Body& a = bodies_[contact.a];
    if (contact.at_wall()) {
      const Vector3d approach = walls_[wall_index(contact.b)].displacement - a.displacement;
      contact.follow_wall(contact.initial_distance + approach.dot(contact.frame.n), options_.dt * a.spin / 2);
    } else {
      const Body& b = bodies_[contact.b];
      contact.follow_pair(b.centre() - a.centre(), options_.dt * (a.spin + b.spin) / 2);
    }
  }

  /// Advances the chains of all points of a contact and adds their forces to both sides.
  void load(ReferenceContact& contact) {
    const ReferenceLaw& law = this->law(contact.pair);
    Body& a = bodies_[contact.a];
    for (ContactPoint& point : contact.points) {
      const Vector3d increment = options_.dt * relative_velocity(contact, point);
      const ContactFrame &middle = contact.middle, &frame = contact.frame;
      const Vector3d local(increment.dot(middle.n), increment.dot(middle.s), increment.dot(middle.t));
      if (law.point) {
        law.point(point.area, contact.length, options_.dt, {local[0], local[1], local[2]}, point.chain);
      }
      for (int axis = 0; axis < 3 && !law.point; ++axis) {
        const double scale = (axis == 0 ? 1.0 : law.alpha) * point.area / contact.length;
        // If area, shear stiffness (α) or modulus is 0, no force acts, so the chain is not advanced.
        // The rock has the same stiffness in all directions, series⁻¹·A/length, so its compliance is α·series in units
        // of the scale of shear.
        const double rock = (axis == 0 ? 1.0 : law.alpha) * contact.series;
        if (scale * law.E_m != 0) advance_chain(law, scale, options_.dt, local[axis], point.chain[axis], rock);
      }
      // In tension the chains pull A towards B, and B towards A.
      const Vector3d force =
          point.chain[0].force * frame.n + point.chain[1].force * frame.s + point.chain[2].force * frame.t;
      a.force += force;
      a.moment += frame.lever_a(point).cross(force);
      if (contact.at_wall()) {
        walls_[wall_index(contact.b)].force -= force;
      } else {
        Body& b = bodies_[contact.b];
        b.force -= force;
        b.moment -= frame.lever_b(point).cross(force);
      }
    }
  }

  /// Returns the velocity of B relative to A at a contact point, model (5.1).
  Vector3d relative_velocity(const ReferenceContact& contact, const ContactPoint& point) const {
    const Body& a = bodies_[contact.a];
    const Vector3d side_a = a.velocity + a.spin.cross(contact.middle.lever_a(point));
    if (contact.at_wall()) return walls_[wall_index(contact.b)].velocity - side_a;
    const Body& b = bodies_[contact.b];
    return b.velocity + b.spin.cross(contact.middle.lever_b(point)) - side_a;
  }

  StepperOptions options_;
  ReferenceLaws laws_;
  std::vector<Body> bodies_;
  std::array<WallPlane, 6> walls_{};
  std::vector<ReferenceContact> contacts_;
  std::int64_t step_ = 0;
};

}  // namespace
}  // namespace reference

std::unique_ptr<Stepper> make_reference_stepper(const Specimen& specimen, const ContactNetwork& network,
                                                const LawTable& laws, const Inertia& inertia,
                                                const StepperOptions& options) {
  reference::require_options(options);
  reference::require_network(network, specimen.size());
  reference::require_inertia(inertia, specimen.size());
  return std::make_unique<reference::ReferenceStepper>(specimen, network, laws, inertia, options);
}

}  // namespace macadam
