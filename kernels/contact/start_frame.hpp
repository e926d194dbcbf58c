// SPDX-License-Identifier: GPL-3.0-or-later
/// \file start_frame.hpp  Computes the initial frame and the initial states of the Kelvin chains of a contact, for a
/// run that starts from the steady state instead of from rest (docs/model.md, section 18).
#pragma once

#include "macadam/stepper.hpp"

namespace macadam::kernels {

/// Returns the tangent ŝ of a contact at step −1, where a run from the steady state begins. It is the tangent of the
/// undeformed contact, turned by the smallest rotation that takes the initial normal to the current one, then about the
/// normal by the mean rotation of the two particles.
inline Vec3d carried_to_start(const Contact& c, const StartState& start) {
  const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
  const Vec3d branch = c.b >= 0 ? c.distance * c.n + (start.displacement[b] - start.displacement[a]) : c.n;
  const Vec3d n = (1 / norm(branch)) * branch;
  const Vec3d turn = 0.5 * (start.rotation[a] + (c.b >= 0 ? start.rotation[b] : Vec3d{}));
  const Vec3d swung = c.s - (dot(c.s, n) / (1 + dot(c.n, n))) * (c.n + n);
  const double angle = dot(turn, n);
  const Vec3d spun = std::cos(angle) * swung + std::sin(angle) * cross(n, swung);
  return (1 / norm(spun)) * spun;
}

/// Computes the chains of the points of a facet from the six chains of the facet, which have `words` numbers each. A
/// point (s, t) follows the rigid motion of the facet and the law is linear, so the chains of a point are linear
/// combinations of the facet's six chains.
struct StartChain {
  const double* six;
  std::size_t words;
  /// Returns word `word` of a chain of the facet.
  double facet(int component, std::size_t word) const {
    return six[static_cast<std::size_t>(component) * words + word];
  }
  /// Returns word `word` of a chain of the point (s, t).
  double point(int component, std::size_t word, double s, double t) const {
    switch (component) {
      case 0:
        return facet(0, word) + s * facet(1, word) + t * facet(2, word);
      case 1:
        return facet(3, word) - t * facet(5, word);
      default:
        return facet(4, word) + s * facet(5, word);
    }
  }
};

}  // namespace macadam::kernels
