// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fields.hpp  Writes particles, contacts and Laguerre cells to files for viewers, in VTKHDF or VTK's XML format.
///
/// A mesh holds the geometry that is drawn. A frame holds the numbers on a mesh at one time. docs/fields.md lists every
/// array.
#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "macadam/contact_network.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/specimen.hpp"
#include "macadam/stepper.hpp"
#include "macadam/wall_motion.hpp"
#include "macadam/tessellation.hpp"

namespace macadam {

/// `vtkhdf`: one file per series (VTKHDF 2.0, in HDF5). `vtp`: one file per frame (VTK's XML) and a list of them,
/// `.pvd`.
enum class FieldFormat : std::uint8_t { vtkhdf, vtp };

/// The part of `[output]` that asks for fields.
struct FieldSpec {
  bool particles = false, contacts = false, cells = false;
  /// Number of samples of a stepped run between two frames. Empty: a twentieth of the samples of a cycle or, for tests
  /// without cycles, of the test.
  std::optional<int> every;
  FieldFormat format = FieldFormat::vtkhdf;

  bool any() const { return particles || contacts || cells; }
  int stride(int samples) const { return every.value_or(std::max(1, samples / 20)); }
};

/// One array: `components` numbers for each particle, contact or polygon; the items are consecutive.
struct FieldArray {
  std::string name, unit;  ///< unit "1" for pure numbers; several units separated by commas if components differ
  int components = 1;
  std::variant<std::vector<float>, std::vector<std::int32_t>> values;
};

/// A mesh: points, and cells that connect them.
struct FieldMesh {
  enum class Shape : std::uint8_t { vertices, lines, polygons };
  Shape shape = Shape::vertices;
  std::vector<float> points;               ///< x y z of each point [m]
  std::vector<std::int64_t> connectivity;  ///< point numbers of the cells, one cell after another
  /// Index in `connectivity` at which each cell begins; the last entry is the size of `connectivity`.
  std::vector<std::int64_t> offsets;
  std::vector<FieldArray> arrays;  ///< constant arrays: one item per point if the cells are vertices, else one per cell

  std::size_t point_count() const { return points.size() / 3; }
  std::size_t cell_count() const { return offsets.size() - 1; }
};

/// Returns a mesh with one vertex per particle. `aggregates`: the aggregates of a generated specimen, which have size
/// classes; may be empty.
FieldMesh particle_mesh(const Specimen& specimen, const std::vector<Aggregate>& aggregates);
/// Returns a mesh with one line per contact, in network order, from centre to centre or from a centre to a wall.
FieldMesh contact_mesh(const Specimen& specimen, const ContactNetwork& network);
/// Returns the facets of all cells as polygons. A facet between two cells appears twice, once for each cell, so that
/// any selection of cells has a closed surface. Normals point out of the cell.
FieldMesh cell_mesh(const Specimen& specimen, const Tessellation& tessellation,
                    const std::vector<Aggregate>& aggregates);

/// Returns the facets of the contacts whose law has a crack, as polygons, in network order.
FieldMesh crack_mesh(const Tessellation& tessellation, const ContactNetwork& network, const FactsTable& laws);

/// The numbers at one time. Lists that the scene does not request are empty.
struct FieldFrame {
  double time = 0;                              ///< [s]
  std::vector<FieldArray> particles, contacts;  ///< specimen order, network order
};

/// Returns displacement, rotation, velocity, spin, force and moment of the particles in a stepped run.
std::vector<FieldArray> particle_arrays(const ParticleState& state);
/// Returns the mean stress in the Laguerre cell of each particle, model (8.3): xx, yy, zz, xy, yz, xz, tension positive
/// [Pa]. The initial volumes, lever arms and facets are used.
FieldArray stress_array(const Tessellation& tessellation, const ContactNetwork& network, const ContactState& state);
/// Returns normal and shear force, force vector, moment and relative displacement of the contacts. In condensed form
/// the stretch of each Kelvin unit is added. If a law can break, `broken` is added, the fraction of the contact's
/// points that are broken. `displacement`: displacements of the particles, from which the current normals are computed;
/// if empty, the initial normals are used. If a law has a crack, the arrays of crack_arrays() are added, zero for
/// contacts without a crack.
std::vector<FieldArray> contact_arrays(const Specimen& specimen, const ContactNetwork& network,
                                       const ContactState& state, const std::vector<Vec3d>& displacement);

/// Returns opening, slip and damage (means over the facet) and the crack energy per area of the contacts whose law has
/// a crack, in the order of crack_mesh().
std::vector<FieldArray> crack_arrays(const ContactNetwork& network, const FactsTable& laws, const ContactState& state);

/// Returns the arrays of the particles in a steady state in which the top wall moves as `amplitude`·cos ωt. `motion` is
/// HarmonicResult::motion. For every component of a particle's motion, which is the real part of z·e^(iωt), the arrays
/// have the real part, imaginary part, magnitude and phase of z.
std::vector<FieldArray> particle_arrays(const std::vector<std::complex<double>>& motion, double amplitude);
/// Returns the arrays of the contacts in a steady state. Forces are computed from the complex stiffness of the laws at
/// the frequency, with the initial geometry. `wall` is HarmonicResult::wall.
std::vector<FieldArray> contact_arrays(const ContactNetwork& network, const LawTable& laws, double frequency_hz,
                                       const std::vector<std::complex<double>>& motion, double amplitude,
                                       const WallMotion& wall = {});

/// A file to which frames are added. After each frame the file is complete, even if the program is then killed.
class FieldSeries {
 public:
  virtual ~FieldSeries() = default;
  /// Returns the number of frames in the file.
  virtual std::size_t size() const = 0;
  /// Adds a frame; all frames of a series have the same arrays. \throws RunError naming the file (disk full, folder
  /// missing).
  virtual void add(double time, const std::vector<FieldArray>& arrays) = 0;
  /// Closes the file after the last frame, because some file systems report write errors only then. \throws RunError
  virtual void end() {}
};

/// Begins a series. `stem`: path of the file without its ending. No file exists before the first frame is added. With
/// `until`, continues the series in an existing file, from which it removes the frames at this time and later; if the
/// file does not exist, begins a new file. \throws InputError naming a file that exists but is not a series of this
/// mesh.
std::unique_ptr<FieldSeries> begin_fields(const std::filesystem::path& stem, FieldFormat format, FieldMesh mesh,
                                          std::optional<double> until = {});

/// Writes a mesh without time, with `arrays` in addition to the arrays of the mesh. \throws RunError naming the file.
void write_fields(const std::filesystem::path& stem, FieldFormat format, FieldMesh mesh,
                  std::vector<FieldArray> arrays = {});

}  // namespace macadam
