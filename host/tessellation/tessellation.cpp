// SPDX-License-Identifier: GPL-3.0-or-later
/// \file tessellation.cpp  Computes the tessellation: triangulation, facets, cell volumes, and the particles that have
/// no cell.
#include "macadam/tessellation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/tessellation/facets.hpp"
#include "host/tessellation/power_diagram.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Largest radius in units of the box's diagonal. R² enters the position of every facet's plane; with larger radii the
/// rounding of R² would be visible in the facets.
constexpr double largest_radius = 1000;

void check_radii(const Specimen& specimen) {
  const double limit = largest_radius * norm(specimen.box.size);
  for (std::size_t i = 0; i < specimen.size(); ++i)
    if (specimen.radius[i] > limit)
      throw InputError(specimen.source, specimen.line_of(static_cast<std::int64_t>(i)),
                       fmt::format("radius in metres of particle {}", i), fmt::format("{}", specimen.radius[i]),
                       fmt::format("at most {}, which is {} times the diagonal of the box", limit, largest_radius));
}

/// Computes cell volumes as sums of signed pyramids over the facets (a centre may lie outside its own cell). Returns
/// the surface area of each cell.
std::vector<double> measure_cells(const Specimen& specimen, Tessellation& out) {
  std::vector<double> surface(specimen.size(), 0);
  out.cell_volume.assign(specimen.size(), 0);
  for (const Facet& f : out.facets) {
    surface[f.a] += f.area;
    if (f.b < 0) {
      out.cell_volume[f.a] -= f.area * height_above_wall(specimen.box, f, specimen.centre[f.a]) / 3;
      continue;
    }
    const Bisector plane(specimen, f.a, f.b);
    surface[f.b] += f.area;
    out.cell_volume[f.a] += f.area * plane.arm / 3;
    out.cell_volume[f.b] += f.area * (plane.distance - plane.arm) / 3;
  }
  return surface;
}

/// Sets `active` to 0 for the particles whose cells have no volume. Returns whether any of these cells had facets. A
/// cell with facets but without volume is a thin sheet between two other cells, or between a cell and a wall; only
/// rounding creates such a sheet. The tolerance 1e-10 is the tolerance of the facets.
bool retire_empty_cells(const Tessellation& tessellation, const std::vector<double>& surface,
                        std::vector<std::uint8_t>& active) {
  bool again = false;
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (!active[i] || tessellation.cell_volume[i] > 1e-10 * surface[i] * std::sqrt(surface[i])) continue;
    active[i] = 0;
    again = again || surface[i] > 0;
  }
  return again;
}

}  // namespace

Tessellation tessellate(const Specimen& particles) {
  validate(particles, particles.source);
  const Specimen specimen = with_voids_as_cells(particles);
  check_radii(specimen);
  Tessellation out;
  std::vector<std::uint8_t> active(specimen.size(), 1);
  for (bool again = true; again;) {  // a second pass, rarely needed, joins the two cells beside a removed sheet
    make_facets(specimen, power_diagram(specimen, active), out);
    again = retire_empty_cells(out, measure_cells(specimen, out), active);
  }
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (active[i]) continue;
    out.cell_volume[i] = 0;
    out.hidden.push_back(static_cast<std::int32_t>(i));
  }
  return out;
}

std::vector<std::int32_t> particles_without_cell(const Specimen& specimen) { return tessellate(specimen).hidden; }

}  // namespace macadam
