// SPDX-License-Identifier: GPL-3.0-or-later
// mastic_law.cpp  Computes the law of a mastic that is the specimen of another scene.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/content_digest.hpp"
#include "host/files/result_files.hpp"
#include "host/scene/crack_keys.hpp"
#include "host/scene/law_range.hpp"
#include "host/scene/sections.hpp"
#include "host/simulation/run_scene.hpp"
#include "macadam/error.hpp"
#include "macadam/fit_report.hpp"
#include "macadam/laws/values.hpp"
#include "macadam/simulation.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

constexpr int points_per_decade = 4;
/// The chain is fitted to at least this factor beyond the frequencies of the test, so that the beginning and the end of
/// a load are in its range, and then to whole decades, so that tests with similar frequencies share one result.
const double margin = std::sqrt(10.0);
/// Difference of the chain from the specimen above which a run warns.
constexpr double large_difference = 0.05;

struct Range {
  double lowest, highest;  ///< [Hz], whole decades
};

/// Returns the reduced frequencies at which the test of a scene needs the law of its mastic.
Range range_needed(const Scene& scene) {
  const laws::Shift& shift = scene.shifts[static_cast<std::size_t>(PairType::mm)];
  auto [low, high] = scene::frequencies_used(scene.experiment);
  std::vector<double> temperatures = temperatures_of(scene.experiment);
  if (scene.materials.temperature) temperatures.push_back(*scene.materials.temperature);
  const TemperatureHistory history = temperature_history_of(scene.experiment);
  temperatures.insert(temperatures.end(), history.temperatures.begin(), history.temperatures.end());
  double smallest = temperatures.empty() ? 0 : INFINITY, largest = temperatures.empty() ? 0 : -INFINITY;
  for (const double t : temperatures) {
    smallest = std::min(smallest, laws::log10_shift(shift, t));
    largest = std::max(largest, laws::log10_shift(shift, t));
  }
  const auto decade = [](double exponent) { return std::stod(fmt::format("1e{}", exponent)); };
  return {decade(std::floor(std::log10(low / margin) + smallest + 1e-9)),
          decade(std::ceil(std::log10(high * margin) + largest - 1e-9))};
}

/// Returns the name of a law and all its values as text.
std::string values_of(Law law) {
  return std::visit(
      [](auto& one) {
        std::string out = one.name;
        laws::each_value(one, [&](const std::string& name, double& value, laws::ValueKind, laws::ValueNeed) {
          out += fmt::format(" {}={}", name, value);
        });
        return out;
      },
      law);
}

void add_file(ContentDigest& digest, const fs::path& file) {
  digest.add(file.filename().string());
  digest.add(read_whole(file));
}

/// Adds the text of a scene and of the files that it names.
void add_scene(ContentDigest& digest, const Scene& scene) {
  digest.add(scene.text);
  for (const auto& file : {scene.specimen.file, scene.specimen.aggregate_file})
    if (file) add_file(digest, *file);
  if (scene.specimen.shapes && scene.specimen.shapes->library == ShapeSpec::Library::folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(scene.specimen.shapes->folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) add_file(digest, file);
  }
  for (const auto& law : scene.laws) digest.add(law ? values_of(*law) : "none");  // a law may be from another file
  if (scene.mastic_source) add_scene(digest, *scene.mastic_source->scene);
}

/// Returns the sweep over the specimen of the mastic, at the reference temperature of its laws.
Scene sweep_of(const Scene& mastic, const SolverSpec& solver, Range range) {
  Scene out = mastic;
  out.laws = reference_laws(mastic);
  if (has_laws_of_phases(out.network.rule)) {  // smooth platens, also if the mastic's own scene has glued ones
    for (const PairType pair : {PairType::mw, PairType::aw}) {
      auto& law = out.laws[static_cast<std::size_t>(pair)];
      if (law) std::visit([](auto& l) { l.alpha = 0; }, *law);
    }
  }
  out.materials.temperature.reset();
  const auto steps = static_cast<int>(std::lround(std::log10(range.highest / range.lowest) * points_per_decade));
  experiments::Sweep sweep;
  for (int i = 0; i <= steps; ++i)
    sweep.frequencies.push_back(range.lowest * std::pow(range.highest / range.lowest, static_cast<double>(i) / steps));
  out.experiment = sweep;
  out.specimen.box.set_rollers({});
  out.solver = {};
  out.solver.method = SolverMethod::harmonic;
  out.solver.backend = solver.backend == Backend::reference ? Backend::cpu : solver.backend;
  out.solver.linear = mastic.solver.linear;
  out.solver.threads = solver.threads;
  out.output = {};
  return out;
}

/// A folder for a result, which gets its final name when the result is complete.
class GrowingFolder {
 public:
  explicit GrowingFolder(const fs::path& kept) : kept_(kept) {
    std::error_code error;
    fs::create_directories(kept.parent_path(), error);
    static std::atomic<int> number = 0;  // scenes of run_many() run at the same time
    const std::string name = fmt::format("{}.part-{}-{}", kept.filename().string(), ::getpid(), number++);
    path_ = kept.parent_path() / name;
    if (!error) fs::create_directory(path_, error);
    if (!error) return;
    keeps_ = false;
    path_ = fs::temp_directory_path() / ("macadam-" + name);
    fs::create_directories(path_);
  }
  ~GrowingFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  GrowingFolder(const GrowingFolder&) = delete;
  GrowingFolder& operator=(const GrowingFolder&) = delete;
  const fs::path& path() const { return path_; }
  /// Gives the folder its final name. Returns whether the result is kept; if another command was faster, the result of
  /// that command is kept.
  bool keep() {
    std::error_code error;
    if (keeps_) fs::rename(path_, kept_, error);
    return keeps_ && fs::exists(kept_ / "law.toml");
  }

 private:
  fs::path kept_, path_;
  bool keeps_ = true;
};

/// A chain, its fit, and the warnings of the specimen's run.
struct Result {
  Law law;
  double largest_difference = 0;
  int units = 0;
  std::vector<std::string> warnings;
};

/// Reads a result from the files of its folder.
Result read_result(const fs::path& folder, bool flows) {
  Result out;
  const auto summary = nlohmann::json::parse(read_whole(folder / "summary.json"));
  for (const auto& words : summary.at("warnings")) out.warnings.push_back(words.get<std::string>());
  const auto chain = nlohmann::json::parse(read_whole(folder / "law.json"));
  out.largest_difference = chain.at("largest_difference").get<double>();
  if (!flows) {
    out.law = laws::Elastic{chain.at("E_pa").get<double>(), 1};
    return out;
  }
  laws::GeneralisedKelvin law;
  law.E_m = chain.at("E_m_pa").get<double>();
  law.C_m = chain.at("C_m_pa_s").is_null() ? INFINITY : chain.at("C_m_pa_s").get<double>();
  law.E = chain.at("E_pa").get<std::vector<double>>();
  law.C = chain.at("C_pa_s").get<std::vector<double>>();
  law.alpha = 1;
  out.units = law.units();
  out.law = std::move(law);
  return out;
}

/// Writes the chain that stands for the sweep in the folder, as law.json and, for use in other scenes, as law.toml.
void fit_result(const fs::path& folder, const laws::Shift& shift, bool flows,
                const std::vector<experiments::HarmonicFrequency>& points) {
  nlohmann::ordered_json out;
  if (!flows) {
    const double E = points.front().stiffness.e_star_pa;
    out = {{"E_pa", E}, {"largest_difference", 0.0}};
    write_whole(folder / "law.toml", fmt::format("[[contacts]]\npair = \"M-M\"\nlaw = \"elastic\"\nE = {:e}\n", E));
  } else {
    ModulusData curve;
    curve.source = (folder / "sweep.csv").string();
    for (const auto& p : points) curve.points.push_back({p.frequency_hz, p.stiffness.e_star_pa, p.stiffness.phase_deg});
    const CurveChain chain = chain_of_curve(curve);
    out = {
        {"E_m_pa", chain.law.E_m},
        {"C_m_pa_s", std::isfinite(chain.law.C_m) ? nlohmann::ordered_json(chain.law.C_m) : nlohmann::ordered_json()},
        {"E_pa", chain.law.E},
        {"C_pa_s", chain.law.C},
        {"largest_difference", chain.largest_difference}};
    write_whole(folder / "law.toml", report_of(chain, curve, shift).files.at("law.toml"));
  }
  write_whole(folder / "law.json", out.dump(1) + "\n");
}

/// Puts the law of the mastic in place of the provisional laws of the pairs with mastic.
void take(Scene& scene, const Law& law, Range range) {
  for (const PairType type : {PairType::mm, PairType::ma, PairType::mw, PairType::aa}) {
    const auto pair = static_cast<std::size_t>(type);
    if (!scene.laws[pair]) continue;
    const Law provisional = *scene.laws[pair];
    scene.laws[pair] = law;
    std::visit(
        [&]<class L>(const L& before) {
          std::visit([&](auto& l) { l.alpha = before.alpha; }, *scene.laws[pair]);
          if constexpr (cracking_law<L>) scene.laws[pair] = scene::with_crack(*scene.laws[pair], before.crack);
        },
        provisional);
    if (!laws::flows(law)) continue;
    scene.ranges[pair] = {range.lowest, range.highest};
    if (scene.materials.temperature)
      scene.laws[pair] = laws::shifted(
          *scene.laws[pair], std::pow(10.0, laws::log10_shift(scene.shifts[pair], *scene.materials.temperature)));
  }
}

}  // namespace

std::vector<std::string> compute_mastic_law(Scene& scene, const Watcher& watcher) {
  if (!scene.mastic_source || scene.mastic_source->computed) return {};
  MasticSource& source = *scene.mastic_source;
  const laws::Shift& shift = scene.shifts[static_cast<std::size_t>(PairType::mm)];
  const bool flows = laws::flows(scene.laws[static_cast<std::size_t>(PairType::mm)].value());
  const Range range = flows ? range_needed(scene) : Range{1, 10};
  ContentDigest digest;
  digest.add(version());
  digest.add(fmt::format("{} {} {}", range.lowest, range.highest, points_per_decade));
  add_scene(digest, *source.scene);
  const fs::path kept =
      source.file.parent_path() / (source.file.stem().string() + "-laws") / digest.digits().substr(0, 20);
  const std::string names = fmt::format("{}: mastic from {}: ", scene.file.string(), source.file.string());
  MasticSource::Computed computed{range.lowest, range.highest, 0, 0, kept, fs::exists(kept / "law.toml")};
  Result result;
  try {
    if (computed.kept_before) {
      result = read_result(kept, flows);
    } else {
      Watcher inside;
      inside.stop = watcher.stop;
      if (watcher.progress)
        inside.progress = [&](const std::string& stage, double share) { watcher.progress("mastic: " + stage, share); };
      GrowingFolder folder(kept);
      const RunResult run = run_scene(sweep_of(*source.scene, scene.solver, range), folder.path(), inside, false, {});
      if (watcher.progress) watcher.progress("mastic: fitting its law", 0);
      fit_result(folder.path(), shift, flows, std::get<experiments::SweepResult>(run.found).points);
      result = read_result(folder.path(), flows);
      if (!folder.keep()) computed.folder.clear();
    }
  } catch (const InterruptedError&) { throw; } catch (const InputError& error) {
    throw InputError(names + error.what());
  } catch (const RunError& error) { throw RunError(names + error.what()); }
  take(scene, result.law, range);
  computed.largest_difference = result.largest_difference, computed.units = result.units;
  std::vector<std::string> warnings;
  for (const std::string& words : result.warnings)
    warnings.push_back(fmt::format("mastic from {}: {}", source.file.string(), words));
  if (result.largest_difference > large_difference)
    warnings.push_back(
        fmt::format("mastic from {}: its chain differs by up to {:.2g} % from the modulus of its specimen",
                    source.file.string(), 100 * result.largest_difference));
  source.computed = std::move(computed);
  // A checkpoint stores the text of the scene, so that a run with another law of the mastic cannot continue it.
  if (!scene.text.empty()) scene.text += fmt::format("\n# mastic: {}\n", values_of(result.law));
  return warnings;
}

}  // namespace macadam
