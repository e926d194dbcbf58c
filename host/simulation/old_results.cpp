// SPDX-License-Identifier: GPL-3.0-or-later
// old_results.cpp  Removes the files that result_files() lists, and the checkpoints of finished runs.
#include "host/simulation/old_results.hpp"

#include <string>
#include <system_error>

#include "host/experiments/experiment.hpp"
#include "host/run/checkpoints.hpp"
#include "macadam/error.hpp"

namespace macadam {

void remove_results(const std::filesystem::path& out) {
  for (const std::string& name : result_files()) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(out / name, error)) continue;
    if (!std::filesystem::remove(out / name, error)) {
      throw RunError((out / name).string() + ": cannot be replaced: " + error.message());
    }
  }
}

void remove_own_checkpoint(const std::filesystem::path& out, const Scene& scene, Backend backend, bool own) {
  std::error_code ignored;
  for (const char* name : {checkpoint_name, previous_checkpoint_name}) {
    const std::filesystem::path file = out / name;
    if (!own && !is_checkpoint_of(file, scene, backend)) continue;
    std::filesystem::remove(file, ignored);
    std::filesystem::remove(file.string() + ".part", ignored);  // left by a kill while a checkpoint was written
  }
}

}  // namespace macadam
