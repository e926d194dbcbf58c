// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene.hpp  A scene file, read and checked completely before any work.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/experiments/all.hpp"
#include "macadam/fields.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/laws/shift.hpp"
#include "macadam/linear_method.hpp"
#include "macadam/recipe.hpp"
#include "macadam/specimen.hpp"

namespace macadam {

/// Densities by phase [kg/m³]; 0 where the scene gives none. And the temperature.
struct Materials {
  double aggregate = 0, mastic = 0;
  std::optional<double> temperature = {};  ///< of the whole specimen [°C]
  double density(Phase phase) const {
    return phase == Phase::aggregate ? aggregate : phase == Phase::mastic ? mastic : 0;
  }
};

/// The factor on all moduli and viscosities of each pair.
using Deltas = std::array<double, pair_types>;
inline constexpr Deltas all_one{1, 1, 1, 1, 1, 1};
static_assert(all_one.back() == 1);

/// How temperature shifts each pair's law.
using ShiftLaws = std::array<laws::Shift, pair_types>;

enum class SolverMethod : std::uint8_t { explicit_, harmonic };

/// `[solver]`. What is empty was not given: make_plan() decides it.
struct SolverSpec {
  SolverMethod method = SolverMethod::explicit_;
  std::optional<double> tolerance;                     ///< largest error of |E*| (relative) and φ [rad]; explicit only
  std::optional<std::vector<double>> density_scaling;  ///< one, or one a frequency
  std::optional<double> safety;                        ///< share of the computed critical step
  std::optional<double> time_step;                     ///< [s]: given instead of computed
  bool damping_given = false;  ///< by the scene, 0 too; what is not cyclic chooses its own otherwise
  Damping damping_kind = Damping::none;
  double damping = 0;  ///< χ of local damping, or β [1/s] of viscous damping
  std::optional<ContactForm> form;
  std::optional<Geometry> geometry;
  std::optional<Precision> precision;
  Backend backend = Backend::automatic;
  LinearMethod linear = LinearMethod::automatic;  ///< of the harmonic solutions
  int threads = 0;                                ///< 0: OpenMP's choice
  DeviceList devices;                             ///< CUDA devices; none: run() chooses
  int side_by_side = 1;                           ///< no key: as in StepperOptions
  bool inertia = false;                           ///< harmonic only: include −ω²M, times density_scaling
};

/// `[output]`.
struct OutputSpec {
  bool contacts = false;       ///< write contacts.csv
  bool response = true;        ///< write response.csv; without it only what the result needs is observed
  bool sensitivities = false;  ///< harmonic only: derivatives of |E*| and φ in summary.json
  FieldSpec fields;            ///< files for viewers
  /// Wall time between two checkpoints [s], 0: when interrupted only; 600 s where the scene gives none.
  std::optional<double> checkpoint;
};

/// A whole scene. `file` is where it came from; relative paths in it have been resolved.
struct Scene {
  std::filesystem::path file;
  std::string text;  ///< of the file; a checkpoint belongs to it. Empty for a scene that was not read from one
  SpecimenSpec specimen;
  std::optional<MixDesign> recipe;  ///< that classes and porosity of the specimen, and the densities, follow from
  Materials materials;
  LawTable laws;            ///< at Materials::temperature; where there is none, each at its own reference temperature
  Deltas deltas = all_one;  ///< that the laws contain
  ShiftLaws shifts;         ///< of these laws
  NetworkSpec network;
  Experiment experiment;
  SolverSpec solver;
  OutputSpec output;

  /// The cyclic test. \throws InputError where the scene has another one.
  experiments::Cyclic& cyclic();
  const experiments::Cyclic& cyclic() const;
};

/// `kind` in `[loading]`.
const char* kind_of(const Experiment& experiment);
/// Files of results that a run of it may leave, besides those of every run.
std::vector<std::string> files_of(const Experiment& experiment);
/// Whether it may be stepped in time (method "explicit").
experiments::Stepping stepping_of(const Experiment& experiment);
/// Frequencies [Hz] and temperatures [°C] that it names; none of those that name none.
std::vector<double> frequencies_of(const Experiment& experiment);
std::vector<double> temperatures_of(const Experiment& experiment);

/// Whether its test has a motion of particles to show: steady states and steps have, spectra have not.
bool has_fields(const Scene& scene);

/// Reads a TOML scene and checks all that can be known without building the specimen: unknown keys (the nearest known
/// one is named), wrong types, impossible values, missing sections, units ("12.5 mm", "35 GPa").
/// \throws InputError with file, line, what was found, what was expected.
Scene read_scene(const std::filesystem::path& file);
/// The same of a text that stands for the file's: messages name `file`, and paths are relative to its folder. Without
/// `lines`, nobody has seen the text, and messages name no line of it.
Scene read_scene(const std::filesystem::path& file, const std::string& text, bool lines = true);

/// A scene's laws at a temperature [°C]; NaN in viscosities where a shift law has no value there.
LawTable laws_at(const Scene& scene, double temperature);
/// The same of laws in place of the scene's: parameters other than its own, at its temperature.
LawTable laws_at(const Scene& scene, double temperature, LawTable laws);

/// log10 a_T at a temperature where all laws that flow follow the same shift, so that the specimen follows it too; else
/// nothing.
std::optional<double> common_log10_shift(const Scene& scene, double temperature);

/// Checks that every pair type present in the network has a law and every phase present a density.
/// \throws InputError naming the pair or phase.
void require_laws(const Scene& scene, const Specimen& specimen, const ContactNetwork& network);

}  // namespace macadam
