// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_readout.hpp  Computes forces and deformation of the contacts of a group for output. Reads the states
/// of an executor (the object that runs the steps on a CPU or GPU); computes on the host in double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "kernels/contact/contact_data.hpp"
#include "kernels/contact/contact_step.hpp"
#include "kernels/contact/initial_contact.hpp"

namespace macadam::kernels {

/// The arrays of a group that steps change, in host memory.
template <class P>
struct GroupState {
  /// As in ContactView. The memory belongs to the executor; it is valid until the next call of a function of the
  /// executor.
  std::span<const typename P::State> chain, frame;
  std::vector<float> change;  ///< [slot][6] change of the force density f since the chains were updated; empty: none
};

/// Reads one group of contacts, with the current displacements.
template <class P, class L>
class GroupReading {
 public:
  GroupReading(const ContactNetwork& network, const Layout& layout, const GroupLayout& group, const L& law,
               const StepperOptions& options, const std::vector<double>& displacement, GroupState<P> state)
      : network_(network),
        layout_(layout),
        group_(group),
        parameters_(law),
        law_(law.template step<double>(options.dt)),
        shape_(layout, group, facts_of(law), options),
        updated_(options.geometry == Geometry::updated),
        alpha_(law.alpha),
        displacement_(displacement),
        state_(std::move(state)) {}

  /// Returns how many numbers contact c has in ContactState::chain.
  std::size_t numbers(const Contact& c) const {
    return words() * (shape_.by_points ? 3 * (c.point_end - c.point_begin) : 6);
  }

  /// Fills in all entries of the group's contacts and of their points. `out.chain_begin` must be complete.
  void read(ContactState& out) const {
#pragma omp parallel for schedule(static)
    for (std::size_t slot = 0; slot < group_.contact.size(); ++slot) {
      if (group_.contact[slot] != inert) read(slot, out);
    }
  }

 private:
  using Vector = Vec3<double>;
  std::size_t words() const { return static_cast<std::size_t>(1 + shape_.view.units); }
  /// Returns the displacement (first = 0) or rotation (first = 4) of a body.
  Vector moved(std::int32_t body, std::size_t first) const {
    const double* u = &displacement_[static_cast<std::size_t>(body) * displacement_words + first];
    return {u[0], u[1], u[2]};
  }

  /// Fills in the entries of the contact in one slot.
  void read(std::size_t slot, ContactState& out) const {
    const std::uint32_t number = group_.contact[slot];
    const Contact& c = network_.contacts[number];
    const std::int32_t a = layout_.body_of(c.a), b = layout_.body_of(c.b);
    const Twist<double> of_a{moved(a, 0), moved(a, 4)}, of_b{moved(b, 0), moved(b, 4)};
    const Placement<double> frame = placement(slot, c, of_b.linear - of_a.linear);
    double u[6];
    relative_rates(frame, of_a, of_b, u);
    std::copy(u, u + 6, out.relative[number].begin());
    double* chain = &out.chain[out.chain_begin[number]];
    const FacetLoad<double> load = shape_.by_points ? points(slot, c, u, chain) : condensed(slot, c, u, chain);
    read_breaks(c, chain, number, out);
    read_cracks(c, chain, out.point_cracks);
    out.force[number] = load.n * frame.n + load.s * frame.s + load.t * frame.t;
    out.moment[number] = load.moment_n * frame.n + load.moment_s * frame.s + load.moment_t * frame.t;
  }

  /// Counts broken points. `chain`: the numbers of the contact's points, one point after another.
  void read_breaks(const Contact& c, [[maybe_unused]] const double* chain, std::uint32_t number,
                   ContactState& out) const {
    if (out.point_breaks.empty()) return;  // no law of the scene can break
    const std::uint32_t points = c.point_end - c.point_begin;
    std::uint32_t broken = 0;
    for (std::uint32_t j = 0; j < points; ++j) {
      Break how = Break::none;
      if constexpr (breakable_law<L>) how = parameters_.break_of(chain + 3 * j * words());
      out.point_breaks[c.point_begin + j] = how;
      broken += how != Break::none;
    }
    out.broken[number] = points == 0 ? 0 : double(broken) / double(points);
  }

  void read_cracks(const Contact& c, [[maybe_unused]] const double* chain,
                   std::vector<laws::PointCrack>& cracks) const {
    if (cracks.empty()) return;  // no law of the scene has a crack
    for (std::uint32_t j = 0; j < c.point_end - c.point_begin; ++j) {
      laws::PointCrack crack;
      if constexpr (cracking_law<L>) crack = parameters_.crack_of(chain + 3 * j * words());
      cracks[c.point_begin + j] = crack;
    }
  }

  /// Returns the current frame by Eq. 5–7. `apart`: displacement of B minus displacement of A.
  Placement<double> placement(std::size_t slot, const Contact& c, const Vector& apart) const {
    Placement<double> out = initial_placement(c);
    if (!updated_) return out;
    follow_branch(out, c.n, c.distance, c.distance * c.n + apart, shape_.view.wall);
    const std::size_t lanes = shape_.lanes, count = static_cast<std::size_t>(shape_.view.frame_words);
    const auto* stored = &state_.frame[slot / lanes * count * lanes + slot % lanes];
    const Vector s{double(stored[0]), double(stored[lanes]), double(stored[2 * lanes])};
    const double pending = count == 4 ? stored[3 * lanes] : 0;
    out.s = spun(swung(s, out.n, out.n), out.n, pending);
    out.t = cross(out.n, out.s);
    return out;
  }

  /// Returns the factor by which rock in series reduces f of a stateless contact, in a normal or a shear component.
  double series_factor(const Contact& c, bool shear) const {
    if constexpr (series_law<L>) {
      const auto factors = SeriesFactors<double>::of(c.series, law_.step_stiffness(), alpha_);
      if (c.series != 0) return shear ? factors.shear : factors.normal;
    }
    return 1;
  }

  /// Returns the force density f of a chain and copies the chain's numbers to `out`. For a stateless contact, computes
  /// f from the displacement x and the factor of rock in series.
  double chain(std::size_t layer, int component, std::size_t lane, double x, double factor, double* out) const {
    if constexpr (memoryless_law<L>) {
      if (shape_.stateless) {
        std::fill(out + 1, out + words(), 0.0);
        return *out = factor * law_.value(x);
      }
    }
    const auto at = (layer * static_cast<std::size_t>(shape_.view.components) + static_cast<std::size_t>(component)) *
                    words() * shape_.lanes;
    for (std::size_t w = 0; w < words(); ++w) out[w] = state_.chain[at + w * shape_.lanes + lane];
    return out[0];
  }

  /// Returns the load of a contact whose facet has one set of chains (condensed form), and copies these chains to
  /// `out`.
  FacetLoad<double> condensed(std::size_t slot, const Contact& c, const double (&u)[6], double* out) const {
    double f[6] = {0, 0, 0, 0, 0, 0};
    for (int k = 0; k < shape_.view.components; ++k) {
      double* own = out + static_cast<std::size_t>(k) * words();
      f[k] = chain(slot / shape_.lanes, k, slot % shape_.lanes, u[k], series_factor(c, k >= 3), own);
      if (!state_.change.empty() && !shape_.stateless)
        *own = f[k] += state_.change[6 * slot + static_cast<std::size_t>(k)];
    }
    std::fill(out + static_cast<std::size_t>(shape_.view.components) * words(), out + 6 * words(), 0.0);
    double moments[6];
    moments_over_length(c, moments);
    return condensed_load(f, alpha_, moments);
  }

  /// Returns the load of a contact whose points have chains of their own (points form), and copies these chains to
  /// `out`.
  FacetLoad<double> points(std::size_t slot, const Contact& c, const double (&u)[6], double* out) const {
    FacetLoad<double> load;
    for (std::uint32_t j = 0; j < c.point_end - c.point_begin; ++j) {
      const std::uint32_t point = c.point_begin + j;
      const double s = network_.point_s[point], t = network_.point_t[point],
                   weight = network_.point_area[point] / c.length;
      const double x[3] = {u[0] + s * u[1] + t * u[2], u[3] - t * u[5], u[4] + s * u[5]};
      double f[3] = {0, 0, 0};
      for (int k = 0; k < shape_.view.components; ++k) {
        const std::size_t layer = group_.packet_layer[slot / shape_.lanes] + j;
        f[k] = weight * chain(layer, k, slot % shape_.lanes, x[k], series_factor(c, k > 0),
                              out + (3 * j + static_cast<std::size_t>(k)) * words());
      }
      std::fill(out + (3 * j + static_cast<std::size_t>(shape_.view.components)) * words(), out + 3 * (j + 1) * words(),
                0.0);
      const double along_s = alpha_ * f[1], along_t = alpha_ * f[2];
      load.n += f[0], load.s += along_s, load.t += along_t;
      load.moment_s += t * f[0], load.moment_t -= s * f[0], load.moment_n += s * along_t - t * along_s;
    }
    return load;
  }

  const ContactNetwork& network_;
  const Layout& layout_;
  const GroupLayout& group_;
  const L& parameters_;
  typename L::template Step<double> law_;
  GroupShape<P> shape_;
  bool updated_;
  double alpha_;
  const std::vector<double>& displacement_;
  GroupState<P> state_;
};

}  // namespace macadam::kernels
