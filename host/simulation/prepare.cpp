// SPDX-License-Identifier: GPL-3.0-or-later
// prepare.cpp  Makes specimen, tessellation and contact network of a scene, in this order.
#include <algorithm>
#include <span>
#include <system_error>
#include <unordered_map>

#include "host/fields/field_output.hpp"
#include "host/network/clusters.hpp"
#include "host/network/cell_volumes.hpp"
#include "host/network/loaded_rollers.hpp"
#include "host/network/turning_rollers.hpp"
#include "host/files/particle_files.hpp"
#include "host/files/result_files.hpp"
#include "host/files/result_folder.hpp"
#include "host/base/seconds_of.hpp"
#include "host/scene/scene_text.hpp"
#include "host/simulation/preparation_files.hpp"
#include "host/simulation/run_scene.hpp"
#include "host/simulation/summary.hpp"
#include "host/specimen/generate.hpp"
#include "host/specimen/known_aggregates.hpp"
#include "host/spheres/size_law.hpp"
#include "macadam/error.hpp"
#include "macadam/simulation.hpp"
#include "macadam/tessellation.hpp"
#include "macadam/thread_limit.hpp"

namespace macadam {
namespace {

bool is_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::equivalent(std::filesystem::absolute(file).parent_path(), folder, error);
}

/// Removes a file of an older result; a new file will get the same name.
void replace(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(file, error);
  if (error) throw RunError(file.string() + ": cannot be replaced: " + error.message());
}

/// Removes one file of an older specimen, if it is there.
void remove_older(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) std::filesystem::remove(file, error);
}

void make_cells(const Scene& scene, const Progress& progress, Preparation& out) {
  if (progress) progress("tessellation", 0);
  const bool of_volume = scene.network.cells_of_voids() == VoidCells::volume;
  out.seconds_tessellation = seconds_of(
      [&] { out.tessellation = of_volume ? tessellate_with_void_volumes(out.specimen) : tessellate(out.specimen); });
}

/// Returns the volume of the true aggregates over the box; nothing if it is unknown.
std::optional<double> rock_fraction(const Specimen& specimen, std::span<const Aggregate> aggregates) {
  std::unordered_map<std::int32_t, double> volume;
  for (const Aggregate& a : aggregates)
    if (a.volume > 0) volume[a.body] = a.volume;
  std::unordered_map<std::int32_t, std::size_t> unknown;  // number of spheres of each body without a known volume
  double sum = 0;
  for (const auto& [body, of_one] : volume) sum += of_one;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    if (specimen.phase[i] != Phase::aggregate || volume.contains(specimen.body[i])) continue;
    if (++unknown[specimen.body[i]] > 1) return {};
    sum += sphere_volume(2 * specimen.radius[i]);
  }
  return sum / specimen.box.volume();
}

/// Gives the contacts their lengths by the rule "series" or "volumetric", and reports on the rock.
void apply_rule(const Scene& scene, const std::vector<Surface>& surfaces, Preparation& out) {
  RockReport report;
  KnownAggregates read;
  if (scene.specimen.aggregate_file) read = read_aggregates_csv(*scene.specimen.aggregate_file, out.specimen);
  const bool from_file = scene.specimen.aggregate_file.has_value();
  const std::vector<Aggregate>& aggregates = from_file ? read.aggregates : out.aggregates;
  const Specimen& specimen = out.specimen;
  const RockSurfaces rock(specimen, aggregates, from_file ? read.surfaces : surfaces);
  const Materials& materials = scene.materials;
  const PhaseConstants constants{materials.rock_modulus.value_or(0), materials.mastic_poisson_ratio.value_or(0),
                                 materials.aggregate_poisson_ratio.value_or(0)};
  if (scene.network.rule == ContactRule::volumetric)
    apply_volumetric(out.network, specimen, out.tessellation, rock, constants);
  else
    apply_series(out.network, specimen, rock, constants.rock_modulus, constants.mastic_poisson_ratio);
  report.mastic_centres_in_rock = mastic_centres_in_rock(specimen, rock);
  for (std::size_t cell = 0; cell < specimen.cells(); ++cell) {
    const Phase phase = specimen.phase_of(static_cast<std::int32_t>(cell));
    const double fraction = out.tessellation.cell_volume[cell] / specimen.box.volume();
    if (phase == Phase::aggregate) report.rock_cells += fraction;
    if (phase == Phase::air_void) report.void_cells += fraction;
  }
  for (const VoidSphere& v : specimen.voids) report.void_nominal += sphere_volume(2 * v.radius) / specimen.box.volume();
  report.rock_nominal = rock_fraction(specimen, aggregates);
  out.rock = report;
}

/// Counts the clusters that join bottom and top wall, and the particles outside them. In a domain without these two
/// walls the largest cluster is the specimen.
void count_clusters(Preparation& out) {
  const Domain& domain = out.specimen.box;
  const bool has_platens = domain.wall_area(wall_index(wall_z_lo)) > 0 && domain.wall_area(wall_index(wall_z_hi)) > 0;
  const std::vector<Cluster> clusters = find_clusters(out.network, out.specimen.size());
  const auto largest = std::ranges::max_element(clusters, {}, [](const Cluster& c) { return c.particles.size(); });
  for (auto cluster = clusters.begin(); cluster != clusters.end(); ++cluster) {
    if (has_platens ? cluster->spans() : cluster == largest)
      ++out.spanning_clusters;
    else
      out.loose_particles += static_cast<std::int64_t>(cluster->particles.size());
  }
}

/// Makes the contacts between particles whose cells exist. `surfaces`: templates of the generated aggregates. \throws
/// InputError if no path of contacts joins bottom and top wall, RunError if a roller touches no particle.
void make_contacts(const Scene& scene, const std::vector<Surface>& surfaces, const Progress& progress,
                   Preparation& out) {
  if (progress) progress(network_stage, 0);
  out.seconds_network = seconds_of([&] {
    require_loaded_rollers(out.specimen, out.tessellation);
    out.network = build_network(out.specimen, out.tessellation, scene.network);
    let_rollers_turn(out.specimen, out.network);
    require_laws(scene, out.specimen, out.network);
    if (has_laws_of_phases(scene.network.rule)) apply_rule(scene, surfaces, out);
    require_fracture_energies(scene, out.network);
    count_clusters(out);
  });
  if (out.spanning_clusters == 0) {
    throw InputError(scene.file.string(), 0, "contact network", "no path of contacts from the bottom to the top wall",
                     "at least one such path (check gap_max and area_min)");
  }
}

}  // namespace

Preparation prepare(const Scene& scene, const Progress& progress) {
  const ThreadLimit threads(scene.solver.threads);
  Preparation out;
  auto report = [&](const char* stage, double share) {
    if (progress) progress(stage, share);
  };
  std::optional<Tessellation> cells;
  std::vector<Surface> surfaces;
  out.seconds_specimen = seconds_of([&] {
    if (scene.specimen.file) {
      report("reading the specimen", 0);
      out.specimen = read_specimen_csv(*scene.specimen.file, scene.specimen.box);
    } else {
      GeneratedWithCells generated = generate_with_cells(scene.specimen, report);
      out.specimen = std::move(generated.made.specimen);
      out.composition = std::move(generated.made.composition);
      out.aggregates = std::move(generated.made.aggregates);
      surfaces = std::move(generated.made.surfaces);
      out.relaxation_iterations = generated.made.relaxation_iterations;
      cells = std::move(generated.tessellation);
      out.seconds_tessellation = generated.seconds_tessellation;
    }
  });
  if (cells) {
    out.tessellation = std::move(*cells);
    out.seconds_specimen -= out.seconds_tessellation;
  } else {
    make_cells(scene, progress, out);
  }
  make_contacts(scene, surfaces, progress, out);
  return out;
}

Preparation prepare(const Scene& scene, Specimen specimen, const Progress& progress) {
  const ThreadLimit threads(scene.solver.threads);
  Preparation out;
  validate(specimen, specimen.source);
  out.specimen = std::move(specimen);
  if (const domains::Rollers* rollers = scene.specimen.box.rollers()) out.specimen.box.set_rollers(*rollers);
  make_cells(scene, progress, out);
  make_contacts(scene, {}, progress, out);
  return out;
}

std::string changed_scene_text(const Scene& scene, const std::filesystem::path& out) {
  scene::SceneText text(scene.text);
  if (!scene.specimen.file) text.set_seed(scene.specimen.seed);
  text.move(scene.file.parent_path(), out);
  std::string head = "# The scene " + scene.file.string() + " with the values that the command has set:\n";
  for (const std::string& change : scene.changes) head += "#   --set " + change + "\n";
  return head + "\n" + text.text();
}

void write_preparation(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out,
                       const std::function<void()>& remove_results) {
  const bool same_specimen = scene.specimen.file && is_in(*scene.specimen.file, out),
             aggregates = !prepared.aggregates.empty(), gradation = scene.recipe.has_value();
  RunResult none;
  // before any file is written: threads that cannot be made end the process without cleaning up
  none.warnings = packing_warnings(prepared.specimen, prepared.tessellation);
  FilesTogether files(out);
  write_specimen_csv(files.place_of("specimen.csv"), prepared.specimen);
  if (aggregates) write_aggregates_csv(files.place_of("aggregates.csv"), prepared.aggregates, prepared.composition);
  if (gradation)
    write_gradation_csv(files.place_of("gradation.csv"), gradation_of(*scene.recipe, prepared.composition));
  if (scene.output.contacts) write_contacts_csv(files.place_of("contacts.csv"), prepared.network);
  std::error_code ignored;
  const bool same_scene = std::filesystem::equivalent(scene.file, out / changed_scene_file, ignored);
  if (!scene.changes.empty() && !same_scene)
    write_whole(files.place_of(changed_scene_file), changed_scene_text(scene, out));
  write_whole(files.place_of("summary.json"), summary_json(scene, prepared, none, "prepared"));
  replace(out / "summary.json");
  remove_results();
  if (!aggregates && !same_specimen) remove_older(out / "aggregates.csv");
  if (!gradation && !same_specimen) remove_older(out / "gradation.csv");
  if (!scene.output.contacts) remove_older(out / "contacts.csv");
  if (scene.changes.empty() && !same_scene) remove_older(out / changed_scene_file);
  for (const ParticleFormat format : {ParticleFormat::data, ParticleFormat::dump, ParticleFormat::xyz})
    remove_older(out / particle_file_name(format));
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    if (!same_specimen && name.starts_with("section_") && name.ends_with(".csv")) remove_older(entry.path());
  }
  files.give_names();
}

Preparation prepare_into(const std::filesystem::path& out, const Scene& scene,
                         const std::vector<SectionPlane>& sections, const Progress& progress) {
  const ThreadLimit threads(scene.solver.threads);
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
