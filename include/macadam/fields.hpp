// SPDX-License-Identifier: GPL-3.0-or-later
/// \file fields.hpp  Particles, contacts and Laguerre cells as files for viewers: VTKHDF, or VTK's XML.
///
/// A mesh is what is drawn, a frame the numbers on it at one time. docs/fields.md lists every array.
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
#include "macadam/tessellation.hpp"

namespace macadam {

/// `vtkhdf`: one file a series (VTKHDF 2.0, in HDF5). `vtp`: one file a frame (VTK's XML) and a list of them, `.pvd`.
enum class FieldFormat : std::uint8_t { vtkhdf, vtp };

/// What of `[output]` asks for fields.
struct FieldSpec {
  bool particles = false, contacts = false, cells = false;
  /// Samples of a stepped run from one frame to the next; none: a twentieth of a cycle's, or of a test's without
  /// cycles.
  std::optional<int> every;
  FieldFormat format = FieldFormat::vtkhdf;

  bool any() const { return particles || contacts || cells; }
  int stride(int samples) const { return every.value_or(std::max(1, samples / 20)); }
};

/// One array: `components` numbers for each particle, contact or polygon, one after another.
struct FieldArray {
  std::string name, unit;  ///< unit `"1"` for pure numbers, several with commas where components differ
  int components = 1;
  std::variant<std::vector<float>, std::vector<std::int32_t>> values;
};

/// What is drawn: points, and cells that join them.
struct FieldMesh {
  enum class Shape : std::uint8_t { vertices, lines, polygons };
  Shape shape = Shape::vertices;
  std::vector<float> points;               ///< x y z of each [m]
  std::vector<std::int64_t> connectivity;  ///< points of one cell after another
  std::vector<std::int64_t> offsets;       ///< where in `connectivity` each cell begins, and its end
  std::vector<FieldArray> arrays;          ///< what does not change; for each point of vertices, else for each cell

  std::size_t point_count() const { return points.size() / 3; }
  std::size_t cell_count() const { return offsets.size() - 1; }
};

/// A vertex for each particle. `aggregates` (may be empty): those of a generated specimen, which know their class.
FieldMesh particle_mesh(const Specimen& specimen, const std::vector<Aggregate>& aggregates);
/// A line for each contact, in network order: from centre to centre, or from the centre to the wall.
FieldMesh contact_mesh(const Specimen& specimen, const ContactNetwork& network);
/// The facets of all cells as polygons. One between two cells is there twice, once for each, so that what is left of a
/// threshold is closed; normals point out of the cell.
FieldMesh cell_mesh(const Specimen& specimen, const Tessellation& tessellation,
                    const std::vector<Aggregate>& aggregates);

/// The numbers of one moment. A list that nobody asked for is empty.
struct FieldFrame {
  double time = 0;                              ///< [s]
  std::vector<FieldArray> particles, contacts;  ///< specimen order, network order
};

/// Arrays of a stepped run: displacement, rotation, velocity, spin, force and moment of the particles.
std::vector<FieldArray> particle_arrays(const ParticleState& state);
/// Mean stress in the Laguerre cell of each particle, model (8.3): xx, yy, zz, xy, yz, xz, tension positive [Pa].
/// Volumes, arms and facets are those of the start.
FieldArray stress_array(const Tessellation& tessellation, const ContactNetwork& network, const ContactState& state);
/// Returns normal and shear force, force, moment and relative displacement; for contacts in condensed form the stretch
/// of each Kelvin unit; where a law can break `broken`, the fraction of the contact's points that are broken.
/// `displacement`: of the particles, by which normals have turned; empty: normals are those of the start.
std::vector<FieldArray> contact_arrays(const Specimen& specimen, const ContactNetwork& network,
                                       const ContactState& state, const std::vector<Vec3d>& displacement);

/// Arrays of a steady state (HarmonicResult::motion) while the top wall moves as amplitude·cos ωt: real and imaginary
/// part of what is multiplied by e^(iωt), amplitude and phase.
std::vector<FieldArray> particle_arrays(const std::vector<std::complex<double>>& motion, double amplitude);
/// Forces by the complex stiffness of the laws at this frequency, about the geometry of the start.
std::vector<FieldArray> contact_arrays(const ContactNetwork& network, const LawTable& laws, double frequency_hz,
                                       const std::vector<std::complex<double>>& motion, double amplitude);

/// A file to which frames are added; after each it is whole, whatever becomes of the program.
class FieldSeries {
 public:
  virtual ~FieldSeries() = default;
  /// Frames in the file.
  virtual std::size_t size() const = 0;
  /// Adds one; all of a series have the same arrays. \throws RunError naming the file (disk full, no folder).
  virtual void add(double time, const std::vector<FieldArray>& arrays) = 0;
  /// After the last: some file systems say only where a file is closed that they could not write it. \throws RunError
  virtual void end() {}
};

/// Begins a series: `stem` is the file's path without its ending. Nothing is there before the first frame is. With
/// `until`, goes on with the one that is there, of which frames from this time on are dropped, or begins where there is
/// none. \throws InputError naming a file that is there and is no series of this mesh.
std::unique_ptr<FieldSeries> begin_fields(const std::filesystem::path& stem, FieldFormat format, FieldMesh mesh,
                                          std::optional<double> until = {});

/// Writes a mesh without time, with these arrays beside its own. \throws RunError naming the file.
void write_fields(const std::filesystem::path& stem, FieldFormat format, FieldMesh mesh,
                  std::vector<FieldArray> arrays = {});

}  // namespace macadam
