// SPDX-License-Identifier: GPL-3.0-or-later
// forecast_files.cpp  Predicts names and sizes of the files that a run leaves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiments/cyclic/step_rules.hpp"
#include "host/experiments/experiment.hpp"
#include "host/experiments/transient/transient_experiment.hpp"
#include "host/files/result_files.hpp"
#include "host/run/cracks.hpp"
#include "host/run/damaged_contacts.hpp"
#include "host/simulation/forecast_parts.hpp"

namespace macadam {
namespace {

/// Measured bytes per line of a table, or per entry.
constexpr double particle_line = 97, aggregate_line = 75, contact_line = 175, gradation_line = 90, sample_line = 62,
                 load_line = 110, crack_line = 190, damage_line = 260, sweep_line = 150, material_file = 2500,
                 summary_base = 5500, summary_point = 260, summary_frequency = 1200;
/// Bytes per line of the columns `length` and `series` of contacts.csv: two numbers of at most 17 digits.
constexpr double series_columns = 45;

/// Sizes of one series of fields, in bytes per particle or contact.
struct FieldSize {
  double mesh = 0;     ///< size of the mesh in a file of VTK's XML, uncompressed
  double packed = 0;   ///< size of the mesh in a VTKHDF file, whose whole numbers are compressed
  double frame = 0;    ///< size of the arrays of one frame
  double entries = 0;  ///< number of particles or contacts
};

/// Adds names and sizes of all files to a forecast.
class FileForecast {
 public:
  FileForecast(const Scene& scene, Forecast& forecast) : scene_(scene), f_(forecast) {}

  void make() {
    const double frequencies = static_cast<double>(frequencies_of(scene_.experiment).size() *
                                                   std::max<std::size_t>(1, temperatures_of(scene_.experiment).size()));
    const double points = static_cast<double>(load_test_of(scene_).history.times.size());
    const bool aggregates = !scene_.specimen.file && f_.census.aggregates > 0;
    for (const std::string& name : files_of_run(scene_, aggregates)) add(name, bytes_of(name, frequencies, points));
    if (scene_.output.fields.any()) add_fields();
  }

 private:
  void add(const std::string& name, double bytes) { f_.files.push_back(name), f_.file_bytes.push_back(bytes); }

  double bytes_of(const std::string& name, double frequencies, double points) const {
    if (name == "summary.json") return summary_base + summary_frequency * frequencies + summary_point * points;
    if (name == "specimen.csv") return particle_line * static_cast<double>(f_.census.particles());
    if (name == "aggregates.csv") return 300 + aggregate_line * static_cast<double>(f_.census.aggregates);
    if (name == "gradation.csv") return 10 * gradation_line;
    if (name == "contacts.csv")
      return (contact_line + (has_laws_of_phases(scene_.network.rule) ? series_columns : 0)) * f_.contacts;
    if (name == changed_scene_file) return static_cast<double>(scene_.text.size());
    if (name == cracks_file) return crack_line * broken_points();
    if (name == damage_file) return damage_line * damaged_contacts();
    if (name == "response.csv") {
      double samples = 0;
      if (scene_.solver.method == SolverMethod::quasi_static)
        samples = static_cast<double>(scene_.cyclic().frequencies.size()) * (samples_by_increments(scene_) + 1);
      for (const StepForecast& s : f_.steps) samples += s.cycles * scene_.cyclic().samples_per_cycle + 1;
      return sample_line * samples;
    }
    if (name == "sweep.csv") return 200 + sweep_line * frequencies;
    const std::string kind = load_test_of(scene_).kind;
    return !kind.empty() && name == load_words(kind).file ? 200 + load_line * points : material_file;
  }

  /// Returns the part of the contacts whose law has the property.
  double part_of_contacts(bool LawFacts::*property) const {
    const auto part = mean_of_usual(scene_, [property](const Law& law, PairType) {
      return std::visit([property](const auto& l) { return facts_of(l).*property ? 1.0 : 0.0; }, law);
    });
    return part.value_or(0);
  }

  /// Returns the number of contacts that are expected to begin to crack: at the peak of a strength test, two thirds.
  double damaged_contacts() const { return 2.0 / 3 * part_of_contacts(&LawFacts::cracks) * f_.contacts; }

  /// Returns the number of broken contact points that the run is expected to list. The true number depends on the load;
  /// the result is its order of magnitude for a specimen that breaks in two.
  double broken_points() const {
    constexpr double points_per_contact = 5.9, broken_part = 0.11;  // measured: specimen t8, torn in two
    const double tests = static_cast<double>(std::max<std::size_t>(1, frequencies_of(scene_.experiment).size()));
    return tests * broken_part * points_per_contact * part_of_contacts(&LawFacts::breaks) * f_.contacts;
  }

  /// Returns the largest number of Kelvin units of any contact; a file of contacts has one array for each unit. Returns
  /// 0 for the contact form `points`, because the states of its Kelvin units are not written.
  int units() const {
    int out = 0;
    if (f_.stepped && f_.form == ContactForm::points) return out;
    for (const auto& law : facts_of(scene_.laws))
      if (law) out = std::max(out, law->units);
    return out;
  }

  void add_fields() {
    const FieldSpec& spec = scene_.output.fields;
    // a file of a generated specimen has the size class of each particle
    const bool made = !scene_.specimen.file && f_.census.aggregates > 0;
    const double particles = static_cast<double>(f_.census.particles()), per_unit = f_.stepped ? 24 : 48;
    const double stress = scene_.solver.backend == Backend::reference ? 0 : 24;
    const bool cracks = can_crack(facts_of(scene_.laws)) && f_.stepped;
    const FieldSize of_particles{48.0 + (made ? 4 : 0), 24.0 + (made ? 2 : 0), f_.stepped ? 72 + stress : 72,
                                 particles};
    const FieldSize of_contacts{60 + 12 * particles / std::max(1.0, f_.contacts),
                                34 + 12 * particles / std::max(1.0, f_.contacts),
                                (f_.stepped ? 56 : 108) + per_unit * units() + (cracks ? 16 : 0), f_.contacts};
    // polygons with five corners, and four arrays
    const FieldSize of_cracks{120, 95, 16, part_of_contacts(&LawFacts::cracks) * f_.contacts};
    const FieldSize of_cells{210, 105, 0, f_.contacts + 9 * std::pow(particles, 2.0 / 3)};
    const bool vtp = spec.format == FieldFormat::vtp;
    if (spec.cells) add(std::string("fields/cells") + (vtp ? ".vtp" : ".vtkhdf"), static_file(of_cells));
    const auto both = [&](const std::string& of, double frames) {
      if (spec.particles) add_series("fields/particles_" + of, of_particles, frames);
      if (spec.contacts) add_series("fields/contacts_" + of, of_contacts, frames);
      if (spec.contacts && cracks) add_series("fields/cracks_" + of, of_cracks, frames);
    };
    if (!f_.stepped) return add_steady(both);
    for (const StepForecast& s : f_.steps) {
      const bool cyclic = s.frequency_hz > 0;
      const int of_piece =
          cyclic ? scene_.cyclic().samples_per_cycle : static_cast<int>(load_test_of(scene_).history.times.size());
      both(cyclic ? fmt::format("{}Hz", s.frequency_hz) : kind_of(scene_.experiment),
           std::floor((cyclic ? s.cycles : 1.0) * of_piece / spec.stride(of_piece)) + 1);
    }
  }

  template <class F>
  void add_steady(F&& both) const {
    const std::vector<double> temperatures = temperatures_of(scene_.experiment);
    for (const double hz : frequencies_of(scene_.experiment)) {
      if (temperatures.size() < 2) both(fmt::format("{}Hz", hz), 0);
      for (const double t : temperatures)
        if (temperatures.size() > 1) both(fmt::format("{}Hz_{}C", hz, t), 0);
    }
  }

  double static_file(const FieldSize& size) const {
    const bool vtp = scene_.output.fields.format == FieldFormat::vtp;
    constexpr double head = 2500, hdf5_head = 40e3;  // an HDF5 file has some kB of its own for each array
    return vtp ? head + size.mesh * size.entries : hdf5_head + size.packed * size.entries;
  }

  /// `frames`: number of frames; 0 for a steady state, which is one file without times.
  void add_series(const std::string& stem, const FieldSize& size, double frames) {
    const bool vtp = scene_.output.fields.format == FieldFormat::vtp;
    const double of_frame = size.frame * size.entries;
    f_.field_frames += std::max(1.0, frames);
    if (frames == 0) return add(stem + (vtp ? ".vtp" : ".vtkhdf"), static_file(size) + of_frame);
    constexpr double list_line = 75, frame_head = 300, piece = 256, of_piece = 65e3;
    constexpr double growing_head = 180e3;  // bytes for the arrays of a VTKHDF file that grow with each frame
    if (!vtp) {
      return add(stem + ".vtkhdf", static_file(size) + growing_head + (of_frame + frame_head) * frames +
                                       of_piece * std::ceil(frames / piece));
    }
    add(stem + ".pvd", 120 + list_line * frames);
    add(stem + "_*.vtp", (static_file(size) + of_frame) * frames);
  }

  const Scene& scene_;
  Forecast& f_;
};

}  // namespace

void forecast_files(const Scene& scene, Forecast& forecast) { FileForecast(scene, forecast).make(); }

}  // namespace macadam
