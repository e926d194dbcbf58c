// SPDX-License-Identifier: GPL-3.0-or-later
// phantom_files.cpp  Writes the folder of a phantom: the scan, its parameters, and the truth.
#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "host/tools/ct/synthetic/grain_files.hpp"
#include "host/files/result_files.hpp"
#include "macadam/error.hpp"
#include "macadam/phantom.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Returns phantom.json: how the phantom was made, and its volume fractions.
std::string parameters(const Phantom& p, const Scene& scene, const PhantomSpec& spec) {
  const Vec3d& box = p.specimen.box.size;
  const Json out = {
      {"macadam", version()},
      {"scene", scene.file.string()},
      {"specimen_seed", scene.specimen.seed},
      {"voxel_m", spec.voxel},
      {"voxels", p.scan.size},
      {"origin_m", {p.scan.origin.x, p.scan.origin.y, p.scan.origin.z}},
      {"box_m", {box.x, box.y, box.z}},
      {"seed", spec.seed},
      {"shape", spec.shape == CoreShape::cylinder ? "cylinder" : "prism"},
      {"sawn_m", spec.sawn},
      {"air_m", spec.air},
      {"samples", spec.samples},
      {"grey", {{"air", spec.grey_air}, {"mastic", spec.grey_mastic}, {"aggregate", spec.grey_aggregate}}},
      {"blur_voxels", spec.blur},
      {"noise", spec.noise},
      {"cupping", spec.cupping},
      {"rings", spec.rings},
      {"drift", spec.drift},
      {"grains", p.grains.size()},
      {"volume_fractions", {{"aggregate", p.aggregate}, {"mastic", p.mastic}, {"void", p.voids}}}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Returns the table of gaps between grains. Grains closer than a voxel count as in contact.
std::string contacts_csv(const Phantom& p, double voxel) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to, "a,b,gap_m,contact\n");
  for (const GrainGap& g : p.gaps) fmt::format_to(to, "{},{},{},{}\n", g.a, g.b, g.gap, g.gap < voxel ? 1 : 0);
  return fmt::to_string(text);
}

/// Returns the table of the grains. Values are in SI units.
std::string grains_csv(const Phantom& p) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to,
                 "id,x,y,z,volume_m3,area_m2,d_long_m,d_intermediate_m,d_short_m,axis_x,axis_y,axis_z,"
                 "sieve_m,border,body,shape\n");
  for (const PhantomGrain& g : p.grains)
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", g.id, g.centre.x, g.centre.y, g.centre.z,
                   g.volume, g.area, g.d_long, g.d_intermediate, g.d_short, g.axis_long.x, g.axis_long.y, g.axis_long.z,
                   g.sieve, g.border ? 1 : 0, g.body, csv_field(g.shape));
  return fmt::to_string(text);
}

}  // namespace

void write_phantom(const fs::path& out, const Phantom& phantom, const Scene& scene, const PhantomSpec& spec) {
  const fs::path truth = out / "truth";
  for (const char* folder : {ct::whole_grains, ct::cut_grains}) {
    std::error_code error;
    fs::remove_all(truth / folder, error);  // removes surfaces of an earlier phantom
    fs::create_directories(truth / folder, error);
    if (error) throw RunError((truth / folder).string() + ": the folder cannot be made: " + error.message());
  }
  write_image(out / "scan.mha", phantom.scan);
  write_image(truth / "labels.mha", phantom.labels);
  write_image(truth / "phases.mha", phantom.phases);
  write_specimen_csv(truth / "specimen.csv", phantom.specimen);
  write_whole(truth / "grains.csv", grains_csv(phantom));
  write_whole(truth / "contacts.csv", contacts_csv(phantom, spec.voxel));
  for (const PhantomGrain& g : phantom.grains)
    write_surface(truth / (g.border ? ct::cut_grains : ct::whole_grains) / ct::surface_file(g.id), g.surface);
  write_whole(out / "phantom.json", parameters(phantom, scene, spec));
}

}  // namespace macadam
