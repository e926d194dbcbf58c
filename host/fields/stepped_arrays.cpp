// SPDX-License-Identifier: GPL-3.0-or-later
// stepped_arrays.cpp  Converts the state of a stepper to the arrays of a frame.
#include <algorithm>
#include <array>
#include <utility>

#include "host/fields/field_lists.hpp"
#include "macadam/fields.hpp"

namespace macadam {
namespace {

/// Returns the number of Kelvin units of each contact; 0 if the state has no chains. A contact has six chains; each has
/// its force f and the stretch of each unit.
std::vector<int> units_of(const ContactState& state) {
  std::vector<int> out(state.force.size(), 0);
  for (std::size_t c = 0; c + 1 < state.chain_begin.size(); ++c) {
    const std::size_t numbers = state.chain_begin[c + 1] - state.chain_begin[c];
    if (numbers > 0) out[c] = static_cast<int>(numbers / 6) - 1;
  }
  return out;
}

/// Returns the unit normal of a contact after its particles have moved, or the initial normal if `displacement` is
/// empty. The normal at a wall does not turn.
Vec3d turned_normal(const Specimen& specimen, const Contact& c, const std::vector<Vec3d>& displacement) {
  if (c.b < 0 || displacement.empty()) return c.n;
  const auto at = [&](std::int32_t i) {
    const auto particle = static_cast<std::size_t>(i);
    return specimen.centre[particle] + displacement[particle];
  };
  const Vec3d line = at(c.b) - at(c.a);
  return (1 / norm(line)) * line;
}

/// Opening [m], slip [m], damage and crack energy [J/m²] of a contact: means over the points of its facet.
using MeanCrack = std::array<double, 4>;

MeanCrack mean_crack(const ContactNetwork& network, const Contact& contact, const ContactState& state) {
  MeanCrack out{};
  double all = 0;
  for (std::uint32_t j = contact.point_begin; j < contact.point_end; ++j) {
    const laws::PointCrack& point = state.point_cracks[j];
    const double area = network.point_area[j], values[4] = {point.opening, point.slip, point.damage, point.energy};
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += area * values[k];
    all += area;
  }
  if (all > 0)
    for (double& value : out) value /= all;
  return out;
}

/// Adds the arrays of cracks to `arrays`.
void add_cracks(const std::vector<MeanCrack>& cracks, std::vector<FieldArray>& arrays) {
  constexpr std::array<std::pair<const char*, const char*>, 4> names{
      {{"opening", "m"}, {"slip", "m"}, {"damage", "1"}, {"crack_energy", "J/m2"}}};
  for (std::size_t k = 0; k < names.size(); ++k) {
    arrays.push_back(
        tuples(names[k].first, names[k].second, cracks.size(), 1, [&](std::size_t c, int) { return cracks[c][k]; }));
  }
}

}  // namespace

std::vector<FieldArray> crack_arrays(const ContactNetwork& network, const FactsTable& laws, const ContactState& state) {
  std::vector<MeanCrack> cracks;
  for (const Contact& c : network.contacts) {
    if (has_crack(laws, c)) cracks.push_back(mean_crack(network, c, state));
  }
  std::vector<FieldArray> out;
  add_cracks(cracks, out);
  return out;
}

std::vector<FieldArray> particle_arrays(const ParticleState& state) {
  std::vector<FieldArray> out;
  out.push_back(vectors("displacement", "m", state.displacement));
  out.push_back(vectors("rotation", "rad", state.rotation));
  out.push_back(vectors("velocity", "m/s", state.velocity));
  out.push_back(vectors("spin", "rad/s", state.spin));
  out.push_back(vectors("force", "N", state.force));
  out.push_back(vectors("moment", "N m", state.moment));
  return out;
}

// Sums arm times force over the contacts of each particle, model (8.3). The forces on A and B are opposite and act at
// the facet's centroid, x_0 + (S_s·ŝ + S_t·t̂)/A. For B both the arm and the force change sign, so their product does
// not.
FieldArray stress_array(const Tessellation& tessellation, const ContactNetwork& network, const ContactState& state) {
  const std::size_t particles = network.row_begin.size() - 1;
  std::vector<std::array<double, 6>> sum(particles);
  const auto add = [&](std::int32_t particle, const Vec3d& arm, const Vec3d& f) {
    const double outer[6] = {arm.x * f.x,
                             arm.y * f.y,
                             arm.z * f.z,
                             0.5 * (arm.x * f.y + arm.y * f.x),
                             0.5 * (arm.y * f.z + arm.z * f.y),
                             0.5 * (arm.x * f.z + arm.z * f.x)};
    for (std::size_t k = 0; k < 6; ++k) sum[static_cast<std::size_t>(particle)][k] += outer[k];
  };
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    const Contact& c = network.contacts[i];
    const Vec3d aside = (1 / c.moments.a) * (c.moments.s * c.s + c.moments.t * c.t);
    add(c.a, c.arm_a * c.n + aside, state.force[i]);
    if (c.b >= 0) add(c.b, c.arm_b * c.n - aside, state.force[i]);
  }
  return tuples("stress", "Pa", particles, 6, [&](std::size_t i, int k) {
    return sum[i][static_cast<std::size_t>(k)] / tessellation.cell_volume[i];
  });
}

std::vector<FieldArray> contact_arrays(const Specimen& specimen, const ContactNetwork& network,
                                       const ContactState& state, const std::vector<Vec3d>& displacement) {
  const std::size_t contacts = network.contacts.size();
  std::vector<double> normal(contacts), shear(contacts);
  for (std::size_t c = 0; c < contacts; ++c) {
    const Vec3d n = turned_normal(specimen, network.contacts[c], displacement), &force = state.force[c];
    normal[c] = dot(force, n);
    shear[c] = norm(force - normal[c] * n);
  }
  std::vector<FieldArray> out;
  out.push_back(scalars("normal_force", "N", normal));
  out.push_back(scalars("shear_force", "N", shear));
  out.push_back(vectors("force", "N", state.force));
  out.push_back(vectors("moment", "N m", state.moment));
  out.push_back(tuples("relative_displacement", relative_unit, contacts, 6,
                       [&](std::size_t c, int k) { return state.relative[c][static_cast<std::size_t>(k)]; }));
  if (!state.broken.empty()) out.push_back(scalars("broken", "1", state.broken));
  if (!state.point_cracks.empty()) {
    std::vector<MeanCrack> cracks;
    for (const Contact& c : network.contacts) cracks.push_back(mean_crack(network, c, state));
    add_cracks(cracks, out);
  }
  const std::vector<int> units = units_of(state);
  const int most = units.empty() ? 0 : *std::max_element(units.begin(), units.end());
  for (int l = 0; l < most; ++l) {
    out.push_back(tuples("stretch_" + std::to_string(l + 1), relative_unit, contacts, 6, [&](std::size_t c, int k) {
      if (l >= units[c]) return 0.0;
      return state.chain[state.chain_begin[c] + static_cast<std::size_t>(k * (1 + units[c]) + 1 + l)];
    }));
  }
  return out;
}

}  // namespace macadam
