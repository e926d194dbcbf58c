// SPDX-License-Identifier: GPL-3.0-or-later
/// \file runner.hpp  Runs cases: specimens, networks and harmonic solutions are made once and kept.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "bench/accuracy/case.hpp"

namespace macadam::accuracy {

class Runner {
 public:
  /// `root`: of the repository, where tests/data and examples/demo are. `out`: folder for the files of run().
  Runner(std::filesystem::path root, std::filesystem::path out);
  ~Runner();

  /// One outcome for each of the case's `cycles`, fewer where the run diverges. What a tolerance chose is written into
  /// the settings. \throws InputError, RunError.
  std::vector<Outcome> run(Case& settings);
  /// The specimen and its contacts.
  const Preparation& prepared(const Case& settings);
  /// With the laws of a case, stiffened ones among them.
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

/// All runs in order. `quick`: a minute; `full`: the full specimen too; `cuda`: a device is there.
std::vector<Case> studies(bool quick, bool full, bool cuda);

}  // namespace macadam::accuracy
