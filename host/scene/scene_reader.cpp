// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_reader.cpp  Defines read_scene(), which reads the file and its sections and checks conditions between
/// sections.
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <new>

#include <fmt/format.h>

#include "host/scene/bending_rollers.hpp"
#include "host/scene/cooling_conditions.hpp"
#include "host/scene/known_keys.hpp"
#include "host/scene/scene_changes.hpp"
#include "host/scene/sections.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace scene {
namespace {

/// Largest size of a scene file [bytes]. People write scenes; a larger file is not a scene.
constexpr std::uintmax_t longest_file = 1u << 20;
/// Longest line [bytes]. A dotted key `a.a.a.…` nests one table per dot, and nested tables are destroyed recursively,
/// so the length of a line limits the depth of the recursion.
constexpr std::size_t longest_line = 2000;

/// Returns the text of a file. `what` is the kind of file in messages. \throws InputError
std::string read_text(const std::filesystem::path& file, const std::string& what) {
  std::error_code error;
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError(file.string(), 0, what, found, expected);
  };
  const std::string kind = "a " + what + " file (TOML)";
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) refuse("no such file", kind);
  if (std::filesystem::is_directory(status)) refuse("a directory", kind);
  if (!std::filesystem::is_regular_file(status)) refuse("a device or pipe", kind);
  const auto bytes = std::filesystem::file_size(file, error);
  if (!error && bytes > longest_file) {
    refuse(fmt::format("{} bytes", bytes), fmt::format("{} of at most {} bytes", kind, longest_file));
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in && errno == ENOMEM) throw std::bad_alloc();
  std::string text(error ? 0 : bytes, '\0');
  if (!in || !in.read(text.data(), std::ssize(text))) refuse("a file that cannot be read", "read permission");
  return text;
}

void check_line_lengths(const std::string& text, const std::string& file, const std::string& what) {
  int line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest_line) {
      throw InputError(file, line, what, fmt::format("{} characters in a line", end - begin),
                       fmt::format("at most {}", longest_line));
    }
    begin = end + 1;
  }
}

void read_network(const Section& section, NetworkSpec& spec) {
  std::vector<Key> keys = keys_of(static_cast<FacetLimits&>(spec));
  keys.push_back({"quadrature", Need::optional,
                  into<Quadrature>(spec.quadrature, {{"lumped", Quadrature::lumped},
                                                     {"exact", Quadrature::exact},
                                                     {"one_point", Quadrature::one_point}}),
                  "area moments of a contact: from its points, from its polygon, or from one point at the centroid"});
  keys.push_back({"lateral_walls", Need::optional, into(spec.lateral_walls),
                  "whether the four sides are walls too; |E*| is then a confined modulus"});
  keys.push_back({"rule", Need::optional,
                  into<ContactRule>(spec.rule, {{"centres", ContactRule::centres},
                                                {"series", ContactRule::series},
                                                {"volumetric", ContactRule::volumetric}}),
                  "how the stiffness of a contact is computed. \"centres\": from the law of its pair and the distance "
                  "of the centres; \"series\": from the laws of mastic and rock, in series along the line between the "
                  "centres; \"volumetric\": as \"series\", with the Poisson's ratios of mastic and rock"});
  keys.push_back({"void_cells", Need::optional,
                  into<VoidCells>(spec.void_cells, {{"volume", VoidCells::volume}, {"spheres", VoidCells::spheres}}),
                  "volume of the cell of a void: the volume of its sphere, or the larger volume that follows from its "
                  "radius",
                  "\"spheres\" with rule \"centres\", else \"volume\""});
  section.read(keys);
}

/// Returns the rule of a scene before its other sections are read, because it decides what they may contain.
ContactRule rule_of(const Section& root) {
  NetworkSpec spec;
  if (root.has("network")) read_network(root.find("network")->section(), spec);
  return spec.rule;
}

void read_output(const Section& section, OutputSpec& spec) {
  std::vector<Key> keys = keys_of(spec.fields);
  keys.push_back({"contacts", Need::optional, into(spec.contacts), "write contacts.csv"});
  keys.push_back({"response", Need::optional, into(spec.response), "write response.csv"});
  keys.push_back({"sensitivities", Need::optional, into(spec.sensitivities),
                  "method \"harmonic\": derivatives of |E*| and phi with respect to every parameter, in summary.json"});
  keys.push_back(
      {"checkpoint", Need::optional, into(spec.checkpoint, duration, non_negative),
       "wall time between two checkpoints of a stepped run; 0: a checkpoint only when the run is interrupted",
       "\"10 min\""});
  section.read(keys);
  check_fields(section, spec.fields);
}

/// Checks conditions between two sections. \throws InputError
void check_together(const Scene& scene, const Section& root) {
  if (scene.network.quadrature == Quadrature::exact && scene.solver.backend == Backend::reference &&
      scene.solver.method == SolverMethod::explicit_) {
    root.find("network")->section().refuse("quadrature", "\"exact\" with backend = \"reference\" in [solver]",
                                           "\"lumped\", because this backend computes each contact point by itself");
  }
  if (scene.network.quadrature == Quadrature::exact && scene.solver.form == ContactForm::points) {
    root.find("network")->section().refuse("quadrature", "\"exact\" with form = \"points\" in [solver]",
                                           "\"lumped\", or form = \"condensed\"");
  }
  if (scene.network.lateral_walls && !scene.specimen.box.is_box()) {
    root.find("network")->section().refuse(
        "lateral_walls", std::string("true with domain = \"") + scene.specimen.box.name() + "\" in [specimen]",
        "false, because only the sides of a box can be held");
  }
  if (scene.output.fields.any() && !has_fields(scene)) {
    root.find("output")->section().refuse("fields", "this key with a test that has no motion of particles to show",
                                          "kind = \"cyclic\" or \"sweep\", or method = \"explicit\" in [solver]");
  }
  if (!temperature_history_of(scene.experiment).empty() && scene.solver.method != SolverMethod::quasi_static) {
    root.find("loading")->section().refuse(
        "temperature", std::string("this key with method \"") + to_string(scene.solver.method) + "\"",
        "method = \"quasi_static\" in [solver], without keys for time steps");
  }
  const auto require_density = [&](bool generated, double density, const std::string& phase) {
    if (generated && density == 0) {
      root.refuse("materials", "no density of the " + phase + " that [specimen] generates",
                  "[materials." + phase + "] with a density");
    }
  };
  require_density(!scene.specimen.aggregate.empty(), scene.materials.aggregate, "aggregate");
  require_density(scene.specimen.mastic.has_value(), scene.materials.mastic, "mastic");
  const auto require_law = [&](PairType pair) {
    if (scene.network.rule == ContactRule::centres && !scene.laws[static_cast<std::size_t>(pair)]) {
      root.refuse("contacts", std::string("no law for ") + to_string(pair) + ", which [specimen] generates",
                  std::string("[[contacts]] with pair = \"") + to_string(pair) + "\"");
    }
  };
  if (scene.specimen.mastic) {
    require_law(PairType::mm);
    require_law(PairType::mw);
    if (!scene.specimen.aggregate.empty()) require_law(PairType::ma);
  }
}

}  // namespace

toml::table read_toml(const std::filesystem::path& file, const std::string& what, std::string& text) {
  text = read_text(file, what);
  return parse_toml(text, file, what);
}

toml::table parse_toml(const std::string& text, const std::filesystem::path& file, const std::string& what) {
  check_line_lengths(text, file.string(), what);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(file.string(), static_cast<int>(error.source().begin.line), "TOML syntax",
                     std::string(error.description()), "valid TOML");
  }
}

namespace {

/// Returns a copy without line numbers, so that messages about it name no line.
toml::table without_lines(const toml::table& table);
toml::array without_lines(const toml::array& array);

/// Calls f with a copy of the content of a node. The copy has no line numbers.
template <class F>
void copied(const toml::node& node, F&& f) {
  node.visit([&](const auto& one) {
    if constexpr (toml::is_table<decltype(one)> || toml::is_array<decltype(one)>)
      f(without_lines(one));
    else
      f(one.get());
  });
}

toml::array without_lines(const toml::array& array) {
  toml::array out;
  for (const toml::node& node : array) copied(node, [&](auto&& value) { out.push_back(value); });
  return out;
}

toml::table without_lines(const toml::table& table) {
  toml::table out;
  for (const auto& [key, node] : table) copied(node, [&, name = key.str()](auto&& value) { out.insert(name, value); });
  return out;
}

/// Gives the domain the strips of its test. A domain that cannot have strips is refused later.
void set_strips(Scene& scene, const Section& root) {
  const double diameter = scene.specimen.box.size.x;
  if (auto* test = std::get_if<experiments::IndirectTensileStrength>(&scene.experiment)) test->diameter = diameter;
  const std::optional<double> asked = std::visit(
      [&](const auto& test) -> std::optional<double> {
        if constexpr (requires { test.strip_width; })
          return test.strip_width.value_or(experiments::usual_strip * diameter);
        return {};
      },
      scene.experiment);
  if (!asked) return;
  const double width = *asked;
  if (!scene.specimen.box.set_strips(width)) return;
  if (!(width >= 0.01 * diameter && width <= 0.5 * diameter))
    root.find("loading")->section().refuse(
        "strip_width", fmt::format("{:g} m", width),
        fmt::format("0.01 to 0.5 of the diameter, {:g} to {:g} m", 0.01 * diameter, 0.5 * diameter));
}

/// Reads all sections. `densities`: whether the scene must give the densities of its materials.
Scene read_root(const ReadingFile& reading, const Section& root, Need densities) {
  Scene out;
  out.file = reading.file;
  const std::filesystem::path folder = reading.file.parent_path();
  const auto read_the_specimen = [&](const Value& v) {
    out.specimen = read_specimen(v.section(), folder, out.recipe, out.network.notches);
  };
  std::optional<SolverSpec> solver;
  PhaseLaws phases;
  PairCracks cracks;
  TemperatureTables tables;
  const ContactRule rule = rule_of(root);
  const bool of_phases = has_laws_of_phases(rule);
  root.read({{"specimen", Need::required, section_by(read_the_specimen),
              "the specimen, which is read from a file or generated"},
             {"materials", densities, section_by([&](const Value& v) {
                out.materials = read_materials(v.section(), densities, rule, reading, phases);
                tables.temperature = out.materials.temperature;
              }),
              "densities, and the temperature", "computed from [specimen.recipe] if that is given"},
             {"contacts", of_phases ? Need::optional : Need::required, sections_by([&](const Value& v) {
                if (of_phases) return read_limits_of_pairs(v.sections(), rule, out.network, cracks, tables);
                out.laws = read_contacts(v.sections(), out.shifts, out.ranges, out.deltas, out.network, tables);
              }),
              "contact law of a pair of materials; one section per pair"},
             {"network", Need::optional, section_by([&](const Value& v) { read_network(v.section(), out.network); }),
              "which facets of the tessellation are contacts", "every facet"},
             {"loading", Need::required,
              section_by([&](const Value& v) { out.experiment = read_experiment(v.section()); }), "the test"},
             {"solver", Need::optional,
              section_by([&](const Value& v) { solver = read_solver(v.section(), out.experiment); }),
              "how the test is stepped or solved", "the defaults of its keys"},
             {"output", Need::optional, section_by([&](const Value& v) { read_output(v.section(), out.output); }),
              "files that are written besides the results", "the defaults of its keys"}});
  out.solver = solver.value_or(usual_solver(out.experiment));
  // only the CPU computes the pressures of cells
  if (rule == ContactRule::volumetric && out.solver.backend == Backend::automatic) out.solver.backend = Backend::cpu;
  if (out.recipe) take_densities(*out.recipe, root, out.materials);
  set_laws_of_phases(out, phases, cracks, root);
  choose_method(out.solver, out.experiment, out.laws);
  set_strips(out, root);
  set_rollers(out, root);
  require_cooling(out, root);
  check_together(out, root);
  apply_temperature(out, root, tables);
  return out;
}

Scene read_tables(const ReadingFile& reading, std::string text, const toml::table& table) {
  const Need densities = table["specimen"]["recipe"] ? Need::optional : Need::required;
  Scene out = read_root(reading, Section(reading.file.string(), 0, "", "", table), densities);
  out.text = std::move(text);
  return out;
}

}  // namespace

Scene read_inner_scene(const ReadingFile& reading) {
  std::string text;
  const toml::table table = read_toml(reading.file, "scene", text);
  return read_tables(reading, std::move(text), table);
}

std::vector<KnownKey> known_keys() {
  const toml::table nothing;
  Collector collector;
  try {
    read_root({}, Section("", 0, "", "", nothing, &collector), Need::required);
  } catch (const Collector::Done&) {}
  return collector.keys();
}

}  // namespace scene

Scene read_scene(const std::filesystem::path& file) { return scene::read_inner_scene({file}); }

Scene read_scene(const std::filesystem::path& file, const std::string& text, bool lines) {
  const toml::table table = scene::parse_toml(text, file, "scene");
  if (lines) return scene::read_tables({file}, text, table);
  return scene::read_tables({file}, text, scene::without_lines(table));
}

Scene read_changed_scene(const std::filesystem::path& file, const std::vector<std::string>& changes) {
  if (changes.empty()) return read_scene(file);
  std::string text;
  toml::table table = scene::read_toml(file, "scene", text);
  scene::ChangedScene changed = scene::with_changes(std::move(table), std::move(text), changes);
  Scene out = scene::read_tables({file}, std::move(changed.text), changed.table);
  out.changes = changes;
  return out;
}

std::string read_scene_text(const std::filesystem::path& file) {
  std::string text;
  scene::read_toml(file, "scene", text);
  return text;
}

}  // namespace macadam
