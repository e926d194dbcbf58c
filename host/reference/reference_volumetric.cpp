// SPDX-License-Identifier: GPL-3.0-or-later
// reference_volumetric.cpp  Computes the stiffness matrix K from the energy W = Σ ½·A_J·Δuᵀ·κ·Δu over the contact
// points + Σ ½·2μ/h·A·w² over the free facets + Σ ½·λ·V·θ² over the cells. Every term is a stiffness times the square
// of a row that is linear in the unknowns, so K is a sum of outer products of such rows.
#include "host/reference/reference_volumetric.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>

#include "host/reference/reference_contact.hpp"
#include "macadam/error.hpp"

namespace macadam::reference {
namespace {

using Complex = std::complex<double>;
/// A sum of unknowns times factors: the factor of each unknown, by the index of the unknown.
using Row = std::map<Eigen::Index, Complex>;

Complex two_mu(const PhaseModuli& m) { return m.E / (1 + m.poisson_ratio); }
Complex lambda(const PhaseModuli& m) {
  return m.E * m.poisson_ratio / ((1 + m.poisson_ratio) * (1 - 2 * m.poisson_ratio));
}

void add(Row& to, const Row& from, Complex factor) {
  for (const auto& [k, x] : from) to[k] += factor * x;
}

/// A facet that is not a contact, or the part of a facet that a notch removed from its contact.
struct FreeFacet {
  const Facet* facet;
  std::int32_t particle;  ///< on one of its sides
  double area;            ///< [m²]
};

class Assembly {
 public:
  Assembly(const Specimen& specimen, const ContactNetwork& network, const PhaseModuli& mastic, const PhaseModuli& rock)
      : specimen_(specimen), network_(network), mastic_(mastic), rock_(rock), dilatation_(specimen.size()) {}

  VolumetricMatrix assemble(const Tessellation& tessellation, const std::vector<double>& in_rock) {
    const auto particles = static_cast<std::int32_t>(specimen_.size());
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> contact_of;
    for (std::size_t c = 0; c < network_.contacts.size(); ++c)
      contact_of[{network_.contacts[c].a, network_.contacts[c].b}] = c;
    std::vector<FreeFacet> free;
    for (const Facet& f : tessellation.facets) {
      const auto contact = contact_of.find({f.a, f.b});
      double area = f.area;
      if (contact != contact_of.end()) area -= network_.contacts[contact->second].area;
      if (area <= 1e-12 * f.area) continue;
      if (f.a < particles) free.push_back({&f, f.a, area});
      if (f.b >= 0 && f.b < particles) free.push_back({&f, f.b, area});
    }
    VolumetricMatrix out;
    out.particles = specimen_.size(), out.free_facets = free.size();
    top_ = static_cast<Eigen::Index>(6 * out.particles + out.free_facets);
    for (std::size_t c = 0; c < network_.contacts.size(); ++c) add_contact(network_.contacts[c], in_rock[c]);
    for (std::size_t k = 0; k < free.size(); ++k) add_free(free[k], static_cast<Eigen::Index>(6 * out.particles + k));
    for (std::size_t i = 0; i < out.particles; ++i) {
      const double volume = tessellation.cell_volume[i];  // dilatation_ holds V·θ
      square(dilatation_[i], lambda(phase(static_cast<std::int32_t>(i))) / volume);
    }
    out.K.resize(top_ + 1, top_ + 1);
    out.K.setFromTriplets(entries_.begin(), entries_.end());
    return out;
  }

 private:
  const PhaseModuli& phase(std::int32_t particle) const {
    return specimen_.phase[static_cast<std::size_t>(particle)] == Phase::mastic ? mastic_ : rock_;
  }

  /// Adds stiffness·rowᵀ·row to K.
  void square(const Row& row, Complex stiffness) {
    for (const auto& [i, x] : row)
      for (const auto& [j, y] : row) entries_.emplace_back(i, j, stiffness * x * y);
  }

  /// Returns the displacement along `e` of the material point at `lever` from the centre of a particle, or of a wall.
  Row displacement(std::int32_t end, const Vector3d& lever, const Vector3d& e) const {
    Row out;
    if (end < 0) {
      if (end == wall_z_hi) out[top_] = e.z();
      return out;
    }
    const Vector3d turn = lever.cross(e);  // (θ × lever)·e = θ·(lever × e)
    for (int k = 0; k < 3; ++k) {
      out[6 * static_cast<Eigen::Index>(end) + k] = e[k];
      out[6 * static_cast<Eigen::Index>(end) + 3 + k] = turn[k];
    }
    return out;
  }

  /// Adds the springs of a contact to K, and its contributions to the dilatations of the two cells.
  void add_contact(const Contact& contact, double in_rock) {
    const ReferenceContact geometry = make_reference_contact(network_, contact, 0);
    const double d = contact.distance, outside = d - in_rock;
    const Complex mu = two_mu(mastic_) / 2.0, of_mastic = two_mu(mastic_), of_rock = two_mu(rock_);
    Complex normal, shear;  // compliance times area
    if (contact.pair == PairType::inner || contact.pair == PairType::aw) {
      normal = shear = d / of_rock;
    } else if (contact.pair == PairType::aa) {
      const double film = std::max(outside, 1e-9 * d);
      normal = (d - film) / of_rock + film / (lambda(mastic_) + 2.0 * mu);
      shear = (d - film) / of_rock + film / mu;
    } else {
      double film = std::max(outside, 0.05 * d);
      if (contact.pair == PairType::ma) film = std::min(film, 0.95 * d);
      normal = shear = (film == d ? 0.0 : (d - film) / of_rock) + film / of_mastic;
    }
    const Complex kappa_n = 1.0 / normal, kappa_s = geometry.at_wall() ? Complex(0) : 1.0 / shear;
    const ContactFrame& frame = geometry.frame;
    const auto relative = [&](const ContactPoint& p, const Vector3d& e) {
      Row out = displacement(contact.b, geometry.at_wall() ? Vector3d::Zero().eval() : frame.lever_b(p), e);
      add(out, displacement(contact.a, frame.lever_a(p), e), -1);
      return out;
    };
    double area = 0;
    ContactPoint centroid;
    for (const ContactPoint& p : geometry.points) {
      square(relative(p, frame.n), kappa_n * p.area);
      square(relative(p, frame.s), kappa_s * p.area);
      square(relative(p, frame.t), kappa_s * p.area);
      area += p.area, centroid.s += p.area * p.s, centroid.t += p.area * p.t;
    }
    centroid.s /= area, centroid.t /= area;
    // V·θ += ± A·s·Δū·(x_f − x), with s = κ/2μ of the cell's phase
    const auto dilate = [&](std::int32_t end, const Vector3d& lever, double sign) {
      if (end < 0) return;
      Row& to = dilatation_[static_cast<std::size_t>(end)];
      const Complex share = sign * area / two_mu(phase(end));
      add(to, relative(centroid, frame.n), share * kappa_n * lever.dot(frame.n));
      add(to, relative(centroid, frame.s), share * kappa_s * lever.dot(frame.s));
      add(to, relative(centroid, frame.t), share * kappa_s * lever.dot(frame.t));
    };
    dilate(contact.a, frame.lever_a(centroid), 1);
    if (!geometry.at_wall()) dilate(contact.b, frame.lever_b(centroid), -1);
  }

  /// Adds a free facet of a particle, whose opening is the unknown `number`.
  void add_free(const FreeFacet& free, Eigen::Index number) {
    const Facet& f = *free.facet;
    const std::int32_t particle = free.particle;
    const Vector3d out = (f.a == particle ? 1 : -1) * to_eigen(f.normal);
    const double h = out.dot(to_eigen(f.centroid - specimen_.centre[static_cast<std::size_t>(particle)]));
    // a facet that lies beyond the centre keeps its opening at zero
    if (h > 0) dilatation_[static_cast<std::size_t>(particle)][number] += free.area;
    square({{number, 1.0}}, two_mu(phase(particle)) * free.area / std::abs(h));
  }

  const Specimen& specimen_;
  const ContactNetwork& network_;
  const PhaseModuli &mastic_, &rock_;
  std::vector<Row> dilatation_;  ///< V·θ of each cell
  std::vector<Eigen::Triplet<Complex>> entries_;
  Eigen::Index top_ = 0;
};

}  // namespace

VolumetricMatrix assemble_volumetric(const Specimen& specimen, const Tessellation& tessellation,
                                     const ContactNetwork& network, const std::vector<double>& in_rock,
                                     const PhaseModuli& mastic, const PhaseModuli& rock) {
  if (in_rock.size() != network.contacts.size())
    throw InputError("reference", 0, "lengths in rock", std::to_string(in_rock.size()),
                     std::to_string(network.contacts.size()) + ", one per contact");
  return Assembly(specimen, network, mastic, rock).assemble(tessellation, in_rock);
}

}  // namespace macadam::reference
