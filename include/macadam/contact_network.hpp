// SPDX-License-Identifier: GPL-3.0-or-later
/// \file contact_network.hpp  Makes the contacts of a specimen from the facets of its tessellation: points, frames,
/// lever arms, area moments.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "macadam/laws/facts.hpp"
#include "macadam/notch.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// The pair of materials that a contact joins (m: mastic, a: aggregate, w: wall). `inner`: two spheres of the same
/// aggregate.
enum class PairType : std::uint8_t { mm, ma, aa, inner, aw, mw };
inline constexpr int particle_pair_types = 4;  ///< number of pair types without a wall, which are the first ones
/// Returns "M-M", "M-A", "A-A", "inner", "A-W" or "M-W".
const char* to_string(PairType pair);

/// The way in which area moments are computed. `lumped`: from the contact points, as in [1]; `exact`: from the polygon
/// (condensed form only); `one_point`: the whole area at the centroid, without resistance to bending and twist.
enum class Quadrature : std::uint8_t { lumped, exact, one_point };
const char* to_string(Quadrature);

/// The way in which a contact gets its stiffness (docs/model/contacts.md, section 25). `centres`: each pair of
/// materials has a law, which acts over the distance of the centres; `series`: each phase has a law, and mastic and
/// rock act in series over the parts of the line of centres that lie in them; `volumetric`: as `series`, with the shear
/// moduli of the phases, and the cell of each particle resists a change of its volume (section 26).
enum class ContactRule : std::uint8_t { centres, series, volumetric };
const char* to_string(ContactRule);
/// Returns whether a scene with this rule has one law for each phase, from which the laws of the pairs follow.
constexpr bool has_laws_of_phases(ContactRule rule) { return rule != ContactRule::centres; }

/// Volumes of the cells of voids. `spheres`: the weights are the squared radii, so cells are larger than their spheres
/// (tessellate()); `volume`: each cell has the volume of its sphere (tessellate_with_void_volumes()).
enum class VoidCells : std::uint8_t { spheres, volume };

/// Limits within which a facet between two particles becomes a contact. Without limits, every facet becomes a contact.
struct FacetLimits {
  std::optional<double> gap_max;   ///< largest surface gap, over the mean of the two radii
  std::optional<double> area_min;  ///< smallest facet area, over the mean area of facets between particles
};

/// Rules that decide which facets become contacts.
struct NetworkSpec : FacetLimits {
  /// Limits of single pair types between particles; a limit given here replaces the limit for all pairs.
  std::array<FacetLimits, particle_pair_types> of_pair;
  Quadrature quadrature = Quadrature::lumped;
  bool bottom_top_walls = true;             ///< facets on −z and +z are contacts; with rollers only those within one
  bool lateral_walls = false;               ///< facets on ±x and ±y are contacts
  ContactRule rule = ContactRule::centres;  ///< build_network() ignores it; prepare() applies it to the contacts
  std::optional<VoidCells> void_cells =
      {};  ///< build_network() ignores it; empty: `spheres` for the rule "centres", else `volume`

  std::vector<Notch> notches = {};  ///< no contact crosses a notch

  /// Returns `void_cells` or, if it is empty, the choice that belongs to the rule.
  VoidCells cells_of_voids() const {
    return void_cells.value_or(rule == ContactRule::centres ? VoidCells::spheres : VoidCells::volume);
  }
};

/// Area moments of a facet: Σ A_J, Σ A_J·s, Σ A_J·t, Σ A_J·s², Σ A_J·s·t, Σ A_J·t², in local coordinates about x0:
/// model (3.4).
struct AreaMoments {
  double a = 0, s = 0, t = 0, ss = 0, st = 0, tt = 0;  ///< [m²] [m³] [m³] [m⁴] [m⁴] [m⁴]
};

/// One contact (docs/model.md, section 3). Lever arms have signs: x0 = x_a + arm_a·n = x_b − arm_b·n.
struct Contact {
  std::int32_t a = 0, b = 0;  ///< particle numbers in specimen order; b may be a Wall
  PairType pair = PairType::mm;
  double distance = 0;  ///< d: distance between the centres, or from the centre to the wall [m]
  /// Length of the law's material [m]: a contact whose law has the stiffness k resists an opening with k·area/length.
  /// It equals `distance` unless the network has the rule "series" (docs/model/contacts.md, section 25).
  double length = 0;
  /// Compliance of the rock in series with the law [1/Pa]: the stiffness of the contact is k/(1 + series·k) in place of
  /// k, in shear α·k/(1 + series·α·k). Zero unless the network has the rule "series".
  double series = 0;
  double area = 0;              ///< [m²]
  Vec3d n{}, s{}, t{};          ///< unit frame, n from a to b, s × t = n (canonical_frame of n)
  double arm_a = 0, arm_b = 0;  ///< [m]; arm_b = 0 at a wall
  AreaMoments moments;          ///< computed with the quadrature of the network
  std::uint32_t point_begin = 0, point_end = 0;
};

/// Resistance of a particle's cell to a change of its volume, with the rule "volumetric" (docs/model/contacts.md,
/// section 26).
struct CellStiffness {
  /// λ'·(1 + ν)²/(E·V) [1/m³], with the Poisson's ratio ν and the modulus E of the cell's phase, the volume V of the
  /// cell, and λ' = λ reduced by the free facets of the cell. It depends only on the geometry and on ν.
  double weight = 0;
  PairType law = PairType::mm;  ///< the pair that has the law of the cell's phase: mm or inner
  double reduction = 1;         ///< λ'/λ: 1 without free facets
};

/// The contacts of a specimen, in order of (a, b) like the facets of the tessellation.
struct ContactNetwork {
  std::vector<Contact> contacts;
  std::vector<double> point_s, point_t;  ///< local coordinates of the contact points [m]: vertices, then centroid; if a
                                         ///< notch left a part of a facet, those of each convex piece
  /// A_J: one third of the area of those fan triangles that have J as a corner [m²].
  std::vector<double> point_area;
  std::vector<std::uint32_t> row_begin;  ///< particle i's contacts are rows[row_begin[i] … row_begin[i+1])
  std::vector<std::uint32_t> rows;       ///< contact numbers, ascending in a row
  std::int64_t dropped_gap = 0, dropped_area = 0;
  /// Area of the facets left out because of area_min, over the area of all facets between particles.
  double dropped_share = 0;
  std::vector<NotchCut> notches;                 ///< the effect of each notch of NetworkSpec, in the same order
  std::array<std::int64_t, pair_types> count{};  ///< number of contacts, by PairType
  double second_moment_difference = 0;  ///< of the moment ss + tt, over all contacts: Σ|lumped − exact| / Σ exact
  ContactRule rule = ContactRule::centres;  ///< the rule by which the lengths of the contacts were set
  double rock_modulus = 0;                  ///< with laws of phases: E of the rock in Contact::series [Pa]
  double mastic_poisson_ratio = 0;          ///< with laws of phases: ν in Contact::length
  double rock_poisson_ratio = 0;            ///< with rule "volumetric": ν of the rock
  std::vector<CellStiffness> cells;         ///< with rule "volumetric": one per particle; otherwise empty

  /// Returns the numbers of a particle's contacts, in rising order.
  std::span<const std::uint32_t> row(std::size_t particle) const {
    return {rows.data() + row_begin[particle], row_begin[particle + 1] - row_begin[particle]};
  }
};

/// Computes tangents s and t for a unit normal, without branches (Duff et al. 2017); s × t = n.
void canonical_frame(const Vec3d& n, Vec3d& s, Vec3d& t);

/// Builds the network of a tessellation (Eq. 5–7 for the initial geometry: docs/model.md, section 3). Facets of voids
/// are free surfaces and give no contacts.
///
/// \throws InputError if a particle has no cell (names its number), if no contact remains, or if a notch lies outside
/// the specimen or severs it: cuts off at least 1 % of the particles.
ContactNetwork build_network(const Specimen& specimen, const Tessellation& tessellation, const NetworkSpec& spec = {});

/// Writes contacts.csv with the columns `a,b,pair,area,distance,nx,ny,nz,points`, in the network's order. With the
/// rules "series" and "volumetric" the columns `length,series` follow. \throws RunError.
void write_contacts_csv(const std::filesystem::path& file, const ContactNetwork& network);

}  // namespace macadam
