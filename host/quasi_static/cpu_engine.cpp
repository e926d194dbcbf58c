// SPDX-License-Identifier: GPL-3.0-or-later
// cpu_engine.cpp  Computes the operations of Newton's method on all threads of the CPU. Sums have a fixed order, so the
// bits do not depend on the number of threads.
#include <algorithm>
#include <cmath>

#include "host/quasi_static/engine.hpp"
#include "kernels/base/parallel.hpp"

namespace macadam::quasi_static {

Vector intact_stiffness(const Vector& diagonal, const Specimen& specimen) {
  const std::size_t particles = specimen.size();
  Vector out(6 * particles);
  double typical = 0;
  for (std::size_t i = 0; i < particles; ++i) {
    const double* d = &diagonal[6 * i];
    typical = std::max(typical, d[0] + (d[1] + d[2]));
  }
  for (std::size_t i = 0; i < particles; ++i) {
    const double* d = &diagonal[6 * i];
    const double forces = std::max(std::max({d[0], d[1], d[2]}), 1e-6 * typical);
    const double moments =
        std::max(std::max({d[3], d[4], d[5]}), 1e-3 * forces * specimen.radius[i] * specimen.radius[i]);
    for (std::size_t k = 0; k < 6; ++k) out[6 * i + k] = std::max(d[k], 1e-3 * (k < 3 ? forces : moments));
  }
  return out;
}

namespace {

Six wall_motion(const Walls& walls, std::int32_t wall) {
  const Vec3d& x = walls[wall_index(wall)];
  return {x.x, x.y, x.z, 0, 0, 0};
}

/// Numbers of contacts or particles in a piece of parallel work.
constexpr std::size_t contacts_at_once = 512, particles_at_once = 1024;

/// Forces on all walls.
struct WallForces {
  Walls of{};
  WallForces& operator+=(const WallForces& other) {
    for (std::size_t w = 0; w < wall_count; ++w) of[w] += other.of[w];
    return *this;
  }
};

class CpuEngine : public Engine {
 public:
  CpuEngine(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
            const QuasiStaticOptions& options)
      : network_(network),
        particles_(specimen.size()),
        contacts_(network, laws),
        matrix_(network, specimen.size()),
        solver_(options.solves_directly(specimen.size()) ? make_direct_solver() : make_iterative_solver(specimen)),
        expansion_(options.expansion),
        displacement_(6 * specimen.size()),
        trial_(6 * specimen.size()) {
    for (std::size_t number = 0; number < network.contacts.size(); ++number) {
      if (network.contacts[number].b < 0) at_walls_.push_back(static_cast<std::uint32_t>(number));
    }
    contacts_.begin(all_laws(instant));
    contacts_.evaluate(std::vector<Six>(network.contacts.size(), Six{}));
    matrix_.assemble(contacts_, true);
    Vector diagonal(6 * particles_);
    for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] = diagonal_number(i);
    intact_ = intact_stiffness(diagonal, specimen);
    find_wall_stiffness();
  }

  void begin(const LawTimes& dt, const Vector& guess, double drag) override {
    contacts_.begin(dt, drag);
    trial_ = guess;
  }

  TrialSums evaluate(const Walls& wall, double warming) override {
    relative_.resize(network_.contacts.size());
    for_each_of(network_.contacts.size(), [&](std::size_t number) {
      const Contact& c = network_.contacts[number];
      const Six at_wall = c.b < 0 ? wall_motion(wall, c.b) : Six{};
      const double* b = c.b < 0 ? at_wall.data() : &trial_[6 * static_cast<std::size_t>(c.b)];
      relative_[number] = relative(c, &trial_[6 * static_cast<std::size_t>(c.a)], b);
      if (!expansion_.empty()) relative_[number][0] -= expansion_[number] * warming;
    });
    contacts_.evaluate(relative_);
    residual_.resize(6 * particles_);
    Vector sizes(6 * particles_);
    for_each_of(particles_, [&](std::size_t i) {
      Six sum{}, size{};
      for (const std::uint32_t number : network_.row(i)) {
        const Contact& c = network_.contacts[number];
        const Six load = load_on(c, contacts_.force(number), c.a == static_cast<std::int32_t>(i) ? 0 : 1);
        for (std::size_t k = 0; k < 6; ++k) sum[k] += load[k], size[k] += std::abs(load[k]);
      }
      for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t degree = 6 * i + k;
        residual_[degree] = sum[k], sizes[degree] = size[k];
      }
    });
    TrialSums out;
    out.size = size_of(residual_);
    out.scale = size_of(sizes);
    out.opening = contacts_.opening();
    const auto forces =
        sum_of_pieces<WallForces>(at_walls_.size(), contacts_at_once, [&](std::size_t from, std::size_t to) {
          WallForces sum;
          for (std::size_t k = from; k < to; ++k) {
            const Contact& c = network_.contacts[at_walls_[k]];
            const Six load = load_on(c, contacts_.force(at_walls_[k]), 1);
            sum.of[wall_index(c.b)] += Vec3d{load[0], load[1], load[2]};
          }
          return sum;
        });
    out.reaction = forces.of;
    return out;
  }

  double restrained_size(double warming) const override {
    if (expansion_.empty() || warming == 0) return 0;
    Vector sizes(6 * particles_, 0.0);
    for (std::size_t number = 0; number < network_.contacts.size(); ++number) {
      const Contact& c = network_.contacts[number];
      const double force = contacts_.stiffness(number)[0] * expansion_[number] * warming;
      for (const int end : {0, 1}) {
        const std::int32_t particle = end == 0 ? c.a : c.b;
        if (particle < 0) continue;
        const Six load = load_on(c, {force, 0, 0, 0, 0, 0}, end);
        for (std::size_t k = 0; k < 6; ++k) sizes[6 * static_cast<std::size_t>(particle) + k] += std::abs(load[k]);
      }
    }
    return size_of(sizes);
  }

  double thermal_work(double warming) const override {
    if (expansion_.empty() || warming == 0) return 0;
    return sum_in_parallel<double>(expansion_.size(), [&](std::size_t c) {
      const double mean = 0.5 * (contacts_.accepted_force(c)[0] + contacts_.force(c)[0]);
      return -mean * expansion_[c] * warming;
    });
  }

  bool wants_symmetric() const override { return solver_->wants_symmetric(); }

  LinearReport prepare(bool symmetric, std::int64_t& loose) override {
    matrix_.assemble(contacts_, symmetric);
    find_wall_stiffness();
    const auto hold = [&](std::size_t i) {
      double now = 0, intact = 0;
      for (std::size_t k = 0; k < 3; ++k) now += diagonal_number(6 * i + k), intact += intact_[6 * i + k];
      const bool is_loose = now < loose_part * intact;
      for (std::size_t k = 0; k < 6; ++k)
        matrix_.add_to_diagonal(6 * i + k, (is_loose ? loose_part : held_part) * intact_[6 * i + k]);
      return std::int64_t{is_loose};
    };
    loose = sum_in_parallel<std::int64_t>(particles_, hold, particles_at_once);
    return solver_->prepare(matrix_);
  }

  LinearReport solve(Unknown unknown, double tolerance) override {
    const bool by_wall = unknown == Unknown::by_wall;
    const Vector& from = by_wall ? matrix_.top_column() : residual_;
    Vector right(from.size());
    for_each_of(right.size(), [&](std::size_t i) { right[i] = -from[i]; });
    return solver_->solve(right, by_wall ? by_wall_ : correction_, tolerance);
  }

  void add_by_wall(double factor) override {
    for_each_of(correction_.size(), [&](std::size_t i) { correction_[i] += factor * by_wall_[i]; });
  }
  double on_top(Unknown unknown) override {
    const Vector& x = solution(unknown);
    return sum_in_parallel<double>(x.size(), [&](std::size_t i) { return matrix_.top_column()[i] * x[i]; });
  }
  double opening_change(Unknown unknown) override {
    static constexpr Six at_rest{};
    const Vector& motion = solution(unknown);
    const auto change = [&](std::size_t number) {
      const Contact& c = network_.contacts[number];
      const Six& rate = contacts_.opening_rate(number);
      if (rate == Six{}) return 0.0;
      const Six u = relative(c, &motion[6 * static_cast<std::size_t>(c.a)],
                             c.b < 0 ? at_rest.data() : &motion[6 * static_cast<std::size_t>(c.b)]);
      double out = 0;
      for (std::size_t k = 0; k < 6; ++k) out += rate[k] * u[k];
      return out;
    };
    return sum_in_parallel<double>(network_.contacts.size(), change, contacts_at_once);
  }
  double wall_stiffness() const override { return wall_stiffness_; }

  void keep() override { kept_ = trial_; }
  void move(double length) override {
    for_each_of(kept_.size(), [&](std::size_t i) { trial_[i] = kept_[i] + length * correction_[i]; });
  }

  ContactEnergies accept() override {
    const ContactEnergies out = contacts_.accept(relative_);
    for_each_of(displacement_.size(), [&](std::size_t i) { displacement_[i] += trial_[i]; });
    return out;
  }
  double growing_part() override { return contacts_.growing_part(); }

  Vector motion() const override { return trial_; }
  EngineState state() const override { return {displacement_, contacts_.states(), contacts_.grew()}; }
  void set_state(EngineState state) override {
    displacement_ = std::move(state.displacement);
    contacts_.set_states(std::move(state.states), std::move(state.grew));
  }
  Vector displacement() const override { return displacement_; }
  const ContactIncrements& contacts() const override { return contacts_; }
  std::string description() const override { return std::string("cpu, double, ") + solver_->name(); }
  std::int64_t bytes() const override { return contacts_.bytes() + matrix_.bytes(); }

 private:
  double diagonal_number(std::size_t degree) const {
    const auto k = static_cast<Eigen::Index>(degree % 6);
    return matrix_.diagonal(degree / 6)(k, k);
  }
  const Vector& solution(Unknown unknown) const { return unknown == Unknown::by_wall ? by_wall_ : correction_; }
  double size_of(const Vector& loads) const {
    return std::sqrt(
        sum_in_parallel<double>(loads.size(), [&](std::size_t i) { return loads[i] * loads[i] / intact_[i]; }));
  }
  void find_wall_stiffness() {
    wall_stiffness_ = sum_in_parallel<double>(
        at_walls_.size(),
        [&](std::size_t k) {
          const Contact& c = network_.contacts[at_walls_[k]];
          if (c.b != wall_z_hi) return 0.0;
          const SixBySix own = motion_matrix(c, 1);
          const Eigen::Map<const Block> g(own.data()), stiffness(contacts_.stiffness(at_walls_[k]).data());
          return (g.transpose() * stiffness * g)(2, 2);
        },
        contacts_at_once);
  }

  const ContactNetwork& network_;
  std::size_t particles_;
  ContactIncrements contacts_;
  TangentMatrix matrix_;
  std::unique_ptr<TangentSolver> solver_;
  std::vector<double> expansion_;        ///< as QuasiStaticOptions::expansion
  std::vector<std::uint32_t> at_walls_;  ///< the contacts at walls, in the network's order
  Vector intact_;                        ///< diagonal of the intact, instantaneous stiffness
  double wall_stiffness_ = 0;            ///< derivative of the top wall's reaction with respect to its displacement
  Vector displacement_, trial_, kept_, residual_, correction_, by_wall_;
  std::vector<Six> relative_;  ///< relative displacements of the contacts at the last evaluation
};

}  // namespace

std::unique_ptr<Engine> make_cpu_engine(const Specimen& specimen, const ContactNetwork& network, const LawTable& laws,
                                        const QuasiStaticOptions& options) {
  return std::make_unique<CpuEngine>(specimen, network, laws, options);
}

}  // namespace macadam::quasi_static
