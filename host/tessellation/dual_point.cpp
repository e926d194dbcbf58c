// SPDX-License-Identifier: GPL-3.0-or-later
// dual_point.cpp  Cramer's rule in double, and exactly where a tetrahedron is flat.
#include "host/tessellation/dual_point.hpp"

#include <CGAL/MP_Float.h>

#include <cmath>

namespace macadam {
namespace {

/// 2·q_k·c = b_k for k = 0, 1, 2 by Cramer's rule: numerators of c and their common denominator.
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

/// Relative to the first site, which is a particle where any is: bounding sites are so far away that differences from
/// them would be nearly parallel.
class Equations {
 public:
  Equations(const WeightedSites& sites, const SiteNumbers& number) {
    for (int k = 0; k < 4; ++k) site_[k] = sites[number[k]];
  }

  Vec3d origin() const { return site_[0].centre; }

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
  using Exact = CGAL::MP_Float;  // sums and products of doubles without rounding
  std::array<Vec3<Exact>, 3> q;
  std::array<Exact, 3> b;
  equations.write(q, b);
  const Cramer<Exact> c(q, b);
  const double den = CGAL::to_double(c.den);  // not 0: the triangulation has no exactly flat tetrahedron
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
  // Rounding moves c by about ε·|q|/flatness: below 1e-3 the error would show in the facets, so it is done exactly.
  // (The dual of a flat tetrahedron of nearly cospherical sites may lie anywhere on a line when rounded badly.)
  constexpr double flat = 1e-3;
  if (std::abs(c.den) > 2 * flat * norm(q[0]) * norm(q[1]) * norm(q[2]))
    return equations.origin() + Vec3d{c.nx / c.den, c.ny / c.den, c.nz / c.den};
  return exactly(equations);
}

}  // namespace macadam
