// SPDX-License-Identifier: GPL-3.0-or-later
// twin_files.cpp  Writes the folder of a twin: a scene that can be run, the specimen, and twin.json with counts and
// volume fractions.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include "host/scene/toml.hpp"

#include "host/files/result_files.hpp"
#include "macadam/error.hpp"
#include "macadam/twin.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

/// Returns the scene with its `[specimen]` replaced by the file, and with the densities that a recipe gave it.
std::string scene_with_file(const Twin& twin, const Scene& scene) {
  toml::table text = toml::parse(scene.text);
  const Vec3d& size = twin.specimen.box.size;
  text.insert_or_assign("specimen",
                        toml::table{{"file", "specimen.csv"}, {"box", toml::array{size.x, size.y, size.z}}});
  if (!text.contains("materials")) text.insert("materials", toml::table{});
  toml::table& materials = *text["materials"].as_table();
  for (const auto& [phase, density] :
       {std::pair{"aggregate", scene.materials.aggregate}, {"mastic", scene.materials.mastic}}) {
    if (!materials.contains(phase) && density > 0) materials.insert(phase, toml::table{{"density", density}});
  }
  std::ostringstream out;
  out << "# " << twin.specimen.source << ", with the laws of " << scene.file.filename().string() << "\n"
      << text << "\n";
  return out.str();
}

/// Returns twin.json.
std::string numbers(const Twin& twin) {
  const Vec3d& c = twin.corner;
  const nlohmann::ordered_json out = {{"macadam", version()},
                                      {"made_of", twin.specimen.source},
                                      {"corner_m", {c.x, c.y, c.z}},
                                      {"grains", twin.grains},
                                      {"clusters", twin.clusters},
                                      {"lost_grains", twin.lost},
                                      {"enclosed_mastic", twin.enclosed_mastic},
                                      {"enclosed_aggregate", twin.enclosed_aggregate},
                                      {"void_spheres", twin.specimen.voids.size()},
                                      {"aggregate", twin.aggregate},
                                      {"mastic", twin.mastic},
                                      {"void", twin.voids},
                                      {"void_left_out", twin.voids_left_out}};
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

void write_twin(const std::filesystem::path& out, const Twin& twin, const Scene& scene) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw RunError(out.string() + ": the folder cannot be made: " + error.message());
  write_specimen_csv(out / "specimen.csv", twin.specimen);
  write_whole(out / "twin.json", numbers(twin));
  write_whole(out / "scene.toml", scene_with_file(twin, scene));
}

}  // namespace macadam
