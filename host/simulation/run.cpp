// SPDX-License-Identifier: GPL-3.0-or-later
// run.cpp  The main job: prepares a scene, solves its frequencies, and leaves whole files whatever happens.
#include "host/results/files.hpp"
#include "host/simulation/solution.hpp"
#include "host/simulation/summary.hpp"
#include "macadam/error.hpp"
#include "macadam/simulation.hpp"

namespace macadam {
namespace {

/// What the command line may have combined.
void require_backend_fits(const Scene& scene) {
  if (scene.solver.method != SolverMethod::explicit_ || scene.solver.backend != Backend::reference) return;
  const auto refuse = [&](const char* what, const char* found, const char* expected) {
    throw InputError(scene.file.string(), 0, std::string(what) + " with backend reference", found, expected);
  };
  if (scene.solver.precision.value_or(Precision::double_) != Precision::double_) {
    refuse("precision", to_string(*scene.solver.precision), "double");
  }
  if (scene.network.quadrature == Quadrature::exact) refuse("quadrature", "exact", "lumped: it works per point");
}

}  // namespace

RunResult run(const Scene& scene, const std::filesystem::path& out, const Watcher& watcher) {
  require_backend_fits(scene);
  RunResult result;
  const bool stepped = scene.solver.method == SolverMethod::explicit_;
  if (stepped) result.backend = select_backend(scene.solver.backend);  // before any work: cuda may not be there
  make_result_folder(out);
  for (const char* name :
       {"response.csv", "contacts.csv", "summary.json"}) {  // none of another run may stay beside ours
    if (std::filesystem::is_regular_file(out / name)) std::filesystem::remove(out / name);
  }
  const Preparation prepared = prepare(scene, watcher.progress);
  write_preparation(scene, prepared, out);
  if (watcher.prepared) watcher.prepared(prepared);

  const Saving save = [&](const std::string& status) {
    write_whole(out / "summary.json", summary_json(scene, prepared, result, status));
  };
  try {
    if (stepped) {
      step_frequencies(scene, prepared, out / "response.csv", watcher, save, result);
    } else {
      solve_frequencies(scene, prepared, watcher.progress, save, result);
    }
  } catch (const std::exception& error) {
    try {
      save(std::string("failed: ") + error.what());
    } catch (const RunError&) {  // a full disk may be why we are here: the first error is the one to tell
    }
    throw;
  }
  save("done");
  return result;
}

}  // namespace macadam
