// SPDX-License-Identifier: GPL-3.0-or-later
// dual_point.cpp  Solves for the dual point by Cramer's rule in double precision, or exactly if the tetrahedron is
// nearly flat.
#include "host/tessellation/dual_point.hpp"

#include <CGAL/MP_Float.h>

#include <cmath>

namespace macadam {
namespace {

/// Solves 2·q_k·c = b_k for k = 0, 1, 2 by Cramer's rule. Stores the numerators of c and their common denominator.
template <class T>
struct Cramer {
  T nx, ny, nz, den;

  Cramer(const std::array<Vec3<T>, 3>& q, const std::array<T, 3>& b) {
    const Vec3<T> q12 = cross(q[1], q[2]), q20 = cross(q[2], q[0]), q01 = cross(q[0], q[1]);
    nx = b[0] * q12.x + b[1] * q20.x + b[2] * q01.x;
    ny = b[0] * q12.y + b[1] * q20.y + b[2] * q01.y;
    nz = b[0] * q12.z + b[1] * q20.z + b[2] * q01.z;
    den = T(2) * dot(q[0], q12);
  }
};

/// The equations for the dual point, in coordinates relative to the first site. The first site is a particle if any of
/// the four sites is. Bounding sites are so far away that the vectors from a bounding site to the other sites would be
/// nearly parallel.
class Equations {
 public:
  Equations(const WeightedSites& sites, const SiteNumbers& number) {
    for (int k = 0; k < 4; ++k) site_[k] = sites[number[k]];
  }

  Vec3d origin() const { return site_[0].centre; }

  /// Writes the equations in number type T.
  template <class T>
  void write(std::array<Vec3<T>, 3>& q, std::array<T, 3>& b) const {
    const WeightedSite& o = site_[0];
    for (int k = 0; k < 3; ++k) {
      const WeightedSite& p = site_[k + 1];
      q[k] = {T(p.centre.x) - T(o.centre.x), T(p.centre.y) - T(o.centre.y), T(p.centre.z) - T(o.centre.z)};
      b[k] = dot(q[k], q[k]) + (T(o.weight) - T(p.weight));
    }
  }

 private:
  std::array<WeightedSite, 4> site_;
};

Vec3d exactly(const Equations& equations) {
  using Exact = CGAL::MP_Float;  // adds and multiplies doubles without rounding
  std::array<Vec3<Exact>, 3> q;
  std::array<Exact, 3> b;
  equations.write(q, b);
  const Cramer<Exact> c(q, b);
  const double den = CGAL::to_double(c.den);  // not 0, because the triangulation contains no exactly flat tetrahedron
  return equations.origin() +
         Vec3d{CGAL::to_double(c.nx) / den, CGAL::to_double(c.ny) / den, CGAL::to_double(c.nz) / den};
}

}  // namespace

Vec3d dual_point(const WeightedSites& sites, const SiteNumbers& number) {
  const Equations equations(sites, number);
  std::array<Vec3d, 3> q;
  std::array<double, 3> b;
  equations.write(q, b);
  const Cramer<double> c(q, b);
  // The flatness of the tetrahedron is |det(q₀, q₁, q₂)| / (|q₀|·|q₁|·|q₂|). Rounding moves the dual point by about
  // ε·|q| divided by the flatness. Below a flatness of 1e-3 this error would be visible in the facets, so the equations
  // are solved exactly. (For a flat tetrahedron of nearly cospherical sites, rounding could place the dual point
  // anywhere on a line.)
  constexpr double flat = 1e-3;
  if (std::abs(c.den) > 2 * flat * norm(q[0]) * norm(q[1]) * norm(q[2]))
    return equations.origin() + Vec3d{c.nx / c.den, c.ny / c.den, c.nz / c.den};
  return exactly(equations);
}

}  // namespace macadam
