// SPDX-License-Identifier: GPL-3.0-or-later
// run.cpp  The main job: prepares a scene, solves its frequencies, and leaves whole files whatever happens.
#include "host/results/files.hpp"
#include "host/simulation/solution.hpp"
#include "host/simulation/summary.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

RunResult run(const Scene& scene, const std::filesystem::path& out, const Progress& progress,
              const std::function<void(const Preparation&)>& on_prepared) {
  RunResult result;
  const bool stepped = scene.solver.method == SolverMethod::explicit_;
  if (stepped) result.backend = select_backend(scene.solver.backend);  // before any work: cuda may not be there
  make_result_folder(out);
  const Preparation prepared = prepare(scene, progress);
  write_preparation(scene, prepared, out);
  if (on_prepared) on_prepared(prepared);

  const Saving save = [&](const std::string& status) {
    write_whole(out / "summary.json", summary_json(scene, prepared, result, status));
  };
  try {
    if (stepped) {
      step_frequencies(scene, prepared, out / "response.csv", progress, save, result);
    } else {
      solve_frequencies(scene, prepared, progress, save, result);
    }
  } catch (const std::exception& error) {
    save(std::string("failed: ") + error.what());
    throw;
  }
  save("done");
  return result;
}

}  // namespace macadam
