// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sections.hpp  Declares the readers of the sections of a scene, each of which is defined in a source file of
/// its own.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/scene/table.hpp"
#include "host/scene/temperature_tables.hpp"
#include "macadam/scene.hpp"

namespace macadam::scene {

/// Reads a TOML file: returns its tables and stores its text in `text`. `what` is the kind of file in messages. \throws
/// InputError
toml::table read_toml(const std::filesystem::path& file, const std::string& what, std::string& text);
/// Returns the tables of `text`, which is used in place of the content of `file`. \throws InputError
toml::table parse_toml(const std::string& text, const std::filesystem::path& file, const std::string& what);

/// Reads `[specimen]`: a file, or the values for the generator. Mixtures that cannot be made are refused. `recipe`
/// receives the mix design, if there is one, and `notches` the notches. Relative paths start from `folder`. \throws
/// InputError
SpecimenSpec read_specimen(const Section& section, const std::filesystem::path& folder,
                           std::optional<MixDesign>& recipe, std::vector<Notch>& notches);

/// Reads one `[[specimen.notch]]`. \throws InputError
Notch read_notch(const Section& section, const Domain& domain);

/// Returns the keys of `[specimen]` that give the domain, to be read before all keys that depend on it. `dimensions`
/// keeps the dimensions [m], by key, while the keys are read. \throws InputError for an unknown kind of domain, or for
/// dimensions of another kind
std::vector<Key> keys_of_domain(const Section& section, std::map<std::string, double>& dimensions, Domain& domain);

/// Reads `[specimen.recipe]`.
/// \throws InputError
MixDesign read_recipe(const Section& section);

/// Sets the densities of the materials to those that follow from the recipe. `root` is the whole scene.
/// \throws InputError if the scene gives other densities.
void take_densities(const MixDesign& recipe, const Section& root, Materials& materials);

/// Returns the library of shapes that is shipped under a name; nothing if the name belongs to a folder.
std::optional<ShapeSpec::Library> shipped_library(const std::string& name);

/// Reads `[specimen.shapes]`. Relative paths start from `folder`.
/// \throws InputError
ShapeSpec read_shapes(const Section& section, const std::filesystem::path& folder);

/// Returns a reader of `[min, max]` [m] with 0 < min ≤ max.
Reader range_into(double& low, double& high);

/// Returns the keys of the limits that decide which facets are contacts, for `[network]` or for one pair.
std::vector<Key> keys_of(FacetLimits& limits);

/// Reads every `[[contacts]]` and returns the laws at their reference temperatures. Stores in `shifts` the temperature
/// shifts of the laws, in `ranges` the ranges in which they hold, in `deltas` the factors `delta` with which the laws
/// were multiplied, and in `network` the limits on the facets of each pair. Strengths and fracture energies that are
/// tables are evaluated at the temperature in `tables`. \throws InputError
LawTable read_contacts(const std::vector<Section>& sections, ShiftLaws& shifts, LawRanges& ranges, Deltas& deltas,
                       NetworkSpec& network, TemperatureTables& tables);

/// Cracks of the pairs of a scene whose laws follow from those of its phases.
using PairCracks = std::array<std::optional<laws::Crack>, pair_types>;

/// Reads every `[[contacts]]` of a scene with the rule "series" or "volumetric": the limits on the facets of each pair,
/// and its crack, but no laws. Strengths and fracture energies that are tables are evaluated at the temperature in
/// `tables`. \throws InputError
void read_limits_of_pairs(const std::vector<Section>& sections, ContactRule rule, NetworkSpec& network,
                          PairCracks& cracks, TemperatureTables& tables);

/// Laws of the phases, for the rules "series" and "volumetric".
struct PhaseLaws {
  std::optional<Law> mastic;           ///< at its reference temperature
  laws::Shift shift;                   ///< of the mastic
  laws::LawRange range;                ///< of the mastic
  std::optional<MasticSource> source;  ///< the scene whose specimen is the mastic; `mastic` is then provisional
  std::optional<double> rock_modulus;
};

/// A scene that is being read, and the scene whose `from` names it (nullptr: none does).
struct ReadingFile {
  std::filesystem::path file;
  const ReadingFile* outer = nullptr;
};

/// Reads a scene that another one names. \throws InputError
Scene read_inner_scene(const ReadingFile& reading);

/// Reads the file that `from` in [materials.mastic] names: another scene, the law.toml of `macadam fit` or
/// `macadam mixture`, or the kelvin.csv of a run. Stores law, shift and range in `phases`. The law is provisional if
/// the file is a scene. Returns Poisson's ratio of the mastic, if the file has one. Paths are relative to the folder of
/// the scene that is being read. \throws InputError that names both files, also if scenes lead back to themselves.
std::optional<double> read_source(const Value& value, const ReadingFile& reading, PhaseLaws& phases);

/// Reads `[materials]`. `need`: whether densities are required; they may be left out if they follow from a recipe.
/// Stores the laws of the phases in `phases`. `reading` is the scene's file. With the rule "centres" such laws are
/// refused. \throws InputError
Materials read_materials(const Section& section, Need need, ContactRule rule, const ReadingFile& reading,
                         PhaseLaws& phases);

/// Reads a section [materials.mastic] as read_materials() does with rule "series"; the density may be left out.
/// \throws InputError
Materials read_mastic_alone(const Section& section, const ReadingFile& reading, PhaseLaws& phases);

/// Sets the laws, with their cracks, and the shifts of all pairs of a scene with laws of phases; otherwise changes
/// nothing. `root` is the whole scene. \throws InputError for a phase without a law
void set_laws_of_phases(Scene& scene, const PhaseLaws& phases, const PairCracks& cracks, const Section& root);

/// Return the keys of `[output]` that ask for fields, and check that their values fit together.
/// \throws InputError
/// @{
std::vector<Key> keys_of(FieldSpec& spec);
void check_fields(const Section& section, const FieldSpec& spec);
/// @}

/// Brings the laws to the scene's temperature. Checks that every temperature in the scene changes at least one law and
/// that all shifts have a value at this temperature. `tables`: the tables that the reading has already evaluated at the
/// scene's temperature. \throws InputError
void apply_temperature(Scene& scene, const Section& root, const TemperatureTables& tables);

/// Reads `[loading]`, whose `kind` decides the other keys.
/// \throws InputError
Experiment read_experiment(const Section& section);

/// Returns the solver settings of a scene without `[solver]`.
SolverSpec usual_solver(const Experiment& experiment);
/// Chooses the method if the scene gives none, the contacts can crack or the temperature changes during the test, and
/// the test is one that takes time steps only on request. The method is then increments without inertia or, if the
/// scene has a setting that only time steps use, time steps.
void choose_method(SolverSpec& solver, const Experiment& experiment, const LawTable& laws);

/// Reads `[solver]`. Density scaling and time step are checked against the experiment's frequencies.
/// \throws InputError
SolverSpec read_solver(const Section& section, const Experiment& experiment);

}  // namespace macadam::scene
