// SPDX-License-Identifier: GPL-3.0-or-later
// experiment.cpp  Reads the experiment of a scene, and finds its functions in the list of all experiments
// (macadam/experiments/all.hpp).
#include "host/experiments/experiment.hpp"

#include "host/run/cracks.hpp"
#include "host/run/damaged_contacts.hpp"
#include "host/scene/sections.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Calls f with an empty experiment of every kind in the list.
template <class F>
void for_each_kind(F&& f) {
  [&]<std::size_t... kind>(std::index_sequence<kind...>) { (f(Experiment(std::in_place_index<kind>)), ...); }
  (std::make_index_sequence<std::variant_size_v<Experiment>>());
}

}  // namespace

Experiment scene::read_experiment(const Section& section) {
  std::vector<Experiment> kinds;
  std::vector<std::string> names;
  for_each_kind([&](const Experiment& experiment) {
    kinds.push_back(experiment);
    names.emplace_back(kind_of(experiment));
  });
  const auto kind = section.find("kind");  // if it is missing, the reader of the first experiment reports it
  return std::visit([&]<class Spec>(const Spec&) -> Experiment { return ExperimentOf<Spec>::read(section); },
                    kinds[kind ? kind->choice(names) : 0]);
}

std::vector<Experiment> all_experiments() {
  std::vector<Experiment> out;
  for_each_kind([&](const Experiment& experiment) { out.push_back(experiment); });
  return out;
}

std::vector<std::string> result_files() {
  std::vector<std::string> out = {"contacts.csv", "summary.json", cracks_file, damage_file};
  for_each_kind([&](const Experiment& experiment) {
    for (const std::string& name : files_of(experiment)) out.push_back(name);
  });
  return out;
}

experiments::Cyclic& Scene::cyclic() { return const_cast<experiments::Cyclic&>(std::as_const(*this).cyclic()); }

const experiments::Cyclic& Scene::cyclic() const {
  if (const auto* found = std::get_if<experiments::Cyclic>(&experiment)) return *found;
  throw InputError(file.string(), 0, "kind in [loading]", kind_of(experiment), experiments::Cyclic::kind);
}

}  // namespace macadam
