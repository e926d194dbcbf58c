// SPDX-License-Identifier: GPL-3.0-or-later
// device_engine.cpp  Passes the operations of Newton's method to a CUDA device. States are copied to the host only when
// somebody asks for them. Small systems are factored on the host, from the blocks that the device has assembled.
#include <algorithm>
#include <cmath>
#include <optional>

#include "host/backends/cuda_code.hpp"
#include "host/quasi_static/engine.hpp"
#include "host/quasi_static/increment_system.hpp"
#include "macadam/error.hpp"

namespace macadam::quasi_static {
namespace {

using kernels::IncrementVector;

/// Number of boxes of the coarse level. The device applies the inverse of a matrix of 6·boxes rows in each iteration.
std::size_t boxes_for(std::size_t particles) {
  constexpr std::size_t per_box = 60, most = 256;
  return std::clamp<std::size_t>(particles / per_box, 1, most);
}

class DeviceEngine : public Engine {
 public:
  DeviceEngine(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
               const QuasiStaticOptions& options, int device)
      : network_(network),
        laws_(pair_laws(network, laws)),
        law_table_(laws),
        system_(make_increment_system(specimen, network, laws_, boxes_for(specimen.size()))),
        device_(cuda_code()->make_increments(system_, device)) {
    body_.resize(system_.bodies());
    for (std::size_t i = 0; i < body_.size(); ++i) body_[static_cast<std::size_t>(system_.particle[i])] = i;
    state_begin_.push_back(0);
    for (const Contact& c : network.contacts) {
      const PairLaw& law = laws_[static_cast<std::size_t>(c.pair)];
      const std::size_t components = law.cracked ? 3 * std::size_t{c.point_end - c.point_begin} : 6;
      state_begin_.push_back(state_begin_.back() + components * static_cast<std::size_t>(law.increment(0).words));
      if (!law.cracked) continue;
      has_cracks_ = true;
      for (std::uint32_t j = c.point_begin; j < c.point_end; ++j) crackable_area_ += network.point_area[j];
    }
    // Without motion the tangent is the intact, instantaneous stiffness
    begin(all_laws(instant), Vector(6 * specimen.size()), 0);
    device_->evaluate({});
    wall_stiffness_ = device_->assemble(true, 0, 0).wall_stiffness;
    device_->set_intact(to_bodies(intact_stiffness(to_particles(device_->diagonal()), specimen)));
    if (!options.solves_directly(specimen.size())) return;
    direct_ = make_direct_solver();
    matrix_.emplace(network, specimen.size());
  }

  void begin(const LawTimes& dt, const Vector& guess, double drag) override {
    for (std::size_t pair = 0; pair < pair_types; ++pair) {
      if (dt[pair] != increment_[pair].dt) increment_[pair] = laws_[pair].increment(dt[pair]);
      increment_[pair].drag = drag;
    }
    device_->write(IncrementVector::trial, to_bodies(guess));
    device_->begin(increment_, growing_area_, drag > 0);
  }
  TrialSums evaluate(const Walls& wall, double /*warming*/) override {
    const kernels::IncrementSums found = device_->evaluate(wall);
    TrialSums out;
    out.size = std::sqrt(found.size), out.scale = std::sqrt(found.scale), out.opening = found.opening;
    for (std::size_t w = 0; w < wall_count; ++w)
      out.reaction[w] = {found.reaction[w][0], found.reaction[w][1], found.reaction[w][2]};
    return out;
  }

  bool wants_symmetric() const override { return !direct_; }
  LinearReport prepare(bool symmetric, std::int64_t& loose) override {
    const kernels::AssembledSums sums = device_->assemble(symmetric, held_part, loose_part);
    loose = sums.loose;
    wall_stiffness_ = sums.wall_stiffness;
    LinearReport out;
    out.solved = true;
    if (direct_) {
      matrix_->set(device_->blocks(), symmetric, [&](std::size_t particle) {
        return static_cast<std::size_t>(system_.entry_begin[body_[particle]]);
      });
      return direct_->prepare(*matrix_);
    }
    device_->precondition();
    return out;
  }
  LinearReport solve(Unknown unknown, double tolerance) override {
    const bool by_wall = unknown == Unknown::by_wall;
    LinearReport out;
    if (!direct_) {
      const kernels::IncrementSolution found = device_->solve(by_wall, tolerance);
      out.solved = found.solved, out.negative = found.negative, out.iterations = found.iterations;
      return out;
    }
    Vector right = to_particles(device_->read(by_wall ? IncrementVector::top : IncrementVector::residual)), x;
    for (double& v : right) v = -v;
    out = direct_->solve(right, x, tolerance);
    device_->write(by_wall ? IncrementVector::by_wall : IncrementVector::correction, to_bodies(x));
    return out;
  }
  void add_by_wall(double factor) override { device_->add_by_wall(factor); }
  double on_top(Unknown unknown) override { return device_->on_top(unknown == Unknown::by_wall); }
  double opening_change(Unknown unknown) override { return device_->opening_change(unknown == Unknown::by_wall); }
  double wall_stiffness() const override { return wall_stiffness_; }
  void keep() override { device_->keep(); }
  void move(double length) override { device_->move(length); }

  ContactEnergies accept() override {
    const ContactEnergies out = device_->accept();
    growing_area_ = out.growing;
    is_copied_ = false;
    return out;
  }
  double growing_part() override { return crackable_area_ > 0 ? device_->growing_area() / crackable_area_ : 0; }

  Vector motion() const override { return to_particles(device_->read(IncrementVector::trial)); }
  EngineState state() const override {
    const kernels::IncrementStates found = device_->states();
    EngineState out{to_particles(found.displacement), order().to_network(found), {}};
    if (!has_cracks_) return out;
    out.grew.assign(system_.network_points, 0);
    for (std::size_t j = 0; j < found.grew.size(); ++j) out.grew[system_.point_of[j]] = found.grew[j] != 0;
    return out;
  }
  void set_state(EngineState state) override {
    kernels::IncrementStates to{to_bodies(state.displacement), {}, {}, {}};
    order().to_device(state.states, to);
    growing_area_ = 0;
    for (const std::uint32_t j : system_.point_of) {
      to.grew.push_back(state.grew[j] != 0);
      growing_area_ += state.grew[j] ? network_.point_area[j] : 0;
    }
    device_->set_states(to);
    is_copied_ = false;
  }
  Vector displacement() const override { return to_particles(device_->read(IncrementVector::displacement)); }
  const ContactIncrements& contacts() const override {
    if (!copy_) copy_.emplace(network_, law_table_);
    if (!is_copied_) {
      EngineState now = state();
      copy_->set_states(std::move(now.states), std::move(now.grew));
      is_copied_ = true;
    }
    return *copy_;
  }
  std::vector<laws::PointCrack> point_cracks() const override {
    std::vector<laws::PointCrack> out(has_cracks_ ? system_.network_points : 0);
    device_->read_cracks(&out, nullptr);
    return out;
  }
  std::optional<experiments::CrackSurvey> survey_cracks() override {
    kernels::CrackTotals found = device_->crack_totals();
    experiments::CrackSurvey out;
    out.cracked = found.cracked;
    for (const std::int64_t number : found.cracked) out.sums.cracked += number;
    out.sums.crack_energy_j = found.energy, out.sums.friction_energy_j = found.friction;
    out.sums.cracked_area_m2 = found.area;
    std::ranges::sort(found.broken, {}, &kernels::BrokenPoint::point);
    for (const kernels::BrokenPoint& p : found.broken)
      out.broken.push_back({contact_of_point(p.point), p.point, p.how, 0, p.opening, p.slip});
    return out;
  }
  std::vector<Break> point_breaks() const override {
    std::vector<Break> out(has_cracks_ ? system_.network_points : 0, Break::none);
    device_->read_cracks(nullptr, &out);
    return out;
  }
  std::string description() const override {
    return direct_ ? "cuda, double, direct solver on the CPU" : "cuda, double, iterative solver";
  }
  std::int64_t bytes() const override { return device_->bytes(); }

 private:
  /// Returns the contact to which a point of the network belongs.
  std::uint32_t contact_of_point(std::uint32_t point) const {
    const auto after = std::ranges::upper_bound(network_.contacts, point, {}, &Contact::point_begin);
    return static_cast<std::uint32_t>(after - network_.contacts.begin()) - 1;
  }
  StateOrder order() const { return {network_, system_, state_begin_, increment_}; }
  /// Reorder six numbers per particle.
  /// @{
  Vector to_particles(const Vector& of_bodies) const {
    Vector out(of_bodies.size());
    for (std::size_t particle = 0; particle < body_.size(); ++particle)
      std::copy_n(&of_bodies[6 * body_[particle]], 6, &out[6 * particle]);
    return out;
  }
  Vector to_bodies(const Vector& of_particles) const {
    Vector out(of_particles.size());
    for (std::size_t particle = 0; particle < body_.size(); ++particle)
      std::copy_n(&of_particles[6 * particle], 6, &out[6 * body_[particle]]);
    return out;
  }
  /// @}

  const ContactNetwork& network_;
  PairLaws laws_;
  LawTable law_table_;
  kernels::IncrementSystem system_;
  std::vector<std::size_t> body_;         ///< particle → body
  std::vector<std::size_t> state_begin_;  ///< as ContactIncrements::state_begin()
  std::unique_ptr<kernels::DeviceIncrements> device_;
  kernels::IncrementLaws increment_{};
  double growing_area_ = 0, crackable_area_ = 0, wall_stiffness_ = 0;
  bool has_cracks_ = false;
  std::unique_ptr<TangentSolver> direct_;  ///< small systems only
  std::optional<TangentMatrix> matrix_;
  mutable std::optional<ContactIncrements> copy_;  ///< of the accepted states
  mutable bool is_copied_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_device_engine(const Specimen& specimen, const ContactNetwork& network,
                                           const LawTable& laws, const QuasiStaticOptions& options) {
  if (!options.expansion.empty())
    throw InputError("quasi-static: found expansions of contacts with backend cuda, expected backend cpu or auto");
  const DeviceList devices = device_numbers(options.devices);
  if (devices.size() != 1) {
    throw InputError("device: found " + to_string(devices) +
                     ", expected one device, because several devices cannot share a quasi-static test");
  }
  return std::make_unique<DeviceEngine>(specimen, network, laws, options, devices.front());
}

}  // namespace macadam::quasi_static
