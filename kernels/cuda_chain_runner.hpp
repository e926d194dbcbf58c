// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cuda_chain_runner.hpp  Runs condensed contacts in double precision over tiles that each have a multiprocessor.
#pragma once

#include <functional>
#include <memory>

#include "kernels/cuda_tile_limits.hpp"
#include "kernels/cuda_tiles_chained.hpp"

namespace macadam::kernels {

template <class P>
class ChainRunner {
 public:
  using R = typename P::Particle;
  using G = typename P::Geometry;
  using State = typename P::State;
  static constexpr int most_units = 3;

  /// `laws` of the pair types that have contacts.
  ChainRunner(const ContactNetwork& network, const Layout& layout, const StepperOptions& options,
              const std::array<std::optional<Law>, pair_types>& laws, cudaStream_t stream)
      : plan_(plan_tiles(network, layout)), bodies_(layout.particles()), dt_(options.dt), stream_(stream) {
    for (const auto& group : layout.groups) {
      const int n = std::visit([](const auto& l) { return l.units(); }, *laws[static_cast<std::size_t>(group.pair)]);
      units_ = n > most_units ? 2 * most_units : std::max(units_, n > 0 ? most_units : 0);
    }
    auto& view = arrays_.shape;
    view.geometry_words = options.geometry == Geometry::updated ? distance + 1 : distance;
    view.frame_words = frame_words_of<P>(options.geometry);
    view.components = 6;
    view.units = units_;
    choose(options.geometry);
    if (!possible()) return;
    const std::size_t n = plan_.contact.size();
    arrays_.body_a.resize(n);
    arrays_.body_b.resize(n);
    arrays_.geometry.assign(n * static_cast<std::size_t>(view.geometry_words), G(0));
    arrays_.chain.assign(n * chain_words(), State(0));
    arrays_.frame.assign(n * static_cast<std::size_t>(view.frame_words), State(0));
    slots_.assign(n, uint2{UINT32_MAX, no_wall_row << 4});
  }

  bool possible() const { return static_cast<bool>(run_); }
  static std::string description() { return "tiles on the chip"; }

  /// Takes group `number`.
  template <Geometry geometry>
  void add_group(int number, const ContactArrays<P>& from, const ContactView<P>& view, double) {
    const auto g = static_cast<std::uint32_t>(number);
    const auto* kelvin = std::get_if<laws::GeneralisedKelvin>(&from.law);
    const double modulus = std::visit([](const auto& l) { return l.instantaneous(); }, from.law);
    scene_.law[number] = {kelvin ? kelvin->template step<State>(dt_) : laws::GeneralisedKelvin{modulus}.step<State>(dt_),
                          view.alpha, view.wall};
    const auto copy = [](const auto& list, std::size_t slot, std::size_t words, auto& to, std::size_t i,
                         std::size_t to_words, auto&& word) {
      for (std::size_t w = 0; w < words; ++w) {
        to[i / 32 * to_words * 32 + word(w) * 32 + i % 32] = list[slot / 32 * words * 32 + w * 32 + slot % 32];
      }
    };
    const auto same = [](std::size_t w) { return w; };
    for (std::size_t i = 0; i < plan_.contact.size(); ++i) {
      const TileContact& c = plan_.contact[i];
      if (c.group_slot == UINT32_MAX || c.group != g) continue;
      arrays_.body_a[i] = c.local_a;
      arrays_.body_b[i] = c.local_b;
      slots_[i] = {c.slot_a | static_cast<std::uint32_t>(c.slot_b) << 16, g | std::min(c.wall_row, no_wall_row) << 4};
      const auto words = static_cast<std::size_t>(view.geometry_words), frame = static_cast<std::size_t>(view.frame_words);
      copy(from.geometry, c.group_slot, words, arrays_.geometry, i, words, same);
      copy(from.frame, c.group_slot, frame, arrays_.frame, i, frame, same);
      const auto chain = static_cast<std::size_t>(1 + view.units);
      if (from.chain.empty()) {
        elastic_.push_back({i, from.body_a[c.group_slot], from.body_b[c.group_slot], modulus});
      } else {
        copy(from.chain, c.group_slot, static_cast<std::size_t>(view.components) * chain, arrays_.chain, i,
             chain_words(), [&](std::size_t w) { return w / chain * static_cast<std::size_t>(1 + units_) + w % chain; });
      }
    }
  }

  void prepare(const ParticleMotion<P>& motion, const std::uint32_t*, const std::uint32_t*, std::size_t,
               const std::vector<std::uint32_t>&) {
    auto& s = scene_.tiles;
    s.motion = motion;
    s.tile = store_.keep(plan_.tile);
    s.body = store_.keep(plan_.body);
    s.row = reinterpret_cast<const uint2*>(store_.keep(plan_.row));
    s.diagonal = store_.keep(plan_.diagonal);
    s.halo = store_.keep(plan_.halo);
    s.force = store_.template zeros<R>((bodies_ + walls) * velocity_words);
    base_ = store_.template zeros<R>(walls * velocity_words);
    s.wall_load = wall_load_ = store_.template zeros<R>(velocity_words * (plan_.wall_begin.back() + 1));
    wall_begin_ = store_.keep(plan_.wall_begin);
    wall_velocity_ = store_.template zeros<double>(table_steps);
    scene_.exchange = store_.template zeros<ulonglong2>(2 * words_exchanged<G> * bodies_);
    if (arrays_.shape.frame_words > 0) {
      scene_.displacement = store_.template zeros<double>(4 * plan_.tile.size() * plan_.most_locals);
    }
    scene_.slots = store_.keep(slots_);
    scene_.view = arrays_.shape;
    scene_.view.body_a = store_.keep(arrays_.body_a);
    scene_.view.body_b = store_.keep(arrays_.body_b);
    scene_.view.geometry = store_.keep(arrays_.geometry);
    scene_.view.frame = store_.keep(arrays_.frame);
    arrays_.geometry = {};
    arrays_.frame = {};
    slots_ = {};
  }

  /// Queues steps first … first + steps − 1.
  void run(std::int64_t first, std::int64_t steps) {
    if (!scene_.view.chain) begin();
    for (std::int64_t done = 0; done < steps;) {
      auto n = static_cast<std::uint32_t>(std::min<std::int64_t>(steps - done, table_steps));
      if (scene_.tiles.motion.loaded) {
        launch("wall", tabulate_wall<loadings::Cyclic>, (n + 127) / 128, 128, 0, stream_, scene_.tiles.motion.loading, first + done, n,
               wall_velocity_);
      }
      scene_.tiles.wall_velocity = wall_velocity_;
      run_(n);
      tag_ += n;
      done += n;
    }
  }

  /// Loads on all bodies now, [body][8].
  const R* forces() const {
    launch("wall loads", add_wall_loads<R, R>, walls, body_threads, 0, stream_, wall_load_, wall_begin_, base_,
           scene_.tiles.force + bodies_ * velocity_words);
    return scene_.tiles.force;
  }
  std::int64_t bytes() const { return store_.bytes(); }
  /// Bytes that a step writes.
  std::int64_t state_bytes() const { return state_bytes_; }

 private:
  static constexpr std::int64_t table_steps = 4096;
  /// A contact whose f follows from the displacements of the start.
  struct ElasticStart {
    std::size_t contact;
    std::int32_t a, b;
    double modulus;
  };

  std::size_t chain_words() const { return static_cast<std::size_t>(6 * (1 + units_)); }

  void choose(Geometry geometry) {
    if (!plan_.fits || units_ > most_units) return;
    auto& s = scene_.tiles;
    s.most_bodies = plan_.most_bodies;
    s.most_halo = plan_.most_halo;
    s.most_locals = plan_.most_locals;
    s.most_slots = plan_.most_slots;
    s.bodies = static_cast<std::uint32_t>(bodies_);
    const auto with = [&](auto units) {
      if (geometry == Geometry::updated)
        try_kernel<units(), Geometry::updated>();
      else
        try_kernel<units(), Geometry::fixed>();
    };
    if (units_ == 0)
      with(std::integral_constant<int, 0>{});
    else
      with(std::integral_constant<int, most_units>{});
  }

  template <int Units, Geometry geometry>
  void try_kernel() {
    constexpr int threads = 512;
    const auto kernel = run_chained<P, Units, geometry, threads>;
    const std::uint32_t shared =
        ChainMemory<P>(plan_.most_bodies, plan_.most_halo, plan_.most_locals, plan_.most_slots).total;
    if (!fits_resident(DeviceLimits::query(), kernel, plan_.tile.size(), threads, shared)) return;
    // carried displacements are those of all bodies
    scene_.tiles.early = geometry == Geometry::updated ? 0 : early_packets(plan_, threads / 32);
    run_ = [this, kernel, shared](std::uint32_t steps) {
      void* arguments[] = {&scene_, &steps, &tag_};
      check_cuda(cudaLaunchCooperativeKernel(kernel, static_cast<unsigned>(plan_.tile.size()), threads, arguments, shared,
                                             stream_),
                 "time steps");
    };
  }

  /// Before the first step: stateless contacts get the f of their displacements, and the chains go to the device.
  void begin() {
    std::vector<double> u((bodies_ + walls) * displacement_words);
    check_cuda(cudaMemcpy(u.data(), scene_.tiles.motion.body.displacement, u.size() * sizeof(double),
                          cudaMemcpyDeviceToHost),
               "displacements");
    const auto vector = [&](std::int32_t body, int first) {
      const double* w = &u[static_cast<std::size_t>(body) * displacement_words + static_cast<std::size_t>(first)];
      return Vec3d{w[0], w[1], w[2]};
    };
    std::vector<G> geometry(arrays_.chain.size() / chain_words() * static_cast<std::size_t>(scene_.view.geometry_words));
    check_cuda(cudaMemcpy(geometry.data(), scene_.view.geometry, geometry.size() * sizeof(G), cudaMemcpyDeviceToHost),
               "geometry");
    for (const ElasticStart& e : elastic_) {
      const G* g = &geometry[e.contact / 32 * static_cast<std::size_t>(scene_.view.geometry_words) * 32 + e.contact % 32];
      const Vec3d n{g[n_x * 32], g[n_y * 32], g[n_z * 32]};
      double x[6];
      relative_rates(canonical_placement(n, std::copysign(1.0, n.z), double(g[arm_a * 32]), double(g[arm_b * 32])),
                     Twist<double>{{}, vector(e.a, 4)}, Twist<double>{vector(e.b, 0) - vector(e.a, 0), vector(e.b, 4)},
                     x);
      State* chain = &arrays_.chain[e.contact / 32 * chain_words() * 32 + e.contact % 32];
      for (int c = 0; c < 6; ++c) chain[c * (1 + units_) * 32] = static_cast<State>(e.modulus * x[c]);
    }
    elastic_ = {};
    state_bytes_ = static_cast<std::int64_t>(arrays_.chain.size() * sizeof(State));
    scene_.view.chain = store_.keep(arrays_.chain);
    arrays_.chain = {};
  }

  TilePlan plan_;
  std::size_t bodies_;
  double dt_;
  cudaStream_t stream_;
  int units_ = 0;
  ContactArrays<P> arrays_;
  std::vector<uint2> slots_;
  std::vector<ElasticStart> elastic_;
  ChainScene<P> scene_{};
  std::uint32_t tag_ = 1;
  R *base_ = nullptr, *wall_load_ = nullptr;
  double* wall_velocity_ = nullptr;
  const std::uint32_t* wall_begin_ = nullptr;
  std::int64_t state_bytes_ = 0;
  DeviceStore store_;
  std::function<void(std::uint32_t)> run_;
};

}  // namespace macadam::kernels
