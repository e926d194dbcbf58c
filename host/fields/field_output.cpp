// SPDX-License-Identifier: GPL-3.0-or-later
// field_output.cpp  Defines the names of the field files, and decides when they are written.
#include "host/fields/field_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "macadam/error.hpp"
#include "macadam/ranks.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

constexpr const char *particles = "particles", *contacts = "contacts", *cells = "cells", *cracks = "cracks";

fs::path folder_in(const fs::path& out) { return out / "fields"; }

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw RunError(folder.string() + ": cannot make the folder of the fields: " + error.message());
}

bool is_field_file(const fs::path& file) {
  constexpr std::array<std::string_view, 4> endings{".vtkhdf", ".vtp", ".pvd", ".part"};
  const std::string name = file.filename().string(), ending = file.extension().string();
  return std::find(endings.begin(), endings.end(), ending) != endings.end() &&
         (name.starts_with(particles) || name.starts_with(contacts) || name.starts_with(cells) ||
          name.starts_with(cracks));
}

/// Returns the amplitude of the top wall in steady states: its displacement [m], or its turn [rad], with which the
/// shear strain at the side of a cylinder has the strain amplitude. A sweep gives no strain amplitude and gets the
/// default of a cyclic test.
double wall_amplitude(const Scene& scene, const Domain& domain, const WallMotion& wall) {
  const auto* cyclic = std::get_if<experiments::Cyclic>(&scene.experiment);
  const double strain = cyclic ? cyclic->strain_amplitude : experiments::Cyclic{}.strain_amplitude;
  return strain * gauge_length(domain) / (wall.turns() ? 0.5 * domain.size.x : 1.0);
}

FieldMesh cells_of(const Preparation& prepared) {
  return cell_mesh(prepared.specimen, prepared.tessellation, prepared.aggregates);
}

}  // namespace

void remove_fields(const fs::path& out) {
  std::error_code error;
  const fs::path folder = folder_in(out);
  if (!fs::is_directory(folder, error)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file(error) || !is_field_file(entry.path())) continue;
    if (!fs::remove(entry.path(), error)) {
      throw RunError(entry.path().string() + ": cannot be replaced: " + error.message());
    }
  }
  fs::remove(folder, error);  // removes the folder only if it is empty; files that the user has put into it stay
}

void write_specimen_fields(const Scene& scene, const Preparation& prepared, const fs::path& out) {
  const FieldSpec& spec = scene.output.fields;
  const fs::path folder = folder_in(out);
  if (spec.any()) make_folder(folder);
  if (spec.particles) {
    write_fields(folder / particles, spec.format, particle_mesh(prepared.specimen, prepared.aggregates));
  }
  if (spec.contacts) write_fields(folder / contacts, spec.format, contact_mesh(prepared.specimen, prepared.network));
  if (spec.cells) write_fields(folder / cells, spec.format, cells_of(prepared));
}

FieldOutput::FieldOutput(const Scene& scene, const Preparation& prepared, const fs::path& out)
    : scene_(scene), prepared_(prepared), folder_(folder_in(out)), writes_(is_first_rank()) {
  const FieldSpec& spec = scene.output.fields;
  if (!writes_) return;
  if (spec.any()) make_folder(folder_);
  if (spec.cells) write_fields(folder_ / cells, spec.format, cells_of(prepared));
}

fs::path FieldOutput::stem(const char* kind, const std::string& of) const { return folder_ / (kind + ("_" + of)); }

std::unique_ptr<FieldSeries> FieldOutput::series(const char* kind, const std::string& of, FieldMesh mesh, double time,
                                                 std::vector<std::string>& missing) const {
  const bool goes_on = time > 0;
  auto out = begin_fields(stem(kind, of), scene_.output.fields.format, std::move(mesh),
                          goes_on ? std::optional(time) : std::nullopt);
  if (goes_on && out->size() == 0) {
    missing.push_back(
        fmt::format("fields: the file {} had no frame to continue from; its first frame is at t = {:.6g} s",
                    stem(kind, of).string(), time));
  }
  return out;
}

std::vector<std::string> FieldOutput::begin(const std::string& of, int samples, double time) {
  const FieldSpec& spec = scene_.output.fields;
  stride_ = spec.stride(samples);
  begun_ = spec.particles || spec.contacts;
  std::vector<std::string> missing;
  if (!writes_) return missing;
  if (spec.particles) {
    particles_ = series(particles, of, particle_mesh(prepared_.specimen, prepared_.aggregates), time, missing);
  }
  if (spec.contacts)
    contacts_ = series(contacts, of, contact_mesh(prepared_.specimen, prepared_.network), time, missing);
  if (const FactsTable laws = facts_of(scene_.laws); spec.contacts && can_crack(laws))
    cracks_ = series(cracks, of, crack_mesh(prepared_.tessellation, prepared_.network, laws), time, missing);
  return missing;
}

bool FieldOutput::wants(std::int64_t sample) const { return begun_ && sample % stride_ == 0; }

void FieldOutput::add(const Stepper& stepper, ContactForm form, Geometry geometry, double time) {
  const FieldSpec& spec = scene_.output.fields;
  ParticleState state;
  if (spec.particles || geometry == Geometry::updated) state = stepper.particles();
  std::vector<FieldArray> of_particles = particle_arrays(state);
  if (geometry == Geometry::fixed) state.displacement.clear();
  // the reference backend does not report the states of its contacts
  const bool has_contact_states = scene_.solver.backend != Backend::reference;
  ContactState carried;
  if (spec.contacts || has_contact_states) carried = stepper.contacts(prepared_.network);
  // in the calls above, this process has sent its data to the first process, which writes the files
  if (!writes_) return;
  if (particles_) {
    if (has_contact_states) of_particles.push_back(stress_array(prepared_.tessellation, prepared_.network, carried));
    particles_->add(time, of_particles);
  }
  if (!contacts_) return;
  if (cracks_) cracks_->add(time, crack_arrays(prepared_.network, facts_of(scene_.laws), carried));
  // In the points form the chains belong to contact points, not to the whole contact.
  if (form == ContactForm::points) carried.chain_begin.clear();
  contacts_->add(time, contact_arrays(prepared_.specimen, prepared_.network, carried, state.displacement));
}

void FieldOutput::end() {
  if (particles_) particles_->end();
  if (contacts_) contacts_->end();
  if (cracks_) cracks_->end();
}

void FieldOutput::write(const HarmonicResult& solved, const LawTable& laws, std::optional<double> temperature) {
  const FieldSpec& spec = scene_.output.fields;
  std::string name = fmt::format("{}Hz", solved.frequency_hz);
  if (temperature) name += fmt::format("_{}C", *temperature);
  const double amplitude = wall_amplitude(scene_, prepared_.specimen.box, solved.wall);
  if (spec.particles) {
    write_fields(stem(particles, name), spec.format, particle_mesh(prepared_.specimen, prepared_.aggregates),
                 particle_arrays(solved.motion, amplitude));
  }
  if (spec.contacts) {
    write_fields(stem(contacts, name), spec.format, contact_mesh(prepared_.specimen, prepared_.network),
                 contact_arrays(prepared_.network, laws, solved.frequency_hz, solved.motion, amplitude, solved.wall));
  }
}

}  // namespace macadam
