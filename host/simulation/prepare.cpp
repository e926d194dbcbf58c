// SPDX-License-Identifier: GPL-3.0-or-later
// prepare.cpp  Scene → specimen → tessellation → contact network.
#include <chrono>
#include <system_error>

#include "host/fields/field_output.hpp"
#include "host/network/clusters.hpp"
#include "host/results/files.hpp"
#include "host/results/result_folder.hpp"
#include "host/simulation/preparation_files.hpp"
#include "host/simulation/summary.hpp"
#include "macadam/error.hpp"
#include "macadam/simulation.hpp"

namespace macadam {
namespace {

/// Seconds that f takes.
template <class F>
double timed(F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool is_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::equivalent(std::filesystem::absolute(file).parent_path(), folder, error);
}

/// Takes a file of an older result away, as a new one will have its name.
void replace(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw RunError(file.string() + ": cannot be replaced: " + error.message());
}

/// A file of an older specimen.
void remove_older(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) std::filesystem::remove(file, error);
}

/// Cells and contacts of particles that are there.
void divide(const Scene& scene, const Progress& progress, Preparation& out) {
  if (progress) progress("tessellation", 0);
  out.seconds_tessellation = timed([&] { out.tessellation = tessellate(out.specimen); });
  if (progress) progress("contact network", 0);
  out.seconds_network = timed([&] {
    out.network = build_network(out.specimen, out.tessellation, scene.network);
    require_laws(scene, out.specimen, out.network);
    for (const Cluster& cluster : find_clusters(out.network, out.specimen.size())) {
      if (cluster.spans()) {
        ++out.spanning_clusters;
      } else {
        out.loose_particles += static_cast<std::int64_t>(cluster.particles.size());
      }
    }
  });
  if (out.spanning_clusters == 0) {
    throw InputError(scene.file.string(), 0, "contact network", "no path of contacts from the bottom to the top wall",
                     "one (check gap_max and area_min)");
  }
}

}  // namespace

Preparation prepare(const Scene& scene, const Progress& progress) {
  Preparation out;
  auto report = [&](const char* stage, double share) {
    if (progress) progress(stage, share);
  };
  out.seconds_specimen = timed([&] {
    if (scene.specimen.file) {
      report("reading the specimen", 0);
      out.specimen = read_specimen_csv(*scene.specimen.file, scene.specimen.box);
    } else {
      GeneratedSpecimen made = generate_specimen(scene.specimen, report);
      out.specimen = std::move(made.specimen);
      out.composition = std::move(made.composition);
      out.aggregates = std::move(made.aggregates);
      out.relaxation_iterations = made.relaxation_iterations;
    }
  });
  divide(scene, progress, out);
  return out;
}

Preparation prepare(const Scene& scene, Specimen specimen, const Progress& progress) {
  Preparation out;
  validate(specimen, specimen.source);
  out.specimen = std::move(specimen);
  divide(scene, progress, out);
  return out;
}

void write_preparation(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
                       const std::function<void()>& remove_results) {
  const bool same_specimen = scene.specimen.file && is_in(*scene.specimen.file, out),
             aggregates = !prepared.aggregates.empty(), gradation = scene.recipe.has_value();
  FilesTogether files(out);
  write_specimen_csv(files.place_of("specimen.csv"), prepared.specimen);
  if (aggregates) write_aggregates_csv(files.place_of("aggregates.csv"), prepared.aggregates, prepared.composition);
  if (gradation)
    write_gradation_csv(files.place_of("gradation.csv"), gradation_of(*scene.recipe, prepared.composition));
  if (scene.output.contacts) write_contacts_csv(files.place_of("contacts.csv"), prepared.network);
  write_whole(files.place_of("summary.json"), summary_json(scene, prepared, {}, "prepared"));
  replace(out / "summary.json");
  remove_results();
  if (!aggregates && !same_specimen) remove_older(out / "aggregates.csv");
  if (!gradation && !same_specimen) remove_older(out / "gradation.csv");
  if (!scene.output.contacts) remove_older(out / "contacts.csv");
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    if (!same_specimen && name.starts_with("section_") && name.ends_with(".csv")) remove_older(entry.path());
  }
  files.give_names();
}

Preparation prepare_into(const std::filesystem::path& out, const Scene& scene,
                         const std::vector<SectionPlane>& sections, const Progress& progress) {
  const ResultFolder folder(out);
  require_no_run(out);
  Preparation prepared = prepare(scene, progress);
  write_preparation(scene, prepared, out, [&] { remove_fields(out); });
  write_specimen_fields(scene, prepared, out);
  for (const SectionPlane& plane : sections) {
    write_cross_section_csv(out / section_file_name(plane), prepared.specimen,
                            cut(prepared.specimen, prepared.tessellation, plane));
  }
  return prepared;
}

}  // namespace macadam
