// SPDX-License-Identifier: GPL-3.0-or-later
/// \file sections.hpp  The sections of a scene that have a file of their own.
#pragma once

#include "host/scene/table.hpp"
#include "macadam/scene.hpp"

namespace macadam::scene {

/// The text of a TOML file and its tables; `what` it is in messages. \throws InputError
toml::table read_toml(const std::filesystem::path& file, const std::string& what, std::string& text);
/// The tables of a text that stands for the file's. \throws InputError
toml::table parse_toml(const std::string& text, const std::filesystem::path& file, const std::string& what);

/// Reads `[specimen]`: a file or what the generator needs, whichever it is, that is not impossible; `recipe` is what
/// its classes follow from, where there is one. Paths are taken from `folder`. \throws InputError
SpecimenSpec read_specimen(const Section& section, const std::filesystem::path& folder,
                           std::optional<MixDesign>& recipe);

/// Reads `[specimen.recipe]`.
/// \throws InputError
MixDesign read_recipe(const Section& section);

/// Gives the materials the densities that follow from the recipe. `root` is the whole scene.
/// \throws InputError where the scene gives others.
void take_densities(const MixDesign& recipe, const Section& root, Materials& materials);

/// Reads `[specimen.shapes]`; paths are taken from `folder`.
/// \throws InputError
ShapeSpec read_shapes(const Section& section, const std::filesystem::path& folder);

/// A reader of `[min, max]` [m] with 0 < min ≤ max.
Reader range_into(double& low, double& high);

/// The keys of limits on facets, in `[network]` or of one pair.
std::vector<Key> keys_of(FacetLimits& limits);

/// Reads every `[[contacts]]`; laws are at their reference temperatures, how they shift goes into `shifts`, what was
/// multiplied into them into `deltas`, limits on
/// a pair's facets into `network`.
/// \throws InputError
LawTable read_contacts(const std::vector<Section>& sections, ShiftLaws& shifts, Deltas& deltas, NetworkSpec& network);

/// The keys of fields, in `[output]`, and what holds between them. \throws InputError
/// @{
std::vector<Key> keys_of(FieldSpec& spec);
void check_fields(const Section& section, const FieldSpec& spec);
/// @}

/// Brings the laws to the scene's temperature, and checks that each temperature that it names means something.
/// \throws InputError
void apply_temperature(Scene& scene, const Section& root);

/// Reads `[loading]` as its `kind` has it.
/// \throws InputError
Experiment read_experiment(const Section& section);

/// How a test is run that says nothing of it.
SolverSpec usual_solver(const Experiment& experiment);

/// Reads `[solver]`; density scaling and time step are checked against the test's frequencies.
/// \throws InputError
SolverSpec read_solver(const Section& section, const Experiment& experiment);

}  // namespace macadam::scene
