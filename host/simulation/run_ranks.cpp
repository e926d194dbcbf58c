// SPDX-License-Identifier: GPL-3.0-or-later
// run_ranks.cpp  Implements the parts of a run that are needed only with several ranks (processes). Every rank
// prepares the scene and takes the same steps. The first rank writes the results; each of the other ranks has a
// temporary folder as long as it runs.
#include "host/simulation/run_ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "host/experiments/experiment.hpp"
#include "host/run/checkpoints.hpp"
#include "host/backends/rank_device.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(int rank) {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / fmt::format("macadam-rank-{}-XXXXXX", rank)).string();
  if (!error && !::mkdtemp(name.data())) error.assign(errno, std::generic_category());
  path_ = name;
  if (error)
    throw RunError(path_.string() + ": cannot make the folder of rank " + std::to_string(rank) + ": " +
                   error.message());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Scene scene_of_rank(const Ranks& team, Scene scene) {
  const std::string beside = fmt::format(" with {} ranks", team.count());
  if (scene.solver.method != SolverMethod::explicit_) {
    throw InputError(scene.file.string(), 0, "method", "\"harmonic\"" + beside,
                     "\"explicit\", because one process solves the frequency domain, on all devices of its host");
  }
  if (scene.solver.backend == Backend::cpu || scene.solver.backend == Backend::reference) {
    throw InputError(scene.file.string(), 0, "backend", to_string(scene.solver.backend) + beside, "cuda");
  }
  scene.solver.backend = Backend::cuda;
  scene.solver.devices = device_of(team, scene.solver.devices);
  if (team.number() > 0) scene.output.contacts = false;
  return scene;
}

void require_same_scene(Ranks& team, const Scene& scene) {
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(scene.text.data()), scene.text.size());
  team.require_same("checksum of " + scene.file.string(), static_cast<std::int64_t>(sum));
}

void hand_out(Ranks& team, const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::string bytes;
    if (team.number() == 0) {
      std::ifstream file(folder / name, std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(file), {});
      if (file.bad()) throw RunError((folder / name).string() + ": cannot be read");
    }
    auto size = static_cast<std::uint64_t>(bytes.size());
    team.take_of_first(&size, sizeof size);
    bytes.resize(size);
    team.take_of_first(bytes.data(), size);
    if (team.number() == 0 || size == 0) continue;
    std::ofstream file(folder / name, std::ios::binary);
    if (!(file << bytes).flush()) throw RunError((folder / name).string() + ": cannot be written");
  }
}

void require_same_specimen(Ranks& team, const Preparation& prepared) {
  team.require_same("checksum of particles and contacts", checksum(prepared));
}

}  // namespace macadam
