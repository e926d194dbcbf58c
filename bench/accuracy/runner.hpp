// SPDX-License-Identifier: GPL-3.0-or-later
/// \file runner.hpp  Runs cases. Specimens, networks and frequency-domain solutions are computed once and reused.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "bench/accuracy/case.hpp"

namespace macadam::accuracy {

/// Runs cases and keeps the specimens, networks and frequency-domain solutions that several cases need.
class Runner {
 public:
  /// `root` is the folder of the repository, which contains tests/data and examples/demo. run() writes its files into
  /// the folder `out`.
  Runner(std::filesystem::path root, std::filesystem::path out);
  ~Runner();

  /// Runs a case. Returns one outcome for each of its `cycles`, fewer if the run diverges. If a tolerance is set, the
  /// settings that it chose are written into the case. \throws InputError, RunError.
  std::vector<Outcome> run(Case& settings);
  /// Returns the specimen of a case and its contacts.
  const Preparation& prepared(const Case& settings);
  /// Returns the scene with the laws of a case, including stiffened ones.
  Scene scene_of(const Case& settings);

 private:
  struct Network;
  const Scene& scene(const std::string& name, const std::string& mix);
  Network& network(const Case& settings);
  std::vector<Outcome> run_asked(Case& settings);
  double seconds_by_hand(const Case& asked);

  std::filesystem::path root_, out_;
  std::map<std::pair<std::string, std::string>, Scene> scenes_;
  std::map<std::tuple<std::string, std::string, std::string, double, Quadrature, double, double>,
           std::unique_ptr<Network>>
      networks_;
};

/// Returns all runs in order. `quick`: a short list that takes a minute; `full`: also the full specimen; `cuda`: also
/// runs on a GPU.
std::vector<Case> studies(bool quick, bool full, bool cuda);

}  // namespace macadam::accuracy
