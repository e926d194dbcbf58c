// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene.hpp  Defines a scene, the complete description of a run, which is read from a file and checked before
/// any work.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "macadam/backend.hpp"
#include "macadam/contact_network.hpp"
#include "macadam/experiments/all.hpp"
#include "macadam/fields.hpp"
#include "macadam/laws/all.hpp"
#include "macadam/laws/law_range.hpp"
#include "macadam/laws/shift.hpp"
#include "macadam/linear_method.hpp"
#include "macadam/recipe.hpp"
#include "macadam/specimen.hpp"
#include "macadam/temperature.hpp"

namespace macadam {

/// Densities by phase [kg/m³], 0 if the scene gives none, the temperature, and the constants that the rules "series"
/// and "volumetric" need besides the laws of the pairs.
struct Materials {
  double aggregate = 0, mastic = 0;
  std::optional<double> temperature = {};              ///< of the whole specimen [°C]; empty: not given
  std::optional<double> rock_modulus = {};             ///< E of the aggregates [Pa]; empty: not given
  std::optional<double> aggregate_poisson_ratio = {};  ///< empty: not given; only rule "volumetric" uses it
  std::optional<double> mastic_poisson_ratio = {};     ///< empty: not given
  Expansion expansion = {};                            ///< used if the temperature changes during the test
  double density(Phase phase) const {
    return phase == Phase::aggregate ? aggregate : phase == Phase::mastic ? mastic : 0;
  }
};

/// Factors δ on all moduli and viscosities of each pair.
using Deltas = std::array<double, pair_types>;
inline constexpr Deltas all_one{1, 1, 1, 1, 1, 1};
static_assert(all_one.back() == 1);

/// The shift law of each pair, which gives the effect of temperature.
using ShiftLaws = std::array<laws::Shift, pair_types>;

/// The range in which the law of each pair holds.
using LawRanges = std::array<laws::LawRange, pair_types>;

struct Scene;

/// Where the law of the mastic comes from, if `from` in [materials.mastic] names another scene: the specimen of that
/// scene is the mastic. compute_mastic_law() (simulation.hpp) solves it; until then the laws of the pairs with mastic
/// are provisional, and only their shift and their kind (elastic or viscoelastic) are right.
struct MasticSource {
  std::filesystem::path file;          ///< the other scene
  std::shared_ptr<const Scene> scene;  ///< its content

  /// The chain that was computed.
  struct Computed {
    double lowest_hz = 0, highest_hz = 0;  ///< reduced frequencies between which the chain was fitted
    double largest_difference = 0;         ///< largest relative difference of its modulus from the specimen's
    int units = 0;                         ///< number of Kelvin units
    std::filesystem::path folder;          ///< folder of the result; empty: it could not be kept
    bool kept_before = false;              ///< whether an earlier command had computed it
  };
  std::optional<Computed> computed = {};
};

/// `explicit_`: time stepping; `harmonic`: the frequency domain; `quasi_static`: increments without inertia.
enum class SolverMethod : std::uint8_t { explicit_, harmonic, quasi_static };
/// Returns "explicit", "harmonic" or "quasi_static".
const char* to_string(SolverMethod);
/// Returns whether a method follows tests in time, by steps or by increments.
constexpr bool is_stepped(SolverMethod method) { return method != SolverMethod::harmonic; }

/// The section `[solver]` of a scene. Options that are empty are chosen by make_plan().
struct SolverSpec {
  SolverMethod method = SolverMethod::explicit_;
  bool method_given = false;  ///< whether the scene gives the method; otherwise the program chooses it
  std::optional<double>
      tolerance;  ///< largest error: explicit, of |E*| (relative) and φ [rad]; quasi-static, of the stress
  std::optional<std::vector<double>> density_scaling;  ///< one value, or one per frequency
  std::optional<double> safety;                        ///< fraction of the computed critical step
  std::optional<double> time_step;                     ///< time step [s]; empty: it is computed
  /// Whether the scene gives a damping, even 0; otherwise tests that are not cyclic choose their own.
  bool damping_given = false;
  Damping damping_kind = Damping::none;
  double damping = 0;  ///< χ of local damping, or β [1/s] of viscous damping
  std::optional<ContactForm> form;
  std::optional<Geometry> geometry;
  std::optional<Precision> precision;
  Backend backend = Backend::automatic;
  LinearMethod linear = LinearMethod::automatic;  ///< method of the harmonic solutions
  int threads = 0;                                ///< 0: OpenMP's choice
  DeviceList devices;                             ///< CUDA devices; empty: run() chooses
  int side_by_side = 1;                           ///< as in StepperOptions; a scene cannot set it
  bool inertia = false;                           ///< harmonic only: include −ω²M, multiplied by density_scaling
};

/// The section `[output]` of a scene.
struct OutputSpec {
  bool contacts = false;       ///< write contacts.csv
  bool response = true;        ///< write response.csv; without it, only what the result needs is sampled
  bool sensitivities = false;  ///< harmonic only: write derivatives of |E*| and φ to summary.json
  FieldSpec fields;            ///< field files for viewers
  /// Wall time between two checkpoints [s]; 0: a checkpoint is written only when the run is interrupted; empty: 600 s.
  std::optional<double> checkpoint;
};

/// A whole scene. `file`: the file from which the scene was read. Relative paths in the scene have been resolved.
struct Scene {
  std::filesystem::path file;
  std::string text;  ///< text of the file, which a checkpoint stores. Empty if the scene was not read from a file
  SpecimenSpec specimen;
  std::optional<MixDesign> recipe;  ///< if given, determines classes and porosity of the specimen, and the densities
  Materials materials;
  LawTable laws;            ///< at Materials::temperature or, without one, each at its own reference temperature
  Deltas deltas = all_one;  ///< already included in the laws
  ShiftLaws shifts;         ///< shift laws that belong to `laws`
  LawRanges ranges;         ///< ranges that belong to `laws`
  std::optional<MasticSource> mastic_source;  ///< empty: the scene itself gives the law of the mastic
  NetworkSpec network;
  Experiment experiment;
  SolverSpec solver;
  OutputSpec output;
  /// Texts KEY=VALUE that set values in place of those in the file; `text` has these values. Empty: the scene is as in
  /// its file
  std::vector<std::string> changes = {};

  /// Returns the cyclic test. \throws InputError if the scene has another experiment.
  experiments::Cyclic& cyclic();
  const experiments::Cyclic& cyclic() const;
};

/// Returns one experiment of each kind, with default values, in the order of the list in experiments/all.hpp.
std::vector<Experiment> all_experiments();

/// Returns whether a run of the scene yields particle motions that can be drawn: steady states and steps do, spectra do
/// not.
inline bool has_fields(const Scene& scene) {
  return is_stepped(scene.solver.method) || !frequencies_of(scene.experiment).empty();
}

/// Reads a TOML scene and checks everything that can be checked without building the specimen: unknown keys (names the
/// nearest known one), wrong types, impossible values, missing sections, units ("12.5 mm", "35 GPa").
///
/// \throws InputError with file, line, the value found, the value expected.
Scene read_scene(const std::filesystem::path& file);
/// Reads a scene from `text` instead of the file's contents. Messages name `file`, and paths are relative to its
/// folder. Without `lines`, messages do not name lines, because the user has not seen the text.
Scene read_scene(const std::filesystem::path& file, const std::string& text, bool lines = true);

/// Reads the file of a scene with other values at some keys, one value per text `KEY=VALUE`, for example
/// `solver.tolerance=1e-3`. KEY is the path of a key, with dots between its parts. A part may be the pair of an entry
/// of
/// `[[contacts]]`, or the number of an entry of a list, counted from 0. VALUE is a TOML value; simple texts need no
/// quotes. A table replaces the whole section. Scene::text has the values, and so has a file `scene_as_run.toml` that
/// run() and prepare_into() write.
///
/// \throws InputError as read_scene(); about a value that was set, it names `--set KEY=VALUE` in place of file and
/// line.
Scene read_changed_scene(const std::filesystem::path& file, const std::vector<std::string>& changes);

/// Returns the text of a scene's file. Checks only that it is TOML. \throws InputError with file and line.
std::string read_scene_text(const std::filesystem::path& file);

/// Returns a scene's laws at a temperature [°C]. Viscosities are NaN if their shift law has no value at this
/// temperature.
LawTable laws_at(const Scene& scene, double temperature);
/// Returns `laws`, which are given at the scene's temperature, at another temperature [°C], as the function above does
/// with the scene's own laws.
LawTable laws_at(const Scene& scene, double temperature, LawTable laws);

/// Returns a scene's laws at their reference temperatures.
LawTable reference_laws(const Scene& scene);

/// Returns a sentence for each law that the test of the scene uses outside of the range in which the law holds: at
/// frequencies of a cyclic test or a sweep, at the inverse 1/(2·pi·t) of the times t of other tests, and at the scene's
/// temperatures.
std::vector<std::string> law_range_warnings(const Scene& scene);

/// Returns log10 a_T at a temperature if all laws with viscosities follow the same shift, which is then the shift of
/// the specimen; otherwise nothing.
std::optional<double> common_log10_shift(const Scene& scene, double temperature);

/// Checks that every pair type present in the network has a law and every phase present a density.
/// \throws InputError naming the pair or phase.
void require_laws(const Scene& scene, const Specimen& specimen, const ContactNetwork& network);

/// Checks that the fracture energies of cracks suffice for every contact, so that each step of a contact has one
/// solution (docs/cracks.md, (C.13)). The lengths of the contacts must be final. \throws InputError naming pair,
/// contact and energy.
void require_fracture_energies(const Scene& scene, const ContactNetwork& network);

}  // namespace macadam
